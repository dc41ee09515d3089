#!/usr/bin/env bash
# Builds the Containerfile with buildah, and meshes a sample in the container.
#   scripts/container_test.sh [--debs DIR]     --debs: with the packages of this folder, without the Containerfile's first half
# The base image is made by debootstrap, so that no registry is needed; chroot isolation and the storage driver vfs need neither
# namespaces nor overlays. Needs root, buildah, debootstrap, Debian's archive, about 12 GB in $TMPDIR. Without --debs the whole
# of scantet is built in there. SCANTET_MIRROR: another archive than http://deb.debian.org/debian.
# shellcheck source-path=SCRIPTDIR
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

debs=
if ! command -v buildah >/dev/null; then say "container_test.sh: apt-get install --no-install-recommends buildah"; exit 2; fi
if [[ ${1:-} == --debs ]]; then debs=$(realpath "$2"); fi
mirror=${SCANTET_MIRROR:-http://deb.debian.org/debian}
folder=$(mktemp -d "${TMPDIR:-/tmp}/scantet-container.XXXXXX")
export BUILDAH_ISOLATION=chroot
in_store() { local command=$1; shift; buildah --root "$folder/store" --runroot "$folder/run" --storage-driver vfs "$command" "$@"; }
cleanup() {
  in_store rm --all >/dev/null 2>&1 || true
  rm -rf --one-file-system "$folder"
}
trap cleanup EXIT

say "the base image"
debootstrap --variant=minbase bookworm "$folder/base" "$mirror" >"$folder/log" 2>&1 || { tail -n 20 "$folder/log" >&2; exit 1; }
base=$(in_store from scratch)
in_store add --quiet "$base" "$folder/base" / >/dev/null
in_store commit --quiet "$base" docker.io/library/debian:bookworm-slim >/dev/null
in_store rm "$base" >/dev/null
rm -rf "$folder/base"

say "the Containerfile"
mkdir "$folder/context"
if [[ -n $debs ]]; then
  mkdir "$folder/context/debs"
  cp "$debs"/*.deb "$folder/context/debs"
  { printf 'FROM scratch AS build\nCOPY debs /debs\n'; sed -n '/^FROM debian:bookworm-slim$/,$p' Containerfile; } >"$folder/context/Containerfile"
else
  git archive HEAD | tar -x -C "$folder/context"
fi
in_store bud --pull-never --quiet --tag scantet "$folder/context" >"$folder/log" 2>&1 || { tail -n 20 "$folder/log" >&2; exit 1; }

say "meshing in the container"
container=$(in_store from --pull-never scantet)
in_store copy --quiet "$container" sample_volumes/sphere.nrrd /data/ >/dev/null
in_store run "$container" scantet mesh sphere.nrrd --level 127.5 --size 3 --quiet -o sphere.vtu
in_store run "$container" scantet verify sphere.vtu --against sphere.nrrd --level 127.5 --require bounded | sed -n 1p
