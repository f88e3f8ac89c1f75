#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# tools/package.sh          writes the Debian packages latsch, latsch-mpi and python3-latsch into build/packages, and
#                           latsch-units-windows if the compiler for Windows is installed (tools/install_packages.sh windows)
# tools/package.sh --try    and installs them in a bare Debian 12 below build/packages (mmdebstrap, root), where new,
#                           check, run, serve, export, the manual and the Python package have to work; prints what each package
#                           weighs that is downloaded; lintian, where it is installed, must find no error
set -eu
cd "$(dirname "$0")/.."
tools/install_packages.sh build page python mpi
packages=build/packages
log=build/package_build.log
mkdir -p "$packages"
windows=
if command -v x86_64-w64-mingw32-g++-posix >/dev/null; then
  windows=$PWD/build/units-windows
  if ! { cmake --preset units-windows && cmake --build --preset units-windows; } >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    exit 1
  fi
else
  echo "no package latsch-units-windows: tools/install_packages.sh windows installs its compiler"
fi
if ! { cmake --preset release -DLATSCH_WINDOWS_UNITS="$windows" && cmake --build --preset release --target latsch_packaged &&
       rm -f "$packages"/*.deb && cpack --config build/release/CPackConfig.cmake -B "$packages"; } >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  exit 1
fi
rm -rf "$packages/_CPack_Packages"
tools/repack.sh "$packages"/*.deb
if command -v lintian >/dev/null; then
  lintian --fail-on error "$packages"/*.deb
fi
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
