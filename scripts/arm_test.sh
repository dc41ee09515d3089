#!/usr/bin/env bash
# Builds the engine (the modules that need CGAL and oneTBB alone) for 64-bit ARM with Debian's cross compiler and runs its
# tests in QEMU: the same bytes on another processor (tests/hashes/engine_bytes_test.cpp), and whatever else it promises.
#   scripts/arm_test.sh [--jobs N]
# Needs the network (Debian's archive; SCANTET_MIRROR names another), root for what is missing of the packages `arm` of
# scripts/install_deps.sh, and 1.5 GB of disk for build/arm64. Debian 12 has no ITK for ARM, and so no program of ours.
# shellcheck source-path=SCRIPTDIR
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

jobs=$(nproc)
if (($# == 2)) && [[ $1 == --jobs && $2 =~ ^[1-9][0-9]*$ ]]; then
  jobs=$2
elif (($# > 0)); then
  say "arm_test.sh takes --jobs N, N from 1 on, and nothing else"
  exit 2
fi
mirror=${SCANTET_MIRROR:-http://deb.debian.org/debian}
root=$PWD/build/arm64/root

scripts/install_deps.sh build arm
if [[ ! -e $root.complete ]]; then
  say "headers and libraries for ARM, from $mirror (build/arm64/root)"
  rm -rf "$root"
  mkdir -p "$root"
  # Unpacked, not installed: nothing of it is run here.
  mmdebstrap --quiet --variant=extract --architectures=arm64 --include=libcgal-dev,libtbb-dev,libgtest-dev bookworm "$root" "$mirror"
  touch "$root.complete"
fi

say "building the engine for ARM (build/arm64)"
cmake --preset arm64 >build/arm64/configure.log 2>&1 || { tail -n 40 build/arm64/configure.log >&2; exit 1; }
cmake --build --preset arm64 --parallel "$jobs" -- --quiet

say "its tests, in QEMU"
ctest --preset arm64 -j "$jobs" -E '^ChildProcess\.MemoryIsLimited$' # QEMU leaves limits of memory to the host
