// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/load_deflection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/document_record.h"
#include "base/units.h"
#include "experiment/language/capabilities.h"
#include "experiment/rigs/fe_rolling/ground_friction.h"
#include "experiment/rigs/static_stiffness.h"
#include "experiment/tests/test_kinds.h"
#include "models/road/plane_road.h"
#include "models/tire/tared_tire.h"

namespace latsch::experiment {
namespace {

/// Presses a rolling tire that does not roll in this test: every state is settled separately.
Result<Channels> press_rolling(Tire& tire, const LoadDeflection& test) {
  if (test.ground.mu != 0.0)
    throw InputError("a tire that rolls has friction in its own file: expected a test without it");
  Channel deflection{"deflection", "m", test.deflections}, radius{"loaded_radius", "m", {}};
  Channel force{"force", "N", {}};
  for (const double r : test.loaded_radii) deflection.values.push_back(tire.free_radius() - r);
  for (const double d : deflection.values) {
    radius.values.push_back(tire.free_radius() - d);
    const Result<double> load = d > 0.0 ? load_at(tire, d) : 0.0;
    if (!load) return load.failure();
    force.values.push_back(*load);
  }
  Channels channels;
  for (Channel* channel : {&deflection, &radius, &force}) channels.add(std::move(*channel));
  return channels;
}

}  // namespace

std::vector<std::string> limits_of_standing(Specimen& specimen, double of_test) {
  std::vector<std::string> limits;
  auto* tire = specimen.find<IsFeTire>();
  if (!tire) return limits;
  (void)tire->drive(
      [&](TireRig& rig, fe_tire::TireSlopes*) -> Result<Channels> {
        if (std::string words = friction_at_rest_in_words(rig, of_test); !words.empty())
          limits.push_back(std::move(words));
        return Channels();
      },
      true,
      {});
  return limits;
}

fe_tire::Ground read_ground(const Node& table) {
  fe_tire::Ground ground;
  ground.mu = table.quantity("friction", "1", Range::between(0.0, 5.0), 0.0);
  return ground;
}

std::string conditions_in_words(const Inflation& pressure, const fe_tire::Ground& ground) {
  std::string text = pressure ? format_quantity(*pressure, "bar", 4) : "";
  if (ground.mu > 0.0)
    text += fmt::format("{}friction {:.3g}", text.empty() ? "" : ", ", ground.mu);
  return text;
}

std::string LoadDeflectionTest::in_words() const {
  const bool radii = !test_.loaded_radii.empty();
  const std::string conditions = conditions_in_words(test_.pressure, test_.ground);
  return fmt::format("load-deflection{}{}, {} {}",
                     test_.pressure       ? " at "
                     : conditions.empty() ? ""
                                          : ", ",
                     conditions,
                     radii ? test_.loaded_radii.size() : test_.deflections.size(),
                     radii ? "loaded radii" : "deflections");
}

std::string LoadDeflectionTest::conditions() const {
  return conditions_in_words(test_.pressure, test_.ground);
}

std::vector<ChannelInfo> LoadDeflectionTest::channels() const {
  return {{"force", "N"},
          {"deflection", "m"},
          {"loaded_radius", "m"},
          {"patch_length", "m"},
          {"patch_width", "m"},
          {"patch_area", "m^2"}};
}

std::vector<std::string> LoadDeflectionTest::needs() const {
  if (test_.ground.mu > 0.0) return {TakesConditions::kName};
  return kLoadDeflectionTest.needs;
}

std::optional<Reach> LoadDeflectionTest::reach(const std::string& channel) const {
  const auto& positions = channel == "deflection"      ? test_.deflections
                          : channel == "loaded_radius" ? test_.loaded_radii
                                                       : std::vector<double>{};
  if (positions.empty()) return std::nullopt;
  const auto [least, most] = std::minmax_element(positions.begin(), positions.end());
  return Reach{*least, *most};
}

std::optional<long> LoadDeflectionTest::samples() const {
  return std::ssize(test_.deflections) + std::ssize(test_.loaded_radii);
}

bool LoadDeflectionTest::tells_slopes(const SpecimenKind& kind, const std::string&) const {
  return test_.ground.mu == 0.0 && kind.has(IsPressed::kName);
}

Result<Channels> LoadDeflectionTest::run(Specimen& specimen) const {
  return run_with_slopes(specimen, {});
}

Result<Channels> LoadDeflectionTest::run_with_slopes(Specimen& specimen, const Asked& asked) const {
  if (auto* pressed = specimen.find<IsPressed>()) return pressed->press(test_, asked);
  const auto pressed = press_rolling(*tared(specimen.find<Rolls>()->tire(test_.pressure)), test_);
  if (pressed) stood_under(specimen, (*pressed)["force"]);
  return pressed;
}

std::vector<std::string> LoadDeflectionTest::limits(Specimen& specimen) const {
  return limits_of_standing(specimen, test_.ground.mu);
}

Result<std::vector<std::string>> LoadDeflectionTest::run_in_blocks(
    Specimen& specimen, const std::function<void(const Channels&)>& tell) const {
  auto notes = Test::run_in_blocks(specimen, tell);
  if (!notes) return notes;
  for (std::string& limit : limits(specimen)) notes->push_back(std::move(limit));
  return notes;
}

namespace {

std::unique_ptr<Test> read_load_deflection(const Node& root, const TestSource& source) {
  LoadDeflection test;
  test.pressure = read_pressure(root, source.measured);
  test.ground = read_ground(root);
  if (const auto from = find_measured(root, "deflections"))
    test.deflections = measured_values(*from, {"deflection", "m"}, source.measured);
  else if (root.has("deflections"))
    test.deflections = root.quantities("deflections", "m", Range::positive());
  if (const auto from = find_measured(root, "loaded_radii"))
    test.loaded_radii = measured_values(*from, {"loaded_radius", "m"}, source.measured);
  else if (root.has("loaded_radii"))
    test.loaded_radii = root.quantities("loaded_radii", "m", Range::positive());
  if (test.deflections.empty() == test.loaded_radii.empty())
    root.reject("deflections", "or loaded_radii is required, exactly one of the two");
  return std::make_unique<LoadDeflectionTest>(std::move(test));
}

std::unique_ptr<Test> load_deflection_as_measured(const Node&,
                                                  const MeasuredAbscissa& measured,
                                                  DocumentRecord& keys) {
  LoadDeflection test;
  test.pressure = read_pressure(keys.node());
  test.ground = read_ground(keys.node());
  test.deflections = measured.deflections;
  test.loaded_radii = measured.loaded_radii;
  if (!test.deflections.empty()) keys.put("deflections", canonical(test.deflections, "m"));
  if (!test.loaded_radii.empty()) keys.put("loaded_radii", canonical(test.loaded_radii, "m"));
  return std::make_unique<LoadDeflectionTest>(std::move(test));
}

}  // namespace

const KeySection& load_deflection_keys();

const TestKind kLoadDeflectionTest = {"load_deflection",
                                      "is pressed on the ground: force, patch",
                                      {IsPressed::kName, Rolls::kName},
                                      read_load_deflection,
                                      load_deflection_keys,
                                      "",
                                      load_deflection_as_measured};

}  // namespace latsch::experiment
