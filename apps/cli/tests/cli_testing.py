"""Support for tests of the program: how it is called, its page, and studies to test it with."""
import contextlib
import json
import pathlib
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request

LATSCH = sys.argv.pop(1) if len(sys.argv) > 1 else "latsch"

DONE, FAILED, WRONG_INPUT, STOPPED = 0, 1, 2, 130


def edit(file, *replacements):
    text = file.read_text()
    for pattern, new in replacements:
        text, count = re.subn(pattern, new, text)
        assert count, f"{pattern} is not in {file}"
    file.write_text(text)


def trials_of(journal):
    """Returns the number of trials in a journal, also while a run writes to it; 0 if the file does not exist yet."""
    try:
        with contextlib.closing(sqlite3.connect(f"file:{journal}?mode=ro", uri=True)) as rows:
            return rows.execute("select count(*) from trials").fetchone()[0]
    except sqlite3.OperationalError:
        return 0


class Coarse(unittest.TestCase):
    """Base class of tests that make a study with `latsch new`, with a few hundred elements and with measurements
    computed by the model itself."""

    template = None

    @classmethod
    def setUpClass(cls):
        cls.base = pathlib.Path(tempfile.mkdtemp(prefix="latsch_cli_"))
        folder = cls.base / "template"
        subprocess.run([LATSCH, "new", folder, "--coarse"], check=True, stdout=subprocess.DEVNULL)
        edit(folder / "tire.toml", (r"\n(meridional|columns) = .*", "\nmeridional = 14"), ("sectors = .*", "sectors = 18"),
             ('young_modulus = "4 MPa"', 'young_modulus = "5 MPa"'))  # one variable sets both sidewalls
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
    """Base class of tests that copy studies of the repository in which an outside program replaces the model."""

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


class Page:
    """The server of the studio, accessed as scripts of the page access it."""

    def __init__(self, *arguments, environment=None, program=LATSCH):
        self.process = subprocess.Popen([program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                        start_new_session=True, env=environment)
        self.address = None
        while self.address is None:
            line = self.process.stdout.readline()
            assert line, "it ended without an address"
            found = re.match(r"(http://[^/]+)/\?token=(\S+)", line)
            if found:
                self.address, self.token = found.groups()

    def open(self, path, body=None, timeout=120):
        request = urllib.request.Request(self.address + path, headers={"Authorization": "Bearer " + self.token})
        if body is not None:
            request.data = json.dumps(body).encode()
            request.add_header("Content-Type", "application/json")
        return urllib.request.urlopen(request, timeout=timeout)

    def get(self, path):
        with self.open(path) as answer:
            return json.load(answer)

    def post(self, path, body):
        with self.open(path, body) as answer:
            return json.load(answer)

    def status(self, path, body=None):
        try:
            with self.open(path, body) as answer:
                return answer.status
        except urllib.error.HTTPError as error:
            with error:
                return error.code

    def wait(self, path, is_so, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            answer = self.get(path)
            if is_so(answer):
                return answer
            time.sleep(0.02)
        raise AssertionError(f"{path} stays {answer}")

    def end(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        self.process.wait(10)
        self.process.stdout.close()


@contextlib.contextmanager
def served(folder, program=LATSCH):
    """Serves a folder and yields its page, once the server has read all studies in the folder."""
    page = Page("serve", str(folder), "--no-browser", program=program)
    try:
        page.wait("/api/home", lambda view: view["studies"] and not view.get("loading")
                  and not any(one.get("reading", one["state"] == "reading") for one in view["studies"]))
        yield page
    finally:
        page.end()


def assert_identifiability(case, folder, names, study="study.toml"):
    """Checks that the identifiability view of a study that has run with intervals opens and shows each variable once.
    """
    with served(folder) as page:
        with page.open(f"/api/identifiability?study={study}", timeout=300) as answer:  # reads the whole journal
            view = json.load(answer)
    case.assertTrue(view["known"], view["why_not"])
    case.assertEqual([one["name"] for one in view["variables"]], list(names))
    case.assertEqual(len(view["correlation"]), len(view["variables"]))
    case.assertEqual(len(view["bands"]), len({band["experiment"] for band in view["bands"]}), "a key that stands twice")
