// SPDX-License-Identifier: Apache-2.0
#include "numerics/dense/least_squares.h"

#include <Eigen/QR>
#include <cassert>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace latsch::numerics {
namespace {

/// The residuals in the form that Eigen's Levenberg-Marquardt solver requires of a function.
struct Function {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const Residuals& residuals;
  Eigen::Index unknowns, count;

  Eigen::Index inputs() const { return unknowns; }
  Eigen::Index values() const { return count; }
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    r = residuals(x);
    return 0;
  }
};

Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& J, double variance) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(J);
  const Eigen::Index n = J.cols();
  if (qr.rank() < n) {
    return Eigen::MatrixXd::Constant(n, n, std::numeric_limits<double>::infinity());
  }
  const Eigen::MatrixXd R = qr.matrixR().topLeftCorner(n, n).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd inverse = qr.colsPermutation() * R.triangularView<Eigen::Upper>().solve(
                                                             Eigen::MatrixXd::Identity(n, n));
  return variance * inverse * inverse.transpose();
}

}  // namespace

LeastSquares least_squares(const Residuals& residuals, const Eigen::VectorXd& start) {
  LeastSquares result;
  result.x = start;
  Eigen::VectorXd r = residuals(start);
  assert(r.size() >= start.size());
  const Function function{residuals, start.size(), r.size()};
  using Differences = Eigen::NumericalDiff<Function, Eigen::Central>;
  Differences differences(function);
  Eigen::LevenbergMarquardt<Differences> method(differences);
  method.parameters.ftol = method.parameters.xtol = 1e-12;
  method.parameters.maxfev = 400;
  using namespace Eigen::LevenbergMarquardtSpace;
  const Status status = method.minimize(result.x);
  result.converged = status == RelativeReductionTooSmall || status == RelativeErrorTooSmall ||
                     status == RelativeErrorAndReductionTooSmall || status == CosinusTooSmall ||
                     status == FtolTooSmall || status == XtolTooSmall || status == GtolTooSmall;
  r = residuals(result.x);
  result.sum = r.squaredNorm();
  const Eigen::Index spare = r.size() - start.size();
  Eigen::MatrixXd J(r.size(), start.size());
  differences.df(result.x, J);
  result.covariance = covariance_of(J, spare > 0 ? result.sum / static_cast<double>(spare) : 0.0);
  return result;
}

}  // namespace latsch::numerics
