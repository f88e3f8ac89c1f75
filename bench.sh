#!/bin/sh
# ./bench.sh NAME    builds and runs the benchmark; ends with 0 where every row of its table is reached
# ./bench.sh NAME --smoke  the same on a tiny case, in seconds; --help names what else it knows
# ./bench.sh --list  names the benchmarks, with a line each
set -eu
cd "$(dirname "$0")"

list() {
  for file in benchmarks/*_bench.cpp benchmarks/*/*_bench.cpp; do
    [ -e "$file" ] || continue
    name=$(basename "$file" _bench.cpp)
    # The first line of the file after the license says what it measures.
    printf '%-14s %s\n' "$name" "$(sed -n '2s|^// *||p' "$file")"
  done
}

name=${1:-}
case $name in
  --list) list; exit ;;
  "" | -*) echo "usage: ./bench.sh NAME | --list" >&2; list >&2; exit 2 ;;
esac
if ! list | grep -q "^$name "; then
  echo "bench.sh: no benchmark is called \"$name\"; there are:" >&2
  list >&2
  exit 2
fi
shift
log=build/bench_build.log
mkdir -p build
tools/install_packages.sh complete
if ! { cmake --preset release && cmake --build --preset release --target "bench_$name"; } >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  exit 1
fi
exec "build/release/bin/bench_$name" "$@"
