"""Support for the tests of the program: calls of the program, and studies for these calls."""
import contextlib
import pathlib
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest

LATSCH = sys.argv.pop(1) if len(sys.argv) > 1 else "latsch"

DONE, FAILED, WRONG_INPUT, STOPPED = 0, 1, 2, 130


def edit(file, *replacements):
    text = file.read_text()
    for pattern, new in replacements:
        text, count = re.subn(pattern, new, text)
        assert count, f"{pattern} is not in {file}"
    file.write_text(text)


def trials_of(journal):
    """Returns the number of trials in a journal, also while a run writes it; 0 if the file does
    not exist yet."""
    try:
        with contextlib.closing(sqlite3.connect(f"file:{journal}?mode=ro", uri=True)) as rows:
            return rows.execute("select count(*) from trials").fetchone()[0]
    except sqlite3.OperationalError:
        return 0


class Coarse(unittest.TestCase):
    """Makes a study with `latsch new`, with a few hundred elements and with measurements from the
    model itself."""

    template = None

    @classmethod
    def setUpClass(cls):
        cls.base = pathlib.Path(tempfile.mkdtemp(prefix="latsch_cli_"))
        folder = cls.base / "template"
        subprocess.run([LATSCH, "new", folder, "--coarse"], check=True, stdout=subprocess.DEVNULL)
        edit(folder / "tire.toml", (r"\n(meridional|columns) = .*", "\nmeridional = 14"), ("sectors = .*", "sectors = 18"),
             ('young_modulus = "4 MPa"', 'young_modulus = "5 MPa"'))  # both sidewalls, as in the variable
        edit(folder / "study.toml",
             (r"values = \[.*\]}", "values = [6, 12]}"),
             ("measured_modes = 10", "measured_modes = 6"),
             ('method = "auto"', 'method = "gss"'),  # slow enough to be stopped during the run
             ("step_tolerance = .*", "step_tolerance = 0.05"),
             (r"\[variable.belt\]\n(.+\n)*", ""))
        for name in ("stiffness.csv", "modes.csv"):
            (folder / name).unlink()
        subprocess.run([LATSCH, "export", folder / "study.toml", "--measurements"], check=True,
                       stdout=subprocess.DEVNULL)
        edit(folder / "study.toml", ('initial = "4.47 N/mm.2"', 'initial = "8 N/mm^2"'))
        cls.template = folder

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.base)

    def setUp(self):
        self.folder = self.base / self._testMethodName
        shutil.copytree(self.template, self.folder)
        self.study = self.folder / "study.toml"

    def latsch(self, *arguments, code=DONE, **options):
        run = subprocess.run([LATSCH, *arguments], capture_output=True, text=True, timeout=300, **options)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def assert_says(self, text, *parts):
        for part in parts:
            self.assertIn(part, text)


class Outside(unittest.TestCase):
    """Makes copies of studies of the repository in which an outside program replaces the model."""

    latsch = Coarse.latsch
    assert_says = Coarse.assert_says

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_cli_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def study(self, name):
        source = pathlib.Path(__file__).resolve().parents[3] / "studies" / name
        shutil.copytree(source, self.folder / name, ignore=shutil.ignore_patterns("*.latsch*", "*.html", "*.scratch"))
        return self.folder / name / "study.toml"

    def found(self, text, variable):
        return float(re.search(rf"\n  {variable} +(\S+)", text)[1])
