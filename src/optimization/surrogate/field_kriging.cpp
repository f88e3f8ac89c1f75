// SPDX-License-Identifier: Apache-2.0
#include "optimization/surrogate/field_kriging.h"

#include <cmath>

#include "numerics/dense/cholesky.h"

namespace latsch {
namespace {

// Lengths that are tried, in ranges.
constexpr double kFieldLengths[] = {0.15, 0.25, 0.4, 0.7, 1.2, 2.0, 4.0};
// Variance of each sample beside that of the field, which keeps K definite to rounding.
constexpr double kFieldNugget = 1e-10;
constexpr int kFieldRounds = 3;  // rounds over the settings in which lengths are chosen

struct FieldFit {
  Eigen::MatrixXd trend, weights;
  Eigen::VectorXd left_out;  // mean square error of samples left out, of each field
};

Eigen::VectorXd field_covariance(const Eigen::MatrixXd& places,
                                 const Eigen::VectorXd& lengths,
                                 const Eigen::VectorXd& at) {
  Eigen::VectorXd k(places.rows());
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    k[i] = std::exp(-0.5 * (places.row(i).transpose() - at).cwiseQuotient(lengths).squaredNorm());
  return k;
}

Eigen::MatrixXd field_trend(const Eigen::MatrixXd& places) {
  Eigen::MatrixXd F(places.rows(), places.cols() + 1);
  F << Eigen::VectorXd::Ones(places.rows()), places;
  return F;
}

FieldFit fit_fields(const Eigen::MatrixXd& places,
                    const Eigen::MatrixXd& fields,
                    const Eigen::VectorXd& lengths) {
  const Eigen::Index N = places.rows();
  Eigen::MatrixXd K(N, N);
  for (Eigen::Index i = 0; i < N; ++i)
    K.col(i) = field_covariance(places, lengths, places.row(i).transpose());
  K.diagonal().array() += kFieldNugget;
  const Eigen::MatrixXd inverse =
      numerics::PivotedCholesky(K).solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(N, N)));
  const Eigen::MatrixXd F = field_trend(places);
  const numerics::PivotedCholesky normal(Eigen::MatrixXd(F.transpose() * inverse * F));
  FieldFit fit;
  fit.trend = normal.solve(Eigen::MatrixXd(F.transpose() * inverse * fields));
  fit.weights = inverse * (fields - F * fit.trend);
  // With an unknown trend K^-1 becomes K^-1 - K^-1 F (F'K^-1 F)^-1 F'K^-1.
  const Eigen::MatrixXd Q =
      inverse - inverse * F * normal.solve(Eigen::MatrixXd(F.transpose() * inverse));
  fit.left_out =
      (Q.diagonal().cwiseInverse().asDiagonal() * fit.weights).colwise().squaredNorm().transpose() /
      static_cast<double>(N);
  return fit;
}

}  // namespace

FieldKriging::FieldKriging(const Eigen::MatrixXd& places, const Eigen::MatrixXd& fields)
    : places_(places), lengths_(Eigen::VectorXd::Constant(places.cols(), 0.7)) {
  const Eigen::RowVectorXd mean = fields.colwise().mean();
  const Eigen::VectorXd variance = (fields.rowwise() - mean).colwise().squaredNorm().transpose() /
                                   static_cast<double>(fields.rows());
  const double largest = variance.maxCoeff();
  // Fields count by their errors relative to their own variance; constant ones do not count.
  constexpr double kConstant = 1e-20;
  const auto error_of = [&](const Eigen::VectorXd& lengths) {
    const FieldFit fit = fit_fields(places, fields, lengths);
    double sum = 0.0;
    for (Eigen::Index f = 0; f < variance.size(); ++f)
      if (variance[f] > kConstant * largest) sum += fit.left_out[f] / variance[f];
    return sum;
  };
  double least = error_of(lengths_);
  for (int round = 0; round < kFieldRounds; ++round)
    for (Eigen::Index i = 0; i < lengths_.size(); ++i)
      for (const double length : kFieldLengths) {
        Eigen::VectorXd tried = lengths_;
        tried[i] = length;
        const double error = error_of(tried);
        if (!(error < least)) continue;
        least = error;
        lengths_ = tried;
      }
  const FieldFit fit = fit_fields(places, fields, lengths_);
  trend_ = fit.trend;
  weights_ = fit.weights;
  Q2_ = Eigen::VectorXd::Ones(variance.size());
  for (Eigen::Index f = 0; f < variance.size(); ++f)
    if (variance[f] > kConstant * largest) Q2_[f] = 1.0 - fit.left_out[f] / variance[f];
}

Eigen::VectorXd FieldKriging::at(const Eigen::VectorXd& place) const {
  Eigen::VectorXd f(place.size() + 1);
  f << 1.0, place;
  return trend_.transpose() * f + weights_.transpose() * field_covariance(places_, lengths_, place);
}

}  // namespace latsch
