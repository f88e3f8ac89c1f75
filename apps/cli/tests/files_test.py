#!/usr/bin/env python3
"""Tests heights of roads, the display of files, the processing of rig recordings, and messages about bushings and
roads.

   files_test.py PATH/TO/latsch"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from cli_testing import DONE, LATSCH, WRONG_INPUT, edit


STUDIES = pathlib.Path(__file__).resolve().parents[3] / "studies"
UNITS = "LENGTH = 'mm'\nANGLE = 'degrees'\nFORCE = 'newton'\nMASS = 'kg'\nTIME = 'second'\n"
POINTS = "x [m],y [m]\n0,0\n1.2,0\n"


def bushing(units=UNITS, more="", stiffness=38000):
    """Returns a bushing file in mm and degrees, with `stiffness` N/mm and 200 N m/rad."""
    text = f"[MDI_HEADER]\nFILE_TYPE = 'bus'\nFILE_VERSION = 4.0\nFILE_FORMAT = 'ASCII'\n[UNITS]\n{units}[DAMPING]\n"
    text += "".join(f"{axis}_DAMPING = 0\n" for axis in ("FX", "FY", "FZ", "TX", "TY", "TZ"))
    for axis in "XYZ":
        text += f"[F{axis}_CURVE]\n{{x force}}\n" + "".join(f"{x} {stiffness * x}\n" for x in (-1, 0, 1))
    for axis in "XYZ":
        text += f"[T{axis}_CURVE]\n{{angle torque}}\n" + "".join(f"{x} {3490.658504 * x}\n" for x in (-1, 0, 1))
    return text + more


def without(text, key):
    """Returns the text without the lines that begin with `key`."""
    return "".join(line for line in text.splitlines(True) if not line.startswith(key))


class FileCase(unittest.TestCase):

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_cli_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name


class Files(FileCase):
    """Checks heights of roads and the display of files."""

    def test_a_ring_tire_rolls_on_the_drum(self):
        tire = pathlib.Path(__file__).resolve().parents[3] / "studies" / "ring_tires" / "passenger_205_55R16.toml"
        test = self.write("test.toml", 'kind = "drum_cleat"\nspeed = "30 km/h"\nload = "3.5 kN"\n'
                                       'drum_diameter = "2.5 m"\nrun_in = "20 ms"\nlead = "20 ms"\n'
                                       'duration = "40 ms"\n[cleat]\nheight = "10 mm"\nlength = "20 mm"\n')
        rows = [line.split(",") for line in self.latsch("test", tire, test).splitlines()]
        self.assertEqual(rows[0][:4], ["time [s]", "Fx [N]", "Fy [N]", "Fz [N]"])
        self.assertEqual(len(rows), 1 + 80)
        self.assertAlmostEqual(float(rows[1][3]), 3500, delta=300)

    def test_bushings_go_out_as_files_and_come_back_in_a_suspension(self):
        front = pathlib.Path(__file__).resolve().parents[3] / "studies" / "kerb" / "front.toml"
        said = self.latsch("export", front, "--bus", self.folder / "bushings")
        self.assertEqual(len(list((self.folder / "bushings").glob("*.bus"))), 10)
        self.assertIn("ubj.bus", said)
        shown = self.latsch("show", self.folder / "bushings" / "ubj.bus", "--html", self.folder / "page.html")
        self.assertRegex(shown, r"about z +straight +20 ")
        stiffness = float(re.search(r'^x = "([\d.]+) kN/mm"', front.read_text(), re.M)[1]) * 1e6  # N/m; its damping is 0.1 ms
        x, damping = map(float, re.search(r"x +straight +(\S+) +(\S+) ", shown).groups())
        self.assertAlmostEqual(x / stiffness, 1.0, delta=1e-3)
        self.assertAlmostEqual(damping / (1e-4 * stiffness), 1.0, delta=1e-3)
        self.assertEqual((self.folder / "page.html").read_text().count("<svg"), 6)
        # In this test the corner reads its bushings from these files.
        joints = sorted(file.stem for file in (self.folder / "bushings").glob("*.bus"))
        text = front.read_text()
        own = "".join(f'[bushing.{joint}]\nfile = "bushings/{joint}.bus"\n' for joint in joints)
        back = self.write("front.toml", text[:text.index("[bushing.all]")] + own)
        model = self.folder / "model.toml"
        self.latsch("export", back, "--model", model)
        self.assertNotIn(".bus", model.read_text())
        self.assertIn('bushing', model.read_text())
        self.latsch("export", model, "--bus", self.folder / "again")
        for joint in joints:
            self.assertEqual((self.folder / "again" / f"{joint}.bus").read_text(),
                             (self.folder / "bushings" / f"{joint}.bus").read_text())
        for arguments, part in (((front.parent / "baseline.toml", "--bus", "x"), "expected a suspension"),
                                ((self.write("play.toml", text + '[bushing.ubj]\nplay.x = [["0.1 mm", "1 kN/mm"]]\n'),
                                  "--bus", self.folder / "none"), "ubj has more than a stiffness or a curve along x")):
            self.assertIn(part, self.latsch("export", *arguments, code=WRONG_INPUT))
        self.assertFalse((self.folder / "none").exists())

    def test_a_footprint_is_a_table_a_picture_and_a_channel(self):
        tire = pathlib.Path(__file__).resolve().parents[3] / "studies" / "ring_tires" / "passenger_205_55R16.toml"
        page, table, blocks = (self.folder / name for name in ("page.html", "table.csv", "blocks.csv"))
        keys = 'kind = "footprint", loads = ["2 kN", "4 kN"]'
        self.latsch("test", tire, "{" + keys + "}", "--html", page, "-o", table, "--details", blocks)
        rows = [line.split(",") for line in table.read_text().splitlines()]
        self.assertEqual(rows[0][:3], ["load [N]", "deflection [m]", "length [m]"])
        self.assertRegex(page.read_text(), r"<b>2000 N</b><svg(.|\n)*<b>4000 N</b><svg")
        self.assertIn("Deflection ", page.read_text())
        self.latsch("test", tire, '{kind = "footprint", loads = ["4 kN"]}', "--html", page)
        self.assertEqual(page.read_text().count("<svg"), 1)  # single values are not drawn
        pressed = [line.split(",") for line in blocks.read_text().splitlines()[1:]]
        self.assertEqual({float(row[0]) for row in pressed}, {1.0, 2.0})
        test = self.write("test.toml", keys.replace(", loads", "\nloads"))
        self.assertEqual(self.latsch("test", tire, test), table.read_text())
        for wrong, said in (('{kind = "footprint"}', "one of the two"), ('{kind = "footprnt"}', 'did you mean "footprint"'),
                            ('{kind = "footprint"', "braces"), ('{kind = "modes", lods = 3}', 'did you mean "load"')):
            self.assertIn(said, self.latsch("test", tire, wrong, code=WRONG_INPUT))
        self.assertIn("no more numbers", self.latsch("test", tire, '{kind = "modes"}', "--details", blocks, code=WRONG_INPUT))

    def test_a_road_answers_with_height_normal_and_friction(self):
        road = self.write("road.toml", 'kind = "cleat"\nheight = "20 mm"\nlength = "50 mm"\nbevel = "10 mm"\n'
                                       'place = "1 m"\nobstacle_friction = 0.8\n')
        points = self.write("points.csv", "x [m],y [mm]\n0,0\n1,250\n0.98,0\n")
        rows = [line.split(",") for line in self.latsch("road", road, points).splitlines()]
        self.assertEqual(rows[0], ["x [m]", "y [m]", "z [m]", "nx [1]", "ny [1]", "nz [1]", "friction [1]"])
        self.assertEqual(rows[1][2:], ["0", "0", "0", "1", "1"])
        self.assertEqual(rows[2][1:3] + rows[2][6:], ["0.25", "0.02", "0.8"])
        self.assertAlmostEqual(float(rows[3][2]), 0.015)
        self.assertAlmostEqual(float(rows[3][3]), -(0.5 ** 0.5))  # 45 deg slope, rising in the forward direction

    def test_a_kerb_becomes_a_file_of_triangles(self):
        kerb = self.write("kerb.toml", 'kind = "kerb"\nshape = "saw_tooth"\npitch = "800 mm"\nwidth = "800 mm"\n'
                                       'height = "25 mm"\ncount = 4\n')
        rdf = self.folder / "kerb.rdf"
        points = self.write("points.csv", "x [m],y [m]\n0.4,0.4\n")
        self.latsch("road", kerb, "--triangles", rdf)
        rows = [line.split(",") for line in self.latsch("road", rdf, points).splitlines()]
        self.assertAlmostEqual(float(rows[1][2]), 0.0125, places=6)
        self.assertIn("POINTS.csv", self.latsch("road", kerb, code=WRONG_INPUT))

    def test_a_drum_moves_with_the_time_of_a_point(self):
        road = self.write("drum.toml", 'kind = "drum"\ndiameter = "2 m"\nspeed = "1 m/s"\ncleats = 1\n'
                                       'height = "20 mm"\nlength = "50 mm"\nstarting_angle = "1 rad"\n')
        points = self.write("points.csv", "x [m],y [m],time [s]\n0,0,0\n0,0,1\n")
        rows = [line.split(",") for line in self.latsch("road", road, points).splitlines()]
        self.assertEqual(rows[1][2], "0")
        self.assertAlmostEqual(float(rows[2][2]), 0.02, delta=5e-4)

    def test_open_crg_answers_with_u_and_v_too(self):
        road = self.write("road.crg", "$ROAD_CRG\nreference_line_increment = 1\nreference_line_start_x = 10\n"
                                      "long_section_v_increment = 2\n$\n$KD_Definition\n#:LRFI\n"
                                      "D:long section 1,m\nD:long section 2,m\n$\n$$$$\n"
                                      " 0.0000000 0.1000000\n 0.0000000 0.1000000\n")
        points = self.write("points.csv", "x [m],y [m]\n10.5,0.5\n")
        rows = [line.split(",") for line in self.latsch("road", road, points).splitlines()]
        self.assertEqual(rows[0][7:], ["u [m]", "v [m]"])
        self.assertAlmostEqual(float(rows[1][2]), 0.075)
        self.assertEqual([float(cell) for cell in rows[1][7:]], [0.5, 0.5])
        self.assertIn("2 rows, 2 long sections", self.latsch("show", road))

    def test_what_cannot_be_evaluated_is_said(self):
        tir = pathlib.Path(__file__).resolve().parents[3] / "studies" / "tire_model_comparison" / "magic_formula.tir"
        states = self.write("states.csv", "Fz,alpha [deg]\n4000,2\n")
        steady = f'{{kind = "steady_states", states = "{states}"}}'
        self.assertIn("Fy [N]", self.latsch("test", tir, steady))
        for text, said in (("Fz,alpha\n", "no row follows the header"), ("alpha\n1\n", "there is no column Fz"),
                           ("Fz [m]\n1\n", "expected a force"), ("Fz,alpha\n4000\n", "has 1 field, expected 2")):
            states.write_text(text)
            self.assertRegex(self.latsch("test", tir, steady, code=WRONG_INPUT), r"states\.csv:\d: .*" + said)
        states.write_text("Fz\n4000\n")
        bare = self.write("bare.tir", re.sub("(?m)^UNLOADED_RADIUS.*$", "", tir.read_text()))
        self.assertIn("there is no UNLOADED_RADIUS", self.latsch("test", bare, steady, code=WRONG_INPUT))
        ring = tir.parents[1] / "ring_tires" / "passenger_205_55R16.toml"
        self.assertIn("cannot do this test", self.latsch("test", ring, steady, code=WRONG_INPUT))

    def test_a_road_without_a_model_or_a_column_is_said(self):
        self.assertIn("is this an Adams road file", self.latsch(
            "road", self.write("cut.rdf", "[UNITS]\n LENGTH = 'mm'\n"), self.write("p.csv", "x,y\n0,0\n"),
            code=WRONG_INPUT))
        flat = self.write("flat.toml", 'kind = "flat"\n')
        self.assertIn('"y" is missing (columns: "x")', self.latsch(
            "road", flat, self.write("p.csv", "x\n0\n"), code=WRONG_INPUT))
        points = self.write("p.csv", "x,y\n0,0\n")
        self.assertIn('--time is "3", expected a time', self.latsch(
            "road", flat, points, "--time", "3", code=WRONG_INPUT))

    def test_show_says_what_was_read_and_draws_it(self):
        tydex = self.write("test.tdx", "**HEADER\n**CONSTANTS\n"
                                       "INFLPRES  Inflation pressure            bar       2.5\n**MEASURCHANNELS\n"
                                       "RUNTIME   Running time                  s         1\n"
                                       "FYW       Lateral force                 kN        1\n"
                                       "**MEASURDATA\n0 1.5\n0.1 NOTAVAIL\n0.2 -0.5\n**END\n")
        page = self.folder / "test.html"
        text = self.latsch("show", tydex, "--html", page)
        self.assertRegex(text, r"INFLPRES +2.5 bar +250000 Pa")
        self.assertRegex(text, r"FYW +kN +W ")
        self.assertRegex(text, r"FYW +N +3 +1 +-500 +500 +1500")
        self.assertRegex(self.latsch("show", tydex, "--axes", "sae"), r"FYW +N +3 +1 +-1500 +-500 +500")
        self.assertIn('expected "iso"', self.latsch("show", tydex, "--axes", "din", code=WRONG_INPUT))
        self.assertIn("<polyline", page.read_text())
        self.assertIn("FYW [N] over RUNTIME [s]", page.read_text())
        table = self.write("table.csv", "Fz [kN],t [ms]\n1,0\n2,5\n")
        self.assertRegex(self.latsch("show", table), r"Fz +N +2 +0 +1000 +1500 +2000")
        ring = self.write("ring.toml", 'kind = "ring_tire"\n[belt]\nradius = "305 mm"\n')
        self.assertRegex(self.latsch("show", ring), r"belt\.radius +0\.305 +m")

    def test_show_draws_what_a_study_measures(self):
        self.write("run.dat", "Run 4\nET\tSA\tFZ\tFY\nsec\tdeg\tN\tN\n0\t-1\t-900\t90\n1\t1\t-900\t-90\n2\t2\t-1500\t-90\n")
        study = self.write("study.toml", '[measurement.cornering]\nfile = "run.dat"\naxes = "sae"\n'
                           'select = {Fz = "800 .. 1000 N"}\n[measurement.all]\nfile = "run.dat"\n[experiment.side]\n')
        page = self.folder / "test.html"
        text = self.latsch("show", study, "--html", page)
        for said in ("cornering: run.dat: 3 samples of 4 channels", "cornering: signs of sae, turned to iso",
                     "cornering: Fz 800 .. 1000 N: 2 of 3 samples", "cornering: Fy from -90 to 90 N", "all: alpha from -1 to 2 deg"):
            self.assertIn(said, text)
        self.assertIn("cornering: Fz [N]", page.read_text())
        self.assertEqual(page.read_text().count("<circle"), 3 * 2 + 3 * 3)
        alone = self.latsch("show", study, "--measurement", "all")
        self.assertNotIn("2 of 3 samples", alone)
        self.assertIn('did you mean "all"?', self.latsch("show", study, "--measurement", "al", code=WRONG_INPUT))
        study.write_text(study.read_text().replace("800 .. 1000 N", "8 .. 10 kN"))
        self.assertIn("study.toml:4: measurement.cornering.select.Fz", self.latsch("show", study, code=WRONG_INPUT))
        study.write_text(study.read_text().replace("select =", "selct ="))
        self.assertIn('did you mean "select"?', self.latsch("show", study, code=WRONG_INPUT))

    def test_a_table_with_texts_is_shown_as_written(self):
        text = self.latsch("show", self.write("kerbs.csv", "name,width [mm]\nexit,800\n"))
        self.assertRegex(text, r'no channels: .*kerbs.csv:2')
        self.assertRegex(text, r"exit +800")

    def test_utf_16_is_named_by_every_reader(self):
        for name in ("t.tir", "t.bus", "t.rdf", "t.crg", "t.inp", "t.toml", "t.csv", "t.tdx", "t.dat"):
            for mark in ("\ufeff", ""):
                (self.folder / name).write_bytes((mark + "[UNITS]\nLENGTH = 'meter'\n").encode("utf-16-le"))
                with self.subTest(f"{name} {bool(mark)}"):
                    self.assertIn("is UTF-16 text, expected UTF-8", self.latsch("show", self.folder / name, code=WRONG_INPUT))

    def test_bad_files_are_named_with_their_line(self):
        self.assertIn('expected ".bunv", ".bus", ".crg"', self.latsch("show", self.write("a.xyz", ""), code=WRONG_INPUT))
        torso = self.write("torso.tdx", "**HEADER\n**MEASURCHANNELS\n")
        self.assertIn("torso.tdx:2", self.latsch("show", torso, code=WRONG_INPUT))
        points = self.write("points.csv", "x [m]\n0\n")
        road = self.write("road.toml", 'kind = "flat"\n')
        self.assertIn('column "y" is missing', self.latsch("road", road, points, code=WRONG_INPUT))
        bumpy = self.write("bumpy.rdf", "[MODEL]\nMETHOD = '2D'\nROAD_TYPE = 'hill'\n")
        self.assertIn("bumpy.rdf:3", self.latsch("road", bumpy, points, code=WRONG_INPUT))


class Drum(unittest.TestCase):
    """Tests `latsch process` on the example of studies/drum_processing, with short plateaus."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_drum_"))
        cls.rig = cls.folder / "rig.toml"
        shutil.copy(pathlib.Path(__file__).parents[3] / "studies/drum_processing/rig.toml", cls.rig)
        edit(cls.rig, ('hold = "20 s"', 'hold = "8 s"'), ("bootstrap = 100", "bootstrap = 5"))
        cls.first = subprocess.run([LATSCH, "process", cls.rig, "--synthetic"], capture_output=True, text=True,
                                   timeout=300)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def process(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, "process", *arguments], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def test_one_command_from_recordings_to_tables_and_page(self):
        self.assertEqual(self.first.returncode, DONE, self.first.stdout + self.first.stderr)
        text = self.first.stdout
        f, true_f = (float(v) for v in re.findall(r"rig.*f = ([\d.]+) Hz", text))
        self.assertLess(abs(f - true_f), 0.005 * true_f)
        time, psd = zip(*((int(a), int(b)) for a, b in re.findall(r"([+-]\d+)%.*?([+-]\d+)%", text)))
        self.assertEqual(len(time), 6)
        # the filter reduces the error of every case, whether that case was fitted or not
        self.assertLess(max(time + psd), -50)
        page = pathlib.Path(re.search(r"Report: (.*)", text)[1])
        self.assertIn("<svg", page.read_text())
        self.assertIn("frequency [Hz]", (page.parent / "psd_light_real_60kph.csv").read_text())

    def test_again_gives_the_same_tables(self):
        self.process(self.rig, "--output", self.folder / "again")
        for file in (self.folder / "rig_processed").iterdir():
            self.assertEqual(file.read_bytes(), (self.folder / "again" / file.name).read_bytes(), file.name)

    def test_a_mat_file_says_the_same_as_the_table(self):
        script = ("import numpy, scipy.io, sys; t = numpy.loadtxt(sys.argv[1], delimiter=',', skiprows=1).T; "
                  "scipy.io.savemat(sys.argv[2], dict(time=t[0], speed=t[1], Fz=t[2], Fx=t[3], comment='rig', n=3.0))")
        table, mat = self.folder / "light_dummy.csv", self.folder / "light_dummy.mat"
        if subprocess.run(["/usr/bin/python3", "-c", script, table, mat], capture_output=True).returncode:
            self.skipTest("SciPy is not installed (Debian: python3-scipy)")
        rig = self.folder / "mat.toml"
        rig.write_text(self.rig.read_text())
        edit(rig, ('"light_dummy.csv"', '"light_dummy.mat"'),
             (r"\[drum\]", '[channels.units]\ntime = "s"\nspeed = "m/s"\nFz = "N"\nFx = "N"\n[drum]'))
        self.process(rig)
        name = "average_light_dummy_60kph.csv"
        self.assertEqual((self.folder / "mat_processed" / name).read_text(),
                         (self.folder / "rig_processed" / name).read_text())

    def test_recordings_that_make_no_sense(self):
        bad = self.folder / "bad.toml"
        for pattern, new, *parts in (
                ('"90 km/h"]', '"90 km/h", "140 km/h"]', "light_dummy.csv", "no plateau at 140 km/h", "comes nearest"),
                (r'\[drum\]\ncircumference = "6 m"', '[drum]\ncircumference = "4 m"', "does not repeat itself"),
                ('force = "Fz"', 'force = "FZ"', 'channel "FZ" is missing', 'did you mean "Fz"'),
                ('margin = "1 km/h"', 'margin = "1 km"', "bad.toml:16", "margin")):
            bad.write_text(self.rig.read_text())
            edit(bad, (pattern, new))
            text = self.process(bad, code=WRONG_INPUT)
            for part in parts:
                self.assertIn(part, text)
        recording = (self.folder / "light_dummy.csv").read_text().splitlines(keepends=True)
        for name, lines, *parts in (
                ("cut.csv", recording[:100], "the drum stands still"),
                ("gap.csv", recording[:500] + recording[540:], "40 samples are missing"),
                ("nan.csv", recording[:7] + ["0.0030,0.1,NaN,0\n"] + recording[8:], "nan.csv:8", "finite number"),
                ("flat.csv", [recording[0]] + [f"{i / 2000},10,4000,{i}\n" for i in range(9000)], "sensor")):
            (self.folder / name).write_text("".join(lines))
            bad.write_text(self.rig.read_text())
            edit(bad, ('"light_dummy.csv"', f'"{name}"'))
            text = self.process(bad, code=WRONG_INPUT)
            for part in (name, *parts):
                self.assertIn(part, text)


class BushingFiles(FileCase):
    """Tests that show, check, test and run report the units and the unread parts of the files that a suspension
    names."""

    def suspension(self, text):
        """Returns a corner with one bushing from a file, and a study that loads it."""
        self.write("rubber.bus", text)
        source = (STUDIES / "compliance" / "corner.toml").read_text()
        head, tail = source.split("[bushing.lca_front]\n", 1)
        rest = tail[tail.index("\n["):] if "\n[" in tail else ""
        return self.write("corner.toml", head + '[bushing.lca_front]\nfile = "rubber.bus"\n' + rest)

    def study(self):
        self.write("m.csv", "Fx [N],Fy [N],Fz [N],Mz [N m],dz [mm]\n" + "".join(
            f"0,0,{fz},0,{fz / 2000}\n" for fz in (0, 1000, 2000)))
        return self.write("study.toml", """model = "corner.toml"
[variable.k]
path = "bushing.ubj.x"
lower = "10 kN/mm"
upper = "100 kN/mm"
initial = "45 kN/mm"
[measurement.m]
file = "m.csv"
[test.rig]
kind = "kc"
loads = {from = "measurement.m"}
[experiment.dz]
kind = "curve"
y = "rig/dz"
measurement = "m"
scale = "1 mm"
""")

    def test_a_missing_unit_is_refused_by_show_check_and_test(self):
        for key, line in (("LENGTH", "LENGTH = 'mm'"), ("ANGLE", "ANGLE = 'degrees'"), ("FORCE", "FORCE = 'newton'")):
            corner = self.suspension(bushing(without(UNITS, key)))
            for command in (("show", self.folder / "rubber.bus"), ("check", corner), ("check", self.study()),
                            ("test", corner, '{kind = "kc", Fz = ["1 kN"]}')):
                text = self.latsch(*command, code=WRONG_INPUT)
                self.assertIn(f"rubber.bus:5: [UNITS] has no {key}", text)
                self.assertIn(f"add the line {line}", text)
        # A bushing needs no unit of mass, and without damping no unit of time.
        self.latsch("check", self.suspension(bushing(without(without(UNITS, "MASS"), "TIME"))))

    def test_unread_parts_are_told_wherever_the_bushing_is_used(self):
        corner = self.suspension(bushing(more="[PRELOAD]\nFX = 100\n"))
        said = "[PRELOAD] is not read: the bushing is as if the file did not contain it"
        study = self.study()
        for command in (("show", self.folder / "rubber.bus"), ("check", corner), ("check", study), ("run", study),
                        ("test", corner, '{kind = "kc", Fz = ["1 kN"]}'), ("test", study, '{kind = "kc", Fz = ["1 kN"]}')):
            text = self.latsch(*command)
            self.assertIn(said, text, command)
            self.assertIn("rubber.bus:", text)
        self.assertIn("rubber.bus: 18 statements: 17 used, 1 not used (`[PRELOAD]`)", self.latsch("check", study))
        self.assertNotIn("not used", "".join(
            line for line in self.latsch("check", self.suspension(bushing())).splitlines() if "rubber.bus" in line))

    def test_a_second_curve_of_an_axis_is_told(self):
        corner = self.suspension(bushing(more="[FX_CURVE]\n{x force}\n-1 -1\n1 1\n"))
        self.assertIn("a second [FX_CURVE] is not read", self.latsch("check", corner))

    def test_a_preload_is_told(self):
        corner = self.suspension(bushing().replace("0 0\n", "0 500\n", 1))
        self.assertIn("[FX_CURVE] has 500 N at the deflection 0: a preload", self.latsch("check", corner))


class SignsOfFiles(FileCase):
    """Checks that check and run report signs that contradict mechanics, with file and line."""

    def corner_table(self, **flips):
        """Simulates a compliant corner on a K&C rig and changes the signs of columns."""
        rig = ('{kind = "kc", Fx = ["0 N", "2 kN", "-2 kN", "0 N", "0 N", "0 N", "0 N", "0 N", "0 N"], '
               'Fy = ["0 N", "0 N", "0 N", "2 kN", "-2 kN", "0 N", "0 N", "0 N", "0 N"], '
               'Fz = ["2 kN", "2 kN", "2 kN", "2 kN", "2 kN", "2 kN", "2 kN", "1 kN", "3 kN"], '
               'Mz = ["0 N m", "0 N m", "0 N m", "0 N m", "0 N m", "99 N m", "-99 N m", "0 N m", "0 N m"]}')
        shutil.copy(STUDIES / "compliance" / "corner.toml", self.folder)
        self.latsch("test", self.folder / "corner.toml", rig, "-o", self.folder / "right.csv")
        head, *rows = (line.split(",") for line in (self.folder / "right.csv").read_text().splitlines())
        signs = [flips.get(name.split(" ")[0], 1) for name in head]
        return self.write("table.csv", ",".join(head) + "\n" + "".join(
            ",".join(f"{sign * float(cell):.9g}" for sign, cell in zip(signs, row, strict=True)) + "\n" for row in rows))

    def study(self):
        return self.write("study.toml", """model = "corner.toml"
[variable.k]
path = "bushing.lca_front.x"
lower = "10 kN/mm"
upper = "100 kN/mm"
initial = "45 kN/mm"
[measurement.m]
file = "table.csv"
[test.rig]
kind = "kc"
loads = {from = "measurement.m"}
[experiment.toe]
kind = "curve"
y = "rig/toe"
measurement = "m"
scale = "0.1 deg"
""")

    def test_a_kc_table_in_iso_is_in_order_and_each_flipped_sign_is_told(self):
        study = self.study()
        self.corner_table()
        text = self.latsch("check", study)
        self.assertIn("Everything is in order", text)
        self.assertIn("positive is toe front inboard, camber top outboard, caster top of the kingpin rearward", text)
        self.assertIn("axes iso, because none are stated: x forward, y to the left, z up", text)
        for name in ("toe", "camber", "Mz", "Fy", "caster", "Fx", "dy", "dz"):
            self.corner_table(**{name: -1})
            self.assertIn("warning: ", self.latsch("check", study), name)

    def test_a_table_of_the_other_side_than_the_model_is_told(self):
        study = self.study()
        self.corner_table(toe=-1, camber=-1)
        text = self.latsch("check", study)
        self.assertRegex(text, r"study\.toml:8: measurement\.m has the signs of a right wheel .* the model is a left one")
        edit(study, ('file = "table.csv"', 'file = "table.csv"\ncolumns = {toe = "-toe", camber = "-camber"}'))
        self.assertIn("Everything is in order", self.latsch("check", study))

    def test_axes_of_adams_are_named_and_read_by_name_or_by_their_columns(self):
        study = self.study()
        self.corner_table(Fx=-1, Fy=-1, dx=-1, dy=-1)
        text = self.latsch("check", study)
        self.assertIn('"caster" falls as Fx rises', text)
        self.assertIn('say axes = "adams"', text)
        written = study.read_text()
        edit(study, ('file = "table.csv"', 'file = "table.csv"\naxes = "adams"'))
        self.assertIn("Everything is in order", self.latsch("check", study))
        study.write_text(written)
        edit(study, ('file = "table.csv"', 'file = "table.csv"\ncolumns = {Fx = "-Fx", Fy = "-Fy", dx = "-dx", dy = "-dy"}'))
        self.assertIn("Everything is in order", self.latsch("check", study))

    def test_a_car_whose_air_lifts_and_whose_damper_falls_is_told_of(self):
        shutil.copytree(STUDIES / "kerb", self.folder / "kerb", ignore=shutil.ignore_patterns("*.latsch", "*.html"))
        car = self.folder / "kerb" / "baseline.toml"
        text = self.latsch("check", car)
        self.assertNotIn("aero.map", text)
        car.write_text(car.read_text().replace('"-1.3 kN"', '"-0.3 kN"')
                       + '\n[aero]\narea = "1 m^2"\nmap = [["0 mm", "0 mm", -1.0, -2.0]]\n')
        test = '{kind = "four_post", duration = "0.5 s", from = "5 Hz"}'
        for text in (self.latsch("check", car), self.latsch("show", car), self.latsch("test", car, test)):
            self.assertRegex(text, r"baseline\.toml:\d+: front\.spring\.damper falls from -300 N at -0\.5 m/s")
            self.assertRegex(text, r"baseline\.toml:\d+: aero\.map has a coefficient below 0 in 1 of 1 rows")

    def test_a_tire_file_tells_its_assumed_units_ranges_and_mode(self):
        tir = (STUDIES / "tire_model_comparison" / "magic_formula.tir").read_text()
        tire = self.write("tire.tir", tir)
        self.assertNotIn("is taken as meter", self.latsch("check", tire))
        self.write("tire.tir", re.sub(r"USE_MODE *= *14", "USE_MODE = 2", without(tir, "LENGTH"))
                   + "\n[SLIP_ANGLE_RANGE]\nALPMIN = -15\nALPMAX = 15\n")
        text = self.latsch("check", tire)
        for said in ("[UNITS] is silent: LENGTH is taken as meter", " assumed: LENGTH is taken as meter",
                     "ALPMIN is -15 rad", "USE_MODE is 2: it asks for Fy, Mx and Mz without longitudinal force"):
            self.assertIn(said, text)

    def test_runs_of_one_name_are_shown_with_their_folder(self):
        self.corner_table()
        for folder in ("a", "b"):
            (self.folder / folder).mkdir()
            shutil.copy(self.folder / "table.csv", self.folder / folder / "run.csv")
        study = self.study()
        edit(study, ('file = "table.csv"', 'files = ["a/run.csv", "b/run.csv"]'))
        for command in ("check", "show"):
            text = self.latsch(command, study)
            for name in ("a/run.csv: ", "b/run.csv: "):
                self.assertIn(name, text)


class RoadFiles(FileCase):
    """Tests that units and unread parts of a road file are reported wherever the road is used."""

    PLANK = ("[MODEL]\nMETHOD = '2D'\nROAD_TYPE = 'plank'\n[PARAMETERS]\nMU = 0.8\nHEIGHT = 20\nSTART = 1000\n"
             "LENGTH = 500\nDIRECTION = 0\n")

    def test_a_road_without_a_unit_of_length_is_refused(self):
        points = self.write("p.csv", POINTS)
        good = self.write("good.rdf", "[UNITS]\n" + UNITS + self.PLANK)
        self.assertIn("0.02", self.latsch("road", good, points))
        for name, units in (("none.rdf", ""), ("silent.rdf", "[UNITS]\n" + without(UNITS, "LENGTH"))):
            road = self.write(name, units + self.PLANK)
            for command in (("show", road), ("road", road, points)):
                self.assertIn("LENGTH = 'mm'", self.latsch(*command, code=WRONG_INPUT))

    CRG = ("$ROAD_CRG\nreference_line_increment = 1\n$ROAD_CRG_OPTS\nborder_mode_u = {0}\nborder_mode_v = {0}\n$\n"
           "$KD_DEFINITION\n#:LRFI\nD:long section at v = -1,m\nD:long section at v = 1,m\n$\n$$$$\n"
           " 0.1000000 0.1000000\n 0.2000000 0.2000000\n")

    def test_points_beyond_a_road_are_counted_and_have_no_height_where_there_is_no_road(self):
        """Checks the border modes of OpenCRG: 0 refuses the computation, 2 continues the edge, 3 repeats the grid."""
        points = self.write("p.csv", "x [m],y [m]\n0.5,0\n3,0\n0.5,-4\n")
        heights = {}
        for mode in (0, 1, 2, 3):
            road = self.write("road.crg", self.CRG.format(mode))
            text = self.latsch("road", road, points, "--output", self.folder / "out.csv")
            rows = [line.split(",") for line in (self.folder / "out.csv").read_text().splitlines()[1:]]
            heights[mode] = [row[2] for row in rows]
            if mode == 3:
                self.assertNotIn("lie beyond", text)
            else:
                self.assertIn("2 of 3 points lie beyond the data of the road, the first at x = 3 m, y = 0 m", text)
        self.assertEqual(heights[0][1:], ["nan", "nan"])
        for mode, expected in ((1, (0.15, 0, 0)), (2, (0.15, 0.2, 0.15))):
            for z, right in zip(heights[mode], expected, strict=True):
                self.assertAlmostEqual(float(z), right, delta=1e-15)
        self.assertIn("2 of them have no height, because a border mode of 0 says that there is no road", self.latsch(
            "road", self.write("road.crg", self.CRG.format(0)), points))

    def test_what_a_car_drives_over_is_told_of(self):
        shutil.copytree(STUDIES / "kerb", self.folder / "kerb", ignore=shutil.ignore_patterns("*.latsch", "*.html"))
        mesh = ("[MODEL]\nMETHOD = '3D'\n[SCALE]\nX = 1\nY = 1\nZ = 2\n[NODES]\n1 -20 -5 0\n2 40 -5 0\n3 40 5 0\n4 -20 5 0\n"
                "[ELEMENTS]\n{node_1 node_2 node_3 mu_x mu_y}\n1 2 3 0.9 0.7\n1 3 4 0.9 0.7\n")
        self.write("kerb/level.rdf", "[UNITS]\n" + UNITS.replace("'mm'", "'meter'") + mesh)
        test = self.write("kerb/drive.toml", 'kind = "kerb"\nspeed = "30 m/s"\nrun_in = "0.04 s"\nduration = "0.05 s"\n'
                          '[road]\nfile = "level.rdf"\n')
        car = self.folder / "kerb" / "baseline.toml"
        braces = ('{kind = "kerb", speed = "30 m/s", run_in = "0.04 s", duration = "0.05 s", '
                  f'road = {{file = "{self.folder}/kerb/level.rdf"}}}}')
        for text in (self.latsch("test", car, test), self.latsch("test", car, braces),
                     self.latsch("show", self.folder / "kerb" / "level.rdf"),
                     self.latsch("road", self.folder / "kerb" / "level.rdf", self.write("p.csv", POINTS))):
            self.assertIn("level.rdf:9: [SCALE] is not read here", text)
            self.assertIn("level.rdf:20: the friction across the road differs from that along it", text)


if __name__ == "__main__":
    unittest.main()
