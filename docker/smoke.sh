#!/bin/bash
# docker/smoke.sh [IMAGE]: builds the image with docker or podman, starts it with keys and a volume, and looks whether it does its work
# and keeps it over a restart. With an IMAGE nothing is built. Needs curl and jq. Without an engine: docker/smoke-chroot.sh.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

engine=${ENGINE:-}
for candidate in docker podman; do
  [ -n "$engine" ] || ! "$candidate" info >/dev/null 2>&1 || engine=$candidate
done
[ -n "$engine" ] || { echo "smoke: neither docker nor podman runs here; docker/smoke-chroot.sh does the same steps without" >&2; exit 1; }

image=${1:-spherematch}
name=spherematch-smoke-$$
[ $# -gt 0 ] || "$engine" build -t "$image" -f docker/Dockerfile .

clean_up() {
  "$engine" rm -f "$name" >/dev/null 2>&1 || true
  "$engine" volume rm "$name" >/dev/null 2>&1 || true
}
trap clean_up EXIT

if "$engine" run --rm --name "$name" "$image" 2>/dev/null; then
  echo "smoke: the server started without keys" >&2
  exit 1
fi
"$engine" volume create "$name" >/dev/null
key=$("$engine" run --rm -v "$name:/var/lib/spherematch" "$image" keys add --name smoke --scope admin 2>/dev/null)
"$engine" run -d --name "$name" -v "$name:/var/lib/spherematch" -p 127.0.0.1::8080 "$image" >/dev/null
address() { "$engine" port "$name" 8080/tcp | head -n 1; }
docker/smoke-checks.sh "http://$(address)" "$key" first
[ "$("$engine" exec "$name" id -u)" = 10001 ] || { echo "smoke: the server does not run as its own user" >&2; exit 1; }
"$engine" exec "$name" spherematch-server --check
"$engine" restart "$name" >/dev/null
docker/smoke-checks.sh "http://$(address)" "$key" again
echo "smoke: passed with $engine"
