#!/bin/bash
# ./test.sh [CTEST OPTION...]   installs what is missing, builds everything and runs every test
# ./test.sh tidy [FILE-REGEX]   clang-tidy over the sources instead, which takes long
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")"
. scripts/setup.sh

if [ "${1:-}" = tidy ]; then
  shift
  install_build_packages
  install_packages tidy
  [ -f "$build_dir/build.ninja" ] || cmake --preset release >&2
  # An anchored default keeps outside code that a build may have generated out of the list.
  exec run-clang-tidy -quiet -p "$build_dir" "${1:-$PWD/(engine|storage|api|server|cli|client)/.*}"
fi

install_build_packages
install_packages test
install_page_tests
build_targets
exec ctest --test-dir "$build_dir" --output-on-failure -j2 "$@"
