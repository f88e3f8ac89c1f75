// SPDX-License-Identifier: Apache-2.0
// kind = "uniformity" (rigs/uniformity_rig.h): the variation of a tire's forces over a turn.
#include <fmt/format.h>

#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/rigs/slip/lift_watch.h"
#include "experiment/rigs/uniformity_rig.h"
#include "experiment/rigs/wheel_scheme.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

class Uniformity : public Test, public TellsLimits {
 public:
  explicit Uniformity(const UniformityTest& test) : test_(test) {}

  std::string in_words() const override {
    return fmt::format(
        "uniformity, {:.4g} N, {:.4g} m/s{}{}",
        test_.load,
        test_.speed,
        inflated(test_.pressure),
        test_.diameter > 0.0 ? fmt::format(", drum of {:.4g} m", test_.diameter) : "");
  }

  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    for (const auto& [name, value] : values_of({})) channels.push_back({name, "N"});
    return channels;
  }

  std::vector<std::string> needs() const override { return kUniformityTest.needs; }
  std::optional<long> samples() const override { return 1; }

  std::vector<std::string> limits(Specimen& specimen) const override {
    const auto* knows = specimen.find<KnowsLimits>();
    return knows ? knows->limits_backward() : std::vector<std::string>();
  }
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override {
    auto notes = Test::run_in_blocks(specimen, tell);
    if (!notes) return notes;
    for (std::string& limit : limits(specimen)) notes->push_back(std::move(limit));
    return notes;
  }

  Result<Channels> run(Specimen& specimen) const override {
    LiftLog lifts;
    if (specimen.find<IsFeTire>())
      return Failure{
          "a finite-element tire is the same all around, so it has no variation of forces: "
          "expected "
          "a model with irregularities, as a flexible ring has"};
    const auto tire = watched(specimen.find<Rolls>()->tire(test_.pressure), lifts);
    const auto found = experiment::run(*tire, test_);
    if (!found) return found.failure();
    record_limit(specimen, lifts.sentence());
    Channels recorded;
    for (const auto& [name, value] : values_of(*found)) recorded.add({name, "N", {value}});
    return recorded;
  }

 private:
  static std::vector<std::pair<std::string, double>> values_of(const UniformityRecord& of) {
    return {{"load", of.load},
            {"radial_force_variation", of.radial.all},
            {"lateral_force_variation", of.lateral.all},
            {"tangential_force_variation", of.tangential.all},
            {"radial_first_harmonic", of.radial.first},
            {"lateral_first_harmonic", of.lateral.first},
            {"tangential_first_harmonic", of.tangential.first},
            {"conicity", of.conicity},
            {"ply_steer", of.ply_steer}};
  }

  UniformityTest test_;
};

std::unique_ptr<Test> read_uniformity(const Node& root, const TestSource& source) {
  return std::make_unique<Uniformity>(read_uniformity_test(root, source.measured));
}

}  // namespace

const KeySection& uniformity_keys();

const TestKind kUniformityTest = {
    "uniformity",
    "uniformity machine: force variations over a turn, conicity, ply steer",
    {Rolls::kName},
    read_uniformity,
    uniformity_keys,
    kWheelScheme};

}  // namespace latsch::experiment
