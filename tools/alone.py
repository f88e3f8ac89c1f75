#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads every C++ file by itself, as a compiler does that makes no code: a file that lacks an include of its own, which the
files before it in a unity build had brought along, is named, and so is every warning.

    tools/alone.py BUILD_FOLDER      the folder of the configured preset `alone`; objects need not exist

Reading takes a third of the time of compiling without optimization. Warnings that need optimized code come from the
other builds. A file that was clean is read again only if its command or one of our files that it includes has changed.
Ends with 1 if a file is not clean.
"""
import json
import pathlib
import re
import shlex
import subprocess
import sys
import threading

from compile_commands import Includes, check_all, without_launcher

# Headers of the system that many files include, as precompiled headers: each file takes the first kit of which it includes
# every header, in its own text or through one of our headers. So no kit gives a file what the file does not include, but a
# file that uses such a header ahead of its include stays unseen.
MANY = ["filesystem", "functional", "map", "memory", "optional", "string", "variant", "vector"]
KITS = [["Eigen/Core", "gtest/gtest.h", *MANY], ["Eigen/Core", *MANY], ["Eigen/Core", "gtest/gtest.h"], ["Eigen/Core"],
        ["gtest/gtest.h"]]
# Options of the code that is made: without them one precompiled header serves all files.
OF_CODE = re.compile(r"-c|-g\d?|-O.*|-f.*|-m.*|--param=.*")


def for_reading(command):
    words = [word for word in shlex.split(" ".join(without_launcher(command))) if not OF_CODE.fullmatch(word)]
    at = words.index("-o")
    return words[:at] + words[at + 2:] + ["-fsyntax-only"]


class Kits:
    """Precompiles a kit when a file first needs it."""

    def __init__(self, folder):
        self.folder, self.made, self.one_at_a_time = folder, {}, threading.Lock()
        folder.mkdir(parents=True, exist_ok=True)

    def options(self, system, words):
        """Returns the options that include the kit of a file with these headers of the system and this command."""
        number = next((number for number, headers in enumerate(KITS) if system.issuperset(headers)), None)
        if number is None:
            return []
        with self.one_at_a_time:
            if number not in self.made:
                self.made[number] = self.make(number, words)
        return ["-include", self.made[number]]

    def make(self, number, words):
        # Definitions for one file leave a precompiled header valid; GTEST_HAS_PTHREAD is CMake's for all tests.
        options = [word for word in words[1:] if word.startswith(("-std", "-W", "-DGTEST"))]
        options += [word for flag, path in zip(words, words[1:]) if flag == "-isystem" for word in (flag, path)]
        kit = self.folder / f"kit_{number}.h"
        kit.write_text("".join(f"#include <{header}>\n" for header in KITS[number]))
        subprocess.run([words[0], *options, "-x", "c++-header", kit, "-o", f"{kit}.gch"], check=True)
        return kit


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    build = pathlib.Path(sys.argv[1]).resolve()
    entries = json.loads((build / "compile_commands.json").read_text())
    if not entries:
        sys.exit(f"{build}: no compile commands")
    compiler = for_reading(entries[0]["command"])[0]
    version = subprocess.run([compiler, "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
    folder = build / "read"
    kits = Kits(folder / "kits")
    includes = Includes([entry["command"] for entry in entries])

    def check(entry):
        words = for_reading(entry["command"])
        kit = kits.options(includes.of(entry["file"])[1], words)
        done = subprocess.run([words[0], *kit, *words[1:]], cwd=entry["directory"], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        return done.returncode == 0, done.stdout.strip()

    rules = [version, pathlib.Path(__file__).read_text()]
    failed = check_all(entries, folder, rules, check, "files")
    if failed:
        sys.exit(f"{failed} files are not clean")


main()
