#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# tools/bare_demo.sh [ROOT FOLDER]   runs the committed ./demo.sh in a bare Debian 12 (mmdebstrap, root) and prints what the
#                                    first command costs: packages, download, disk, and the time after the packages
set -eu
cd "$(dirname "$0")/.."
tools/install_packages.sh bare
root=${1:-build/bare_demo}
mkdir -p "$(dirname "$root")"
rm -rf "$root"
mmdebstrap --quiet --variant=minbase bookworm "$root" http://deb.debian.org/debian
cp /etc/resolv.conf "$root/etc/resolv.conf"
cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"  # such as the address of a mirror
mkdir "$root/latsch"
git archive HEAD | tar -x -C "$root/latsch"
# Debian's du is in the bare root; what apt keeps of its downloads is not counted.
size() { du -sm --exclude=proc --exclude=latsch --exclude=var/cache --exclude=var/lib/apt "$root" | cut -f1; }
before=$(size)
in_root() {
  # /proc is mounted for these processes alone and disappears with the last of them.
  unshare --mount --pid --fork --mount-proc="$root/proc" chroot "$root" env HOME=/root sh -c "$1"
}
in_root "cd /latsch && tools/install_packages.sh build" >"$root/install.log" 2>&1 || { cat "$root/install.log"; exit 1; }
grep '^installing' "$root/install.log" | cut -c1-120
echo "disk: $(($(size) - before)) MB more than before"
began=$(date +%s)
in_root "cd /latsch && ./demo.sh"
ended=$(date +%s)
echo "time of ./demo.sh after its packages: $(((ended - began) / 60)) min $(((ended - began) % 60)) s"
