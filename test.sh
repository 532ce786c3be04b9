#!/usr/bin/env bash
# Builds and runs the tests: ./test.sh [--quick] [--label unit|verification|regression] [ctest options]
#   --quick   unit and regression tests only
#   --fuzz SECONDS   only the fuzzers, so long each, built with clang in build-fuzz
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")"
. cmake/setup.sh

# Each fuzzer for $1 seconds; findings are in build-fuzz/tests/findings.
fuzz() {
  mesoslip_packages+=(clang)
  install_packages
  cmake_options=(-DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DMESOSLIP_SANITIZE=ON)
  build build-fuzz fuzzers
  local program failed=()
  for program in build-fuzz/tests/fuzz_*; do
    tests/fuzz/run.sh "$program" "$1" || failed+=("${program##*/fuzz_}")
  done
  [ ${#failed[@]} -eq 0 ] || fail "something was found in ${failed[*]}: see build-fuzz/tests/findings"
}

selection=(--label-exclude long)
while [ $# -gt 0 ]; do
  case $1 in
    --quick) selection=(--label-exclude 'long|verification') ;;
    --fuzz) fuzz "${2:?--fuzz needs a number of seconds}"; exit ;;
    --label) selection=(--label-regex "${2:?--label needs a name}"); shift ;;
    -h | --help) sed -n '2,4s/^# //p' "$0"; exit 0 ;;
    *) break ;;
  esac
  shift
done

install_packages
cmake_options=()
[ -z "${CI:-}" ] || cmake_options+=(-DMESOSLIP_WERROR=ON)
build build all
exec ctest --test-dir build --output-on-failure -j "$(nproc)" "${selection[@]}" "$@"
