#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The checks that ./test.sh leaves out because they take long. Each step is a function step_NAME. Every step runs even if
# one before it has failed; its output is in build/thorough/NAME.log, and the table at the end names the steps that failed.
#
#   tools/thorough.sh [STEP...]      runs all steps, or the named ones
#   tools/thorough.sh --list         names the steps
set -u
cd "$(dirname "$0")/.."
logs=build/thorough
jobs=$(nproc)
steps="format tidy alone no_node sanitizers benchmarks studies"

about() {
  case $1 in
    format) echo "clang-format would change no file" ;;
    tidy) echo "clang-tidy finds nothing in the program's files (.clang-tidy lists the checks)" ;;
    alone) echo "every file is read by itself without an error or a warning: no unity build" ;;
    no_node) echo "the program builds where Node is missing, and says that it has no page (in the tree of the sanitizers)" ;;
    sanitizers) echo "all tests with the address and undefined-behavior sanitizers" ;;
    benchmarks) echo "the smoke run of every benchmark with the same sanitizers" ;;
    studies) echo "the shipped studies that take seconds, with the same sanitizers" ;;
  esac
}

step_format() {
  tools/format.sh
}

# The compile commands, not the objects, of the tree for the sanitizers.
step_tidy() {
  cmake --preset asan
  python3 tools/tidy.py build/asan
}

# The compile commands of a tree without unity builds.
step_alone() {
  cmake --preset alone
  python3 tools/alone.py build/alone
}

# The tree of the sanitizers has no page, so that this step compiles nothing that they do not need.
step_no_node() {
  cmake --preset asan | tee "$logs/no_node_configured.log"
  grep "No page: latsch is built without that of latsch serve" "$logs/no_node_configured.log"
  cmake --build --preset asan --target latsch
  python3 apps/cli/tests/serve_test.py "$PWD/build/asan/bin/latsch" -k test_the_start_page
}

sanitized() {
  cmake --preset asan
  cmake --build --preset asan -- -k 0
}

smoke='^bench_.*_smoke$'
quick='^studies_quick$'

step_sanitizers() {
  sanitized
  ctest --preset asan -j "$jobs" -E "$smoke|$quick|^bench_smoke_time$"
}

step_benchmarks() {
  sanitized
  ctest --preset asan -j "$jobs" -R "$smoke"
}

step_studies() {
  sanitized
  ctest --preset asan -R "$quick"
}

# Runs one step, prints its name, time and result in one line, and adds the line to the table.
run() {
  printf '%-11s %s\n' "$1" "$(about "$1")"
  begin=$(date +%s)
  (
    set -e
    "step_$1"
  ) >"$logs/$1.log" 2>&1
  result=$?
  seconds=$(($(date +%s) - begin))
  if [ "$result" -eq 0 ]; then
    word="passed"
  else
    word="FAILED"
    tail -n 30 "$logs/$1.log" | sed 's/^/    /'
  fi
  line=$(printf '%-11s %s after %d min %02d s' "$1" "$word" $((seconds / 60)) $((seconds % 60)))
  echo "$line"
  [ "$word" = passed ] || failed="$failed
  $line; the output is in $logs/$1.log"
}

for word in "$@"; do
  case $word in
    --list)
      for step in $steps; do printf '%-11s %s\n' "$step" "$(about "$step")"; done
      exit
      ;;
  esac
  case " $steps " in
    *" $word "*) ;;
    *)
      echo "thorough.sh: no step is called \"$word\"; the steps are: $steps" >&2
      exit 2
      ;;
  esac
done
mkdir -p "$logs"
tools/install_packages.sh complete thorough || exit
failed=""
began=$(date +%s)
[ $# -gt 0 ] || eval "set -- $steps"
for step in "$@"; do run "$step"; done
total=$(($(date +%s) - began))
printf 'all steps together: %d min %02d s\n' $((total / 60)) $((total % 60))
[ -z "$failed" ] || {
  echo "failed:$failed"
  exit 1
}
