#!/bin/bash
# Installs what is missing, builds, and starts the server. See usage() below.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")"
. scripts/setup.sh

usage() {
  cat <<'USAGE'
usage: ./run.sh [OPTION...]        install, build and serve on http://127.0.0.1:8080, shapes kept in data/spherematch.db
       ./run.sh build              install and build only
       ./run.sh demo [OPTION...]   the same as the first, then uploads two sample meshes, matches them, and shows what came out

Options go to build/bin/spherematch-server, for example --port 8081; relative paths start at the repository root.
The server's own list of options: ./run.sh --help
USAGE
}

install_and_build() {
  install_build_packages
  build_targets spherematch-server spherematch
}

# announce [demo]: copies the server's output, and after its first line says what to do with the address in it, or does it.
announce() {
  # Control-C reaches the whole group; the server then stops on its own terms, and this ends with its output.
  trap '' INT TERM
  local line url
  IFS= read -r line || return 0
  printf '%s\n' "$line"
  case $line in
    'listening on http'*)
      url=${line#listening on }
      if [ "${1:-}" = demo ]; then
        scripts/demo.sh "$url" || echo "The demo did not get to its end." >&2
      else
        hint "$url"
      fi
      ;;
  esac
  cat
}

# hint URL: two lines to try.
hint() {
  cat <<HINTS

The page, for dropping meshes on and looking at maps: $1/

Or upload a mesh, then match two by the ids of the answers:
  curl --data-binary @mesh.off '$1/shapes?name=mesh&wait=60'
  curl '$1/match?src=ID&tgt=ID&format=npz' -o map.npz

HINTS
}

mode=serve
case ${1:-} in
  build)
    [ $# -eq 1 ] || { usage >&2; exit 2; }
    install_and_build
    exit
    ;;
  demo)
    mode=demo
    shift
    install_packages build demo
    ;;
  help | -h)
    usage
    exit
    ;;
  '' | -*) ;;
  *)
    echo "unknown command \"$1\"" >&2
    usage >&2
    exit 2
    ;;
esac

install_and_build
# The server's own defaults are what usage() says. exec: signals to this script are signals to the server.
exec "$build_dir/bin/spherematch-server" "$@" > >(announce "$mode")
