// SPDX-License-Identifier: Apache-2.0
// Mass and moments of inertia of a tire: rubber and cords, neither rim nor air.
//
// Channels of one value: "mass" (kg), "spin_inertia" and "diametral_inertia" (kg m^2), about the
// spin axis and about a diameter of the wheel's center plane. The rim has to be subtracted from
// measurements with a rim. Each channel is an objective by kind = "values", with slopes in
// densities, thicknesses, cord areas and all other numbers in which a tire knows slopes.
//
// The keys are in experiment/tests/keys/mass_properties_keys.cpp.
#include <fmt/format.h>

#include "experiment/language/capabilities.h"
#include "experiment/rigs/fe_tire/channel_slopes.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

/// Mass and moments of inertia without the rim, but inflated as on the rim.
struct MassTest {
  Inflation pressure = {};
};

Result<Channels> weigh(TireRig& rig, const MassTest& test, fe_tire::TireSlopes* slopes) {
  const auto& inflated = rig.inflated(test.pressure.value_or(rig.own_pressure()));
  if (!inflated) return inflated.failure();
  const fe_tire::MassProperties of = rig.tire().mass_properties(*inflated);
  Channels channels;
  channels.add({"mass", "kg", {of.mass}});
  channels.add({"spin_inertia", "kg m^2", {of.spin_inertia}});
  channels.add({"diametral_inertia", "kg m^2", {of.diametral_inertia}});
  if (!slopes) return channels;
  const auto by = slopes->of_mass(*inflated);
  if (!by) return by.failure();
  return with_slopes(channels,
                     {{"mass", by->mass.transpose()},
                      {"spin_inertia", by->spin_inertia.transpose()},
                      {"diametral_inertia", by->diametral_inertia.transpose()}});
}

class MassPropertiesTest : public Test {
 public:
  explicit MassPropertiesTest(const MassTest& test) : test_(test) {}

  std::string in_words() const override { return "mass properties" + inflated(test_.pressure); }
  std::vector<ChannelInfo> channels() const override {
    return {{"mass", "kg"}, {"spin_inertia", "kg m^2"}, {"diametral_inertia", "kg m^2"}};
  }
  std::vector<std::string> needs() const override { return kMassPropertiesTest.needs; }
  std::optional<long> samples() const override { return 1; }

  Result<Channels> run(Specimen& specimen) const override { return run_with_slopes(specimen, {}); }
  bool tells_slopes(const SpecimenKind&, const std::string&) const override { return true; }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    const auto weighed = specimen.find<IsFeTire>()->drive(
        [this](TireRig& rig, fe_tire::TireSlopes* slopes) { return weigh(rig, test_, slopes); },
        test_.pressure.has_value(),
        asked);
    if (!weighed) return weighed;
    return with_slopes_of(asked.channels, *weighed);
  }

 private:
  MassTest test_;
};

std::unique_ptr<Test> read_mass_properties(const Node& root, const TestSource& source) {
  root.choice("kind", {"mass_properties"});
  return std::make_unique<MassPropertiesTest>(MassTest{read_pressure(root, source.measured)});
}

}  // namespace

const KeySection& mass_properties_keys();

const TestKind kMassPropertiesTest = {"mass_properties",
                                      "is weighed and swung: mass, moments of inertia",
                                      {IsFeTire::kName},
                                      read_mass_properties,
                                      mass_properties_keys};

}  // namespace latsch::experiment
