# SPDX-License-Identifier: MPL-2.0
# Sourced by the other scripts: where things are, what must be installed, how ranks behave on a small machine.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

# The system's Python, whatever comes first on the PATH: it is the one that has numpy and matplotlib from apt.
python=/usr/bin/python3

build_packages="g++ cmake ninja-build pkg-config libeigen3-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev
  libopenmpi-dev openmpi-bin libhdf5-dev libgtest-dev libgmock-dev python3"
picture_packages="python3-numpy python3-matplotlib python3-meshio"
test_packages="clang libclang-rt-dev python3-scipy python3-h5py python3-pytest python3-hypothesis qemu-user"

say() { printf '%s\n' "$*"; }
fail() { printf '%s\n' "$*" >&2; exit 1; }

# Installs those of the given Debian packages that are missing.
need_packages() {
  command -v dpkg-query >/dev/null ||
    fail "This script installs what it needs with apt (Debian 12, Ubuntu 24.04). Elsewhere install the equivalents of: $*"
  local missing=() package
  for package in "$@"; do
    [ "$(dpkg-query -W -f '${db:Status-Abbrev}' "$package" 2>/dev/null)" = "ii " ] || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  say "Installing: ${missing[*]}"
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "Not root and no sudo. As root, run: apt-get install ${missing[*]}"
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq || say "apt-get update failed; trying with the package lists there are"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" \
    >/dev/null || fail "Could not install: ${missing[*]}"
}

# Builds one preset; quiet when nothing is to do.
build() {
  local preset=$1
  shift
  cmake --preset "$preset" >"build/$preset.configure.log" 2>&1 || {
    cat "build/$preset.configure.log" >&2
    fail "Configuring preset $preset failed"
  }
  cmake --build --preset "$preset" "$@" || fail "Building preset $preset failed"
}
mkdir -p build

# One thread a rank, ranks not tied to cores, more ranks than cores allowed and giving way while they wait.
export OMP_NUM_THREADS=1
export OMPI_MCA_hwloc_base_binding_policy=none
export OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_mpi_yield_when_idle=1
if [ "$(id -u)" -eq 0 ]; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
