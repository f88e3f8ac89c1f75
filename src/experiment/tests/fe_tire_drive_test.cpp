// SPDX-License-Identifier: Apache-2.0
// A new test of the finite-element tire is one file and its line in a Language. This file holds the
// whole of such a test, the aspect of the inflated section, and compares it with the test
// "inflation".
#include <gtest/gtest.h>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "experiment/rigs/fe_tire/channel_slopes.h"

namespace latsch::experiment {
extern const TestKind kAspectTest;
namespace {

Result<Channels> aspect_of(TireRig& rig, const Inflation& pressure, fe_tire::TireSlopes* slopes) {
  const auto& inflated = rig.inflated(pressure.value_or(rig.own_pressure()));
  if (!inflated) return inflated.failure();
  const double aspect = inflated->width / inflated->radius;
  Channels channels;
  channels.add({"aspect", "1", {aspect}});
  if (!slopes) return channels;
  const auto by = slopes->of_inflated(*inflated);
  if (!by) return by.failure();
  return with_slopes(channels, {{"aspect", (by->width - aspect * by->radius) / inflated->radius}});
}

class AspectTest : public Test {
 public:
  explicit AspectTest(const Inflation& pressure) : pressure_(pressure) {}
  std::string in_words() const override { return "aspect" + inflated(pressure_); }
  std::vector<ChannelInfo> channels() const override { return {{"aspect", "1"}}; }
  std::vector<std::string> needs() const override { return kAspectTest.needs; }
  Result<Channels> run(Specimen& specimen) const override { return run_with_slopes(specimen, {}); }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    return specimen.find<IsFeTire>()->drive(
        [this](TireRig& rig, fe_tire::TireSlopes* slopes) {
          return aspect_of(rig, pressure_, slopes);
        },
        pressure_.has_value(),
        asked);
  }

 private:
  Inflation pressure_;
};

std::unique_ptr<Test> read_aspect(const Node& root, const TestSource& source) {
  return std::make_unique<AspectTest>(read_pressure(root, source.measured));
}

class ANewTestOfTheTire : public testing::Test {
 protected:
  ANewTestOfTheTire() { language_.tests.push_back(&kAspectTest); }

  Channels run(const std::string& test, const std::vector<std::string>& channels) {
    write_text_file(folder_ / "test.toml", test);
    const auto read = language_.read_test(folder_ / "test.toml");
    const auto found =
        read->run_with_slopes(*kind_.build(kind_.read(kTire)), {channels, {"pressure"}});
    EXPECT_TRUE(found);
    return *found;
  }

  static inline const std::filesystem::path kTire =
      std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/tires/race_16x7.5-10.toml";
  ScratchFolder folder_;
  Language language_ = language();
  const SpecimenKind& kind_ = *language_.find_kind("fe_tire");
};

TEST_F(ANewTestOfTheTire, RunsWithItsSlopes) {
  const Channels aspect = run("kind = \"aspect\"\n", {"aspect"});
  const Channels size = run("kind = \"inflation\"\n", {"outer_radius", "section_width"});
  const double width = size["section_width"][0], radius = size["outer_radius"][0];
  EXPECT_DOUBLE_EQ(aspect["aspect"][0], width / radius);
  const auto slope = [](const Channels& of, const char* name) {
    return of.find(name)->slopes.at(0);
  };
  const double expected =
      (slope(size, "section_width") - width / radius * slope(size, "outer_radius")) / radius;
  EXPECT_NEAR(slope(aspect, "aspect"), expected, 1e-12 * std::abs(expected));
  EXPECT_NE(expected, 0.0);
}

TEST_F(ANewTestOfTheTire, HasNoSlopeInThePressureThatItStates) {
  const Channels aspect = run("kind = \"aspect\"\npressure = \"1 bar\"\n", {"aspect"});
  EXPECT_EQ(aspect.find("aspect")->slopes.at(0), 0.0);
}

TEST_F(ANewTestOfTheTire, IsRefusedByOtherTires) {
  write_text_file(folder_ / "test.toml", "kind = \"aspect\"\n");
  const auto test = language_.read_test(folder_ / "test.toml");
  EXPECT_TRUE(can(kind_, *test));
  EXPECT_FALSE(can(*language_.find_kind("rigid_ring"), *test));
}

}  // namespace

const TestKind kAspectTest = {
    "aspect", "is inflated: width over radius", {IsFeTire::kName}, read_aspect};

}  // namespace latsch::experiment
