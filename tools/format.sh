#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Fails if clang-format would change a C++ file, and names the places. `tools/format.sh -i` changes them instead.
# Ends with 77, which skips the test of this name, if clang-format is missing; `tools/install_packages.sh thorough` installs it.
set -eu
cd "$(dirname "$0")/.."
command -v clang-format >/dev/null || {
  echo "format.sh: clang-format is not installed, so no file was checked"
  exit 77
}
[ $# -gt 0 ] || set -- --dry-run -Werror
find src apps benchmarks verification examples -name node_modules -prune -o \( -name '*.h' -o -name '*.cpp' \) -print |
  xargs -P "$(nproc)" -n 50 clang-format "$@"
