// SPDX-License-Identifier: Apache-2.0
#include "base/document_parts.h"

#include <gtest/gtest.h>

namespace latsch {
namespace {

const char* const kPart = R"(
kind = "ring"     # a comment
title = "with \"quotes\" and # signs"
pressure = "2.4 bar"
contour = {unit = "mm", values = [[0, 310], [10.5, 300]]}
levels = ["1 m", "2 m"]
[side.radial]
stiffness = "0.55 MN/m^2"
on = true
)";

TEST(DocumentParts, APartKeepsItsNumbersUnderPathsOfItsOwn) {
  const Document part = Document::parse(kPart, "ring.toml");
  const Document whole = Document::parse(
      "title = \"car\"\ntire = \"ring.toml\"\n[body]\nmass = \"5 kg\"\n", "car.toml");
  Document both = with_part(whole, "tire", part);
  for (const std::string& path : part.paths()) EXPECT_EQ(both.get("tire." + path), part.get(path));
  EXPECT_EQ(both.paths().size(), part.paths().size() + 1);
  EXPECT_EQ(both.get("body.mass"), 5.0);
  EXPECT_FALSE(has_part(whole, "tire"));
  EXPECT_TRUE(has_part(both, "tire"));
  both.set("tire.side.radial.stiffness", 6e5);
  both.set("tire.contour.1.0", 0.011);
  const Document back = part_of(both, "tire");
  EXPECT_EQ(back.get("side.radial.stiffness"), 6e5);
  EXPECT_EQ(back.get("contour.1.0"), 0.011);
  EXPECT_EQ(back.root().text("title"), "with \"quotes\" and # signs");
  EXPECT_TRUE(back.root().table("side").table("radial").flag("on", false));
}

TEST(DocumentParts, LinesOfTheWholeKeepTheirNumbers) {
  const Document both =
      with_part(Document::parse("a = \"1 m\"\ntire = \"x\"\nb = \"2 kg\"\n", "car.toml"),
                "tire",
                Document::parse("c = \"3 N\"", "x"));
  try {
    both.root().quantity("b", "m");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("car.toml:3"), std::string::npos) << error.what();
  }
}

TEST(DocumentParts, ALineBecomesLinesOfTheSameTable) {
  const std::vector<std::string> lines = {"x = \"3 N\"", "deep.y = \"4 N\""};
  for (const std::string text :
       {"[a.b]\nbefore = \"1 m\"\n  file = \"f\"   # comment\nbehind = \"2 m\"\n",
        "[a]\nb.before = \"1 m\"\nb.file = \"f\"\nb.behind = \"2 m\"",
        "a.b.before = \"1 m\"\na.b.behind = \"2 m\"\na.b.file = 'f'"}) {
    const Document document = with_lines(Document::parse(text, "car.toml"), "a.b.file", lines);
    EXPECT_EQ(document.get("a.b.x"), 3.0) << document.text();
    EXPECT_EQ(document.get("a.b.deep.y"), 4.0);
    EXPECT_EQ(document.get("a.b.before"), 1.0);
    EXPECT_EQ(document.get("a.b.behind"), 2.0);
    EXPECT_FALSE(document.root().table("a").table("b").has("file"));
  }
  for (const std::string text : {"a.b = {file = \"f\"}\n", "a = {b.file = \"f\", c = 1}\n"})
    EXPECT_THROW(with_lines(Document::parse(text, "car.toml"), "a.b.file", lines), InputError);
}

TEST(DocumentParts, WhatIsNoPartIsRefused) {
  const Document whole = Document::parse("tire = 3\n", "car.toml");
  EXPECT_THROW(with_part(whole, "tire", whole), InputError);
  EXPECT_THROW(part_of(whole, "tire"), InputError);
  EXPECT_FALSE(has_part(whole, "tire"));
  EXPECT_FALSE(has_part(whole, "body"));
}

}  // namespace
}  // namespace latsch
