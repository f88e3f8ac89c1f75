// SPDX-License-Identifier: Apache-2.0
#include "optimization/problem/design_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/units.h"
#include "optimization/problem/feasible_region.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

void check(const DesignVariable& v) {
  const auto reject = [&](const std::string& message) {
    throw InputError(v.place, fmt::format("variable \"{}\": {}", v.name, message));
  };
  const auto shown = [&](double si) { return format_quantity(si, v.unit); };
  if (v.name.empty()) throw InputError(v.place, "a design variable has no name");
  if (!std::isfinite(v.lower) || !std::isfinite(v.upper)) {
    reject(fmt::format("bounds {} and {} are not finite, expected two numbers", v.lower, v.upper));
  }
  if (!(v.lower < v.upper)) {
    reject(
        fmt::format("lower bound {} is not below upper bound {}", shown(v.lower), shown(v.upper)));
  }
  if (v.scale == Scale::logarithmic && !(v.lower > 0.0)) {
    reject(
        fmt::format("lower bound {} on a logarithmic scale, expected a positive one or a linear "
                    "scale",
                    shown(v.lower)));
  }
  const double span = v.scale == Scale::logarithmic ? v.upper / v.lower : v.upper - v.lower;
  if (!std::isfinite(span)) {
    reject(
        fmt::format("bounds {} and {} are so far apart that numbers between them cannot be "
                    "distinguished, expected narrower ones",
                    shown(v.lower),
                    shown(v.upper)));
  }
  if (!(v.lower <= v.initial && v.initial <= v.upper)) {
    reject(fmt::format("initial value {} is outside its bounds {} to {}",
                       shown(v.initial),
                       shown(v.lower),
                       shown(v.upper)));
  }
}

double place(const DesignVariable& v, double x) {
  return v.scale == Scale::logarithmic ? std::log(x / v.lower) / std::log(v.upper / v.lower)
                                       : (x - v.lower) / (v.upper - v.lower);
}

double to_unit(const DesignVariable& v, double x) { return std::clamp(place(v, x), 0.0, 1.0); }

double from_unit(const DesignVariable& v, double u) {
  if (!(u > 0.0)) return v.lower;
  if (u >= 1.0) return v.upper;
  const double x = v.scale == Scale::logarithmic ? v.lower * std::pow(v.upper / v.lower, u)
                                                 : v.lower + u * (v.upper - v.lower);
  return std::clamp(x, v.lower, v.upper);
}

/// Returns dx/du, the derivative of the value with respect to the unit coordinate.
double slope(const DesignVariable& v, double x) {
  return v.scale == Scale::logarithmic ? x * std::log(v.upper / v.lower) : v.upper - v.lower;
}

// Distance from a constraint, as a share of the ranges, that is attributed to rounding of typed
// digits.
constexpr double kLastDigits = 1e-6;
// Digits of the feasible point that a message suggests, enough for the point to be accepted.
constexpr int kOfferedDigits = 9;

void check(const LinearConstraint& c, const std::vector<DesignVariable>& variables) {
  const auto reject = [&](const std::string& message) {
    throw InputError(c.place, fmt::format("linear constraint \"{}\": {}", c.name, message));
  };
  if (c.coefficients.size() != variables.size()) {
    reject(fmt::format("{} coefficients for {} variables, expected one each",
                       c.coefficients.size(),
                       variables.size()));
  }
  bool is_empty = true;
  for (size_t i = 0; i < variables.size(); ++i) {
    const double a = c.coefficients[i];
    if (!std::isfinite(a)) reject(fmt::format("the coefficient of {} is {}", variables[i].name, a));
    if (a == 0.0) continue;
    is_empty = false;
    if (variables[i].scale == Scale::logarithmic) {
      reject(
          fmt::format("variable \"{}\" is logarithmic, and a sum of values is no plane in the "
                      "logarithms; expected scale = \"linear\" for it",
                      variables[i].name));
    }
  }
  if (is_empty) reject("it has no variable, expected a coefficient that is not 0");
  if (!(c.lower <= c.upper)) {
    reject(fmt::format("lower bound {} is above upper bound {}",
                       format_quantity(c.lower, c.unit),
                       format_quantity(c.upper, c.unit)));
  }
  if (!std::isfinite(c.lower) && !std::isfinite(c.upper)) {
    reject("it has no bound, expected a finite lower or upper one or both");
  }
}

/// Returns the constraint from which u is farthest on the violating side.
const LinearConstraint& most_violated(const DesignSpace& space, const Eigen::VectorXd& u) {
  const auto distance = [&](const LinearConstraint& constraint) {
    return FeasibleRegion(space, {constraint}).violation(u);
  };
  const auto less = [&](const auto& a, const auto& b) { return distance(a) < distance(b); };
  return *std::max_element(space.constraints().begin(), space.constraints().end(), less);
}

std::string violated(const LinearConstraint& c, const DesignPoint& point) {
  const double sum = c.sum(point.values);
  const bool too_low = sum < c.lower;
  const double bound = too_low ? c.lower : c.upper;
  return fmt::format("is {} at the initial point, {} {} its bound {}",
                     format_quantity(sum, c.unit),
                     format_quantity(std::abs(sum - bound), c.unit),
                     too_low ? "below" : "above",
                     format_quantity(bound, c.unit));
}

}  // namespace

DesignSpace::DesignSpace(std::vector<DesignVariable> variables,
                         std::vector<LinearConstraint> constraints)
    : variables_(std::move(variables)), constraints_(std::move(constraints)) {
  if (variables_.empty()) throw InputError("no design variable is given, expected at least one");
  for (auto v = variables_.begin(); v != variables_.end(); ++v) {
    check(*v);
    const auto same_name = [&](const DesignVariable& other) { return other.name == v->name; };
    if (std::any_of(variables_.begin(), v, same_name)) {
      throw InputError(v->place, fmt::format("variable \"{}\" is declared twice", v->name));
    }
  }
  if (!constraints_.empty()) check_constraints();
}

void DesignSpace::check_constraints() {
  for (const LinearConstraint& constraint : constraints_) check(constraint, variables_);
  const FeasibleRegion region(*this);
  if (const std::string rows = region.contradiction(); !rows.empty()) {
    throw InputError(
        constraints_.front().place,
        "no point fulfills all linear constraints; these contradict each other: " + rows);
  }
  const Eigen::VectorXd u = to_vector(to_unit(initial()));
  if (region.contains(u)) return;
  const Eigen::VectorXd near = region.nearest(u);
  const DesignPoint nearest = from_unit({near.begin(), near.end()});
  if ((near - u).norm() <= kLastDigits) {
    for (int i = 0; i < size(); ++i) variables_[i].initial = nearest.values[i];
    return;
  }
  std::string offer;
  for (int i = 0; i < size(); ++i) {
    const std::string value =
        format_quantity(nearest.values[i], variables_[i].unit, kOfferedDigits);
    offer += fmt::format("{}{} = {}", i == 0 ? "" : ", ", variables_[i].name, value);
  }
  const LinearConstraint& worst = most_violated(*this, u);
  throw InputError(worst.place,
                   fmt::format("linear constraint \"{}\" {}; the nearest point that fulfills all "
                               "constraints is {}",
                               worst.name,
                               violated(worst, initial()),
                               offer));
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
  if (constraints_.empty()) return true;
  return FeasibleRegion(*this).contains(to_vector(to_unit(point)));
}

std::optional<std::vector<double>> DesignSpace::place(const DesignPoint& point) const {
  if (point.values.size() != variables_.size()) {
    throw InputError(fmt::format("a point of the design space has {} values, expected {}",
                                 point.values.size(),
                                 variables_.size()));
  }
  std::vector<double> u(variables_.size());
  for (int i = 0; i < size(); ++i) {
    u[i] = latsch::place(variables_[i], point.values[i]);
    if (!std::isfinite(u[i])) return std::nullopt;
  }
  return u;
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

Eigen::MatrixXd DesignSpace::unit_jacobian(const DesignPoint& point, const Score& score) const {
  assert(point.values.size() == variables_.size());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto m = std::ssize(score.residuals);
  if (score.jacobian.empty() || std::ssize(score.jacobian) != m * size()) return {};
  Eigen::MatrixXd J = Eigen::Map<const Rows>(score.jacobian.data(), m, size());
  if (!J.allFinite()) return {};
  for (int i = 0; i < size(); ++i) J.col(i) *= slope(variables_[i], point.values[i]);
  return J;
}

DesignSpace DesignSpace::starting_at(const DesignPoint& point) const {
  assert(contains(point));
  DesignSpace moved = *this;
  for (int i = 0; i < size(); ++i) moved.variables_[i].initial = point.values[i];
  return moved;
}

DesignSpace DesignSpace::tightened(const DesignPoint& point, double factor) const {
  assert(contains(point) && factor > 0.0 && factor <= 1.0);
  std::vector<DesignVariable> narrow = variables_;
  const std::vector<double> center = to_unit(point);
  for (int i = 0; i < size(); ++i) {
    // The narrower range is shifted inside the old bounds rather than cut off, so that every stage
    // has the same width.
    const double lower = std::clamp(center[i] - 0.5 * factor, 0.0, 1.0 - factor);
    narrow[i].lower = latsch::from_unit(variables_[i], lower);
    narrow[i].upper = latsch::from_unit(variables_[i], lower + factor);
    narrow[i].initial = std::clamp(point.values[i], narrow[i].lower, narrow[i].upper);
  }
  return DesignSpace(std::move(narrow), constraints_);
}

}  // namespace latsch
