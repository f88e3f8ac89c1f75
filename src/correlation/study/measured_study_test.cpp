// SPDX-License-Identifier: Apache-2.0
// Studies whose experiments and tests use recordings of a laboratory, [measurement.NAME].
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "correlation/observable/force_curve.h"
#include "correlation/study/ledgers/study_ledgers.h"
#include "correlation/study/spring_testing.h"
#include "correlation/study/study.h"
#include "correlation/study/variables.h"
#include "correlation/target/residuals.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/twin.h"
#include "experiment/kinds/sparse_tir_testing.h"
#include "formats/tables/csv_table.h"

namespace latsch::correlation {
namespace {

// The record has SAE signs, so loads are negative; the last row is warm-up.
constexpr const char* kRecord =
    "t_s,SA [deg],FZ [N],FY [N],SL,who\n"
    "0,-4,-4000,3100,0,ann\n"
    "1,4,-4000,-3000,,ann\n"
    "2,-2,-2000,1000,0,bob\n"
    "99,-3,-2000,1500,0,bob\n";
constexpr const char* kMeasuredStudy = R"(
model = "tire.tir"
[measurement.cornering]
file = "record.csv"
axes = "sae"
columns = {time = "t_s [s]"}
[measurement.cornering.select]
time = ".. 10 s"
[measurement.cornering.noise]
Fy = "20 N"
[test.steady]
kind = "steady_states"
states = {from = "measurement.cornering"}
[variable.grip]
path = "PDY1"
lower = 0.5
upper = 2
initial = 1
[experiment.side_force]
kind = "curve"
y = "steady/Fy"
measurement = "cornering"
)";

class MeasuredStudy : public testing::Test {
 protected:
  MeasuredStudy() {
    write_text_file(folder_ / "tire.tir", experiment::sparse_tir(experiment::kSideForce));
    write_text_file(folder_ / "record.csv", kRecord);
  }
  Study read(std::string from = "", const std::string& to = "") {
    std::string text = kMeasuredStudy;
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    write_text_file(folder_ / "study.toml", text);
    return read_study(folder_ / "study.toml", experiment::language());
  }
  void edit_record(const std::string& from, const std::string& to) {
    std::string text = kRecord;
    text.replace(text.find(from), from.size(), to);
    write_text_file(folder_ / "record.csv", text);
  }
  template <class Action>
  std::string complaint(Action action) {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  }

  ScratchFolder folder_;
};

// These states and forces are the measured ones, converted by hand into Latsch's axes and stored in
// separate files. Both studies must give equal results.
TEST_F(MeasuredStudy, IsTheStudyOfTheSameNumbersInFiles) {
  const Study measured = read();
  write_text_file(folder_ / "states.csv", "Fz [N],alpha [deg]\n4000,4\n4000,-4\n2000,2\n");
  write_text_file(folder_ / "forces.csv", "Fy [N]\n-3100\n3000\n-1000\n");
  write_text_file(folder_ / "steady.toml", "kind = \"steady_states\"\nstates = \"states.csv\"\n");
  write_text_file(folder_ / "plain.toml", R"(
model = "tire.tir"
[test.steady]
file = "steady.toml"
[variable.grip]
path = "PDY1"
lower = 0.5
upper = 2
initial = 1
[experiment.side_force]
kind = "curve"
y = "steady/Fy"
measurement = "forces.csv"
noise = "20 N"
)");
  const Study plain = read_study(folder_ / "plain.toml", experiment::language());
  const auto one = objective(measured)(*evaluator(measured)(measured.space.initial()));
  const auto other = objective(plain)(*evaluator(plain)(plain.space.initial()));
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->value, other->value);
  EXPECT_EQ(one->residuals, other->residuals);  // weighted by the noise the measurement states
}

TEST_F(MeasuredStudy, AJournalDependsOnMeasuredConditionsNotOnMeasuredForces) {
  const StudyIdentity before = identity(read());
  edit_record("3100", "3123");
  EXPECT_FALSE(difference(before, identity(read())));
  edit_record("99,-3", "98,-5");  // left out
  EXPECT_FALSE(difference(before, identity(read())));
  edit_record("-2000,1000", "-2001,1000");
  EXPECT_TRUE(difference(before, identity(read())));
}

TEST_F(MeasuredStudy, ANoiseOfItsOwnHasPrecedence) {
  const Study study =
      read("measurement = \"cornering\"\n", "measurement = \"cornering\"\nnoise = \"5 %\"\n");
  EXPECT_EQ(study.experiments[0].noise, (MeasurementNoise{0.05, 0.0}));
  EXPECT_EQ(read().experiments[0].noise, (MeasurementNoise{0.0, 20.0}));
}

TEST_F(MeasuredStudy, ATestInAFileOfItsOwnTakesItsStatesToo) {
  write_text_file(folder_ / "steady.toml",
                  "kind = \"steady_states\"\nstates = {from = \"measurement.cornering\"}\n");
  const std::string test =
      "kind = \"steady_states\"\nstates = {from = \"measurement.cornering\"}\n";
  const StudyIdentity before = identity(read(test, "file = \"steady.toml\"\n"));
  edit_record("3100", "3123");
  EXPECT_FALSE(difference(before, identity(read(test, "file = \"steady.toml\"\n"))));
  edit_record("-2000,1000", "-2001,1000");
  EXPECT_TRUE(difference(before, identity(read(test, "file = \"steady.toml\"\n"))));
}

// A journal depends on measured deflections, not on measured forces: corrected forces leave every
// trial valid, corrected deflections do not, whether the test is stated in the study or in a file.
TEST_F(MeasuredStudy, AJournalDependsOnMeasuredDeflectionsNotOnTheForcesBesideThem) {
  const std::string test =
      "kind = \"load_deflection\"\ndeflections = {from = \"measurement.press\"}\n";
  write_text_file(folder_ / "pressed.toml", test);
  for (const std::string& keys : {test, std::string("file = \"pressed.toml\"\n")}) {
    const auto with = [&](const std::string& rows) {
      write_text_file(folder_ / "press.csv", "deflection [mm],Fz [N]\n" + rows);
      write_text_file(folder_ / "press_study.toml",
                      "model = \"tire.tir\"\n[measurement.press]\nfile = \"press.csv\"\n"
                      "[test.pressed]\n" +
                          keys +
                          "[variable.stiffness]\npath = \"VERTICAL_STIFFNESS\"\n"
                          "lower = \"100 N/mm\"\nupper = \"300 N/mm\"\ninitial = \"190 N/mm\"\n"
                          "[experiment.force]\nkind = \"load_deflection\"\ntest = \"pressed\"\n"
                          "measurement = \"press\"\n");
      return read_study(folder_ / "press_study.toml", experiment::language());
    };
    const Study study = with("10,1900\n20,3800\n");
    const auto found = objective(study)(*evaluator(study)(study.space.initial()));
    ASSERT_TRUE(found) << found.failure().reason;
    EXPECT_NEAR(found->value, 0.0, 1e-9);  // 190 N/mm at 10 and 20 mm, as measured
    EXPECT_FALSE(difference(identity(study), identity(with("10,1950\n20,3700\n"))));
    EXPECT_TRUE(difference(identity(study), identity(with("10,1900\n21,3800\n"))));
    EXPECT_TRUE(difference(identity(study), identity(with("10,1900\n20,3800\n21,3990\n"))));
  }
}

TEST_F(MeasuredStudy, ATwinKeepsTheFilesColumnsUnitsAndSigns) {
  const std::string selection = "[measurement.cornering.select]\ntime = \".. 10 s\"\n";
  const Study study = read(selection, "");
  ASSERT_TRUE(write_twin(study));
  const auto table = formats::CsvTable::read(folder_ / "record.csv");
  EXPECT_EQ(table.columns(), (std::vector<std::string>{"t_s", "SA", "FZ", "FY", "SL", "who"}));
  EXPECT_EQ(table.texts("who"), (std::vector<std::string>{"ann", "ann", "bob", "bob"}));
  EXPECT_EQ(table.numbers("FZ", "N"), (std::vector<double>{-4000, -4000, -2000, -2000}));
  EXPECT_GT(table.numbers("FY", "N")[0], 1000.0);  // opposes the slip angle, as before
  EXPECT_LT(table.numbers("FY", "N")[1], -1000.0);
  const Study again = read(selection, "");
  EXPECT_FALSE(difference(identity(study), identity(again)));
  const auto found = objective(again)(*evaluator(again)(DesignPoint{{again.model.get("PDY1")}}));
  ASSERT_TRUE(found) << found.failure().reason;
  EXPECT_EQ(found->value, 0.0);
}

TEST_F(MeasuredStudy, ATwinRefusesWhatItCannotUndo) {
  const Study study = read();
  const std::string found = complaint([&] { (void)write_twin(study); });
  EXPECT_NE(found.find("study.toml:3: measurement.cornering cannot be written by a twin: it has "
                       "\"select\", which cannot be undone"),
            std::string::npos)
      << found;
  EXPECT_EQ(read_text_file(folder_ / "record.csv"), kRecord);
}

TEST_F(MeasuredStudy, SaysWhatAStudyNamesThatIsNotThere) {
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& part) {
    const std::string found = complaint([&] { read(from, to); });
    EXPECT_NE(found.find(part), std::string::npos) << found;
  };
  expect("measurement = \"cornering\"\n",
         "measurement = \"corner\"\n",
         "neither a file nor a [measurement.NAME], did you mean \"cornering\"?");
  expect("from = \"measurement.cornering\"",
         "from = \"measurement.cornring\"",
         "did you mean \"measurement.cornering\"?");
  expect("columns = {time = \"t_s [s]\"}",
         "columns = {time = \"t_s [s]\", Fz = \"SL\"}",
         "column \"SL\" has no unit, expected a force, such as "
         "columns = {Fz = \"SL [N]\", time = \"t_s [s]\"} in [measurement.cornering]");
  expect("columns = {time = \"t_s [s]\"}",
         "columns = {time = \"t_s [s]\", kappa = \"SL\"}",
         "record.csv:3: measurement.cornering: kappa is no finite number here, the first of 1 gaps "
         "in 3 samples");
  expect("y = \"steady/Fy\"", "y = \"steady/Mz\"", "column \"Mz\" is missing");
  expect("[measurement.cornering]\n",
         "[measurement.cornering]\nfiler = \"x\"\n",
         "unknown key \"measurement.cornering.filer\", did you mean \"file\"?");
  expect("[measurement.cornering]", "[measurment.cornering]", "did you mean \"measurement\"?");
}

TEST_F(MeasuredStudy, ATestOfAStudyAloneIsRefusedElsewhere) {
  write_text_file(folder_ / "steady.toml",
                  "kind = \"steady_states\"\nstates = {from = \"measurement.cornering\"}\n");
  const std::string found =
      complaint([&] { experiment::language().read_test(folder_ / "steady.toml"); });
  EXPECT_NE(found.find("which only a test of a study can name"), std::string::npos) << found;
}

// The spring has a stiffness of 20 N/mm and, when it is pulled slowly, no damping force.
TEST_F(MeasuredStudy, ValuesMayBeMeasuredToo) {
  write_text_file(folder_ / "spring.toml",
                  "kind = \"spring\"\nstiffness = \"20 N/mm\"\ndamping = \"0 N s/m\"\n");
  write_text_file(folder_ / "pulled.csv", "force [kN]\n0.04\n0.1\n");
  write_text_file(folder_ / "springs.toml", R"(
model = "spring.toml"
[test.pull]
kind = "pull"
speed = "0 m/s"
travels = ["2 mm", "5 mm"]
[variable.stiffness]
path = "stiffness"
lower = "5 N/mm"
upper = "60 N/mm"
initial = "20 N/mm"
[experiment.forces]
kind = "values"
channel = "pull/force"
measurement = "pulled.csv"
)");
  const Study study = read_study(folder_ / "springs.toml", experiment::spring_language());
  EXPECT_EQ(study.experiments[0].values(), 2u);
  const auto found = objective(study)(*evaluator(study)(study.space.initial()));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 0.0, 1e-12);
  write_text_file(folder_ / "pulled.csv", "force [kN]\n7\n8\n");
  ASSERT_TRUE(write_twin(study));
  EXPECT_EQ(formats::CsvTable::read(folder_ / "pulled.csv").texts("force"),
            (std::vector<std::string>{"0.04", "0.1"}));
}

// If two tests write the same column of a file, the second overwrites the first, so a twin refuses
// it.
TEST_F(MeasuredStudy, ATwinRefusesAColumnThatTwoTestsFill) {
  write_text_file(folder_ / "spring.toml",
                  "kind = \"spring\"\nstiffness = \"20 N/mm\"\ndamping = \"5 N s/m\"\n");
  const std::string pulled = "force [kN]\n0.04\n0.1\n";
  const auto with = [&](const std::string& speed) {
    write_text_file(folder_ / "pulled.csv", pulled);
    std::string text =
        "model = \"spring.toml\"\n[variable.stiffness]\npath = \"stiffness\"\n"
        "lower = \"5 N/mm\"\nupper = \"60 N/mm\"\ninitial = \"20 N/mm\"\n";
    for (const auto& [name, v] : {std::pair{"slow", std::string("0 m/s")}, {"fast", speed}}) {
      text += fmt::format(
          "[test.{0}]\nkind = \"pull\"\nspeed = \"{1}\"\ntravels = [\"2 mm\", \"5 mm\"]\n"
          "[experiment.{0}]\nkind = \"values\"\nchannel = \"{0}/force\"\n"
          "measurement = \"pulled.csv\"\n",
          name,
          v);
    }
    write_text_file(folder_ / "springs.toml", text);
    return read_study(folder_ / "springs.toml", experiment::spring_language());
  };
  const Study study = with("1 m/s");
  const std::string found = complaint([&] { (void)write_twin(study); });
  EXPECT_NE(found.find("experiments slow and fast are both measured in"), std::string::npos)
      << found;
  EXPECT_NE(found.find("slow/force and fast/force differ"), std::string::npos) << found;
  EXPECT_EQ(read_text_file(folder_ / "pulled.csv"), pulled);
  EXPECT_TRUE(write_twin(with("0 m/s")));  // equal values written twice lose nothing
}

// The rig's table has other column names, and several pressures of which one is selected for the
// force curve.
TEST_F(MeasuredStudy, AForceCurveIsSelectedFromATableOfMany) {
  write_text_file(folder_ / "tire.toml", "");
  write_text_file(folder_ / "radii.csv",
                  "p_kPa,Fz_N,R_mm\n69,500,202.4\n83,500,203.5\n83,1000,200.6\n");
  write_text_file(folder_ / "one.toml", R"(
[measurement.radii]
file = "radii.csv"
columns = {p = "p_kPa [kPa]", Fz = "Fz_N [N]", loaded_radius = "R_mm [mm]"}
select = {p = "83 +- 1 kPa"}
)");
  const Laboratory laboratory =
      read_laboratory(Document::read(folder_ / "one.toml").root(), folder_.path());
  const LoadDeflectionCurve curve = force_curve_of(*laboratory[0]);
  EXPECT_EQ(curve.abscissa, Abscissa::loaded_radius);
  EXPECT_EQ(curve.force, (std::vector<double>{500.0, 1000.0}));
  EXPECT_NEAR(curve.position[1], 0.2006, 1e-15);
}

/// Returns the row of a column in the ledger of the record.
LedgerRow ledger_row_of(const Study& study, const std::string& column) {
  for (const Ledger& ledger : ledgers_of(study))
    if (const LedgerRow* row = ledger.find_written(column)) return *row;
  return {};
}

TEST_F(MeasuredStudy, HasALedgerOfWhatItsColumnsWereTakenFor) {
  const Study study = read();
  const LedgerRow alpha = ledger_row_of(study, "SA");
  EXPECT_EQ(alpha.taken_as, "alpha");
  EXPECT_EQ(alpha.unit_written, "deg");
  EXPECT_EQ(alpha.unit, "rad");
  EXPECT_NEAR(alpha.factor, 0.017453292519943295, 1e-18);
  EXPECT_EQ(alpha.axes, "sae, -1");
  EXPECT_EQ(alpha.line, 1);
  EXPECT_EQ(alpha.used_by, std::vector<std::string>{"test steady"});
  EXPECT_EQ(ledger_row_of(study, "FY").used_by, std::vector<std::string>{"experiment side_force"});
  EXPECT_EQ(ledger_row_of(study, "t_s").used_by, std::vector<std::string>{"select"});
  EXPECT_EQ(ledger_row_of(study, "SL").state, LedgerState::not_used);
  const std::string line = in_one_line(ledgers_of(study).front());
  EXPECT_NE(line.find("4 used"), std::string::npos) << line;
  EXPECT_NE(line.find("`SL`"), std::string::npos) << line;
  EXPECT_NE(line.find("kappa is taken as 0 by test steady"), std::string::npos) << line;
}

TEST_F(MeasuredStudy, TakesASlipAngleByAnySpelling) {
  const auto expected = read().tests.front().identity;
  for (const char* name : {"Slip Angle [deg]",
                           "Schräglaufwinkel [deg]",
                           "alpha [deg]",
                           "ALPHA [deg]",
                           "slip_angle [deg]",
                           "SlipAngle [deg]"}) {
    edit_record("SA [deg]", name);
    EXPECT_EQ(read().tests.front().identity, expected) << name;
  }
}

TEST_F(MeasuredStudy, NeverLeavesOutASlipAngleSilently) {
  edit_record("SA [deg]", "SA");
  std::string found = complaint([&] { read(); });
  EXPECT_NE(found.find("\"SA\""), std::string::npos) << found;
  EXPECT_NE(found.find("unit"), std::string::npos) << found;
  edit_record("SA [deg]", "Alhpa [deg]");  // looks like the missing channel
  found = complaint([&] { read(); });
  EXPECT_NE(found.find("columns = {alpha = \"Alhpa\", time = \"t_s [s]\"}"), std::string::npos)
      << found;
  EXPECT_NE(found.find("without = [\"alpha\"]"), std::string::npos) << found;
  const std::string from = "{from = \"measurement.cornering\"}";
  EXPECT_EQ(
      complaint([&] { read(from, "{from = \"measurement.cornering\", without = [\"alpha\"]}"); }),
      "nothing");
  found = complaint([&] { read(from, "{from = \"measurement.cornering\", without = [\"Fz\"]}"); });
  EXPECT_NE(found.find("without"), std::string::npos) << found;
  // this name is not similar to that of any channel, so it only causes a warning
  edit_record("SA [deg]", "channel 7 [deg]");
  const Study study = read();
  const auto doubts = ledgers_of(study).front().doubts;
  EXPECT_TRUE(std::any_of(doubts.begin(), doubts.end(), [](const LedgerDoubt& doubt) {
    return doubt.name == "channel 7" && !doubt.is_error &&
           doubt.sentence.find("alpha is taken as 0") != std::string::npos;
  }));
}

// No axes are stated, and every load is negative.
TEST_F(MeasuredStudy, RefusesLoadsBelowZeroWithTheWayOut) {
  const std::string found = complaint([&] { read("axes = \"sae\"\n", ""); });
  EXPECT_NE(found.find("\"FZ\""), std::string::npos) << found;
  EXPECT_NE(found.find("axes = \"sae\""), std::string::npos) << found;
}

TEST_F(MeasuredStudy, WarnsOfASideForceOfTheOtherSign) {
  std::string text = kRecord;
  write_text_file(folder_ / "record.csv",
                  "t_s,SA [deg],FZ [N],FY [N],SL,who\n0,4,4000,3100,0,ann\n"
                  "1,-4,4000,-3000,,ann\n2,2,2000,1000,0,bob\n");
  const Study study = read("axes = \"sae\"\n", "");
  const auto doubts = ledgers_of(study).front().doubts;
  EXPECT_TRUE(std::any_of(doubts.begin(), doubts.end(), [](const LedgerDoubt& doubt) {
    return doubt.name == "FY" && !doubt.is_error;
  }));
}

TEST_F(MeasuredStudy, RefusesTwoColumnsForOneChannelByBothNames) {
  edit_record(",SL,who", ",Slip angle [deg],who");
  std::string found = complaint([&] { read(); });
  EXPECT_NE(found.find("\"SA\" and \"Slip angle\""), std::string::npos) << found;
  EXPECT_EQ(complaint([&] {
              read("columns = {time = \"t_s [s]\"}",
                   "columns = {time = \"t_s [s]\", alpha = \"SA\"}");
            }),
            "nothing");
}

}  // namespace
}  // namespace latsch::correlation
