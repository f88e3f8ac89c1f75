#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the manual page latsch(1) from the program's own help: one page with a section for every verb.

   tools/man_page.py PATH/TO/latsch latsch.1"""
import re
import subprocess
import sys


def said(program, *arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout.rstrip()


def plain(text):
    """Converts lines to roff that keeps them as they are, so that columns and examples keep their places."""
    escaped = text.replace("\\", "\\e").replace("-", "\\-")
    lines = ["\\&" + line if line.startswith((".", "'")) else line for line in escaped.splitlines()]
    return ".nf\n" + "\n".join(lines) + "\n.fi\n"


def main(program, file):
    general = said(program, "help")
    description, rest = general.split("\nUsage:", 1)
    verbs = re.findall(r"^  ([a-z]+) {2,}\S", rest.split("Subcommands:")[1].split("\n\n")[0], re.M)
    version = said(program, "--version").split()[1]
    page = [f'.TH LATSCH 1 "" "latsch {version}" "User Commands"\n',
            ".SH NAME\nlatsch \\- identifies tire and suspension models from rig measurements\n",
            ".SH SYNOPSIS\n.B latsch\n.I VERB\n[OPTIONS]\n",
            ".SH DESCRIPTION\n" + plain(description),
            ".SH VERBS\n" + plain(rest.split("Subcommands:")[1].strip("\n"))]
    for verb in verbs:
        page.append(f".SH latsch {verb}\n" + plain(said(program, "help", verb)))
    page.append(".SH ENVIRONMENT\n.TP\n.B LATSCH_KERNELS\nForces a set of vector instructions: baseline, avx2, avx512.\n")
    page.append(".SH SEE ALSO\n.B latsch help study\nprints all that may stand in a study.\n")
    with open(file, "w") as out:
        out.write("".join(page))


if __name__ == "__main__":
    main(*sys.argv[1:])
