// SPDX-License-Identifier: Apache-2.0
// Trials that show whether residuals that scatter around their model are noisy, or curved.
//
// A model of slopes over moves that change the residuals by their own size cannot tell noise from
// curvature. Over a tenth of these moves curvature makes a hundredth of the error, wrong slopes a
// tenth, and noise as much as before. Up to three points at that distance, in random directions,
// are compared with the slopes. The residuals are noisy if one of them is off by a tenth of the
// noise that the model claims, and not if all three are closer.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "optimization/least_squares/open_variables.h"
#include "optimization/trust_region/natural_frame.h"
#include "optimization/trust_region/trust_box.h"

namespace latsch {

/// Noise that a verification claims at a sample: the norm that it gives the residuals, the slopes
/// there, and the moves over which both were found.
struct ClaimedNoise {
  double norm = 0.0;
  PointSlopes slopes;
  NaturalFrame frame;
};

class NoiseCheck {
 public:
  /// Checks the noise around the center of the box.
  explicit NoiseCheck(const TrustBox& box, const ClaimedNoise& claimed);

  /// Returns the next trial; nullopt if its outcome must arrive first, or if the check has ended.
  std::optional<Wanted> next(TrustBox& box);
  /// Receives the residuals of a trial; nullopt for a failure, which says nothing.
  void observe(const Eigen::VectorXd& u, const std::optional<Eigen::VectorXd>& r);

  bool is_confirmed() const { return is_confirmed_; }
  /// True if all trials are closer to the slopes than the claimed noise allows.
  bool is_refuted() const { return !is_confirmed_ && near_ == kMost; }

 private:
  static constexpr int kMost = 3;

  ClaimedNoise claimed_;
  Eigen::VectorXd u_, r_;
  std::optional<Eigen::VectorXd> awaited_;
  int tried_ = 0;
  int near_ = 0;  // trials that are as near to the slopes as without noise
  bool is_confirmed_ = false;
};

}  // namespace latsch
