#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every system header that the build has read belongs to a package, or to a dependency of one, of the sets
that the target may need: the program reads headers of the set `build` alone, the Python package also of `python`, runs
on ranks also of `mpi`, tests and benchmarks of all. Otherwise a machine on which more packages are installed would hide
that a bare machine lacks one.

   tools/packages.py BUILD_FOLDER

Recommended packages do not count, because they are not installed. The check needs ninja and dpkg; without them, or
for a header that belongs to no package, nothing is checked."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SKIPPED = 77  # exit code that ctest counts as skipped


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


def listed(sets):
    text = (ROOT / "cmake/dependencies.cmake").read_text()
    lines = [line for each in sets for line in re.findall(rf"^# apt {each}: (.*)$", text, re.M)]
    return {name for line in lines for name in line.split()}


def sets_of(target):
    """Returns the sets that bring the packages of a target, which is the folder of its object files."""
    if "latsch_mpi.dir" in target:
        return ("build", "mpi")
    if "latsch_python.dir" in target:
        return ("build", "python")
    if re.search(r"^(benchmarks|verification)/|_test\.dir|/spring\.dir|_testing", target):
        return ("build", "python", "mpi", "test")
    return ("build",)


def closure(packages):
    """Returns the packages with all their dependencies as installed here; of alternatives, each one that is
    installed."""
    needs, provided = {}, {}
    fields = "${Package}\t${Pre-Depends}, ${Depends}\t${Provides}\t${db:Status-Status}\n"
    for line in output("dpkg-query", "-W", "-f", fields).splitlines():
        name, depends, provides, status = line.split("\t")
        if status != "installed":
            continue
        names = lambda text: re.findall(r"(?:^|[,|])\s*([a-z0-9][a-z0-9+.-]*)", text)
        needs[name] = names(depends)
        for virtual in names(provides):
            provided.setdefault(virtual, []).append(name)
    known, open_ones = set(), list(packages)
    while open_ones:
        name = open_ones.pop()
        if name in known:
            continue
        known.add(name)
        open_ones += needs.get(name, []) + ([] if name in needs else provided.get(name, []))
    return known


def headers(build):
    """Returns for each combination of sets the paths of the system headers that its targets read: as the compiler saw
    them, and with symbolic links in /usr resolved, as packages list them."""
    read, sets = {}, ()
    for line in output("ninja", "-C", build, "-t", "deps").splitlines():
        if line.startswith("    /usr/"):
            path = line.strip()
            read.setdefault(sets, set()).update((os.path.realpath(path), os.path.normpath(path)))
        elif line and not line.startswith(" "):
            sets = sets_of(line.split(": #deps")[0])
    return read


def owners(paths):
    found = {}
    for line in output("dpkg", "-S", *sorted(paths)).splitlines():
        if line.startswith("diversion") or ": " not in line:
            continue
        names, path = line.split(": ", 1)
        for name in names.split(", "):
            found.setdefault(name.split(":")[0], path)
    return found


def main(build):
    if not shutil.which("ninja") or not shutil.which("dpkg"):
        print("no ninja or no dpkg here: not checked")
        return SKIPPED
    read = headers(build)
    if not read:
        print(f"{build} knows no system headers: is it built with Ninja?")
        return SKIPPED
    failed = False
    for sets, paths in sorted(read.items()):
        used = owners(paths)
        installed = closure(listed(sets))
        for name, path in sorted(used.items()):
            if name not in installed:
                failed = True
                print(f"{path} is of {name}, which no line '# apt {sets[-1]}:' of cmake/dependencies.cmake "
                      "brings: add it there", file=sys.stderr)
        print(f"{', '.join(sets)}: {len(used)} packages have headers that are used")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
