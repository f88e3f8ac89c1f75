// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/values.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/file.h"
#include "base/scratch_folder_testing.h"

namespace latsch::correlation {
namespace {

const std::vector<KnownChannel> kKnown = {{"print/length", "m"},
                                          {"print/load", "N"},
                                          {"air/frequency", "Hz"},
                                          {"air/n", "1"},
                                          {"air/type", "1"},
                                          {"air/damping", "1"}};

std::shared_ptr<const Values> values_of(const std::string& text) {
  const Document document = Document::parse("[e.row]\n" + text, "study.toml");
  const Node root = document.root();
  auto values = read_values(root.named_tables("e").front(), kKnown);
  root.close();
  return values;
}

std::string values_complaint(const std::string& text) {
  try {
    values_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Channels lengths(std::vector<double> values) {
  Channels channels;
  channels.add({"print/length", "m", std::move(values)});
  return channels;
}

TEST(Values, AreComparedInSharesOfThemselves) {
  const auto both = values_of("channel = \"print/length\"\nvalues = [\"100 mm\", \"200 mm\"]\n");
  const auto comparison = both->compare(lengths({0.09, 0.21}), {});
  ASSERT_TRUE(comparison);
  EXPECT_NEAR(comparison->errors[0], 0.1, 1e-12);
  EXPECT_NEAR(comparison->errors[1], -0.05, 1e-12);
  EXPECT_NEAR(comparison->mean_error, 0.075, 1e-12);
  EXPECT_EQ(both->rows()[1], "print/length, value 2");
  EXPECT_NEAR(both->deviations({.absolute = 0.002}, {})[1], 0.01, 1e-15);
}

TEST(Values, OneOfSeveralIsTakenByItsName) {
  const auto one = values_of(
      "channel = \"print/length\"\nvalue = \"20 cm\"\nof = \"largest\"\nscale = \"1 cm\"\n");
  EXPECT_NEAR(one->compare(lengths({0.1, 0.19, 0.12}), {})->errors[0], 1.0, 1e-12);
  const auto plain = values_of("channel = \"print/length\"\nvalue = \"20 cm\"\n");
  EXPECT_NE(plain->compare(lengths({0.1, 0.2}), {}).failure().reason.find("of = \"largest\""),
            std::string::npos);
  EXPECT_FALSE(plain->compare(Channels(), {}));
}

/// Returns modal channels. The codes are those of mode_record.h: lateral n=0, radial n=2, lateral
/// n=1 a and s, a lower radial n=2.
Channels vibrations() {
  Channels channels;
  channels.add({"air/frequency", "Hz", {41.0, 95.0, 50.0, 51.0, 48.0}});
  channels.add({"air/n", "1", {0.0, 2.0, 1.0, 1.0, 2.0}});
  channels.add({"air/type", "1", {1.0, 2.0, 1.0, 1.0, 2.0}});
  channels.add({"air/phase", "1", {0.0, 0.0, 2.0, 1.0, 0.0}});
  channels.add({"air/damping", "1", {0.07, 0.03, 0.05, 0.04, 0.06}});
  return channels;
}

// The recording has a radial n=2 at 95 Hz and a lower one at 48 Hz, whose damping is 6 %.
TEST(Values, NamedModesAreTakenFromARecordingOfAllModes) {
  const ScratchFolder folder;
  const auto all = folder / "all.csv";
  write_text_file(all,
                  "frequency [Hz],n [1],type [1],phase [1],damping [1]\n"
                  "41,0,1,0,0.07\n95,2,2,0,0.03\n48,2,2,0,0.06\n");
  const auto measurement = read_measurement(all);
  const auto read = [&](const std::string& modes) {
    const Document document = Document::parse(
        "[e.row]\nchannel = \"air/damping\"\nmodes = [" + modes + "]\n", "study.toml");
    return read_values(document.root().named_tables("e").front(), kKnown, &measurement);
  };
  const auto found = read("\"radial n=2\", \"lateral n=0\"")->compare(vibrations(), {});
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->errors[0], 0.0);
  EXPECT_DOUBLE_EQ(found->errors[1], 0.0);
  EXPECT_THROW(read("\"torsional n=0\""), InputError);
}

// Modes are found by name in any order. Of several with the same name the lowest is used, unless
// the phase is stated too.
TEST(Values, OfModesAreTakenByTheirNames) {
  const auto named = values_of(
      "channel = \"air/frequency\"\nmodes = [\"lateral n=1\", \"lateral n=1 s\", "
      "\"radial n=2\"]\nvalues = [\"40 Hz\", \"51 Hz\", \"50 Hz\"]\n");
  const auto comparison = named->compare(vibrations(), {});
  ASSERT_TRUE(comparison) << comparison.failure().reason;
  EXPECT_NEAR(comparison->errors[0], -0.25, 1e-12);
  EXPECT_NEAR(comparison->errors[1], 0.0, 1e-12);
  EXPECT_NEAR(comparison->errors[2], 0.04, 1e-12);
  EXPECT_EQ(named->rows()[2], "radial n=2");
  const auto damping =
      values_of("channel = \"air/damping\"\nmodes = [\"radial n=2\"]\nvalues = [0.05]\n");
  EXPECT_NEAR(damping->compare(vibrations(), {})->errors[0], -0.2, 1e-12);
}

// A missing mode counts as an error of 100 % without derivatives, as in mode_set.h.
TEST(Values, OfAModeThatIsNotThereAreMissing) {
  const auto named = values_of(
      "channel = \"air/frequency\"\nmodes = [\"radial n=3\", \"radial n=2\"]\n"
      "values = [\"100 Hz\", \"48 Hz\"]\n");
  const auto comparison = named->compare(vibrations(), {});
  ASSERT_TRUE(comparison);
  EXPECT_EQ(comparison->errors[0], 1.0);
  EXPECT_EQ(comparison->pairing.missing, std::vector<int>{0});
  EXPECT_NEAR(comparison->errors[1], 0.0, 1e-12);
}

TEST(Values, OfModesSayWhatIsWrong) {
  const std::string modes = "channel = \"air/frequency\"\nmodes = [\"radial n=2\"]\n";
  EXPECT_NE(values_complaint(modes + "values = [\"1 Hz\", \"2 Hz\"]\n").find("there are 2 values"),
            std::string::npos);
  EXPECT_NE(
      values_complaint(modes + "value = \"1 Hz\"\nof = \"first\"\n").find("is given beside of"),
      std::string::npos);
  EXPECT_NE(values_complaint("channel = \"air/frequency\"\nmodes = [\"radial 2\"]\n"
                             "values = [\"1 Hz\"]\n")
                .find("such as \"radial n=2\""),
            std::string::npos);
  EXPECT_NE(values_complaint("channel = \"print/load\"\nmodes = [\"radial n=2\"]\n"
                             "values = [\"1 N\"]\n")
                .find("records no modes"),
            std::string::npos);
}

TEST(Values, SayWhatIsWrong) {
  EXPECT_NE(values_complaint("channel = \"print/lenght\"\nvalue = \"1 m\"\n").find("did you mean"),
            std::string::npos);
  EXPECT_NE(values_complaint("channel = \"print/length\"\nvalue = \"1 N\"\n").find("length"),
            std::string::npos);
  EXPECT_NE(values_complaint("channel = \"print/length\"\nvalue = \"0 m\"\n").find("scale"),
            std::string::npos);
  EXPECT_NE(values_complaint("channel = \"print/length\"\n").find("one of them"),
            std::string::npos);
}

}  // namespace
}  // namespace latsch::correlation
