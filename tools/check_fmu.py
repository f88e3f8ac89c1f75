#!/usr/bin/env python3
"""Checks packages of FMI 2.0 and 3.0 by the rules that importing programs apply, with Python's standard library alone.

    tools/check_fmu.py tire.fmu ...            # prints what a package holds and every fault; exit code 1 for a fault
    tools/check_fmu.py --any-libraries fe.fmu  # a package whose binary may need libraries that a bare machine lacks

Archive: names, flags and methods that every unzip reads. Description: identifier, token, names, references, starts, units
and their exponents, structure. Binaries: for the platform of their folder, with exactly the functions of the standard,
and for Linux with libraries and symbols that glibc 2.36 has, for Windows with imports that every Windows has."""
import argparse
import pathlib
import re
import struct
import sys
import xml.etree.ElementTree
import zipfile

LARGEST = {"linux": 6e6, "windows": 7e6}  # bytes of a library
SI = {"m", "kg", "s", "A", "K", "mol", "cd", "rad", "N", "Pa", "Hz", "W", "J"}  # units of a package, format 2
LARGEST_PACKAGE = 5.5e6  # bytes
NEWEST_GLIBC = (2, 36)
# The dynamic loader is a part of glibc.
OF_GLIBC = {"libc.so.6", "libm.so.6", "libpthread.so.0", "ld-linux-x86-64.so.2"}
OF_WINDOWS = {"kernel32.dll", "msvcrt.dll"}
PLATFORMS = {"2.0": {"linux64": "linux", "win64": "windows"},
             "3.0": {"x86_64-linux": "linux", "x86_64-windows": "windows"}}
ENDINGS = {"linux": ".so", "windows": ".dll"}
TOKEN = {"2.0": "guid", "3.0": "instantiationToken"}

# Functions that every library for co-simulation has to export [FMI 2.0.5, 2.1 and 4.2; FMI 3.0.2, 2.2 and 4.2].
BOTH = """GetVersion SetDebugLogging FreeInstance EnterInitializationMode ExitInitializationMode Terminate Reset
GetString GetBoolean SetString SetBoolean GetDirectionalDerivative DoStep"""
FUNCTIONS = {
    "2.0": BOTH + """ GetTypesPlatform Instantiate SetupExperiment GetReal GetInteger SetReal SetInteger GetFMUstate
SetFMUstate FreeFMUstate SerializedFMUstateSize SerializeFMUstate DeSerializeFMUstate SetRealInputDerivatives
GetRealOutputDerivatives CancelStep GetStatus GetRealStatus GetIntegerStatus GetBooleanStatus GetStringStatus""",
    "3.0": BOTH + """ InstantiateModelExchange InstantiateCoSimulation InstantiateScheduledExecution EnterEventMode
GetFloat32 GetFloat64 GetInt8 GetUInt8 GetInt16 GetUInt16 GetInt32 GetUInt32 GetInt64 GetUInt64 GetBinary GetClock
SetFloat32 SetFloat64 SetInt8 SetUInt8 SetInt16 SetUInt16 SetInt32 SetUInt32 SetInt64 SetUInt64 SetBinary SetClock
GetNumberOfVariableDependencies GetVariableDependencies GetFMUState SetFMUState FreeFMUState SerializedFMUStateSize
SerializeFMUState DeserializeFMUState GetAdjointDerivative EnterConfigurationMode ExitConfigurationMode
GetIntervalDecimal GetIntervalFraction GetShiftDecimal GetShiftFraction SetIntervalDecimal SetIntervalFraction
SetShiftDecimal SetShiftFraction EvaluateDiscreteStates UpdateDiscreteStates EnterContinuousTimeMode
CompletedIntegratorStep SetTime SetContinuousStates GetContinuousStateDerivatives GetEventIndicators
GetContinuousStates GetNominalsOfContinuousStates GetNumberOfEventIndicators GetNumberOfContinuousStates
EnterStepMode GetOutputDerivatives ActivateModelPartition""",
}
# One library may serve several standards: FMI 2 and 3 and the Standard Tyre Interface.
OF_STANDARDS = {f"fmi{version[0]}{one}" for version, names in FUNCTIONS.items() for one in names.split()} | {
    "dtyre", "dtyre_", "latsch_sti_message"}

# Exponents of kg, m, s, rad.
UNITS = {"kg": (1, 0, 0, 0), "m": (0, 1, 0, 0), "s": (0, 0, 1, 0), "rad": (0, 0, 0, 1), "N": (1, 1, -2, 0),
         "Pa": (1, -1, -2, 0), "W": (1, 2, -3, 0), "Hz": (0, 0, -1, 0), "J": (1, 2, -2, 0), "1": (0, 0, 0, 0)}


class Spoiled(Exception):
    """A file that cannot be read on."""


def exponents_of(name):
    """Returns the exponents of a unit such as "N m/rad"; None if the name is not known."""
    total = [0, 0, 0, 0]
    for side, product in zip((1, -1), name.split("/", 1)):
        for factor in product.strip("()").split():
            base, _, power = factor.partition("^")
            if base not in UNITS:
                return None
            total = [t + side * int(power or 1) * e for t, e in zip(total, UNITS[base])]
    return tuple(total)


def archive_faults(package):
    """Finds entries that some unzip does not read, or that would leave the folder."""
    seen = set()
    for entry in package.infolist():
        name = entry.filename
        if name in seen:
            yield f"{name}: is twice in the archive"
        seen.add(name)
        if not name.isascii():
            yield f"{name!r}: expected ASCII alone in a name"
        if name.startswith("/") or "\\" in name or ":" in name or ".." in name.split("/"):
            yield f"{name}: expected a path inside the package, with slashes"
        if entry.flag_bits & 0x1:
            yield f"{name}: is encrypted"
        if entry.flag_bits & 0x8:
            yield f"{name}: has its sizes behind its content (a data descriptor), which some importers do not read"
        if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            yield f"{name}: is compressed by method {entry.compress_type}, expected none or deflate"
    if (broken := package.testzip()) is not None:
        yield f"{broken}: its check sum is wrong"


class Description:
    """The content of modelDescription.xml, in the words of both versions."""

    def __init__(self, text):
        try:
            self.root = xml.etree.ElementTree.fromstring(text)
        except xml.etree.ElementTree.ParseError as error:
            raise Spoiled(f"modelDescription.xml: {error}") from error
        self.version = self.root.get("fmiVersion")
        if self.root.tag != "fmiModelDescription" or self.version not in FUNCTIONS:
            raise Spoiled(f"modelDescription.xml: expected fmiModelDescription of version 2.0 or 3.0, "
                          f"found {self.root.tag} of {self.version}")
        self.variables = list(self.root.find("ModelVariables"))
        self.simulation = self.root.find("CoSimulation")
        if self.simulation is None:
            raise Spoiled("modelDescription.xml: has no CoSimulation")

    @property
    def identifier(self):
        return self.simulation.get("modelIdentifier", "")

    def value(self, variable, name):
        """Returns an attribute of a variable's value, which FMI 2.0 has in an element of its own."""
        return (variable[0] if self.version == "2.0" else variable).get(name)

    def listed(self, what):
        """Returns the references that a list of ModelStructure names: "Output" or "InitialUnknown"."""
        structure = self.root.find("ModelStructure")
        if self.version == "3.0":
            return [one.get("valueReference") for one in structure.findall(what)]
        places = [int(one.get("index")) for one in structure.findall(f"{what}s/Unknown")]
        return [self.variables[i - 1].get("valueReference") if 0 < i <= len(self.variables) else "nowhere" for i in places]

    def faults(self):
        if not re.fullmatch(r"[A-Za-z_]\w*", self.identifier, re.ASCII):
            yield f"modelIdentifier is {self.identifier!r}: expected a C identifier"
        if not self.root.get(TOKEN[self.version]):
            yield f"{TOKEN[self.version]} is missing"
        yield from self.variable_faults()
        yield from self.unit_faults()
        outputs = [one.get("valueReference") for one in self.variables if one.get("causality") == "output"]
        for what in ("Output", "InitialUnknown"):
            listed = self.listed(what)
            if sorted(listed) != sorted(outputs):
                yield f"ModelStructure: {what} lists {len(listed)} variables that are not exactly the {len(outputs)} outputs"
        experiment = self.root.find("DefaultExperiment")
        if experiment is not None and not float(experiment.get("stepSize", 1)) > 0.0:
            yield "DefaultExperiment: expected a step above 0"

    def variable_faults(self):
        names, references = set(), set()
        for variable in self.variables:
            name, reference, causality = (variable.get(key) for key in ("name", "valueReference", "causality"))
            if name in names:
                yield f"variable {name}: the name is taken twice"
            if reference in references:
                yield f"variable {name}: the reference {reference} is taken twice"
            names.add(name)
            references.add(reference)
            start = self.value(variable, "start")
            if causality in ("input", "parameter") and start is None:
                yield f"variable {name}: expected a start for an {causality}"
            if causality in ("output", "independent") and start is not None:
                yield f"variable {name}: an {causality} that is calculated has no start"
            if causality == "parameter" and variable.get("variability") not in ("fixed", "tunable"):
                yield f"variable {name}: a parameter is fixed or tunable"
        if [one.get("causality") for one in self.variables].count("independent") != 1:
            yield "expected one independent variable, the time"

    def unit_faults(self):
        defined = {}
        for unit in self.root.findall("UnitDefinitions/Unit"):
            base = unit.find("BaseUnit")
            defined[unit.get("name")] = tuple(int(base.get(key, 0)) for key in ("kg", "m", "s", "rad"))
            if float(base.get("factor", 1)) != 1.0 or float(base.get("offset", 0)) != 0.0:
                yield f"unit {unit.get('name')}: expected SI without factor and offset"
        for name, exponents in defined.items():
            if exponents_of(name) != exponents:
                yield f"unit {name}: the exponents of kg, m, s, rad are {exponents}, expected {exponents_of(name)}"
        for variable in self.variables:
            unit = self.value(variable, "unit")
            if unit is not None and unit not in defined:
                yield f"variable {variable.get('name')}: the unit {unit} is not defined"


class Elf:
    """What a shared library for Linux needs and exports [Tool Interface Standard, ELF 1.2; Linux Standard Base 5.0]."""
    SYMTAB, STRTAB, NEEDED, STRSZ, VERNEED, VERNEEDNUM = 6, 5, 1, 10, 0x6FFFFFFE, 0x6FFFFFFF

    def __init__(self, data):
        if data[:6] != b"\x7fELF\x02\x01" or struct.unpack_from("<H", data, 18)[0] != 62:
            raise Spoiled("is no ELF library for x86-64")
        self.data = data
        phoff, = struct.unpack_from("<Q", data, 32)
        size, count = struct.unpack_from("<HH", data, 54)
        self.loaded, dynamic = [], None
        for i in range(count):
            kind, _, offset, address, _, length = struct.unpack_from("<IIQQQQ", data, phoff + i * size)
            if kind == 1:
                self.loaded.append((address, offset, length))
            if kind == 2:
                dynamic = (offset, length)
        if dynamic is None:
            raise Spoiled("is no shared library")
        entries = [struct.unpack_from("<qQ", data, dynamic[0] + i) for i in range(0, dynamic[1], 16)]
        self.entries = entries[:[tag for tag, _ in entries].index(0)]
        self.table = dict(self.entries)
        self.strings = self.place(self.table[self.STRTAB])

    def place(self, address):
        for begin, offset, length in self.loaded:
            if begin <= address < begin + length:
                return offset + address - begin
        raise Spoiled("refers to an address outside of the file")

    def text(self, offset):
        begin = self.strings + offset
        return self.data[begin:self.data.index(b"\0", begin)].decode()

    def needed(self):
        return {self.text(value) for tag, value in self.entries if tag == self.NEEDED}

    def versions(self):
        """Returns the names of the versions of symbols that it needs, such as "GLIBC_2.34"."""
        found, at = set(), self.place(self.table[self.VERNEED]) if self.VERNEED in self.table else None
        for _ in range(self.table.get(self.VERNEEDNUM, 0)):
            _, count, _, auxiliary, following = struct.unpack_from("<HHIII", self.data, at)
            one = at + auxiliary
            for _ in range(count):
                _, _, _, name, further = struct.unpack_from("<IHHII", self.data, one)
                found.add(self.text(name))
                one += further
            at += following
        return found

    def exported(self):
        """Returns the names of the defined symbols; the table of symbols ends where its strings begin."""
        found, at = set(), self.place(self.table[self.SYMTAB])
        for symbol in range(at + 24, self.strings, 24):
            name, info, _, section, _, _ = struct.unpack_from("<IBBHQQ", self.data, symbol)
            if section not in (0, 0xFFF1) and info >> 4 in (1, 2):
                found.add(self.text(name))
        return found


class Pe:
    """What a library for Windows imports and exports [Microsoft, PE Format]."""

    def __init__(self, data):
        if data[:2] != b"MZ":
            raise Spoiled("is no library for Windows")
        self.data = data
        head, = struct.unpack_from("<I", data, 60)
        if data[head:head + 4] != b"PE\0\0" or struct.unpack_from("<H", data, head + 4)[0] != 0x8664:
            raise Spoiled("is no library for Windows on x86-64")
        sections, optional = struct.unpack_from("<H12xH", data, head + 6)
        self.directories = head + 24 + 112
        self.sections = [struct.unpack_from("<8xIIII", data, head + 24 + optional + 40 * i) for i in range(sections)]

    def place(self, address):
        for size, begin, length, offset in self.sections:
            if begin <= address < begin + max(size, length):
                return offset + address - begin
        raise Spoiled("refers to an address outside of the file")

    def text(self, address):
        begin = self.place(address)
        return self.data[begin:self.data.index(b"\0", begin)].decode()

    def directory(self, i):
        return struct.unpack_from("<I", self.data, self.directories + 8 * i)[0]

    def needed(self):
        found, at = set(), self.place(self.directory(1))
        while (name := struct.unpack_from("<I", self.data, at + 12)[0]) != 0:
            found.add(self.text(name).lower())
            at += 20
        return found

    def exported(self):
        at = self.place(self.directory(0))
        count, _, names = struct.unpack_from("<III", self.data, at + 24)
        return {self.text(struct.unpack_from("<I", self.data, self.place(names) + 4 * i)[0]) for i in range(count)}


def version_of(text):
    return tuple(int(one) for one in text.split("."))


def library_faults(name, data, system, version, any_libraries):
    """Finds what keeps a library from being loaded on another machine."""
    library = Elf(data) if system == "linux" else Pe(data)
    prefix = "fmi2" if version == "2.0" else "fmi3"
    expected = {prefix + one for one in FUNCTIONS[version].split()}
    exported = library.exported()
    for symbol in sorted(expected - exported):
        yield f"{name}: does not export {symbol}"
    if others := sorted(exported - OF_STANDARDS):
        yield f"{name}: exports {len(others)} more symbols than the standard has, such as {others[0]}"
    if any_libraries:
        return
    for other in sorted(library.needed() - (OF_GLIBC if system == "linux" else OF_WINDOWS)):
        yield f"{name}: needs {other}, which a bare machine lacks"
    if len(data) > LARGEST[system]:
        yield f"{name}: is {len(data) / 1e6:.1f} MB, expected at most {LARGEST[system] / 1e6:g} MB"
    if system == "linux":
        for needed in sorted(library.versions()):
            family, _, number = needed.partition("_")
            if family != "GLIBC" or version_of(number) > NEWEST_GLIBC:
                yield f"{name}: needs {needed}, expected GLIBC_{NEWEST_GLIBC[0]}.{NEWEST_GLIBC[1]} at most"


def binary_faults(package, description, any_libraries):
    folders = PLATFORMS[description.version]
    found = 0
    for name in package.namelist():
        if not name.startswith("binaries/") or name.endswith("/"):
            continue
        found += 1
        system = folders.get(name.split("/")[1])
        if system is None:
            yield f"{name}: expected a folder of {', '.join(folders)}"
        elif name.split("/")[2:] != [description.identifier + ENDINGS[system]]:
            yield f"{name}: expected the name {description.identifier}{ENDINGS[system]}, as modelIdentifier says"
        else:
            try:
                yield from library_faults(name, package.read(name), system, description.version, any_libraries)
            except struct.error:
                yield f"{name}: is cut off or damaged"
            except (Spoiled, KeyError, ValueError) as error:
                yield f"{name}: {error}"
    if not found:
        yield "binaries: there is none"


def resource_faults(package, description):
    """Yields what is wrong with the files from which the unit reads its model."""
    names = package.namelist()
    texts = {}
    for name in ("resources/unit.toml", "resources/model.toml"):
        if name not in names:
            yield f"{name}: is missing, and the unit reads it"
            continue
        try:
            texts[name] = package.read(name).decode()
        except (zipfile.BadZipFile, UnicodeDecodeError, OSError) as error:
            yield f"{name}: {error}"
            continue
        if not texts[name].strip():
            yield f"{name}: is empty"
    token = description.root.get(TOKEN[description.version])
    found = re.search(r'^token = "(.*)"$', texts.get("resources/unit.toml", ""), re.M)
    if found and found[1] != token:
        yield "resources/unit.toml: has another token than the description"
    elif not found and texts.get("resources/unit.toml", "").strip():
        yield "resources/unit.toml: has no token"
    if re.search(r"^format = 2$", texts.get("resources/unit.toml", ""), re.M):
        for line in texts.get("resources/model.toml", "").splitlines():
            for unit in re.findall(r'"[-+0-9.eE]+ ([^"]+)"', line):
                if not set(re.findall(r"[A-Za-z]+", unit)) <= SI:
                    yield f"resources/model.toml: {line.strip()[:60]!r} is not in SI"
        if not any(name.startswith("documentation/licenses") for name in names):
            yield "documentation/licenses: is missing, which names the licenses of the code inside the library"


def faults_of(file, any_libraries=False):
    """Returns (what the package is, its faults)."""
    try:
        package = zipfile.ZipFile(file)
    except OSError as error:
        return "no package", [f"cannot be read: {error.strerror}"]
    except zipfile.BadZipFile as error:
        return "no package", [f"is no ZIP file: {error}"]
    with package:
        faults = list(archive_faults(package))
        if "modelDescription.xml" not in package.namelist():
            return "no package", [*faults, "modelDescription.xml: is missing"]
        try:
            description = Description(package.read("modelDescription.xml"))
        except Spoiled as error:
            return "no package", [*faults, str(error)]
        faults += description.faults()
        faults += binary_faults(package, description, any_libraries)
        faults += resource_faults(package, description)
        size = pathlib.Path(file).stat().st_size
        if not any_libraries and size > LARGEST_PACKAGE:
            faults.append(f"is {size / 1e6:.1f} MB, expected at most {LARGEST_PACKAGE / 1e6:g} MB")
        systems = [one.split("/")[1] for one in package.namelist() if one.startswith("binaries/")]
        return (f"FMI {description.version}, {len(description.variables)} variables, {', '.join(systems)}, "
                f"{size / 1e6:.1f} MB"), faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packages", nargs="+", metavar="FILE.fmu")
    parser.add_argument("--any-libraries", action="store_true", help="binaries may be of any size and need any library")
    arguments = parser.parse_args()
    any_fault = False
    for file in arguments.packages:
        what, faults = faults_of(file, arguments.any_libraries)
        print(f"{file}: {what}{'' if faults else ', no fault'}")
        for fault in faults:
            print(f"  {fault}")
        any_fault = any_fault or bool(faults)
    return 1 if any_fault else 0


if __name__ == "__main__":
    sys.exit(main())
