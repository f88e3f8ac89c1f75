#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# tools/repack.sh FILE.deb...   compresses Debian packages again with a dictionary of 64 MB, so that the code that the program
#                               and its libraries have in common is there once (a package of 13.7 MB became one of 9.1)
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for package; do
  rm -rf "$scratch/content"
  dpkg-deb --raw-extract "$package" "$scratch/content"
  # CPack calls ldconfig, but no library of these packages is where the loader searches.
  rm -f "$scratch/content/DEBIAN/postinst" "$scratch/content/DEBIAN/postrm"
  dpkg-deb --root-owner-group -Zxz -z9 -Sextreme --build "$scratch/content" "$scratch/package.deb" >"$scratch/log"
  mv "$scratch/package.deb" "$package"
done
