#!/bin/sh
# Installs what is missing, builds the release preset and runs every test. Arguments go to ctest: ./test.sh -R units
set -eu
cd "$(dirname "$0")"
tools/install_packages.sh
cmake --preset release
cmake --build --preset release
exec ctest --preset release "$@"
