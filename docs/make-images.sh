#!/bin/bash
# docs/make-images.sh: makes the pictures of docs/tutorial.md and docs/gallery.md again, by running the documents against a server of its
# own, built by ./run.sh build. Options go to run_document.py: --update writes what the blocks print into the documents.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

place=$(mktemp -d)
trap 'kill "$server" 2>/dev/null || true; rm -rf "$place"' EXIT
build/bin/spherematch-server --port 0 --store "$place/store.db" >"$place/listening" 2>/dev/null &
server=$!
until grep -q '^listening on' "$place/listening"; do
  kill -0 "$server"
  sleep 0.1
done
url=$(sed -n 's/^listening on //p' "$place/listening")

mkdir "$place/work"
ln -s "$PWD"/{samples,client,build} "$place/work/"
for document in tutorial gallery; do
  python3 -B docs/run_document.py "docs/$document.md" "$url" "$place/work" "$@"
done

# Of all that the documents' commands write, the pictures that the documents show.
mkdir -p docs/images/tutorial docs/images/gallery
for document in tutorial gallery; do
  grep -o "images/$document/[a-z0-9-]*\.png" "docs/$document.md" | sort -u | while read -r image; do
    cp "$place/work/$(basename "$image")" "docs/$image"
  done
done
cp "$place/work/match.png" docs/images/hound.png
du -bc docs/images/*/*.png docs/images/*.png | tail -1
