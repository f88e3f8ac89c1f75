#!/usr/bin/env python3
"""The shipped studies and what they come to.

    tools/studies.py --list                     every study with its cost, what the tests do with it, and the sums
    tools/studies.py --check [NAME...]          runs the studies and compares what they come to with expected.toml
    tools/studies.py --quick [NAME...]          checks what takes seconds: run by the tests
    tools/studies.py --renew [NAME...]          runs the studies, writes expected.toml and the block of README.md anew
    tools/studies.py --readme [NAME...]         writes the blocks alone, from expected.toml
    ... --data                                  with --renew: first writes the data that our own model computes anew

NAME is a folder of studies/ or one study file of it, race_tire or tire_a/five.toml. --latsch FILE names the program, by
default build/release/bin/latsch. Studies run in a copy: no journal, report or datum of studies/ is touched but by --renew.

Every study file below studies/ is in the expected.toml of its folder or of one above. It holds, for every study file:

    ["study.toml"]
    quick = "run"               # what --quick does: run the study, or one trial at the values found ("trial"), or "none"
    cpu_seconds = 17.2          # processor time of a run, as last renewed
    trial_seconds = 0.4         # processor time of one trial
    steps = 4                   # of the optimizer
    target = 0.001263
    tolerance = {target = 0.01, values = 0.02, errors = 0.02}     # relative; errors besides by 1e-5 of the measured
    reason = "why these tolerances"
    truth = {belt = "5 GPa"}    # of a twin: its data have a target below 1e-8 there
    needs = "ccx"               # a program that has to be there, or the study is skipped
    search = false              # nothing is fitted: the values are written by hand, a check is one trial there
    no_run = "why"              # no run has given the numbers yet: --quick says so and tries those that are there, --check fails
    ["study.toml".values]       # found, and the ends of the 95 % interval where there is one
    sidewall = {value = 75.0, unit = "N/mm^2", lower = 51.0, upper = 108.0}
    ["study.toml".errors]       # by experiment: mean and largest, in its own measure
    radius_83 = {mean = 0.0326, largest = 0.058, fitted = true}

or, where no search finds the result but another command of latsch prints it:

    ["comparison.toml"]
    command = ["compare", "comparison.toml"]                      # in the folder; --json is added
    keep = ["tires.*_error.*"]  # which numbers of the result, as in a file name; a list's items go by their names
    after = ["fits/ring.toml"]  # studies that have to be run before
    quick = "none"
    tolerance = {results = 0.02}
    reason = "why this tolerance"
    ["comparison.toml".results]
    "tires.ring.time_error.Fx" = 0.085

and, where our own model computed what is measured, how:

    [data]
    command = ["{latsch}", "export", "study.toml", "--measurements"]       # in the folder
    files = ["stiffness.csv", "modes.csv"]
    also = ["mode_shapes.csv"]  # written, not compared: the sign of a shape is free
    tolerance = 1e-6            # relative, of every number

A README quotes a number outside of its block by naming it, and it is written and checked, too: tools/study_figures.py.

Numbers of runs are written by --renew; quick, tolerance, reason, truth, needs, search, no_run, command, keep, after and
[data] by hand, and kept; --renew removes no_run. Two --renew at once in one folder keep each other's results; of one
study the second is refused (tools/study_locks.py). Values and errors are those of one run that began without a journal, at
full digits: a trial at rounded values, or the end of a second run, is another result.
"""
import argparse
import contextlib
import fnmatch
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import tomllib

from study_figures import NoFigure, differing_figures, with_figures
from study_locks import being_run, being_written
from study_tables import BEGIN, END, LITTLE, block_of

TREE = pathlib.Path(__file__).resolve().parents[1]
STUDIES = TREE / "studies"
MOST_AT_THE_TRUTH = 1e-8
HEAD = """\
# What the studies of this folder come to. tools/studies.py checks it, renews the numbers and writes the block of README.md
# from them; quick, tolerance, reason, truth and [data] are written by hand. See the head of tools/studies.py.
"""


class Wrong(Exception):
    """Raised if a study cannot be run or its expected results cannot be read."""


# --- files ---

def folder_of(name):
    """Returns the folder whose expected.toml contains the study: the folder of the study file, or one above it."""
    if not name.endswith(".toml"):
        return STUDIES / name
    above = [one for one in (STUDIES / name).parents if STUDIES in one.parents]
    return next((one for one in above if (one / "expected.toml").exists()), above[0])


def expected_files(names):
    """Returns the expected.toml of the named folders, or of all folders."""
    folders = sorted({folder_of(name) for name in names} if names else {file.parent for file in STUDIES.rglob("expected.toml")})
    for folder in folders:
        if not (folder / "expected.toml").exists():
            raise Wrong(f"{folder.relative_to(TREE)} has no expected.toml")
    return [folder / "expected.toml" for folder in folders]


def chosen(names, folder, study):
    """Returns whether a study file of the folder is among the names."""
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
        compared = ["results"] if "command" in entry else ["target", "values", "errors"]
        if not entry.get("reason") or set(entry.get("tolerance", {})) != set(compared):
            raise Wrong(f"{file.relative_to(TREE)}: {study} needs tolerance = {{{', '.join(compared)}}} and a reason")
        if "command" in entry and (not entry.get("keep") or entry["quick"] == "trial"):
            raise Wrong(f"{file.relative_to(TREE)}: {study} has a command, so it needs keep, and has no trials")
    return content


def is_renewed(entry):
    """Returns whether the numbers of the entry come from a run, or from a trial if the study searches nothing."""
    return "results" in entry or "target" in entry and ("cpu_seconds" in entry or not entry.get("search", True))


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
            if key not in ("values", "errors", "results"):
                text += f"{key} = {literal(value)}\n"
        for key in ("values", "errors", "results"):
            if key in entry:
                text += f"\n[{json.dumps(name)}.{key}]\n"
                text += "".join(f"{one if re.fullmatch(r'[A-Za-z0-9_-]+', one) else json.dumps(one)} = {literal(value)}\n"
                                for one, value in entry[key].items())
    # in one step, so that a process that reads meanwhile never finds half of it
    new = file.with_name(f".{file.name}.{os.getpid()}")
    new.write_text(text)
    os.replace(new, file)


def is_study(content):
    """Returns whether a file below studies/ is run for a result: a fit, a comparison, a suite of checks, or
    recordings of a rig."""
    if "experiment" in content:
        return set(content.get("variable", {})) != {"none"}  # a study with no variable writes measurements
    return "check" in content or "channels" in content and bool({"tire", "model"} & set(content)) or {"run", "hammer"} <= set(content)


def without_results():
    """Returns in words every study that is in no expected.toml or has no numbers of a run."""
    wrong = []
    for file in sorted(STUDIES.rglob("*.toml")):
        with open(file, "rb") as stream:
            content = tomllib.load(stream)
        if file.name == "expected.toml":
            wrong += [f"{file.relative_to(TREE)}: the numbers of {study} are not those of a run: tools/studies.py --renew"
                      for study, entry in content.items() if study != "data" and not is_renewed(entry) and "no_run" not in entry]
        elif is_study(content):
            expected = folder_of(str(file.relative_to(STUDIES))) / "expected.toml"
            if not expected.exists() or str(file.relative_to(expected.parent)) not in read(expected):
                wrong.append(f"{file.relative_to(TREE)} is a study of which no expected.toml speaks (tools/studies.py)")
    return wrong


# --- running ---

def copy_of_studies(folder):
    """Copies studies/ without journals and reports into a folder, and the rest of the tree that scripts of the
    studies need."""
    shutil.copytree(STUDIES, folder / "studies", ignore=shutil.ignore_patterns("*.latsch*", "*.html", "*.scratch"))
    return folder / "studies"


def answer(latsch, *words, folder=None):
    """Returns the result and the CPU seconds of `latsch WORDS --json`, run in a folder."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([latsch, *map(str, words), "--json"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True)
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
    """Returns the target and the errors by experiment of one trial. `values` has the variables' values as text with
    units."""
    words = [word for name, value in values.items() for word in ("--set", f"{name}={value}")]
    result, seconds = answer(latsch, "simulate", study, *words)
    errors = {one["name"]: {"mean": one["mean_error"], "largest": one["largest_error"], "fitted": one["fitted"]}
              for one in result["experiments"]}
    return {"trial_seconds": round(seconds, 1), "target": result["target"], "errors": errors}


def trial_there(latsch, study, entry):
    """Runs one trial at the values of the variables in expected.toml and returns its results."""
    return trial(latsch, study, {name: quantity(value) for name, value in entry["values"].items()})


def numbers_of(value, name=""):
    """Returns every number of a result by its path, with its unit; items of a list are named by their name or
    channel."""
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return {name: value}
    numbers = {}
    if isinstance(value, dict):
        for key, one in value.items():
            labels = value.get("channels") if isinstance(one, list) else None
            if labels and len(labels) == len(one) and all(isinstance(item, float) for item in one):
                one = dict(zip(labels, one))
            unit = value.get("unit") if isinstance(one, float) else None
            word = f"{key} [{unit}]" if unit not in (None, "", "1") else key
            numbers |= numbers_of(one, f"{name}.{word}" if name else word)
    elif isinstance(value, list):
        for i, one in enumerate(value):
            own = next((one[key] for key in ("name", "check") if key in one), i) if isinstance(one, dict) else i
            numbers |= numbers_of(one, f"{name}.{own}")
    return numbers


def results(latsch, folder, entry):
    """Returns those numbers of a command's JSON output that the entry in expected.toml contains."""
    for study in entry.get("after", []):
        if not (folder / study).with_suffix(".latsch").exists():  # a second run would continue the first
            answer(latsch, "run", folder / study)
    result, seconds = answer(latsch, *entry["command"], folder=folder)
    numbers, kept = numbers_of(result), {}
    for pattern in entry["keep"]:
        named = {name: value for name, value in numbers.items() if fnmatch.fnmatchcase(name, pattern)}
        if not named:
            raise Wrong(f"latsch {' '.join(entry['command'])}: no number is called {pattern}")
        kept |= named
    return {"cpu_seconds": round(seconds, 1), "results": kept}


def quantity(value):
    return f"{value['value']:.15g} {value['unit']}" if value["unit"] not in ("", "1") else f"{value['value']:.15g}"


def run(latsch, study):
    """Runs a study, which must have no journal yet, and one further trial at the fitted values; returns the results
    of the run and the errors of that trial."""
    result, seconds = answer(latsch, "run", study)
    values = {}
    for row in result["variables"]:
        values[row["name"]] = {"value": row["value"], "unit": row["unit"]}
        for key, end in zip(("lower", "upper"), row.get("interval", [])):
            if end is not None:
                values[row["name"]][key] = end
    found = trial(latsch, study, {name: quantity(value) for name, value in values.items()})
    return {"cpu_seconds": round(seconds, 1), "trial_seconds": found["trial_seconds"], "steps": result["steps"],
            "target": result["target"], "values": values, "errors": found["errors"]}


# --- comparing ---

def off(found, expected, relative, absolute=0.0):
    """Returns whether a number differs by more than the tolerance. Two missing numbers are equal."""
    if found is None or expected is None:
        return (found is None) != (expected is None)
    return abs(found - expected) > relative * abs(expected) + absolute


def differences(entry, found):
    """Returns in words every result of a run or a trial that differs from the expected one."""
    tolerance, wrong = entry["tolerance"], []
    if "results" in entry:
        return differences_of_results(entry["results"], found["results"], tolerance["results"])
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


def differences_of_results(expected, found, tolerance):
    wrong = [f"{name} is {'not printed' if name not in found else f'{found[name]:.6g}'}, expected {value:.6g} within "
             f"{tolerance:g} of it" for name, value in expected.items() if name not in found or off(found[name], value, tolerance, 1e-9)]
    more = set(found) - set(expected)
    return wrong + (["numbers that expected.toml does not know: " + ", ".join(sorted(more))] if more else [])


NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?")


def changed_numbers(old, new, tolerance):
    """Returns how many numbers of two files differ; if other words of the files differ, all numbers count as
    different."""
    if NUMBER.sub("#", old) != NUMBER.sub("#", new):
        return max(1, len(NUMBER.findall(new)))
    pairs = zip(NUMBER.findall(old), NUMBER.findall(new))
    scale = max((abs(float(one)) for one in NUMBER.findall(old)), default=1.0)
    return sum(abs(float(a) - float(b)) > tolerance * max(abs(float(a)), 1e-6 * scale) for a, b in pairs)


def computed_data(latsch, folder, data):
    """Computes the data of a folder again, in a copy."""
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

def readme_with(text, block, name):
    if BEGIN not in text or END not in text:
        raise Wrong(f"{name} has no block between {BEGIN} and {END}")
    head, rest = text.split(BEGIN, 1)
    return head + block + rest.split(END, 1)[1]


def readme_differences(folder, content):
    file = folder / "README.md"
    text = file.read_text()
    wrong = []
    if readme_with(text, block_of(content), file.relative_to(TREE)) != text:
        wrong.append(f"the block of {file.relative_to(TREE)} is not what expected.toml says")
    try:
        wrong += [f"{file.relative_to(TREE)}: {one}" for one in differing_figures(text, content)]
    except NoFigure as error:
        return [*wrong, f"{file.relative_to(TREE)}: {error}"]
    return [f"{one}; write it: tools/studies.py --readme {folder.relative_to(STUDIES)}" for one in wrong]


# --- commands ---

def check(latsch, names, quick):
    """Checks the named studies. Returns 1 if any result differs from the expected one."""
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
                    if quick and "no_run" in entry:
                        print(f"{folder.relative_to(STUDIES)}/{study}: no run has given its numbers yet: {entry['no_run']}")
                        if "target" not in entry:
                            continue
                    steps.append((study, lambda s=study, e=entry: study_check(latsch, place, s, e, quick)))
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


def study_check(latsch, folder, study, entry, quick):
    wrong = []
    if not is_renewed(entry) and not (quick and "no_run" in entry):
        return ["its numbers are not those of a run: tools/studies.py --renew"]
    if "truth" in entry:
        target = trial(latsch, folder / study, entry["truth"])["target"]
        if not target < MOST_AT_THE_TRUTH:
            wrong.append(f"the target at the truth is {target:.3g}, expected below {MOST_AT_THE_TRUTH:g}: the data are of "
                         "another model; renew them: tools/studies.py --renew --data")
    if not quick or entry["quick"] == "run":
        return wrong + differences(entry, computed(latsch, folder, study, entry))
    if entry["quick"] == "trial":
        return wrong + differences(entry, trial_there(latsch, folder / study, entry))
    return wrong


def computed(latsch, folder, study, entry):
    """Returns all numbers of an entry: from its command, from one trial, or from a run from the beginning."""
    if "command" in entry:
        return results(latsch, folder, entry)
    if not entry.get("search", True):
        return trial_there(latsch, folder / study, entry)
    return run(latsch, folder / study)


def renew(latsch, names, with_data):
    for file in expected_files(names):
        folder, content = file.parent, read(file)
        asked = [study for study in content if study != "data" and chosen(names, folder, study)]
        # data count for every study of the folder, so none of them may run while data are written
        locked = [study for study in content if study != "data"] if with_data and "data" in content else asked
        with contextlib.ExitStack() as locks, tempfile.TemporaryDirectory() as scratch:
            for study in locked:
                locks.enter_context(being_run(folder / study, f"{folder.relative_to(STUDIES)}/{study}", Wrong))
            studies = copy_of_studies(pathlib.Path(scratch))
            place = studies / folder.relative_to(STUDIES)
            if with_data and "data" in content:
                computed_data(latsch, place, content["data"])
                for pattern in [*content["data"]["files"], *content["data"].get("also", [])]:
                    for one in place.glob(pattern):
                        shutil.copyfile(one, folder / one.relative_to(place))
            for study in asked:
                # written after each study, so that results remain if a later one fails or is interrupted
                keep_results(file, study, computed(latsch, place, study, content[study]))
    return 0


def keep_results(file, study, found):
    """Writes the results of a study. Whatever else has changed in expected.toml since the run began remains: results
    of other studies by other processes, and what people wrote."""
    folder = file.parent
    with being_written(folder, str(folder.relative_to(STUDIES))):
        content = read(file)
        if study not in content:
            raise Wrong(f"{file.relative_to(TREE)} has no [{json.dumps(study)}] any more: its results are not written")
        content[study].update(found)
        content[study].pop("no_run", None)
        write(file, content)
        write_readme(folder, content)
    target = f"target {found['target']:.6g}, " if "target" in found else ""
    print(f"{folder.relative_to(STUDIES)}/{study}: {target}{seconds_of(content[study])} s", flush=True)


def write_readme(folder, content):
    file = folder / "README.md"
    name = file.relative_to(TREE)
    try:
        file.write_text(with_figures(readme_with(file.read_text(), block_of(content), name), content))
    except NoFigure as error:
        raise Wrong(f"{name}: {error}") from None


def seconds_of(entry, quick=False):
    """Returns the processor time of a check as last measured; None if it was not measured."""
    if quick and entry["quick"] == "none":
        return 0.0
    of_trial = not entry.get("search", True) or quick and entry["quick"] == "trial"
    return entry.get("trial_seconds" if of_trial else "cpu_seconds")


def entries(names):
    """Returns pairs of a study's name below studies/ and its entry in expected.toml."""
    return [(str(file.parent.relative_to(STUDIES) / study), entry) for file in expected_files(names)
            for study, entry in read(file).items() if study != "data"]


def sums(named):
    """Returns in words the processor time of all checks and of those that the tests run."""
    whole, quick = (sum(seconds_of(entry, how) or 0.0 for _, entry in named) for how in (False, True))
    untimed = sum("no_run" in entry for _, entry in named)
    more = f", without {untimed} that no run has timed yet" if untimed else ""
    return (f"{len(named)} studies: --check takes {whole / 60:.0f} minutes of processor time{more}, "
            f"--quick, which the tests run, {quick / 60:.1f} minutes.")


def list_all(names):
    quick = {"run": "run by the tests", "trial": "one trial by the tests", "none": "not by the tests"}
    named = entries(names)
    for name, entry in named:
        costs = [f"{seconds:8.1f} s" if seconds is not None else "not timed" for seconds in (seconds_of(entry), seconds_of(entry, True))]
        print(f"{name:44} {costs[0]:>11} {costs[1]:>11}  {'no run yet' if 'no_run' in entry else quick[entry['quick']]}")
    print(sums(named))
    return 0


def main():
    try:
        epilog = sums(entries([]))
    except (Wrong, tomllib.TOMLDecodeError):
        epilog = None  # the message of a wrong command line states what is wrong
    parser = argparse.ArgumentParser(description=__doc__, epilog=epilog, formatter_class=argparse.RawDescriptionHelpFormatter)
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
                with being_written(file.parent, str(file.parent.relative_to(STUDIES))):
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
