#!/usr/bin/env python3
"""docs/study_reference.md: all that may stand in a study, from the readers themselves.

    tools/study_reference.py           writes the page
    tools/study_reference.py --check   ends with 1 where the page is not what the readers say

Keys, what is expected of them and what holds unless they are given are taken from the calls that read them and that
write the error messages; the examples from the heads of their headers. So neither can be forgotten here.
"""
import pathlib
import re
import sys

TREE = pathlib.Path(__file__).resolve().parents[1]
FOLDER = TREE / "src" / "correlation"
TESTS = TREE / "src" / "experiment"
ROADS = TREE / "src" / "models" / "road"
PAGE = TREE / "docs" / "study_reference.md"

# Heading, and name of header and source. `latsch help study` omits headings of tests that its
# program does not have. If a reader of a study is missing here, the program ends with an error.
SECTIONS = [
    ("A study", "study"),
    ("model, [model], [test.NAME]", "specimens"),
    ("[simulator]: an outside program in the model's place", "simulator_settings"),
    ('Test "load_deflection": force over deflection', "load_deflection"),
    ('Test "modes": frequencies and shapes', "modes"),
    ('Test "drum_cleat": over a cleat on the drum', "drum_rig"),
    ('Test "slip_sweep": on a flat track', "slip_sweep"),
    ('Test "rolling_stiffness": slopes at free rolling', "rolling_stiffness"),
    ('Test "uniformity": forces that vary over a turn', "uniformity_rig"),
    ('Test "static_stiffness": of a standing tire', "static_stiffness"),
    ("pressure of a test", "rigs/inflation"),
    ('Test "inflation": dimensions under pressures', "tests/inflation"),
    ("[cleat] of a test", "cleat"),
    ('Test "footprint": contact patch on the ground', "footprint_rig"),
    ('Test "mass_properties": mass, moments of inertia', "mass_properties"),
    ('Test "steady_states": a table of states', "steady_states"),
    ('Test "slip_history": slips as recorded, lagging', "slip_history"),
    ('Test "kc": a corner under loads', "kc"),
    ("What a K&C rig states or has recorded, slopes over it", "kc_histories"),
    ('Test "kinematics": a corner and its axle as rigid links', "kinematics"),
    ('Test "four_post": a car on four posts', "four_post"),
    ('Test "axle_kc": both wheels of an axle under loads', "axle_kc"),
    ('Test "kerb": a car over a kerb or on a road', "tests/kerb"),
    ("[kerb] of a test, and roads in words", "road_reader"),
    ("[variable.NAME], [tie.NAME]", "variables"),
    ("[linear_constraint.NAME]", "linear_constraints"),
    ("[measurement.NAME]: what a laboratory recorded", "measurement"),
    ("[experiment.NAME]", "study_experiment"),
    ("[experiment.NAME] with kind = \"curve\"", "curve"),
    ("What of a curve is compared", "curve_comparison"),
    ("nuisance of a curve: the delay of its recording", "curve_delay"),
    ("[experiment.NAME] with kind = \"values\"", "values"),
    ("The noise of what was measured", "measurement_noise"),
    ("[constraint.NAME]: on channels", "channel_constraint"),
    ("[optimizer]", "study_optimizer"),
    ("[optimizer] start: where a search begins", "study_start"),
    ("[stage.NAME]: one fit after the other", "study_stages"),
    ("[refined]: what mesh and step make of the numbers", "refinement"),
    ("[doe]", "study_design"),
    ("[run]", "run_settings"),
    ("A suite: acceptance of a model", "suite"),
]
OTHER_ROOMS = {"rig_data", "comparison"}  # these rooms read files that are no studies
READ_AGAIN = {"plausibility"}  # looks at keys that other readers have read

FILE = re.compile(r"\bsource\.file\(\s*\w+,\s*\"([^\"]*)\"\s*\)")  # opens a file that a test names
SHARE = re.compile(r"\bread_share\(\s*\w+,\s*\"([a-z_]+)\",")
GETTER = re.compile(r"\b\w+(?:->|\.)(quantity|quantities|one_or_more|choice|integer|flag|texts?|rows)\(\s*(\w+|\"[^\"]*\")\s*([,)])")


def reader(name, ending):
    """A file of the folder, in whatever room; of a test without a header its source."""
    for file in (f"{name}.{ending}", f"{name}.cpp"):
        for folder in (FOLDER, TESTS, ROADS):
            for found in folder.rglob(file):
                return found
    sys.exit(f"tools/study_reference.py: there is no {name}.{ending}; mend SECTIONS")


def arguments(text, start):
    """The arguments of a call from behind its first one, split at commas of their own level."""
    parts, depth, begin, quoted = [], 0, start, False
    for i in range(start, len(text)):
        c = text[i]
        if c == '"' and text[i - 1] != "\\":
            quoted = not quoted
        if quoted:
            continue
        if c in "({":
            depth += 1
        elif c in ")}":
            if depth == 0:
                parts.append(text[begin:i])
                return [" ".join(part.split()) for part in parts if part.strip()]
            depth -= 1
        elif c == "," and depth == 0:
            parts.append(text[begin:i])
            begin = i + 1
    return parts


WORDS = {"1": "a plain number", "Pa": "a pressure or modulus", "m": "a length", "N": "a force", "s": "a time", "rad": "an angle",
         "Hz": "a frequency", "m/s": "a velocity"}
EXAMPLES = {"Pa": "2.6 bar", "m": "25 mm", "N": "4 kN", "s": "0.1 s", "rad": "22 deg", "Hz": "80 Hz", "m/s": "40 km/h"}


def constants(text):
    return dict(re.findall(r"constexpr \w+(?: \w+)* (k\w+) = ([\d.e+'_-]+);", text))


def literal(text, known):
    for name, value in known.items():
        text = re.sub(rf"\b{name}\b", value.replace("'", ""), text)
    return text


def unit_words(unit):
    if not unit.startswith('"'):
        return "a quantity in the unit of the number it belongs to"
    unit = unit.strip('"')
    word = WORDS.get(unit, f"a quantity in {unit}")
    return word + (f" such as `\"{EXAMPLES[unit]}\"`" if unit in EXAMPLES else "")


def range_words(text):
    if not text:
        return ""
    if text == "Range::positive()":
        return ", above 0"
    if text == "Range::not_negative()":
        return ", 0 or more"
    match = re.match(r"(?:Range::between\(|Range)?[{(]?\s*([\d.e-]+), ([\w.\->]+)(, true)?", text.removeprefix("Range::between("))
    if match and re.match(r"[\d.]", match[2]):
        return f", {'above ' if match[3] else ''}{float(match[1]):g} to {float(match[2]):g}"
    return ""


def fallback_words(text):
    if text is None:
        return ""
    if re.fullmatch(r"-?[\d.e+-]+|true|false|\"[^\"]*\"", text):
        return f"`{text}`"
    return "the program's own"


def described(kind, rest, known):
    """What is expected, what holds unless given."""
    rest = [literal(part, known) for part in rest]
    if kind in ("quantity", "quantities", "one_or_more"):
        unit, extra = rest[0] if rest else '"1"', rest[1] if len(rest) > 1 else ""
        words = unit_words(unit) + range_words(extra)
        many = {"quantities": "a list, each ", "one_or_more": "one or a list, each "}
        return many.get(kind, "") + words, rest[2] if len(rest) > 2 else None
    if kind == "integer":
        limits = [part for part in rest[:2]]
        shown = f" from {limits[0]} to {limits[1]}" if all(re.fullmatch(r"[\d']+", p) for p in limits) else ""
        return "an integer" + shown.replace("'", ""), rest[2] if len(rest) > 2 else None
    if kind == "choice":
        words = re.findall(r'"([^"]+)"', rest[0])
        return (", ".join(f"`\"{word}\"`" for word in words) if words else "one of the names above"), rest[1] if len(rest) > 1 else None
    if kind == "flag":
        return "`true` or `false`", rest[0] if rest else None
    if kind == "texts":
        return "a list of texts in quotes", None
    if kind == "rows":
        return "a list of rows", None
    return "a text in quotes", rest[0] if rest else None


def keys_of(source, of_optimizer=False):
    """Keys that a reader takes from its table, or from the table [optimizer] of a study, which it
    calls `optimizer`."""
    text = re.sub(r"//.*", "", source)
    known, found = constants(text), {}
    for match in GETTER.finditer(text):
        if match[0].startswith("optimizer->") != of_optimizer:
            continue
        kind, key, behind = match[1], match[2], match[3]
        if not key.startswith('"') or not re.fullmatch(r'"[a-z_A-Z]+"', key):
            continue
        rest = arguments(text, match.end()) if behind == "," else []
        expected, fallback = described(kind, rest, known)
        entry = found.setdefault(key.strip('"'), [])
        if (expected, fallback) not in entry:
            entry.append((expected, fallback))
    if of_optimizer:
        return found
    for match in SHARE.finditer(text):
        extra = range_words(arguments(text, match.end())[0])
        found.setdefault(match[1], []).append((f'a share such as `"3 %"`{extra}; without a unit at most 1', None))
    for match in FILE.finditer(text):
        found.setdefault(match[1], []).append(("the name of a file, beside the study or the test", None))
    return found


def head_of(header):
    """The comment a header begins with: prose, and examples indented by two blanks more."""
    lines = []
    for line in header.splitlines()[1:]:
        if not line.startswith("//"):
            break
        lines.append(line[2:].removeprefix(" "))
    return lines


def without_pointers(line):
    """A page for users names no headers."""
    header = r"(?:\w+/)*\w+\.h"
    line = re.sub(rf"\s*\({header}\)", "", line)
    line = re.sub(rf"see {header}; ", "", line)
    return re.sub(rf"[,:;]? ?(?:see )?{header}\b", "", line).rstrip()


def section(heading, name):
    lines, code = [f"## {heading}", ""], False
    for line in head_of(reader(name, "h").read_text()):
        indented = line.startswith("  ")
        if indented and not code:
            toml = re.match(r"  +(\[|[\w.]+ = )", line)
            lines += ([""] if lines[-1] else []) + ["```toml" if toml else "```"]
        if not indented and code and line:
            while not lines[-1]:
                lines.pop()
            lines += ["```", ""]
        code = indented or (code and not line)
        shown = without_pointers(line[2:] if code else line)
        if shown.startswith((":", ".", ";", ",")):  # behind the name of a header that was left out
            lines[-1] += shown
            continue
        lines.append(re.sub(r"#\s*$", "", shown).rstrip())
    while not lines[-1]:
        lines.pop()
    if code:
        lines.append("```")
    keys = keys_of(reader(name, "cpp").read_text())
    if name == "study_optimizer":
        keys |= keys_of(reader("study", "cpp").read_text(), of_optimizer=True)
    if keys:
        lines += ["", "| key | expected | unless given |", "| --- | --- | --- |"]
        for key, ways in keys.items():
            expected = "; or ".join(dict.fromkeys(way[0] for way in ways))
            fallback = " or ".join(dict.fromkeys(filter(None, (fallback_words(way[1]) for way in ways))))
            lines.append(f"| `{key}` | {expected} | {fallback} |")
    return "\n".join(lines) + "\n"


def expect_no_constants(text):
    """A name of the code, such as kFulfilled, says nothing to the reader of the page."""
    if names := re.findall(r"\bk[A-Z][a-z]{2,}\w*", text):
        sys.exit(f"tools/study_reference.py: the page names {', '.join(names)}; write the number into the header")


def page():
    listed = {name for _, name in SECTIONS}
    for file in sorted(FOLDER.rglob("*.cpp")):
        if file.stem.endswith("_test") or file.stem in listed | READ_AGAIN or file.parent.name in OTHER_ROOMS:
            continue
        if keys_of(file.read_text()):
            sys.exit(f"tools/study_reference.py: {file.stem}.cpp reads keys of a study, but is no section of the reference; "
                     "add it to SECTIONS")
    text = ("# What may stand in a study\n\nMade from the readers by `tools/study_reference.py`; `latsch help study` prints it. "
            "A study is a TOML file. Quantities are\ntexts with their unit, such as `\"2.6 bar\"`; any unit of the dimension will "
            "do. A key that is not known ends in an error that\nnames its line. `latsch new` writes a study to start from, "
            "`latsch check` says what it understood.\n\n")
    return text + "\n".join(section(*one) for one in SECTIONS)


def main():
    made = page()
    expect_no_constants(made)
    if sys.argv[1:] == ["--check"]:
        if not PAGE.exists() or PAGE.read_text() != made:
            sys.exit("docs/study_reference.md is not what the readers say: run tools/study_reference.py and look at what changed")
        return
    PAGE.write_text(made)


if __name__ == "__main__":
    main()
