#!/bin/sh
# SPDX-License-Identifier: MIT
# upload.sh MESH [PARAMETER=VALUE...]     uploads a mesh, waits until it is prepared, prints its id
# Parameters are those of POST /shapes, for example tags=hand,left simplify=5000 repair=none.
. "$(dirname "$0")/common.sh"
[ $# -ge 1 ] || fail 'usage: upload.sh MESH [PARAMETER=VALUE...]'
mesh=$1
shift
[ -r "$mesh" ] || fail "cannot read $mesh"
query="name=$(escaped "${mesh##*/}")&wait=60"
for parameter; do query="$query&${parameter%%=*}=$(escaped "${parameter#*=}")"; done

shape=$(call --data-binary "@$mesh" "$URL/shapes?$query")
id=$(printf '%s' "$shape" | jq -r .id)
while true; do
  case $(printf '%s' "$shape" | jq -r .state) in
    ready) break ;;
    failed) fail "$mesh: $(printf '%s' "$shape" | jq -r .error.detail)" ;;
  esac
  printf '%s' "$shape" | jq -r '"\(.name): \(.stage // "queued") \(.progress * 100 | floor)%"' >&2
  call "$URL/jobs/p$id?wait=5" > /dev/null
  shape=$(call "$URL/shapes/$id")
done
echo "$id"
