// SPDX-License-Identifier: Apache-2.0
// Mass and moments of inertia of a tire: rubber and cords, neither rim nor air.
//
//   kind = "mass_properties"
//   pressure = "2.6 bar"             # inflation widens the tire by some 0.1 to 1 %; the tire's own
//                                    # unless given (inflation.h)
//
// Channels of one value: "mass" (kg), "spin_inertia" and "diametral_inertia" (kg m^2), about the
// spin axis and about a diameter of the wheel's center plane. The rim has to be subtracted from
// measurements with a rim. Each channel is an objective by kind = "values", with slopes in
// densities, thicknesses, cord areas and all other numbers in which a tire knows slopes.
#include <fmt/format.h>

#include "experiment/language/capabilities.h"
#include "experiment/language/test.h"

namespace latsch::experiment {

extern const TestKind kMassProperties;
namespace {

class MassPropertiesTest : public Test {
 public:
  explicit MassPropertiesTest(const MassTest& test) : test_(test) {}

  std::string in_words() const override { return "mass properties" + inflated(test_.pressure); }
  std::vector<ChannelInfo> channels() const override {
    return {{"mass", "kg"}, {"spin_inertia", "kg m^2"}, {"diametral_inertia", "kg m^2"}};
  }
  std::vector<std::string> needs() const override { return kMassProperties.needs; }
  std::optional<long> samples() const override { return 1; }

  Result<Channels> run(Specimen& specimen) const override { return run_with_slopes(specimen, {}); }
  bool tells_slopes(const SpecimenKind&, const std::string&) const override { return true; }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    const auto weighed = specimen.find<IsWeighed>()->weigh(test_, asked);
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

const TestKind kMassProperties = {"mass_properties",
                                  "is weighed and swung: mass, moments of inertia",
                                  {IsWeighed::kName},
                                  read_mass_properties};

}  // namespace latsch::experiment
