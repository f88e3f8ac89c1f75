// SPDX-License-Identifier: Apache-2.0
// Dimensions of a tire that is inflated on its rim, off the ground.
//
// Channels, one value for each pressure in the order of the file: "pressure" (Pa), "outer_radius"
// (m, half of the outside diameter), "section_width" (m, from sidewall to sidewall), and "growth"
// (m), the outward displacement of the middle of the tread relative to zero pressure. Growth is
// mostly the stretch of belt and carcass: it identifies their moduli, on which frequencies hardly
// depend.
//
// With `speed` the tire spins, its growth includes that by rotation, and "spin" (rad/s) is
// recorded.
//
// The keys are in experiment/tests/keys/inflation_keys.cpp.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/units.h"
#include "experiment/language/capabilities.h"
#include "experiment/rigs/fe_tire/channel_slopes.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

/// A test that determines the dimensions of the inflated tire without contact.
struct InflatedSizeTest {
  std::vector<double> pressures = {};   // Pa, gauge; none: the tire's own
  std::optional<SpinSpeed> speed = {};  // none: at rest
};

Result<Channels> inflate(TireRig& rig, const InflatedSizeTest& test, fe_tire::TireSlopes* slopes) {
  std::vector<double> pressures = test.pressures;
  if (pressures.empty()) pressures.push_back(rig.own_pressure());
  Channel pressure{"pressure", "Pa", pressures}, radius{"outer_radius", "m", {}};
  Channel width{"section_width", "m", {}}, growth{"growth", "m", {}};
  Channel spin{"spin", "rad/s", {}};
  const auto variables = slopes ? slopes->variables() : 0;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(std::ssize(pressures), variables);
  Eigen::MatrixXd by_pressure = none, by_radius = none, by_width = none, by_growth = none;
  for (std::size_t i = 0; i < pressures.size(); ++i) {
    const auto inflated =
        test.speed ? rig.spinning(pressures[i], *test.speed) : rig.inflated(pressures[i]);
    if (!inflated) return inflated.failure();
    spin.values.push_back(inflated->spin);
    radius.values.push_back(inflated->radius);
    width.values.push_back(inflated->width);
    growth.values.push_back(inflated->growth);
    if (!slopes) continue;
    const auto of = slopes->of_inflated(*inflated);
    if (!of) return of.failure();
    const auto row = static_cast<Eigen::Index>(i);
    by_radius.row(row) = of->radius;
    by_width.row(row) = of->width;
    by_growth.row(row) = of->growth;
    by_pressure.row(row) = of->pressure;
  }
  Channels channels;
  for (Channel* channel : {&pressure, &radius, &width, &growth}) channels.add(std::move(*channel));
  if (test.speed) channels.add(std::move(spin));
  if (!slopes) return channels;
  return with_slopes(channels,
                     {{"pressure", by_pressure},
                      {"outer_radius", by_radius},
                      {"section_width", by_width},
                      {"growth", by_growth}});
}

std::string range_in_words(const std::vector<double>& pressures) {
  if (pressures.empty()) return "";
  const auto [least, most] = std::minmax_element(pressures.begin(), pressures.end());
  const std::string from = format_quantity(*least, "bar", 4);
  return *least == *most ? from : from + " to " + format_quantity(*most, "bar", 4);
}

class InflationTest : public Test {
 public:
  explicit InflationTest(InflatedSizeTest test) : test_(std::move(test)) {}

  std::string in_words() const override {
    const std::string under = conditions();
    return under.empty() ? "inflation" : "inflation, " + under;
  }
  std::string conditions() const override {
    const std::string pressures = range_in_words(test_.pressures);
    if (!test_.speed) return pressures;
    return (pressures.empty() ? "" : pressures + ", ") + "spinning at " +
           speed_in_words(*test_.speed);
  }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels = {
        {"pressure", "Pa"}, {"outer_radius", "m"}, {"section_width", "m"}, {"growth", "m"}};
    if (test_.speed) channels.push_back({"spin", "rad/s"});
    return channels;
  }
  std::vector<std::string> needs() const override { return kInflationTest.needs; }
  std::optional<Reach> reach(const std::string& channel) const override {
    if (channel != "pressure" || test_.pressures.empty()) return std::nullopt;
    const auto [least, most] = std::minmax_element(test_.pressures.begin(), test_.pressures.end());
    return Reach{*least, *most};
  }
  std::optional<long> samples() const override {
    return std::max<long>(1, std::ssize(test_.pressures));
  }

  Result<Channels> run(Specimen& specimen) const override { return run_with_slopes(specimen, {}); }
  /// Derivatives are not known for a rotating tire.
  bool tells_slopes(const SpecimenKind&, const std::string&) const override { return !test_.speed; }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    const auto measured = specimen.find<IsFeTire>()->drive(
        [this](TireRig& rig, fe_tire::TireSlopes* slopes) {
          return inflate(rig, test_, test_.speed ? nullptr : slopes);
        },
        !test_.pressures.empty(),
        asked);
    if (!measured) return measured;
    return with_slopes_of(asked.channels, *measured);
  }

 private:
  InflatedSizeTest test_;
};

std::unique_ptr<Test> read_inflation(const Node& root, const TestSource& source) {
  InflatedSizeTest test;
  if (const auto from = find_measured(root, "pressures"))
    test.pressures = measured_values(*from, {"pressure", "Pa"}, source.measured);
  else if (root.has("pressures"))
    test.pressures = root.quantities("pressures", "Pa", Range::positive());
  if (root.has("speed")) test.speed = read_spin_speed(root);
  return std::make_unique<InflationTest>(std::move(test));
}

}  // namespace

const KeySection& inflation_keys();

const TestKind kInflationTest = {"inflation",
                                 "is inflated: outer radius, section width, growth",
                                 {IsFeTire::kName},
                                 read_inflation,
                                 inflation_keys};

}  // namespace latsch::experiment
