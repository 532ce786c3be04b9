#!/usr/bin/env bash
# Builds and installs programs, libraries, scripts and the Python module without the tests: cmake/install.sh [prefix]
# The prefix is /usr/local unless it is given. Debian packages that are missing are installed, as by run.sh.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
. cmake/setup.sh

case ${1:-} in
  -h | --help) sed -n '2,/^set/s/^# //p' "$0"; exit ;;
esac
prefix=${1:-/usr/local}
mesoslip_packages=("${program_packages[@]}")
install_packages
cmake_options=(-DMESOSLIP_BUILD_TESTS=OFF)
build build-install all
cmake --install build-install --prefix "$prefix" >build-install/install.log || fail "nothing could be installed in $prefix, see build-install/install.log"
tools=$prefix/share/mesoslip/applications/tools
say "Installed in $prefix: programs in $prefix/bin, run_chain.py in $tools, the Python module in $tools/python"
