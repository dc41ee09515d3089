#!/usr/bin/env bash
# Installs what is missing to build, test, demonstrate and time scantet on Debian 12.
#   scripts/install_deps.sh [build] [test] [demo] [benchmark] [profile] [fuzz] [arm] [check]     default: build test demo
# Installs nothing, and asks for no privilege, if all of it is there.
set -euo pipefail

build_packages=(
  g++ cmake ninja-build ccache pkg-config
  libcgal-dev libeigen3-dev libinsighttoolkit5-dev libvtk9-dev libtbb-dev libcli11-dev nlohmann-json3-dev libssl-dev
  libtiff-dev zlib1g-dev libhdf5-dev libopenvdb-dev libmuparser-dev
  libcairo2-dev libjs-three libjs-d3
  python3-dev pybind11-dev python3-numpy
)
test_packages=(
  libgtest-dev libbenchmark-dev python3 python3-meshio python3-h5py python3-scipy gmsh calculix-ccx clang-format doxygen
  chromium chromium-driver python3-selenium
  snakemake libmed-tools
  man-db mandoc zsh fish
  python3-pytest python3-nibabel python3-vtk9 mypy
  python3-dolfinx python3-slepc4py
)
demo_packages=(mricron-data)
benchmark_packages=(libbenchmark-dev python3 mricron-data libcgal-demo invesalius-examples)
profile_packages=(valgrind python3)
arm_packages=(mmdebstrap g++-aarch64-linux-gnu qemu-user)
fuzz_packages=(clang libclang-rt-14-dev gzip python3)
check_packages=("${fuzz_packages[@]}" "${benchmark_packages[@]}" "${arm_packages[@]}" clang-tidy gcovr doxygen shellcheck debootstrap buildah lintian dpkg-dev file libnifti2-dev libgdcm-dev
  python3-nbclient python3-ipykernel slurmctld slurmd slurm-client munge procps)

say() { printf '%s\n' "scantet: $*" >&2; }

if (($# == 0)); then set -- build test demo; fi
wanted=()
for group in "$@"; do
  case "$group" in
    build) wanted+=("${build_packages[@]}") ;;
    test) wanted+=("${test_packages[@]}") ;;
    demo) wanted+=("${demo_packages[@]}") ;;
    benchmark) wanted+=("${benchmark_packages[@]}") ;;
    profile) wanted+=("${profile_packages[@]}") ;;
    fuzz) wanted+=("${fuzz_packages[@]}") ;;
    arm) wanted+=("${arm_packages[@]}") ;;
    check) wanted+=("${check_packages[@]}") ;;
    *) say "install_deps.sh: no group of packages is called '$group'; use build, test, demo, benchmark, profile, fuzz, arm or check"; exit 2 ;;
  esac
done

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  say "this system has no apt-get, so nothing was installed; the build needs: ${wanted[*]} (Debian 12 names)"
  exit 0
fi

missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then exit 0; fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    say "these packages are missing: ${missing[*]}"
    say "install them as root: apt-get install --no-install-recommends ${missing[*]}"
    exit 1
  fi
  as_root=(sudo)
fi

log=$(mktemp "${TMPDIR:-/tmp}/scantet-apt.XXXXXX")
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@" </dev/null >>"$log" 2>&1
}
say "installing ${missing[*]}"
if ! { apt update; apt install --yes --no-install-recommends "${missing[@]}"; }; then
  tail -n 15 "$log" >&2
  say "apt-get could not install all of: ${missing[*]} (full log: $log)"
  exit 1
fi
rm -f "$log"
