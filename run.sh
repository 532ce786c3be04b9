#!/usr/bin/env bash
# Runs a chain of .prm files, or one of them: ./run.sh [options] [folder | file.prm]      (./run.sh --help)
# or a study: ./run.sh paper | prediction | thickness | maps | stability | verification | benchmarks | gallery [options]      (./run.sh paper --help)
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")"
. cmake/setup.sh

# Studies are scripts of their own.
script=applications/tools/run_chain.py
for study in "applications/tools/studies/${1:-none}/run.py" "tests/${1:-none}/run.py"; do
  if [ -f "$study" ]; then
    script=$study
    shift
    break
  fi
done

for argument in "$@"; do
  case $argument in
    -h | --help) exec "$python" "$script" --help ;;
  esac
done
caller=${OLDPWD:-$PWD}
install_packages
cmake_options=()
programs=(rve_homogenization contact_dynamics stress_localization)
[ "$script" != applications/tools/studies/benchmarks/run.py ] || programs+=(brick_benchmark mesh_benchmark model_problems scaling_benchmark step_benchmark voxel_benchmark)
say_how_long build "${programs[@]}"
build build "${programs[@]}"
[ "$script" != applications/tools/run_chain.py ] || set -- --from "$caller" "$@"
exec "$python" "$script" --programs build/applications "$@"
