// SPDX-License-Identifier: Apache-2.0
// The design variables with their bounds, and their mapping to the unit cube that optimizers use.
//   linear:       u = (x - lower) / (upper - lower)
//   logarithmic:  u = ln(x / lower) / ln(upper / lower)
// Linear constraints may exclude parts of the cube. Choose the logarithmic scale if twice the value
// is as likely as half the value, for example for a stiffness known only to its order of magnitude.
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

/// Scale of a variable. On a logarithmic one, equal steps are equal ratios of the values, which
/// must be positive.
enum class Scale { linear, logarithmic };

/// A number of the model that is a variable's value times a factor.
struct Follower {
  std::string name;                // for people
  std::vector<std::string> paths;  // paths of numbers of the model
  double factor = 1.0;             // multiplies the variable's value
};

/// One variable of a search.
struct DesignVariable {
  std::string name;                     // name that is unique in the design space
  std::vector<std::string> paths = {};  // numbers of the model set to its value
  double lower = 0.0;                   // in SI, as are upper and initial
  double upper = 1.0;                   // SI
  double initial = 0.5;                 // start of a search
  Scale scale = Scale::linear;          // scale of the search and of the intervals
  std::string unit = "1";               // unit for display; the values above are in SI
  Place place = {};                     // place in the study that declares the variable
  std::optional<Prior> prior = {};      // prior knowledge of the value, which adds a residual
  /// Numbers of the model that are set to multiples of the value.
  std::vector<Follower> followers = {};
};

class DesignSpace {
 public:
  /// Throws InputError if bounds are crossed, not finite, or so far apart that their distance or
  /// ratio is not finite; if an initial value lies outside its bounds; if a logarithmic variable
  /// has a lower bound that is not positive; if two variables have the same name; or if no variable
  /// is given. Also throws if a constraint has no variable, a logarithmic one, crossed bounds or no
  /// bounds; if constraints contradict each other; or if the initial point violates a constraint,
  /// with the nearest feasible point in the message. An initial point that violates a constraint
  /// only by the rounding of typed digits, 1e-6 of the ranges, is moved onto the constraint.
  explicit DesignSpace(std::vector<DesignVariable> variables,
                       std::vector<LinearConstraint> constraints = {});

  /// Number of variables.
  int size() const { return static_cast<int>(variables_.size()); }
  /// Returns the variables in their order.
  const std::vector<DesignVariable>& variables() const { return variables_; }
  /// Returns variable i, counted from 0.
  const DesignVariable& operator[](int i) const { return variables_[i]; }
  /// Returns the linear constraints.
  const std::vector<LinearConstraint>& constraints() const { return constraints_; }

  /// Returns the point of the initial values.
  DesignPoint initial() const;
  /// True if the point lies inside the bounds and, up to rounding, fulfills the constraints.
  bool contains(const DesignPoint& point) const;

  /// Returns the unit coordinates of any point: outside of 0 ... 1 if a value is outside of its
  /// bounds; nullopt if a value has no position in the cube, because it is not finite or not
  /// positive on a logarithmic scale. Throws InputError if the number of values differs from that
  /// of the variables.
  std::optional<std::vector<double>> place(const DesignPoint& point) const;

  /// Converts a point into the unit cube and back. to_unit needs a point that has a place(). Both
  /// clamp to the cube; the faces of the cube give the exact bits of the bounds.
  std::vector<double> to_unit(const DesignPoint& point) const;
  /// Converts a point of the unit cube into values in SI.
  DesignPoint from_unit(const std::vector<double>& u) const;
  /// Returns the Jacobian of the score's residuals with respect to the unit cube, dr/du = dr/dx
  /// dx/du, one row for each residual. Empty if the score has no Jacobian, one of another size, or
  /// one that is not finite.
  Eigen::MatrixXd unit_jacobian(const DesignPoint& point, const Score& score) const;

  /// Returns a copy of this space whose initial point is `point`.
  DesignSpace starting_at(const DesignPoint& point) const;
  /// Returns a space for the next stage of a search: it starts at `point`, and its bounds are
  /// `factor` (0..1) times as wide in the unit cube and lie inside the old ones.
  DesignSpace tightened(const DesignPoint& point, double factor) const;

 private:
  void check_constraints();

  std::vector<DesignVariable> variables_;
  std::vector<LinearConstraint> constraints_;
};

}  // namespace latsch
