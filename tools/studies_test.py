#!/usr/bin/env python3
"""Tests tools/studies.py on a small tree with a program that answers as latsch does: it must find every difference."""
import contextlib
import fcntl
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import studies
import study_figures

EXPECTED = """\
["study.toml"]
quick = "run"
tolerance = {target = 0.01, values = 0.01, errors = 0.02}
reason = "It rounds."
truth = {spring = "5 N/mm"}

[data]
command = ["sh", "-c", "cp computed.csv measured.csv"]
files = ["measured.csv"]
tolerance = 1e-6
"""

# A spring whose target is (spring / stiffness of the data - 1)^2.
LATSCH = """\
#!/usr/bin/env python3
import json, pathlib, sys
verb, study = sys.argv[1:3]
truth = float(pathlib.Path(study).with_name("measured.csv").read_text().split()[1])
at = truth
for word in sys.argv:
    if word.startswith("spring="):
        at = float(word.split("=")[1].split()[0])
error = at / truth - 1
result = {"target": error**2, "experiments": [{"name": "force", "fitted": True, "mean_error": abs(error), "largest_error": abs(error)}]}
if verb == "run":
    result |= {"steps": 3, "variables": [{"name": "spring", "value": at, "unit": "N/mm", "interval": [at - 1, None]}]}
if verb == "run":
    pathlib.Path(study).with_suffix(".latsch").write_text("")
if verb == "compare":  # errors of two models, the second where a fit was run
    fitted = pathlib.Path("study.latsch").exists()
    result = {"models": [{"name": "soft", "channels": ["Fx", "Fz"], "error": [0.5, 0.25], "seconds": 3.0,
                         "value": 0.5, "unit": "N/m"},
                         {"name": "fitted", "channels": ["Fx", "Fz"], "error": [0.125 if fitted else 1.0, 0.0625], "seconds": 4.0}]}
print(json.dumps({"result": result}))
"""

COMPARISON = """
["comparison.toml"]
command = ["compare", "comparison.toml"]
keep = ["models.*.error.*", "models.*.value*"]
after = ["study.toml"]
quick = "none"
tolerance = {results = 0.01}
reason = "It rounds."
"""


class Studies(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.tree = pathlib.Path(scratch.name)
        self.folder = self.tree / "studies" / "spring"
        self.folder.mkdir(parents=True)
        self.latsch = self.tree / "latsch"
        self.latsch.write_text(LATSCH)
        self.latsch.chmod(0o755)
        for name, text in {"study.toml": "", "expected.toml": EXPECTED, "measured.csv": "N/mm 5.0\n",
                           "computed.csv": "N/mm 5.0\n", "README.md": f"# Spring\n\n{studies.BEGIN}\n{studies.END}\nend\n"}.items():
            (self.folder / name).write_text(text)
        old = studies.TREE, studies.STUDIES
        self.addCleanup(lambda: (setattr(studies, "TREE", old[0]), setattr(studies, "STUDIES", old[1])))
        studies.TREE, studies.STUDIES = self.tree, self.tree / "studies"
        self.asked(studies.renew, [], False)

    def asked(self, command, *words):
        """Runs a command; returns its exit code and the printed text."""
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            code = command(self.latsch, *words)
        return code, out.getvalue()

    def edit(self, name, old, new):
        file = self.folder / name
        text = file.read_text()
        self.assertIn(old, text)
        file.write_text(text.replace(old, new))

    def test_what_was_renewed_is_as_expected(self):
        code, said = self.asked(studies.check, [], False)
        self.assertEqual(code, 0, said)
        self.assertNotIn("NOT", said)
        text = (self.folder / "README.md").read_text()
        self.assertIn("| spring | 5 N/mm | 4 .. – |", text)
        self.assertTrue(text.endswith("end\n"))
        self.assertIn('reason = "It rounds."', (self.folder / "expected.toml").read_text())

    def test_another_value_target_or_error_is_found(self):
        for old, new in [("value = 5", "value = 5.2"), ("target = 0\n", "target = 0.1\n"), ("mean = 0,", "mean = 0.3,")]:
            with self.subTest(old):
                self.edit("expected.toml", old, new)
                self.assertEqual(self.asked(studies.check, [], True)[0], 1)
                self.edit("expected.toml", new, old)

    def test_data_of_another_model_are_found_at_the_truth_and_beside_the_data(self):
        self.edit("measured.csv", "5.0", "5.01")
        code, said = self.asked(studies.check, ["spring"], True)
        self.assertEqual(code, 1)
        self.assertIn("target at the truth", said)
        self.assertIn("1 numbers of spring/measured.csv", self.asked(studies.check, [], False)[1])
        self.asked(studies.renew, [], True)
        self.assertEqual(self.asked(studies.check, [], False)[0], 0)
        self.assertEqual((self.folder / "measured.csv").read_text(), "N/mm 5.0\n")

    def test_a_block_written_by_hand_is_found(self):
        self.edit("README.md", "5 N/mm", "6 N/mm")
        code, said = self.asked(studies.check, [], True)
        self.assertEqual(code, 1)
        self.assertIn("README.md", said)

    def test_an_experiment_that_nobody_expects_is_found(self):
        self.edit("expected.toml", "force = {", "moment = {")
        said = self.asked(studies.check, [], True)[1]
        self.assertIn("no experiment moment", said)
        self.assertIn("does not know: force", said)

    def test_expected_results_without_tolerance_reason_or_study_are_refused(self):
        for old, new in [('reason = "It rounds."', 'reason = ""'), ("values = 0.01, ", ""), ('quick = "run"', 'quick = "soon"'),
                         ('["study.toml"]', '["studdy.toml"]')]:
            with self.subTest(old):
                whole = (self.folder / "expected.toml").read_text()
                self.edit("expected.toml", old, new)
                self.assertRaises(studies.Wrong, self.asked, studies.check, [], True)
                (self.folder / "expected.toml").write_text(whole)

    def test_names_choose_folders_and_files(self):
        self.assertEqual(self.asked(studies.check, ["spring/study.toml"], True)[0], 0)
        self.assertRaises(studies.Wrong, self.asked, studies.check, ["sprung"], True)

    def add(self, more, *files):
        for name in files:
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).write_text("")
        with open(self.folder / "expected.toml", "a") as file:
            file.write(more)

    def two_springs(self):
        """Adds a second study and lets the runs of both wait: a run begins with a file STUDY.begun and ends once there
        is a file `go`. Returns a function that starts --renew of a study in another process."""
        self.add(EXPECTED.split("truth")[0].replace("study.toml", "other.toml"), "other.toml")
        self.asked(studies.renew, ["spring/other.toml"], False)
        go = self.tree / "go"
        self.latsch.write_text(LATSCH.replace("truth = float", f"""
if verb == "run":
    import time
    pathlib.Path({str(self.tree)!r}, pathlib.Path(study).name + ".begun").write_text("")
    while not pathlib.Path({str(go)!r}).exists():
        time.sleep(0.01)
truth = float""", 1))
        code = ("import pathlib, sys; sys.path.insert(0, sys.argv[1]); import studies; tree = pathlib.Path(sys.argv[2]); "
                "studies.TREE, studies.STUDIES = tree, tree / 'studies'; "
                "sys.argv = ['studies.py', '--renew', *sys.argv[3:], '--latsch', str(tree / 'latsch')]; sys.exit(studies.main())")

        def start(*words):
            process = subprocess.Popen([sys.executable, "-c", code, str(pathlib.Path(__file__).parent), str(self.tree), *words],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.addCleanup(lambda: (process.kill(), process.communicate()))
            return process
        return start, go

    def wait_for(self, name):
        for _ in range(6000):
            if (self.tree / name).exists():
                return
            time.sleep(0.01)
        self.fail(f"{name} did not begin")

    def test_two_renewals_at_once_keep_each_others_results(self):
        start, go = self.two_springs()
        (self.folder / "measured.csv").write_text("N/mm 7.0\n")
        processes = [start("spring/study.toml"), start("spring/other.toml")]
        for name in ("study.toml.begun", "other.toml.begun"):
            self.wait_for(name)
        self.edit("expected.toml", "It rounds.", "It rounds, as a person wrote during the runs.")
        go.write_text("")
        for process in processes:
            _, said = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 0, said)
        content = studies.read(self.folder / "expected.toml")
        for study in ("study.toml", "other.toml"):
            self.assertEqual(content[study]["values"]["spring"]["value"], 7, study)
            self.assertIn("during the runs", content[study]["reason"])
        text = (self.folder / "README.md").read_text()
        self.assertEqual(text.count("| spring | 7 N/mm |"), 2, text)
        self.assertEqual(sorted(one.name for one in self.folder.iterdir()),
                         sorted(["study.toml", "other.toml", "expected.toml", "measured.csv", "computed.csv", "README.md"]))

    def test_a_study_that_is_being_renewed_is_not_renewed_again(self):
        start, go = self.two_springs()
        first = start("spring/study.toml")
        self.wait_for("study.toml.begun")
        second = start("spring/study.toml")
        _, said = second.communicate(timeout=60)
        self.assertEqual(second.returncode, 2, said)
        self.assertIn(f"spring/study.toml is being renewed by process {first.pid}", said)
        go.write_text("")
        self.assertEqual(first.wait(timeout=60), 0)
        self.assertEqual(start("spring/study.toml").wait(timeout=60), 0)  # the lock ended with its process

    def test_data_are_not_written_while_a_study_of_the_folder_runs(self):
        start, go = self.two_springs()
        first = start("spring/other.toml")
        self.wait_for("other.toml.begun")
        (self.folder / "computed.csv").write_text("N/mm 9.0\n")
        _, said = start("spring/study.toml", "--data").communicate(timeout=60)
        self.assertIn("spring/other.toml is being renewed by", said)
        self.assertEqual((self.folder / "measured.csv").read_text(), "N/mm 5.0\n")
        go.write_text("")
        self.assertEqual(first.wait(timeout=60), 0)

    def test_who_waits_for_a_folder_says_so(self):
        descriptor = os.open(self.folder, os.O_RDONLY)
        self.addCleanup(os.close, descriptor)
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        said = io.StringIO()

        def release_once_said():
            for _ in range(6000):
                if "waits until" in said.getvalue():
                    break
                time.sleep(0.01)
            fcntl.flock(descriptor, fcntl.LOCK_UN)

        threading.Thread(target=release_once_said).start()
        with contextlib.redirect_stderr(said):
            self.asked(studies.renew, [], False)
        self.assertIn(f"waits until process {os.getpid()} has written the results of spring", said.getvalue())

    def test_results_of_a_command_are_kept_by_name_and_compared(self):
        self.add(COMPARISON, "comparison.toml")
        code, said = self.asked(studies.renew, ["spring/comparison.toml"], False)
        text = (self.folder / "expected.toml").read_text()
        self.assertIn('"models.fitted.error.Fx" = 0.125\n', text)  # results of the study before the changed run
        self.assertIn('"models.soft.value [N/m]" = 0.5\n', text)
        self.assertNotIn("seconds\" =", text)
        self.assertIn("| models.fitted.error | 0.125 | 0.0625 |", (self.folder / "README.md").read_text())
        self.assertEqual(self.asked(studies.check, [], False)[0], 0)
        for old, new, words in (("Fz\" = 0.25", "Fz\" = 0.26", "models.soft.error.Fz is 0.25, expected 0.26"),
                                ("soft.error.Fz", "softer.error.Fz", "models.softer.error.Fz is not printed"),
                                ('"models.soft.error.Fx" = 0.5\n', "", "does not know: models.soft.error.Fx")):
            with self.subTest(words):
                self.edit("expected.toml", old, new)
                self.assertIn(words, self.asked(studies.check, [], False)[1])
                (self.folder / "expected.toml").write_text(text)

    def test_a_command_without_such_numbers_is_wrong(self):
        self.add(COMPARISON.replace("error", "errors"), "comparison.toml")
        self.assertRaises(studies.Wrong, self.asked, studies.renew, ["spring/comparison.toml"], False)

    def test_a_study_below_the_folder_is_that_of_the_folder(self):
        self.add(EXPECTED.split("truth")[0].replace("study.toml", "fits/part.toml"), "fits/part.toml", "fits/measured.csv")
        (self.folder / "fits" / "measured.csv").write_text("N/mm 7.0\n")
        self.assertEqual(self.asked(studies.renew, ["spring/fits/part.toml"], False)[0], 0)
        code, said = self.asked(studies.check, ["spring/fits/part.toml"], False)
        self.assertEqual((code, "fits/part.toml: as expected" in said), (0, True), said)

    def test_a_study_without_search_is_one_trial_at_its_values(self):
        self.edit("expected.toml", 'quick = "run"', 'quick = "run"\nsearch = false')
        self.edit("expected.toml", "value = 5", "value = 6")
        self.edit("expected.toml", "truth = ", "# truth = ")
        self.asked(studies.renew, [], False)
        self.assertIn("target = 0.04", (self.folder / "expected.toml").read_text())
        self.assertEqual(self.asked(studies.check, [], False)[0], 0)

    def test_numbers_that_no_run_gave_are_refused(self):
        text = (self.folder / "expected.toml").read_text()
        (self.folder / "expected.toml").write_text("".join(line for line in text.splitlines(True) if "cpu_seconds" not in line))
        for quick in (True, False):
            self.assertIn("not those of a run", self.asked(studies.check, [], quick)[1])

    def test_a_study_that_was_not_run_yet_is_told_and_no_success(self):
        entry = EXPECTED.split("truth")[0].replace("study.toml", "long.toml").replace('quick = "run"', 'quick = "none"')
        self.add(entry + 'no_run = "It takes a day."\n', "long.toml")
        self.assertEqual(studies.without_results(), [])
        studies.write_readme(self.folder, studies.read(self.folder / "expected.toml"))
        self.assertIn("`long.toml`: no run has given its numbers yet. It takes a day.", (self.folder / "README.md").read_text())
        code, said = self.asked(studies.check, [], True)
        self.assertEqual((code, "long.toml: no run has given its numbers yet: It takes a day." in said), (0, True), said)
        self.assertEqual(self.asked(studies.check, [], False)[0], 1)
        self.assertIn("without 1 that no run has timed yet", studies.sums(studies.entries([])))
        with open(self.folder / "expected.toml", "a") as file:  # replaces the numbers by those of one trial
            file.write('["long.toml".values]\nspring = {value = 6, unit = "N/mm"}\n'
                       '["long.toml".errors]\nforce = {mean = 0.2, largest = 0.2, fitted = true}\n')
        self.edit("expected.toml", 'no_run = "It takes a day."', 'no_run = "It takes a day."\ntarget = 0.04')
        self.edit("expected.toml", 'quick = "none"', 'quick = "trial"')
        studies.write_readme(self.folder, studies.read(self.folder / "expected.toml"))
        self.assertEqual(self.asked(studies.check, [], True)[0], 0)
        self.edit("expected.toml", "mean = 0.2,", "mean = 0.3,")
        self.assertIn("mean error of force", self.asked(studies.check, [], True)[1])
        self.assertIn("not those of a run", self.asked(studies.check, [], False)[1])
        self.asked(studies.renew, ["spring/long.toml"], False)
        self.assertNotIn("no_run", (self.folder / "expected.toml").read_text())
        self.assertEqual(self.asked(studies.check, [], False)[0], 0)

    def test_a_figure_in_a_sentence_is_checked_and_renewed(self):
        readme = self.folder / "README.md"
        quoted = "It takes <!-- = study.toml steps -->17<!-- / --> steps.\n"
        readme.write_text(quoted + readme.read_text())
        code, said = self.asked(studies.check, [], True)
        self.assertEqual(code, 1)
        self.assertIn('"17" is written for study.toml steps, where expected.toml says 3', said)
        self.asked(studies.renew, [], False)
        self.assertIn("It takes <!-- = study.toml steps -->3<!-- / --> steps.", readme.read_text())
        self.assertEqual(self.asked(studies.check, [], True)[0], 0)
        self.edit("README.md", "study.toml steps", "study.toml strides")
        self.assertIn('expected.toml has no figure "study.toml strides"', self.asked(studies.check, [], True)[1])
        with self.assertRaises(studies.Wrong):
            studies.write_readme(self.folder, studies.read(self.folder / "expected.toml"))

    def test_figures_are_written_as_their_words_say(self):
        content = {"a.toml": {"target": 0.000121, "steps": 1250, "cpu_seconds": 579.0,
                              "values": {"radial": {"value": 0.6009, "unit": "MN/m^2", "lower": 0.594}},
                              "errors": {"slow.Fx": {"mean": 0.0188, "largest": 0.0687}},
                              "results": {"tires.ring.error.Fx": 0.08523}}}
        for words, expected in (("target %", "0.0121"), ("target root % 2", "1.1"), ("steps", "1250"), ("cpu_seconds minutes 2", "9.7"),
                                ("values.radial", "0.601"), ("values.radial.lower 2", "0.59"), ("values.radial from 0.63", "-4.62"),
                                ("values.radial from 0.6 2", "+0.15"), ("values.radial times 1000", "601"), ("errors.slow.Fx %", "1.88"),
                                ("errors.slow.Fx.largest % 2", "6.9"), ("results.tires.ring.error.Fx % 1", "9")):
            text = study_figures.with_figures(f"<!-- = a.toml {words} --><!-- / -->", content)
            self.assertEqual(text, f"<!-- = a.toml {words} -->{expected}<!-- / -->")
        for words in ("values.lateral", "values.radial upside down", "values"):
            with self.assertRaises(study_figures.NoFigure):
                study_figures.with_figures(f"<!-- = a.toml {words} --><!-- / -->", content)

    def test_a_study_of_which_nobody_speaks_is_found(self):
        self.assertEqual(studies.without_results(), [])
        fit = '[variable.spring]\npath = "spring"\n[experiment.force]\nkind = "values"\n'
        for name, text in (("fits/other.toml", fit), ("wide.toml", 'channels = ["Fx"]\n[tire.ring]\nfile = "ring.toml"\n'),
                           ("suite.toml", '[check.first]\nlower = 1\n'), ("rig.toml", "[run.a]\n[hammer]\n")):
            self.add("", name)
            (self.folder / name).write_text(text)
            self.assertIn(f"studies/spring/{name} is a study of which no", "".join(studies.without_results()))
            (self.folder / name).write_text("[chassis]\n")  # a model
        (self.folder / "laboratory.toml").write_text(fit.replace("variable.spring", "variable.none"))
        self.assertEqual(studies.without_results(), [])
        self.edit("expected.toml", "cpu_seconds", "# cpu_seconds")
        self.assertIn("study.toml are not those of a run", "".join(studies.without_results()))

    def test_costs_are_summed(self):
        self.edit("expected.toml", 'quick = "run"', 'quick = "trial"')
        text = (self.folder / "expected.toml").read_text()
        for key, value in (("cpu_seconds", 600.0), ("trial_seconds", 30.0)):
            text = re.sub(rf"(?m)^{key} = .*$", f"{key} = {value}", text)
        (self.folder / "expected.toml").write_text(text)
        self.assertIn("1 studies: --check takes 10 minutes of processor time, --quick, which the tests run, 0.5 minutes",
                      studies.sums(studies.entries([])))

    def test_numbers_of_files_differ_by_more_than_the_tolerance(self):
        self.assertEqual(studies.changed_numbers("a 1.0,2e3\n", "a 1.0000001,2000\n", 1e-6), 0)
        self.assertEqual(studies.changed_numbers("a 1.0,2e3\n", "a 1.00001,2000\n", 1e-6), 1)
        self.assertEqual(studies.changed_numbers("a 1,2\n", "b 1,2\n", 1e-6), 2)


if __name__ == "__main__":
    unittest.main()
