// SPDX-License-Identifier: Apache-2.0
// kind = "modes": vibration modes of a tire with its rim held, off the ground or standing on it.
//
// A tire in the air may spin, and its rim may move:
//
//   speed = "100 km/h"               # or "90 rad/s"; at rest unless given
//   rim = "free"                     # "held" unless given; [rim] of the tire file describes it
//   standing_wave = true             # compute the standing-wave speed, too
//
// Channels, one value for each mode: "frequency" (Hz), and "n", "type" and "phase" as
// numbers (rigs/mode_record.h); "shape" at the points; "damping" (of critical) if the model has it;
// on the ground one value of "deflection", "loaded_radius" (m) and "force" (N) if the model
// computes them. If the tire spins or its rim moves: rigs/fe_tire/spinning_rig.cpp.
//
// The keys are in experiment/tests/keys/modes_keys.cpp.
#pragma once

#include "experiment/language/known_limits.h"
#include "experiment/language/test.h"
#include "experiment/rigs/load_case.h"

namespace latsch::experiment {

/// Number of additional modes, so that each measured mode finds its neighbors in frequency.
constexpr long kMoreModesThanMeasured = 8;

class ModesTest : public Test, public TellsLimits {
 public:
  explicit ModesTest(ModalTest settings) : test_(std::move(settings)) {}

  std::string in_words() const override;
  std::string conditions() const override;
  std::vector<ChannelInfo> channels() const override;
  std::vector<std::string> needs() const override;
  std::shared_ptr<const Test> with_points(const Eigen::Matrix3Xd& points) const override;
  Result<Channels> run(Specimen& specimen) const override;
  /// The identifiers of a mode and its shape have no derivatives.
  bool tells_slopes(const SpecimenKind&, const std::string& channel) const override {
    return test_.ground.mu == 0.0 && test_.camber == 0.0 && !test_.moves() && !test_.is_damped &&
           channel != "n" && channel != "type" && channel != "phase" && channel != "shape";
  }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override;
  /// Says that the modes are those of relaxed moduli if the tire's file states losses.
  std::vector<std::string> limits(Specimen& specimen) const override;
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override;

 private:
  RigSettings rig_settings() const override { return &test_; }

  ModalTest test_;
};

/// Returns whether the specimen is a finite-element tire and its file states `prony` or
/// `loss_factor` of a rubber or a layer, so that its modes have damping.
bool has_losses(Specimen& specimen);

/// Returns "unloaded", "pressed 25 mm", "under 4000 N", with the camber.
std::string state_in_words(const ModalTest& test);

/// Returns rows of x, y, z (m) as points [3 x points].
Eigen::Matrix3Xd rows_as_points(const std::vector<std::vector<double>>& rows);

}  // namespace latsch::experiment
