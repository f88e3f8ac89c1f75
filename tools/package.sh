#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# tools/package.sh          writes the Debian packages latsch, latsch-mpi and python3-latsch into build/packages
# tools/package.sh --try    and installs them in a bare Debian 12 below build/packages (mmdebstrap, root), where new,
#                           check, run, serve, export, the manual and the Python package have to work
set -eu
cd "$(dirname "$0")/.."
tools/install_packages.sh build page python mpi
packages=build/packages
log=build/package_build.log
mkdir -p "$packages"
if ! { cmake --preset release && cmake --build --preset release --target latsch_packaged &&
       rm -f "$packages"/*.deb && cpack --config build/release/CPackConfig.cmake -B "$packages"; } >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  exit 1
fi
rm -rf "$packages/_CPack_Packages"
ls "$packages"/*.deb
[ "${1:-}" = --try ] || exit 0

tools/install_packages.sh bare
root=$packages/bare_debian
trap 'rm -rf "$root"' EXIT
rm -rf "$root"
mmdebstrap --quiet --variant=minbase --include=man-db,bash-completion bookworm "$root" http://deb.debian.org/debian
cp /etc/resolv.conf "$root/etc/resolv.conf"
mkdir -p "$root/packages"
cp -r "$packages"/*.deb tools/try_packages.sh studies/compliance "$root/packages"
cp studies/ring_tires/passenger_205_55R16.toml "$root/packages/tire.toml"
# /proc is mounted for these processes alone and disappears with the last of them.
unshare --mount --pid --fork --mount-proc="$root/proc" chroot "$root" sh /packages/try_packages.sh
