// SPDX-License-Identifier: Apache-2.0
// Messages about measured files propose what to write. Each test writes exactly the proposal, and
// the file must then be read correctly.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "correlation/laboratory/measurement.h"

namespace latsch::correlation {
namespace {

/// A column that a laboratory wrote without its unit, and the channel that uses it.
struct Unitless {
  const char *written, *channel, *si, *natural;
  double first;  // SI value of the number 2 in the natural unit
};
constexpr double kPerDegree = std::numbers::pi / 180.0;
constexpr std::array kUnitless = {
    Unitless{"SA", "alpha", "rad", "deg", 2.0 * kPerDegree},
    Unitless{"INCLANGL", "gamma", "rad", "deg", 2.0 * kPerDegree},
    Unitless{"FZ", "Fz", "N", "N", 2.0},
    Unitless{"FYW", "Fy", "N", "N", 2.0},
    Unitless{"INFLPRES", "p", "Pa", "kPa", 2000.0},
    Unitless{"MZ", "Mz", "N m", "N m", 2.0},
    Unitless{"RL", "loaded_radius", "m", "mm", 0.002},
    Unitless{"LONGVEL", "Vx", "m/s", "km/h", 2.0 / 3.6},
    Unitless{"WHROTSPD", "omega", "rad/s", "rpm", 2.0 * std::numbers::pi / 30.0},
    Unitless{"TSTC", "tread_center", "K", "degC", 275.15},
    Unitless{"ET", "time", "s", "s", 2.0},
};

class ReaderHints : public testing::Test {
 protected:
  /// Reads a [measurement.run] of a file with these additional lines.
  Measurement read(const std::string& file, const std::string& lines) {
    const Document document = Document::parse(
        "[measurement.run]\nfile = \"" + file + "\"\n" + lines + "\n", "study.toml");
    return *find(read_laboratory(document.root(), folder_.path()), "run");
  }
  template <class Action>
  static std::string complaint(const Action& action) {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  }
  /// Returns the text `columns = {...}` that a message proposes.
  static std::string columns_of(const std::string& message) {
    const std::size_t begin = message.find("columns = {");
    EXPECT_NE(begin, message.npos) << message;
    return begin == message.npos ? "" : message.substr(begin, message.find('}', begin) + 1 - begin);
  }
  /// Returns the text between two texts.
  static std::string between(const std::string& text,
                             const std::string& from,
                             const std::string& to) {
    const std::size_t begin = text.find(from);
    EXPECT_NE(begin, text.npos) << text;
    if (begin == text.npos) return "";
    return text.substr(begin + from.size(),
                       text.find(to, begin + from.size()) - begin - from.size());
  }
  static bool says(const Measurement& measurement, const std::string& words) {
    for (const Ledger& ledger : measurement.ledgers())
      for (const LedgerDoubt& doubt : ledger.doubts)
        if (doubt.sentence.find(words) != doubt.sentence.npos) return true;
    return false;
  }
  static std::string doubt_with(const Measurement& measurement, const std::string& words) {
    for (const Ledger& ledger : measurement.ledgers())
      for (const LedgerDoubt& doubt : ledger.doubts)
        if (doubt.sentence.find(words) != doubt.sentence.npos) return doubt.sentence;
    return "";
  }

  ScratchFolder folder_;
};

TEST_F(ReaderHints, AColumnWithoutUnitIsMendedInTheStudy) {
  for (const Unitless& one : kUnitless) {
    SCOPED_TRACE(one.written);
    write_text_file(folder_ / "run.csv", fmt::format("{},other [N]\n2,1\n2,1\n", one.written));
    // The study already states a column, which the proposal must contain as well.
    const std::string stated = "columns = {spare = \"other\"}";
    const Measurement before = read("run.csv", stated);
    const std::string message = complaint([&] { (void)before.values(one.channel, one.si); });
    EXPECT_NE(message.find("has no unit"), message.npos) << message;
    EXPECT_NE(message.find(fmt::format("\"{} [{}]\"", one.written, one.natural)), message.npos)
        << message;
    const Measurement after = read("run.csv", columns_of(message));
    EXPECT_NEAR(after.values(one.channel, one.si).at(0), one.first, 1e-12 * one.first);
    EXPECT_EQ(after.written("spare").column, "other");
  }
}

TEST_F(ReaderHints, AColumnWithoutUnitIsMendedInItsFile) {
  struct Kind {
    const char *file, *head, *sample;
  };
  // Kinds of files: one line of names; names and a line of units; and files of a test consortium
  // with tabs and with blanks.
  for (const Kind& kind : {Kind{"run.csv", "{},other [N]\n", "2,1\n"},
                           Kind{"units.csv", "{},other\n,N\n", "2,1\n"},
                           Kind{"run.dat", "Run 1\n{}\tother\n\tN\n", "2\t1\n"},
                           Kind{"named.dat", "{}\tother\n", "2\t1\n"},
                           Kind{"blanks.dat", "{} FX[N]\n", "2 1\n"}})
    for (const Unitless& one : kUnitless) {
      SCOPED_TRACE(fmt::format("{} {}", kind.file, one.written));
      const std::string head = fmt::format(fmt::runtime(kind.head), one.written);
      const auto write = [&](const std::string& text) {
        write_text_file(folder_ / kind.file, text + kind.sample + kind.sample);
      };
      write(head);
      const std::string message = complaint(
          [&] { (void)read_measurement(folder_ / kind.file).values(one.channel, one.si); });
      const std::string proposed = between(message, "such as ", " in its file, or ");
      std::string mended = head;
      if (proposed.find(" below ") == proposed.npos) {
        const std::string title = proposed.substr(1, proposed.size() - 2);
        mended.replace(mended.find(one.written), std::string(one.written).size(), title);
      } else {  // "deg" below "SA" in line 2
        const std::string unit = between(proposed, "\"", "\" below ");
        const int line = std::stoi(proposed.substr(proposed.rfind(' ')));
        std::size_t at = 0;
        for (int i = 1; i < line; ++i) at = mended.find('\n', at) + 1;
        mended.insert(at, unit);
      }
      write(mended);
      const Measurement after = read_measurement(folder_ / kind.file);
      EXPECT_NEAR(after.values(one.channel, one.si).at(0), one.first, 1e-12 * one.first) << mended;
      // Test the opposite case, in which the table belongs to the study.
      write(head);
      EXPECT_NEAR(read(kind.file, columns_of(message)).values(one.channel, one.si).at(0),
                  one.first,
                  1e-12 * one.first);
    }
}

TEST_F(ReaderHints, AColumnOfAnotherDimensionIsReplacedByTheOneThatIsNamed) {
  write_text_file(folder_ / "run.csv", "Fz [bar],LOAD CELL [kN],SA [deg]\n2,3,1\n2,3,1\n");
  const std::string message =
      complaint([&] { (void)read("run.csv", "columns = {Fz = \"Fz\"}").values("Fz", "N"); });
  EXPECT_NE(message.find("\"Fz\" is in \"bar\", expected a force"), message.npos) << message;
}

TEST_F(ReaderHints, AChannelOfAnotherDimensionNamesTheColumnsThatMayBeIt) {
  write_text_file(folder_ / "run.csv", "force [bar],LOAD CELL [kN],SA [deg]\n2,3,1\n2,3,1\n");
  const std::string message = complaint([&] { (void)read("run.csv", "").values("force", "N"); });
  EXPECT_NE(message.find("is in \"bar\", expected a force"), message.npos) << message;
  EXPECT_EQ(read("run.csv", columns_of(message)).values("force", "N").at(0), 3000.0);
}

TEST_F(ReaderHints, TwoColumnsForOneChannelAreToldApart) {
  write_text_file(folder_ / "run.csv", "SA [deg],Slip angle [deg]\n1,2\n1,2\n");
  const Measurement before = read("run.csv", "columns = {}");
  const std::string message = complaint([&] { (void)before.values("alpha", "rad"); });
  const Measurement after = read("run.csv", columns_of(message));
  EXPECT_NEAR(after.values("alpha", "rad").at(0), kPerDegree, 1e-15);
  EXPECT_FALSE(says(after, "both are"));
}

TEST_F(ReaderHints, LoadsBelowZeroAreTurnedByTheColumnOrByTheAxes) {
  write_text_file(folder_ / "run.csv", "FZ [N],FX [N]\n-1000,1\n-1000,1\n");
  const Measurement before = read("run.csv", "");
  const std::string sentence = doubt_with(before, "axes = ");
  ASSERT_FALSE(sentence.empty());
  const std::string axes = "axes = \"" + between(sentence, "axes = \"", "\"") + "\"";
  EXPECT_EQ(read("run.csv", axes).values("Fz", "N").at(0), 1000.0);
  EXPECT_FALSE(says(read("run.csv", axes), "below 0"));
  // If the axes are stated, the sign of the column must be changed as well.
  const std::string stated = "axes = \"iso\"\ncolumns = {Fx = \"FX\"}\n";
  const std::string complained = complaint([&] {
    const Measurement iso = read("run.csv", stated);
    throw InputError(doubt_with(iso, "turn the column"));
  });
  if (complained.find("columns = {") != complained.npos) {
    const Measurement after = read("run.csv", "axes = \"iso\"\n" + columns_of(complained));
    EXPECT_EQ(after.values("Fz", "N").at(0), 1000.0);
    EXPECT_EQ(after.written("Fx").column, "FX");
  }
}

TEST_F(ReaderHints, AChannelThatIsNotThereIsFoundUnderTheNameThatIsProposed) {
  for (const char* title : {"channel 7", "channel 7 [deg]", "angle \"7\" [deg]"}) {
    SCOPED_TRACE(title);
    const std::string quoted = std::string(title).find('"') == std::string::npos
                                   ? std::string(title)
                                   : "\"angle \"\"7\"\" [deg]\"";
    write_text_file(folder_ / "run.csv", quoted + ",FX [N]\n2,1\n2,1\n");
    const Measurement before = read("run.csv", "columns = {Fx = \"FX\"}");
    before.note_absent({"alpha", "rad", "test steady", "0"});
    const std::string sentence = doubt_with(before, "alpha is taken as 0");
    const Measurement after = read("run.csv", columns_of(sentence));
    EXPECT_NEAR(after.values("alpha", "rad").at(0), 2.0 * kPerDegree, 1e-15) << sentence;
    EXPECT_EQ(after.written("Fx").column, "FX");
  }
}

}  // namespace
}  // namespace latsch::correlation
