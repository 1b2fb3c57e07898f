#!/bin/sh
# SPDX-License-Identifier: MIT
# list.sh [PARAMETER=VALUE...]     all shapes, newest first: id, state, vertices, name
# Parameters are those of GET /shapes, for example tag=hand state=ready q=left.
. "$(dirname "$0")/common.sh"
query=limit=200
for parameter; do query="$query&${parameter%%=*}=$(escaped "${parameter#*=}")"; done
cursor=
while true; do
  page=$(call "$URL/shapes?$query${cursor:+&cursor=$cursor}")
  printf '%s' "$page" | jq -r '.items[] | [.id, .state, .vertices, .name] | @tsv'
  cursor=$(printf '%s' "$page" | jq -r '.next_cursor // empty')
  [ -n "$cursor" ] || break
done
