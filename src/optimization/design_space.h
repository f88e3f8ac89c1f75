// SPDX-License-Identifier: Apache-2.0
// What may vary, between which bounds, and the unit cube in which optimizers see it.
//   linear:       u = (x - lower) / (upper - lower)
//   logarithmic:  u = ln(x / lower) / ln(upper / lower)
// Choose logarithmic where a factor is as likely up as down: stiffness known to its order of
// magnitude.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "optimization/design_point.h"

namespace latsch {

enum class Scale { linear, logarithmic };

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
};

class DesignSpace {
 public:
  /// Throws InputError where bounds are crossed or not finite, the initial value lies outside them,
  /// a logarithmic variable has a lower bound that is not positive, a name comes twice or no
  /// variable is given.
  explicit DesignSpace(std::vector<DesignVariable> variables);

  int size() const { return static_cast<int>(variables_.size()); }
  const std::vector<DesignVariable>& variables() const { return variables_; }
  const DesignVariable& operator[](int i) const { return variables_[i]; }

  DesignPoint initial() const;
  bool contains(const DesignPoint& point) const;

  /// Into the unit cube and back. from_unit clamps to the cube; its faces give the bits of the
  /// bounds.
  std::vector<double> to_unit(const DesignPoint& point) const;
  DesignPoint from_unit(const std::vector<double>& u) const;
  /// dx/du of every variable.
  std::vector<double> unit_slopes(const DesignPoint& point) const;

  /// The same variables, starting at `point`, with bounds `factor` (0..1) as wide in the unit cube,
  /// inside the old ones: the next stage of a cascade.
  DesignSpace tightened(const DesignPoint& point, double factor) const;

 private:
  std::vector<DesignVariable> variables_;
};

}  // namespace latsch
