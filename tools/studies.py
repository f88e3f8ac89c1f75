#!/usr/bin/env python3
"""The shipped studies and what they come to.

    tools/studies.py --list                     every study with its cost and what the tests do with it
    tools/studies.py --check [NAME...]          runs the studies and compares what they come to with expected.toml
    tools/studies.py --quick [NAME...]          checks what takes seconds: run by the tests
    tools/studies.py --renew [NAME...]          runs the studies, writes expected.toml and the block of README.md anew
    tools/studies.py --readme [NAME...]         writes the blocks alone, from expected.toml
    ... --data                                  with --renew: first writes the data that our own model computes anew

NAME is a folder of studies/ or one study file of it, race_tire or tire_a/five.toml. --latsch FILE names the program, by
default build/release/bin/latsch. Studies run in a copy: no journal, report or datum of studies/ is touched but by --renew.

Every folder of studies/ with a study.toml has an expected.toml. It holds, for every study file:

    ["study.toml"]
    quick = "run"               # what --quick does: run the study, or one trial at the values found ("trial"), or "none"
    cpu_seconds = 17.2          # of a run, as last renewed
    steps = 4                   # of the optimizer
    target = 0.001263
    tolerance = {target = 0.01, values = 0.02, errors = 0.02}     # relative; errors besides by 1e-5 of the measured
    reason = "why these tolerances"
    truth = {belt = "5 GPa"}    # of a twin: its data have a target below 1e-8 there
    needs = "ccx"               # a program that has to be there, or the study is skipped
    ["study.toml".values]       # found, and the ends of the 95 % interval where there is one
    sidewall = {value = 75.0, unit = "N/mm^2", lower = 51.0, upper = 108.0}
    ["study.toml".errors]       # by experiment: mean and largest, in its own measure
    radius_83 = {mean = 0.0326, largest = 0.058, fitted = true}

and, where our own model computed what is measured, how:

    [data]
    command = ["{latsch}", "export", "study.toml", "--measurements"]       # in the folder
    files = ["stiffness.csv", "modes.csv"]
    also = ["mode_shapes.csv"]  # written, not compared: the sign of a shape is free
    tolerance = 1e-6            # relative, of every number

Numbers of runs are written by --renew; quick, tolerance, reason, truth, needs and [data] by hand, and kept.
"""
import argparse
import json
import math
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import tomllib

TREE = pathlib.Path(__file__).resolve().parents[1]
STUDIES = TREE / "studies"
BEGIN, END = "<!-- tools/studies.py: begin -->", "<!-- tools/studies.py: end -->"
MOST_AT_THE_TRUTH = 1e-8
MOST_ROWS = 24  # rows of a table in a README
LITTLE = 1e-5  # share of the measured value: smaller errors are rounding
HEAD = """\
# What the studies of this folder come to. tools/studies.py checks it, renews the numbers and writes the block of README.md
# from them; quick, tolerance, reason, truth and [data] are written by hand. See the head of tools/studies.py.
"""


class Wrong(Exception):
    """A study that cannot be run, or whose expected results cannot be read."""


# --- files ---

def expected_files(names):
    """expected.toml of the folders named, or of all."""
    folders = sorted({(STUDIES / name).parent if name.endswith(".toml") else STUDIES / name for name in names}
                     if names else {file.parent for file in STUDIES.rglob("expected.toml")})
    for folder in folders:
        if not (folder / "expected.toml").exists():
            raise Wrong(f"{folder.relative_to(TREE)} has no expected.toml")
    return [folder / "expected.toml" for folder in folders]


def chosen(names, folder, study):
    """Whether a study file of the folder is among what was named."""
    place = folder.relative_to(STUDIES)
    return not names or str(place) in names or str(place / study) in names


def read(file):
    with open(file, "rb") as stream:
        content = tomllib.load(stream)
    for study, entry in content.items():
        if study == "data":
            continue
        if not study.endswith(".toml") or not (file.parent / study).exists():
            raise Wrong(f"{file.relative_to(TREE)}: there is no study file \"{study}\"")
        if entry.get("quick") not in ("run", "trial", "none"):
            raise Wrong(f"{file.relative_to(TREE)}: {study} has quick = {entry.get('quick')!r}, "
                        "expected \"run\", \"trial\" or \"none\"")
        if not entry.get("reason") or set(entry.get("tolerance", {})) != {"target", "values", "errors"}:
            raise Wrong(f"{file.relative_to(TREE)}: {study} needs tolerance = {{target, values, errors}} and a reason")
    return content


def literal(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return f"{value:.6g}" if isinstance(value, float) else str(value)
    if isinstance(value, list):
        return "[" + ", ".join(literal(one) for one in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {literal(one)}" for key, one in value.items()) + "}"
    return json.dumps(value, ensure_ascii=False)


def write(file, content):
    text = HEAD
    for name, entry in content.items():
        text += f"\n[{json.dumps(name) if '.' in name else name}]\n"
        for key, value in entry.items():
            if key not in ("values", "errors"):
                text += f"{key} = {literal(value)}\n"
        for key in ("values", "errors"):
            if key in entry:
                text += f"\n[{json.dumps(name)}.{key}]\n"
                text += "".join(f"{one} = {literal(value)}\n" for one, value in entry[key].items())
    file.write_text(text)


# --- running ---

def copy_of_studies(folder):
    """studies/ without journals and reports, below a folder; its tree besides, for scripts that look for it."""
    shutil.copytree(STUDIES, folder / "studies", ignore=shutil.ignore_patterns("*.latsch*", "*.html", "*.scratch"))
    return folder / "studies"


def answer(latsch, *words):
    """The result and the CPU seconds of `latsch WORDS --json`."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([latsch, *map(str, words), "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    try:
        content = json.loads(done.stdout)
    except json.JSONDecodeError:
        raise Wrong(f"latsch {' '.join(map(str, words))}: {done.stderr.strip() or 'no answer'}") from None
    if done.returncode != 0 or "result" not in content:
        raise Wrong(f"latsch {' '.join(map(str, words))}: {content.get('error', content)}")
    return content["result"], seconds


def trial(latsch, study, values):
    """Target and errors by experiment of one trial; values: quantities in words by variable."""
    words = [word for name, value in values.items() for word in ("--set", f"{name}={value}")]
    result, _ = answer(latsch, "simulate", study, *words)
    errors = {one["name"]: {"mean": one["mean_error"], "largest": one["largest_error"], "fitted": one["fitted"]}
              for one in result["experiments"]}
    return {"target": result["target"], "errors": errors}


def quantity(value):
    return f"{value['value']:.15g} {value['unit']}" if value["unit"] not in ("", "1") else f"{value['value']:.15g}"


def run(latsch, study):
    """All that a run comes to, and one trial there for the errors."""
    result, seconds = answer(latsch, "run", study)
    values = {}
    for row in result["variables"]:
        values[row["name"]] = {"value": row["value"], "unit": row["unit"]}
        for key, end in zip(("lower", "upper"), row.get("interval", [])):
            if end is not None:
                values[row["name"]][key] = end
    found = trial(latsch, study, {name: quantity(value) for name, value in values.items()})
    return {"cpu_seconds": round(seconds, 1), "steps": result["steps"], "target": result["target"], "values": values,
            "errors": found["errors"]}


# --- comparing ---

def off(found, expected, relative, absolute=0.0):
    """Whether a number is farther off than it may be; none and none are alike."""
    if found is None or expected is None:
        return (found is None) != (expected is None)
    return abs(found - expected) > relative * abs(expected) + absolute


def differences(entry, found):
    """In words, everything of a run or a trial that is not as expected."""
    tolerance, wrong = entry["tolerance"], []
    if off(found["target"], entry["target"], tolerance["target"], 1e-10):
        wrong.append(f"target {found['target']:.6g}, expected {entry['target']:.6g} within {tolerance['target']:g} of it")
    for name, expected in entry.get("values", {}).items():
        if "values" not in found:
            break
        value = found["values"].get(name)
        if value is None:
            wrong.append(f"no variable {name}")
        elif off(value["value"], expected["value"], tolerance["values"]):
            wrong.append(f"{name} {value['value']:.6g} {value['unit']}, expected {expected['value']:.6g} within "
                         f"{tolerance['values']:g} of it")
    for name, expected in entry.get("errors", {}).items():
        error = found["errors"].get(name)
        if error is None:
            wrong.append(f"no experiment {name}")
        elif off(error["mean"], expected["mean"], tolerance["errors"], LITTLE):
            wrong.append(f"mean error of {name} {error['mean']:.4g}, expected {expected['mean']:.4g} within "
                         f"{tolerance['errors']:g} of it")
    more = set(found["errors"]) - set(entry.get("errors", {}))
    if more:
        wrong.append("experiments that expected.toml does not know: " + ", ".join(sorted(more)))
    return wrong


NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")


def changed_numbers(old, new, tolerance):
    """How many numbers of two files differ; all of them where words do."""
    if NUMBER.sub("#", old) != NUMBER.sub("#", new):
        return max(1, len(NUMBER.findall(new)))
    pairs = zip(NUMBER.findall(old), NUMBER.findall(new))
    scale = max((abs(float(one)) for one in NUMBER.findall(old)), default=1.0)
    return sum(abs(float(a) - float(b)) > tolerance * max(abs(float(a)), 1e-6 * scale) for a, b in pairs)


def computed_data(latsch, folder, data):
    """Computes the data of a folder, in a copy, anew."""
    command = [word.replace("{latsch}", str(latsch)) for word in data["command"]]
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise Wrong(f"{' '.join(command)}: {done.stdout.strip()}")


def data_differences(folder, computed, data):
    wrong = []
    for pattern in data["files"]:
        for file in sorted(folder.glob(pattern)):
            other = computed / file.relative_to(folder)
            count = changed_numbers(file.read_text(), other.read_text(), data["tolerance"])
            if count:
                wrong.append(f"{count} numbers of {file.relative_to(STUDIES)} are not what the model computes today; "
                             "renew them: tools/studies.py --renew --data " + str(folder.relative_to(STUDIES)))
    return wrong


# --- README ---

def figure(value, digits=3):
    if value is None:
        return "–"
    return "0" if value == 0 else f"{value:.{digits}g}"


def percent(value):
    if value is None:
        return "–"
    return "below 0.001 %" if abs(value) < LITTLE else f"{100 * value:.3g} %"


def with_unit(value):
    return figure(value["value"], 4) + ("" if value["unit"] in ("", "1") else f" {value['unit']}")


def variables_of(entry):
    """A table, of many one line."""
    values = entry["values"]
    if len(values) > MOST_ROWS:
        two_sided = sum("lower" in value and "upper" in value for value in values.values())
        return [f"{len(values)} variables, {two_sided} of them with two ends of their 95 % interval: `expected.toml`."]
    lines = ["| variable | found | 95 % |", "| --- | --- | --- |"]
    for name, value in values.items():
        ends = "–"
        if "lower" in value or "upper" in value:
            ends = f"{figure(value.get('lower'), 4)} .. {figure(value.get('upper'), 4)}"
        lines.append(f"| {name} | {with_unit(value)} | {ends} |")
    return lines


def errors_of(entry):
    """A table, of many experiments two lines."""
    lines = ["| experiment | | mean error | largest |", "| --- | --- | --- | --- |"]
    for fitted, how in ((True, "fitted"), (False, "predicted")):
        errors = {name: error for name, error in entry["errors"].items() if error["fitted"] == fitted}
        if len(entry["errors"]) > MOST_ROWS and errors:
            means = sorted(errors, key=lambda name: errors[name]["mean"] or 0.0)
            lines.append(f"| {len(errors)}, the median | {how} | {percent(errors[means[len(means) // 2]]['mean'])} | |")
            lines.append(f"| the worst, {means[-1]} | {how} | {percent(errors[means[-1]]['mean'])} | |")
        elif errors:
            lines += [f"| {name} | {how} | {percent(error['mean'])} | {percent(error['largest'])} |"
                      for name, error in errors.items()]
    return lines


def table_of(study, entry):
    cost = f", {entry['cpu_seconds']:.3g} s of processor time" if "cpu_seconds" in entry else ""
    how = f"in {entry['steps']} steps" if "steps" in entry else "of one trial at these values"
    return [f"`{study}`: target {figure(entry['target'])} {how}{cost}.", "", *variables_of(entry), "", *errors_of(entry)]


def block_of(content):
    lines = [BEGIN]
    for study, entry in content.items():
        if study != "data" and "target" in entry:
            lines += [*table_of(study, entry), ""]
    return "\n".join(lines[:-1] + [END]) if len(lines) > 1 else BEGIN + "\n" + END


def readme_with(text, block, name):
    if BEGIN not in text or END not in text:
        raise Wrong(f"{name} has no block between {BEGIN} and {END}")
    head, rest = text.split(BEGIN, 1)
    return head + block + rest.split(END, 1)[1]


def readme_differences(folder, content):
    file = folder / "README.md"
    text = file.read_text()
    if readme_with(text, block_of(content), file.relative_to(TREE)) != text:
        return [f"the block of {file.relative_to(TREE)} is not what expected.toml says; write it: tools/studies.py --readme "
                + str(folder.relative_to(STUDIES))]
    return []


# --- commands ---

def check(latsch, names, quick):
    """Exit code 1 where anything is not as expected."""
    wrong_ones = 0
    with tempfile.TemporaryDirectory() as scratch:
        studies = copy_of_studies(pathlib.Path(scratch))
        for file in expected_files(names):
            folder, content = file.parent, read(file)
            place = studies / folder.relative_to(STUDIES)
            steps = [("README.md", lambda: readme_differences(folder, content))]
            for study, entry in content.items():
                if study == "data":
                    if not quick:
                        steps.append(("data", lambda data=entry: data_check(latsch, folder, place, data)))
                elif not shutil.which(entry.get("needs", "sh")):
                    print(f"{folder.relative_to(STUDIES)}/{study}: skipped, there is no {entry['needs']}")
                elif chosen(names, folder, study):
                    steps.append((study, lambda s=study, e=entry: study_check(latsch, place / s, e, quick)))
            for what, ask in steps:
                name = f"{folder.relative_to(STUDIES)}/{what}"
                try:
                    wrong = ask()
                except Wrong as error:
                    wrong = [str(error)]
                print(f"{name}: " + ("as expected" if not wrong else "NOT as expected"), flush=True)
                for one in wrong:
                    print(f"  {one}", flush=True)
                wrong_ones += bool(wrong)
    return 1 if wrong_ones else 0


def data_check(latsch, folder, place, data):
    with tempfile.TemporaryDirectory() as scratch:
        computed = copy_of_studies(pathlib.Path(scratch)) / folder.relative_to(STUDIES)
        computed_data(latsch, computed, data)
        return data_differences(folder, computed, data)


def study_check(latsch, study, entry, quick):
    wrong = []
    if "target" not in entry:
        return ["nothing is expected of it yet: tools/studies.py --renew"]
    if "truth" in entry:
        target = trial(latsch, study, entry["truth"])["target"]
        if not target < MOST_AT_THE_TRUTH:
            wrong.append(f"the target at the truth is {target:.3g}, expected below {MOST_AT_THE_TRUTH:g}: the data are of "
                         "another model; renew them: tools/studies.py --renew --data")
    if not quick or entry["quick"] == "run":
        return wrong + differences(entry, run(latsch, study))
    if entry["quick"] == "trial":
        found = trial(latsch, study, {name: quantity(value) for name, value in entry["values"].items()})
        return wrong + differences(entry, found)
    return wrong


def renew(latsch, names, with_data):
    for file in expected_files(names):
        folder, content = file.parent, read(file)
        with tempfile.TemporaryDirectory() as scratch:
            studies = copy_of_studies(pathlib.Path(scratch))
            place = studies / folder.relative_to(STUDIES)
            if with_data and "data" in content:
                computed_data(latsch, place, content["data"])
                for pattern in [*content["data"]["files"], *content["data"].get("also", [])]:
                    for one in place.glob(pattern):
                        shutil.copyfile(one, folder / one.relative_to(place))
            for study in content:
                if study != "data" and chosen(names, folder, study):
                    content[study].update(run(latsch, place / study))
                    print(f"{folder.relative_to(STUDIES)}/{study}: target {content[study]['target']:.6g}, "
                          f"{content[study]['cpu_seconds']} s", flush=True)
                    write(file, content)  # also if a later study fails or is interrupted
                    write_readme(folder, read(file))
    return 0


def write_readme(folder, content):
    file = folder / "README.md"
    file.write_text(readme_with(file.read_text(), block_of(content), file.relative_to(TREE)))


def list_all(names):
    quick = {"run": "run by the tests", "trial": "one trial by the tests", "none": "not by the tests"}
    for file in expected_files(names):
        for study, entry in read(file).items():
            if study != "data":
                cost = f"{entry['cpu_seconds']:8.1f} s" if "cpu_seconds" in entry else "not timed"
                print(f"{str(file.parent.relative_to(STUDIES) / study):44} {cost:>11}  {quick[entry['quick']]}")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    action = parser.add_mutually_exclusive_group(required=True)
    for name in ("--list", "--check", "--quick", "--renew", "--readme"):
        action.add_argument(name, nargs="*", metavar="NAME")
    parser.add_argument("--data", action="store_true")
    parser.add_argument("--latsch", default=TREE / "build/release/bin/latsch", type=pathlib.Path)
    asked = parser.parse_args()
    latsch = asked.latsch.resolve()
    try:
        if asked.list is not None:
            return list_all(asked.list)
        if asked.readme is not None:
            for file in expected_files(asked.readme):
                write_readme(file.parent, read(file))
            return 0
        if not latsch.exists():
            raise Wrong(f"{latsch} does not exist: build it, or name it with --latsch")
        if asked.renew is not None:
            return renew(latsch, asked.renew, asked.data)
        return check(latsch, asked.check if asked.check is not None else asked.quick, asked.quick is not None)
    except (Wrong, tomllib.TOMLDecodeError) as error:
        print(f"tools/studies.py: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
