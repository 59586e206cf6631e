#!/usr/bin/env bash
# Installs what mrpt-lamp needs on Debian 12. Does nothing, and needs no rights, if all is there.
#
#   scripts/install_dependencies.sh               to build, run and test
#   scripts/install_dependencies.sh --build-only  to build and run
#   scripts/install_dependencies.sh --bench       to build, run, test and run the benchmarks
#   scripts/install_dependencies.sh --fuzz        to build and run the fuzz targets
set -euo pipefail

# Of MRPT only the libraries in use: libmrpt-dev would pull in Qt, wxWidgets and ROS as well.
packages=(
  g++ cmake ninja-build
  libmrpt-maps-dev libmrpt-graphs-dev
  libceres-dev libmetis-dev libeigen3-dev liboctomap-dev libnanoflann-dev
  libtbb-dev libcli11-dev libembree-dev nlohmann-json3-dev zlib1g-dev libpng-dev liblzf-dev
  gnuplot-nox # pictures of lamp-eval
  mrpt-common # the recording that demo.sh runs
)
# PCL and OctoMap's tools read our files back in the tests.
test_packages=(libgtest-dev libgmock-dev libpcl-dev octomap-tools)
bench_packages=(libbenchmark-dev libsuitesparse-dev)
fuzz_packages=(clang libclang-rt-dev)

case "${1:-}" in
  "") packages+=("${test_packages[@]}") ;;
  --build-only) ;;
  --bench) packages+=("${test_packages[@]}" "${bench_packages[@]}") ;;
  --fuzz) packages+=("${fuzz_packages[@]}") ;;
  *)
    echo "usage: $0 [--build-only | --bench | --fuzz]" >&2
    exit 2
    ;;
esac

is_installed() {
  [[ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]
}

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "Missing packages: ${missing[*]}. Install them as root, or install sudo." >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get -qq update
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get -qq -y --no-install-recommends -o Dpkg::Use-Pty=0 install "${missing[@]}" >/dev/null
