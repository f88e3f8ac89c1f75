#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests that the stubs contain exactly the existing names with their arguments, that everything public has a
docstring, and that the examples run."""
import ast
import importlib.metadata
import inspect
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import latsch
from python_testing import LATSCH, ROOT

STUBS = ast.parse((pathlib.Path(latsch.__file__).with_name("__init__.pyi")).read_text())
ONLY_TYPES = {"Array", "Path", "Best"}


def stubbed(body):
    names = {one.name: one for one in body if isinstance(one, (ast.ClassDef, ast.FunctionDef))}
    names |= {one.target.id: one for one in body if isinstance(one, ast.AnnAssign)}
    return names


def arguments(function):
    names = [one.arg for one in function.args.args + function.args.kwonlyargs]
    return [name for name in names if name != "self"]


class Stubs(unittest.TestCase):
    def test_they_name_what_is_there(self):
        names = stubbed(STUBS.body)
        self.assertEqual(set(names) - ONLY_TYPES - {"__version__", "__all__"}, set(latsch.__all__))
        for name in latsch.__all__:
            thing = getattr(latsch, name)
            if not inspect.isclass(thing):
                continue
            own = {one for base in thing.__mro__ if base.__module__.startswith("latsch") for one in vars(base)
                   if not one.startswith("_")}
            told = {one for one in stubbed(names[name].body) if not one.startswith("_")}
            # the other classes have these attributes only in instances
            if name not in ("InputError", "Failure", "Posterior", "Recording", "Trials"):
                self.assertEqual(told, own, name)

    def test_they_have_the_arguments(self):
        for one in STUBS.body:
            if isinstance(one, ast.FunctionDef):
                self.has_arguments(one.name, one, getattr(latsch, one.name))
            if isinstance(one, ast.ClassDef) and one.name in latsch.__all__:
                for method in one.body:
                    is_method = isinstance(method, ast.FunctionDef) and not method.decorator_list
                    if is_method and not (method.name.startswith("__") and method.name != "__init__"):
                        self.has_arguments(f"{one.name}.{method.name}", method, getattr(getattr(latsch, one.name), method.name))

    def has_arguments(self, name, stub, thing):
        try:
            there = [one for one in inspect.signature(thing).parameters.values()]
            names = [one.name for one in there if one.kind != one.VAR_KEYWORD and one.name != "self"]
            if names and names != ["args"]:
                self.assertEqual(arguments(stub), names, name)
        except ValueError:  # a function of the extension module: its docstring begins with the signature
            signature = thing.__doc__.splitlines()[0]
            for argument in arguments(stub):
                self.assertRegex(signature, rf"\b{argument}\b", name)

    def test_all_says_what_it_is(self):
        for name in latsch.__all__:
            self.assertTrue((getattr(latsch, name).__doc__ or "").strip(), name)


class Examples(unittest.TestCase):
    def test_they_run(self):
        says = {"decay": "k = 0.503, 95 %: 0.486 .. 0.521, identifiable", "bushings": "stiffer by a tenth",
                "study": "40 trials", "workers": "the path of one process: the same"}
        examples = sorted((ROOT / "apps/python/examples").glob("*.py"))
        self.assertEqual({one.stem for one in examples}, set(says))
        environment = {**os.environ, "LATSCH_PROGRAM": LATSCH}
        with tempfile.TemporaryDirectory(prefix="latsch_python_") as folder:
            for example in examples:
                command = [sys.executable, example] + ([folder] if example.stem == "study" else [])
                run = subprocess.run(command, capture_output=True, text=True, env=environment)
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertIn(says[example.stem], run.stdout)


    def test_the_page_prints_what_it_says(self):
        page = (ROOT / "docs/python.md").read_text()
        program = page.split("```python\n")[1].split("```")[0]
        run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, cwd=ROOT)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("prints\n\n" + "".join(f"    {line}\n" for line in run.stdout.splitlines()), page)


class Import(unittest.TestCase):
    def test_its_version_is_the_programs(self):
        program = subprocess.run([LATSCH, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
        self.assertEqual(latsch.__version__, program)
        self.assertEqual(importlib.metadata.version("latsch"), program)

    def test_it_loads_no_numpy(self):
        script = "import sys, latsch; sys.exit('numpy' in sys.modules)"
        self.assertEqual(subprocess.run([sys.executable, "-c", script]).returncode, 0)


if __name__ == "__main__":
    unittest.main()
