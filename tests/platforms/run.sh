#!/usr/bin/env bash
# Builds and tests the last commit on another release of Debian, in a folder that debootstrap makes:
#   tests/platforms/run.sh bookworm|trixie|sid|experimental [--syntax] [options of ctest]
# Needs root, debootstrap, a network, 8 GB of disk and half an hour to two. --syntax only lets the compiler read library and programs.
# The folder, of which another call uses what is there, is <release> in $MESOSLIP_PLATFORMS (/var/tmp/mesoslip-platforms). A row of
# doc/platforms.md says what passed.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."
. cmake/setup.sh # fail, and the Python that has numpy

case ${1:-} in
  bookworm | trixie | sid) release=$1 suite=$1 ;;
  experimental) release=$1 suite=sid ;;
  *) sed -n '2,/^set/s/^# //p' "$0"; exit 2 ;;
esac
[ "$(id -u)" -eq 0 ] || fail "root is needed: debootstrap and chroot are"
command -v debootstrap >/dev/null || fail "debootstrap is missing (apt install debootstrap)"
# What is mounted below is gone when this ends.
[ -n "${MESOSLIP_UNSHARED:-}" ] || MESOSLIP_UNSHARED=1 exec unshare --mount --propagation private "$0" "$@"
shift
syntax=
[ "${1:-}" != --syntax ] || { syntax=1; shift; }

root=${MESOSLIP_PLATFORMS:-/var/tmp/mesoslip-platforms}/$release
mkdir -p "$root"
[ -f "$root/etc/debian_version" ] || debootstrap --variant=minbase "$suite" "$root" https://deb.debian.org/debian ||
  debootstrap --variant=minbase "$suite" "$root" http://deb.debian.org/debian
# Packages are signed; certificates of a proxy, which this machine may have, are not in the folder. A mirror may be a snapshot of some weeks ago.
echo "deb http://deb.debian.org/debian $suite main" >"$root/etc/apt/sources.list"
echo 'Acquire::Check-Valid-Until "false";' >"$root/etc/apt/apt.conf.d/90snapshot"
for folder in proc sys dev; do mount --rbind "/$folder" "$root/$folder"; done
inside() { chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/local/bin:/usr/bin:/usr/sbin:/bin LC_ALL=C.UTF-8 TMPDIR=/tmp DEBIAN_FRONTEND=noninteractive bash -c "cd /root/mesoslip && $1"; }

rm -rf "$root/root/mesoslip.new" && mkdir -p "$root/root/mesoslip"
commit=$(git rev-parse --short HEAD)
git clone -q --depth 1 "file://$PWD" "$root/root/mesoslip.new"
# Sources keep their times where they are the same, so that only what changed is compiled.
inside "command -v rsync >/dev/null || { apt-get update -qq && apt-get install -y -qq --no-install-recommends rsync git ca-certificates; }
        rsync -rlpc --delete --exclude /build --exclude /build-syntax ../mesoslip.new/ ./"
if [ "$release" = experimental ]; then
  echo "deb http://deb.debian.org/debian experimental main" >"$root/etc/apt/sources.list.d/experimental.list"
  # Only these come from experimental: what else is there may be built for other libraries.
  printf '%s\n' 'Package: libdeal.ii* libtrilinos* trilinos*' 'Pin: release a=experimental' 'Pin-Priority: 900' >"$root/etc/apt/preferences.d/experimental"
  inside "apt-get update -qq && apt-get install -y -qq --no-install-recommends libdeal.ii-dev" || fail "deal.II of experimental does not install"
fi

if [ -n "$syntax" ]; then
  inside 'rm -rf build-syntax; . cmake/setup.sh; mesoslip_packages=("${program_packages[@]}"); install_packages
          cmake_options=(-DMESOSLIP_BUILD_TESTS=OFF -DMESOSLIP_WERROR=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON); configure build-syntax
          ninja -C build-syntax -k 0 -t commands all | grep -e " -c .*\.cc$" | xargs -d "\n" -P "$(n_cores)" -I COMMAND bash -c "cd build-syntax && COMMAND -fsyntax-only" 2>&1 | tee build-syntax/syntax.log
          ! grep -q "error:" build-syntax/syntax.log'
  passed="compiles"
else
  inside "CI= ./test.sh --label '^(unit|system|regression|verification)$' $* 2>&1 | tee test.log; exit \${PIPESTATUS[0]}" || echo "not all of it passes"
  passed=$(sed -n 's/^\([0-9]*\)% tests passed, \([0-9]*\) tests failed out of \([0-9]*\)/\2 \3/p' "$root/root/mesoslip/test.log" | awk '{ print $2 - $1 " of " $2 " tests" }')
fi
# The programs built here, if there are any, give the results to compare with.
if [ -z "$syntax" ] && [ -x build/applications/stress_localization ]; then
  rm -rf "$root/root/examples"
  "$python" -B tests/platforms/examples.py build/applications "$root/root/examples/other" &&
    inside "python3 -B tests/platforms/examples.py build/applications ../examples/here --against ../examples/other" &&
    passed="${passed:+$passed, }$(ls "$root/root/examples/here" | wc -l) examples" || echo "the examples differ"
fi
of() { inside "dpkg-query -W -f='\${Version}' $1 2>/dev/null | sed 's/^[0-9]*://; s/[-+~].*//'" || echo none; }
hdf5=$(inside "dpkg-query -W -f='\${Version}' 'libhdf5-openmpi-dev' | sed 's/[-+~].*//'")
row="| $release | $(of libdeal.ii-dev) | $(of g++) | $hdf5 | $(of libboost-dev) | $(of libeigen3-dev) | $(of libgmsh-dev) | $(of libopenmpi-dev) | ${passed:-nothing was built} | $commit, $(date +%F) |"
page=doc/platforms.md
# In the place of the release's row, or behind the last row.
awk -v row="$row" -v first="| $release |" '
  index($0, first) == 1 { if (!done) print row; done = 1; next }
  in_table && !/^\|/ { if (!done) print row; done = 1 }
  { in_table = /^\|/; print }' "$page" >"$page.new" && mv "$page.new" "$page"
printf '%s\n' "$row"
