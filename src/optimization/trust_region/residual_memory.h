// SPDX-License-Identifier: Apache-2.0
// Stores all outcomes of a vector of residuals: samples, whoever proposed them, and failed regions.
//
// A point that failed, or at which the residuals exploded, is surrounded by a ball that is not
// entered again. The radius of the ball is a quarter of the distance to the nearest point that
// succeeded. A single failure thus excludes little, and a region of failures is closed off from all
// sides.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimization/least_squares/residual_kriging.h"
#include "optimization/problem/shared_history.h"
#include "optimization/region/failure_edges.h"
#include "optimization/trust_region/natural_frame.h"

namespace latsch {

struct ResidualSample {
  Eigen::VectorXd u;  // point in the unit cube
  Eigen::VectorXd r;
  Eigen::MatrixXd J;  // Jacobian dr/du; empty: not known
  double f;           // |r|^2
  int stand_ins = 0;  // number of stand-ins among the residuals (score.h)
};

class ResidualMemory {
 public:
  int size() const { return samples_.size(); }
  const ResidualSample& operator[](int i) const { return samples_[i]; }

  void add(ResidualSample sample);
  void add_failure(const Eigen::VectorXd& u);

  /// Returns the indices of the samples nearest to the sample `center`, as many as a quadratic has
  /// coefficients plus the number of variables. Samples that exploded or have another number of
  /// stand-ins are left out. Distances are measured in units of the half widths h of a box.
  std::vector<int> near(int center, const Eigen::VectorXd& h) const;
  /// Returns the limit above which the value of a sample counts as exploded, from the values near
  /// `center` and its own value.
  double explosion(int center, const Eigen::VectorXd& h) const;
  /// Returns the samples near `center` in coordinates z = (u - center) / h.
  ResidualSamples around(int center, const Eigen::VectorXd& h) const;
  /// Returns the samples in the neighborhood of `center` in coordinates y of the frame. Samples so
  /// near that their differences are only noise are left out.
  ResidualSamples around(int center, const NaturalFrame& frame) const;

  /// Returns the edges of failed regions around `center`, in (u - center) / widths.
  std::vector<Edge> edges(int center, const Eigen::VectorXd& widths) const;
  bool has_failed_near(const Eigen::VectorXd& u) const { return failure_near(u) >= 0; }
  /// Returns the index of the failure whose ball contains u; -1 if there is none.
  int failure_near(const Eigen::VectorXd& u) const;
  const Eigen::VectorXd& failure(int i) const { return failures_[i].u; }
  int failures() const { return static_cast<int>(failures_.size()); }
  /// Returns the radius of the ball to avoid around failure `i`.
  double avoided(int i) const;
  /// True if some sample differs from u by less than `distance` in every variable.
  bool knows(const Eigen::VectorXd& u, const Eigen::VectorXd& distance) const;

 private:
  /// Returns the indices of all samples except `center`, ordered by distance from it. The last
  /// result is stored, because it is requested repeatedly between two samples.
  const std::vector<int>& nearest(int center, const Eigen::VectorXd& h) const;

  struct FailedPoint {
    Eigen::VectorXd u;
    double success;  // distance to the nearest point that succeeded
  };

  SharedHistory<ResidualSample> samples_;
  std::vector<FailedPoint> failures_;
  mutable struct {
    int center = -1, size = 0;
    Eigen::VectorXd h;
    std::vector<int> indices;
  } nearest_;
};

}  // namespace latsch
