#!/bin/sh
# Builds Latsch, runs one study and names its result and its report: ./demo.sh [STUDY FOLDER]
set -eu
cd "$(dirname "$0")"
STUDY=${1:-studies/race_tire}

mkdir -p build
tools/install_packages.sh build
if ! command -v npm >/dev/null; then
  echo "without npm, the page of latsch serve is left out, and the report has pictures that do not move;" \
    "tools/install_packages.sh page brings it ($(tools/install_packages.sh --say page))"
fi
echo "building (the first time takes some minutes) ..."
if ! { cmake --preset release && cmake --build --preset release --target latsch; } >build/demo_build.log 2>&1; then
  tail -n 40 build/demo_build.log >&2
  exit 1
fi
exec build/release/bin/latsch run "$STUDY/study.toml"
