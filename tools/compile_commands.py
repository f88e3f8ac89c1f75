# SPDX-License-Identifier: Apache-2.0
"""Checks of the files in a compile_commands.json, two at a time on two cores, for tools/tidy.py and tools/alone.py.

A file that was clean is checked again only if its command, one of our files that it includes, or a rule of the check has
changed: check_all() keeps one empty file for every clean file, named by a hash of these."""
import concurrent.futures
import hashlib
import os
import pathlib
import re
import time

TREE = pathlib.Path(__file__).resolve().parents[1]


def without_launcher(command):
    """The words of a compile command without a launcher, such as ccache."""
    words = command.split()
    begin = next(i for i, word in enumerate(words) if re.search(r"(\+\+|g\+\+|clang\+\+)(-\d+)?$", word))
    return words[begin:]


class Includes:
    """Finds what files include: our files by path, and headers of the system by name."""

    def __init__(self, commands):
        named = {pathlib.Path(path) for command in commands for path in re.findall(r"-I ?(\S+)", command)}
        self.folders = sorted(one for one in named if one.is_relative_to(TREE))
        self.known = {}

    def of(self, file):
        """Returns all our files that a file includes, with the file itself, and all names in angle brackets there."""
        found, system, open_ones = set(), set(), [pathlib.Path(file)]
        while open_ones:
            one = open_ones.pop()
            if one in found:
                continue
            found.add(one)
            if one not in self.known:
                text = one.read_text(errors="replace")
                names = re.findall(r'^\s*#\s*include\s+"([^"]+)"', text, re.M)
                candidates = ([place / name for place in (one.parent, *self.folders) if (place / name).is_file()]
                              for name in names)
                self.known[one] = ([pathlib.Path(os.path.realpath(each[0])) for each in candidates if each],
                                   set(re.findall(r"^\s*#\s*include\s+<([^>]+)>", text, re.M)))
            ours, theirs = self.known[one]
            open_ones += ours
            system |= theirs
        return found, system


def fingerprint(entry, includes, rules):
    sha = hashlib.sha256()
    for part in (*rules, entry["command"]):
        sha.update(part.encode() + b"\0")
    for file in sorted(includes.of(entry["file"])[0]):
        sha.update(str(file).encode() + b"\0" + file.read_bytes())
    return sha.hexdigest()


def check_all(entries, folder, rules, check, noun):
    """Calls check(entry), which returns whether the file is clean and what was said, for each entry that has changed since
    it was clean. Prints a line for each, and returns how many are not clean."""
    folder.mkdir(parents=True, exist_ok=True)
    includes = Includes([entry["command"] for entry in entries])
    stamps = [(entry, folder / fingerprint(entry, includes, rules)) for entry in entries]
    open_ones = [(entry, stamp) for entry, stamp in stamps if not stamp.exists()]
    print(f"{len(entries)} {noun}, {len(entries) - len(open_ones)} of them unchanged since they were clean", flush=True)

    def timed(entry):
        begin = time.monotonic()
        return *check(entry), time.monotonic() - begin

    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as workers:
        checks = {workers.submit(timed, entry): (entry, stamp) for entry, stamp in open_ones}
        for each in concurrent.futures.as_completed(checks):
            entry, stamp = checks[each]
            clean, said, seconds = each.result()
            name = os.path.relpath(entry["file"], TREE)
            print(f"{name}: {'clean' if clean else 'NOT clean'}, {seconds:.0f} s" + (f"\n{said}" if said and not clean else ""),
                  flush=True)
            if clean:
                stamp.touch()
            failed += not clean
    return failed
