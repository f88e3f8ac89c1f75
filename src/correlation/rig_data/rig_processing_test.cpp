// SPDX-License-Identifier: Apache-2.0
// The whole processing chain on recordings with known parameters.
#include "correlation/rig_data/rig_processing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <regex>

#include "base/error.h"
#include "base/text.h"
#include "correlation/rig_data/rig_doubts.h"
#include "correlation/rig_data/rig_report.h"
#include "correlation/rig_data/rig_tables.h"
#include "formats/tables/recording.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

const std::string kRig = R"(
title = "Rig <1>"
[channels]
force = "Fz"
also = ["Fx"]
[drum]
circumference = "6 m"
[plateaus]
speeds = ["40 km/h", "80 km/h"]
[spectrum]
segment = "0.2 s"
band = ["10 Hz", "300 Hz"]
[run.dummy]
file = "dummy.csv"
[run.real]
file = "real.csv"
[hammer]
file = "hammer.csv"
input = "hammer"
[compensation]
fit = ["slow"]
bootstrap = 10
apply = ["dummy"]
[case.slow]
dummy = "dummy"
real = "real"
speed = "40 km/h"
[case.fast]
dummy = "dummy"
real = "real"
speed = "80 km/h"
[truth]
circumference = "6 m"
gain = 0.45
frequency = "92 Hz"
damping = 0.06
direct = 0.55
hold = "8 s"
hits = 8
[truth.run.dummy]
rim = "dummy"
noise = "3 N"
modes = [["46 Hz", "5 %", "400 N"], ["92 Hz", "4 %", "250 N"], ["141 Hz", "4 %", "120 N"]]
[truth.run.real]
rim = "real"
noise = "3 N"
modes = [["46 Hz", "5 %", "400 N"], ["92 Hz", "4 %", "250 N"], ["141 Hz", "4 %", "120 N"]]
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// Writes the synthetic recordings into a temporary folder.
class RigData : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("latsch_rig_data_" + std::to_string(getpid()));
    fs::create_directory(folder_);
    write_synthetic_files(rig());
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static RigFile rig(const std::string& text = kRig) {
    std::ofstream(folder_ / "rig.toml") << text;
    return read_rig_file(folder_ / "rig.toml");
  }
  static RigResults results(const std::string& text = kRig) {
    return process(rig(text), [](long, long, const std::string&) {});
  }
  static void refused(const std::string& text, const std::string& part) {
    try {
      results(text);
      FAIL() << part;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  static inline fs::path folder_;
};

TEST_F(RigData, FindsTheRigAndItsInverseAgain) {
  const RigResults found = results();
  const RigResponse truth = rig().truth->rig.response;
  const RigResponse by_hammer = found.hammer->fit.response;
  EXPECT_NEAR(by_hammer.f, truth.f, 2e-3 * truth.f);
  EXPECT_NEAR(by_hammer.zeta, truth.zeta, 2e-3);
  EXPECT_NEAR(by_hammer.gain(), truth.gain(), 0.01);
  EXPECT_NEAR(by_hammer.c, truth.c, 0.01);
  // Averages of a dozen passages with little noise are accurate to a percent (noise of the
  // dummy-rim force would reduce c).
  const RigResponse filter = found.compensation->filter_response, back = *inverse(truth);
  EXPECT_NEAR(filter.f, back.f, 0.01 * back.f);
  EXPECT_NEAR(filter.zeta, back.zeta, 0.01);
  EXPECT_NEAR(filter.c, back.c, 0.05 * back.c);
  EXPECT_GT(found.compensation->over_hits.f, 0.0);
}

// The speed of a drum was recorded as the pulses of a toothed wheel. The angle is the integral of
// the speed, and each tooth is high for half of its angle.
TEST_F(RigData, TakesTheSpeedFromAToothedWheel) {
  constexpr double kTeeth = 100.0, kWay = 6.0;
  std::string text = replaced(kRig, "[channels]", "[channels]\npulses = \"tooth\"");
  text = replaced(text, "[drum]", "[drum]\nteeth = 100");
  for (const char* name : {"dummy", "real"}) {
    const Channels recorded = formats::read_recording(folder_ / (std::string(name) + ".csv"), {});
    const auto &time = recorded.find("time")->values, &v = recorded.find("speed")->values;
    std::ofstream out(folder_ / (std::string(name) + "_pulses.csv"));
    out << "time [s],speed [m/s],tooth,Fz [N],Fx [N]\n";  // speed of another, faulty sensor
    double way = 0.0;
    for (std::size_t i = 0; i < time.size(); ++i) {
      if (i > 0) way += 0.5 * (v[i] + v[i - 1]) * (time[i] - time[i - 1]);
      const double turn = way * kTeeth / kWay;
      out << fmt::format("{:.4f},0,{:.4f},{},{}\n",
                         time[i],
                         std::tanh(4.0 * std::sin(2.0 * std::numbers::pi * turn)),
                         recorded.find("Fz")->values[i],
                         recorded.find("Fx")->values[i]);
    }
    text = replaced(text, fmt::format("\"{}.csv\"", name), fmt::format("\"{}_pulses.csv\"", name));
  }
  const RigResults by_speed = results(), by_pulses = results(text);
  for (std::size_t run = 0; run < by_speed.runs.size(); ++run) {
    for (std::size_t k = 0; k < by_speed.runs[run].plateaus.size(); ++k) {
      const Plateau &a = by_speed.runs[run].plateaus[k].plateau,
                    &b = by_pulses.runs[run].plateaus[k].plateau;
      EXPECT_NEAR(b.mean, a.mean, 1e-3 * a.mean);
      EXPECT_EQ(by_pulses.runs[run].plateaus[k].passages.starts.size(),
                by_speed.runs[run].plateaus[k].passages.starts.size());
    }
  }
}

TEST_F(RigData, PulsesNeedTheWheelTheyAreOf) {
  const std::string pulses = replaced(kRig, "[channels]", "[channels]\npulses = \"tooth\"");
  refused(pulses, "teeth");
  refused(replaced(pulses, "[drum]\ncircumference = \"6 m\"", ""), "needs both");
  refused(replaced(pulses, "force =", "speed = \"v\"\nforce ="), "is given beside speed");
  refused(replaced(kRig, "[drum]", "[drum]\nteeth = 60"), "no pulses to count");
  refused(replaced(pulses, "[drum]", "[drum]\nteeth = 60"), "channel \"tooth\" is missing");
}

// Digits beyond the second digit of a standard deviation are due to chance and differ on other
// processors.
TEST_F(RigData, ThePageShowsNoDigitsThatTheHitsDoNotTell) {
  const std::string page = rig_page(rig(), results());
  const std::regex known("<td[^>]*>(?:−)?([0-9.]+) ± ([0-9.]+)</td>");
  int values = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), known), end; at != end; ++at, ++values) {
    const std::string value = (*at)[1];
    const auto point = std::min(value.find('.'), value.size() - 1);
    const int second_digit = 1 - static_cast<int>(std::floor(std::log10(std::stod((*at)[2]))));
    EXPECT_LE(value.size() - point - 1, std::max(0, second_digit)) << at->str();
  }
  EXPECT_EQ(values, 8);  // four numbers of the rig, four of the filter
}

TEST_F(RigData, TheFilterBringsTheDummyRimToTheRealOneWhereItWasNotFitted) {
  const RigResults found = results();
  ASSERT_EQ(found.compensation->cases.size(), 2u);
  for (const CaseRow& row : found.compensation->cases) {
    EXPECT_EQ(row.fitted, row.name == "slow");
    EXPECT_LT(row.filtered.time, 0.3 * row.dummy.time) << row.name;
    EXPECT_LT(row.filtered.psd, 0.3 * row.dummy.psd) << row.name;
    EXPECT_LT(row.filtered.level, row.dummy.level) << row.name;
  }
}

TEST_F(RigData, OneRecordingAsDummyAndAsRealRimIsDoubted) {
  const std::string same = replaced(kRig, "real.csv", "dummy.csv");
  const auto doubts = doubts_of(rig(same), results(same));
  ASSERT_FALSE(doubts.empty());
  EXPECT_NE(doubts.front().find("case slow: the dummy and the real rim have the same force"),
            std::string::npos)
      << doubts.front();
  EXPECT_TRUE(doubts_of(rig(), results()).empty());
}

TEST_F(RigData, WithoutFittedCasesTheFilterIsTheInverseOfTheHammers) {
  const auto found = results(replaced(kRig, "fit = [\"slow\"]", "low_pass = \"800 Hz\""));
  EXPECT_FALSE(found.compensation->fit);
  EXPECT_EQ(found.compensation->filter.a.size(), 5u);  // second order and the low-pass
  for (const CaseRow& row : found.compensation->cases) {
    EXPECT_LT(row.filtered.psd, 0.5 * row.dummy.psd) << row.name;
  }
}

TEST_F(RigData, SameFileSameBits) {
  const RigFile file = rig();
  EXPECT_EQ(rig_page(file, results()), rig_page(file, results()));
}

TEST_F(RigData, TablesCanBeReadAgainAndThePageHoldsNoForeignMarkup) {
  const RigFile file = rig();
  const RigResults found = results();
  const auto tables = write_rig_tables(file, found, folder_ / "out");
  for (const fs::path& table : tables) {
    const std::string name = table.filename().string();
    if (name == "responses.csv" || name == "cases.csv") continue;  // tables with words
    EXPECT_FALSE(formats::read_recording(table).empty()) << table;
  }
  const auto average = formats::read_recording(folder_ / "out" / "average_dummy_40kph.csv");
  EXPECT_EQ(average["Fz"], found.runs[0].plateaus[0].force());
  const std::string page = rig_page(file, found);
  EXPECT_NE(page.find("Rig &lt;1&gt;"), std::string::npos);
  EXPECT_EQ(page.find("Rig <1>"), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

TEST_F(RigData, WhatCannotBeProcessedIsRefusedInWords) {
  refused(replaced(kRig, "\"80 km/h\"]", "\"80 km/h\", \"120 km/h\"]"),
          "has no plateau at 120 km/h");
  refused(replaced(kRig, "circumference = \"6 m\"\n[plat", "circumference = \"4 m\"\n[plat"),
          "does not repeat itself on the plateau at 40 km/h");
  refused(replaced(kRig, "force = \"Fz\"", "force = \"Fy\""), "channel \"Fy\" is missing");
  refused(replaced(kRig, "force = \"Fz\"", "force = \"speed\""),
          "channel \"speed\" is in m/s, expected a force");
  refused(replaced(kRig, "fit = [\"slow\"]", "fit = [\"quick\"]"),
          "names \"quick\", expected \"slow\" or \"fast\"");
  refused(replaced(kRig, "speed = \"80 km/h\"", "speed = \"70 km/h\""),
          "which is none of plateaus.speeds");
  refused(replaced(kRig, "file = \"dummy.csv\"", "file = \"absent.csv\""), "absent.csv");
  refused(replaced(kRig, "[hammer]", "[hammmer]"), "needs a start by hand");
  refused(replaced(kRig, "input = \"hammer\"", "input = \"hammer\"\nwindow = \"30 s\""),
          "expected longer pauses");
}

// Each of these times has more samples than a 32-bit integer holds. Regression test: with trim =
// "3221225 s" the number overflowed to a negative one and the program read before the beginning of
// the record; the hammer's window became one second.
TEST_F(RigData, ATimeLongerThanAnyRecordIsRefusedInWords) {
  for (const char* time : {"2147483 s", "3221225 s", "4294968 s", "1e17 s"}) {
    const std::string longer = in_quotes(time) + "\n";
    refused(replaced(kRig, "[plateaus]\n", "[plateaus]\ntrim = " + longer), "has no plateau at");
    refused(replaced(kRig, "[plateaus]\n", "[plateaus]\nshortest = " + longer),
            "has no plateau at");
    refused(replaced(kRig, "segment = \"0.2 s\"\n", "segment = " + longer),
            "expected a part of it");
    refused(replaced(kRig, "input = \"hammer\"", "input = \"hammer\"\nwindow = " + longer),
            "expected longer pauses");
  }
}

}  // namespace
}  // namespace latsch::correlation
