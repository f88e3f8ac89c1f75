#!/usr/bin/env python3
"""Tests latsch export --fmu and --sti: the contents of a package, and its valid description.

The schemas of the standard, fmi2ModelDescription.xsd and fmi3ModelDescription.xsd with the files that they include,
are searched for in the folder that LATSCH_FMI_SCHEMAS names; if it is not set, only the structure of the descriptions
is checked."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

from cli_testing import DONE, LATSCH, WRONG_INPUT

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "tools"))
import check_fmu

STUDIES = pathlib.Path(__file__).resolve().parents[3] / "studies"
RING = STUDIES / "ring_tires/passenger_205_55R16.toml"
CAR = STUDIES / "kerb/baseline.toml"
RIGID_RING = STUDIES / "tire_model_comparison/rigid_ring.tir"
MAGIC_FORMULA = STUDIES / "tire_model_comparison/magic_formula.tir"
FE_TIRE = STUDIES / "tires/passenger_225_50R16.toml"
SUSPENSION = STUDIES / "kerb/front_rigid.toml"
XMLLINT = shutil.which("xmllint")
SCHEMAS = os.environ.get("LATSCH_FMI_SCHEMAS")
# the road '"10 mm"' high and '"25 mm"' long, as a package holds it
ROAD_IN_SI = 'kind = "cleat"\nheight = "0.01 m"\nlength = "0.025 m"\n'
VERSIONS = {"2.0": ("guid", "binaries/linux64/tire.so", "canGetAndSetFMUstate"),
            "3.0": ("instantiationToken", "binaries/x86_64-linux/tire.so", "canGetAndSetFMUState")}


def latsch(*arguments):
    run = subprocess.run([LATSCH, "export", *map(str, arguments)], capture_output=True, text=True, timeout=300)
    return run.returncode, run.stdout + run.stderr


class Exchange(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory(prefix="latsch_cli_")
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)

    def package(self, version, *more, name="tire.fmu"):
        file = self.folder / name
        code, said = latsch(RING, "--fmu", version, "-o", file, *more)
        self.assertEqual(code, DONE, said)
        return zipfile.ZipFile(file)

    def description(self, version, model=RING):
        file = self.folder / f"description_{version}.xml"
        code, said = latsch(model, "--fmu", version, "-o", self.folder / "described.fmu")
        self.assertEqual(code, DONE, said)
        with zipfile.ZipFile(self.folder / "described.fmu") as package:
            file.write_bytes(package.read("modelDescription.xml"))
        return file

    def test_a_package_holds_what_the_standard_has(self):
        for version, (_, library, _) in VERSIONS.items():
            with self.package(version) as package:
                self.assertIsNone(package.testzip())
                self.assertEqual(sorted(package.namelist()),
                                 sorted(["modelDescription.xml", library, "resources/unit.toml",
                                         "resources/model.toml", "resources/road.toml",
                                         "documentation/externalDependencies.txt",
                                         "documentation/licenses/licenses.txt"]))
                for entry in package.infolist():
                    self.assertIn(entry.compress_type, (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))
                    self.assertLessEqual(entry.extract_version, 20)
                self.assertTrue(package.read(library).startswith(b"\x7fELF"))

    def test_a_unit_of_finite_elements_has_the_library_that_can_make_it(self):
        for version in VERSIONS:
            file = self.folder / "fe.fmu"
            code, said = latsch(FE_TIRE, "--fmu", version, "-o", file)
            self.assertEqual(code, DONE, said)
            with zipfile.ZipFile(file) as package:
                self.assertNotIn("format = 2", package.read("resources/unit.toml").decode())
                self.assertIn(b"libmetis", package.read("documentation/externalDependencies.txt"))
            self.assertEqual(check_fmu.faults_of(file, any_libraries=True)[1], [])
            self.assertTrue(any("libmetis" in fault for fault in check_fmu.faults_of(file)[1]))

    def test_importers_find_no_fault_in_any_kind_of_unit(self):
        for version in VERSIONS:
            for model in (RING, RIGID_RING, MAGIC_FORMULA, CAR):
                file = self.folder / "any.fmu"
                code, said = latsch(model, "--fmu", version, "-o", file)
                self.assertEqual(code, DONE, said)
                self.assertEqual(check_fmu.faults_of(file)[1], [], model)

    def test_a_car_is_a_unit_with_its_suspensions_and_tires_in_one_file(self):
        road = self.folder / "kerb.toml"
        road.write_text('kind = "cleat"\nheight = "10 mm"\nlength = "25 mm"\n')
        for version in VERSIONS:
            file = self.folder / "car.fmu"
            code, said = latsch(CAR, "--fmu", version, "-o", file, "--road", road)
            self.assertEqual(code, DONE, said)
            with zipfile.ZipFile(file) as package:
                model = package.read("resources/model.toml").decode()
                self.assertIn('kind = "car"', package.read("resources/unit.toml").decode())
                self.assertEqual(package.read("resources/kerb.toml").decode(), ROAD_IN_SI)
                description = package.read("modelDescription.xml").decode()
            for table in ("front_suspension.", "rear_suspension.", "front_tire.", "rear_tire."):
                self.assertIn(table, model)
            self.assertNotIn("slick.tir", model)
            self.assertEqual(description.count('causality="parameter"'), 7)
            self.assertEqual(description.count('causality="input"'), 19)
            self.assertEqual(description.count('causality="output"'), 55)
            units = set(re.findall(r'<Unit name="([^"]+)"', description))
            self.assertLessEqual(set(re.findall(r' unit="([^"]+)"', description)), units)
        # The exported model can be read as a car and gives the same package.
        written = self.folder / "model.toml"
        written.write_text(model)
        again = self.folder / "again" / "car.fmu"
        again.parent.mkdir()
        code, said = latsch(written, "--fmu", "3.0", "-o", again, "--road", road)
        self.assertEqual(code, DONE, said)
        with zipfile.ZipFile(again) as package:
            self.assertEqual(package.read("resources/model.toml").decode(), model)

    def test_the_same_content_gives_the_same_bytes_and_another_another_token(self):
        road = self.folder / "kerb.toml"
        road.write_text('kind = "cleat"\nheight = "10 mm"\nlength = "25 mm"\n')
        for version, (token, _, _) in VERSIONS.items():
            def token_of(package):
                return re.search(token + '="([^"]+)"', package.read("modelDescription.xml").decode())[1]
            with self.package(version) as one, self.package(version, name="tire_2.fmu") as two, \
                    self.package(version, "--road", road, name="tire_3.fmu") as other:
                self.assertEqual(token_of(one), token_of(two))
                self.assertRegex(token_of(one), r"^\{[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\}$")
                self.assertNotEqual(token_of(one), token_of(other))
                self.assertIn(token_of(one), one.read("resources/unit.toml").decode())
                self.assertEqual(other.read("resources/kerb.toml").decode(), ROAD_IN_SI)
        first = (self.folder / "tire.fmu").read_bytes()
        self.package("3.0")
        self.assertEqual((self.folder / "tire.fmu").read_bytes(), first)

    @unittest.skipUnless(XMLLINT, "xmllint is not installed")
    def test_a_description_has_variables_units_and_structure_that_agree(self):
        for version, (token, _, state) in VERSIONS.items():
            file = self.description(version)

            def ask(path):
                run = subprocess.run([XMLLINT, "--xpath", path, file], capture_output=True, text=True, check=True)
                return run.stdout.strip()
            head = "/fmiModelDescription"
            self.assertEqual(ask(f"string({head}/@fmiVersion)"), version)
            self.assertNotEqual(ask(f"string({head}/@{token})"), "")
            self.assertEqual(ask(f"string({head}/CoSimulation/@modelIdentifier)"), "described")
            self.assertEqual(ask(f"string({head}/CoSimulation/@{state})"), "true")
            self.assertEqual(ask(f"string({head}/CoSimulation/@needsExecutionTool)"), "false")
            variables = f"{head}/ModelVariables/*"
            self.assertEqual(ask(f"count({variables}[@causality='independent'])"), "1")
            outputs = int(ask(f"count({variables}[@causality='output'])"))
            self.assertGreaterEqual(outputs, 13)
            self.assertEqual(ask(f"count({variables}[@causality='input'])"), "16")
            # Every input has a start, no output has one; every unit that is used is defined.
            value = "Real/" if version == "2.0" else ""
            self.assertEqual(ask(f"count({variables}[@causality='input'][not({value}@start)])"), "0")
            self.assertEqual(ask(f"count({variables}[@causality='output'][{value}@start])"), "0")
            self.assertEqual(
                ask(f"count({variables}[{value}@unit][not({value}@unit = {head}/UnitDefinitions/Unit/@name)])"), "0")
            references = re.findall('valueReference="([0-9]+)"', ask(f"{variables}/@valueReference"))
            self.assertEqual([int(one) for one in references], list(range(len(references))))
            # variables that are younger have the numbers behind those of the older ones
            self.assertEqual(ask(f"string({variables}[@name='contact.area']/@valueReference)"), "32")
            self.assertEqual(ask(f"string({variables}[@name='spin.is_free']/@valueReference)"), "33")
            # The section ModelStructure lists the outputs and nothing else.
            if version == "2.0":
                listed = re.findall('index="([0-9]+)"', ask(f"{head}/ModelStructure/Outputs/Unknown/@index"))
                self.assertEqual(len(listed), outputs)
                for place in listed:
                    self.assertEqual(ask(f"string({variables}[{place}]/@causality)"), "output")
            else:
                self.assertEqual(ask(f"count({head}/ModelStructure/Output)"), str(outputs))
                self.assertEqual(
                    ask(f"count({variables}[@causality='output']"
                        f"[not(@valueReference = {head}/ModelStructure/Output/@valueReference)])"), "0")

    @unittest.skipUnless(XMLLINT and SCHEMAS, "LATSCH_FMI_SCHEMAS names no folder with the standard's schemas")
    def test_a_description_is_one_by_the_schemas_of_the_standard(self):
        for version in VERSIONS:
            schema = pathlib.Path(SCHEMAS) / f"fmi{version[0]}ModelDescription.xsd"
            for model in (RING, RIGID_RING, MAGIC_FORMULA, FE_TIRE, CAR):
                run = subprocess.run([XMLLINT, "--noout", "--schema", schema, self.description(version, model)],
                                     capture_output=True, text=True)
                self.assertEqual(run.returncode, 0, run.stderr)

    def test_what_is_wrong_is_said(self):
        fmu = self.folder / "tire.fmu"
        for arguments, part in [((RING, "--fmu", "1.0", "-o", fmu), "1.0"),
                                ((RING, "--fmu", "3.0"), "-o"),
                                ((RING, "--fmu", "3.0", "-o", fmu, "--road", self.folder / "none.crg"), "none.crg"),
                                ((SUSPENSION, "--fmu", "3.0", "-o", fmu), "does not roll"),
                                ((RING, "--fmu", "3.0", "-o", fmu, "--platforms", "linux,mac"), '"mac"'),
                                ((FE_TIRE, "--fmu", "3.0", "-o", fmu, "--platforms", "windows"), "for Linux alone"),
                                ((SUSPENSION, "--sti"), "does not roll"),
                                ((RING, "-o", fmu), "--fmu"),
                                ((RING,), "--fmu")]:
            code, said = latsch(*arguments)
            self.assertEqual(code, WRONG_INPUT, said)
            self.assertIn(part, said)
            self.assertFalse(fmu.exists())

    def test_a_missing_library_is_named_where_it_is_demanded(self):
        fmu = self.folder / "tire.fmu"
        if (pathlib.Path(LATSCH).resolve().parents[1] / "lib/latsch/latsch_fmi3.dll").exists():
            self.skipTest("the libraries for Windows are there")
        code, said = latsch(RING, "--fmu", "3.0", "-o", fmu, "--platforms", "linux,windows")
        self.assertEqual(code, WRONG_INPUT, said)
        self.assertIn("latsch_fmi3.dll", said)
        self.assertFalse(fmu.exists())
        code, said = latsch(RING, "--fmu", "3.0", "-o", fmu)
        self.assertEqual(code, DONE, said)
        self.assertIn("runs on Linux", said)

    def test_sti_names_a_library_that_is_there(self):
        for tire in (RING, FE_TIRE):
            code, said = latsch(tire, "--sti")
            self.assertEqual(code, DONE, said)
            library = re.search(r"library +(\S+)", said)[1]
            self.assertTrue(pathlib.Path(library).is_file(), library)
            self.assertIn(str(tire), said)

    def test_sti_writes_a_folder_for_the_slim_library(self):
        with tempfile.TemporaryDirectory() as folder:
            code, said = latsch(RING, "--sti", "-o", f"{folder}/sti")
            self.assertEqual(code, DONE, said)
            self.assertRegex(said, r"library +\S+/latsch_sti\.so")
            self.assertIn(f"tire file {folder}/sti/unit.toml", said)
            self.assertEqual(sorted(path.name for path in pathlib.Path(folder, "sti").iterdir()),
                             ["model.toml", "road.toml", "unit.toml"])
            code, said = latsch(FE_TIRE, "--sti", "-o", f"{folder}/fe")
            self.assertEqual(code, WRONG_INPUT, said)
            self.assertIn("has finite elements", said)
            self.assertFalse(pathlib.Path(folder, "fe").exists())


if __name__ == "__main__":
    unittest.main()
