#!/usr/bin/env python3
"""Counts the lines of the program by module: all lines, and lines of code (neither blank nor comment). Tests and
their helpers (x_test, x_testing) and generated files are not counted; src/experiment/tests counts, because the tests
of tires in it are part of the program. Readers of foreign files and recordings are counted separately.

   tools/count_lines.py    counts the files that git tracks in the repository of this script"""
import argparse
import collections
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
READERS = ("src/formats", "src/correlation/laboratory")


def counted(file):
    return (file.suffix in (".cpp", ".h") and file.parts[0] in ("src", "apps")
            and not file.stem.endswith(("_test", "_testing")))


def module_of(file):
    if str(file.parent).startswith(READERS):
        return next(folder for folder in READERS if str(file.parent).startswith(folder))
    return "/".join(file.parts[:3] if file.parts[1] == "models" else file.parts[:2])


def lines_of(text):
    """Returns the number of all lines and of lines of code."""
    lines = text.splitlines()
    return len(lines), sum(1 for line in lines if line.strip() and not line.lstrip().startswith("//"))


def main():
    argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
    files = subprocess.run(["git", "-C", ROOT, "ls-files"], capture_output=True, text=True, check=True).stdout.split("\n")
    sums = collections.defaultdict(lambda: [0, 0])
    for file in map(pathlib.Path, filter(None, files)):
        if not counted(file) or not (ROOT / file).is_file():
            continue
        for k, count in enumerate(lines_of((ROOT / file).read_text())):
            for name in (module_of(file), "readers" if module_of(file) in READERS else "the rest", "together"):
                sums[name][k] += count
    print(f"{'':34} {'lines':>8} {'code':>8}")
    last = ("the rest", "readers", "together")
    for name in [*sorted(set(sums) - set(last)), *last]:
        print(f"{name:34} {sums[name][0]:8,} {sums[name][1]:8,}")


if __name__ == "__main__":
    main()
