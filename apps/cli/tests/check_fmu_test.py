#!/usr/bin/env python3
"""Tests that tools/check_fmu.py finds what is wrong in a package: each fault is put into a package without faults."""
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

from cli_testing import DONE, LATSCH

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tools"))
import check_fmu

RING = ROOT / "studies/ring_tires/passenger_205_55R16.toml"
DESCRIPTION = "modelDescription.xml"


class CheckFmu(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="latsch_fmu_")
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.packages = {}
        for version in ("2.0", "3.0"):
            file = cls.folder / f"tire_{version[0]}.fmu"
            run = subprocess.run([LATSCH, "export", RING, "--fmu", version, "-o", file], capture_output=True, text=True,
                                 timeout=300)
            assert run.returncode == DONE, run.stderr
            with zipfile.ZipFile(file) as package:
                cls.packages[version] = {name: package.read(name) for name in package.namelist()}

    def faults(self, entries):
        file = self.folder / "spoiled.fmu"
        with zipfile.ZipFile(file, "w") as package:
            for name, content in entries.items():
                package.writestr(name, content)
        return check_fmu.faults_of(file)[1]

    def expect_fault(self, version, part, change):
        entries = dict(self.packages[version])
        change(entries)
        self.assertNotEqual(entries, self.packages[version], "nothing was changed")
        self.assertTrue(any(part in fault for fault in self.faults(entries)), (part, self.faults(entries)))

    def test_files_of_the_model_are_there_and_in_si(self):
        for entry in ("resources/unit.toml", "resources/model.toml"):
            self.expect_fault("3.0", entry + ": is missing", lambda entries: entries.pop(entry))
            self.expect_fault("2.0", entry + ": is empty", lambda entries: entries.update({entry: b""}))
        self.expect_fault("3.0", "is not in SI", self.replaced(' Pa"', ' bar"', "resources/model.toml"))
        self.expect_fault("3.0", "licenses: is missing", lambda entries: [
            entries.pop(name) for name in list(entries) if name.startswith("documentation/licenses")])
        self.assertIn("cannot be read", check_fmu.faults_of(self.folder / "nosuch.fmu")[1][0])

    def replaced(self, old, new, entry=DESCRIPTION):
        def change(entries):
            entries[entry] = entries[entry].replace(old.encode(), new.encode(), 1)
        return change

    def test_a_package_as_exported_has_no_fault(self):
        for version, entries in self.packages.items():
            self.assertEqual(self.faults(entries), [], version)

    def test_every_fault_is_found(self):
        two, three = "binaries/linux64/tire_2.so", "binaries/x86_64-linux/tire_3.so"
        for version, part, change in [
                ("3.0", "inside the package", lambda e: e.update({"../x": b""})),
                ("3.0", "inside the package", lambda e: e.update({"a\\b": b""})),
                ("3.0", "ASCII", lambda e: e.update({"resources/\u00fc": b""})),
                ("2.0", "is missing", lambda e: e.pop(DESCRIPTION)),
                ("2.0", "not well-formed", self.replaced("<ModelVariables>", "<ModelVariables")),
                ("2.0", "found fmiModelDescription of 1.0", self.replaced('fmiVersion="2.0"', 'fmiVersion="1.0"')),
                ("3.0", "C identifier", self.replaced('modelIdentifier="tire_3"', 'modelIdentifier="3 tire"')),
                ("3.0", "as modelIdentifier says", self.replaced('modelIdentifier="tire_3"', 'modelIdentifier="other"')),
                ("2.0", "another token", self.replaced('guid="{', 'guid="{0')),
                ("3.0", "taken twice", self.replaced('name="wheel.y"', 'name="wheel.x"')),
                ("3.0", "taken twice", self.replaced('valueReference="4"', 'valueReference="3"')),
                ("2.0", "expected a start", self.replaced(' start="0"', "")),
                ("3.0", "not defined", self.replaced('unit="Pa" start', 'unit="bar" start')),
                ("2.0", "exponents", self.replaced('s="-2"', 's="-1"')),
                ("3.0", "Output lists", self.replaced("    <Output ", "    <Event ")),
                ("2.0", "InitialUnknown lists", self.replaced('index="18"/>', 'index="19"/>')),
                ("2.0", "there is none", lambda e: e.pop(two)),
                ("3.0", "expected a folder of", lambda e: e.update({"binaries/x86-linux/tire_3.so": e.pop(three)})),
                ("2.0", "is no ELF library", lambda e: e.update({two: b"MZ" + e[two]})),
                ("3.0", "does not export fmi3DoStep", self.replaced("fmi3DoStep\0", "fmi3DoStop\0", three)),
                ("3.0", "more symbols than the standard", self.replaced("fmi3DoStep\0", "fmi3DoStop\0", three)),
                ("2.0", "which a bare machine lacks", self.replaced("libm.so.6\0", "libq.so.6\0", two)),
                ("2.0", "at most", self.replaced("GLIBC_2.34\0", "GLIBC_2.39\0", two)),
                ("3.0", "at most 6 MB", lambda e: e.update({three: e[three] + bytes(3_000_000)}))]:
            with self.subTest(part=part):
                self.expect_fault(version, part, change)

    def test_a_data_descriptor_and_a_file_that_is_no_package_are_found(self):
        file = self.folder / "streamed.fmu"
        with open(file, "wb") as stream, zipfile.ZipFile(Unseekable(stream), "w") as package:
            for name, content in self.packages["2.0"].items():
                package.writestr(name, content)
        self.assertTrue(any("data descriptor" in fault for fault in check_fmu.faults_of(file)[1]))
        file.write_bytes(b"no package")
        self.assertIn("is no ZIP file", check_fmu.faults_of(file)[1][0])


class Unseekable:
    """A stream whose writer cannot go back, so that an archive states sizes behind the content."""

    def __init__(self, stream):
        self.stream = stream

    def write(self, data):
        return self.stream.write(data)

    def flush(self):
        self.stream.flush()


if __name__ == "__main__":
    unittest.main()
