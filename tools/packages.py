#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every system header that the build has read belongs to a package that install_packages.sh installs, or
to a dependency of one. Otherwise a machine on which more packages are installed would hide that a bare machine lacks
one.

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


def listed():
    text = (ROOT / "cmake/dependencies.cmake").read_text()
    return {name for line in re.findall(r"^# apt: (.*)$", text, re.M) for name in line.split()}


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
    """Returns the paths of the system headers as the compiler saw them, and with symbolic links in /usr resolved, as
    packages list them."""
    read = set(re.findall(r"^    (/usr/.*)$", output("ninja", "-C", build, "-t", "deps"), re.M))
    return {os.path.realpath(path) for path in read} | {os.path.normpath(path) for path in read}


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
    used = owners(headers(build))
    if not used:
        print(f"{build} knows no system headers: is it built with Ninja?")
        return SKIPPED
    installed = closure(listed())
    missing = {name: path for name, path in used.items() if name not in installed}
    for name, path in sorted(missing.items()):
        print(f"{path} is of {name}, which no '# apt:' line of cmake/dependencies.cmake brings: add "
              "it there", file=sys.stderr)
    print(f"{len(used)} packages have headers that are used")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
