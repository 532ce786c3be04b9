#!/usr/bin/env bash
# Builds and runs the tests: ./test.sh [option] [ctest options]
#   without one      what CI runs: all tests but the long ones, then --lint and --sanitize
#   --quick          unit, system and regression tests only
#   --label NAME     unit, verification, system, regression, lint or long
#   --sanitize       unit tests, and those of programs and verification that are quick enough, with AddressSanitizer,
#                    UndefinedBehaviorSanitizer, LeakSanitizer and the assertions of deal.II's Debug library, in build-sanitize
#   --lint           clang-format, clang-tidy and cppcheck over library and programs
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

# Release build, and the tests of $@ in it. CI looks at the report and at XDMF as users do, with 1 GB of programs.
release() {
  install_packages
  [ -z "${CI:-}" ] || (mesoslip_packages=(chromium python3-paraview) && install_packages) ||
    say "Without them system/report/browser or system/programs/xdmf is skipped"
  build build all
  ctest --test-dir build --output-on-failure -j "$(nproc)" "$@"
}

# One build for both kinds of checks: deal.II's Debug library and our assertions, and the sanitizers.
sanitize() {
  install_packages
  cmake_options+=(-DCMAKE_BUILD_TYPE=Debug -DMESOSLIP_SANITIZE=ON)
  build build-sanitize sanitized_tests
  # Memory that cannot be had is a failed allocation, as without the sanitizers.
  export ASAN_OPTIONS=allocator_may_return_null=1:detect_stack_use_after_return=1:strict_string_checks=1
  # Whole stacks, also through libraries without frame pointers, for the names in leaks.txt.
  ASAN_OPTIONS+=:fast_unwind_on_malloc=0
  export LSAN_OPTIONS=suppressions=$PWD/tests/lint/leaks.txt:print_suppressions=0
  export UBSAN_OPTIONS=print_stacktrace=1
  ctest --test-dir build-sanitize --output-on-failure -j "$(nproc)" --label-regex '^sanitize$' "$@"
}

# clang-format, and clang-tidy, which reads two halves of the library (tests/lint/clang_tidy.cmake), kernels and programs.
tidy() {
  local mesoslip_packages=("${mesoslip_packages[@]}" clang clang-tidy clang-format)
  install_packages
  find lib applications tests doc -name '*.cc' -o -name '*.h' | xargs clang-format --dry-run -Werror ||
    fail "clang-format would write the above differently: clang-format -i"
  local cmake_options=(-DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++
                       -DCMAKE_UNITY_BUILD_BATCH_SIZE=0)
  configure build-lint
  cmake build-lint >build-lint/configure.log # files may have come and gone
  say "clang-tidy reads library and programs (some minutes)"
  run-clang-tidy -p build-lint -quiet -extra-arg=-Wno-ignored-optimization-argument "/tidy_(lower|upper).dir/|^$PWD/lib/|^$PWD/build-lint/(lib/[a-z]|applications/)" \
    >build-lint/clang-tidy.log 2>&1 || {
    grep -E -A 3 '(error|warning):' build-lint/clang-tidy.log || tail -n 5 build-lint/clang-tidy.log
    fail "clang-tidy finds the above"
  }
  say "clang-tidy finds nothing"
}

lint() {
  tidy
  ctest --test-dir build-lint --output-on-failure --label-regex lint "$@"
}

cmake_options=()
[ -z "${CI:-}" ] || cmake_options+=(-DMESOSLIP_WERROR=ON)
case ${1:-} in
  -h | --help) sed -n '2,/^set/s/^# //p' "$0" ;;
  --fuzz) fuzz "${2:?--fuzz needs a number of seconds}" ;;
  --sanitize) sanitize "${@:2}" ;;
  --lint) lint "${@:2}" ;;
  --quick) release --label-exclude 'long|verification' "${@:2}" ;;
  --label) release --label-regex "${2:?--label needs a name}" "${@:3}" ;;
  "") release --label-exclude long && tidy && sanitize ;;
  *) release --label-exclude long "$@" ;;
esac
