// SPDX-License-Identifier: Apache-2.0
// kind = "drum_cleat": a tire that rolls over a cleat on the drum (rigs/drum_rig.h has the keys).
#pragma once

#include "experiment/language/known_limits.h"
#include "experiment/language/test.h"
#include "experiment/rigs/drum_rig.h"

namespace latsch::experiment {

class DrumCleatTest : public Test, public TellsLimits {
 public:
  explicit DrumCleatTest(const DrumTest& settings) : test_(settings) {}

  std::string in_words() const override;
  std::vector<ChannelInfo> channels() const override;
  std::vector<std::string> needs() const override;
  std::optional<Reach> reach(const std::string& channel) const override;
  Result<Channels> run(Specimen& specimen) const override;
  std::vector<std::string> limits(Specimen& specimen) const override;
  /// The returned sentences state what the tire's model does not describe on the cleat and, for a
  /// finite-element tire, remarks on its passage.
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override;
  std::optional<Result<std::vector<ChannelConvergence>>> convergence(
      const SpecimenKind& kind, const Document& numbers) const override;

 private:
  /// Returns the limits that a run does not report by itself. A run reports ranges that it left.
  std::vector<std::string> limits_of_model(Specimen& specimen) const;
  RigSettings rig_settings() const override { return &test_; }

  DrumTest test_;
};

/// Reads a file that must be of this kind. Throws InputError.
DrumTest read_drum_cleat(const std::filesystem::path& file);

}  // namespace latsch::experiment
