#!/bin/sh
# SPDX-License-Identifier: MIT
# delete.sh SHAPE...     removes shapes with everything derived from them
. "$(dirname "$0")/common.sh"
[ $# -ge 1 ] || fail 'usage: delete.sh SHAPE...'
for shape; do call -X DELETE "$URL/shapes/$(escaped "$shape")"; done
