#!/usr/bin/env python3
"""Tests options that name an output file if that file exists already: as a pipe, a link, or a full device.

   writing_test.py PATH/TO/latsch"""
import os
import pathlib
import shutil
import stat
import subprocess
import tempfile
import threading
import unittest

from cli_testing import DONE, FAILED, LATSCH, WRONG_INPUT

STUDIES = pathlib.Path(__file__).resolve().parents[3] / "studies"


class Writing(unittest.TestCase):
    """Checks every verb that writes."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_cli_"))
        self.addCleanup(shutil.rmtree, self.folder)
        points = self.write("points.csv", "x [m],y [mm]\n0,0\n1,250\n")
        ring = STUDIES / "ring_tires" / "passenger_205_55R16.toml"
        tire = STUDIES / "tires" / "passenger_205_55R16.toml"
        road = self.write("road.toml", 'kind = "cleat"\nheight = "20 mm"\nlength = "50 mm"\nplace = "1 m"\n')
        print_of = ("test", ring, '{kind = "footprint", loads = ["2 kN"]}')
        self.verbs = [("road", road, points, "--output"), ("show", points, "--html"),
                      (*print_of, "-o"), (*print_of, "--html"), (*print_of, "--details"), ("export", tire, "--model"),
                      ("export", tire, "--ccx")]

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=60)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def texts(self):
        """Returns the options of every verb that write a file."""
        for number, verb in enumerate(self.verbs):
            file = self.folder / f"plain{number}"
            self.latsch(*verb, file)
            self.assertGreater(file.stat().st_size, 20, verb)
            yield verb, file.read_bytes()

    def test_a_pipe_and_a_link_stay_and_get_the_same_text(self):
        pipe, link, target = self.folder / "pipe", self.folder / "link", self.folder / "target"
        os.mkfifo(pipe)
        link.symlink_to("target")
        for verb, text in self.texts():
            read = []
            reader = threading.Thread(target=lambda: read.append(pipe.read_bytes()))
            reader.start()
            self.latsch(*verb, pipe)
            reader.join(timeout=10)
            self.assertEqual(read, [text], verb)
            self.assertTrue(stat.S_ISFIFO(pipe.lstat().st_mode), verb)
            self.latsch(*verb, link)
            self.assertEqual(os.readlink(link), "target", verb)
            self.assertEqual(target.read_bytes(), text, verb)
            target.unlink()

    def test_a_full_device_is_reported_and_stays(self):
        full = self.folder / "full"
        try:
            os.mknod(full, stat.S_IFCHR | 0o666, os.makedev(1, 7))  # a device like /dev/full, which no test may endanger
            os.close(os.open(full, os.O_WRONLY))  # some systems forbid opening devices here
        except OSError as error:
            self.skipTest(f"devices cannot be made here: {error}")
        self.assertIn(f"{full}: the log cannot be written", self.latsch(*self.verbs[0][:3], "--log", full))
        with full.open("w") as output:
            for verb in (self.verbs[0][:3], (*self.verbs[0][:3], "--json")):
                run = subprocess.run([LATSCH, *map(str, verb)], stdout=output, stderr=subprocess.PIPE, text=True)
                self.assertIn("the standard output cannot be written: No space left on device", run.stderr)
                self.assertEqual(run.returncode, FAILED, verb)
        for verb in self.verbs:
            self.assertIn("No space left on device", self.latsch(*verb, full, code=WRONG_INPUT), verb)
            self.assertTrue(stat.S_ISCHR(full.lstat().st_mode), verb)

    def test_a_file_that_the_command_reads_is_no_output(self):
        """Checks that a command refuses to write to a file that it reads, also through a link and for files that its
        input names."""
        tire = self.write("tire.toml", (STUDIES / "tires" / "passenger_205_55R16.toml").read_text())
        ring = self.write("ring.toml", (STUDIES / "ring_tires" / "passenger_205_55R16.toml").read_text())
        test = self.write("test.toml", 'kind = "load_deflection"\ndeflections = ["10 mm"]\n')
        points, road = self.folder / "points.csv", self.folder / "road.toml"
        link = self.folder / "link.csv"
        link.symlink_to("points.csv")
        for verb, lost in ((("road", road, points, "--output", points), points),
                           (("road", road, points, "--output", link), points),
                           (("road", road, points, "--output", road), road),
                           (("show", points, "--html", points), points),
                           (("test", ring, test, "-o", test), test),
                           (("test", ring, test, "--html", ring), ring),
                           (("mesh", tire, "--vtu", tire), tire),
                           (("export", tire, "--model", tire), tire),
                           (("export", tire, "--ccx", tire), tire)):
            before = lost.read_bytes()
            # A name that ends as another format is refused before the file is looked at.
            self.assertRegex(self.latsch(*verb, code=WRONG_INPUT), "is read by this command|ends as a file of another format", verb)
            self.assertEqual(lost.read_bytes(), before, verb)
        for _ in range(2):  # the output of an earlier command may be replaced
            self.latsch("show", points, "--html", self.folder / "points.html")

    def test_a_log_is_not_appended_to_a_file_that_is_none(self):
        points = self.folder / "points.csv"
        before = points.read_bytes()
        self.assertIn("is no log", self.latsch("show", points, "--log", points, code=WRONG_INPUT))
        self.assertEqual(points.read_bytes(), before)
        for _ in range(2):
            self.latsch("show", points, "--log", self.folder / "log.txt")

    def test_measured_values_are_kept_when_a_twin_takes_their_place(self):
        study = self.folder / "study.toml"
        self.write("ring.toml", (STUDIES / "ring_tires" / "passenger_205_55R16.toml").read_text())
        study.write_text('''model = "ring.toml"
[experiment.pressed]
kind = "load_deflection"
measurement = "pressed.csv"
[variable.k]
path = "sidewall.radial.stiffness"
lower = "400 kN/m^2"
upper = "700 kN/m^2"
initial = "500 kN/m^2"
''')
        measured = "deflection [mm],force [N]\n10,1500\n20,3300\n"
        pressed = self.write("pressed.csv", measured)
        self.assertIn("kept as", self.latsch("export", study, "--measurements"))
        self.assertEqual((self.folder / "pressed.measured.csv").read_text(), measured)
        self.assertTrue(pressed.read_text().startswith("# Not measured"))
        self.assertNotIn("kept as", self.latsch("export", study, "--measurements"))


if __name__ == "__main__":
    unittest.main()
