// SPDX-License-Identifier: Apache-2.0
// All that is known of a vector of residuals: samples, whoever asked for them, and failed regions.
//
// A point that failed, or where the residuals exploded, makes a ball around it one to avoid, as
// wide as a quarter of its distance to the nearest point that succeeded: a single failure hides
// little, a region of them is closed off from all sides, and neither is ever entered twice.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimization/residual_model.h"

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
  int size() const { return static_cast<int>(samples_.size()); }
  const ResidualSample& operator[](int i) const { return samples_[i]; }

  void add(ResidualSample sample) { samples_.push_back(std::move(sample)); }
  void add_failure(const Eigen::VectorXd& u) { failures_.push_back(u); }

  /// The samples nearest to one, as many as a quadratic has coefficients and as there are
  /// variables; without those that exploded or have other stand-ins. Distances are told by the half
  /// widths h of a box.
  std::vector<int> near(int center, const Eigen::VectorXd& h) const;
  /// From here on a value counts as exploded, beside those near `center`.
  double explosion(int center, const Eigen::VectorXd& h) const;
  /// Those near `center` in z = (u - center) / h.
  ResidualSamples around(int center, const Eigen::VectorXd& h) const;

  bool has_failed_near(const Eigen::VectorXd& u) const;
  /// Whether a sample is nearer than `distance` in every variable.
  bool knows(const Eigen::VectorXd& u, const Eigen::VectorXd& distance) const;

 private:
  std::vector<int> nearest(int center, const Eigen::VectorXd& h) const;

  std::vector<ResidualSample> samples_;
  std::vector<Eigen::VectorXd> failures_;
};

}  // namespace latsch
