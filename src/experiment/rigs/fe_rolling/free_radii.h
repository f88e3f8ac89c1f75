// SPDX-License-Identifier: Apache-2.0
// Effective radius of a freely rolling tire, R_e = V_x/Omega, over load, speed and camber: the
// reference of the slip kappa in a record in which these change.
//
// R_e is found at a grid of free wheels and is a polynomial between them: through the Chebyshev
// points cos(pi k/(n - 1)) of each quantity's range, of which a wider range has more. A quantity
// that does not change has one. kappa = 1e-4 is 1 % of the load and more, so R_e counts to 1e-5.
#pragma once

#include <cstddef>
#include <vector>

#include "experiment/rigs/fe_tire/rolling_rig.h"

namespace latsch::experiment {

class FreeRadii {
 public:
  /// Chooses the free wheels for the ranges of these rows, of which there is at least one.
  explicit FreeRadii(const std::vector<RollingRow>& rows);

  /// The free wheels whose R_e is needed, one row each.
  const std::vector<RollingRow>& wheels() const { return wheels_; }
  /// Sets R_e of every wheel, m.
  void set(std::vector<double> radii) { radii_ = std::move(radii); }
  /// Returns R_e, m, within the ranges of the rows.
  double at(double load, double speed, double camber) const;

 private:
  std::vector<double> loads_, speeds_, cambers_;
  std::vector<RollingRow> wheels_;  // loads vary first, cambers last
  std::vector<double> radii_;
};

}  // namespace latsch::experiment
