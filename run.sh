#!/usr/bin/env bash
# Runs a chain of .prm files: ./run.sh [options] [folder]      (./run.sh --help)
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")"
. cmake/setup.sh

for argument in "$@"; do
  case $argument in
    -h | --help) exec "$python" applications/run_chain.py --help ;;
  esac
done
caller=${OLDPWD:-$PWD}
install_packages
cmake_options=()
build build rve_homogenization contact_dynamics stress_localization
exec "$python" applications/run_chain.py --programs build/applications --from "$caller" "$@"
