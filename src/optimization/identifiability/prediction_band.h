// SPDX-License-Identifier: Apache-2.0
// How uncertain a computed value is that follows from fitted variables: one that was fitted, or one
// that is only predicted.
//
// y(u) with the derivatives g = dy/du at a fitted point; in linear approximation, with the letters
// of confidence.h,
//   var y = g' C g                          the delta method
//   y +- (t sqrt(g' C g) + |g' d|)          95 % band
//   y +- sqrt(band^2 + (t sigma_y)^2)       where a measured value lies, whose noise is sigma_y
// [Bates, Watts, Nonlinear Regression Analysis and Its Applications, 1988, p. 58]. The band of
// y = u_i is the interval of u_i, inside the cube. Where intervals know more than C, bands do too:
//   - a direction v_k along which the interval covers all of the cube is open: it takes no part in
//     C, and y moves by g' v_k as far as the cube reaches along v_k;
//   - a variable held at its bound moves inward, the others following by their refit, as far as its
//     one-sided interval reaches: so far the band reaches to one side;
//   - y moves no further than anywhere in the cube.
// These ways are summed up, which is the widest they can be together.
//
// Limits: it is of one value, not of all values of a curve at once. It is linear: along an open
// direction, over all of the cube, that is a guess. Where neighbors share noise, t is the largest
// of the variables' intervals.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimization/identifiability/confidence.h"

namespace latsch {

/// Beside the value at the point.
struct PredictionBand {
  double lower = 0.0, upper = 0.0;  // <= 0, >= 0
  int open = -1;  // the open direction, a column of FreeDirections::axes, that makes up the most of
                  // it, a tenth at least; -1: none does
  int held = -1;  // the same of the variables that are held at a bound
};

class PredictionBands {
 public:
  /// Of a linearization at u; its sigma is a number.
  PredictionBands(const Eigen::VectorXd& u, const Confidence& confidence);

  PredictionBand of(const Eigen::VectorXd& g) const;

 private:
  /// How far the cube reaches from u along a direction of it.
  struct Reach {
    double lower = 0.0, upper = 0.0;  // <= 0, >= 0

    Reach times(double factor) const;
    double width() const { return upper - lower; }
    void operator+=(const Reach& other);
  };
  Reach reach(const Eigen::VectorXd& g) const;

  Eigen::VectorXd u_;
  FreeDirections free_;      // 0 for those that are open
  std::vector<Reach> open_;  // of every direction; 0 of one that is not open
  std::vector<Reach> held_;  // of every variable; 0 of one that is not held
};

}  // namespace latsch
