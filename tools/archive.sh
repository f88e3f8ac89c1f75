#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# tools/archive.sh          writes build/packages/latsch-VERSION-x86_64.tar.xz: the program with all libraries that it needs
#                           but those of glibc, for machines where nobody may install packages. It runs where it is
#                           unpacked, on every Linux whose glibc is at least 2.36, such as Debian 12 and Ubuntu 24.04
# tools/archive.sh --try    and runs it in roots of Debian 12 and 13 that have libc6 alone (mmdebstrap, root)
set -eu
cd "$(dirname "$0")/.."
newest_glibc=2.36
tools/install_packages.sh build page archive
log=build/archive_build.log
mkdir -p build/packages
if ! { cmake --preset release && cmake --build --preset release --target latsch latsch_manual latsch_fmi2 latsch_fmi3 latsch_sti latsch_all; } >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  exit 1
fi
name=latsch-$(sed -n 's/^project(latsch VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)-$(uname -m)
folder=build/packages/$name
rm -rf "$folder"
cmake --install build/release --component program --strip --prefix "$folder" >"$log"
needed=$folder/lib/latsch/needed
mkdir -p "$needed" "$folder/share/xml"
cp LICENSE "$folder"
cp -r /usr/share/xml/udunits "$folder/share/xml/"
licenses=$folder/share/doc/licenses
mkdir -p "$licenses"
ldd "$folder/bin/latsch" | awk '$3 ~ "^/" { print $3 }' | while read -r library; do
  package=$(dpkg -S "$(realpath "$library")" "$library" 2>/dev/null | head -n 1 | cut -d: -f1)
  [ "$package" != libc6 ] || continue
  cp -L "$library" "$needed/"
  cp "/usr/share/doc/$package/copyright" "$licenses/$package"
done
# An RPATH, unlike a RUNPATH, also holds for the libraries that the libraries need.
# shellcheck disable=SC2016  # $ORIGIN is a word of the loader
patchelf --force-rpath --set-rpath '$ORIGIN/../lib/latsch/needed' "$folder/bin/latsch"
glibc=$(objdump -T "$folder/bin/latsch" "$needed"/* | grep -o 'GLIBC_[0-9.]*' | cut -d_ -f2 | sort -uV | tail -n 1)
if [ "$(printf '%s\n%s\n' "$glibc" $newest_glibc | sort -V | tail -n 1)" != $newest_glibc ]; then
  echo "archive.sh: a library asks for glibc $glibc; the page says $newest_glibc" >&2
  exit 1
fi
tar -C build/packages --owner=0 --group=0 --sort=name -c "$name" | xz -9e -T2 >"$folder.tar.xz"
echo "$folder.tar.xz: $(du -m --apparent-size "$folder.tar.xz" | cut -f1) MB, $(du -sm "$folder" | cut -f1) MB unpacked, glibc $glibc or newer"
rm -rf "$folder"
[ "${1:-}" = --try ] || exit 0

tools/install_packages.sh bare
root=build/packages/only_libc
trap 'rm -rf "$root"' EXIT
for suite in bookworm trixie; do
  rm -rf "$root"
  mmdebstrap --quiet --variant=extract --include=libc6 $suite "$root" http://deb.debian.org/debian
  tar -C "$root" -xf "$folder.tar.xz"
  mkdir -p "$root/proc" "$root/tmp"
  for merged in lib lib64; do  # links that another package of Debian 13 has
    [ -e "$root/$merged" ] || ln -s "usr/$merged" "$root/$merged"
  done
  for command in "--version" "new tire --coarse" "check tire/study.toml" "run tire/study.toml --workers 2"; do
    echo "== $suite: latsch $command"
    # shellcheck disable=SC2086  # one word an argument
    unshare --mount --pid --fork --mount-proc="$root/proc" chroot "$root" "/$name/bin/latsch" $command >"$root/said" 2>&1 || {
      cat "$root/said"
      exit 1
    }
  done
  test -s "$root/tire/study.html"
done
echo "== all of it works"
