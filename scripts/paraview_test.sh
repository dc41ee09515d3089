#!/usr/bin/env bash
# Tries the plugin of ParaView in a bare Debian 12 made by debootstrap in a temporary folder, with Debian's ParaView, which a
# machine that builds scantet cannot have (it takes libvtk9-dev away): in pvpython, without a display.
#   scripts/paraview_test.sh [--keep]     --keep: leave the folder with the Debian
# Takes build/release as it is. Needs root (chroot), the network (Debian's archive), about 3 GB of disk in $TMPDIR.
# SCANTET_MIRROR: another archive than http://deb.debian.org/debian. SCANTET_PARAVIEW_ROOT: a folder that --keep left.
# shellcheck source-path=SCRIPTDIR
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

keep=0
if [[ ${1:-} == --keep ]]; then keep=1; fi
mirror=${SCANTET_MIRROR:-http://deb.debian.org/debian}
if ((EUID != 0)); then say "paraview_test.sh: only root can chroot"; exit 2; fi

if [[ -n ${SCANTET_PARAVIEW_ROOT:-} ]]; then
  root=$SCANTET_PARAVIEW_ROOT keep=1
else
  root=$(mktemp -d "${TMPDIR:-/tmp}/scantet-paraview.XXXXXX")
fi
cleanup() {
  umount "$root/proc" 2>/dev/null || true
  if ((keep == 1)); then say "left in $root"; else rm -rf --one-file-system "$root"; fi
}
trap cleanup EXIT
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
apt_inside() { inside apt-get -qq -o Dpkg::Use-Pty=0 -o APT::Sandbox::User=root --no-install-recommends "$@" >>"$root/apt.log" 2>&1 || { tail -n 20 "$root/apt.log" >&2; exit 1; }; }

started=$SECONDS
if [[ ! -x $root/usr/bin/apt-get ]]; then
  say "a bare Debian 12 in $root"
  debootstrap --variant=minbase bookworm "$root" "$mirror" >"$root.log" 2>&1 || { tail -n 20 "$root.log" >&2; exit 1; }
  rm -f "$root.log"
fi
mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
say "ParaView, and the packages that the installed program links"
rm -rf "$root/opt/scantet" "$root/usr/lib/x86_64-linux-gnu/scantet"
for component in scantet libscantet; do
  DESTDIR=$root cmake --install build/release --prefix /opt/scantet --component "$component" >/dev/null
done
mapfile -t packages < <(LD_LIBRARY_PATH=$root/opt/scantet/lib ldd "$root/opt/scantet/bin/scantet" | awk '$2 == "=>" && $3 ~ "^/(usr/)?lib" {print $3}' |
  xargs readlink -f | xargs dpkg-query --search | cut -d: -f1 | sort -u)
apt_inside update
apt_inside install --yes paraview python3-paraview "${packages[@]}"
say "$((SECONDS - started)) s, $(du -sm --one-file-system "$root" | cut -f1) MB"

# Where docs/vtk.md has it, as the Debian package does.
ln -s /opt/scantet/lib/scantet "$root/usr/lib/x86_64-linux-gnu/scantet"
rm -rf "$root/work"
mkdir -p "$root/work/docs" "$root/work/tests"
cp bindings/paraview/tests/plugin_test.py README.md "$root/work"
cp docs/vtk.md "$root/work/docs"
cp -r tests/docs "$root/work/tests"
started=$SECONDS
inside timeout 600 pvpython /work/plugin_test.py /opt/scantet/bin/scantet \
  /usr/lib/x86_64-linux-gnu/scantet/paraview/ScantetParaView.py /work
say "the plugin works in $(inside pvpython --version 2>/dev/null), $((SECONDS - started)) s"
