#!/bin/bash
# docker/smoke-checks.sh URL KEY first|again: what smoke.sh and smoke-chroot.sh ask a running server: that it is ready, keeps strangers
# out of everything but the page, prepares and matches two of the samples (first), or has kept them over a restart (again).
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

url=$1
key=$2
phase=$3

fail() {
  echo "smoke: $*" >&2
  exit 1
}

call() {
  curl -sS --max-time 90 -H "Authorization: Bearer $key" "$@"
}

# expect STATUS ARGUMENT...: the status that curl gets with these arguments, without the key.
expect() {
  local wanted=$1 status
  shift
  status=$(curl -sS --max-time 90 -o /dev/null -w '%{http_code}' "$@")
  [ "$status" = "$wanted" ] || fail "$* gave $status instead of $wanted"
}

wait_until_ready() {
  local left
  for ((left = 120; left > 0; --left)); do
    [ "$(curl -s -o /dev/null -w '%{http_code}' "$url/readyz" || true)" = 200 ] && return
    sleep 0.5
  done
  fail "$url/readyz: $(curl -sS "$url/readyz" 2>&1)"
}

# upload FILE: prints the id once the shape is ready.
upload() {
  local shape left
  shape=$(call --fail-with-body --data-binary "@$1" "$url/shapes?name=$(basename "$1")&wait=60") || fail "$1: $shape"
  for ((left = 240; left > 0; --left)); do
    case $(jq -r .state <<<"$shape") in
      ready)
        jq -r .id <<<"$shape"
        return
        ;;
      failed) fail "$1: $shape" ;;
    esac
    sleep 0.5
    shape=$(call "$url/shapes/$(jq -r .id <<<"$shape")")
  done
  fail "$1 is not ready: $shape"
}

wait_until_ready
expect 200 "$url/healthz"
expect 401 "$url/shapes"
expect 401 --data-binary @samples/hound/stand.off "$url/shapes"
# The page is bundled when the image is built, and strangers may load all of it.
files=$(curl -sS --max-time 90 --fail "$url/" | grep -oE '/page/[a-z]+\.[a-z]+(\?v=[0-9a-f]+)?' | sort -u) || fail "no page at $url/"
for file in $files; do
  expect 200 "$url$file"
done
[[ $files == *page.css\?v=*page.js\?v=* ]] || fail "the page does not ask for its style and its program: $files"

known=$(call "$url/shapes" | jq '.items | length')
if [ "$phase" = first ]; then
  [ "$known" = 0 ] || fail "a new store has $known shapes"
else
  [ "$known" = 2 ] || fail "$known shapes instead of 2 after the restart"
fi
begin=$(date +%s)
a=$(upload samples/hound/stand.off)
b=$(upload samples/hound/leap.glb)
took=$(($(date +%s) - begin))
[ "$phase" = first ] || [ "$took" -le 2 ] || fail "known uploads took $took s: they were prepared again"

answer=$(call --fail-with-body "$url/match?src=$a&tgt=$b") || fail "match: $answer"
jq -e '(.vertex | length) == .n_src and .n_src > 1000 and (.n_tgt as $n | .vertex | all(. >= 0 and . < $n))
  and (.vertex | unique | length) > .n_tgt / 2 and .quality.flipped_target < 0.1' >/dev/null <<<"$answer" || fail "not the match it should be: ${answer:0:300}"
arrays=$(call -o /dev/null -w '%{http_code} %{content_type} %{size_download}' "$url/match?src=$a&tgt=$b&format=npz")
[[ $arrays =~ ^200\ application/x-npz\ [0-9]{5,}$ ]] || fail "not the arrays of a match: $arrays"
metrics=$(call "$url/metrics")
grep -q '^spherematch_http_requests_total{.*route="/match"} ' <<<"$metrics" || fail "no count of matches in /metrics"
echo "smoke: $phase: two shapes ready after $took s, matched $(jq .n_src <<<"$answer") vertices onto $(jq '.vertex | unique | length' <<<"$answer")"
