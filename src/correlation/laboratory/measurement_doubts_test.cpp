// SPDX-License-Identifier: Apache-2.0
// Tests doubts about a record that would otherwise give a wrong number: keys of `columns` that are
// no channels, a minus before a name, filler numbers, contradicting signs and encodings.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "correlation/laboratory/measurement.h"

namespace latsch::correlation {
namespace {

class MeasurementDoubts : public testing::Test {
 protected:
  Measurement read(const std::string& table,
                   const std::string& lines,
                   const std::string& file = "run.csv") {
    write_text_file(folder_ / file, table);
    const Document document = Document::parse(
        "[measurement.run]\nfile = \"" + file + "\"\n" + lines + "\n", "study.toml");
    return *find(read_laboratory(document.root(), folder_.path()), "run");
  }
  /// Returns the sentences of all doubts that contain these words, those of errors with "error: ".
  static std::string said(const Measurement& measurement, const std::string& words) {
    std::string all;
    for (const Ledger& ledger : measurement.ledgers())
      for (const LedgerDoubt& doubt : ledger.doubts)
        if (doubt.sentence.find(words) != doubt.sentence.npos)
          all += (doubt.is_error ? "error: " : "") + doubt.place.text() + ": " + doubt.sentence;
    return all;
  }
  /// Returns a sweep of the slip angle of a linear tire in iso axes, 60 samples.
  static std::string sweep(const std::string& names, double alpha_sign, int filler_from = 60) {
    std::string table = names + "\n";
    for (int i = 0; i < 60; ++i) {
      const double alpha = 4.0 * std::sin(0.3 * i);
      const bool is_filler = i >= filler_from && i < filler_from + 3;
      table += fmt::format("{},{},{:.4f},{:.3f}\n",
                           0.1 * i,
                           4000 + i % 7,
                           alpha_sign * alpha,
                           is_filler ? -9999.0 : -600.0 * alpha + std::sin(3.0 * i * i));
    }
    return table;
  }

  ScratchFolder folder_;
};

constexpr const char* kNames = "time [s],FZ [N],SA [deg],FY [N]";

TEST_F(MeasurementDoubts, AKeyThatIsNoChannelIsAnErrorUnlessSomethingUsesIt) {
  const Measurement run = read(sweep(kNames, 1.0), "columns = {alpa = \"SA\"}");
  const std::string error = said(run, "columns has alpa");
  EXPECT_NE(error.find("error: study.toml:3"), error.npos) << error;
  EXPECT_NE(error.find("did you mean \"alpha\"?"), error.npos) << error;
  run.note_use("alpa", "experiment own");
  EXPECT_EQ(said(run, "columns has alpa"), "");
  EXPECT_EQ(said(read(sweep(kNames, 1.0), "columns = {Alpha = \"SA\"}"), "columns has"), "");
}

TEST_F(MeasurementDoubts, AMinusBeforeANameIsApplied) {
  const Measurement plain = read(sweep(kNames, 1.0), "");
  for (const char* title :
       {"-SA [deg]", "- SA [deg]", "\u2212SA [deg]", "\u2013 slip angle [deg]"}) {
    const Measurement turned =
        read(sweep(fmt::format("time [s],FZ [N],{},FY [N]", title), -1.0), "");
    EXPECT_EQ(turned.values("alpha", "rad"), plain.values("alpha", "rad")) << title;
    EXPECT_NE(said(turned, "begins with a minus, which is applied: alpha is minus"), "") << title;
    EXPECT_EQ(said(turned, "same sign"), "") << title;
  }
  // Test a file in which a minus before a name is only a dash: the user then states the column in
  // `columns`.
  const Measurement dash =
      read(sweep("time [s],FZ [N],-SA [deg],FY [N]", 1.0), "columns = {alpha = \"-SA\"}");
  EXPECT_EQ(dash.values("alpha", "rad"), plain.values("alpha", "rad"));
  EXPECT_EQ(said(dash, "minus"), "");
}

TEST_F(MeasurementDoubts, AFillerIsAnErrorOnceSomethingUsesItsChannel) {
  const Measurement run = read(sweep(kNames, 1.0, 20), "");
  EXPECT_EQ(said(run, "-9999 N").find("error"), std::string::npos);
  run.note_use("Fy", "experiment fy");
  const std::string error = said(run, "-9999 N in 3 of 60 samples (lines 22 to 24)");
  EXPECT_NE(error.find("error: "), error.npos) << error;
  // The window that the message proposes excludes exactly these rows.
  const std::size_t begin = error.find("Fy = \"");
  ASSERT_NE(begin, error.npos) << error;
  const std::string window = error.substr(begin, error.find('"', begin + 6) + 1 - begin);
  const Measurement rest = read(sweep(kNames, 1.0, 20), "[measurement.run.select]\n" + window);
  EXPECT_EQ(rest.samples(), 57u);
  EXPECT_EQ(said(rest, "-9999"), "");
  // A low-pass filter spreads the filler number over its neighbors, so no selection of samples
  // removes it.
  const Measurement filtered = read(sweep(kNames, 1.0, 20), "low_pass = \"2 Hz\"");
  EXPECT_NE(said(filtered, "low_pass has spread it"), "");
}

TEST_F(MeasurementDoubts, AFillerInAnotherUnitOrFileIsFound) {
  std::string table = "time [s],FZ [kN],SA [deg],FY [kN]\n";
  for (int i = 0; i < 30; ++i)
    table += fmt::format("{},4.{:03},{},{}\n", 0.1 * i, i, i % 9, i == 5 ? -999.0 : -0.3 * (i % 9));
  const std::string text = said(read(table, ""), "-999 kN");
  EXPECT_NE(text.find("in 1 of 30 samples (line 7)"), text.npos) << text;
  write_text_file(folder_ / "first.csv", sweep(kNames, 1.0));
  write_text_file(folder_ / "second.csv", sweep(kNames, 1.0, 3));
  const Document document =
      Document::parse("[measurement.run]\nfiles = [\"first.csv\", \"second.csv\"]\n", "study.toml");
  const auto both = find(read_laboratory(document.root(), folder_.path()), "run");
  const std::string second = said(*both, "-9999 N");
  EXPECT_NE(second.find("second.csv:5"), second.npos) << second;
  EXPECT_NE(second.find("lines 5 to 7"), second.npos) << second;
  EXPECT_EQ(said(*both, "goes back"), "");  // each file has its own time
}

TEST_F(MeasurementDoubts, AMissingStateNamesTheColumnsThatMayBeIt) {
  const Measurement run = read(sweep("time [s],FZ [N],steer [deg],FY [N]", 1.0), "");
  run.note_absent({"alpha", "rad", "test steady", "0"});
  const std::string text = said(run, "alpha is taken as 0");
  EXPECT_NE(text.find("`steer` (a steer angle"), text.npos) << text;
  EXPECT_NE(text.find("columns = {alpha = \"steer\"}"), text.npos) << text;
  EXPECT_NE(text.find("without = [\"alpha\"]"), text.npos) << text;
  const Measurement exchanged = read(sweep(kNames, 1.0), "columns = {gamma = \"SA\"}");
  exchanged.note_absent({"alpha", "rad", "test steady", "0"});
  exchanged.note_use("gamma", "test steady");
  EXPECT_NE(said(exchanged, "`SA` (stated to be gamma)"), "");
}

TEST_F(MeasurementDoubts, AToeInMinutesOrMillimetersIsExplained) {
  const auto complaint = [&](const std::string& title) {
    try {
      (void)read(sweep(fmt::format("time [s],FZ [N],{},FY [N]", title), 1.0), "")
          .values("toe", "rad");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_NE(complaint("toe [mm]").find("asin(toe / d)"), std::string::npos)
      << complaint("toe [mm]");
  EXPECT_NE(complaint("toe [min]").find("\"arcmin\""), std::string::npos) << complaint("toe [min]");
  EXPECT_NE(complaint("Toe [mm]").find("asin(toe / d)"), std::string::npos);
  EXPECT_EQ(complaint("toe [arcmin]"), "nothing");
}

TEST_F(MeasurementDoubts, AnAssumedEncodingIsARowOfTheLedger) {
  const auto encoding_of = [&](const std::string& table) {
    const std::vector<Ledger> ledgers = read(table, "").ledgers();
    for (const LedgerRow& row : ledgers.front().rows)
      if (row.taken_as == "encoding") return row.remark;
    return std::string();
  };
  EXPECT_EQ(encoding_of(sweep("time [s],FZ [N],Schräglaufwinkel [°],FY [N]", 1.0)), "");
  const std::string western = sweep("time [s],FZ [N],Schr\xe4glaufwinkel [\xb0],FY [N]", 1.0);
  EXPECT_NE(encoding_of(western).find("Windows-1252"), std::string::npos);
  EXPECT_EQ(encoding_of(western).find("Shift-JIS"), std::string::npos);
  EXPECT_EQ(said(read(western, ""), "Shift-JIS"), "");
  const std::string japanese = sweep("time [s],FZ [N],\x89\xb7\x93x [deg],FY [N]", 1.0);
  // Längskraft, Rückstellmoment: an umlaut and the letter behind it are no Japanese character.
  const std::string german =
      "L\xe4ngskraft [N],R\xfc"
      "ckstellmoment [N m],Schr\xe4glaufwinkel [\xb0]\n1,2,3\n2,3,4\n";
  EXPECT_EQ(said(read(german, ""), "Shift-JIS"), "");
  EXPECT_NE(said(read(japanese, ""), "they look like Shift-JIS"), "");
}

TEST_F(MeasurementDoubts, StepsAreUsersOfTheChannelsThatTheyRead) {
  const auto users = [&](const std::string& table, const std::string& lines) {
    const Measurement run = read(table, lines);
    std::string all;
    const std::vector<Ledger> ledgers = run.ledgers();
    for (const LedgerRow& row : ledgers.front().rows)
      for (const std::string& user : row.used_by) all += row.written + " by " + user + ";";
    return all;
  };
  const std::string plain = sweep(kNames, 1.0);
  EXPECT_NE(users(plain, "low_pass = \"2 Hz\"").find("time by low_pass;"), std::string::npos);
  EXPECT_NE(users(plain, "sweep = {SA = \"rising\"}").find("time by sweep;"), std::string::npos);
  const std::string zero = "zero = {channels = [\"FY\"], at = {SA = \"0 deg +- 1 deg\"}}";
  EXPECT_NE(users(plain, zero).find("SA by zero;"), std::string::npos);
  // Mx about the contact point takes Fy and Fz at the wheel center, gamma and the radius.
  const std::string turned = users(
      "gamma [deg],loaded_radius [mm],FyH [N],FzH [N],MxH [N m]\n2,300,-900,4000,30\n"
      "2,301,-950,3900,31\n",
      "in_frame = \"W\"");
  for (const char* name : {"gamma", "loaded_radius", "FyH", "FzH"})
    EXPECT_NE(turned.find(name + std::string(" by in_frame;")), turned.npos) << turned;
}

/// Returns a TYDEX file of three samples: RUNTIME, INCLANGL and DSTGRWHC, and text behind its end.
std::string tydex_of_heights(const std::string& inclination, const std::string& behind = "") {
  const bool leans = !inclination.empty();
  std::string text =
      "**HEADER\nRELEASE   Release                       -         1.3\n**MEASURCHANNELS\n"
      "RUNTIME   time                          s         1         0         0\n" +
      inclination +
      "DSTGRWHC  height                        mm        1         0         0\n"
      "**MEASURDATA\n";
  for (int i = 0; i < 3; ++i)
    text += fmt::format("{} {}300\n", 0.1 * i, leans ? fmt::format("{} ", -6 * i) : std::string());
  return text + "**END\n" + behind;
}

// cos 6 deg = 0.994521895, cos 12 deg = 0.978147601: a wheel whose center is 300 mm high has a
// longer radius in its plane if it leans, to either side.
TEST_F(MeasurementDoubts, TheHeightOfTheCenterIsNoLoadedRadiusOfAWheelThatLeans) {
  const std::string leans =
      "INCLANGL  inclination                   deg       1         0         0\n";
  const auto radius = [&](const std::string& text, const std::string& lines) {
    return read(text, lines, "rig.tdx").values("loaded_radius", "m");
  };
  const std::vector<double> turned = radius(tydex_of_heights(leans), "");
  EXPECT_NEAR(turned[0], 0.3, 1e-12);
  EXPECT_NEAR(turned[1], 0.3 / 0.994521895368, 1e-12);
  EXPECT_NEAR(turned[2], 0.3 / 0.978147600734, 1e-12);
  const std::vector<double> flat(3, 0.3);
  EXPECT_EQ(radius(tydex_of_heights(leans), "columns = {loaded_radius = \"DSTGRWHC\"}"), flat);
  EXPECT_EQ(radius(tydex_of_heights(""), ""), flat);
  const auto remark = [&](const std::string& text, const std::string& lines) {
    const std::vector<Ledger> ledgers = read(text, lines, "rig.tdx").ledgers();
    for (const LedgerRow& row : ledgers.front().rows)
      if (row.written == "DSTGRWHC") return row.remark;
    return std::string();
  };
  EXPECT_NE(remark(tydex_of_heights(leans), "").find("over the cosine of INCLANGL, up to 2.2 %"),
            std::string::npos)
      << remark(tydex_of_heights(leans), "");
  const std::vector<Ledger> summed = read(tydex_of_heights(leans), "", "rig.tdx").ledgers();
  EXPECT_NE(in_one_line(summed.front()).find("loaded_radius is the height DSTGRWHC of the wheel"),
            std::string::npos)
      << in_one_line(summed.front());
  EXPECT_NE(remark(tydex_of_heights(""), "").find("no inclination is in the file"),
            std::string::npos);
  EXPECT_NE(
      remark(tydex_of_heights(leans), "columns = {loaded_radius = \"DSTGRWHC\"}").find("as stated"),
      std::string::npos);
  // a table that writes the same name in small letters, and a column that is the radius itself
  EXPECT_NEAR(read("gamma [deg],dstgrwhc [mm]\n12,300\n", "").values("loaded_radius", "m")[0],
              0.3 / 0.978147600734,
              1e-12);
  EXPECT_EQ(read("gamma [deg],RL [mm]\n12,300\n", "").values("loaded_radius", "m")[0], 0.3);
}

TEST_F(MeasurementDoubts, TextBehindTheEndOfATydexIsTold) {
  const std::string text = said(read(tydex_of_heights("", "0.4 250\n"), "", "rig.tdx"), "**END");
  EXPECT_NE(text.find("rig.tdx:11: 1 line behind **END is not read"), text.npos) << text;
  EXPECT_EQ(said(read(tydex_of_heights(""), "", "rig.tdx"), "**END"), "");
}

/// Returns a table of a linear corner or axle on a K&C rig, a row for each state of its loads.
std::string kc_table(const std::string& axes, bool both_wheels, int rows, bool unloaded_row) {
  const double x = axes == "adams" ? -1.0 : 1.0, y = axes == "iso" ? 1.0 : -1.0,
               z = axes == "sae" || axes == "adapted_sae" ? -1.0 : 1.0,
               load = axes == "sae" ? -1.0 : 1.0;
  std::string head, text;
  for (const char* end : {"_L", "_R"}) {
    if (!both_wheels && end[1] == 'R') continue;
    const std::string of = both_wheels ? end : "";
    for (const char* name : {"Fx", "Fy", "Fz"}) head += std::string(name) + of + " [N],";
    head += "Mz" + of + " [N m],";
    for (const char* name : {"dx", "dy", "dz"}) head += std::string(name) + of + " [mm],";
    for (const char* name : {"toe", "camber", "caster"}) head += std::string(name) + of + " [deg],";
  }
  head.back() = '\n';
  for (int i = 0; i < rows; ++i) {
    std::string line;
    for (const double side : {1.0, -1.0}) {
      if (!both_wheels && side < 0.0) continue;
      const double k = i + (side > 0.0 ? 0.0 : 0.37);
      const bool is_loaded = !(unloaded_row && i == 0);
      const double Fx = is_loaded ? 2000 * std::sin(1.0 + 2.1 * k) : 0.0,
                   Fy = is_loaded ? 2500 * std::sin(0.3 + 3.7 * k) : 0.0,
                   Fz = is_loaded ? 3000 + 900 * std::sin(1.9 * k) : 0.0,
                   Mz = is_loaded ? 80 * std::sin(2.0 + 5.3 * k) : 0.0;
      line += fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},", x * Fx, y * Fy, load * Fz, x * y * Mz);
      line += fmt::format("{:.6g},{:.6g},{:.6g},", x * 3e-4 * Fx, y * 2e-4 * Fy, z * 4e-4 * Fz);
      line += fmt::format("{:.6g},{:.6g},{:.6g},",
                          -side * (5e-3 * Mz + 1e-5 * Fx),
                          -side * (2e-5 * Fy + 1e-6 * Fz),
                          2e-5 * Fx);
    }
    line.back() = '\n';
    text += line;
  }
  return head + text;
}

TEST_F(MeasurementDoubts, EveryTableOfAKcRigIsOfferedItsAxes) {
  for (const bool both : {false, true})
    for (const char* axes : {"sae", "adapted_sae", "adams"}) {
      const Measurement unsaid = read(kc_table(axes, both, 14, false), "");
      const std::string words = fmt::format("axes = \"{}\"", axes);
      EXPECT_NE(said(unsaid, words), "") << axes << both;
      const Measurement stated = read(kc_table(axes, both, 14, false), words);
      EXPECT_EQ(said(stated, ""), "") << axes << both;
      const Measurement iso = read(kc_table("iso", both, 14, false), "axes = \"iso\"");
      EXPECT_EQ(said(iso, ""), "") << both;
      const std::string first = both ? "dx_L" : "dx";
      for (std::size_t i = 0; i < 14; ++i)
        EXPECT_NEAR(stated.values(first, "m")[i], iso.values(first, "m")[i], 1e-9) << axes;
    }
}

// A row without load changed an error with advice into a warning without.
TEST_F(MeasurementDoubts, ARowWithoutLoadDoesNotChangeWhatIsSaid) {
  for (const bool both : {false, true})
    for (const bool unloaded : {false, true}) {
      const std::string text = said(read(kc_table("sae", both, 6, unloaded), ""), "below 0");
      EXPECT_EQ(text.find("error: "), 0u) << text;
      EXPECT_NE(text.find("axes = \"sae\""), text.npos) << text;
      EXPECT_EQ(text.find("-0 N"), text.npos) << text;
    }
}

TEST_F(MeasurementDoubts, AxesOfACarAreNoAxesOfASlipAngle) {
  try {
    (void)read(sweep(kNames, 1.0), "axes = \"adams\"");
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("study.toml:3"), text.npos) << text;
    EXPECT_NE(text.find("do not define alpha"), text.npos) << text;
  }
}

// The channel varies from 1.99 to 2.01 deg, and its direction changes with every sample.
TEST_F(MeasurementDoubts, ASweepOfAConstantChannelIsDoubted) {
  std::string table = "time [s],IA [deg],FY [N]\n";
  for (int i = 0; i < 60; ++i)
    table += fmt::format("{},{:.4f},{}\n", 0.1 * i, 2.0 + 0.01 * std::sin(7.0 * i * i), 100 + i);
  EXPECT_NE(said(read(table, "sweep = {gamma = \"rising\"}"), "constant but for noise"), "");
  EXPECT_EQ(said(read(sweep(kNames, 1.0), "sweep = {SA = \"rising\"}"), "but for noise"), "");
}

/// Returns a cornering test of a linear tire over slip angle and inclination as the axes of SAE
/// J670 have it, but with positive loads and with this sign of the side force. In iso axes it is
/// read as a tire that leans against its force.
std::string inclined_sweep(const std::string& names, double sign = 1.0) {
  std::string table = names + "\n";
  for (const double camber : {-4.0, -2.0, 0.0, 2.0, 4.0})
    for (int i = -6; i <= 6; ++i)
      table += fmt::format("{},{},{},{:.3f}\n",
                           4000 + 3 * i,
                           0.3 * i,
                           camber,
                           sign * (-600.0 * 0.3 * i + 60.0 * camber + std::sin(3.0 * i * i)));
  return table;
}

constexpr const char* kInclined = "FZ [N],SA [deg],IA [deg],FY [N]";

// The record and its mirror image agree: the file is in sae axes with positive loads, or its
// inclination has the other sign. Both are offered with the difference between them, whether or not
// the study states iso; if either is stated, there is no contradiction.
TEST_F(MeasurementDoubts, ARecordAndItsMirrorImageAreBothOffered) {
  for (const std::string stated : {"axes = \"iso\"", ""}) {
    SCOPED_TRACE(stated);
    const std::string text = said(read(inclined_sweep(kInclined), stated), "raises Fy");
    const std::string in_place = stated.empty() ? "" : " in place of \"iso\"";
    for (const std::string& part :
         {std::string("each of several statements"),
          std::string("columns = {gamma = \"-IA\"} (right if at the rig a positive FY pushes the "
                      "tire to the left and a positive IA leans its top to the left"),
          "axes = \"sae\"" + in_place +
              " and, because its loads are written as positive, columns = {Fz = \"-FZ\"} (right "
              "if at the rig a positive FY pushes the tire to the right and a positive IA leans "
              "its top to the right"})
      EXPECT_NE(text.find(part), text.npos) << part << "\n" << text;
  }
  for (const char* said_then :
       {"axes = \"iso\"\ncolumns = {gamma = \"-IA\"}", "axes = \"sae\"\ncolumns = {Fz = \"-FZ\"}"})
    EXPECT_EQ(said(read(inclined_sweep(kInclined), said_then), "raises Fy"), "") << said_then;
}

// The study turns the column of the side force: the named directions are those of the file.
TEST_F(MeasurementDoubts, TheDirectionsThatTellAMirrorImageAreThoseOfTheFile) {
  const std::string text =
      said(read(inclined_sweep(kInclined, -1.0), "axes = \"iso\"\ncolumns = {Fy = \"-FY\"}"),
           "raises Fy");
  EXPECT_NE(text.find("gamma = \"-IA\"} (right if at the rig a positive FY pushes the tire to the "
                      "right and a positive IA leans its top to the left"),
            text.npos)
      << text;
  EXPECT_NE(text.find("in place of \"iso\""), text.npos) << text;
}

}  // namespace
}  // namespace latsch::correlation
