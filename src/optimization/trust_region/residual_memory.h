// SPDX-License-Identifier: Apache-2.0
// All that is known of a vector of residuals: samples, whoever asked for them, and failed regions.
//
// A point that failed, or where the residuals exploded, makes a ball around it one to avoid, as
// wide as a quarter of its distance to the nearest point that succeeded: a single failure hides
// little, a region of them is closed off from all sides, and neither is ever entered twice.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimization/least_squares/residual_kriging.h"
#include "optimization/problem/shared_history.h"
#include "optimization/region/failure_edges.h"
#include "optimization/trust_region/natural_frame.h"

namespace latsch {

struct ResidualSample {
  Eigen::VectorXd u;  // in the unit cube
  Eigen::VectorXd r;
  Eigen::MatrixXd J;  // dr/du; empty: not known
  double f;           // |r|^2
  int stand_ins = 0;  // among the residuals (score.h)
};

class ResidualMemory {
 public:
  int size() const { return samples_.size(); }
  const ResidualSample& operator[](int i) const { return samples_[i]; }

  void add(ResidualSample sample);
  void add_failure(const Eigen::VectorXd& u);

  /// The samples nearest to one, as many as a quadratic has coefficients and as there are
  /// variables; without those that exploded or have other stand-ins. Distances are told by the half
  /// widths h of a box.
  std::vector<int> near(int center, const Eigen::VectorXd& h) const;
  /// From here on a value counts as exploded, beside those near `center` and its own.
  double explosion(int center, const Eigen::VectorXd& h) const;
  /// Those near `center` in z = (u - center) / h.
  ResidualSamples around(int center, const Eigen::VectorXd& h) const;
  /// Those in its neighborhood in y, without those so near that they tell of noise alone.
  ResidualSamples around(int center, const NaturalFrame& frame) const;

  /// The edges of failed regions around `center`, in (u - center) / widths.
  std::vector<Edge> edges(int center, const Eigen::VectorXd& widths) const;
  bool has_failed_near(const Eigen::VectorXd& u) const { return failure_near(u) >= 0; }
  /// The failure whose ball u lies in; -1: none.
  int failure_near(const Eigen::VectorXd& u) const;
  const Eigen::VectorXd& failure(int i) const { return failures_[i].u; }
  int failures() const { return static_cast<int>(failures_.size()); }
  /// Of the ball around it.
  double avoided(int i) const;
  /// Whether a sample is nearer than `distance` in every variable.
  bool knows(const Eigen::VectorXd& u, const Eigen::VectorXd& distance) const;

 private:
  /// Indices by their distance; `center` is not among them. Asked again and again between two
  /// samples: the last answer is kept.
  const std::vector<int>& nearest(int center, const Eigen::VectorXd& h) const;

  struct FailedPoint {
    Eigen::VectorXd u;
    double success;  // its distance to the nearest point that succeeded
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
