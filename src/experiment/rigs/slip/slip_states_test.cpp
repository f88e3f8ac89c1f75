// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/slip_states.h"

#include <gtest/gtest.h>

#include <numbers>

namespace latsch {
namespace {

using formats::CsvTable;

magic_formula::Parameters tire() {
  magic_formula::Parameters p;
  p.LONGVL = 16.0;
  p.INFLPRES = 2.4e5;
  p.FZMAX = 8000.0;
  return p;
}

TEST(SlipStates, AnyOrderAnyUnitAndSiWithoutOne) {
  const SlipStates s = slip_states(
      CsvTable::parse(
          "alpha [deg],FZ [kN],p [bar],kappa,note [mm]\n10,4,2.2,-0.1,1\n-5,3,2.0,0,2\n", "s.csv"),
      tire());
  ASSERT_EQ(s.states.size(), 2u);
  EXPECT_DOUBLE_EQ(s.states[0].alpha, 10 * std::numbers::pi / 180);
  EXPECT_EQ(s.states[0].Fz, 4000.0);
  EXPECT_EQ(s.states[0].p, 2.2e5);
  EXPECT_EQ(s.states[0].kappa, -0.1);
  EXPECT_EQ(s.states[1].Fz, 3000.0);
  EXPECT_EQ(s.states[1].Vx, 16.0);
  EXPECT_EQ(s.unused, (std::vector<std::string>{"note"}));
  const SlipStates si = slip_states(CsvTable::parse("Vx,Fz\n20,4000\n", "s.csv"), tire());
  EXPECT_EQ(si.states[0].Vx, 20.0);
  EXPECT_EQ(si.states[0].p, 2.4e5);
}

TEST(SlipStates, WrongTablesAreNamed) {
  const auto complaint = [](const char* text) -> std::string {
    try {
      slip_states(CsvTable::parse(text, "s.csv"), tire());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint("kappa\n0.1\n"),
            "s.csv:1: there is no column Fz; a table of states has Fz and any of kappa, alpha, "
            "gamma, phit, Vx, p (columns: \"kappa\")");
  EXPECT_EQ(complaint("Fz,FZ\n1,2\n"), "s.csv:1: \"FZ\" comes twice");
  EXPECT_NE(complaint("Fz [mm]\n1\n"), "");
  EXPECT_NE(complaint("Fz\nnan\n"), "");
}

// A slip angle is recognized under any name; if there is none, the ledger says that it is 0.
TEST(SlipStates, KnowTheSpellingsOfAState) {
  for (const char* header : {"FZ [N],SA [deg]",
                             "Radlast [N],Schräglaufwinkel [deg]",
                             "FZW [N],slip angle [deg]",
                             "Normal load [N],SlipAngle [deg]"}) {
    const SlipStates s =
        slip_states(CsvTable::parse(std::string(header) + "\n4000,2\n", "s.csv"), tire());
    EXPECT_EQ(s.states[0].Fz, 4000.0) << header;
    EXPECT_DOUBLE_EQ(s.states[0].alpha, 2 * std::numbers::pi / 180) << header;
    EXPECT_TRUE(s.unused.empty()) << header;
  }
}

TEST(SlipStates, AreNeverLeftOutSilently) {
  const auto complaint = [](const char* text) -> std::string {
    try {
      slip_states(CsvTable::parse(text, "s.csv"), tire());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(complaint("Fz [N],SA\n4000,2\n").find("\"SA\" has no unit"), std::string::npos);
  EXPECT_NE(complaint("Fz [N],Alhpa [deg]\n4000,2\n").find("\"Alhpa\" looks like it"),
            std::string::npos);
  EXPECT_NE(complaint("Fz [N],alpha [deg],SA [deg]\n4000,2,2\n").find("both are alpha"),
            std::string::npos);
  const Ledger ledger =
      ledger_of_states(CsvTable::parse("Fz [N],Kanal 7 [deg]\n4000,2\n", "s.csv"), "test steady");
  ASSERT_FALSE(ledger.doubts.empty());
  EXPECT_EQ(ledger.doubts[0].name, "Kanal 7");
  EXPECT_NE(ledger.doubts[0].sentence.find("alpha is taken as 0"), std::string::npos);
  EXPECT_EQ(ledger.find_taken("alpha")->state, LedgerState::assumed);
  EXPECT_EQ(ledger.find_taken("Fz")->used_by, std::vector<std::string>{"test steady"});
}

TEST(SlipStates, ColumnsWithoutAUnitAreToldWithTheUnitThatIsTaken) {
  const auto said = [](const char* text) {
    return assumed_states(CsvTable::parse(text, "s.csv"), tire());
  };
  EXPECT_NE(said("Fz,alpha,kappa [1],p [bar]\n4000,0.2,0,2\n")
                .find("; Fz, alpha are taken in N, rad, because the columns have no unit"),
            std::string::npos)
      << said("Fz,alpha,kappa [1],p [bar]\n4000,0.2,0,2\n");
  EXPECT_EQ(said("Fz [N],alpha,kappa,gamma [deg],Vx [m/s],p [bar]\n4000,0.2,0,0,10,2\n"),
            "alpha is taken in rad, because the column has no unit");
  EXPECT_EQ(said("Fz [N],alpha [deg],kappa,gamma [deg],Vx [m/s],p [bar]\n4000,1,0,0,10,2\n"), "");
}

TEST(SlipStates, HaveLoadsAboveZero) {
  const Ledger ledger =
      ledger_of_states(CsvTable::parse("Fz [N],alpha [deg]\n-4000,2\n-4000,1\n", "s.csv"), "test");
  ASSERT_EQ(ledger.doubts.size(), 1u);
  EXPECT_TRUE(ledger.doubts[0].is_error);
  EXPECT_EQ(ledger.doubts[0].place.line, 2);
}

TEST(SlipStates, OutsideOfTheRanges) {
  EXPECT_EQ(
      outside_of_ranges({{9000.0, 0, 0, 0, 0, 20.0, 2e5}, {4000.0, 0, 0, 0, 0, 20.0, 2e5}}, tire()),
      1);
}

}  // namespace
}  // namespace latsch
