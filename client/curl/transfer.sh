#!/bin/sh
# SPDX-License-Identifier: MIT
# transfer.sh SOURCE TARGET INPUT.npy OUTPUT.npy [PARAMETER=VALUE...]     carries rows of the target's vertices to the source's
# Skin weights, labels, colours, fields: one row for each vertex of TARGET in, one for each vertex of SOURCE out. Parameters are those of
# POST /transfer, for example interp=nearest.
. "$(dirname "$0")/common.sh"
[ $# -ge 4 ] || fail 'usage: transfer.sh SOURCE TARGET INPUT.npy OUTPUT.npy [PARAMETER=VALUE...]'
query="src=$(escaped "$1")&tgt=$(escaped "$2")&wait=60"
input=$3 output=$4
[ -r "$input" ] || fail "cannot read $input"
shift 4
for parameter; do query="$query&${parameter%%=*}=$(escaped "${parameter#*=}")"; done
(call -H "Content-Type: application/x-npy" --data-binary "@$input" "$URL/transfer?$query") > "$output.part" || { rm -f "$output.part"; exit 1; }
mv "$output.part" "$output"
