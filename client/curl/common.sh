# SPDX-License-Identifier: MIT
# What the scripts share; to be sourced. SPHEREMATCH_URL is the server, SPHEREMATCH_KEY the API key where it needs one.
set -eu

URL=${SPHEREMATCH_URL:-http://127.0.0.1:8080}

fail() {
  printf '%s: %s\n' "${0##*/}" "$1" >&2
  exit 1
}

for tool in curl jq; do
  command -v "$tool" > /dev/null || fail "needs $tool"
done

# call CURL-ARGUMENT...: curl with the key, retries of what passes, and the server's reason on standard error where it refuses.
call() {
  body=$(mktemp)
  status=$(curl -sS --retry 3 --retry-connrefused -o "$body" -w '%{http_code}' ${SPHEREMATCH_KEY:+-H "Authorization: Bearer $SPHEREMATCH_KEY"} "$@") || {
    rm -f "$body"
    fail "no answer from $URL"
  }
  if [ "$status" -ge 400 ]; then
    reason=$(jq -r '"\(.code): \(.detail)"' "$body" 2> /dev/null || cat "$body")
    rm -f "$body"
    fail "the server refused with $status, $reason"
  fi
  cat "$body"
  rm -f "$body"
}

# escaped TEXT: fit for a query.
escaped() {
  printf '%s' "$1" | jq -sRr @uri
}
