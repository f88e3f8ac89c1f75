// SPDX-License-Identifier: Apache-2.0
#include "optimization/design_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace latsch {
namespace {

void check(const DesignVariable& v) {
  const auto reject = [&](const std::string& message) {
    throw InputError(v.place, fmt::format("variable \"{}\": {}", v.name, message));
  };
  if (v.name.empty()) throw InputError(v.place, "a design variable has no name");
  if (!std::isfinite(v.lower) || !std::isfinite(v.upper)) {
    reject(fmt::format("bounds {} and {} are not finite, expected two numbers", v.lower, v.upper));
  }
  if (!(v.lower < v.upper)) {
    reject(fmt::format("lower bound {} is not below upper bound {}", v.lower, v.upper));
  }
  if (v.scale == Scale::logarithmic && !(v.lower > 0.0)) {
    reject(
        fmt::format("lower bound {} on a logarithmic scale, expected a positive one or a linear "
                    "scale",
                    v.lower));
  }
  if (!(v.lower <= v.initial && v.initial <= v.upper)) {
    reject(fmt::format(
        "initial value {} is outside its bounds {} to {}", v.initial, v.lower, v.upper));
  }
}

double to_unit(const DesignVariable& v, double x) {
  const double u = v.scale == Scale::logarithmic
                       ? std::log(x / v.lower) / std::log(v.upper / v.lower)
                       : (x - v.lower) / (v.upper - v.lower);
  return std::clamp(u, 0.0, 1.0);
}

double from_unit(const DesignVariable& v, double u) {
  if (!(u > 0.0)) return v.lower;
  if (u >= 1.0) return v.upper;
  const double x = v.scale == Scale::logarithmic ? v.lower * std::pow(v.upper / v.lower, u)
                                                 : v.lower + u * (v.upper - v.lower);
  return std::clamp(x, v.lower, v.upper);
}

}  // namespace

DesignSpace::DesignSpace(std::vector<DesignVariable> variables) : variables_(std::move(variables)) {
  if (variables_.empty()) throw InputError("no design variable is given, expected at least one");
  for (auto v = variables_.begin(); v != variables_.end(); ++v) {
    check(*v);
    const auto same_name = [&](const DesignVariable& other) { return other.name == v->name; };
    if (std::any_of(variables_.begin(), v, same_name)) {
      throw InputError(v->place, fmt::format("variable \"{}\" is declared twice", v->name));
    }
  }
}

DesignPoint DesignSpace::initial() const {
  DesignPoint point;
  for (const DesignVariable& v : variables_) point.values.push_back(v.initial);
  return point;
}

bool DesignSpace::contains(const DesignPoint& point) const {
  if (point.values.size() != variables_.size()) return false;
  for (int i = 0; i < size(); ++i) {
    const double x = point.values[i];
    if (!(variables_[i].lower <= x && x <= variables_[i].upper)) return false;
  }
  return true;
}

std::vector<double> DesignSpace::to_unit(const DesignPoint& point) const {
  assert(point.values.size() == variables_.size());
  std::vector<double> u(variables_.size());
  for (int i = 0; i < size(); ++i) u[i] = latsch::to_unit(variables_[i], point.values[i]);
  return u;
}

DesignPoint DesignSpace::from_unit(const std::vector<double>& u) const {
  assert(u.size() == variables_.size());
  DesignPoint point;
  for (int i = 0; i < size(); ++i) {
    point.values.push_back(latsch::from_unit(variables_[i], u[i]));
  }
  return point;
}

std::vector<double> DesignSpace::unit_slopes(const DesignPoint& point) const {
  assert(point.values.size() == variables_.size());
  std::vector<double> slopes;
  for (int i = 0; i < size(); ++i) {
    const DesignVariable& v = variables_[i];
    slopes.push_back(v.scale == Scale::logarithmic ? point.values[i] * std::log(v.upper / v.lower)
                                                   : v.upper - v.lower);
  }
  return slopes;
}

DesignSpace DesignSpace::tightened(const DesignPoint& point, double factor) const {
  assert(contains(point) && factor > 0.0 && factor <= 1.0);
  std::vector<DesignVariable> narrow = variables_;
  const std::vector<double> center = to_unit(point);
  for (int i = 0; i < size(); ++i) {
    // Shifted rather than cut at the old bounds, so that every stage has the same width.
    const double lower = std::clamp(center[i] - 0.5 * factor, 0.0, 1.0 - factor);
    narrow[i].lower = latsch::from_unit(variables_[i], lower);
    narrow[i].upper = latsch::from_unit(variables_[i], lower + factor);
    narrow[i].initial = std::clamp(point.values[i], narrow[i].lower, narrow[i].upper);
  }
  return DesignSpace(std::move(narrow));
}

}  // namespace latsch
