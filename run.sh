#!/bin/bash
# Installs what is missing, builds, and starts the server. See usage() below.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")"
. scripts/setup.sh

usage() {
  cat <<'USAGE'
usage: ./run.sh [OPTION...]   install, build and serve on http://127.0.0.1:8080, shapes kept in data/spherematch.db
       ./run.sh build         install and build only
       ./run.sh demo          does not exist yet

Options go to build/bin/spherematch-server, for example --port 8081; relative paths start at the repository root.
The server's own list of options: ./run.sh --help
USAGE
}

install_and_build() {
  install_packages build
  build_targets spherematch-server spherematch
}

# Copies the server's output, and says after its first line what to do with the address in it.
announce() {
  # Control-C reaches the whole group; the server then stops on its own terms, and this ends with its output.
  trap '' INT TERM
  local line url
  IFS= read -r line || return 0
  printf '%s\n' "$line"
  case $line in
    'listening on http'*)
      url=${line#listening on }
      cat <<HINTS

Spherematch serves at $url/

Upload a mesh, then match two by the ids of the answers:
  curl --data-binary @mesh.off '$url/shapes?name=mesh&wait=60'
  curl '$url/match?src=ID&tgt=ID&format=npz' -o map.npz

HINTS
      ;;
  esac
  cat
}

case ${1:-} in
  build)
    [ $# -eq 1 ] || { usage >&2; exit 2; }
    install_and_build
    exit
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
exec "$build_dir/bin/spherematch-server" "$@" > >(announce)
