#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests tools/public_headers.py: installed headers include each other below latsch/, and the text for Doxygen has the
comment of every member at that member. With Doxygen installed, a member without a comment is an error."""
import contextlib
import io
import pathlib
import shutil
import subprocess
import tempfile
import unittest
from unittest import mock

import public_headers as tool

HEADER = """\
// SPDX-License-Identifier: Apache-2.0
// A wheel of a cart.
//
// It turns.
#pragma once

#include <array>

#include "base/error.h"

struct CartWheel {
  double radius = 0.3, width = 0.2;  // m, at
                                     // rest
  std::array<double, 2> x{}, y{};  // m
  std::string unit = "1";  // of the <load>
  bool operator==(const CartWheel&) const = default;
  /// Both in N.
  double load, *drag;
  void turn(int a, int b);
};
"""


class PublicHeaders(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.header = self.folder / "cart_wheel.h"
        self.header.write_text(HEADER)
        self.lines = tool.filtered(self.header).splitlines()

    def enterContext(self, context):  # Python 3.11 has it
        value = context.__enter__()
        self.addCleanup(context.__exit__, None, None, None)
        return value

    def line_of(self, word):
        return next(line for line in self.lines if word in line)

    def test_a_warning_names_the_line_of_the_source(self):
        self.assertEqual(len(self.lines), len(HEADER.splitlines()))

    def test_the_head_describes_the_file_and_the_class_of_its_name(self):
        self.assertEqual(self.lines[:2], [r"/// \file", "/// A wheel of a cart."])
        self.assertIn("/** A wheel of a cart. */ struct CartWheel {", self.lines)

    def test_a_comment_behind_several_members_describes_each(self):
        self.assertEqual(self.line_of("radius").split(),
                         "double radius = 0.3; /**< m, at */ double width = 0.2; /**< m, at */".split())
        self.assertEqual(self.line_of("x{}").count("/**< m */"), 2)
        self.assertEqual(self.line_of("*drag").count("/**< Both in N. */"), 2)

    def test_texts_are_no_commands_of_doxygen(self):
        self.assertIn(r"///< of the \<load\>", self.line_of("unit"))

    def test_parameters_are_no_members(self):
        self.assertIn("  void turn(int a, int b);", self.lines)

    def test_installed_headers_include_each_other_below_latsch(self):
        text = tool.installed_text(HEADER)
        self.assertIn('#include "latsch/base/error.h"', text)
        self.assertIn("#include <array>", text)

    def test_every_installed_header_has_what_it_includes(self):
        names = tool.closure(tool.listed())
        self.assertLess(set(tool.listed()), set(names))
        for name in names:
            for used in tool.INCLUDE.findall(tool.source(name).read_text()):
                self.assertIn(used[1], names)

    def test_an_example_may_include_only_listed_headers(self):
        examples = self.folder / "examples"
        examples.mkdir()
        (examples / "1.cpp").write_text('#include "base/error.h"\n#include <latsch/numerics/student_t.h>\n')
        page = self.folder / "headers.md"
        page.write_text("| `base/error.h` | errors |\n| `base/none.h` | nothing |\n")
        with mock.patch.object(tool, "EXAMPLES", examples), mock.patch.object(tool, "PAGE", page):
            told = io.StringIO()
            with contextlib.redirect_stderr(told), contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(tool.main([]), 1)
        for words in ("there is no base/none.h", 'includes "base/error.h": write <latsch/', "numerics/student_t.h, which"):
            self.assertIn(words, told.getvalue())

    @unittest.skipUnless(shutil.which("doxygen"), "doxygen is not installed")
    def test_doxygen_refuses_a_member_without_a_comment(self):
        def made(text):
            (self.folder / "cart_wheel.h").write_text(text)
            shown = tool.filtered(self.header)
            self.header.write_text(shown)
            settings = f"INPUT={self.header}\nOUTPUT_DIRECTORY={self.folder}\nGENERATE_LATEX=NO\nHAVE_DOT=NO\n" \
                       "QUIET=YES\nWARN_AS_ERROR=FAIL_ON_WARNINGS\nJAVADOC_AUTOBRIEF=YES\n"
            return subprocess.run(["doxygen", "-"], input=settings, text=True, capture_output=True, check=False)
        described = HEADER.replace("  void turn", "  /// Turns.\n  void turn")
        self.assertEqual(made(described).returncode, 0)
        bare = made(HEADER)
        self.assertNotEqual(bare.returncode, 0)
        self.assertIn("cart_wheel.h:19", bare.stderr)


if __name__ == "__main__":
    unittest.main()
