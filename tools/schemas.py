#!/usr/bin/env python3
"""Writes docs/schemas/latsch-KIND.json, JSON schemas (draft-07) of the TOML files that the program reads, for editors.

   tools/schemas.py PATH/TO/recorded_keys            writes the schemas
   tools/schemas.py PATH/TO/recorded_keys --check    ends with 1 if they differ, or if a key that a reader of the
                                                     sources requests is in no schema

A reader states each key with its type, unit, range, choices and default when it reads it. The schemas are made of these
statements over all files of tools/schema_corpus.py. A schema never refuses what the program takes: a key is required
only if the program refuses every file of the corpus without it."""
import copy
import json
import pathlib
import re
import sys
import tempfile

import schema_corpus

FOLDER = schema_corpus.ROOT / "docs" / "schemas"
TITLES = {"study": "study", "suite": "suite of checks for latsch validate", "test": "test", "road": "road",
          "comparison": "comparison of tires or models", "rig": "description of a drum rig for latsch process",
          "modes": "table of measured modes", "fe_tire": "finite-element tire", "ring_tire": "flexible ring tire",
          "suspension": "suspension", "car": "car"}
# Tables that several kinds of files have in common, by the pattern of their path.
SHARED = {("study", "test.*"): "test", ("study", "refined.test.*"): "test", ("suite", "test.*"): "test",
          ("study", "measurement.*"): "measurement", ("suite", "measurement.*"): "measurement",
          ("comparison", "measurement.*"): "measurement", ("study", "refined.simulator"): "simulator",
          ("study", "simulator"): "simulator", ("car", "front"): "axle", ("car", "rear"): "axle"}
# Joints of a suspension: all have the same keys.
JOINTS = re.compile(r"bushing\.[^.]+$")
# Tables that take the keys of another one: the samples of the other one state them.
ALIKE = {("study", "stage.*"): ("study", "optimizer"), ("study", "optimizer.member.*"): ("study", "optimizer"),
         ("suite", "check.*"): ("study", "experiment.*")}
# Choices that are names in other files or are made of names, so that a schema cannot list them.
NAMES = {("comparison", "case"), ("comparison", "model"), ("test", "slopes_by"), ("study", "test"), ("suite", "test")}
# Numbers in the unit of another number: a variable may be dimensionless.
UNIT_OF_ANOTHER = {"study": ("variable.*", "constraint.*", "linear_constraint.*", "tie.*"), "suite": ("check.*",)}
# Tables whose keys are free, with values that the program knows from other files.
FREE = {"study": ("stage.*.model", "refined.model"), "comparison": ("reference.noise", "test.*.vary"),
        "rig": ("channels.units",)}
# Tables of tables whose names another table of the file defines.
NAMED = {("rig", "truth.run")}
# Keys that readers of models ask for only to refuse them. Sections of the reference name those of studies and tests.
REFUSED = {("fe_tire", "kind"), ("fe_tire", "friction_pressure"), ("fe_tire", "friction_exponent"),
           ("ring_tire", "belt.bending_lateral"), ("ring_tire", "belt.section_bending")}
# A number, then a blank or a character that is part of no number: "2.6 bar", "5%", "3 1/s".
WITH_UNIT = r"^\s*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?(\s+\S.*|[^0-9\s.].*)$"
WITH_OR_WITHOUT_UNIT = r"^\s*[+-]?([0-9]|\.[0-9]).*$"


def shared_name(owner, path):
    """Returns the name of the table that several places have in common; None if there is none."""
    joined = ".".join(path)
    if owner == "suspension" and JOINTS.match(joined):
        return "joint"
    return SHARED.get((owner, joined))


class Table:
    """A table at one place of a kind of file, as all files of the corpus together declare it."""

    def __init__(self, owner, path):
        self.owner, self.path = owner, path  # "study", ("experiment", "*")
        self.seen = []  # (declared keys, content, the file, the path of the table there)
        self.below = {}  # (key, kind of this table) -> Table
        self.known_variants = None  # variants() when all files are read

    def child(self, key, variant):
        return self.below.setdefault((key, variant), Table(self.owner, self.path + (key,)))

    def variants(self):
        """Returns the values of `kind` on which the keys depend; [None] if they depend on none."""
        kinds = {kind_in(declared, content) for declared, content, *_ in self.seen}
        keys = {kind: set().union(*(declared for declared, content, *_ in self.seen if kind_in(declared, content) == kind))
                for kind in kinds}
        same = len({frozenset(one) for one in keys.values()}) == 1
        return [None] if same and self.path else sorted(kinds, key=str)

    def variant_of(self, declared, content):
        """Returns the variant of one of the tables that were seen."""
        if self.known_variants is None:
            self.known_variants = self.variants()
        kind = kind_in(declared, content)
        return kind if kind in self.known_variants else None


def kind_in(declared, content):
    return content.get("kind") if declared.get("kind", {}).get("kind") == "choice" else None


def tree_of(declared):
    """Returns the declared keys as a tree: {key: (declaration or None, {...})}."""
    root = {}
    for path, what in declared.items():
        here, parts = root, path.split(".")
        for part in parts[:-1]:
            here = here.setdefault(part, [None, {}])[1]
        here.setdefault(parts[-1], [None, {}])[0] = what
    return root


class Schemas:
    def __init__(self, recorder):
        self.recorder = recorder
        self.sections = recorder.sections()
        self.roots = {}
        self.faults = []
        self.names = {}
        self.said = schema_corpus.read(schema_corpus.ROOT / "tools" / "schema_words.toml")
        self.used = set()  # owners and patterns of the sentences that a key has
        for kind, file in recorder.files():
            declared = recorder.keys(kind, file)
            if declared is not None:
                content = schema_corpus.read(file)
                self.add(self.root(kind), tree_of(declared), content, (kind, file), ())

    def root(self, name):
        return self.roots.setdefault(name, Table(name, ()))

    def add(self, table, tree, content, origin, place):
        shared = shared_name(table.owner, table.path)
        if shared:
            table.seen.append(({}, content, origin, place))  # only a mark that there is one
            return self.add(self.root(shared), tree, content, origin, place)
        # A value that the reader finds may come from another file, such as a table of hardpoints.
        declared = {key: {**what, "is_there": key in content} for key, (what, _) in tree.items() if what}
        table.seen.append((declared, content, origin, place))
        variant = kind_in(declared, content)
        for key, (what, below) in tree.items():
            inner = content.get(key) if isinstance(content, dict) else None
            path = ".".join(table.path + (key,))
            if not isinstance(inner, (dict, list)) or path in FREE.get(table.owner, ()) or (what and what["is_measurable"]):
                continue
            if what and (what["kind"] == "tables" or (table.owner, path) in NAMED):
                named = table.child(key, variant)
                entries = inner.items() if isinstance(inner, dict) else ((str(i), one) for i, one in enumerate(inner))
                for name, one in entries:
                    self.add(named.child("*", None), below.get(name, [None, {}])[1], one, origin, place + (key, name))
            elif isinstance(inner, dict) and below:
                self.add(table.child(key, variant), below, inner, origin, place + (key,))

    # Words

    def sentence(self, table, variant, key):
        """Returns the entry of the reference for a key; {} if there is none."""
        if table.owner in self.said:
            return self.said_of(table, key)
        path = list(table.path) + [key]
        best, most = {}, 0
        for section in self.sections:
            at = [one for one in section["table"].split(".") if one]
            for entry in section["keys"]:
                pattern = at + entry["path"].split(".")
                if table.owner in ("test", "simulator", "measurement", "road"):
                    if at and at != {"test": ["test", "*"], "measurement": ["measurement", "*"]}.get(table.owner, [table.owner]):
                        continue
                    if not at and table.owner in ("simulator", "measurement"):
                        continue
                    pattern = entry["path"].split(".")
                    if section["heading"] in ("A study", "A suite: acceptance of a model"):
                        continue
                    if section["heading"].startswith("Test ") and f'"{variant}"' not in section["heading"] and table.path == ():
                        continue
                elif table.owner in ("study", "suite"):
                    if section["heading"].startswith("Test "):
                        continue
                    if table.owner == "suite" and path[:1] == ["check"] and at == ["experiment", "*"]:
                        pattern = ["check", "*"] + entry["path"].split(".")
                    if table.owner == "study" and section["heading"].startswith("A suite"):
                        continue
                else:
                    continue
                tail = path[-len(pattern):]
                if len(tail) != len(pattern) or any(a != b and b != "*" for a, b in zip(tail, pattern)):
                    continue
                exact = sum(a == b for a, b in zip(tail, pattern))
                # "[experiment.NAME] with kind = "curve"" is about this kind, "What of a curve is compared" too.
                heading = section["heading"]
                score = 10 * exact + (2 if f'"{variant}"' in heading else 1 if variant and variant in heading else 0.5)
                if score > most:
                    best, most = entry, score
        return best

    def said_of(self, table, key):
        """Returns the sentence of tools/schema_words.toml for a key as an entry of the reference."""
        path, words = table.path + (key,), self.said[table.owner]
        fitting = [pattern for pattern in words if len(parts := pattern.split(".")) == len(path)
                   and all(part in ("*", name) for part, name in zip(parts, path))]
        if not fitting:
            self.faults.append(f"{table.owner}: the key {'.'.join(path)!r} has no sentence in tools/schema_words.toml")
            return {}
        best = min(fitting, key=lambda pattern: (pattern.count("*"), pattern))
        self.used.add((table.owner, best))
        return {"sentence": words[best]}

    # Values

    def value(self, table, variant, key, forms):
        """Returns the schema of a value that has one of these forms."""
        entry = self.sentence(table, variant, key)
        pattern = ".".join(table.path)
        loose = pattern in UNIT_OF_ANOTHER.get(table.owner, ())
        units = {tuple(form["units"]) for form in forms if form["kind"] in ("quantity", "quantities", "one_or_more")}
        ways = []
        for form in forms:
            for way in self.ways(table, key, form, loose or len(units) > 1, entry, forms):
                if way not in ways:
                    ways.append(way)
        if any(form.get("is_measurable") for form in forms):
            ways.append({"type": "object", "required": ["from"], "properties": {
                "from": {"type": "string", "description": "Measurement that the values are taken from, measurement.NAME."},
                "channel": {"type": "string", "description": "Channel of the measurement, if it has another name."},
                "without": {"type": "array", "items": {"type": "string"},
                            "description": "Conditions that are left out although a column looks like them."}}})
        enums = [way for way in ways if "enum" in way]
        if len(enums) > 1:
            ways = [way for way in ways if "enum" not in way]
            ways.append({"enum": list(dict.fromkeys(word for way in enums for word in way["enum"]))})
        schema = ways[0] if len(ways) == 1 else {"anyOf": ways} if ways else {}
        words = self.words(table.owner, forms, entry, loose or len(units) > 1)
        return {"description": words, **schema} if words else schema

    def words(self, owner, forms, entry, loose):
        expected = []
        for form in forms:
            silent = ("presence", "text", "choice") + (("table", "tables") if entry else ())
            for one in form.get("expected") or ([] if form["kind"] in silent else [form["words"]]):
                if loose and form["kind"] == "quantity" and not form.get("expected"):
                    one = "a quantity in the unit of the number it belongs to"
                one = one.replace("`", "")
                if one and one not in expected:
                    expected.append(one)
        text = entry.get("sentence", "")
        if expected:
            joined = "; or ".join(expected)
            text += (" " if text else "") + joined[0].upper() + joined[1:] + "."
        default = entry.get("default_in_words") or " or ".join(entry.get("defaults", []))
        if not default and owner in self.said:
            default = self.fallback_of(forms)
        return text + (f" Unless given: {default}." if default else "")

    @staticmethod
    def fallback_of(forms):
        """Returns the value that applies if a key is not written; "" if there is none, if it depends on other keys, or if
        it stands for none: an empty text, or a number outside of the key's range."""
        fallbacks = {form.get("fallback", "") for form in forms}
        if len(fallbacks) != 1:
            return ""
        fallback = fallbacks.pop()
        number = fallback.strip('"').split(" ")[0]
        try:
            value = float(number)
        except ValueError:
            return "" if fallback == '""' else fallback
        form = forms[0]
        below = value < form.get("lower", value) or (form["lower_excluded"] and value == form.get("lower"))
        return "" if below or value > form.get("upper", value) else fallback

    def number(self, form, loose, entry, forms):
        """Returns the ways in which one number can be written."""
        units = form["units"]
        if not loose and units != ["1"]:
            return [{"type": "string", "pattern": WITH_UNIT}]
        number = {"type": "number"}
        if not loose and not entry.get("range") and not form.get("expected"):
            number |= self.bounds(form, forms)
        return [number, {"type": "string", "pattern": WITH_OR_WITHOUT_UNIT}]

    @staticmethod
    def bounds(form, forms):
        """Returns the range of a plain number if it is the same in all files."""
        same = [one for one in forms if one["kind"] == form["kind"]]
        bounds = {}
        for end, word in (("lower", "minimum"), ("upper", "maximum")):
            if len({(one.get(end), one["lower_excluded"]) for one in same}) == 1 and end in form:
                strict = end == "lower" and form["lower_excluded"]
                bounds["exclusiveMinimum" if strict else word] = whole(form[end])
        return bounds

    def ways(self, table, key, form, loose, entry, forms):
        kind = form["kind"]
        many = lambda items: [{"type": "array", "items": items}, {
            "type": "object", "required": ["unit", "values"], "additionalProperties": False,
            "properties": {"unit": {"type": "string"}, "values": {"type": "array"}}}]
        one = lambda ways: ways[0] if len(ways) == 1 else {"anyOf": ways}
        if kind == "quantity":
            return self.number(form, loose, entry, forms)
        if kind in ("quantities", "one_or_more"):
            number = self.number(form, loose, entry, forms)
            return (number if kind == "one_or_more" else []) + many(one(number))
        if kind == "rows":
            columns = [one(self.number({**form, "units": [unit], "expected": ["row"]}, False, {}, forms)) for unit in form["units"]]
            return many({"type": "array", "items": columns, "minItems": len(columns), "maxItems": len(columns)})
        if kind == "integer":
            return [{"type": "integer", **({} if entry.get("range") else self.bounds(form, forms))}]
        if kind == "flag":
            return [{"type": "boolean"}]
        if kind == "choice":
            if (table.owner, key) in NAMES or form.get("are_names"):
                return [{"type": "string"}]
            return [{"enum": form["choices"]}]
        if kind == "texts":
            return [{"type": "array", "items": {"type": "string"}}]
        if kind == "text":  # a reader that analyzes the text further may take a plain number too
            return [{"type": "string"}] + ([{"type": "number"}] if form.get("expected") else [])
        if kind in ("table", "tables"):
            return [{"type": "object"} if kind == "table" else {"type": ["object", "array"]}]
        return []

    # Tables

    def forms_of(self, tables, key, variant, only=True):
        """Returns the forms in which readers read a key, and whether a file states it."""
        forms, stated = [], False
        for table in tables:
            for declared, content, (_, file), _ in table.seen:
                what = declared.get(key)
                if not what or (only and table.variant_of(declared, content) != variant):
                    continue
                stated = stated or what["is_there"]
                if what["kind"] == "presence":
                    continue
                form = {name: what[name] for name in what if name not in ("is_there", "may_be_missing")}
                if what["kind"] == "choice":
                    form["are_names"] = bool(what["choices"]) and set(what["choices"]) <= self.names_in_file(file)
                if form not in forms:
                    forms.append(form)
        return forms, stated

    def names_in_file(self, file):
        """Returns the names that a file defines: all its keys."""
        if file not in self.names:
            self.names[file] = names_in(schema_corpus.read(file))
        return self.names[file]

    def object(self, table, variant):
        """Returns the schema of a table of one variant."""
        keys = {}
        for declared, content, *_ in table.seen:
            if table.variant_of(declared, content) == variant:
                keys |= dict.fromkeys(declared)
        properties, required = {}, []
        for key in keys:
            forms, stated = self.forms_of([table], key, variant)
            if not forms:
                forms, _ = self.forms_of(self.like(table), key, None, only=False)
            if not forms and not self.is_refused(table, key):
                forms, _ = self.forms_of(self.alike(table), key, variant, only=False)
            if not stated and self.is_refused(table, key):
                continue
            if not forms and not stated:
                self.faults.append(f"{table.owner}: no file of the corpus states the key {'.'.join(table.path + (key,))!r}")
                continue
            if key == "kind" and variant is not None:
                properties[key] = {"const": variant}
                continue
            path = ".".join(table.path + (key,))
            inner = table.below.get((key, variant)) or next(
                (other.below[at] for other in self.like(table) for at in other.below if at[0] == key), None)
            inner = inner or next((other.below[at] for other in self.alike(table)
                                   for at in other.below if at[0] == key and key not in table.path), None)
            if inner is None and shared_name(table.owner, table.path + (key,)):
                inner = Table(table.owner, table.path + (key,))
            properties[key] = self.value(table, variant, key, forms)
            if inner is None and key not in table.path and path not in FREE.get(table.owner, ()) and not any(form["is_measurable"] for form in forms) and (
                    any(form["kind"] in ("table", "tables") for form in forms)):
                self.faults.append(f"{table.owner}: no file of the corpus states what is in the table [{path}]"
                                   + (f" with kind = \"{variant}\"" if variant else ""))
            if inner is not None and any(form["kind"] in ("table", "tables") for form in forms) or (inner and not forms):
                is_named = any(form["kind"] == "tables" for form in forms) or (table.owner, path) in NAMED
                free = path in FREE.get(table.owner, ())
                described = {k: v for k, v in properties[key].items() if k == "description"}
                others = [way for way in properties[key].get("anyOf", [properties[key]])
                          if way.get("type") not in ("object", ["object", "array"])]
                others = [{k: v for k, v in way.items() if k != "description"} for way in others]
                others = [way for way in others if way]
                schema = {"type": "object"} if free else self.named(inner) if is_named else self.table(inner)
                properties[key] = {**described, **schema} if not others else {**described, "anyOf": others + [schema]}
            if self.is_required(table, variant, key):
                required.append(key)
        schema = {"type": "object", "properties": properties, "additionalProperties": False}
        if self.has_free_names(table):
            # The names of the corpus are no choices: what they have in common holds for every name.
            free = [properties.pop(key) for key in list(properties)]
            schema["additionalProperties"] = free[0] if free and all(one == free[0] for one in free) else {}
            required = []
        if required:
            schema["required"] = sorted(required)
        return schema

    def has_free_names(self, table):
        pattern = ".".join(table.path)
        for section in self.sections:
            at = section["table"]
            for entry in section["keys"]:
                whole_path = (at + "." if at else "") + entry["path"]
                if entry["path"].endswith(".*") and (whole_path == pattern + ".*" or
                                                     (table.owner in SHARED.values() and entry["path"] == pattern + ".*")):
                    return True
        return False

    def like(self, table):
        """Returns the tables at the same place of other variants of the tables above."""
        found = []

        def visit(one):
            if one.path == table.path and one is not table:
                found.append(one)
            for below in one.below.values():
                visit(below)

        visit(self.roots[table.owner])
        return found + [table]

    def alike(self, table):
        """Returns the tables whose keys this one takes."""
        other = ALIKE.get((table.owner, ".".join(table.path)))
        return self.like(Table(other[0], tuple(other[1].split(".")))) if other else []

    def is_refused(self, table, key):
        """True if a reader asks for the key only to refuse it."""
        if (table.owner, ".".join(table.path + (key,))) in REFUSED:
            return True
        for section in self.sections:
            at = section["table"]
            for path in section["refused"]:
                whole_path = (at + "." if at else "") + path
                if (table.owner in ("study", "suite") and whole_path == ".".join(table.path + (key,))) or (
                        section["heading"].startswith("Test ") and table.owner == "test" and path == ".".join(table.path + (key,))):
                    return True
        return False

    def named(self, table):
        """Returns the schema of tables with free names, written as [KEY.NAME] or [[KEY]]."""
        items = [below for (key, _), below in table.below.items() if key == "*"]
        if not items:
            return {"type": ["object", "array"]}
        one = self.table(items[0])
        if "$ref" not in one:
            name = "_".join(part for part in items[0].path if part != "*")
            one = self.define(name, one)
        return {"type": ["object", "array"], "additionalProperties": one, "items": one}

    def define(self, name, schema):
        number = ""
        while self.definitions.get(name + number, schema) != schema:
            number = str(int(number or 1) + 1)
        self.definitions[name + number] = schema
        return {"$ref": f"#/definitions/{name}{number}"}

    def table(self, table):
        shared = shared_name(table.owner, table.path)
        if shared:
            if shared not in self.definitions:
                self.definitions[shared] = {}
                self.definitions[shared] = self.table(self.root(shared))
            return {"$ref": f"#/definitions/{shared}"}
        variants = table.variants()
        if variants == [None]:
            return self.object(table, None)
        schema = {"type": "object", "properties": {"kind": self.kinds(table)}, "allOf": []}
        if variants == [variants[0]] and table.path == ():
            return self.object(table, variants[0])
        for variant in variants:
            test = {"properties": {"kind": {"const": variant}}, "required": ["kind"]} if variant else {
                "not": {"required": ["kind"]}}
            then = self.object(table, variant)
            schema["allOf"].append({"if": test, "then": then})
        if None not in variants:
            schema["required"] = ["kind"]
        return schema

    def kinds(self, table):
        forms, _ = self.forms_of([table], "kind", None, only=False)
        words = list(dict.fromkeys(word for form in forms for word in form.get("choices", [])))
        known = [variant for variant in table.variants() if variant]
        for word in words:
            if word not in known:
                self.faults.append(f"{table.owner}: no file of the corpus has a table [{'.'.join(table.path)}] with kind = \"{word}\"")
        return {"description": "Kind: the other keys depend on it.", "enum": sorted(set(words) | set(known))}

    def is_required(self, table, variant, key):
        """True if every file of the corpus states the key and the program takes none without it."""
        there = []
        for declared, content, origin, place in table.seen:
            if table.variant_of(declared, content) != variant:
                continue
            what = declared.get(key)
            if not what or not what["is_there"] or what["may_be_missing"] or what["kind"] == "presence":
                return False
            there.append((origin, place))
        for (kind, file), place in there:
            content = schema_corpus.read(file)
            here = content
            for part in place:
                here = here[int(part)] if isinstance(here, list) else here[part]
            del here[key]
            if self.recorder.takes(kind, file, content):
                return False
        return True

    def schema(self, kind):
        self.definitions = {}
        root = self.root(kind)
        body = self.table(root)
        if kind == "test":
            body["required"] = ["kind"]
            body["allOf"] = [one for one in body["allOf"] if "not" not in one["if"]]
            for one in body["allOf"]:
                one["then"]["properties"].pop("file", None)
        schema = {"$schema": "http://json-schema.org/draft-07/schema#", "title": f"Latsch: {TITLES[kind]}", **body}
        if self.definitions:
            schema["definitions"] = dict(sorted(self.definitions.items()))
        return schema


def names_in(content):
    """Returns all keys of a content, which are the names that it defines."""
    names = set()
    if isinstance(content, dict):
        for key, value in content.items():
            names |= {key} | names_in(value)
    elif isinstance(content, list):
        for value in content:
            names |= names_in(value)
    return names


def whole(number):
    return int(number) if number == int(number) and abs(number) < 1e15 else number


def text_of(schema):
    return json.dumps(schema, indent=1, ensure_ascii=False) + "\n"


def make(program):
    """Returns the texts of all schemas by their kinds, and the makers."""
    with tempfile.TemporaryDirectory() as folder:
        recorder = schema_corpus.Recorder(program, folder)
        schemas = Schemas(recorder)
        texts = {kind: text_of(schemas.schema(kind)) for kind in TITLES}
        recorder.close()
    schemas.faults += [f"tools/schema_words.toml: {owner}: the sentence on {pattern!r} belongs to no key"
                       for owner, words in schemas.said.items() for pattern in words if (owner, pattern) not in schemas.used]
    schemas.faults = list(dict.fromkeys(schemas.faults))
    return texts, schemas


GETTER = re.compile(r"(?:\.|->)(?:quantity|quantities|one_or_more|rows|integer|flag|text|choice|texts|table|find_table|"
                    r"named_tables)\(\s*\"(\w+)\"")
READERS = ("models", "measurement", "optimization", "formats", "experiment", "correlation")
# Readers of numbers of a .tir or .inp, which are in no TOML file. Keys of such files have capital letters.
NO_KEYS = {"src/experiment/kinds/inp_numbers.cpp", "src/models/magic_formula/tree/parameter_tree.cpp"}


def keys_in(schema):
    """Returns the names of all properties of a schema, and of those that a choice of kinds adds."""
    keys = set()
    if isinstance(schema, dict):
        keys |= set(schema["properties"]) if isinstance(schema.get("properties"), dict) else set()
        for value in schema.values():
            keys |= keys_in(value)
    elif isinstance(schema, list):
        for value in schema:
            keys |= keys_in(value)
    return keys


def forgotten(texts, sections):
    """Returns a sentence for each key of a reader or of the reference that is in no schema."""
    of_kinds = {kind: keys_in(json.loads(text)) for kind, text in texts.items()}
    everywhere = set().union(*of_kinds.values())
    faults = []
    for folder in READERS:
        for file in sorted((schema_corpus.ROOT / "src" / folder).rglob("*.cpp")):
            name = str(file.relative_to(schema_corpus.ROOT))
            if re.search("_test(ing)?[.]cpp$", name) or name in NO_KEYS:
                continue
            text = file.read_text()
            for found in GETTER.finditer(text):
                if found[1] not in everywhere and not found[1].isupper():
                    line = text.count("\n", 0, found.start()) + 1
                    faults.append(f"{name}:{line}: the key {found[1]!r} is in no schema; state it in a file of "
                                  "tools/schema_samples or in a sample of its section")
    for section in sections:
        known = of_kinds["suite"] if section["heading"].startswith("A suite") else of_kinds["study"] | of_kinds["road"]
        for entry in section["keys"]:
            key = entry["path"].replace(".*", "").split(".")[-1]
            if key not in known and key != "*":
                faults.append(f"{section['heading']}: the key {entry['path']!r} of the reference is in no schema")
    return faults


def main():
    program, *options = sys.argv[1:]
    texts, schemas = make(program)
    faults = schemas.faults + forgotten(texts, schemas.sections)
    if options != ["--check"]:
        FOLDER.mkdir(parents=True, exist_ok=True)
        for kind, text in texts.items():
            (FOLDER / f"latsch-{kind}.json").write_text(text)
    else:
        for kind, text in texts.items():
            file = FOLDER / f"latsch-{kind}.json"
            if not file.exists() or file.read_text() != text:
                faults.append(f"{file.relative_to(schema_corpus.ROOT)} is not what the readers state: run tools/schemas.py "
                              f"{program} and look at what changed")
    for fault in faults:
        print(fault)
    print(f"{sum(len(keys_in(json.loads(text))) for text in texts.values())} names of keys in {len(texts)} schemas, "
          f"{len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
