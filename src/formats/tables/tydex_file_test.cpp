// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/tydex_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "base/units.h"

namespace latsch::formats {
namespace {

const std::filesystem::path kTydexSamples = LATSCH_SOURCE_DIR "/../shared/data/tdx";
constexpr double kDegree = std::numbers::pi / 180.0;

const std::string kHead =
    "**HEADER\n"
    "RELEASE   Release of TYDEX-Format                 1.3\n"
    "MEASID    Measurement ID                          K12\n"
    "**CONSTANTS\n"
    "INFLPRES  Inflation pressure            bar       2.5\n"
    "NOMWIDTH  Nominal section width         mm        205\n"
    "IDENTITY  Identity                                205/55 R16\n";
const std::string kChannels =
    "**MEASURCHANNELS\n"
    "RUNTIME   Running time                  s         1         0         0\n"
    "SLIPANGL  Slip angle                    deg       2         1         -0.5\n"
    "FZW       Vertical force                kN        1         0         0\n";
const std::string kData = "**MEASURDATA\n0 0.5 1.0\n0.1 1.5 2.0\n**END\n";

std::string message_of(const std::string& text) {
  try {
    TydexFile::parse(text, "rig.tdx");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_tydex_message(const std::string& text,
                          const std::string& place,
                          const std::string& words) {
  const std::string message = message_of(text);
  EXPECT_EQ(message.find(place), 0u) << message;
  EXPECT_NE(message.find(words), std::string::npos) << message;
}

TEST(TydexFile, TheNumberOfSamplesBehindTheKeywordIsThatOfTheSamples) {
  const auto with_count = [](const std::string& count) {
    std::string data = kData;
    return kHead + kChannels + data.replace(0, 12, "**MEASURDATA" + count);
  };
  EXPECT_EQ(message_of(with_count("  2")), "");
  EXPECT_EQ(message_of(with_count(" samples")), "");
  expect_tydex_message(with_count("  50"), "rig.tdx:12: ", "states 50 samples, but 2 follow");
  expect_tydex_message(with_count("  1"), "rig.tdx:12: ", "states 1 samples, but 2 follow");
}

TEST(TydexFile, ReadsHeaderConstantsAndChannelsInSi) {
  const TydexFile file = TydexFile::parse(kHead + kChannels + kData, "rig.tdx");
  EXPECT_EQ(file.find("RELEASE")->text, "1.3");
  EXPECT_EQ(file.find("MEASID")->comment, "Measurement ID");
  EXPECT_EQ(file.find("IDENTITY")->text, "205/55 R16");
  EXPECT_FALSE(file.find("IDENTITY")->number);
  EXPECT_EQ(*file.find("NOMWIDTH")->number, 0.205);
  EXPECT_EQ(file.constant("INFLPRES", "bar"), 2.5e5);
  EXPECT_EQ(file.channels["RUNTIME"], (std::vector<double>{0.0, 0.1}));
  EXPECT_EQ(file.channels["FZW"], (std::vector<double>{1000.0, 2000.0}));
  EXPECT_EQ(file.channels.find("SLIPANGL")->unit, "rad");
  // The value is factor (raw + measured offset) + physical offset = 2 (0.5 + 1) - 0.5 degrees.
  EXPECT_NEAR(file.channels["SLIPANGL"][0], 2.5 * kDegree, 1e-16);
  EXPECT_EQ(file.descriptions[1].comment, "Slip angle");
  EXPECT_EQ(file.lines, (std::vector<int>{13, 14}));
  EXPECT_NEAR(file.constant("FZW", "N"), 1500.0, 1e-12);  // the mean of the channel
}

TEST(TydexFile, ToleratesWhatRigsWrite) {
  std::string text =
      "**header\r\n"
      "release   Release of TYDEX-Format                 1.3\r\n"
      "**COMMENTS\r\n! gemessen in M\xfcnchen\r\nB\xf6"
      "den\r\n"
      "**CONSTANTS\r\n"
      "AMBITEMP  Umgebung f\xfcr Reifen            deg C     20\r\n"
      "INFLPRES\tpressure\tbar\t2,5\r\n"
      "**MEASURCHANNELS\r\n"
      "RUNTIME   Running time                  S\r\n"
      "WHROTSPD  Rotational speed              1/min     1\r\n"
      "MZW       Aligning moment               NM        1         0         0\r\n"
      "! a comment\r\n"
      "**MEASURDATA\r\n"
      "0         60.0      1.0D+01\r\n"
      "\r\n"
      "0,1       NOTAVAIL  -1,5\r\n"
      "       0.2-600.00001-1234.5678\r\n"
      "0.3                 7\r\n"
      "**end\r\n"
      "whatever follows\r\n";
  const TydexFile file = TydexFile::parse(text, "rig.tdx");
  EXPECT_EQ(file.comments.at(0), "gemessen in M\xc3\xbcnchen");
  EXPECT_EQ(file.find("AMBITEMP")->comment, "Umgebung f\xc3\xbcr Reifen");
  EXPECT_EQ(*file.find("AMBITEMP")->number, 293.15);
  EXPECT_EQ(file.constant("INFLPRES", "Pa"), 2.5e5);
  EXPECT_EQ(file.channels["RUNTIME"], (std::vector<double>{0.0, 0.1, 0.2, 0.3}));
  const auto& spin = file.channels["WHROTSPD"];
  EXPECT_NEAR(spin[0], 2.0 * std::numbers::pi, 1e-15);
  EXPECT_TRUE(std::isnan(spin[1]));
  EXPECT_NEAR(spin[2], -600.00001 * std::numbers::pi / 30.0, 1e-13);
  EXPECT_TRUE(std::isnan(spin[3]));
  EXPECT_EQ(file.channels["MZW"], (std::vector<double>{10.0, -1.5, -1234.5678, 7.0}));
}

TEST(TydexFile, KeepsTheSectionsOfAModel) {
  const TydexFile file = TydexFile::parse(kHead +
                                              "**MODELDEFINITION\nMF\n**MODELPARAMETERS\n"
                                              "FNOMIN    nominal load                  N         "
                                              "4000\n**MODELEND\n**END\n",
                                          "model.tdx");
  ASSERT_EQ(file.model.size(), 3u);
  EXPECT_EQ(file.model[1].keyword, "**MODELPARAMETERS");
  EXPECT_EQ(file.model[1].entries.at(0).text, "4000");
  EXPECT_TRUE(file.channels.empty());
}

TEST(TydexFile, SaysWhereAndWhatIsWrong) {
  expect_tydex_message("", "rig.tdx: ", "**HEADER");
  expect_tydex_message(kHead + kChannels + "**MEASURDATA\n0 1 2\n", "rig.tdx:13: ", "incomplete");
  expect_tydex_message(kHead + "**MEASURDATA\n0 1 2\n**END\n", "rig.tdx:8: ", "**MEASURCHANNELS");
  expect_tydex_message(
      kHead + kChannels + "**MEASURDATA\n**END\n", "rig.tdx:13: ", "without a sample");
  expect_tydex_message(kHead + "**MESURDATA\n**END\n", "rig.tdx:8: ", "mean \"**MEASURDATA\"");
  expect_tydex_message(
      kHead + kChannels + "**MEASURDATA\n0 1\n**END\n", "rig.tdx:13: ", "3 channels");
  expect_tydex_message(
      kHead + kChannels + "**MEASURDATA\n0 1 x7\n**END\n", "rig.tdx:13: ", "FZW is \"x7\"");
  expect_tydex_message(
      kHead + kChannels + "**MEASURDATA\n0 inf 7\n**END\n", "rig.tdx:13: ", "SLIPANGL");
  expect_tydex_message("FZW 1\n**END\n", "rig.tdx:1: ", "expected **HEADER");
  std::string wrong = kHead + kChannels + kData;
  wrong.replace(wrong.find("kN"), 2, "mm");
  expect_tydex_message(wrong, "rig.tdx:11: ", "FZW is in \"mm\", expected a force");
  wrong = kHead + kChannels + kData;
  wrong.replace(wrong.find("kN"), 2, "kX");
  expect_tydex_message(wrong, "rig.tdx:11: ", "unknown unit \"kX\"");
  wrong = kHead + kChannels + kData;
  wrong.replace(wrong.find("deg "), 4, "    ");
  expect_tydex_message(wrong, "rig.tdx:10: ", "SLIPANGL has no unit");
  wrong = kHead + kChannels + kData;
  wrong.replace(wrong.find("FZW "), 4, "SLIPANGL");
  expect_tydex_message(wrong, "rig.tdx:11: ", "channel SLIPANGL comes twice");
  expect_tydex_message(kHead + std::string(1, '\0') + kChannels, "rig.tdx:8: ", "zero byte");
  const TydexFile file = TydexFile::parse(kHead + kChannels + kData, "rig.tdx");
  EXPECT_THROW(file.constant("FNOMIN", "N"), InputError);
  EXPECT_THROW(file.constant("INFLPRES", "N"), InputError);
}

TEST(LabUnits, AreUnderstoodAsARigMeansThem) {
  const auto is = [](std::string_view text, std::string_view unit) {
    const auto found = Unit::find(text);
    return found && found->same_dimension(Unit::of(unit)) &&
           found->to_si(7.0L) == Unit::of(unit).to_si(7.0L);
  };
  for (const auto& [text, unit] :
       std::vector<std::pair<const char*, const char*>>{{"[kPa]", "kPa"},
                                                        {"KPA", "kPa"},
                                                        {"nm", "Nm"},
                                                        {"NM", "Nm"},
                                                        {"C", "degC"},
                                                        {"DEG", "deg"},
                                                        {"\xc2\xb0", "deg"},
                                                        {"(-)", "1"},
                                                        {"KM/H", "km/h"},
                                                        {"mph", "mile/h"},
                                                        {"%", "percent"},
                                                        {"1/min", "rpm"},
                                                        {"SEC", "s"},
                                                        {"MM", "mm"},
                                                        {"psi", "psi"}}) {
    EXPECT_TRUE(is(text, unit)) << text;
  }
  EXPECT_FALSE(Unit::find("quux"));
}

// Regression: "Grad", German for degree, was read as a giga-radian.
TEST(TydexFile, AGradOfAGermanRigIsADegree) {
  const std::string text =
      "**HEADER\nRELEASE   Release of TYDEX-Format                 1.3\n**MEASURCHANNELS\n"
      "SLIPANGL  Schraeglaufwinkel             Grad      1         0         0\n"
      "FZW       Radlast                       N         1         0         0\n"
      "**MEASURDATA\n-2 3000\n2 3000\n**END\n";
  const TydexFile file = TydexFile::parse(text, "g_grad.tdx");
  EXPECT_NEAR(file.channels["SLIPANGL"][1], 2 * std::numbers::pi / 180, 1e-16);
  std::string lower = text;
  lower.replace(lower.find("Grad "), 4, "grad");
  expect_tydex_message(lower, "rig.tdx:4: ", "unit \"grad\", which is a degree in German and 0.9");
}

// The samples are cornering tests on a flat belt at 25 mph; the names of the files state load and
// pressure.
TEST(TydexFile, ReadsTheCorneringTestsAsTheyAreNamed) {
  if (!std::filesystem::exists(kTydexSamples)) GTEST_SKIP() << "no samples in " << kTydexSamples;
  for (const double kilopascal : {69.0, 83.0}) {
    for (const double newton : {1050.0, 1610.0}) {
      const std::string name = "ttc_SA_sweep_P" + std::to_string(static_cast<int>(kilopascal)) +
                               "_IA0_FZ" + std::to_string(static_cast<int>(newton)) + ".tdx";
      const TydexFile file = TydexFile::read(kTydexSamples / name);
      ASSERT_EQ(file.channels.all().size(), 11u);
      EXPECT_GT(file.lines.size(), 1000u);
      EXPECT_EQ(file.constant("INFLPRES", "Pa"), 1000.0 * kilopascal);
      EXPECT_EQ(file.constant("FZW", "N"), newton);
      double load = 0.0, pressure = 0.0, sideways = 0.0;
      for (const double value : file.channels["FZW"]) load += value / file.lines.size();
      for (const double value : file.channels["INFLPRES"]) pressure += value / file.lines.size();
      const auto& slip = file.channels["SLIPANGL"];
      for (std::size_t i = 0; i < slip.size(); ++i) sideways -= slip[i] * file.channels["FYW"][i];
      // The rig keeps its loads within 10 % and its pressure within 5 %.
      EXPECT_NEAR(load, newton, 0.1 * newton) << name;
      EXPECT_NEAR(pressure, 1000.0 * kilopascal, 50.0 * kilopascal) << name;
      EXPECT_NEAR(file.channels["LONGVEL"][0], 40.2 / 3.6, 0.1);
      EXPECT_GT(sideways, 0.0) << "positive slip angle, negative lateral force: ISO";
    }
  }
}

// An unknown unit of a channel that TYDEX does not define affects only this channel.
TEST(TydexFile, LeavesOutAChannelOfItsOwnWhoseUnitIsUnknown) {
  const std::string text =
      kHead + "TREADDEP  Depth                         32nds     8\n" + kChannels +
      "SENSOR_7  Something                     grC       1         0         0\n"
      "**MEASURDATA\n0 0.5 1.0 7\n0.1 1.5 2.0 8\n**END\n";
  const TydexFile file = TydexFile::parse(text, "rig.tdx");
  ASSERT_EQ(file.channels.all().size(), 3u);
  ASSERT_EQ(file.descriptions.size(), 3u);
  EXPECT_EQ(file.channels["FZW"], (std::vector<double>{1000.0, 2000.0}));
  ASSERT_TRUE(file.left_out.contains("SENSOR_7"));
  EXPECT_NE(file.left_out.at("SENSOR_7").find("unknown unit \"grC\""), std::string::npos);
}

// A spreadsheet program writes tabs instead of columns of fixed width.
TEST(TydexFile, TextBehindTheEndIsTold) {
  const auto doubts = [](const std::string& behind) {
    return TydexFile::parse(kHead + kChannels + kData + behind, "rig.tdx").doubts;
  };
  EXPECT_TRUE(doubts("").empty());
  EXPECT_TRUE(doubts("\n! a comment\n  \n").empty());
  const auto told = doubts("\n0.2 2.5 3.0\n0.3 3.5 4.0\n");
  expect_tydex_message(kHead + kChannels + kData + "**COMMENTS\nmore\n",
                       "rig.tdx:16: ",
                       "\"**COMMENTS\" stands behind **END");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].place.line, 17);
  EXPECT_NE(told[0].sentence.find("2 lines behind **END are not read"), std::string::npos)
      << told[0].sentence;
}

TEST(TydexFile, ChannelsBetweenTabsAreRead) {
  const TydexFile file = TydexFile::parse(kHead +
                                              "**MEASURCHANNELS\n"
                                              "RUNTIME\tRunning time\ts\t1\t0\t0\n"
                                              "SLIPANGL\tSlip angle\tdeg\t2\t1\t-0.5\n"
                                              "FZW\tVertical force\tkN\t1\t0\t0\n" +
                                              kData,
                                          "rig.tdx");
  const TydexFile whole = TydexFile::parse(kHead + kChannels + kData, "rig.tdx");
  EXPECT_EQ(file.channels.all(), whole.channels.all());
}

TEST(TydexFile, ChannelsBesideTheirColumnsAreRefusedByThatReason) {
  for (const char* line : {"RUNTIME Running time s 1 0 0\n", "FZW load N m 1 0 0\n"})
    expect_tydex_message(kHead + "**MEASURCHANNELS\n" + line + kData,
                         "rig.tdx:9: ",
                         "has its fields beside their columns");
}

TEST(TydexFile, AConstantThatIsNoNumberIsDoubted) {
  const std::string text =
      "**HEADER\n"
      "RELEASE   Release of TYDEX-Format                 1.3\n"
      "**CONSTANTS\n"
      "LONGVEL   Longitudinal velocity         km/h      1.234,5\n"
      "INFLPRES  Inflation pressure            bar       NOTAVAIL\n"
      "LOCATION  Location                                anywhere\n"
      "**MEASURCHANNELS\n"
      "FYW       lateral force                 N         1         0         0\n"
      "**MEASURDATA\n1\n2\n**END\n";
  const TydexFile file = TydexFile::parse(text, "x.tdx");
  ASSERT_EQ(file.doubts.size(), 1u);
  EXPECT_EQ(file.doubts[0].name, "LONGVEL");
  EXPECT_EQ(file.doubts[0].sentence,
            "constant LONGVEL is \"1.234,5\", expected a number: it is not used");
}

}  // namespace
}  // namespace latsch::formats
