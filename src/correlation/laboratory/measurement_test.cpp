// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/measurement.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/file.h"
#include "base/scratch_folder_testing.h"

namespace latsch::correlation {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// The rig uses SAE axes at 10 Hz: loads are negative, and the side force opposes the slip angle
// with 100 N per degree.
constexpr const char* kRun =
    "Tire 1\tRun 4\n"
    "ET\tSA\tIA\tP\tFY\tFZ\tMZ\tTSTC\n"
    "sec\tdeg\tdeg\tkPa\tN\tN\tN-m\tdeg C\n"
    "0.0\t-2\t0\t80\t205\t-1000\t-4\t40\n"
    "0.1\t-1\t0\t80\t105\t-1010\t-2\t45\n"
    "0.2\t0\t0.1\t80\t5\t-1020\t0\t50\n"
    "0.3\t1\t0\t81\t-95\t-1500\t2\t55\n"
    "0.4\t2\t2\t81\t-195\t-1510\t4\t60\n"
    "0.5\t1\t2\t81\t-95\t-1490\t2\tNaN\n"
    "0.6\t0\t2\t97\t5\t-1500\t0\t65\n"
    "0.7\t-1\t2\t97\t105\t-1000\t-2\t65\n";

class LabMeasurement : public testing::Test {
 protected:
  LabMeasurement() { write_text_file(folder_ / "run.dat", kRun); }
  /// Reads a table [measurement.run] with these additional lines.
  Measurement read(const std::string& lines) {
    write_text_file(folder_ / "study.toml", "[measurement.run]\nfile = \"run.dat\"\n" + lines);
    const Document document = Document::read(folder_ / "study.toml");
    const Laboratory laboratory = read_laboratory(document.root(), folder_.path());
    document.root();
    return *find(laboratory, "run");
  }
  std::string complaint(const std::string& lines) {
    try {
      read(lines);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  }
  /// Expects that a complaint contains each of these parts.
  void expect_complaint(const std::string& lines, const std::vector<std::string>& parts) {
    const std::string found = complaint(lines);
    for (const std::string& part : parts) EXPECT_NE(found.find(part), std::string::npos) << found;
  }

  ScratchFolder folder_;
};

TEST_F(LabMeasurement, HasOurNamesAxesAndUnits) {
  const Measurement run = read("axes = \"sae\"\n");
  EXPECT_EQ(run.samples(), 8u);
  // in SAE axes y, and therefore alpha, has the opposite sign
  EXPECT_NEAR(run.values("alpha", "rad")[0], 2 * kDegree, 1e-15);
  EXPECT_EQ(run.values("Fy", "N")[0], -205.0);
  EXPECT_EQ(run.values("Fz", "N")[3], 1500.0);
  EXPECT_EQ(run.values("Mz", "N m")[0], 4.0);
  EXPECT_NEAR(run.values("gamma", "rad")[4], 2 * kDegree, 1e-15);
  EXPECT_EQ(run.values("p", "Pa")[7], 97e3);
  EXPECT_EQ(run.values("time", "s")[1], 0.1);
  const Measurement as_written = read("");
  EXPECT_EQ(as_written.values("Fy", "N")[0], 205.0);
}

TEST_F(LabMeasurement, SelectsByWindowsOfSeveralChannels) {
  const Measurement run = read(
      "axes = \"sae\"\n[measurement.run.select]\nFz = \"900 .. 1100 N\"\n"
      "p = [\"80 +- 0.5 kPa\", \"90 kPa ..\"]\ngamma = \"0 +- 0.05 deg\"\n");
  EXPECT_EQ(run.values("time", "s"), (std::vector<double>{0.0, 0.1}));
  const auto& words = run.words();
  const auto says = [&](const std::string& part) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& line) {
      return line.find(part) != line.npos;
    });
  };
  EXPECT_TRUE(says("run.dat: 8 samples of 8 channels"));
  EXPECT_TRUE(says("Fz 900 .. 1100 N: 4 of 8 samples"));
  EXPECT_TRUE(says("p 80 +- 0.5 kPa or 90 kPa ..: 4 of 4 samples"));
  EXPECT_TRUE(says("gamma 0 +- 0.05 deg: 2 of 4 samples"));
  EXPECT_TRUE(says("Fz from 1000 to 1010 N"));
}

TEST_F(LabMeasurement, AGapIsOutsideOfEveryWindow) {
  const Measurement run = read("[measurement.run.select]\ntread_center = \"50 degC .. 70 degC\"\n");
  EXPECT_EQ(run.values("time", "s"), (std::vector<double>{0.2, 0.3, 0.4, 0.6, 0.7}));
}

TEST_F(LabMeasurement, TellsTheWaysOfASweepApart) {
  EXPECT_EQ(read("sweep = {alpha = \"falling\"}\n").values("time", "s"),
            (std::vector<double>{0.4, 0.5, 0.6, 0.7}));
  EXPECT_EQ(read("sweep = {alpha = \"rising\"}\nevery = 3\n").values("time", "s"),
            (std::vector<double>{0.0, 0.3}));
}

TEST_F(LabMeasurement, IsZeroedAndShifted) {
  const Measurement run =
      read("zero = {channels = [\"Fy\"], time = \"0.15 s .. 0.25 s\"}\nshift = \"-100 ms\"\n");
  EXPECT_EQ(run.values("Fy", "N")[2], 0.0);
  EXPECT_EQ(run.values("Fy", "N")[0], 200.0);
  EXPECT_EQ(run.values("Mz", "N m")[0], -4.0);
  EXPECT_NEAR(run.values("time", "s")[1], 0.0, 1e-15);
  EXPECT_EQ(run.recorded()["Fy"][0], 205.0);
}

TEST_F(LabMeasurement, AZeroThatIsNoOffsetIsDoubted) {
  const auto doubts = [&](const std::string& keys) {
    std::string all;
    const std::vector<Ledger> ledgers = read(keys).ledgers();
    for (const LedgerDoubt& doubt : ledgers.front().doubts) all += doubt.sentence;
    return all;
  };
  EXPECT_NE(doubts("zero = {channels = [\"p\"], time = \"0 s .. 10 s\"}\n").find("zero takes"),
            std::string::npos);
  EXPECT_NE(doubts("zero = {channels = [\"Mz\"], time = \"0 s .. 0.01 s\"}\n").find("zero takes"),
            std::string::npos);
  EXPECT_EQ(doubts("").find("zero takes"), std::string::npos);
}

// A sine at the frequency of the filter comes out at half its height (twice 3 dB), in phase; a sine
// far below is unchanged; a sine of 100 Hz is damped as by order 2. [Butterworth: |H|^2 = 1/2 at
// the edge; forward and backward filtering squares it]
TEST_F(LabMeasurement, IsFilteredWithoutDelay) {
  std::string text = "time [s],Fy [N],Fz [N],Fx [N],who [N]\n";
  for (int i = 0; i < 2000; ++i) {
    const double t = 1e-3 * i;
    text += fmt::format("{},{},{},{},\n",
                        t,
                        std::sin(2 * std::numbers::pi * 50 * t),
                        std::sin(2 * std::numbers::pi * 2 * t),
                        std::sin(2 * std::numbers::pi * 100 * t));
  }
  write_text_file(folder_ / "run.csv", text);
  const Measurement run = [&] {
    write_text_file(folder_ / "study.toml",
                    "[measurement.run]\nfile = \"run.csv\"\nlow_pass = \"50 Hz\"\n");
    return *find(read_laboratory(Document::read(folder_ / "study.toml").root(), folder_.path()),
                 "run");
  }();
  const auto& Fy = run.values("Fy", "N");
  const auto& Fz = run.values("Fz", "N");
  const auto& Fx = run.values("Fx", "N");
  // The bilinear transform changes the frequencies, so |H|^2 = 1 / (1 + w^4) holds at the changed
  // frequencies.
  const double beyond =
      1.0 /
      (1.0 + std::pow(std::tan(0.1 * std::numbers::pi) / std::tan(0.05 * std::numbers::pi), 4));
  for (int i = 500; i < 1500; ++i) {
    const double t = 1e-3 * i;
    ASSERT_NEAR(Fy[i], 0.5 * std::sin(2 * std::numbers::pi * 50 * t), 1e-6);
    ASSERT_NEAR(Fz[i], std::sin(2 * std::numbers::pi * 2 * t), 1e-5);
    ASSERT_NEAR(Fx[i], beyond * std::sin(2 * std::numbers::pi * 100 * t), 1e-6);
  }
}

TEST_F(LabMeasurement, JoinsFilesAndLeavesOutWhatOneLacks) {
  write_text_file(folder_ / "more.csv", "ET [s],FY [kN],FZ [N]\n0.1,1,-5\n0.2,2,-6\n");
  write_text_file(folder_ / "study.toml",
                  "[measurement.both]\nfiles = [\"run.dat\", \"more.csv\"]\n");
  const Measurement both =
      *find(read_laboratory(Document::read(folder_ / "study.toml").root(), folder_.path()), "both");
  EXPECT_EQ(both.samples(), 10u);
  EXPECT_EQ(both.values("Fy", "N")[9], 2000.0);
  EXPECT_FALSE(both.has("alpha"));
  try {
    both.values("alpha", "rad");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"alpha\" is not in more.csv"), std::string::npos)
        << error.what();
  }
}

TEST_F(LabMeasurement, TakesColumnsByTheNamesOfTheFile) {
  write_text_file(folder_ / "odd.csv", "slip_deg,load,SA [deg]\n1,2,3\n");
  write_text_file(
      folder_ / "study.toml",
      "[measurement.odd]\nfile = \"odd.csv\"\ncolumns = {alpha = \"slip_deg [deg]\", Fz "
      "= \"load [kN]\"}\n");
  const Document document = Document::read(folder_ / "study.toml");
  const Measurement odd = *find(read_laboratory(document.root(), folder_.path()), "odd");
  EXPECT_NEAR(odd.values("alpha", "rad")[0], kDegree, 1e-15);
  EXPECT_EQ(odd.values("Fz", "N")[0], 2000.0);
  EXPECT_NEAR(odd.values("SA", "rad")[0], 3 * kDegree, 1e-15);
}

TEST_F(LabMeasurement, SaysWhatIsWrongWithANeededChannel) {
  const Measurement run = read("axes = \"sae\"\n");
  const auto said = [&](const std::string& channel, const std::string& unit) {
    try {
      run.values(channel, unit);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(said("Fzz", "N").find("did you mean \"Fz\"?"), std::string::npos) << said("Fzz", "N");
  EXPECT_NE(said("Fz", "m").find("\"FZ\" is in \"N\", expected a length"), std::string::npos);
  const std::string gap = said("tread_center", "K");
  EXPECT_NE(gap.find("run.dat:9: "), std::string::npos) << gap;
  EXPECT_NE(gap.find("the first of 1 gaps in 8 samples"), std::string::npos) << gap;
}

TEST_F(LabMeasurement, RefusesSignsThatContradictItsAxes) {
  expect_complaint("axes = \"iso\"\n", {"study.toml:3", "measurement.run.axes", "as in \"sae\""});
  expect_complaint("axes = \"adapted_sae\"\n", {"as in \"sae\""});
  std::string positive = kRun;
  for (std::size_t at; (at = positive.find("-1")) != positive.npos;)
    if (positive[at + 2] == '\t')
      positive.replace(at, 3, "-9\t");  // alpha stays unchanged
    else
      positive.replace(at, 2, "1");
  write_text_file(folder_ / "run.dat", positive);
  expect_complaint(
      "axes = \"sae\"\n",
      {"is \"sae\"", "Fz goes from 1000 to 1510 N", "a load has to be negative", "as in \"iso\""});
}

TEST_F(LabMeasurement, RefusesWhatLeavesNothing) {
  expect_complaint(
      "axes = \"sae\"\n[measurement.run.select]\nFz = \"900 .. 1100 N\"\n"
      "gamma = \"5 +- 1 deg\"\n",
      {"study.toml:6: measurement.run.select.gamma",
       "none of 4 samples",
       "gamma goes from 0 to 2 deg",
       "Fz 900 .. 1100 N: 4 of 8"});
}

TEST_F(LabMeasurement, RefusesWhatItDoesNotUnderstand) {
  expect_complaint("columns = {Fz = \"LOAD\"}\n", {"\"LOAD\" is missing", "columns: "});
  expect_complaint("[measurement.run.select]\nFzz = \"1 .. 2 N\"\n", {"did you mean \"Fz\"?"});
  expect_complaint("[measurement.run.select]\nFz = \"1 .. 2 mm\"\n", {"expected a window in N"});
  expect_complaint("[measurement.run.select]\nFz = \"a lot\"\n", {"expected a window such as"});
  expect_complaint("[measurement.run.select]\nFz = \"3 .. 2 N\"\n", {"lower end first"});
  expect_complaint("[measurement.run.select]\nFz = 5\n", {"select.Fz is not a window such as"});
  expect_complaint("sweep = {alpha = \"up\"}\n", {"\"rising\" or \"falling\""});
  expect_complaint("axes = \"SAE\"\n", {"did you mean \"sae\"?"});
  expect_complaint("low_pass = \"5 Hz\"\n", {"has to be below 5 Hz"});
  expect_complaint("zero = {channels = [\"Fy\"], time = \"3 s ..\"}\n",
                   {"holds no sample", "from 0 to 0.7 s"});
  expect_complaint("[measurement.run.noise]\nFy = \"2 mm\"\n", {"noise.Fy", "is in N"});
  expect_complaint("files = [\"a.csv\"]\n", {"one of the two"});
  write_text_file(folder_ / "study.toml", "[measurement.run]\nfile = \"gone.csv\"\n");
}

const std::filesystem::path kSharedData = LATSCH_SOURCE_DIR "/../shared/data";

// The expected numbers were counted by an independent script of ten lines.
TEST_F(LabMeasurement, OfARealRunIsWhatAScriptCounts) {
  const auto file = kSharedData / "measured/ttc_hoosier_43075_cornering_10Hz.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file << " beside the project";
  std::filesystem::copy_file(file, folder_ / "run.csv");
  const auto of = [&](const std::string& lines) {
    write_text_file(folder_ / "real.toml", R"([measurement.run]
file = "run.csv"
axes = "iso"
)" + lines + R"(
[measurement.run.columns]
time = "t_s [s]"
alpha = "SA_deg [deg]"
gamma = "IA_deg [deg]"
p = "P_kPa [kPa]"
Fy = "FY_N [N]"
Fz = "FZ_N_positive [N]"
)");
    return *find(read_laboratory(Document::read(folder_ / "real.toml").root(), folder_.path()),
                 "run");
  };
  EXPECT_EQ(of("").samples(), 5996u);
  const Measurement run =
      of("[measurement.run.select]\nFz = \"950 .. 1150 N\"\n"
         "p = \"83 +- 3 kPa\"\ngamma = \"0 +- 0.3 deg\"\n");
  EXPECT_EQ(run.samples(), 120u);
  const auto& Fy = run.values("Fy", "N");
  EXPECT_EQ(*std::min_element(Fy.begin(), Fy.end()), -1421.32);
  EXPECT_EQ(*std::max_element(Fy.begin(), Fy.end()), 1304.1);
  const auto rising = of("sweep = {alpha = \"rising\"}\n").samples(),
             falling = of("sweep = {alpha = \"falling\"}\n").samples();
  EXPECT_NEAR(static_cast<double>(rising + falling), 5996.0, 0.02 * 5996.0);
  EXPECT_EQ(of("").values("Mx", "N m").size(), 5996u);  // the name MX_Nm ends in its unit
  std::string sae = read_text_file(folder_ / "real.toml");
  sae.replace(sae.find("\"iso\""), 5, "\"sae\"");
  write_text_file(folder_ / "real.toml", sae);
  EXPECT_THROW(read_laboratory(Document::read(folder_ / "real.toml").root(), folder_.path()),
               InputError);
}

TEST_F(LabMeasurement, OfTydexSweepsKnowsItsNames) {
  const auto files = kSharedData / "tdx";
  if (!std::filesystem::exists(files)) GTEST_SKIP() << "no " << files << " beside the project";
  for (const char* name : {"ttc_SA_sweep_P69_IA0_FZ1050.tdx", "ttc_SA_sweep_P83_IA0_FZ1610.tdx"})
    std::filesystem::copy_file(files / name, folder_ / name);
  write_text_file(folder_ / "real.toml", R"([measurement.run]
files = ["ttc_SA_sweep_P69_IA0_FZ1050.tdx", "ttc_SA_sweep_P83_IA0_FZ1610.tdx"]
axes = "iso"
select = {Fz = ".. 1300 N", alpha = "-4 .. 4 deg"}
)");
  const Measurement run =
      *find(read_laboratory(Document::read(folder_ / "real.toml").root(), folder_.path()), "run");
  EXPECT_EQ(run.frame("Fy"), "W");
  EXPECT_EQ(run.samples(), 500u);
  EXPECT_NEAR(run.values("loaded_radius", "m")[0], 0.1991, 0.005);
  EXPECT_NEAR(run.values("p", "Pa")[0], 69e3, 3e3);
}

// A name may end in the unit that no header states.
TEST_F(LabMeasurement, TakesAUnitFromTheEndOfAName) {
  write_text_file(folder_ / "run.csv", "SA_deg,P_kPa,FZ_N,V_kmh,who_deg\n2,80,1000,36,1\n");
  const Measurement run = read_measurement(folder_ / "run.csv");
  EXPECT_NEAR(run.values("alpha", "rad")[0], 2 * kDegree, 1e-15);
  EXPECT_EQ(run.values("p", "Pa")[0], 80e3);
  EXPECT_EQ(run.values("Fz", "N")[0], 1000.0);
  EXPECT_NEAR(run.values("Vx", "m/s")[0], 10.0, 1e-14);
  EXPECT_EQ(run.unit("who_deg"), "1");  // the unit of an unknown name is not interpreted
}

// A unit of another dimension contradicts a name of one letter: t in mm is a trail.
TEST_F(LabMeasurement, TakesNoLengthForATime) {
  write_text_file(folder_ / "trail.csv", "Fy [N],t [mm]\n800,30\n-790,31\n");
  EXPECT_EQ(read_measured_file(folder_ / "trail.csv").ledger.find_written("t")->meaning, "");
  write_text_file(folder_ / "time.csv", "Fy [N],t [ms]\n800,30\n-790,31\n");
  EXPECT_EQ(read_measured_file(folder_ / "time.csv").ledger.find_written("t")->meaning, "time");
}

// The function that reads one file of any kind, without a study, returns channels, ledger and
// doubts.
TEST_F(LabMeasurement, OfAnyFileHasALedger) {
  const MeasuredFile plain = read_measured_file(folder_ / "run.dat");
  EXPECT_EQ(plain.ledger.find_written("SA")->taken_as, "alpha");
  EXPECT_EQ(plain.ledger.find_written("SA")->line, 2);
  EXPECT_EQ(plain.ledger.find_written("SA")->column, 2);
  ASSERT_FALSE(plain.ledger.doubts.empty());
  EXPECT_TRUE(plain.ledger.doubts[0].is_error);
  EXPECT_EQ(plain.ledger.doubts[0].name, "FZ");
  EXPECT_NE(plain.ledger.doubts[0].sentence.find("axes = \"sae\""), std::string::npos);
  const MeasuredFile sae = read_measured_file(folder_ / "run.dat", AxisConvention::sae);
  for (const LedgerDoubt& doubt : sae.ledger.doubts)  // gaps are reported, and are no error
    EXPECT_TRUE(!doubt.is_error && doubt.sentence.find("\" is empty in ") != std::string::npos)
        << doubt.sentence;
  EXPECT_EQ(sae.ledger.find_written("FZ")->axes, "sae, -1");
  EXPECT_EQ(sae.channels["Fz"][0], 1000.0);
}

}  // namespace
}  // namespace latsch::correlation
