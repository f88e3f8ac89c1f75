#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Rolls tires through the library of the Standard Tyre Interface for Windows, under wine, and through that for Linux, and
compares forces and moments.

   windows_test.py LATSCH STI_CALLER LIBRARY_OF_LINUX BUILD_OF_WINDOWS

The library for Windows is that of the preset units-windows; without it or without wine the test is skipped, and says
what is missing. Claims: forces and moments within 1e-9 of the largest, because Windows has another libm; a folder may
have any name; a wrong file is refused with its reason."""
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77
LATSCH, CALLER, LIBRARY, BUILD = (pathlib.Path(word) for word in sys.argv[1:5])
WINDOWS_CALLER, WINDOWS_LIBRARY = BUILD / "bin/sti_caller.exe", BUILD / "lib/latsch/latsch_sti.dll"
WINE = shutil.which("wine64") or shutil.which("wine") or next(
    (str(file) for file in [pathlib.Path("/usr/lib/wine/wine64")] if file.exists()), None)
KINDS = {"ring": "ring_tires/passenger_205_55R16.toml", "rigid_ring": "tire_model_comparison/rigid_ring.tir",
         "magic_formula": "tire_model_comparison/magic_formula.tir"}
STEPS, STEP, SPEED = 50, 0.001, 10.0
LIMIT = 1e-9  # share of the largest force or moment
# Height of the axle and spin rate: a tire of 0.31 to 0.34 m radius that carries some kN and is driven a little.
HEIGHT, SPIN_RATE = 0.295, 33.0


class Windows(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="latsch_sti_windows_")
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)
        os.environ["WINEPREFIX"] = str(cls.folder / "wine")
        for kind, file in KINDS.items():
            subprocess.run([LATSCH, "export", ROOT / "studies" / file, "--sti", "-o", cls.folder / kind], check=True,
                           capture_output=True)

    def call(self, windows, file, road="-"):
        numbers = (str(number) for number in (STEPS, STEP, HEIGHT, SPEED, SPIN_RATE))
        place = lambda path: f"Z:{path}" if windows else str(path)
        command = [place(WINDOWS_LIBRARY if windows else LIBRARY), place(file), road if road == "-" else place(road)]
        return subprocess.run([*([WINE, WINDOWS_CALLER] if windows else [CALLER]), *command, *numbers], text=True,
                              capture_output=True, env={**os.environ, "WINEDEBUG": "-all"}, timeout=600)

    def run_of(self, windows, file, road="-"):
        """Returns forces (N) and moments (N m) of every step."""
        run = self.call(windows, file, road)
        self.assertEqual(run.returncode, 0, run.stderr)
        return [[struct.unpack(">d", bytes.fromhex(bits))[0] for bits in line.split()] for line in run.stdout.splitlines()]

    def assert_near(self, one, other, what):
        self.assertEqual(len(one), STEPS + 1)
        self.assertEqual(len(other), STEPS + 1)
        for columns in (slice(0, 3), slice(3, 6)):
            a, b = ([value for row in rows for value in row[columns]] for rows in (one, other))
            largest = max(map(abs, a))
            self.assertGreater(largest, 1.0, what)
            self.assertLessEqual(max(abs(x - y) for x, y in zip(a, b)), LIMIT * largest, what)

    def test_forces_and_moments_are_those_of_linux(self):
        for kind in KINDS:
            file = self.folder / kind / "unit.toml"
            linux = self.run_of(False, file)
            self.assertGreater(max(row[2] for row in linux), 500.0, kind)  # it carries a load
            self.assert_near(linux, self.run_of(True, file), kind)

    def test_files_of_tire_and_road_may_have_any_name(self):
        road = "kind = \"drum\"\ndiameter = \"2.5 m\"\n"
        for name in ("with blanks", "\u00fc\u00e4", "\u8f6e\u80ce"):
            place = self.folder / name
            shutil.copytree(self.folder / "magic_formula", place)
            (place / "road.toml").write_text(road)
            file = place / "unit.toml"
            self.assert_near(self.run_of(False, file, place / "road.toml"), self.run_of(True, file, place / "road.toml"), name)

    def test_a_file_that_is_no_tire_is_refused_with_its_reason(self):
        for windows in (False, True):
            run = self.call(windows, self.folder / "gone" / "unit.toml")
            self.assertEqual(run.returncode, 2)
            self.assertIn("unit.toml", run.stderr)


def main():
    missing = []
    if not WINDOWS_CALLER.exists() or not WINDOWS_LIBRARY.exists():
        missing.append(f"there is no library for Windows in {BUILD}: cmake --preset units-windows && cmake --build "
                       "--preset units-windows makes it (Debian: g++-mingw-w64-x86-64-posix)")
    if WINE is None:
        missing.append("wine is missing (Debian: wine64)")
    if missing:
        print("skipped: " + "; ".join(missing))
        return SKIPPED
    del sys.argv[1:]
    return 0 if unittest.main(exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
