#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy on the files of the program, without tests and benchmarks, in the groups in which they are compiled.

    tools/tidy.py BUILD_FOLDER [WORD...]      checks the groups whose compile command contains one of the words, or all

BUILD_FOLDER is configured; objects need not exist. .clang-tidy lists the checks. A group that was clean is checked
again only if .clang-tidy, its compile command, or one of our files that it includes has changed. Ends with 1 if
clang-tidy finds anything.
"""
import json
import pathlib
import re
import subprocess
import sys

from compile_commands import TREE, check_all, without_launcher

# Options that only GCC knows, and options that slow clang-tidy down without further findings.
OF_GCC = re.compile(r"-m(move|store)-max=.*|--param=.*|-f(no-)?sanitize.*|-D_GLIBCXX_(ASSERTIONS|SANITIZE_VECTOR)|-W.*")
IS_TEST = re.compile(r"_test(ing)?\.cpp$")


def is_of_program(file, directory):
    """Returns whether the file, or the group of files that CMake wrote below `directory`, belongs to the program."""
    if file.is_relative_to(TREE / "src") or file.is_relative_to(TREE / "apps"):
        return not IS_TEST.search(file.name)
    target = re.search(r"/latsch_(\w+)\.dir/Unity/", str(file))
    return target is not None and file.is_relative_to(directory) and not target[1].endswith("_test")


def for_clang(command):
    """The compile command without options that clang-tidy does not need."""
    return " ".join(word for word in without_launcher(command) if not OF_GCC.fullmatch(word))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    build, words = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]
    commands = json.loads((build / "compile_commands.json").read_text())
    version = subprocess.run(["clang-tidy", "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
    folder = build / "tidy"
    folder.mkdir(exist_ok=True)
    entries = [{**one, "command": for_clang(one["command"])} for one in commands
               if is_of_program(pathlib.Path(one["file"]), build) and (not words or any(w in one["command"] for w in words))]
    (folder / "compile_commands.json").write_text(json.dumps(entries))

    def check(entry):
        done = subprocess.run(["clang-tidy", "-p", folder, "--quiet", entry["file"]], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True)
        said = done.stdout + "\n".join(line for line in done.stderr.splitlines() if not line.endswith("generated."))
        return done.returncode == 0, said.strip()

    rules = [version, (TREE / ".clang-tidy").read_text()]
    failed = check_all(entries, folder, rules, check, "groups of files")
    if failed:
        sys.exit(f"{failed} groups of files are not clean")


main()
