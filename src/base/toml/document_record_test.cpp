// SPDX-License-Identifier: Apache-2.0
#include "base/document_record.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/scratch_folder_testing.h"

namespace latsch {
namespace {

/// Reads keys of every kind, as the reader of a study does.
DocumentRecord read(const Document& document, const std::string& table = "") {
  const Node root = document.root();
  DocumentRecord record(table.empty() ? root : root.table(table));
  const Node& node = record.node();
  node.quantity("speed", "m/s", Range::positive());
  node.quantity("pressure", "Pa", Range::positive(), 2.6e5);
  node.choice("mode", {"heave", "roll"}, "heave");
  node.flag("spectra", false);
  node.integer("count", 1, 9, 3);
  if (node.has("loads")) node.one_or_more("loads", "N");
  if (node.has("points")) node.rows("points", {"m", "1"});
  if (node.has("names")) node.texts("names");
  if (const auto road = node.find_table("road")) road->quantity("heading", "rad", {}, 0.0);
  node.has("mark");
  root.close();
  return record;
}

std::string text_of(const std::string& toml, const std::string& table = "") {
  return read(Document::parse(toml, "test.toml"), table).text();
}

TEST(DocumentRecordTest, SaysEveryKeyWithItsResolvedValue) {
  EXPECT_EQ(text_of("speed = \"36 km/h\"\nloads = [\"1 kN\", \"2 kN\"]\n[road]\n"),
            "count = 3\nloads = {unit = \"N\", values = [1000, 2000]}\nmode = \"heave\"\n"
            "pressure = \"260000 Pa\"\nroad.heading = \"0 rad\"\nspectra = false\n"
            "speed = \"10 m/s\"\n");
}

TEST(DocumentRecordTest, IsBlindForNotesUnitsOrderDefaultsAndPlace) {
  const std::string one = text_of("speed = \"36 km/h\"\nloads = \"1 kN\"\n");
  EXPECT_EQ(one, text_of("# a note\nloads   = [\"1000 N\"]  # another\n\nspeed = \"10 m/s\"\n"));
  EXPECT_EQ(one,
            text_of("speed = \"10 m/s\"\nloads = \"1 kN\"\nmode = \"heave\"\ncount = 3\n"
                    "pressure = \"2.6 bar\"\nspectra = false\n"));
  EXPECT_EQ(one, text_of("[test]\nspeed = \"10 m/s\"\nloads = \"1 kN\"\n", "test"));
}

TEST(DocumentRecordTest, AValueThatIsAlsoReadAsATextStaysWhatItIs) {
  const Document document = Document::parse("width = \"3 mm\"\nmode = \"roll\"\n", "test.toml");
  const DocumentRecord record(document.root());
  record.node().quantity("width", "m", Range::positive());
  record.node().text("width");
  record.node().choice("mode", {"heave", "roll"});
  record.node().text("mode");
  const DeclaredKey& width = record.keys().at("width");
  EXPECT_EQ(width.kind, DeclaredKey::Kind::quantity);
  EXPECT_EQ(width.units, std::vector<std::string>{"m"});
  EXPECT_TRUE(width.range.lower_excluded);
  EXPECT_EQ(record.keys().at("mode").choices.size(), 2u);
}

TEST(DocumentRecordTest, KnowsWhichKeysMayBeMissingAndWhatATextHasToBe) {
  const Document document = Document::parse("noise = \"3 %\"\nforce = \"1 N\"\n", "test.toml");
  const DocumentRecord outer(document.root());
  const DocumentRecord record(outer.node());
  if (record.node().has("noise")) record.node().text("noise");
  record.node().quantity("force", "N");
  for (int times = 0; times < 2; ++times)
    DocumentRecord::expects(record.node(), "noise", "a share such as \"3 %\"");
  for (const auto& keys : {record.keys(), outer.keys()}) {
    EXPECT_TRUE(keys.at("noise").may_be_missing);
    EXPECT_FALSE(keys.at("force").may_be_missing);
    EXPECT_EQ(keys.at("noise").expected, std::vector<std::string>{"a share such as \"3 %\""});
  }
}

TEST(DocumentRecordTest, DiffersWithEveryKey) {
  const std::string all =
      "speed = \"10 m/s\"\npressure = \"2 bar\"\nmode = \"roll\"\nspectra = true\ncount = 2\n"
      "loads = [\"1 kN\"]\npoints = [[\"1 m\", 2]]\nnames = [\"a\"]\nmark = 1\n"
      "[road]\nheading = \"1 deg\"\n";
  const std::string before = text_of(all);
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"10 m/s", "10.000001 m/s"},
                                                        {"2 bar", "2.1 bar"},
                                                        {"roll", "heave"},
                                                        {"true", "false"},
                                                        {"count = 2", "count = 4"},
                                                        {"1 kN", "1.1 kN"},
                                                        {"1 m\"", "2 m\""},
                                                        {", 2]", ", 3]"},
                                                        {"[\"a\"]", "[\"b\"]"},
                                                        {"mark = 1", "mark = 2"},
                                                        {"1 deg", "2 deg"},
                                                        {"[\"a\"]", "[\"a\", \"a\"]"}}) {
    std::string changed = all;
    changed.replace(changed.find(from), from.size(), to);
    EXPECT_NE(text_of(changed), before) << from;
  }
}

TEST(DocumentRecordTest, DeclaresUnitRangeChoicesAndDefault) {
  const DocumentRecord record = read(Document::parse("speed = \"10 m/s\"\n", "test.toml"));
  const auto& keys = record.keys();
  EXPECT_EQ(keys.at("pressure").units, std::vector<std::string>{"Pa"});
  EXPECT_EQ(keys.at("pressure").fallback, "\"260000 Pa\"");
  EXPECT_TRUE(keys.at("pressure").range.lower_excluded);
  EXPECT_EQ(keys.at("mode").choices, (std::vector<std::string>{"heave", "roll"}));
  EXPECT_EQ(keys.at("count").range.upper, 9.0);
  EXPECT_EQ(keys.at("road").kind, DeclaredKey::Kind::table);
  EXPECT_FALSE(keys.at("road").is_there);
  EXPECT_TRUE(keys.at("speed").is_there);
}

TEST(DocumentRecordTest, AFileCountsByItsContentAndEnding) {
  const ScratchFolder folder;
  const auto text = [&](const std::string& name) {
    const Document document = Document::parse("file = \"" + name + "\"\n", "test.toml");
    const DocumentRecord record(document.root());
    DocumentRecord::names_files(record.node(), "file", {folder / record.node().text("file")});
    return record.text();
  };
  write_text_file(folder / "a.csv", "1\n");
  write_text_file(folder / "b.csv", "1\n");
  write_text_file(folder / "c.csv", "2\n");
  write_text_file(folder / "a.txt", "1\n");
  EXPECT_EQ(text("a.csv"), text("b.csv"));
  EXPECT_NE(text("a.csv"), text("c.csv"));
  EXPECT_NE(text("a.csv"), text("a.txt"));
  write_text_file(folder / "a.toml", "height = \"10 mm\"\n");
  write_text_file(folder / "b.toml", "# noted\nheight = \"1 cm\"\n");
  write_text_file(folder / "c.toml", "height = \"2 cm\"\n");
  EXPECT_EQ(text("a.toml"), text("b.toml"));
  EXPECT_NE(text("a.toml"), text("c.toml"));
}

TEST(DocumentRecordTest, ATableStandsForWhatItWasResolvedInto) {
  const Document document = Document::parse("speed = {from = \"measurement.rig\"}\n", "test.toml");
  const DocumentRecord record(document.root());
  const Node table = *record.node().find_table("speed");
  table.text("from");
  DocumentRecord::stands_for(table, canonical(10.0, "m/s"));
  EXPECT_EQ(record.text(), "speed = \"10 m/s\"\n");
}

TEST(DocumentRecordTest, TheCanonicalTextOfADocumentIsItsOwn) {
  const Document document = Document::parse(
      "title = \"a \\\"b\\\"\"  # note\n[rubber.tread]\nyoung_modulus = \"4 MPa\"\nflag = true\n"
      "[section]\ncontour = {unit = \"mm\", values = [[0, 310], [1.5, 2]]}\n\"odd key\" = 1e3\n"
      "[empty]\n",
      "tire.toml");
  const std::string text = canonical_text(document);
  EXPECT_EQ(text,
            "title = \"a \\\"b\\\"\"\nrubber.tread.young_modulus = \"4000000 Pa\"\n"
            "rubber.tread.flag = true\n"
            "section.contour = [[\"0 m\", \"0.31 m\"], [\"0.0015 m\", \"0.002 m\"]]\n"
            "section.\"odd key\" = 1000\nempty = {}\n");
  EXPECT_EQ(canonical_text(Document::parse(text, "again.toml")), text);
  Document changed = document;
  changed.set("rubber.tread.young_modulus", 5e6);
  EXPECT_NE(canonical_text(changed), text);
}

}  // namespace
}  // namespace latsch
