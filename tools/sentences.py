#!/usr/bin/env python3
"""Counts comments that are hard to read: comments that begin with a bare relative word (Of, What, Where, How, The
same ...) and so have no main clause; lines that end too early after an edit; and phrases that CONTRIBUTING.md bans.
`tools/sentences.py` prints each place and fails if there are any. With a seed and a number it draws comments at
random, to be read without their context: `tools/sentences.py --draw 110 --seed 7`."""
import argparse
import pathlib
import random
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ["src", "apps", "benchmarks", "verification", "tools", "cmake"]
MARK = {".h": "//", ".cpp": "//", ".js": "//", ".mjs": "//", ".ts": "//", ".py": "#", ".cmake": "#", ".sh": "#"}

BARE = re.compile(r"(of|what|where|whose|as|from|by|how|which|that|who|whom|whether|than|the same)\b(?! is the case\b)", re.I)
BANNED = re.compile(r"\b(hangs? on|hung on)\b", re.I)
NO_SENTENCE = re.compile(r"namespace\b|SPDX|clang-format|NOLINT|Copyright|-\*-|!/")

NARROW = 60  # A line of a comment is torn if it ends before this column although the next word would fit,
WIDE = 80  # and if another line of the comment is at least this long.


def comment_of(line, mark):
    """Returns the column of the comment mark in a line, the comment's text, and whether code stands before it; or
    None."""
    inside = None  # The quote of the string that the position is in.
    at = 0
    while at < len(line):
        char = line[at]
        if inside:
            at += 1 if char != "\\" else 2
            inside = None if char == inside else inside
            continue
        if char in "\"'" and not (char == "'" and at and line[at - 1].isalnum()):
            inside = char
        elif line.startswith(mark, at):
            text = line[at + len(mark):]
            text = text[1:] if mark == "//" and text.startswith("/") else text
            text = text[1:] if text.startswith("<") else text
            return at, text.rstrip(), bool(line[:at].strip())
        at += 1
    return None


def without_texts(text, suffix):
    """Returns a file's text in which multi-line strings of Python are replaced by blanks, because # begins no comment
    in them."""
    if suffix != ".py":
        return text
    return re.sub(r'"""(?:.|\n)*?"""', lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def blocks_of(path):
    """Returns each comment of a file as (line, [its lines]). A comment behind code may continue in the lines below."""
    found, block, column, first, raw = [], [], 0, 0, False
    for number, line in enumerate(without_texts(path.read_text(encoding="utf-8"), path.suffix).split("\n") + [""], 1):
        if not raw and 'R"' in line:
            raw = ')"' not in line and re.search(r'R"\w*\(', line) is not None
        elif raw:
            raw = not re.search(r'\)\w*"', line)
            continue
        comment = comment_of(line, MARK[path.suffix])
        goes_on = block and comment and not comment[2] and (comment[0] == column)
        if block and not goes_on:
            found.append((first, block))
            block = []
        if comment:
            if not block:
                first, column = number, comment[0]
            block.append(comment[1])
    return found + ([(first, block)] if block else [])


def torn_line(block):
    """Returns the index of a line in a block that ends early within a sentence, as in an edited text that was not
    wrapped again."""
    for at, (line, after) in enumerate(zip(block, block[1:])):
        words = after.split()
        if not words or re.match(r"\s{2,}", line) or re.match(r"\s{2,}|\s*(?:[-*|(\d\[#`=]|apt [a-z-]+:)", after):
            continue
        room = len(line) + 1 + len(words[0]) < NARROW and not re.search(r"[.:;,!?)\]=|]$", line)
        if room and re.match(r"[a-z]+[,.]?$", words[0]) and max(map(len, block)) > WIDE and len(line.split()) > 2:
            return at
    return None


def files():
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in MARK and "node_modules" not in path.parts:
                yield path


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--draw", type=int, default=0, help="print that many comments drawn at random")
    options.add_argument("--seed", type=int, default=1, help="the seed of the draw")
    options.add_argument("paths", nargs="*", help="look at these files and folders only")
    asked = options.parse_args()
    chosen = [pathlib.Path(path).resolve() for path in asked.paths]
    faults, comments = [], []
    for path in files():
        if chosen and not any(path == one or one in path.parents for one in chosen):
            continue
        for line, block in blocks_of(path):
            if "SPDX" in block[0]:  # the head of a file begins behind its license
                line, block = line + 1, block[1:]
            text = " ".join(part.strip() for part in block).strip()
            if not re.search(r"[A-Za-z]", text) or NO_SENTENCE.match(text):
                continue
            place = f"{path.relative_to(ROOT)}:{line}"
            comments.append((place, block))
            torn = torn_line(block)
            if BARE.match(text):
                faults.append(f"{place}: begins with a bare relative word: {text[:70]}")
            elif BANNED.search(text):
                faults.append(f"{place}: says {BANNED.search(text).group(0)!r}: {text[:70]}")
            elif torn is not None:
                faults.append(f"{path.relative_to(ROOT)}:{line + torn}: a torn line: {block[torn].strip()[:70]}")
    if asked.draw:
        for place, block in random.Random(asked.seed).sample(comments, min(asked.draw, len(comments))):
            print(place, *block, sep="\n   ")
        return 0
    print(*faults, sep="\n")
    print(f"{len(faults)} of {len(comments)} comments have to be rewritten.")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
