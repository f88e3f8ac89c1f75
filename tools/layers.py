#!/usr/bin/env python3
"""Checks that every #include follows the architecture: a folder may use itself and what is listed here; and that what
is written for the user goes through base/file.h, which knows of links, pipes, devices and full disks."""
import pathlib
import re
import sys

BELOW = {
    "base": [],
    "numerics": ["base"],
    "models": ["base", "numerics"],
    "measurement": ["base", "numerics"],
    "optimization": ["base", "numerics"],
    "formats": ["base", "numerics", "models", "measurement", "optimization"],
    "experiment": ["base", "numerics", "models", "measurement", "formats"],
    "evaluation": ["base", "numerics", "measurement", "optimization", "formats"],
    "correlation": ["base", "numerics", "models", "measurement", "optimization", "formats",
                    "experiment", "evaluation"],
}

# One model does not use another, except these: every tire rolls on a road, and the rigid ring's slip
# forces are the Magic Formula's.
MODELS = {"road": [], "tire": ["road"], "rigid_ring": ["road", "tire", "magic_formula"]}
EVERY_TIRE = ["road", "tire"]

SOURCE = pathlib.Path(__file__).resolve().parent.parent / "src"
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
APPENDS = "apps/cli/console.cpp"  # a log: written through whatever it is
WRITING = re.compile(r"\b(ofstream|fopen|rename)\b(?!\))")


def model_of(path):
    """src/models/fe_tire/... -> fe_tire."""
    return path.parts[1] if path.parts[0] == "models" and len(path.parts) > 2 else None


def faults():
    for file in sorted([*SOURCE.rglob("*.h"), *SOURCE.rglob("*.cpp")]):
        here = file.relative_to(SOURCE)
        for number, line in enumerate(file.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            used = pathlib.Path(match.group(1))
            layer, target = here.parts[0], used.parts[0]
            if not (SOURCE / used).is_file():
                yield f'{here}:{number}: "{used}" is not a file below src/ (write paths from src/)'
            elif target != layer and target not in BELOW[layer]:
                yield f"{here}:{number}: {layer} may not use {target} (allowed: {', '.join(BELOW[layer])})"
            elif layer == target == "models" and model_of(used) not in [
                    model_of(here), *MODELS.get(model_of(here), EVERY_TIRE)]:
                yield f"{here}:{number}: model {model_of(here)} may not use model {model_of(used)}"


def writers():
    for folder in (SOURCE, SOURCE.parent / "apps"):
        for file in sorted([*folder.rglob("*.h"), *folder.rglob("*.cpp")]):
            if file in (SOURCE / "base/file.cpp", SOURCE.parent / APPENDS) or re.search("_test(ing)?[.]", file.name):
                continue
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = WRITING.search(line.split("//")[0])
                if match:
                    yield f"{file.relative_to(SOURCE.parent)}:{number}: {match[1]}: files are written by base/file.h"


if __name__ == "__main__":
    found = [*faults(), *writers()]
    print("\n".join(found) or "layers: every #include follows the architecture")
    sys.exit(1 if found else 0)
