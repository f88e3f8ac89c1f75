// SPDX-License-Identifier: Apache-2.0
// Computes the uncertainty of a value that is computed from fitted variables. The value may have
// been fitted or only predicted.
//
// y(u) has the derivatives g = dy/du at a fitted point. In linear approximation, with the letters
// of confidence.h,
//   var y = g' C g                          the delta method
//   y +- (t sqrt(g' C g) + |g' d|)          95 % band
//   y +- sqrt(band^2 + (t sigma_y)^2)       range of a measured value whose noise is sigma_y
// [Bates, Watts, Nonlinear Regression Analysis and Its Applications, 1988, p. 58]. The band of y =
// u_i is the interval of u_i, inside the cube. Where the intervals include other contributions than
// C, the bands include them, too:
//   - a direction v_k along which the interval covers all of the cube is open: it is left out of
//     C, and y moves by g' v_k times the extent of the cube along v_k;
//   - a variable held at its bound moves inward to the end of its one-sided interval, and the
//     others follow by their refit: this widens the band to one side;
//   - y moves no further than it can move within the cube.
// These contributions are added, which is the widest they can be together.
//
// Limits: the band is that of one value, not of all values of a curve at once. It is linear, which
// is a guess along an open direction, because that direction covers all of the cube. If neighbors
// share noise, t is the largest of the variables' intervals.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimization/identifiability/confidence.h"

namespace latsch {

/// The band of a value: its deviations from the value at the point.
struct PredictionBand {
  double lower = 0.0, upper = 0.0;  // <= 0, >= 0
  /// The open direction (a column of FreeDirections::axes) that contributes most to the band, and
  /// at least a tenth of it; -1: none.
  int open = -1;
  /// The variable held at a bound that contributes most to the band, and at least a tenth of it;
  /// -1: none.
  int held = -1;
};

/// Computes bands of values that depend on the variables, for one confidence.
class PredictionBands {
 public:
  /// Uses the confidence at the point u; its sigma must not be NaN.
  PredictionBands(const Eigen::VectorXd& u, const Confidence& confidence);

  /// Returns the band of a value with the gradient g with respect to the unit cube.
  PredictionBand of(const Eigen::VectorXd& g) const;

 private:
  /// The changes of a value if the point moves from u along a direction to the faces of the cube.
  struct Reach {
    double lower = 0.0, upper = 0.0;  // <= 0, >= 0

    Reach times(double factor) const;
    double width() const { return upper - lower; }
    void operator+=(const Reach& other);
  };
  Reach reach(const Eigen::VectorXd& g) const;

  Eigen::VectorXd u_;
  FreeDirections free_;      // directions of the free variables; open directions are set to 0
  std::vector<Reach> open_;  // change along each direction; 0 if the direction is not open
  std::vector<Reach> held_;  // change of the value by each held variable; 0 for all others
};

}  // namespace latsch
