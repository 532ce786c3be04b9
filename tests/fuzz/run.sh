#!/usr/bin/env bash
# One fuzzer for some seconds: run.sh <fuzz_target> <seconds> [more of libFuzzer's options]
# Starts from corpus/<target>; new inputs stay in a folder beside the program, findings in its folder findings/.
set -euo pipefail
program=$1 seconds=$2
shift 2
target=${program##*/fuzz_}
here=$(dirname "$(readlink -f "$0")")
inputs=$(dirname "$program")/fuzz-inputs/$target findings=$(dirname "$program")/findings
mkdir -p "$inputs" "$findings"
# Memory that an input asks for beyond reason is not given (our own requests would end in std::bad_alloc, a finding); MPI
# keeps some to the end.
export ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=1024:detect_leaks=0
# Half of the time went into stacks of allocations and the frequency of each branch. Findings have stacks when run by themselves.
ASAN_OPTIONS+=:malloc_context_size=0:max_malloc_fill_size=0:quarantine_size_mb=4
exec nice "$program" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=2048 -max_len=4096 \
  -entropic=0 -detect_leaks=0 -verbosity=0 -print_final_stats=1 -artifact_prefix="$findings/$target-" "$@" "$inputs" \
  "$here/corpus/$target"
