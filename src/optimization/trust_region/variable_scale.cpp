// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/variable_scale.h"

namespace latsch {
namespace {

constexpr double kExponent = 0.5;
// Smallest effect D_i of a variable on the residuals, as a share of the largest effect. Smaller
// ones count as this.
constexpr double kInsensitive = 1e-3;

}  // namespace

VariableScale::VariableScale(const Eigen::VectorXd& base)
    : base_(base), largest_(Eigen::VectorXd::Zero(base.size())), widths_(base) {}

void VariableScale::widen(const Eigen::VectorXd& base) {
  base_ = base_.cwiseMax(base);
  update();
}

void VariableScale::learn(const Eigen::MatrixXd& J) {
  const Eigen::VectorXd now = J.colwise().norm().transpose();
  if (!now.allFinite() || !(now.maxCoeff() > 0.0)) return;
  largest_ = largest_.cwiseMax(now);
  update();
}

void VariableScale::update() {
  widths_ = base_;
  const Eigen::ArrayXd effect = largest_.cwiseProduct(base_);
  if (!(effect.maxCoeff() > 0.0)) return;
  const Eigen::ArrayXd D = effect.max(kInsensitive * effect.maxCoeff());
  Eigen::ArrayXd logarithm = -kExponent * D.log();
  logarithm -= logarithm.mean();
  widths_.array() *= logarithm.exp();
}

double VariableScale::length(const Eigen::VectorXd& du) const {
  return du.cwiseQuotient(widths_).lpNorm<Eigen::Infinity>();
}

double VariableScale::norm(const Eigen::VectorXd& du) const {
  return du.cwiseQuotient(widths_).norm();
}

}  // namespace latsch
