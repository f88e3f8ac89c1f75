#!/usr/bin/env python3
"""Checks that every published figure has a run that renews it: every benchmark of ./bench.sh --list has a smoke test,
and every study below studies/ has expected results that come from a run or state that there was none.

   every_figure.py SOURCE BUILD        ends with 1 and names what is missing"""
import json
import pathlib
import subprocess
import sys

import studies


def benchmarks_without_test(source, build):
    listed = subprocess.run([source / "bench.sh", "--list"], check=True, stdout=subprocess.PIPE, text=True).stdout
    names = [line.split()[0] for line in listed.splitlines()]
    known = json.loads(subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True,
                                      stdout=subprocess.PIPE, text=True).stdout)
    tests = {test["name"] for test in known["tests"]}
    if len(names) < 10:
        return [f"./bench.sh --list names {len(names)} benchmarks"]
    return [f"benchmark {name} has no test bench_{name}_smoke" for name in names if f"bench_{name}_smoke" not in tests]


def main():
    source, build = (pathlib.Path(word) for word in sys.argv[1:3])
    wrong = benchmarks_without_test(source, build) + studies.without_results()
    for one in wrong:
        print(one)
    sys.exit(1 if wrong else 0)


main()
