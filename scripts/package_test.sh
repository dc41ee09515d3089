#!/usr/bin/env bash
# Makes the Debian packages, looks at them with lintian, and tries them out in a bare Debian 12 made by debootstrap in a
# temporary folder: installed by apt with what they depend on, used, removed, and nothing left.
#   scripts/package_test.sh [--keep]     --keep: leave the folder with the Debian
# Needs root (chroot), the network (Debian's archive), about 3 GB of disk in $TMPDIR.
# SCANTET_MIRROR: another archive than http://deb.debian.org/debian.
# shellcheck source-path=SCRIPTDIR
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

keep=0
if [[ ${1:-} == --keep ]]; then keep=1; fi
mirror=${SCANTET_MIRROR:-http://deb.debian.org/debian}
debs=$PWD/build/packages/deb
if ((EUID != 0)); then say "package_test.sh: only root can chroot"; exit 2; fi

say "building the packages (build/packages)"
cmake --preset packages >/dev/null
cmake --build --preset packages --parallel "$(nproc)" -- --quiet
rm -rf "$debs"
cpack --config build/packages/CPackConfig.cmake -B "$debs" >build/packages/cpack.log || { tail -n 20 build/packages/cpack.log >&2; exit 1; }

say "lintian"
# There is no address of ours, no bug of Debian's to close, and CPack itself writes the call of ldconfig.
lintian --allow-root --fail-on error,warning --suppress-tags \
  bogus-mail-host,bogus-mail-host-in-debian-changelog,initial-upload-closes-no-bugs,maintscript-calls-ldconfig "$debs"/*.deb

root=$(mktemp -d "${TMPDIR:-/tmp}/scantet-debian.XXXXXX")
cleanup() {
  umount "$root/proc" 2>/dev/null || true
  if ((keep == 1)); then say "left in $root"; else rm -rf --one-file-system "$root"; fi
}
trap cleanup EXIT
say "a bare Debian 12 in $root"
started=$SECONDS
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$root.log" 2>&1 || { tail -n 20 "$root.log" >&2; exit 1; }
rm -f "$root.log"
mount -t proc proc "$root/proc" 2>/dev/null || say "no /proc in there"
say "$((SECONDS - started)) s, $(du -sm --one-file-system "$root" | cut -f1) MB"
mkdir -p "$root/debs" "$root/work"
for name in $(sed -n 's/^| `\([a-z0-9-]*\)` | .*/\1/p' docs/release.md); do
  compgen -G "$debs/${name}_*.deb" >/dev/null || { say "missing: the package $name"; exit 1; }
done
cp "$debs"/*.deb "$root/debs"
cp sample_volumes/sphere.nrrd sample_volumes/labels_octants.nrrd tests/install/slicer_test.py "$root/work"
cp -r bindings/vtk/example "$root/work"

inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
apt_inside() { inside apt-get -qq -o Dpkg::Use-Pty=0 -o APT::Sandbox::User=root --no-install-recommends "$@" >>"$root/apt.log" 2>&1 || { tail -n 20 "$root/apt.log" >&2; exit 1; }; }

say "installing"
started=$SECONDS
inside dpkg-query --show --showformat '${Package}\n' | sort >"$root/before"
apt_inside update
mapfile -t packages < <(cd "$root" && find debs -name '*.deb' -printf '/%p\n')
apt_inside install --yes "${packages[@]}"
say "$((SECONDS - started)) s, $(inside dpkg-query --show | wc -l) packages, $(du -sm --one-file-system "$root" | cut -f1) MB"

say "using"
inside scantet --version
[[ $(inside scantet plugins) == *OpenVDB* ]] || { say "the plugins are not found"; exit 1; }
inside scantet mesh /work/sphere.nrrd --level 127.5 --size 3 --quiet -o /work/a.vtu -o /work/a.msh --report /work/a.html
inside scantet diff /work/a.vtu /work/a.msh | sed -n 1p
inside scantet mesh implicit:torus --size 0.2 --quiet -o /work/torus.vtu
inside scantet convert /work/sphere.nrrd /work/a.vdb
inside scantet mesh /work/labels_octants.nrrd --size 4 --quiet -o /work/labels.vtk
inside scantet verify /work/a.vtu --against /work/sphere.nrrd --level 127.5 --require bounded --json /work/a.json | sed -n 1p
inside scantet-check /work/a.json | tail -n 1
inside "/usr/lib/$(inside dpkg --print-architecture | sed s/amd64/x86_64-linux-gnu/)/scantet/slicer/ScantetMesh" --level 127.5 --size 4 /work/sphere.nrrd /work/s.vtk | grep filter-time
for file in share/man/man1/scantet-mesh.1.gz share/bash-completion/completions/scantet share/zsh/vendor-completions/_scantet; do
  [[ -s $root/usr/$file ]] || { say "missing: /usr/$file"; exit 1; }
done
compgen -G "$root/usr/lib/*/scantet/paraview/ScantetParaView.py" >/dev/null || { say "missing: the plugin of ParaView"; exit 1; }
inside scantet cohort --help | sed -n 1p
inside python3 -c 'import scantet; print("Python:", len(scantet.mesh("/work/sphere.nrrd", level=127.5, size=4).tets), "tetrahedra")'
inside python3 - <<'PYTHON'
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkscantet.vtkScantet import vtkScantetMesher, vtkTetQualityHistogram
image, mesher, histogram = vtkRTAnalyticSource(), vtkScantetMesher(), vtkTetQualityHistogram()
mesher.SetInputConnection(image.GetOutputPort())
mesher.SetLevel(180)
mesher.SetSize(3)
histogram.SetInputConnection(mesher.GetOutputPort())
histogram.Update()
assert histogram.GetOutput().GetNumberOfRows() > 0
print("VTK:", mesher.GetOutput().GetNumberOfCells(), "tetrahedra")
PYTHON
apt_inside install --yes cmake g++ make
inside cmake -S /work/example -B /work/build >"$root/cmake.log" || { cat "$root/cmake.log" >&2; exit 1; }
inside cmake --build /work/build >>"$root/cmake.log" || { cat "$root/cmake.log" >&2; exit 1; }
inside env --chdir=/work build/mesh_with_vtk
inside scantet report /work/wavelet.vtu | sed -n 1p

say "removing"
apt_inside purge --yes 'scantet*' 'libscantet*' cmake g++ make
if inside dpkg-query --show python3-scantet >/dev/null 2>&1; then apt_inside purge --yes python3-scantet; fi
apt_inside autoremove --purge --yes
left=$(find "$root" -xdev -mindepth 1 -path "$root/proc" -prune -o -path "$root/debs" -prune -o -path "$root/work" -prune -o -iname '*scantet*' -print)
if [[ -n $left ]]; then say "left behind:"; printf '%s\n' "$left" >&2; exit 1; fi
inside dpkg-query --show --showformat '${Package}\n' | sort | comm -13 "$root/before" - >"$root/more"
if [[ -s $root/more ]]; then say "packages that stayed: $(tr '\n' ' ' <"$root/more")"; fi
say "installed, used and removed: $(find "$debs" -maxdepth 1 -name '*.deb' -printf '%f ')"
