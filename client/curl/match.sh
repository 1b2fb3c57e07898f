#!/bin/sh
# SPDX-License-Identifier: MIT
# match.sh SOURCE TARGET OUTPUT [PARAMETER=VALUE...]     the map between two shapes, by their ids, as a file
# The output's extension chooses the format: npz npy txt ply glb obj png json. Parameters are those of GET /match, for example
# orientation=any hints=12:40,77:3, or fields=confidence,distortion for these two beside the map in npz and ply.
. "$(dirname "$0")/common.sh"
[ $# -ge 3 ] || fail 'usage: match.sh SOURCE TARGET OUTPUT [PARAMETER=VALUE...]'
query="src=$(escaped "$1")&tgt=$(escaped "$2")&format=$(escaped "${3##*.}")&wait=60"
output=$3
shift 3
for parameter; do query="$query&${parameter%%=*}=$(escaped "${parameter#*=}")"; done
(call "$URL/match?$query") > "$output.part" || { rm -f "$output.part"; exit 1; }
mv "$output.part" "$output"
