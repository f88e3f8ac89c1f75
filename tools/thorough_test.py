#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests that the steps of tools/thorough.sh find the faults that they look for, in small trees made for this test.
Ends with 77, as a skipped test, if clang-format or clang-tidy is not installed."""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

TREE = pathlib.Path(__file__).resolve().parents[1]
CLEAN = "int twice(int x) { return 2 * x; }\n"
SUSPICIOUS = "int twice(int x) { return sizeof(sizeof(x)) + x; }\n"  # bugprone-sizeof-expression


class Thorough(unittest.TestCase):
    def setUp(self):
        self.tree = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.tree)
        (self.tree / "tools").mkdir()
        (self.tree / "src").mkdir()
        for name in ("tools/thorough.sh", "tools/format.sh", "tools/tidy.py", "tools/alone.py", "tools/compile_commands.py",
                     ".clang-format", ".clang-tidy"):
            shutil.copy(TREE / name, self.tree / name)
        (self.tree / "tools/install_packages.sh").write_text("#!/bin/sh\n")
        (self.tree / "tools/install_packages.sh").chmod(0o755)
        self.write(CLEAN)

    def write(self, text, name="src/twice.cpp"):
        (self.tree / name).write_text(text)

    def steps(self, *names):
        done = subprocess.run(["sh", self.tree / "tools/thorough.sh", *names], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        return done.returncode, done.stdout

    def tidy(self):
        build = self.tree / "build"
        build.mkdir(exist_ok=True)
        source = self.tree / "src/twice.cpp"
        test = self.tree / "src/twice_test.cpp"
        command = "/usr/bin/ccache /usr/bin/c++ -mmove-max=256 --param=x=1 -fsanitize=address -std=c++20 -c "
        entries = [{"directory": str(build), "command": command + str(file), "file": str(file)} for file in (source, test)]
        (build / "compile_commands.json").write_text(json.dumps(entries))
        done = subprocess.run([sys.executable, self.tree / "tools/tidy.py", build], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        return done.returncode, done.stdout

    def alone(self, *names):
        build = self.tree / "build"
        build.mkdir(exist_ok=True)
        options = f"-I{self.tree}/src -isystem /usr/include/eigen3 -O0 -fPIC -Wall -Wextra -Werror -std=c++20 -o x.o -c "
        entries = [{"directory": str(build), "command": "/usr/bin/ccache /usr/bin/c++ " + options + str(self.tree / name),
                    "file": str(self.tree / name)} for name in names]
        (build / "compile_commands.json").write_text(json.dumps(entries))
        done = subprocess.run([sys.executable, self.tree / "tools/alone.py", build], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        return done.returncode, done.stdout

    def test_alone_finds_a_missing_include_though_other_files_have_it(self):
        self.write("#include <string>\nstd::string first() { return {}; }\n", "src/first.cpp")
        self.write("std::string second() { return {}; }\n", "src/second.cpp")
        code, said = self.alone("src/first.cpp", "src/second.cpp")
        self.assertEqual(code, 1, said)
        self.assertIn("src/first.cpp: clean", said)
        self.assertIn("src/second.cpp: NOT clean", said)
        self.assertIn("1 files are not clean", said)

    def test_alone_finds_a_warning_and_reads_clean_files_once(self):
        self.write("void unused(int x) {}\n")
        for _ in range(2):
            code, said = self.alone("src/twice.cpp")
            self.assertEqual(code, 1, said)
            self.assertIn("unused parameter", said)
        self.write(CLEAN)
        self.assertEqual(self.alone("src/twice.cpp")[0], 0)
        self.assertIn("1 files, 1 of them unchanged", self.alone("src/twice.cpp")[1])

    def test_a_precompiled_kit_brings_no_header_that_the_file_does_not_include(self):
        self.write("#include <Eigen/Core>\n", "src/point.h")
        self.write('#include "point.h"\nstd::filesystem::path lost() { return {}; }\n', "src/lost.cpp")
        code, said = self.alone("src/lost.cpp")
        self.assertEqual(code, 1, said)
        self.assertIn("filesystem", said)
        self.write('#include <filesystem>\n#include "point.h"\nstd::filesystem::path lost() { return {}; }\n', "src/lost.cpp")
        self.assertEqual(self.alone("src/lost.cpp")[0], 0)

    def test_a_step_names_itself_its_time_and_its_result(self):
        code, said = self.steps("format")
        self.assertEqual(code, 0, said)
        self.assertRegex(said, r"format +passed after 0 min \d\d s")
        self.assertNotIn("failed", said)

    def test_a_failed_step_is_in_the_table_and_the_steps_after_it_run(self):
        self.write("int  twice( int x ) {return 2*x;}\n")
        code, said = self.steps("format", "format")
        self.assertEqual(code, 1, said)
        self.assertIn("src/twice.cpp:1", said)  # the end of its output
        self.assertEqual(said.count("clang-format would change no file"), 2)
        self.assertEqual(said.split("failed:")[1].count("build/thorough/format.log"), 2)

    def test_a_step_of_several_commands_fails_with_its_first(self):
        code, said = self.steps("alone")  # this step needs a configured build, which the small tree lacks
        self.assertEqual(code, 1, said)
        self.assertRegex(said, r"alone +FAILED")

    def test_an_unknown_step_is_refused_with_the_names_there_are(self):
        code, said = self.steps("format", "santizers")
        self.assertEqual(code, 2)
        self.assertIn('no step is called "santizers"; the steps are: format tidy', said)
        listed = self.steps("--list")[1]
        for name in said.split("the steps are:")[1].split():
            self.assertIn(name, listed)

    def test_tidy_finds_a_fault_and_checks_clean_files_once(self):
        self.write(SUSPICIOUS, "src/twice_test.cpp")  # tests are not checked
        code, said = self.tidy()
        self.assertEqual(code, 0, said)
        self.assertIn("1 groups of files, 0 of them unchanged", said)
        self.assertIn("1 groups of files, 1 of them unchanged", self.tidy()[1])
        self.write(SUSPICIOUS)
        for _ in range(2):  # a second run must report the fault again
            code, said = self.tidy()
            self.assertEqual(code, 1, said)
            self.assertIn("bugprone-sizeof-expression", said)

    def test_tidy_checks_again_if_an_included_file_has_changed(self):
        self.write('#include "twice.h"\n')
        self.write(CLEAN, "src/twice.h")
        self.assertEqual(self.tidy()[0], 0)
        self.write(SUSPICIOUS, "src/twice.h")
        code, said = self.tidy()
        self.assertEqual(code, 1, said)
        self.assertIn("bugprone-sizeof-expression", said)


if not (shutil.which("clang-format") and shutil.which("clang-tidy")):
    print("clang-format or clang-tidy is not installed: tools/install_packages.sh thorough")
    sys.exit(77)
unittest.main()
