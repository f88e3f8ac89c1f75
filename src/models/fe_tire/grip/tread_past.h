// SPDX-License-Identifier: Apache-2.0
// Earlier states of the points of a tread, for friction that changes in time.
//
// Material at point k of a line was at point k - 1 the time Delta t_k before, so that (F.1) in time
// reads
//   t'_k(t) = t_{k-1}(t - Delta t_k)
//             - epsilon_t [x_k(t) - x_{k-1}(t - Delta t_k) - V_g Delta t_k].                  (F.5)
// The values at t - Delta t_k are those of the parabola through three instants, of which the latest
// may be the unknown one, now; where a point was not in contact at all three,
// those of the straight line between the two instants around. In a steady state (F.5) is (F.1) to
// rounding, whatever the step of time, and there is no interpolation along the line, which would
// smear tractions.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <vector>

#include "models/fe_tire/grip/rolling_grip.h"

namespace latsch::fe_tire {

class TreadPast {
 public:
  /// All points of the tread at one instant.
  struct Instant {
    Eigen::Matrix3Xd x;  // m, place along the ground and height over it (TreadBody)
    Eigen::Matrix2Xd t;  // Pa, 0 off the ground
  };
  /// Begins with a state that was steady up to the time 0. Instants are kept for `longest`, s, at
  /// least.
  TreadPast(Instant steady, double longest);

  /// Adds the instant that follows the latest one by `step`, s.
  void add(Instant next, double step);
  /// Returns what the points before the listed ones were, seen `step`, s, after the latest instant.
  /// Points are those of the tread, line after line; `lines` has their times.
  Upstream upstream(const std::vector<int>& points, const RollingLines& lines, double step) const;

 private:
  double longest_;
  std::deque<Instant> instants_;  // the latest first
  std::deque<double> times_;      // s
};

}  // namespace latsch::fe_tire
