#!/usr/bin/env python3
"""Nothing that states a figure may lack the run that renews it: every benchmark of ./bench.sh --list has its smoke test,
every folder of studies/ with a study.toml its expected results, which name each of its studies.

    every_figure.py SOURCE BUILD        ends with 1 and names what lacks one
"""
import json
import pathlib
import subprocess
import sys


def benchmarks_without_test(source, build):
    listed = subprocess.run([source / "bench.sh", "--list"], check=True, stdout=subprocess.PIPE, text=True).stdout
    names = [line.split()[0] for line in listed.splitlines()]
    known = json.loads(subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True,
                                      stdout=subprocess.PIPE, text=True).stdout)
    tests = {test["name"] for test in known["tests"]}
    if len(names) < 10:
        return [f"./bench.sh --list names {len(names)} benchmarks"]
    return [f"benchmark {name} has no test bench_{name}_smoke" for name in names if f"bench_{name}_smoke" not in tests]


def studies_without_results(source):
    wrong = []
    for study in sorted((source / "studies").glob("*/study.toml")):
        expected = study.with_name("expected.toml")
        if not expected.exists():
            wrong.append(f"studies/{study.parent.name} has a study.toml and no expected.toml (tools/studies.py)")
        elif '["study.toml"]' not in expected.read_text():
            wrong.append(f"studies/{study.parent.name}/expected.toml does not speak of study.toml")
    return wrong


def main():
    source, build = (pathlib.Path(word) for word in sys.argv[1:3])
    wrong = benchmarks_without_test(source, build) + studies_without_results(source)
    for one in wrong:
        print(one)
    sys.exit(1 if wrong else 0)


main()
