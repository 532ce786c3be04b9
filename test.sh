#!/usr/bin/env bash
# Builds and runs the tests: ./test.sh [--quick] [--label unit|verification|regression] [ctest options]
#   --quick   unit and regression tests only
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")"
. cmake/setup.sh

selection=(--label-exclude long)
while [ $# -gt 0 ]; do
  case $1 in
    --quick) selection=(--label-exclude 'long|verification') ;;
    --label) selection=(--label-regex "${2:?--label needs a name}"); shift ;;
    -h | --help) sed -n '2,3s/^# //p' "$0"; exit 0 ;;
    *) break ;;
  esac
  shift
done

install_packages
cmake_options=()
[ -z "${CI:-}" ] || cmake_options+=(-DMESOSLIP_WERROR=ON)
build build all
exec ctest --test-dir build --output-on-failure -j "$(nproc)" "${selection[@]}" "$@"
