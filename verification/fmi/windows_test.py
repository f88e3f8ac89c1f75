#!/usr/bin/env python3
"""Runs units through their libraries for Windows, under wine, and for Linux, and compares the outputs.

   windows_test.py LATSCH UNIT_CALLER BUILD_OF_WINDOWS

The libraries for Windows are those of the preset units-windows; without them or without wine the tests are skipped, and
say what is missing. Claims: outputs within 1e-9 of the largest, accelerations of the car and forces of its push-rods
within 1e-8, because Windows has another libm; the same bits for stacks of any phase and for every set of instructions
that has the same arithmetic (AVX2, AVX-512); no instruction that moves 32 or 64 bytes by an aligned address other than
that of a constant, because Windows aligns stacks to 16 only."""
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77
LATSCH, CALLER, BUILD = (pathlib.Path(word) for word in sys.argv[1:4])
WINDOWS_CALLER = BUILD / "bin/unit_caller.exe"
WINE = shutil.which("wine64") or shutil.which("wine") or next(
    (str(file) for file in [pathlib.Path("/usr/lib/wine/wine64")] if file.exists()), None)
OBJDUMP = shutil.which("x86_64-w64-mingw32-objdump")
KINDS = {"ring": "ring_tires/passenger_205_55R16.toml", "rigid_ring": "tire_model_comparison/rigid_ring.tir",
         "magic_formula": "tire_model_comparison/magic_formula.tir", "car": "kerb/baseline.toml"}
TIRE_INPUTS = {"wheel.x": "0+15", "wheel.z": "0.3", "wheel.vx": "15", "wheel.yaw": "0+0.1", "wheel.wz": "0.1",
               "wheel.spin": "0+48", "wheel.spin_rate": "48"}
CAR_INPUTS = {"speed": "15", "rack.travel": "0+0.02", "rack.velocity": "0.02", "drive.RL": "100", "drive.RR": "100"}
# Shares of the largest value. An acceleration of the car, and so the force of a push-rod, contains a difference of
# velocities over a step of 0.2 ms, which enlarges a difference of the last digits of velocities ten thousand times.
LIMIT, LIMIT_OF_DIFFERENCES = 1e-9, 1e-8
DIFFERENCES = re.compile(r"chassis\.a[xyz]$|pushrod\.")
PARAMETERS_OF_START = {"speed"}  # cannot be set later


class Unit:
    """A package that was exported and unpacked."""

    def __init__(self, folder, kind, version):
        self.version, self.kind = version, kind
        file = folder / f"{kind}_{version}.fmu"
        subprocess.run([LATSCH, "export", ROOT / "studies" / KINDS[kind], "--fmu", f"{version}.0", "-o", file],
                       check=True, capture_output=True)
        self.folder = folder / f"{kind}_{version}"
        with zipfile.ZipFile(file) as package:
            package.extractall(self.folder)
        description = xml.etree.ElementTree.parse(self.folder / "modelDescription.xml").getroot()
        self.token = description.get("guid" if version == 2 else "instantiationToken")
        self.references = {one.get("name"): one.get("valueReference") for one in description.find("ModelVariables")}
        self.outputs = [one.get("valueReference") for one in description.find("ModelVariables")
                        if one.get("causality") == "output"]
        self.names = [one.get("name") for one in description.find("ModelVariables")
                      if one.get("causality") == "output"]
        self.binary = next((self.folder / "binaries").rglob("*.so"))

    def run(self, windows, steps=50, phase=0, resources=None, kernels=None, start=None):
        """Returns the outputs of every step, as texts of their bits."""
        place = resources or self.folder / "resources"
        where = f"Z:{place}" if windows else str(place)
        if self.version == 2:
            where = f"file:///{where}" if windows else f"file://{where}"
        inputs = CAR_INPUTS if self.kind == "car" else TIRE_INPUTS
        given = [f"{self.references[name]}={value}" for name, value in inputs.items() if name not in PARAMETERS_OF_START]
        library = BUILD / f"lib/latsch/latsch_fmi{self.version}.dll" if windows else self.binary
        command = [str(self.version), f"Z:{library}" if windows else library, where, self.token, str(steps), "0.001",
                   str(phase), *given, *self.outputs]
        environment = {**os.environ, "WINEDEBUG": "-all", **({"LATSCH_KERNELS": kernels} if kernels else {})}
        run = subprocess.run([WINE, WINDOWS_CALLER, *command] if windows else [CALLER, *command], capture_output=True,
                             text=True, env=environment, timeout=600)
        if run.returncode:
            raise AssertionError(f"{self.kind}, FMI {self.version}: {run.returncode} {run.stderr}")
        return [line.split() for line in run.stdout.splitlines()]


def number(bits):
    return struct.unpack(">d", bytes.fromhex(bits))[0]


class Windows(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="latsch_windows_")
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        os.environ["WINEPREFIX"] = str(cls.folder / "wine")
        cls.units = {(kind, version): Unit(cls.folder, kind, version) for kind in KINDS for version in (2, 3)}

    def test_the_outputs_are_those_of_linux(self):
        for (kind, version), unit in self.units.items():
            linux, windows = unit.run(False), unit.run(True)
            self.assertEqual(len(linux), 51)
            self.assertEqual([len(row) for row in linux], [len(row) for row in windows])
            for column in range(len(linux[0])):
                a, b = ([number(row[column]) for row in rows] for rows in (linux, windows))
                worst = max(abs(x - y) for x, y in zip(a, b))
                limit = LIMIT_OF_DIFFERENCES if DIFFERENCES.match(unit.names[column]) else LIMIT
                self.assertLessEqual(worst, limit * max(*map(abs, a), 1.0), (kind, version, unit.names[column]))

    def test_every_stack_and_kernel_set_gives_the_same_bits(self):
        unit = self.units["ring", 3]
        expected = unit.run(True, 20)
        for phase in (16, 32, 48):
            self.assertEqual(unit.run(True, 20, phase), expected, phase)
        sets = {name: unit.run(True, 20, 16, kernels=name) for name in ("baseline", "avx2")}
        self.assertTrue(expected == sets["avx2"] or expected == sets["baseline"])

    def test_folders_have_any_name(self):
        unit = self.units["magic_formula", 3]
        for name in ("with blanks", "\u00fc\u00e4", "\u8f6e\u80ce"):
            place = self.folder / name
            shutil.copytree(unit.folder / "resources", place)
            self.assertEqual(unit.run(True, 2, resources=place), unit.run(True, 2), name)

    @unittest.skipUnless(OBJDUMP, "objdump of mingw is missing: apt-get install binutils-mingw-w64-x86-64")
    def test_no_wide_instruction_relies_on_the_stack(self):
        aligned = re.compile(r"\tv?mov(?:ap[sd]|dqa(?:32|64)?|nt\w+)\s+(.*)")
        for library in sorted((BUILD / "lib/latsch").glob("latsch_*.dll")):
            listing = subprocess.run([OBJDUMP, "-d", "--no-show-raw-insn", library], check=True, capture_output=True, text=True)
            wide, wrong = 0, []
            for line in listing.stdout.splitlines():
                if "%ymm" not in line and "%zmm" not in line:
                    continue
                wide += 1
                match = aligned.search(line)
                if match and "(" in match[1] and "(%rip)" not in match[1]:
                    wrong.append(line.strip())
            self.assertGreater(wide, 1000)
            self.assertEqual(wrong, [])


def main():
    missing = []
    if not WINDOWS_CALLER.exists() or not (BUILD / "lib/latsch/latsch_fmi3.dll").exists():
        missing.append(f"there are no libraries for Windows in {BUILD}: cmake --preset units-windows && cmake --build "
                       "--preset units-windows makes them (Debian: g++-mingw-w64-x86-64-posix)")
    if WINE is None:
        missing.append("wine is missing (Debian: wine64)")
    if missing:
        print("skipped: " + "; ".join(missing))
        return SKIPPED
    del sys.argv[1:]
    return 0 if unittest.main(exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
