#!/usr/bin/env python3
"""The TOML files from which docs/schemas is made, and what their readers request in them.

The corpus contains the samples of the reference, the files of studies and verification, and those of
tools/schema_samples, which state what no other file does. The program recorded_keys reads them."""
import json
import os
import pathlib
import subprocess
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[1]
SAMPLES = ROOT / "tools" / "schema_samples"
MODELS = ("ring_tire", "suspension", "car")
ROADS = ("flat", "cleat", "drum", "wave")


def read(file):
    """Returns the content of a TOML file; a byte order mark is skipped, as the program does."""
    return tomllib.loads(pathlib.Path(file).read_text(encoding="utf-8-sig"))


def kind_of(content, name=""):
    """Returns the kind of a file by its content; None for a file that the program does not read."""
    if name == "expected.toml":  # the results of a study, which tools/studies.py reads
        return None
    kind = content.get("kind")
    if kind in MODELS:
        return kind
    if kind == "kerb":  # a road has a shape, a test has a car that drives
        return "road" if "shape" in content else "test"
    if kind in ROADS:
        return "road"
    if kind is not None:
        return "test"
    for kind, keys in (("fe_tire", ("section",)), ("suite", ("check",)), ("study", ("experiment", "variable")),
                       ("rig", ("plateaus",)), ("comparison", ("tire", "reference")), ("modes", ("mode",))):
        if any(key in content for key in keys):
            return kind
    return None


def toml_files():
    """Returns the TOML files of the repository that the program reads, with their kinds."""
    files = []
    for folder in ("studies", "verification", "tools/schema_samples"):
        for file in sorted((ROOT / folder).rglob("*.toml")):
            kind = kind_of(read(file), file.name)
            if kind:
                files.append((kind, file))
    return files


def toml_text(table):
    """Returns a table as TOML text, every value of the root in one line."""
    return "".join(f"{json.dumps(key, ensure_ascii=False)} = {value_text(value)}\n" for key, value in table.items())


def value_text(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key, ensure_ascii=False)} = {value_text(one)}" for key, one in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(value_text, value)) + "]"
    if isinstance(value, float):
        return repr(value)  # "inf" and "nan" are TOML too
    return json.dumps(value, ensure_ascii=False) if isinstance(value, (str, bool, int)) else value.isoformat()


class Recorder:
    """The program recorded_keys, and a folder in which files of the corpus can be changed."""

    def __init__(self, program, folder):
        self.program, self.folder = str(program), pathlib.Path(folder)
        said = self.run("--samples", self.folder)
        self.samples = [(kind, pathlib.Path(file)) for kind, file in (line.split("\t") for line in said.splitlines())]
        for name in ("studies", "verification", "tools/schema_samples"):
            self.mirror(ROOT / name, self.folder / name)
        self.reader = subprocess.Popen([self.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def run(self, *options):
        return subprocess.run([self.program, *map(str, options)], capture_output=True, text=True, check=True).stdout

    @staticmethod
    def mirror(source, target):
        """Makes a folder whose files are links to those of another one, so that a changed file can stand beside them."""
        for folder, _, names in os.walk(source):
            here = target / pathlib.Path(folder).relative_to(source)
            here.mkdir(parents=True, exist_ok=True)
            for name in names:
                (here / name).symlink_to(pathlib.Path(folder) / name)

    def files(self):
        """Returns all files of the corpus in the mirrored folder, with their kinds."""
        return self.samples + [(kind, self.folder / file.relative_to(ROOT)) for kind, file in toml_files()]

    def sections(self):
        return json.loads(self.run("--sections"))

    def keys(self, kind, file):
        """Returns the declared keys of a file by their paths; None if the file is refused."""
        self.reader.stdin.write(f"{kind}\t{file}\n")
        self.reader.stdin.flush()
        return json.loads(self.reader.stdout.readline()).get("keys")

    def takes(self, kind, beside, content):
        """True if the program takes this content in a file beside another one."""
        file = pathlib.Path(beside).with_name("changed.toml")
        file.write_text(content if isinstance(content, str) else toml_text(content))
        taken = self.keys(kind, file) is not None
        file.unlink()
        return taken

    def close(self):
        self.reader.stdin.close()
        self.reader.wait()
