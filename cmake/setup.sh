# Shared by run.sh, test.sh and cmake/install.sh: installs what is missing, configures, builds.
# Sourced with the repository as current folder.

# Debian packages of the programs and their scripts, and those that only the tests need.
program_packages=(
  build-essential ccache cmake ninja-build libdeal.ii-dev libboost-program-options-dev libeigen3-dev nlohmann-json3-dev libpng-dev libtiff-dev libxxhash-dev libgmsh-dev mold
  python3 python3-numpy python3-scipy python3-h5py python3-matplotlib)
test_packages=(
  libgtest-dev python3-pil python3-pip python3-gmsh python3-meshio python3-xarray calculix-ccx doxygen python3-sphinx python3-myst-parser furo cppcheck g++-aarch64-linux-gnu qemu-user)
mesoslip_packages=("${program_packages[@]}" "${test_packages[@]}")

# choose_python: sets python to the first of $MESOSLIP_PYTHON, python3 and /usr/bin/python3 that has numpy, scipy, h5py and matplotlib.
# Debian's has them where a python3 that comes first in PATH may not.
choose_python() {
  local candidate
  for candidate in "${MESOSLIP_PYTHON:-}" python3 /usr/bin/python3; do
    "${candidate:-false}" -c 'import sys, importlib.util as u; sys.exit(not all(map(u.find_spec, ("numpy", "scipy", "h5py", "matplotlib"))))' 2>/dev/null &&
      python=$candidate && return
  done
  python=python3
}
choose_python

say() { printf '%s\n' "$*"; }
fail() { printf '%s: %s\n' "${0##*/}" "$*" >&2; exit 2; }

missing_packages() {
  local package
  for package in "${mesoslip_packages[@]}"; do
    case $(dpkg-query -W -f='${Status}' "$package" 2>/dev/null) in
      *"ok installed") ;;
      *) printf '%s ' "$package" ;;
    esac
  done
}

install_packages() {
  command -v dpkg-query >/dev/null || {
    say "Neither Debian nor Ubuntu: expecting deal.II 9.4 or newer with MPI, Trilinos, HDF5, ARPACK, METIS, muParser and UMFPACK; CHOLMOD, Gmsh, Eigen, Boost, nlohmann-json, libpng, libtiff and xxHash; CMake 3.25 and Ninja; numpy, scipy, h5py and matplotlib for python3 or \$MESOSLIP_PYTHON; for the tests GoogleTest. cmake says what it does not find"
    return
  }
  local missing as_root=()
  missing=$(missing_packages)
  [ -n "$missing" ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "these Debian packages are missing and there is neither root nor sudo to install them: $missing"
    as_root=(sudo)
  fi
  say "Installing $missing"
  # shellcheck disable=SC2086
  { ${as_root[@]+"${as_root[@]}"} apt-get update -qq &&
    ${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing
  } >"${TMPDIR:-/tmp}/mesoslip-apt.$$.log" 2>&1 || {
    tail -n 5 "${TMPDIR:-/tmp}/mesoslip-apt.$$.log" >&2
    fail "apt could not install: $missing"
  }
  rm -f "${TMPDIR:-/tmp}/mesoslip-apt.$$.log"
  choose_python
}

# How many cores there are.
n_cores() { nproc 2>/dev/null || sysctl -n hw.ncpu 2>/dev/null || echo 1; }

# configured_for <folder>: the sources that a build folder is of; those of another place are built in vain.
configured_for() { [ ! -f "$1/CMakeCache.txt" ] || sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$1/CMakeCache.txt"; }

# require_own_build <folder>: says what to remove when the folder was moved or copied here with its sources.
require_own_build() {
  local sources
  sources=$(configured_for "$1")
  [ -z "$sources" ] || [ "$sources" -ef . ] ||
    fail "$PWD/$1 was made for the sources in $sources, as this folder was moved or copied: remove it (rm -rf '$PWD/$1') and start again"
}

# configure <folder>: once, with cmake_options; prints only what goes wrong. Files of a topic are compiled together, as
# deal.II's headers take longer than ours: a first build takes half the time.
configure() {
  local folder=$1 log="$1/configure.log"
  require_own_build "$folder"
  [ ! -f "$folder/build.ninja" ] || return 0
  mkdir -p "$folder"
  say "Configuring in $folder"
  cmake -S . -B "$folder" -G Ninja -DMESOSLIP_UNITY=ON ${cmake_options[@]+"${cmake_options[@]}"} >"$log" 2>&1 || { tail -n 30 "$log" >&2; fail "cmake failed, see $log"; }
}

# say_how_long <folder> <program>... : what the first build of the programs takes, before it begins.
say_how_long() {
  is_built "$@" && return 0
  local cores
  cores=$(n_cores)
  say "The programs are built first: about 16 minutes of one core, so some $(((16 + cores - 1) / cores)) minutes on the $cores of this machine if they are idle"
}

# is_built <folder> <target>... : whether programs of these names are there, up to date or not.
is_built() {
  local target
  for target in "${@:2}"; do
    [ -n "$(find "$1" -name "$target" -type f -perm -u+x -print -quit 2>/dev/null)" ] || return 1
  done
}

# with_progress <log>: what ninja prints goes to the log; that it builds something, and each tenth of its steps that is done, is a line.
with_progress() {
  local line tenth last=-1
  while IFS= read -r line; do
    printf '%s\n' "$line" >&3
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\] && $line != *\]\ Re-* ]] || continue # CMake looks for files that are new
    [ "$last" -ge 0 ] || { last=0; say "Building (the first time takes some minutes)"; }
    tenth=$((10 * BASH_REMATCH[1] / BASH_REMATCH[2]))
    [ "$tenth" -gt "$last" ] || continue
    last=$tenth
    say "  ${tenth}0 %: ${BASH_REMATCH[1]} of ${BASH_REMATCH[2]} steps"
  done 3>"$1"
}

# build <folder> <target>... : configures once, then builds; prints how far it is and what goes wrong. In a checkout that may not be written the
# programs that are there are used.
build() {
  local folder=$1 log="$1/build.log"
  shift
  require_own_build "$folder"
  if [ -d "$folder" ] && [ ! -w "$folder" ]; then
    is_built "$folder" "$@" || fail "$PWD/$folder cannot be written to, and it does not hold what has to be built: $*"
    say "$PWD/$folder cannot be written to: the programs in it are used as they are"
    return 0
  fi
  [ -w . ] || [ -d "$folder" ] || fail "$PWD cannot be written to, and nothing is built in it: make a copy that is yours"
  configure "$folder"
  if [ -t 1 ]; then
    cmake --build "$folder" --target "$@" || fail "the build failed"
  else
    (set -o pipefail; NINJA_STATUS='[%f/%t] ' cmake --build "$folder" --target "$@" 2>&1 | with_progress "$log") || { grep -E 'error|FAILED' "$log" >&2 || tail -n 30 "$log" >&2; fail "the build failed, see $log"; }
  fi
}
