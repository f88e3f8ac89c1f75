#!/usr/bin/env python3
"""tools/studies.py on a tree of its own with a program that answers as latsch does: what it has to find, it finds."""
import contextlib
import io
import pathlib
import tempfile
import unittest

import studies

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
print(json.dumps({"result": result}))
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
        """Exit code and what was printed."""
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

    def test_numbers_of_files_differ_by_more_than_the_tolerance(self):
        self.assertEqual(studies.changed_numbers("a 1.0,2e3\n", "a 1.0000001,2000\n", 1e-6), 0)
        self.assertEqual(studies.changed_numbers("a 1.0,2e3\n", "a 1.00001,2000\n", 1e-6), 1)
        self.assertEqual(studies.changed_numbers("a 1,2\n", "b 1,2\n", 1e-6), 2)


if __name__ == "__main__":
    unittest.main()
