// SPDX-License-Identifier: Apache-2.0
// What may vary, between which bounds, and the unit cube in which optimizers see it.
//   linear:       u = (x - lower) / (upper - lower)
//   logarithmic:  u = ln(x / lower) / ln(upper / lower)
// Linear constraints may leave a part of the cube only.
// Choose logarithmic where a factor is as likely up as down: stiffness known to its order of
// magnitude.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "optimization/problem/design_point.h"
#include "optimization/problem/linear_constraint.h"
#include "optimization/problem/prior.h"
#include "optimization/problem/score.h"

namespace latsch {

enum class Scale { linear, logarithmic };

/// A number of the model that moves with a variable: factor times its value.
struct Follower {
  std::string name;
  std::vector<std::string> paths;
  double factor = 1.0;
};

struct DesignVariable {
  std::string name;
  std::vector<std::string> paths = {};  // numbers of the model that take its value
  double lower = 0.0;                   // SI, as upper and initial
  double upper = 1.0;
  double initial = 0.5;
  Scale scale = Scale::linear;
  std::string unit =
      "1";           // the unit in which a person reads it; says nothing about the values above
  Place place = {};  // where the study declares it
  std::optional<Prior> prior = {};
  std::vector<Follower> followers = {};
};

class DesignSpace {
 public:
  /// Throws InputError where bounds are crossed or not finite or so far apart that their distance
  /// or ratio is not a number, the initial value lies outside them,
  /// a logarithmic variable has a lower bound that is not positive, a name comes twice or no
  /// variable is given; where a constraint has no variable, a logarithmic one, crossed bounds or
  /// none, where constraints contradict each other, and where the initial point violates one: the
  /// message then offers the nearest point that does not. An initial point that is off by the last
  /// digits of a person alone, 1e-6 of the ranges, is moved onto the constraint.
  explicit DesignSpace(std::vector<DesignVariable> variables,
                       std::vector<LinearConstraint> constraints = {});

  int size() const { return static_cast<int>(variables_.size()); }
  const std::vector<DesignVariable>& variables() const { return variables_; }
  const DesignVariable& operator[](int i) const { return variables_[i]; }
  const std::vector<LinearConstraint>& constraints() const { return constraints_; }

  DesignPoint initial() const;
  /// Inside the bounds and, up to rounding, the constraints.
  bool contains(const DesignPoint& point) const;

  /// Where any point lies: outside of 0 ... 1 where a value is outside of its bounds; nullopt where
  /// one has no place, not finite or not positive on a logarithmic scale. Throws InputError for
  /// another number of values than there are variables.
  std::optional<std::vector<double>> place(const DesignPoint& point) const;

  /// Into the unit cube and back; to_unit is for points that have a place, and clamps like
  /// from_unit. from_unit clamps to the cube; its faces give the bits of the
  /// bounds.
  std::vector<double> to_unit(const DesignPoint& point) const;
  DesignPoint from_unit(const std::vector<double>& u) const;
  /// dr/du = dr/dx dx/du of the residuals of the score at that point, one a row. Empty where the
  /// score has no Jacobian, one of another size, or one that is not finite.
  Eigen::MatrixXd unit_jacobian(const DesignPoint& point, const Score& score) const;

  /// The same space, starting at `point`.
  DesignSpace starting_at(const DesignPoint& point) const;
  /// The same variables and constraints, starting at `point`, with bounds `factor` (0..1) as wide
  /// in the unit cube, inside the old ones: the next stage of a cascade.
  DesignSpace tightened(const DesignPoint& point, double factor) const;

 private:
  void check_constraints();

  std::vector<DesignVariable> variables_;
  std::vector<LinearConstraint> constraints_;
};

}  // namespace latsch
