// SPDX-License-Identifier: Apache-2.0
// The identity of the study that a journal belongs to contains everything a trial depends on, in
// however many files, and nothing else.
#include <gtest/gtest.h>

#include <regex>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "correlation/study/study.h"
#include "evaluation/journal/study_identity.h"
#include "experiment/language.h"

namespace latsch::correlation {
namespace {

const std::filesystem::path kKerbStudy = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/kerb";

constexpr const char* kSurface =
    "$ROAD_CRG\nreference_line_increment = 1\n$\n$KD_DEFINITION\n#:LRFI\n"
    "D:long section at v = -1,m\nD:long section at v = 1,m\n$\n$$$$\n"
    " 0.1000000 0.1000000\n 0.2000000 0.2000000\n";

constexpr const char* kBushing =
    "[MDI_HEADER]\n FILE_TYPE = 'bus'\n FILE_VERSION = 4.0\n FILE_FORMAT = 'ASCII'\n[UNITS]\n"
    " LENGTH = 'mm'\n ANGLE = 'degrees'\n FORCE = 'newton'\n MASS = 'kg'\n TIME = 'second'\n"
    "[DAMPING]\n FX_DAMPING = 1\n FY_DAMPING = 1\n FZ_DAMPING = 1\n TX_DAMPING = 1\n"
    " TY_DAMPING = 1\n TZ_DAMPING = 1\n"
    "[FX_CURVE]\n -1 -10000\n 1 10000\n[FY_CURVE]\n -1 -10000\n 1 10000\n"
    "[FZ_CURVE]\n -1 -10000\n 1 10000\n[TX_CURVE]\n -1 -1000\n 1 1000\n"
    "[TY_CURVE]\n -1 -1000\n 1 1000\n[TZ_CURVE]\n -1 -1000\n 1 1000\n";

constexpr const char* kKeys =
    "kind = \"kerb\"\nspeed = \"10 m/s\"\nduration = \"0.1 s\"\n[ROADroad]\nfile = \"NAME\"\n"
    "beyond_edge = \"continue\"\n";

/// A car of several files, one of them of hardpoints and one of a bushing, is driven over a road.
class IdentityOfStudies : public testing::Test {
 protected:
  IdentityOfStudies() {
    write("car.toml", read_text_file(kKerbStudy / "mf_compliant.toml"));
    write("rear.toml", read_text_file(kKerbStudy / "rear.toml"));
    write("slick.tir", read_text_file(kKerbStudy / "slick.tir"));
    std::string front = read_text_file(kKerbStudy / "front.toml"),
                points = "name,x [mm],y [mm],z [mm]\n";
    static const std::regex point(
        R"re((\w+) = \["([-\d.]+) mm", "([-\d.]+) mm", "([-\d.]+) mm"\]\n)re");
    for (std::smatch found; std::regex_search(front, found, point);) {
      points += found[1].str() + "," + found[2].str() + "," + found[3].str() + "," +
                found[4].str() + "\n";
      front.erase(static_cast<std::size_t>(found.position(0)),
                  static_cast<std::size_t>(found.length(0)));
    }
    replace(front, "[hardpoint]\n", "");
    replace(front, "side = \"left\"\n", "side = \"left\"\nhardpoints = \"points.csv\"\n");
    write("front.toml", front + "\n[bushing.ubj]\nfile = \"rubber.bus\"\n");
    write("points.csv", points);
    write("rubber.bus", kBushing);
    write("surface.crg", kSurface);
    write("track.crg", "$ROAD_CRG_FILE\n surface.crg\n$\n");
    write("track.toml", "kind = \"flat\"\nfriction = 0.9\n");
    write("study.toml", study(inline_test("track.crg")));
  }

  static void replace(std::string& text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }
  static std::string keys(const std::string& road, const std::string& table) {
    std::string text = kKeys;
    replace(text, "ROAD", table);
    replace(text, "NAME", road);
    return text;
  }
  static std::string inline_test(const std::string& road) {
    return "[test.run]\n" + keys(road, "test.run.");
  }
  static std::string study(const std::string& test) {
    return "model = \"car.toml\"\n" + test +
           "[variable.spring]\npath = \"front.spring.stiffness\"\nlower = \"30 N/mm\"\n"
           "upper = \"80 N/mm\"\ninitial = \"50 N/mm\"\n"
           "[experiment.push]\nkind = \"values\"\nchannel = \"run/pushrod_FL\"\nof = \"largest\"\n"
           "value = \"5 kN\"\n";
  }
  void write(const std::string& name, const std::string& text) {
    write_text_file(folder_ / name, text);
  }
  void edit(const std::string& name, const std::string& from, const std::string& to) {
    std::string text = read_text_file(folder_ / name);
    replace(text, from, to);
    write(name, text);
  }
  StudyIdentity read() {
    return identity(read_study(folder_ / "study.toml", experiment::language()));
  }
  /// What differs after an edit of a file; the edit is undone.
  std::string differs(const std::string& name, const std::string& from, const std::string& to) {
    const StudyIdentity before = read();
    const std::string text = read_text_file(folder_ / name);
    edit(name, from, to);
    const auto what = difference(before, read());
    write(name, text);
    EXPECT_FALSE(difference(before, read()));
    return what.value_or("");
  }

  ScratchFolder folder_;
};

TEST_F(IdentityOfStudies, AnEditedRoadOfATestInTheStudyIsAnotherStudy) {
  const std::string what = differs("surface.crg", "0.2000000 0.2", "0.3000000 0.2");
  EXPECT_NE(what.find("\"tests\" differs"), std::string::npos) << what;
  EXPECT_NE(what.find("run.road.file"), std::string::npos) << what;
  EXPECT_NE(differs("track.crg", "$ROAD_CRG_FILE", "$CT\n a note\n$\n$ROAD_CRG_FILE"), "");
  write("study.toml", study(inline_test("track.toml")));
  EXPECT_NE(differs("track.toml", "0.9", "0.8"), "");
}

TEST_F(IdentityOfStudies, ATestThatIsMovedIntoAFileKeepsItsJournal) {
  const StudyIdentity before = read();
  write("tests.toml", keys("track.crg", ""));
  write("study.toml", study("[test.run]\nfile = \"tests.toml\"\n"));
  EXPECT_FALSE(difference(before, read()));
  std::filesystem::create_directory(folder_ / "tests");
  write("tests/run.toml", keys("../track.crg", ""));
  write("study.toml", study("[test.run]\nfile = \"tests/run.toml\"\n"));
  EXPECT_FALSE(difference(before, read()));
  EXPECT_NE(differs("surface.crg", "0.2000000 0.2", "0.3000000 0.2"), "");
  EXPECT_NE(differs("tests/run.toml", "0.1 s", "0.11 s"), "");
}

TEST_F(IdentityOfStudies, EveryFileOfTheModelCounts) {
  EXPECT_NE(differs("car.toml", "220 kg", "221 kg"), "");
  EXPECT_NE(differs("rear.toml", "125.161 mm", "125.171 mm"), "");
  EXPECT_NE(differs("points.csv", "1648.347", "1648.348"), "");
  EXPECT_NE(differs("rubber.bus", " 1 10000\n[FY", " 1 11000\n[FY"), "");
  const std::string tire = read_text_file(folder_ / "slick.tir");
  std::smatch number;
  ASSERT_TRUE(std::regex_search(tire, number, std::regex(R"(VERTICAL_STIFFNESS *= *[\d.eE+]+)")));
  EXPECT_NE(differs("slick.tir", number.str(), "VERTICAL_STIFFNESS = 123456"), "");
}

TEST_F(IdentityOfStudies, NotesFormattingAndUnitsDoNotCount) {
  EXPECT_EQ(differs("car.toml", "mass = \"220 kg\"", "mass   =  \"220000 g\"  # weighed"), "");
  EXPECT_EQ(differs("study.toml", "duration = \"0.1 s\"", "duration =   \"100 ms\" # short"), "");
  EXPECT_EQ(differs("study.toml", "speed = \"10 m/s\"\n", "speed = \"36 km/h\"\nline = \"0 m\"\n"),
            "");
  EXPECT_EQ(differs("study.toml", "value = \"5 kN\"", "value = \"6 kN\"\nweight = 2"), "");
  EXPECT_EQ(differs("study.toml", "model =", "title = \"another\"\nmodel ="), "");
}

TEST_F(IdentityOfStudies, WhatVariesCounts) {
  EXPECT_NE(differs("study.toml", "front.spring.stiffness", "rear.spring.stiffness"), "");
  EXPECT_NE(differs("study.toml", "[variable.spring]", "[variable.coil]"), "");
  EXPECT_NE(differs("study.toml",
                    "[experiment.push]",
                    "[tie.rear]\npath = \"rear.spring.stiffness\"\nfollows = \"spring\"\n"
                    "[experiment.push]"),
            "");
  EXPECT_EQ(differs("study.toml", "upper = \"80 N/mm\"", "upper = \"90 N/mm\""), "");
}

// Checks that a journal by an older version of the program, which described tests differently, is
// distinguished from the journal of another study.
TEST_F(IdentityOfStudies, AnOlderJournalIsRefusedInWordsAndMayBeAdopted) {
  const StudyIdentity now = read();
  StudyIdentity old = now;
  for (IdentityPart& part : old) {
    if (part.name == kTestsPart) part = {kOldTestsPart, "run: kerb speed 0 / 10 line 0 / 0 ..."};
    if (part.name == kModelPart) part.text = "# as written\n" + part.text + "\n";
  }
  const auto what = difference(old, now);
  ASSERT_TRUE(what);
  EXPECT_NE(what->find("it is older and does not contain"), std::string::npos) << *what;
  EXPECT_TRUE(is_same_but_for_versions(old, now));
  edit("car.toml", "220 kg", "221 kg");
  EXPECT_FALSE(is_same_but_for_versions(old, read()));
}

// The identity contains everything in [simulator] that an outside program's channels depend on, and
// nothing else.
TEST_F(IdentityOfStudies, EveryKeyOfAnOutsideProgramCounts) {
  write("in.txt", "{k}\n");
  write("extra.dat", "1\n");
  write("table.dat", "2\n");
  write(
      "study.toml",
      "[simulator]\ncommand = [\"program\", \"--fine\", \"{study}/table.dat\"]\n"
      "inputs = [\"in.txt\"]\nfiles = [\"extra.dat\"]\ntimeout = \"5 s\"\nkeep_failed = false\n"
      "[simulator.output.a]\nfile = \"a.csv\"\nreader = \"table\"\n"
      "quantities = [\"force [N]\"]\nsamples = 3\n"
      "[simulator.output.b]\nfile = \"b.txt\"\nreader = \"pattern\"\npattern = \"x=([0-9]+)\"\n"
      "after = \"begin\"\nquantities = [\"x [m]\"]\n"
      "[simulator.output.c]\nfile = \"c.txt\"\nreader = \"keys\"\nkeys = [\"mass\"]\n"
      "quantities = [\"m [kg]\"]\n"
      "[simulator.output.d]\nfile = \"d.txt\"\nreader = \"columns\"\ncolumns = [2]\n"
      "quantities = [\"y [m]\"]\n"
      "[variable.k]\nunit = \"N/mm\"\nlower = \"1 N/mm\"\nupper = \"9 N/mm\"\n"
      "initial = \"3 N/mm\"\n"
      "[experiment.e]\nkind = \"values\"\nchannel = \"a/force\"\nof = \"last\"\nvalue = \"5 N\"\n");
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"\"program\"", "\"other\""},
                                                        {"--fine", "--coarse"},
                                                        {"\"a.csv\"", "\"b.csv\""},
                                                        {"force [N]", "force [kN]"},
                                                        {"samples = 3", "samples = 4"},
                                                        {"x=(", "y=("},
                                                        {"begin", "end"},
                                                        {"\"mass\"", "\"weight\""},
                                                        {"columns = [2]", "columns = [3]"},
                                                        {"output.d", "output.e"},
                                                        {"unit = \"N/mm\"", "unit = \"N/m\""},
                                                        {"\"x [m]\"", "\"z [m]\""}})
    EXPECT_NE(differs("study.toml", from, to), "") << from;
  EXPECT_NE(differs("in.txt", "{k}", "2 {k}"), "");
  EXPECT_NE(differs("extra.dat", "1", "3"), "");
  EXPECT_NE(differs("table.dat", "2", "3"), "");
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"timeout = \"5 s\"", "timeout = \"9 s\""},
           {"keep_failed = false", "keep_failed = true"},
           {"value = \"5 N\"", "value = \"6 N\""},
           {"lower = \"1", "lower = \"2"},
           {"[simulator]", "# a note\n[simulator]"}})
    EXPECT_EQ(differs("study.toml", from, to), "") << from;
}

// The short spelling of an experiment with its own test gives the identity of the test that it
// abbreviates.
TEST_F(IdentityOfStudies, TheTestOfAnExperimentIsThatOfTheSameKeys) {
  std::filesystem::copy_file(
      std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/tires/comparison_225_50R16.toml",
      folder_ / "tire.toml");
  write("press.csv", "deflection [mm],force [N]\n10,1900\n20,3800\n");
  const std::string head =
      "model = \"tire.toml\"\n[variable.angle]\npath = \"layer.belt_1.angle\"\nlower = \"15 deg\"\n"
      "upper = \"30 deg\"\ninitial = \"22 deg\"\n";
  const std::string experiment =
      "[experiment.press]\nkind = \"load_deflection\"\nmeasurement = \"press.csv\"\n";
  const std::string conditions = "pressure = \"2 bar\"\nfriction = 0.5\n";
  write("study.toml", head + experiment + conditions);
  const StudyIdentity own = read();
  EXPECT_NE(differs("study.toml", "2 bar", "2.1 bar"), "");
  EXPECT_NE(differs("study.toml", "friction = 0.5", "friction = 0.6"), "");
  EXPECT_NE(differs("press.csv", "20,3800", "21,3800"), "");
  EXPECT_EQ(differs("press.csv", "20,3800", "20,3900"), "");
  write("study.toml",
        head + "[test.press]\nkind = \"load_deflection\"\ndeflections = [\"10 mm\", \"20 mm\"]\n" +
            conditions + experiment + "test = \"press\"\n");
  // An experiment and a test of one name are refused only if both have tests.
  EXPECT_FALSE(difference(own, read())) << *difference(own, read());
}

}  // namespace
}  // namespace latsch::correlation
