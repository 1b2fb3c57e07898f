#!/bin/bash
# docker/smoke-chroot.sh [BASE]: what docker/smoke.sh does, on a machine without a container engine or a registry, as root.
#
# buildah performs docker/Dockerfile instruction by instruction in chroot isolation, and runs the image's programs as the image's user.
# debian:bookworm, which nothing can be pulled from here, is a bare root made by debootstrap: BASE, or a new one, from $MIRROR.
# Needs the Debian packages buildah, debootstrap, curl, jq and procps, some minutes, and 6 GB in $TMPDIR, which are freed at the end; in a
# directory named by $WORK they stay, and the next run begins with what is there.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
[ "$(id -u)" -eq 0 ] || { echo "smoke: chroot and debootstrap need root" >&2; exit 1; }

place=${WORK:-$(mktemp -d)}
mkdir -p "$place"
server=
export STORAGE_DRIVER=${STORAGE_DRIVER:-overlay} BUILDAH_ISOLATION=chroot

buildah_here() {
  buildah --root "$place/storage" --runroot "$place/run" "$@"
}

clean_up() {
  local code=$?
  [ "$code" -eq 0 ] || [ ! -f "$place/log" ] || tail -n 30 "$place/log" >&2
  [ -z "$server" ] || kill "$(innermost "$server")" 2>/dev/null || true
  buildah_here rm --all >/dev/null 2>&1 || true
  [ -z "${WORK:-}" ] || return
  buildah_here rmi --all --force >/dev/null 2>&1 || true
  umount "$place/storage/overlay" 2>/dev/null || true
  rm -rf "$place"
}
trap clean_up EXIT

# innermost PID: the process at the end of the chain of buildah's own processes. It does not end with them.
innermost() {
  local pid=$1 child
  while child=$(pgrep -P "$pid" | head -n 1) && [ -n "$child" ]; do pid=$child; done
  echo "$pid"
}

fail() {
  echo "smoke: $*" >&2
  exit 1
}

make_base() {
  local base=${1:-} container
  ! buildah_here inspect --type image debian:bookworm >/dev/null 2>&1 || return 0
  if [ -z "$base" ]; then
    base=$place/base
    debootstrap --variant=minbase bookworm "$base" "${MIRROR:-http://deb.debian.org/debian}" >"$place/log"
  fi
  container=$(buildah_here from scratch)
  buildah_here add -q "$container" "$base" / >/dev/null
  buildah_here commit -q "$container" docker.io/library/debian:bookworm >/dev/null
  buildah_here tag docker.io/library/debian:bookworm docker.io/library/debian:bookworm-slim
  buildah_here rm "$container" >/dev/null
}

# in_container COMMAND...: with the image's user, environment and working directory.
in_container() {
  buildah_here run "$container" -- "$@"
}

# start: sets `server` to the process of buildah.
start() {
  in_container spherematch-server --host 127.0.0.1 --port "$port" >"$place/log" 2>&1 &
  server=$!
}

# The server itself, rather than buildah around it, is told to stop, as a container engine would.
stop() {
  local pid
  pid=$(innermost "$server")
  [[ $(ps -o comm= -p "$pid") = spherematch-ser* ]] || fail "process $pid is not the server"
  kill -TERM "$pid"
  wait "$server" || fail "the server ended with $?"
  server=
}

echo "smoke: the base" >&2
make_base "${1:-}"
echo "smoke: the image" >&2
buildah_here build -q --layers --pull-never --format docker -t spherematch -f docker/Dockerfile . >"$place/log" 2>&1
container=$(buildah_here from --pull-never spherematch)
port=${PORT:-18080}
url=http://127.0.0.1:$port

[ "$(in_container id -u)" = 10001 ] || fail "the image's programs do not run as its user"
! in_container spherematch-server --port "$port" >/dev/null 2>&1 || fail "the server started without keys"
key=$(in_container spherematch-server keys add --name smoke --scope admin 2>/dev/null)
start
docker/smoke-checks.sh "$url" "$key" first
in_container spherematch-server --port "$port" --check
stop
! in_container spherematch-server --port "$port" --check >/dev/null 2>&1 || fail "--check is content with a server that is gone"
start
docker/smoke-checks.sh "$url" "$key" again
stop
echo "smoke: passed with buildah in chroot isolation, image of $(buildah_here images --format '{{.Size}}' spherematch)"
