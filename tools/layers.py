#!/usr/bin/env python3
"""Checks rules of the source tree. Every #include follows the architecture: a folder may use itself and the folders
listed here, and a room of a module the rooms before it. No folder has too many files. Comments end at the column
limit, because clang-format does not wrap them. Studies and verbs know no model. A simulation that fails returns a
Result or a Status. Every x.cpp implements x.h or a header that names it. Files for the user are written through
base/file.h, which handles links, pipes, devices and full disks. `--test` shows that the checks find what they must
find."""
import pathlib
import re
import sys

BELOW = {
    "base": [],
    "numerics": ["base"],
    "models": ["base", "numerics"],
    "measurement": ["base", "numerics"],
    "optimization": ["base", "numerics"],
    "report": ["base", "numerics", "models"],
    "formats": ["base", "numerics", "models", "measurement", "optimization"],
    "experiment": ["base", "numerics", "models", "measurement", "report", "formats"],
    "exchange": ["base", "numerics", "models", "formats", "experiment"],
    "evaluation": ["base", "numerics", "measurement", "optimization", "formats"],
    "correlation": ["base", "numerics", "models", "measurement", "optimization", "report", "formats",
                    "experiment", "evaluation"],
    "studio": ["base", "numerics", "measurement", "optimization", "report", "formats", "experiment", "evaluation",
               "correlation"],
}

# Rooms of a module: each may use itself and the rooms before it, so no two use each other. Files in
# the module's own folder may use all rooms, and no room uses them. Tests may use any room.
ROOMS = {
    "base": ["unit_words", "toml"],
    "numerics": ["kernels", "dense", "sparse", "signals"],
    "models/fe_tire": ["mesh", "element", "history", "description", "ring", "contact", "analysis", "motion", "grip",
                       "rolling", "passage", "slopes"],
    "models/ring_tire": ["description", "belt", "tread", "step", "ring"],
    "optimization": ["problem", "region", "direct_search", "least_squares", "trust_region", "sqp", "design", "surrogate",
                     "strategy", "identifiability", "posterior", "selection"],
    "formats": ["text", "recorders", "tables", "tire", "car", "road", "deck", "mesh"],
    "experiment": ["rigs", "language", "tests", "kinds"],
    "exchange": ["unit", "package"],
    "evaluation": ["trial", "executors", "journal", "schedule", "outside_program"],
    "correlation": ["laboratory", "observable", "nuisance", "study", "target", "doe", "analysis", "posterior", "selection", "campaign",
                    "search", "study_report", "rig_data", "comparison", "validation"],
    "studio": ["http", "shelf", "views"],
}

# Folders that may use fewer modules, or rooms of modules, than the module to which they belong.
NARROW_ROOMS = {
    "studio/http": ["base"],
    # A slim library consists of these (apps/exchange/slim).
    "exchange/unit": ["base", "numerics", "models/car", "models/magic_formula", "models/multibody", "models/rigid_ring",
                      "models/ring_tire", "models/road", "models/suspension", "models/tire", "formats/road"],
}

# A model must not use another one, with these exceptions: every tire rolls on a road, the slip forces of the rigid
# ring are those of the Magic Formula, suspensions consist of rigid bodies and their elements, and a car has
# suspensions and tires.
MODELS = {"road": [], "tire": ["road"], "rigid_ring": ["road", "tire", "magic_formula"], "multibody": [],
          "suspension": ["multibody"], "car": ["road", "tire", "multibody", "suspension"]}
EVERY_TIRE = ["road", "tire"]

# Studies work with models of any kind, so the code shared by all of them knows no model.
KNOWS_NO_MODEL = "correlation"
# Folders that know no kind of test either: everything that a test reports beyond its channels is returned by a
# virtual function of the class Test.
KNOW_NO_TEST = ("correlation", "studio", "report")
# Verbs of the program whose purpose concerns a certain model. No other verb may know one.
VERBS_OF_MODELS = {"export", "exported_bushings", "exported_kc", "exported_rolling", "mesh", "road", "shown_bushing", "shown_file",
                   "shown_tire"}
KIND_BY_NAME = re.compile(r'name\(\)\s*[!=]=\s*"(fe_tire|ring_tire|rigid_ring|magic_formula)"')

MOST_FILES = 40  # largest number of files directly in one folder
MOST_COLUMNS = 100  # ColumnLimit of .clang-format

SOURCE = pathlib.Path(__file__).resolve().parent.parent / "src"
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
APPENDS = "apps/cli/console/console.cpp"  # the log, which is appended to and so may be a file of any kind
WRITING = re.compile(r"\b(ofstream|fopen|rename)\b(?!\))")


def model_of(path):
    """Returns the model to which a path belongs: "fe_tire" for src/models/fe_tire/..."""
    return path.parts[1] if path.parts[0] == "models" and len(path.parts) > 2 else None


def room_of(path):
    """(module, room) of a path below src/. The room is None for files in the module's own folder."""
    for module in ROOMS:
        if str(path).startswith(module + "/"):
            inside = pathlib.Path(path).relative_to(module).parts
            return module, inside[0] if len(inside) > 1 else None
    return None, None


def room_fault(here, used):
    (module, room), (other, target) = room_of(here), room_of(used)
    if module is None or module != other or room == target or here.stem.endswith(("_test", "_testing")):
        return None
    rooms = ROOMS[module]
    for name in filter(None, (room, target)):
        if name not in rooms:
            return f"{module}/{name} is no room of tools/layers.py (there are {', '.join(rooms)})"
    if room is None:
        return None
    if target is None or rooms.index(target) > rooms.index(room):
        return f"{module}/{room} may not use {used} (only rooms before it: {', '.join(rooms[:rooms.index(room)]) or 'none'})"
    return None


def allowed_in(here):
    """Modules and rooms that a file may use beyond its own module. Tests of a narrow folder are not narrow."""
    is_test = here.stem.endswith(("_test", "_testing"))
    return BELOW[here.parts[0]] if is_test else NARROW_ROOMS.get(str(here.parent), BELOW[here.parts[0]])


def may_use(used, allowed):
    return any(str(used).startswith(name + "/") for name in allowed)


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
            elif target != layer and not may_use(used, allowed := allowed_in(here)):
                yield f"{here}:{number}: {layer} may not use {target} (allowed: {', '.join(allowed)})"
            elif layer == target == "models" and model_of(used) not in [
                    model_of(here), *MODELS.get(model_of(here), EVERY_TIRE)]:
                yield f"{here}:{number}: model {model_of(here)} may not use model {model_of(used)}"
            elif (layer == KNOWS_NO_MODEL and not here.stem.endswith(("_test", "_testing"))
                  and str(used).startswith(("models/", "experiment/kinds/"))):
                yield f"{here}:{number}: {layer} knows no model: what only a kind can do is a capability or SpecimenKind's"
            elif (layer in KNOW_NO_TEST and not here.stem.endswith(("_test", "_testing"))
                  and str(used).startswith("experiment/tests/")):
                yield f"{here}:{number}: {layer} knows no test: what a test tells is a function of Test"
            elif fault := room_fault(here, used):
                yield f"{here}:{number}: {fault}"


def models_in_verbs():
    apps = SOURCE.parent / "apps"
    for file in sorted([*apps.rglob("*.h"), *apps.rglob("*.cpp")]):
        if file.stem in VERBS_OF_MODELS or file.parent.name == "templates":
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if match and match.group(1).startswith(("models/", "experiment/kinds/", "experiment/tests/")):
                yield f"{file.relative_to(SOURCE.parent)}:{number}: a verb for any model and test knows none: it asks the language"


# Declarations of types. A type's name must not occur in two headers; exceptions are the C interfaces of the two FMI
# standards, which keep the names of the standards.
TYPE = re.compile(r"^(?:class|struct|enum class|enum|union)\s+(\w+)\b(?!\s*::)(?!.*;\s*$)|^using\s+(\w+)\s*=")
NAMES_OF_STANDARDS = {"apps/exchange/fmi2.h", "apps/exchange/fmi3.h"}


def names_twice():
    first = {}
    root = SOURCE.parent
    for file in sorted([*SOURCE.rglob("*.h"), *(root / "apps").rglob("*.h")]):
        name = str(file.relative_to(root))
        if file.stem.endswith("_testing") or name in NAMES_OF_STANDARDS:
            continue
        for number, line in enumerate(file.read_text().splitlines(), 1):
            if not (match := TYPE.match(line.split("//")[0])):
                continue
            type_name = match.group(1) or match.group(2)
            other = first.setdefault(type_name, name)
            if other != name:
                yield f"{name}:{number}: the type {type_name} is also in {other}: one of them needs another name"


def crowds():
    for top in ("src", "apps", "benchmarks", "verification", "tools"):
        for folder in [SOURCE.parent / top, *(SOURCE.parent / top).rglob("*")]:
            if {"node_modules", "dist"} & set(folder.parts):  # folders that npm has made
                continue
            files = sum(1 for file in folder.iterdir() if file.is_file()) if folder.is_dir() else 0
            if files > MOST_FILES:
                yield f"{folder.relative_to(SOURCE.parent)}: {files} files in one folder, at most {MOST_FILES}: make rooms"


def wide_comments():
    for top in ("src", "apps", "benchmarks", "verification"):
        for file in sorted([*(SOURCE.parent / top).rglob("*.h"), *(SOURCE.parent / top).rglob("*.cpp")]):
            for number, line in enumerate(file.read_text().splitlines(), 1):
                if len(line) > MOST_COLUMNS and "//" in line:
                    yield f"{file.relative_to(SOURCE.parent)}:{number}: {len(line)} columns, at most {MOST_COLUMNS}: wrap the comment"


def kinds_by_name():
    for folder in (SOURCE / KNOWS_NO_MODEL, SOURCE.parent / "apps"):
        for file in sorted([*folder.rglob("*.h"), *folder.rglob("*.cpp")]):
            for number, line in enumerate(file.read_text().splitlines(), 1):
                if KIND_BY_NAME.search(line) and not file.stem.endswith("_test"):
                    yield f"{file.relative_to(SOURCE.parent)}:{number}: asks which kind of model it has; ask for a capability"


def writers():
    for folder in (SOURCE, SOURCE.parent / "apps"):
        for file in sorted([*folder.rglob("*.h"), *folder.rglob("*.cpp")]):
            if file in (SOURCE / "base/file.cpp", SOURCE.parent / APPENDS) or re.search("_test(ing)?[.]", file.name):
                continue
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = WRITING.search(line.split("//")[0])
                if match:
                    yield f"{file.relative_to(SOURCE.parent)}:{number}: {match[1]}: files are written by base/file.h"


# Return types that a simulation must not use for a failure. It has to return a Result or a Status (base/result.h),
# which carries the reason as a Failure.
OTHER_OUTCOMES = {
    re.compile(r"\boptional<\s*(?:latsch::)?Failure\s*>"): "a Status says whether there is a Failure",
    re.compile(r"\bResult<\s*(?:bool|void|std::monostate)\s*>"): "a Result without a value is a Status",
    re.compile(r"!\w+\.empty\(\)\)\s*\{?\s*return\s+(?:latsch::)?Failure\{"): "a text that is empty on success is a Status",
}
OUTCOMES_THEMSELVES = "base/result.h"


def other_outcomes(text):
    """Returns (line, advice) for each function that returns the outcome of a simulation in another type than Result
    or Status."""
    return sorted((text.count("\n", 0, match.start()) + 1, advice)
                  for pattern, advice in OTHER_OUTCOMES.items() for match in pattern.finditer(text))


def outcomes():
    for folder in (SOURCE, SOURCE.parent / "apps"):
        for file in sorted([*folder.rglob("*.h"), *folder.rglob("*.cpp")]):
            if file == SOURCE / OUTCOMES_THEMSELVES:
                continue
            for line, advice in other_outcomes(file.read_text()):
                yield f"{file.relative_to(SOURCE.parent)}:{line}: {advice} (src/base/result.h)"


# A .cpp file has a header of the same name, or a header in its folder that mentions the file, that declares the type
# after which the file is named, or with whose name the file's name begins. Programs, Python modules and tables of keys
# (*_keys.cpp) need no header.
BEGINS_A_PROGRAM = re.compile(r"^(?:int main|PYBIND11_MODULE)\(", re.M)
KEYS = "_keys"


def camel_case(name):
    return "".join(part.capitalize() for part in name.split("_"))


def is_named_by(stem, header_stem, header):
    """True if the text of a header says that the source file STEM.cpp implements a part of it; `header_stem` is the
    header's name without extension."""
    return (stem.startswith(header_stem + "_")
            or re.search(rf"\b(?:\w+_)?{stem}\(|\bk{camel_case(stem)}Test\b|\b{stem}\.cpp\b", header) is not None)


def has_header(file):
    text = file.read_text()
    if file.with_suffix(".h").is_file() or BEGINS_A_PROGRAM.search(text):
        return True
    if file.stem.endswith(KEYS) and re.search(rf"\bKeySection& {file.stem}\(\)", text):
        return True
    return any(is_named_by(file.stem, header.stem, header.read_text()) for header in sorted(file.parent.glob("*.h")))


def lonely_files():
    root = SOURCE.parent
    for top in (SOURCE, root / "apps", root / "verification", root / "benchmarks", root / "examples"):
        for file in sorted(top.rglob("*.cpp")):
            name = str(file.relative_to(root))
            if file.stem.endswith(("_test", "_testing")) or "node_modules" in file.parts or has_header(file):
                continue
            yield (f"{name}: no {file.stem}.h is beside it, and no header of its folder names it: give it one, name it "
                   f"after its header, or write its name where its header declares what it contains")


def test():
    """Tests the checks of texts: every forbidden spelling is found, and the two allowed ones are not."""
    header = "Result<Rest> settle();  // statics.cpp\nvoid add_check(App&);\nextern const TestKind kAxleKcTest;\nJson home_view(int);"
    for named in ("statics", "check", "axle_kc", "home_view", "car_settling"):
        assert is_named_by(named, "car", header), named
    for lonely in ("static", "dynamics", "kc", "home", "carpet", "settling"):
        assert not is_named_by(lonely, "car", header), lonely
    for refused in ("std::optional<Failure> start();", "optional<latsch::Failure> why;", "Result<bool> film();",
                    "if (const std::string why = torn(); !why.empty())\n    return Failure{why};"):
        assert [line for line, _ in other_outcomes("\n" + refused)] == [2], refused
    assert not may_use(pathlib.Path("models/fe_tire/analysis/fe_tire.h"), NARROW_ROOMS["exchange/unit"])
    assert may_use(pathlib.Path("formats/road/road_file.h"), NARROW_ROOMS["exchange/unit"])
    for meant in ("Status start();", "Result<double> height();", "Result<std::vector<bool>> held();",
                  "if (!names.empty()) return Channels{names};"):
        assert not other_outcomes(meant), meant


if __name__ == "__main__":
    if sys.argv[1:] == ["--test"]:
        sys.exit(test())
    found = [*faults(), *models_in_verbs(), *names_twice(), *crowds(), *wide_comments(), *kinds_by_name(), *writers(),
             *outcomes(), *lonely_files()]
    print("\n".join(found) or "layers: every #include follows the architecture")
    sys.exit(1 if found else 0)
