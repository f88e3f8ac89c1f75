#!/usr/bin/env python3
"""Tests docs/schemas with an independent validator, Python's jsonschema (Debian's python3-jsonschema).

   tools/schemas_test.py PATH/TO/recorded_keys [--every N]

All TOML files of the repository and all samples of the reference have to be taken, and 27 of the 30 wrong files refused.
Good files are changed at one place and given to the program: what it takes, the schema has to take. A random one in N
of these changes is tried, the same ones in every run; without --every one in 400."""
import copy
import json
import random
import sys
import tempfile
import tomllib

import schema_corpus

try:
    import jsonschema
except ImportError:
    print("skipped: no validator is installed; the Debian package python3-jsonschema has one")
    sys.exit(77)

FOLDER = schema_corpus.ROOT / "docs" / "schemas"
LEAST_REFUSED = 27

TWIN, TIRE, RING = "studies/tire_b_twin/study.toml", "studies/tires/race_16x7.5-10.toml", "tools/schema_samples/ring_tire.toml"
DRUM, CORNER, CAR = "studies/cleat_fit/tests/slow.toml", "studies/compliance/corner.toml", "studies/four_post/baseline.toml"
RIG, TIRES, SUITE = "tools/schema_samples/rig.toml", "studies/tire_model_comparison/comparison.toml", "tools/schema_samples/suite.toml"

# Wrong files: what is wrong, the kind, the good file, the text there and what stands in its place. The program refuses
# them all. A schema cannot know the last three: a dimension, a name that the file does not define, two keys that exclude
# each other.
WRONG = [
    ("misspelled key", "study", TWIN, 'title = "Tire', 'titel = "Tire'),
    ("misspelled table", "study", TWIN, "[optimizer]", "[optimiser]"),
    ("text for an integer", "study", TWIN, "levels = 5", 'levels = "5"'),
    ("integer out of range", "study", TWIN, "workers = 2", "workers = 0"),
    ("wrong word", "study", TWIN, 'scale = "logarithmic"', 'scale = "log"'),
    ("flag for a quantity", "study", TWIN, 'lower = "6 N/mm^2"', "lower = true"),
    ("missing key", "study", TWIN, 'kind = "load_deflection"\n', ""),
    ("kind that does not exist", "study", TWIN, 'kind = "modes"', 'kind = "mode"'),
    ("key of another kind", "study", TWIN, 'shapes = "mode_shapes.csv"', 'x = "a/time"'),
    ("number without unit", "study", TWIN, 'timeout = "5 min"', "timeout = 300"),
    ("text for a list", "study", TWIN, 'paths = ["layer.belt_1.young_modulus", "layer.belt_2.young_modulus"]', 'paths = "layer.belt_1.young_modulus"'),
    ("table array for a table", "study", TWIN, "[doe]", "[[doe]]"),
    ("number without unit", "test", DRUM, 'speed = "30 km/h"', "speed = 30"),
    ("key of another kind", "test", DRUM, "passages = 3", "modes = 3"),
    ("missing key", "test", DRUM, 'drum_diameter = "2.5 m"\n', ""),
    ("quantity for a table", "test", DRUM, '[cleat]\nheight = "10 mm"\nlength = "20 mm"\nbevel = "3 mm"\nangle = "0 deg"\n', 'cleat = "10 mm"\n'),
    ("unit without number", "fe_tire", TIRE, 'pressure = "83 kPa"', 'pressure = "kPa"'),
    ("misspelled table", "fe_tire", TIRE, "[rubber.", "[rubbers."),
    ("fraction for an integer", "fe_tire", TIRE, "sectors = 60", "sectors = 60.5"),
    ("row of three columns", "fe_tire", TIRE, '[0.5, "2 mm"]', '[0.5, "2 mm", "3 mm"]'),
    ("misspelled key", "ring_tire", RING, "radius = ", "radus = "),
    ("share above 1", "ring_tire", RING, "pressure_share = 0.5", "pressure_share = 50"),
    ("numbers without unit", "suspension", CORNER, '["1510.800 mm", "527.786 mm", "350.000 mm"]', "[1510.8, 527.786, 350]"),
    ("missing table", "car", CAR, '[chassis]\nmass = "220 kg"\ncenter = ["0.75 m", "0 m", "0.28 m"]\ninertia_xx = "25 kg m^2"\ninertia_yy = "84 kg m^2"\ninertia_zz = "100 kg m^2"\n', ""),
    ("text for a list", "rig", RIG, 'speeds = ["30 km/h", "60 km/h"]', 'speeds = "30 km/h"'),
    ("text for a flag", "comparison", TIRES, "fitted = true", 'fitted = "yes"'),
    ("key that belongs to a study", "suite", SUITE, 'mean_error = "5 %"', 'mean_error = "5 %"\nweight = 2'),
    ("quantity of another dimension", "fe_tire", TIRE, 'pressure = "83 kPa"', 'pressure = "83 mm"'),
    ("name that the file does not define", "fe_tire", TIRE, 'rubber = "bead"', 'rubber = "apex"'),
    ("two keys that exclude each other", "ring_tire", RING, "shore_a = 70", 'shore_a = 70\nyoung_modulus = "5 MPa"'),
]

# Files in every form that the program takes: a byte order mark, keys in quotes, dotted keys and inline tables for
# tables, arrays of tables for tables with names, one unit for a list.
EDGES = [
    ("byte order mark", "test", DRUM, 'kind = "drum_cleat"', '\ufeffkind = "drum_cleat"'),
    ("keys in quotes", "test", DRUM, "speed = ", '"speed" = '),
    ("a table in quotes", "test", DRUM, "[cleat]", '["cleat"]'),
    ("dotted keys", "test", DRUM, 'passages = 3\nwheel_step = "1.2 deg"\n[cleat]\nheight = "10 mm"\nlength = "20 mm"\nbevel = "3 mm"\nangle = "0 deg"\n', 'cleat.height = "10 mm"\ncleat."length" = "20 mm"\n'),
    ("an inline table", "test", DRUM, '[cleat]\nheight = "10 mm"\nlength = "20 mm"\nbevel = "3 mm"\nangle = "0 deg"\n', 'cleat = {height = "10 mm", length = "20 mm"}\n'),
    ("one unit for a list", "suspension", CORNER, '["1510.800 mm", "527.786 mm", "350.000 mm"]', '{unit = "mm", values = [1510.8, 527.786, 350]}'),
    ("one unit for rows", "rig", RIG, 'speeds = ["30 km/h", "60 km/h"]', 'speeds = {unit = "km/h", values = [30, 60]}'),
    ("a unit without a blank", "ring_tire", RING, 'pressure = "2.4 bar"', 'pressure = "2.4bar"'),
    ("a number with exponent and sign", "ring_tire", RING, 'pressure = "2.4 bar"', 'pressure = "+2.4e5 Pa"'),
    ("a share in percent", "ring_tire", RING, "pressure_share = 0.5", 'pressure_share = "50 %"'),
    ("a literal text", "ring_tire", RING, 'pressure = "2.4 bar"', "pressure = '2.4 bar'"),
    ("a text in three quotes", "ring_tire", RING, 'pressure = "2.4 bar"', 'pressure = """2.4 bar"""'),
    ("an integer in hexadecimal", "test", DRUM, "passages = 3", "passages = 0x3"),
    ("a comment that names a schema", "test", DRUM, 'kind = "drum_cleat"', '#:schema file:///nowhere.json\nkind = "drum_cleat"'),
    ("arrays of tables", "modes", "tools/schema_samples/modes.toml", "[[mode]]", "[[mode]]"),
]

# Values that stand in the place of others: of every type of TOML, with and without units, in and out of usual ranges.
PROBES = [0, 1, 2, 0.5, -3, 1e6, "word", "2 mm", "0.5", "3 %", True, [], ["2 mm"], [1, 2], ["word"],
          {"unit": "mm", "values": [1, 2]}, {}, {"from": "measurement.a"}]


# Values of a key that is added to a table: a table whose keys are free takes some of them.
ADDED = [1, 0.5, "word", "2 mm", "3 %", "N", ["2 mm"], {}]


def validators():
    schemas = {kind: json.loads((FOLDER / f"latsch-{kind}.json").read_text())
               for kind in (file.stem.removeprefix("latsch-") for file in FOLDER.glob("latsch-*.json"))}
    for schema in schemas.values():
        jsonschema.Draft7Validator.check_schema(schema)
    return {kind: jsonschema.Draft7Validator(schema) for kind, schema in schemas.items()}


def first_error(validator, content):
    """Returns the innermost message of the first error; None if there is none."""
    error = jsonschema.exceptions.best_match(validator.iter_errors(content))
    return error and f"{'.'.join(map(str, error.absolute_path)) or 'the file'}: {error.message[:160]}"


def good_files(validators):
    """Returns how many of the good files are taken, and how many there are."""
    files, taken = schema_corpus.toml_files(), 0
    for kind, file in files:
        error = first_error(validators[kind], schema_corpus.read(file))
        taken += error is None
        if error:
            print(f"{file.relative_to(schema_corpus.ROOT)} is refused as a {kind}: {error}")
    return taken, len(files)


def as_printed(sample):
    """Returns a sample with the kind of model that the reference prints in the place of the samples' stand-in."""
    return renamed(sample, "any_model", "rigid_ring")


def samples_taken(validators, recorder):
    """Returns a sentence for each sample of the reference that a schema refuses."""
    errors = [(kind, file, first_error(validators[kind], as_printed(schema_corpus.read(file)))) for kind, file in recorder.samples]
    print(f"samples of the reference taken {sum(error is None for *_, error in errors)} of {len(errors)}")
    return [f"the sample {file.read_text()!r} is refused as a {kind}: {error}" for kind, file, error in errors if error]


def places(content, at=()):
    """Yields the places of all values of a content, lists as a whole."""
    entries = content.items() if isinstance(content, dict) else []
    for key, value in entries:
        yield at + (key,)
        if isinstance(value, list) and value and isinstance(value[0], dict):
            for i, one in enumerate(value):
                yield from places(one, at + (key, i))
        else:
            yield from places(value, at + (key,))


def changed(content, place, value):
    """Returns the content with another value at a place; without the key if the value is None."""
    content = copy.deepcopy(content)
    here = content
    for part in place[:-1]:
        here = here[part]
    if value is None:
        del here[place[-1]]
    else:
        here[place[-1]] = value
    return content


def texts_in(value):
    """Returns all texts of a content, which may name what it defines."""
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else []
    return {value} if isinstance(value, str) else set().union(*map(texts_in, inner), set())


def keys_of(value):
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else []
    return (set(value) if isinstance(value, dict) else set()).union(*map(keys_of, inner))


def renamed(value, old, new):
    """Returns a content in which a name is another one wherever it is a key or a text."""
    if isinstance(value, dict):
        return {new if key == old else key: renamed(one, old, new) for key, one in value.items()}
    if isinstance(value, list):
        return [renamed(one, old, new) for one in value]
    return new if value == old else value


def changes(content):
    """Yields a description and a content for each change: another value, no value, one more key, another name."""
    for place in places(content):
        here = content
        for part in place:
            here = here[part]
        for value in [None, *PROBES]:
            yield f"{'.'.join(map(str, place))} = {value}", lambda: changed(content, place, value)
        if isinstance(here, dict):
            for value in ADDED:
                yield f"{'.'.join(map(str, place))}.other = {value}", lambda: changed(content, (*place, "other"), value)
    for name in sorted(texts_in(content) & keys_of(content)):
        yield f"{name} is called other_name", lambda: renamed(content, name, "other_name")


def refused_although_taken(validators, recorder, every):
    """Returns a sentence for each change of a good file that the program takes and the schema refuses, and the number
    of changes."""
    faults, tried, order = [], 0, random.Random(7)
    for kind, file in recorder.files():
        content = schema_corpus.read(file)
        for what, make in changes(content):
            if order.randrange(every) and not what.endswith("other_name"):
                continue
            tried += 1
            other = make()
            if not validators[kind].is_valid(as_printed(other)) and recorder.takes(kind, file, other):
                faults.append(f"{kind}, {file.name}: {what}: the program takes what the schema refuses: "
                              f"{first_error(validators[kind], other)}")
    return faults, tried


def changed_text(file, old, new):
    """Returns the text of a file with one passage replaced. The passage has to be there."""
    text = (schema_corpus.ROOT / file).read_text()
    if old not in text:
        sys.exit(f"{file} does not contain {old!r} any more: choose another passage")
    return text.replace(old, new, 1)


def edges_taken(validators, recorder):
    """Returns a sentence for each form of a file that the program takes and the schema refuses."""
    faults = []
    for what, kind, file, old, new in EDGES:
        text = changed_text(file, old, new)
        if not recorder.takes(kind, recorder.folder / file, text):
            faults.append(f"{what}: the program refuses this form itself")
            continue
        error = first_error(validators[kind], tomllib.loads(text.removeprefix("\ufeff")))
        if error:
            faults.append(f"{what}: {error}")
    return faults


def wrong_files(validators, recorder):
    """Returns how many of the wrong files are refused, and a sentence for each that is not wrong at all."""
    refused, faults = 0, []
    for what, kind, file, old, new in WRONG:
        text = changed_text(file, old, new)
        if recorder.takes(kind, recorder.folder / file, text):
            faults.append(f"{what} in {file}: the program takes this file, so it is not wrong")
        error = first_error(validators[kind], tomllib.loads(text))
        refused += error is not None
        print(f"  {what:35} {kind:12} {error or 'taken: latsch check refuses it'}")
    return refused, faults


def main():
    program, *options = sys.argv[1:]
    every = int(options[options.index("--every") + 1]) if "--every" in options else 400
    every_kind = validators()
    with tempfile.TemporaryDirectory() as folder:
        recorder = schema_corpus.Recorder(program, folder)
        refused, faults = wrong_files(every_kind, recorder)
        faults += samples_taken(every_kind, recorder) + edges_taken(every_kind, recorder)
        strict, tried = refused_although_taken(every_kind, recorder, every)
        recorder.close()
    taken, all_of_them = good_files(every_kind)
    for fault in faults + strict:
        print(fault)
    print(f"good files taken {taken} of {all_of_them}, wrong refused {refused} of {len(WRONG)}")
    print(f"{tried} changes of good files, {len(strict)} of them taken by the program and refused by a schema")
    sys.exit(0 if taken == all_of_them and refused >= LEAST_REFUSED and not faults and not strict else 1)


if __name__ == "__main__":
    main()
