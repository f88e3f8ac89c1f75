#!/usr/bin/env python3
"""Nothing that states a figure may lack the run that renews it: every benchmark of ./bench.sh --list has its smoke test,
every folder of studies/ with a study.toml its expected results, which name each of its studies.

    every_figure.py SOURCE BUILD [UNTRIED...]        ends with 1 and names what lacks one

UNTRIED: benchmarks whose smoke run nobody has tried yet (benchmarks/CMakeLists.txt). They are named, and none of them may
be unknown or have its test.
"""
import json
import pathlib
import subprocess
import sys


def benchmarks_without_test(source, build, untried):
    listed = subprocess.run([source / "bench.sh", "--list"], check=True, stdout=subprocess.PIPE, text=True).stdout
    names = [line.split()[0] for line in listed.splitlines()]
    known = json.loads(subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True,
                                      stdout=subprocess.PIPE, text=True).stdout)
    tests = {test["name"] for test in known["tests"]}
    if len(names) < 10:
        return [f"./bench.sh --list names {len(names)} benchmarks"]
    has_test = {name for name in names if f"bench_{name}_smoke" in tests}
    for name in untried:
        print(f"the smoke run of {name} is not tried yet")
    return ([f"benchmark {name} has no test bench_{name}_smoke" for name in names if name not in has_test | set(untried)]
            + [f"{name} is in LATSCH_UNTRIED_SMOKE, and is no benchmark" for name in untried if name not in names]
            + [f"{name} is in LATSCH_UNTRIED_SMOKE, and has its test" for name in untried if name in has_test])


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
    wrong = benchmarks_without_test(source, build, sys.argv[3:]) + studies_without_results(source)
    for one in wrong:
        print(one)
    sys.exit(1 if wrong else 0)


main()
