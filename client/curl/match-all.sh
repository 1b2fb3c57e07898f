#!/bin/sh
# SPDX-License-Identifier: MIT
# match-all.sh SHAPE SHAPE [SHAPE...]     matches all ordered pairs of the shapes in one job; prints a line of JSON for each as it finishes
# At most 1000 pairs, which is 32 shapes. FIELDS chooses the arrays, as the parameter of GET /match does: vertex (default), corners, bary,
# confidence, distortion.
. "$(dirname "$0")/common.sh"
[ $# -ge 2 ] || fail 'usage: match-all.sh SHAPE SHAPE [SHAPE...]'
job=$(jq -n --arg fields "${FIELDS-vertex}" '{fields: $fields, pairs: [$ARGS.positional as $ids | $ids[] as $a | $ids[] as $b | select($a != $b) | [$a, $b]]}' \
  --args -- "$@" | call -H 'Content-Type: application/json' --data-binary @- "$URL/match" | jq -r .id)
exec curl -sSN ${SPHEREMATCH_KEY:+-H "Authorization: Bearer $SPHEREMATCH_KEY"} "$URL/jobs/$job/results"
