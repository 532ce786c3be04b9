# Shared by run.sh and test.sh: installs what is missing, configures, builds.
# Sourced with the repository as current folder.

# Debian packages; the programs need all but the last line, the tests also that.
mesoslip_packages=(
  build-essential cmake ninja-build libdeal.ii-dev libboost-program-options-dev libeigen3-dev nlohmann-json3-dev libpng-dev libtiff-dev libxxhash-dev libgmsh-dev
  python3 python3-numpy python3-scipy python3-h5py python3-matplotlib
  libgtest-dev python3-pil python3-pip doxygen cppcheck g++-aarch64-linux-gnu qemu-user)

# Debian's python has numpy, h5py and matplotlib; another one in PATH may not.
python=/usr/bin/python3
[ -x "$python" ] || python=python3

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
    say "Not a Debian system: expecting deal.II 9.4, Gmsh, Eigen, nlohmann-json, libpng, libtiff, xxhash, GoogleTest to be there."
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
  { "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing
  } >"${TMPDIR:-/tmp}/mesoslip-apt.$$.log" 2>&1 || {
    tail -n 5 "${TMPDIR:-/tmp}/mesoslip-apt.$$.log" >&2
    fail "apt could not install: $missing"
  }
  rm -f "${TMPDIR:-/tmp}/mesoslip-apt.$$.log"
}

# configure <folder>: once, with cmake_options; prints only what goes wrong. Files of a topic are compiled together, as
# deal.II's headers take longer than ours: a first build takes half the time.
configure() {
  local folder=$1 log="$1/configure.log"
  [ ! -f "$folder/build.ninja" ] || return 0
  mkdir -p "$folder"
  say "Configuring in $folder"
  cmake -S . -B "$folder" -G Ninja -DCMAKE_UNITY_BUILD=ON "${cmake_options[@]}" >"$log" 2>&1 || { tail -n 30 "$log" >&2; fail "cmake failed, see $log"; }
}

# build <folder> <target>... : configures once, then builds; prints only what goes wrong.
build() {
  local folder=$1 log="$1/build.log"
  shift
  configure "$folder"
  say "Building (the first time takes some minutes)"
  if [ -t 1 ]; then
    cmake --build "$folder" --target "$@" || fail "the build failed"
  else
    cmake --build "$folder" --target "$@" >"$log" 2>&1 || { grep -E 'error|FAILED' "$log" >&2 || tail -n 30 "$log" >&2; fail "the build failed, see $log"; }
  fi
}
