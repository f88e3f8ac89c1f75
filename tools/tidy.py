#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy on the files of the program, without tests and benchmarks, in the groups in which they are compiled.

    tools/tidy.py BUILD_FOLDER [WORD...]      checks the groups whose compile command contains one of the words, or all

BUILD_FOLDER is configured; objects need not exist. .clang-tidy lists the checks. A group that was clean is checked
again only if .clang-tidy, its compile command, or one of our files that it includes has changed. Ends with 1 if
clang-tidy finds anything.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import time

TREE = pathlib.Path(__file__).resolve().parents[1]
# Options that only GCC knows, and options that slow clang-tidy down without further findings.
OF_GCC = re.compile(r"-m(move|store)-max=.*|--param=.*|-fsanitize=.*|-D_GLIBCXX_(ASSERTIONS|SANITIZE_VECTOR)|-W.*")
IS_TEST = re.compile(r"_test(ing)?\.cpp$")


def is_of_program(file, directory):
    """Returns whether the file, or the group of files that CMake wrote below `directory`, belongs to the program."""
    if file.is_relative_to(TREE / "src") or file.is_relative_to(TREE / "apps"):
        return not IS_TEST.search(file.name)
    target = re.search(r"/latsch_(\w+)\.dir/Unity/", str(file))
    return target is not None and file.is_relative_to(directory) and not target[1].endswith("_test")


def for_clang(command):
    """The compile command without a launcher, such as ccache, and without options that clang-tidy does not need."""
    words = command.split()
    begin = next(i for i, word in enumerate(words) if re.search(r"(\+\+|g\+\+|clang\+\+)(-\d+)?$", word))
    return " ".join(word for word in words[begin:] if not OF_GCC.fullmatch(word))


def includes(file, known):
    """Returns all files of this repository that a file includes, and the file itself; `known` keeps the results."""
    found, open_ones = set(), [file]
    while open_ones:
        one = open_ones.pop()
        if one in found:
            continue
        found.add(one)
        if one not in known:
            text = one.read_text(errors="replace")
            places = [one.parent, TREE / "src", TREE / "apps"]
            named = re.findall(r'^\s*#\s*include\s+"([^"]+)"', text, re.M)
            candidates = ([place / name for place in places if (place / name).is_file()] for name in named)
            known[one] = {os.path.realpath(each[0]) for each in candidates if each}
        open_ones += map(pathlib.Path, known[one])
    return found


def fingerprint(entry, known, version):
    sha = hashlib.sha256()
    for part in (version, (TREE / ".clang-tidy").read_text(), entry["command"]):
        sha.update(part.encode() + b"\0")
    for file in sorted(includes(pathlib.Path(entry["file"]), known)):
        sha.update(str(file).encode() + b"\0" + file.read_bytes())
    return sha.hexdigest()


def check(folder, entry):
    begin = time.monotonic()
    done = subprocess.run(["clang-tidy", "-p", folder, "--quiet", entry["file"]], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)
    said = done.stdout + "\n".join(line for line in done.stderr.splitlines() if not line.endswith("generated."))
    return done.returncode == 0, said.strip(), time.monotonic() - begin


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
    known, open_ones, failed = {}, [], 0
    for entry in entries:
        stamp = folder / fingerprint(entry, known, version)
        if not stamp.exists():
            open_ones.append((entry, stamp))
    print(f"{len(entries)} groups of files, {len(entries) - len(open_ones)} of them unchanged since they were clean", flush=True)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as workers:
        checks = {workers.submit(check, folder, entry): (entry, stamp) for entry, stamp in open_ones}
        for each in concurrent.futures.as_completed(checks):
            entry, stamp = checks[each]
            clean, said, seconds = each.result()
            name = os.path.relpath(entry["file"], TREE)
            print(f"{name}: {'clean' if clean else 'NOT clean'}, {seconds:.0f} s" + (f"\n{said}" if not clean else ""), flush=True)
            if clean:
                stamp.touch()
            failed += not clean
    if failed:
        sys.exit(f"{failed} groups of files are not clean")


main()
