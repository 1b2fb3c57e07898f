#!/bin/bash
# scripts/demo.sh URL: what a newcomer would do with a running server, with two of the shipped samples, and what comes out of it.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

url=$1
source=samples/hound/stand.off
target=samples/hound/leap.glb
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

fail() {
  echo "demo: $*" >&2
  exit 1
}

# upload FILE: posts a mesh, waits until it is prepared, and prints its shape object.
upload() {
  local shape id
  shape=$(curl -sS --fail-with-body --data-binary "@$1" "$url/shapes?name=$(basename "$1")&wait=60") || fail "$1: $shape"
  id=$(jq -r .id <<<"$shape")
  while [[ $(jq -r .state <<<"$shape") =~ ^(queued|processing)$ ]]; do
    sleep 0.5
    shape=$(curl -sS --fail-with-body "$url/shapes/$id") || fail "$1: $shape"
  done
  [ "$(jq -r .state <<<"$shape")" = ready ] || fail "$1: $(jq -r .error.detail <<<"$shape")"
  printf '%s' "$shape"
}

# seconds: reads an object that has the member "seconds" and prints its stages in one line.
seconds() {
  jq -r '.seconds | to_entries | map("\(.key) \(.value * 100 | round / 100)") | join(", ")'
}

echo "Uploading $source and $target ..."
a=$(upload "$source")
b=$(upload "$target")
match="$url/match?src=$(jq -r .id <<<"$a")&tgt=$(jq -r .id <<<"$b")"
curl -sS --fail -o "$place/map.npz" "$match&format=npz"
answer=$(curl -sS --fail "$match&fields=")
error=$(build/bin/spherematch evaluate "$source" "$target" "$place/map.npz" \
  --landmarks "${source%.*}.vts" "${target%.*}.vts" --mirrored "${target%.*}.sym.vts")

cat <<SUMMARY

  source    $source: $(jq -r '"\(.vertices) vertices, \(.faces) faces"' <<<"$a")
  prepared  in seconds: $(seconds <<<"$a")
  target    $target: $(jq -r '"\(.vertices) vertices, \(.faces) faces"' <<<"$b")
  prepared  in seconds: $(seconds <<<"$b")
  matched   in seconds: $(seconds <<<"$answer")
  ${error//$'\n'/$'\n'  }

The match, to look at:
  $url/#src=$(jq -r .id <<<"$a")&tgt=$(jq -r .id <<<"$b")
Both shapes in one picture, corresponding points in one colour:
  $match&format=png
The source coloured by its place on the target, for MeshLab, Blender or three.js:
  curl '$match&format=glb' -o match.glb
The map as arrays for NumPy:
  curl '$match&format=npz' -o map.npz

The server goes on at $url/ (Control-C ends it). Your own meshes next:
  curl --data-binary @mesh.obj '$url/shapes?name=mesh&wait=60'
SUMMARY
