// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/derivative_check.h"

#include <algorithm>
#include <cmath>

#include "correlation/study/study_slopes.h"
#include "correlation/target/residuals.h"
#include "correlation/target/study_trials.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

constexpr double kLength = 1e-3;  // step of the differences as a share of the range
constexpr double kOff = 1e-5;  // allowed error as a share of the largest derivative by the variable
constexpr double kUnsure = 10.0;  // multiple of the difference between two steps, or of a kink

/// Finite differences of the residuals by one variable.
struct Differences {
  Eigen::VectorXd central;
  Eigen::VectorXd jump;  // forward minus backward
};

/// Evaluates residuals at points that are given in coordinates of the unit cube.
class Cube {
 public:
  explicit Cube(const Study& study)
      : study_(study), trial_(evaluator(study)), residuals_(residual_objective(study)) {}

  Result<Score> at(const Eigen::VectorXd& u) const {
    const DesignPoint point = study_.space.from_unit({u.begin(), u.end()});
    const auto channels = trial_(point);
    if (!channels) return channels.failure();
    return residuals_(point, *channels);
  }

  /// Returns the differences D(h) and the derivatives j(h) for one variable; `r` contains the
  /// residuals at u.
  Result<Differences> differences(const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& r,
                                  int variable,
                                  double h) const {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(u.size(), variable);
    const auto above = at(u + step), below = at(u - step);
    if (!above) return above.failure();
    if (!below) return below.failure();
    const Eigen::VectorXd r_above = to_vector(above->residuals),
                          r_below = to_vector(below->residuals);
    return Differences{(r_above - r_below) / (2.0 * h), (r_above - 2.0 * r + r_below) / h};
  }

 private:
  const Study& study_;
  Evaluator trial_;
  Objective residuals_;
};

CheckedSlope worst(const Eigen::VectorXd& J,
                   const Eigen::VectorXd& D,
                   const Eigen::VectorXd& unsure) {
  const double largest = std::max(J.cwiseAbs().maxCoeff(), D.cwiseAbs().maxCoeff());
  CheckedSlope found;
  Eigen::Index at = 0;
  for (Eigen::Index k = 0; k < J.size(); ++k) {
    const double off = std::abs(J[k] - D[k]);
    const bool agrees = off <= kOff * largest || off <= kUnsure * unsure[k];
    const bool is_worse = agrees == found.agrees ? off > std::abs(J[at] - D[at]) : !agrees;
    if (!is_worse) continue;
    at = k;
    found.agrees = agrees;
  }
  found.slope = J[at];
  found.difference = D[at];
  found.off = largest > 0.0 ? std::abs(J[at] - D[at]) / largest : 0.0;
  found.row = std::to_string(at);
  return found;
}

}  // namespace

Result<std::vector<CheckedSlope>> check_slopes(const Study& study, const DesignPoint& point) {
  if (const auto reason = reason_without_slopes(study))
    throw InputError({study.file.string(), 0}, "there are no slopes to check: " + *reason);
  Study sloping = study;
  sloping.asks_slopes = true;
  const Cube cube(sloping);
  const Eigen::VectorXd u =
      to_vector(study.space.to_unit(point)).cwiseMax(kLength).cwiseMin(1.0 - kLength);
  const auto center = cube.at(u);
  if (!center) return center.failure();
  const Eigen::MatrixXd J =
      study.space.unit_jacobian(study.space.from_unit({u.begin(), u.end()}), *center);
  if (J.size() == 0) return Failure{"the model has no slopes there, or some that are not finite"};
  const Eigen::VectorXd r = to_vector(center->residuals);
  const auto rows = residual_rows(study);
  std::vector<CheckedSlope> all;
  for (int i = 0; i < study.space.size(); ++i) {
    const auto whole = cube.differences(u, r, i, kLength),
               half = cube.differences(u, r, i, 0.5 * kLength);
    if (!whole) return whole.failure();
    if (!half) return half.failure();
    const Eigen::VectorXd D = (4.0 * half->central - whole->central) / 3.0,
                          lengths = (half->central - whole->central).cwiseAbs(),
                          kink = (2.0 * half->jump - whole->jump).cwiseAbs();
    CheckedSlope one = worst(J.col(i), D, lengths.cwiseMax(kink));
    const ResidualRow& row = rows[std::stoul(one.row)];
    one.row = row.experiment < 0
                  ? row.name
                  : study.experiments[static_cast<size_t>(row.experiment)].name + ": " + row.name;
    one.variable = study.space[i].name;
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace latsch::correlation
