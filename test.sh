#!/bin/sh
# Installs what is missing, builds the release preset and runs every test. `./test.sh --help` lists what else it does.
set -eu
cd "$(dirname "$0")"
case ${1:-} in
  -h | --help)
    cat <<'END'
./test.sh                     installs missing packages, builds the release preset and runs every test
./test.sh ARGUMENT...         the same, with arguments for ctest: `-R units` runs the tests whose names contain units,
                              `-N` lists all names, `--rerun-failed` repeats those that failed last
./test.sh --thorough          runs the checks that take longer, one step after the other, to the end, and fails with a
                              table of the steps that failed
./test.sh --thorough STEP...  runs the named steps alone; `./test.sh --thorough --list` names them

One test program alone: build/release/bin/X_test --gtest_filter='Y*', or
python3 apps/cli/tests/X_test.py build/release/bin/latsch.
END
    exit
    ;;
  --thorough)
    shift
    exec tools/thorough.sh "$@"
    ;;
esac
tools/install_packages.sh complete
cmake --preset release -D LATSCH_TESTS=ON
cmake --build --preset release
exec ctest --preset release "$@"
