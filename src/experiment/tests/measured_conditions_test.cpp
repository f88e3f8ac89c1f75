// SPDX-License-Identifier: Apache-2.0
// A test with numbers from a measurement equals the test in which the numbers are typed, in words,
// identity and needs.
#include "experiment/rigs/measured_conditions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "experiment/language.h"

namespace latsch::experiment {
namespace {

/// Returns the record of a rig for any measurement that is named.
const Channels& recorded() {
  static const Channels all = [] {
    Channels channels;
    channels.add({"deflection", "m", {0.005, 0.012, 0.0201}});
    channels.add({"loaded_radius", "m", {0.31, 0.3, 0.29}});
    channels.add({"Fz", "N", {3990.0, 4000.0, 4010.0}});
    channels.add({"Vx", "m/s", {9.0, 10.0, 11.0}});
    channels.add({"held", "m/s", {10.25, 10.25, 10.25}});
    channels.add({"frequency", "Hz", {40.0, 50.0, 60.0}});
    channels.add({"x", "m", {0.0, 0.31, 0.0}});
    channels.add({"y", "m", {0.05, -0.05, 0.05}});
    channels.add({"z", "m", {0.31, 0.0, 0.31}});
    channels.add({"mode", "1", {1.0, 1.0, 2.0}});
    channels.add({"pressure", "Pa", {2.5e5, 2.6e5, 2.7e5}});
    channels.add({"none", "m", {}});
    return channels;
  }();
  return all;
}

Channels measured(const Node& table, const std::vector<MeasuredCondition>& conditions) {
  EXPECT_EQ(table.text("from"), "measurement.rig");
  Channels channels;
  for (const MeasuredCondition& condition : conditions) {
    Channel channel = *recorded().find(table.text("channel", condition.channel));
    EXPECT_EQ(channel.unit, condition.unit);
    channel.name = condition.channel;
    channels.add(std::move(channel));
  }
  return channels;
}

ReadTest read(const std::string& keys, bool in_a_study = true) {
  const Document document = Document::parse(keys, "test.toml");
  TestSource source;
  if (in_a_study) source.measured = measured;
  return language().read_identified_test(document.root(), source);
}

/// Compares two tests: the keys of the first refer to a measurement, and those of the second
/// contain its numbers.
void expect_same(const std::string& common, const std::string& taken, const std::string& typed) {
  const auto one = read(common + taken), other = read(common + typed);
  EXPECT_EQ(one.identity, other.identity);
  EXPECT_EQ(one.test->in_words(), other.test->in_words());
  EXPECT_EQ(one.test->needs(), other.test->needs());
}

constexpr const char* kTakes = "{from = \"measurement.rig\"}\n";

TEST(MeasuredConditionsTest, AreTheNumbersThatWereMeasured) {
  const std::string from = kTakes;
  expect_same("kind = \"load_deflection\"\n",
              "deflections = " + from,
              "deflections = [\"5 mm\", \"12 mm\", \"20.1 mm\"]\n");
  expect_same("kind = \"load_deflection\"\n",
              "loaded_radii = " + from,
              "loaded_radii = [\"0.31 m\", \"0.3 m\", \"0.29 m\"]\n");
  expect_same("kind = \"static_stiffness\"\n",
              "deflections = " + from,
              "deflections = [\"5 mm\", \"12 mm\", \"20.1 mm\"]\n");
  expect_same("kind = \"static_stiffness\"\n", "load = " + from, "load = \"4 kN\"\n");
  for (const char* kind : {"static_stiffness", "rolling_stiffness", "uniformity"})
    expect_same(std::string("load = \"4 kN\"\nkind = \"") + kind + "\"\n",
                "pressure = " + from,
                "pressure = \"2.6 bar\"\n");
  expect_same("kind = \"footprint\"\n",
              "loads = " + from,
              "loads = [\"3990 N\", \"4000 N\", \"4010 N\"]\n");
  expect_same("kind = \"footprint\"\n",
              "deflections = " + from,
              "deflections = [\"5 mm\", \"12 mm\", \"20.1 mm\"]\n");
  const std::string sweep = "kind = \"slip_sweep\"\nalpha = [\"0 deg\", \"4 deg\"]\n";
  const std::string held = "speed = {from = \"measurement.rig\", channel = \"held\"}\n";
  expect_same(sweep, held + "load = " + from, "speed = \"10.25 m/s\"\nload = \"4 kN\"\n");
  expect_same("kind = \"drum_cleat\"\ndrum_diameter = \"2 m\"\n",
              held + "load = " + from,
              "speed = \"10.25 m/s\"\nload = \"4 kN\"\n");
}

// The test computes eight modes more than were measured, at the sensor points of the first measured
// mode.
TEST(MeasuredConditionsTest, OfModesAreTheirNumberAndSensors) {
  const std::string from = kTakes;
  expect_same("kind = \"modes\"\n",
              "load = " + from + "count = " + from + "points = " + from,
              "load = \"4 kN\"\ncount = 11\npoints = [[\"0 m\", \"50 mm\", \"310 mm\"], "
              "[\"310 mm\", \"-50 mm\", \"0 m\"]]\n");
}

std::string complaint(const std::string& keys, bool in_a_study = true) {
  try {
    read(keys, in_a_study);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MeasuredConditionsTest, SayWhatNoTestCanTake) {
  const auto expect = [](const std::string& keys, const std::string& part) {
    EXPECT_NE(complaint(keys).find(part), std::string::npos) << complaint(keys);
  };
  const std::string pressed =
      "kind = \"load_deflection\"\ndeflections = {from = \"measurement.rig\"";
  expect(pressed + ", channel = \"x\"}\n",
         "test.toml:2: deflections.from is \"measurement.rig\", whose deflection is 0 m in sample "
         "1, expected above 0");
  expect(pressed + ", channel = \"none\"}\n", "has no sample");
  expect(pressed + ", chanel = \"x\"}\n", "did you mean \"channel\"?");
  expect("kind = \"slip_sweep\"\nload = \"4 kN\"\nalpha = [\"0 deg\", \"4 deg\"]\nspeed = " +
             std::string(kTakes),
         "goes from 9 m/s to 11 m/s, expected a constant one above 0");
  EXPECT_NE(complaint(pressed + "}\n", false).find("which only a test of a study can name"),
            std::string::npos);
}

}  // namespace
}  // namespace latsch::experiment
