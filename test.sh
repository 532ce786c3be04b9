#!/usr/bin/env bash
# Builds and runs the tests: ./test.sh [option] [ctest options]
#   without one      what CI runs: all tests but the long ones, then --lint and --sanitize
#   --quick          unit and regression tests, and those of the system that take less than a quarter of a minute
#   --label NAME     unit, verification, system, regression, lint or long
#   --sanitize       unit tests, and those of programs and verification that are quick enough, with AddressSanitizer,
#                    UndefinedBehaviorSanitizer, LeakSanitizer and the assertions of deal.II's Debug library, in build-sanitize
#   --lint           clang-format, clang-tidy and cppcheck over library and programs
#   --fuzz SECONDS   only the fuzzers, so long each, built with clang in build-fuzz
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")"
. cmake/setup.sh

# phase <name>: what follows belongs to it, until the next one. At the end a table tells how long each took.
phases=() phase_starts=()
phase() { phases+=("$1"); phase_starts+=("$SECONDS"); }

# The phases so far, and which tests took longest, so that growth is seen when it comes.
report_times() {
  local k end
  say "Where the time went (s):"
  for k in "${!phases[@]}"; do
    end=${phase_starts[k + 1]:-$SECONDS}
    printf '%6d  %s\n' $((end - phase_starts[k])) "${phases[k]}"
  done
  printf '%6d  in all\n' "$SECONDS"
  local costs=build/Testing/Temporary/CTestCostData.txt
  [ ! -f "$costs" ] || { say "Longest tests (s):"; sed '/^---/,$d' "$costs" | sort -rn -k 3 | awk 'NR <= 12 {printf "%6.0f  %s\n", $3, $1}'; }
}

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
  phase packages
  install_packages
  [ -z "${CI:-}" ] || (mesoslip_packages=(chromium python3-paraview) && install_packages) ||
    say "Without them system/report/browser or system/programs/xdmf is skipped"
  phase "build of programs and tests"
  build build all
  phase "tests"
  ctest --test-dir build --output-on-failure -j "$(n_cores)" "$@"
}

# One build for both kinds of checks: deal.II's Debug library and our assertions, and the sanitizers.
sanitize() {
  install_packages
  cmake_options+=(-DCMAKE_BUILD_TYPE=Debug -DMESOSLIP_SANITIZE=ON)
  phase "build with sanitizers"
  build build-sanitize sanitized_tests
  phase "tests with sanitizers"
  # Memory that cannot be had is a failed allocation, as without the sanitizers.
  export ASAN_OPTIONS=allocator_may_return_null=1:detect_stack_use_after_return=1:strict_string_checks=1
  export LSAN_OPTIONS=suppressions=$PWD/tests/lint/leaks.txt:print_suppressions=0
  export UBSAN_OPTIONS=print_stacktrace=1
  ctest --test-dir build-sanitize --output-on-failure -j "$(n_cores)" --label-regex '^sanitize$' "$@"
}

# sanitize(), unless CI, which has 90 minutes, would be over before its end, as on a slow machine. The build takes as long as the first one did.
sanitize_in_time() {
  local build=$((phase_starts[2] - phase_starts[1]))
  if [ $((SECONDS + 5 * build / 4 + 420)) -gt 5200 ]; then
    say "The build and the tests with sanitizers are LEFT OUT: ${SECONDS} s are over, and the first build took $build s; ./test.sh --sanitize"
    return
  fi
  sanitize
}

# What clang-tidy's verdict depends on, as a name for a file: our sources, its settings, and the versions of compiler and libraries.
tidy_key() {
  {
    find lib applications cmake tests/lint CMakeLists.txt test.sh .clang-tidy -name '*.cc' -o -name '*.h' -o -name '*.cmake' -o -name 'CMakeLists.txt' -o -name '*.sh' -o -name .clang-tidy |
      sort | xargs sha256sum
    clang-tidy --version
    dpkg-query -W libdeal.ii-dev libeigen3-dev libboost-dev 2>/dev/null
  } | sha256sum | cut -d ' ' -f 1
}

# clang-format, and clang-tidy, which reads two halves of the library (tests/lint/clang_tidy.cmake), kernels and programs; not when it has
# found nothing in the same sources before. Other releases write and find other things.
tidy() {
  local mesoslip_packages=("${mesoslip_packages[@]}" clang clang-tidy clang-format) found_nothing
  install_packages
  case $(clang-format --version) in
    *' 14.'*) ;;
    *) say "clang-format and clang-tidy are left out: the sources are checked with release 14, which Debian 12 has"; return ;;
  esac
  phase "clang-format and clang-tidy"
  find lib applications tests doc -name '*.cc' -o -name '*.h' | xargs clang-format --dry-run -Werror ||
    fail "clang-format would write the above differently: clang-format -i"
  local cmake_options=(-DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++)
  configure build-lint
  cmake build-lint >build-lint/configure.log # files may have come and gone
  found_nothing=$HOME/.cache/mesoslip/tidy/$(tidy_key)
  if [ -f "$found_nothing" ]; then
    say "clang-tidy found nothing in these sources before"
    return
  fi
  say "clang-tidy reads library and programs (some minutes)"
  run-clang-tidy -p build-lint -quiet -extra-arg=-Wno-ignored-optimization-argument "/tidy_(lower|upper).dir/|^$PWD/lib/|^$PWD/build-lint/(lib/[a-z]|applications/)" \
    >build-lint/clang-tidy.log 2>&1 || {
    grep -E -A 3 '(error|warning):' build-lint/clang-tidy.log || tail -n 5 build-lint/clang-tidy.log
    fail "clang-tidy finds the above"
  }
  say "clang-tidy finds nothing"
  mkdir -p "${found_nothing%/*}" && touch "$found_nothing"
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
  --quick) release --label-exclude 'long|slow|verification' "${@:2}" ;;
  --label) release --label-regex "${2:?--label needs a name}" "${@:3}" ;;
  "") trap report_times EXIT && release --label-exclude long && tidy && sanitize_in_time ;;
  *) release --label-exclude long "$@" ;;
esac
