#!/usr/bin/env python3
"""Tests docs/schemas with an independent validator, Python's jsonschema (Debian's python3-jsonschema).

   tools/schemas_test.py PATH/TO/recorded_keys [--every N]

All TOML files of the repository have to be taken, and 27 of the 30 wrong files refused. Files that are changed at one
place are given to the program: what it takes, the schema has to take. Every Nth change is tried, of each kind of file."""
import copy
import json
import random
import sys
import tempfile

import schema_corpus

try:
    import jsonschema
except ImportError:
    print("skipped: no validator is installed; the Debian package python3-jsonschema has one")
    sys.exit(77)

FOLDER = schema_corpus.ROOT / "docs" / "schemas"
LEAST_REFUSED = 27

# Values that stand in the place of others: of every type of TOML, with and without units, in and out of usual ranges.
PROBES = [0, 1, 2, 0.5, -3, 1e6, "word", "2 mm", "0.5", "3 %", True, [], ["2 mm"], [1, 2], ["word"],
          {"unit": "mm", "values": [1, 2]}, {}, {"from": "measurement.a"}]


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


def refused_although_taken(validators, recorder, every):
    """Returns a sentence for each change of a good file that the program takes and the schema refuses, and the number
    of changes."""
    faults, tried, order = [], 0, random.Random(7)
    for kind, file in recorder.files():
        content = schema_corpus.read(file)
        for place in places(content):
            for value in [None, *PROBES]:
                if order.randrange(every):
                    continue
                tried += 1
                other = changed(content, place, value)
                if not validators[kind].is_valid(other) and recorder.takes(kind, file, other):
                    faults.append(f"{kind}, {file.name}: {'.'.join(map(str, place))} = {value}: the program takes what the "
                                  f"schema refuses: {first_error(validators[kind], other)}")
    return faults, tried


def main():
    program, *options = sys.argv[1:]
    every = int(options[options.index("--every") + 1]) if "--every" in options else 50
    every_kind = validators()
    with tempfile.TemporaryDirectory() as folder:
        recorder = schema_corpus.Recorder(program, folder)
        faults, tried = refused_although_taken(every_kind, recorder, every)
        recorder.close()
    for f in sorted(set(faults)): print(f)
    print(tried, len(faults))
    print(good_files(every_kind))


if __name__ == "__main__":
    main()
