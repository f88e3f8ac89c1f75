#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Headers for programs built on Latsch. docs/headers.md lists them.

    tools/public_headers.py                    checks the list and the examples
    tools/public_headers.py --install FOLDER   copies the listed headers and those that they include
    tools/public_headers.py --pages FOLDER     writes the listed headers as Doxygen reads them

Sources include each other from src/ ("base/error.h"). Installed headers include each other below
latsch/ ("latsch/base/error.h"), so that they cannot be mistaken for files of another project.
tools/api_pages.sh makes the pages of the listed headers."""
import itertools
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/headers.md"
EXAMPLES = ROOT / "examples"
ROW = re.compile(r"^\| `([\w/]+\.h)` \| (\S.*) \|$", re.M)
INCLUDE = re.compile(r'^(\s*#\s*include\s+)"([^"]+)"', re.M)
INSTALLED = re.compile(r"^\s*#\s*include\s+<latsch/([^>]+)>", re.M)
TRAILING = re.compile(r"^(.*[;,{})>\w])(\s+)//(?!/)\s?(.*)$")
CONTINUED = re.compile(r"^(\s{8,})//(?!/)\s?(.*)$")


def listed():
    return [name for name, _ in ROW.findall(PAGE.read_text())]


def source(name):
    """Returns the file of a header: src/NAME, or apps/NAME for headers of the program."""
    return next((path for path in (ROOT / "src" / name, ROOT / "apps" / name) if path.is_file()), None)


def closure(names):
    """Returns the listed headers and all that they include, in alphabetical order."""
    known, waiting = set(), list(names)
    while waiting:
        name = waiting.pop()
        if name in known:
            continue
        known.add(name)
        waiting += [used for _, used in INCLUDE.findall(source(name).read_text()) if source(used)]
    return sorted(known)


def installed_text(text):
    return INCLUDE.sub(lambda m: f'{m[1]}"latsch/{m[2]}"' if source(m[2]) else m[0], text)


def write(names, folder, text_of):
    for name in names:
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text_of(source(name)))


def faults():
    names = listed()
    for name in names:
        if not source(name):
            yield f"docs/headers.md: there is no {name} below src/ or apps/"
        elif names.count(name) > 1:
            yield f"docs/headers.md lists {name} twice"
    for example in sorted(EXAMPLES.glob("*.cpp")):
        text = example.read_text()
        for _, used in INCLUDE.findall(text):
            yield f'{example.name} includes "{used}": write <latsch/...>'
        for used in INSTALLED.findall(text):
            if used not in names:
                yield f"{example.name} includes {used}, which docs/headers.md does not list"


def escaped(text):
    """Returns the text with everything escaped that Doxygen would read as a command, except code between backticks."""
    parts = re.split(r"(`[^`]*`)", text)
    return "".join(part if part.startswith("`") else re.sub(r"([\\@<>#%&~\"])", r"\\\1", part)
                   for part in parts)


def head_of(lines):
    """Returns the comment at the head of a file, below its SPDX line, as (text, number of the line that follows)."""
    end = 1
    while end < len(lines) and lines[end].startswith("//"):
        end += 1
    return [line[2:].removeprefix(" ") for line in lines[1:end]], end


def members_of(code):
    """Splits the declaration `T a, b = 1;` into its type and members. Returns None if it declares one member or none.
    """
    declared = re.match(r"(\s+(?:(?:static|constexpr|mutable|const) )*)(\w.*);\s*$", code)
    depth, cuts = 0, []
    for k, letter in enumerate(declared[2] if declared else ""):
        depth += (letter in "<({[") - (letter in ">)}]")
        if depth == 0 and (letter == "," or letter == " " and not cuts):
            cuts.append(k)
    if len(cuts) < 2:
        return None
    pieces = [declared[2][a + 1:b].strip() for a, b in zip(cuts, cuts[1:] + [len(declared[2])])]
    if not all(re.fullmatch(r"\*?\w+( = [^,]*|\{.*\})?", piece) for piece in pieces):
        return None
    return declared[1] + declared[2][:cuts[0]], pieces


def filtered(path):
    """Returns a header line by line as Doxygen has to read it. Comments behind a member and at the head of the file
    become documentation. The class that has the file's name is described by the first paragraph of the head if it has
    no comment of its own. Declarations that the compiler defines need no description."""
    lines = path.read_text().splitlines()
    head, end = head_of(lines)
    title = "".join(word.capitalize() for word in path.stem.split("_"))
    paragraph = " ".join(escaped(text) for text in itertools.takewhile(str.strip, head))
    out, follows = [r"/// \file"] + ["/// " + escaped(text) for text in head], False
    for k, line in enumerate(lines[end:], end):
        trailing, continued = TRAILING.match(line), CONTINUED.match(line)
        if line.lstrip().startswith("///"):
            indent, text = line.split("///", 1)
            line, follows = f"{indent}///{escaped(text)}", False
            above.append(text.strip())
            out.append(line)
            continue
        elif re.search(r"(operator.*|&&\)) = default;", line):
            line = ""
        elif several := members_of(trailing[1] if trailing else line):
            text = escaped(" ".join([trailing[3]] if trailing else above)).replace("*/", "")
            describe = f" /**< {text} */" if text else ""
            line = " ".join(f"{several[0]} {piece}{';'}{describe}" for piece in several[1])
            follows = False
        elif trailing and trailing[1].count('"') % 2 == 0:
            line, follows = f"{trailing[1]}{trailing[2]}///< {escaped(trailing[3])}", True
        elif continued and follows:
            line = f"{continued[1]}///< {escaped(continued[2])}"
        else:
            follows = False
            if re.match(rf"(?:class|struct) {title}\b(?!;)", line) and not lines[k - 1].startswith("///"):
                line = f"/** {paragraph} */ {line}"
        above = []
        out.append(line)
    return "\n".join(out) + "\n"


def main(arguments):
    if arguments[:1] == ["--install"] and len(arguments) == 2:
        write(closure(listed()), pathlib.Path(arguments[1]), lambda path: installed_text(path.read_text()))
    elif arguments[:1] == ["--pages"] and len(arguments) == 2:
        write(listed(), pathlib.Path(arguments[1]), filtered)
    elif arguments:
        sys.exit(__doc__)
    else:
        found = list(faults())
        print("\n".join(found), file=sys.stderr)
        print(f"{len(listed())} headers are public, {len(closure(listed()))} are installed"
              if not found else f"{len(found)} faults")
        return 1 if found else 0
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
