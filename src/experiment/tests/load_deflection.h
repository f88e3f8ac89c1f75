// SPDX-License-Identifier: Apache-2.0
// kind = "load_deflection": vertical force over deflection or loaded radius.
//
// Channels, one value for each position in the order of the file: "deflection", "loaded_radius"
// (m), "force" (N), and for a tire that computes its patch "patch_length", "patch_width" (m),
// "patch_area" (m^2). A loaded radius larger than that of the tire means no contact: all are 0. The
// tire is pressed once through all positions, deeper and deeper: with friction the path is part of
// the result.
//
// The keys are in experiment/tests/keys/load_deflection_keys.cpp.
#pragma once

#include "experiment/language/known_limits.h"
#include "experiment/language/test.h"
#include "experiment/rigs/load_case.h"

namespace latsch::experiment {

class LoadDeflectionTest : public Test, public TellsLimits {
 public:
  explicit LoadDeflectionTest(LoadDeflection settings) : test_(std::move(settings)) {}

  std::string in_words() const override;
  std::string conditions() const override;
  std::vector<ChannelInfo> channels() const override;
  std::vector<std::string> needs() const override;
  std::optional<Reach> reach(const std::string& channel) const override;
  std::optional<long> samples() const override;
  Result<Channels> run(Specimen& specimen) const override;
  /// Only a finite-element tire has derivatives, a rolling tire has none.
  bool tells_slopes(const SpecimenKind& kind, const std::string& channel) const override;
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override;
  /// Says which friction the tire stands on if its file has a law for rolling.
  std::vector<std::string> limits(Specimen& specimen) const override;
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override;

 private:
  RigSettings rig_settings() const override { return &test_; }

  LoadDeflection test_;
};

/// Says which friction a tire stands on whose file has a law by pressure or sliding speed, which is
/// that of rolling; `of_test` is the test's friction. Empty for other specimens.
std::vector<std::string> limits_of_standing(Specimen& specimen, double of_test);
/// Reads `friction` of a test on the ground. Throws InputError.
fe_tire::Ground read_ground(const Node& table);
/// Returns "2.6 bar, friction 0.8", "" if neither is stated.
std::string conditions_in_words(const Inflation& pressure, const fe_tire::Ground& ground);

}  // namespace latsch::experiment
