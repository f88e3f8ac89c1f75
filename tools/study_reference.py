#!/usr/bin/env python3
"""Writes docs/study_reference.md, the reference of all keys of a study, from the program's own key tables.

   tools/study_reference.py PATH/TO/latsch           writes the page
   tools/study_reference.py PATH/TO/latsch --check   ends with 1 if the page differs from the program's text"""
import pathlib
import subprocess
import sys

PAGE = pathlib.Path(__file__).resolve().parents[1] / "docs" / "study_reference.md"


def main():
    program, *options = sys.argv[1:]
    said = subprocess.run([program, "help", "study"], capture_output=True, text=True, check=True).stdout
    page = said.split("\n## Models and tests of this program\n")[0]
    if options != ["--check"]:
        PAGE.write_text(page)
    elif not PAGE.exists() or PAGE.read_text() != page:
        sys.exit(f"docs/study_reference.md is not what the program says: run tools/study_reference.py {program} "
                 "and look at what changed")


if __name__ == "__main__":
    main()
