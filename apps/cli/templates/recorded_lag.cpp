// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/recorded_lag.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "correlation/laboratory/selection.h"
#include "numerics/dense/cholesky.h"

namespace latsch::cli {
namespace {

using correlation::Measurement;

// Number of samples on each side from which a time derivative is computed.
constexpr std::size_t kReach = 2;
constexpr std::size_t kFewest = 30;  // least number of samples with small slip
// rad, or 1 for longitudinal slip: largest value of the slip that is not swept
constexpr double kNoOtherSlip = 0.02;
// share of the median load; at smaller loads the wheel counts as lifted
constexpr double kLightest = 0.5;

std::vector<double> values_of(const Measurement& measured, const std::string& channel) {
  if (!measured.has(channel)) return {};
  return measured.values(channel, measured.unit(channel));
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Regressors for force over load, where s is the slip and V the speed: s, ds/dt / |V|, 1, s^3,
/// then load, s load, camber.
constexpr int kAlways = 4, kAll = 7;
using Regressors = Eigen::Matrix<double, kAll, 1>;

struct Rows {
  std::vector<double> y;
  std::vector<Regressors> X;
  std::vector<std::size_t> samples;
  std::vector<double> rates, speeds;
};

Rows rows_of(const Measurement& measured,
             const std::string& force,
             const std::string& slip,
             double most) {
  const auto time = values_of(measured, "time"), V = values_of(measured, "Vx");
  const auto F = values_of(measured, force), Fz = values_of(measured, "Fz");
  const auto s = values_of(measured, slip), gamma = values_of(measured, "gamma");
  const auto other = values_of(measured, slip == "alpha" ? "kappa" : "alpha");
  Rows rows;
  if (time.empty() || V.empty() || F.empty() || s.empty()) return rows;
  const double usual = quantile(Fz, 0.5), least = kLightest * usual;
  for (const auto& stretch : correlation::stretches_of(time, measured.samples())) {
    for (std::size_t i = stretch.first + kReach; i + kReach < stretch.end; ++i) {
      const double rate = (s[i + kReach] - s[i - kReach]) / (time[i + kReach] - time[i - kReach]);
      if (std::abs(V[i]) < 1.0 || Fz[i] < least) continue;
      if (!other.empty() && std::abs(other[i]) > kNoOtherSlip) continue;
      rows.rates.push_back(std::abs(rate));
      rows.speeds.push_back(std::abs(V[i]));
      if (std::abs(s[i]) > most) continue;
      rows.y.push_back(F[i] / Fz[i]);
      const double load = Fz[i] / usual - 1.0;
      rows.X.emplace_back();
      rows.X.back() << s[i], rate / std::abs(V[i]), 1.0, s[i] * s[i] * s[i], load, s[i] * load,
          gamma.empty() ? 0.0 : gamma[i];
      rows.samples.push_back(i);
    }
  }
  return rows;
}

/// Returns the columns of those regressors that vary, each normalized to length 1; `scale` receives
/// the lengths before normalization.
Eigen::MatrixXd columns_of(const Rows& rows, Eigen::VectorXd& scale) {
  // Least variation above which a condition varies: of the load, root mean square over median, or
  // of the camber, rad.
  constexpr double kVaries = 0.02;
  const Eigen::Index n = std::ssize(rows.y);
  Eigen::MatrixXd X(n, kAll);
  for (Eigen::Index i = 0; i < n; ++i) X.row(i) = rows.X[static_cast<std::size_t>(i)];
  const auto varies = [&](Eigen::Index k) {
    return (X.col(k).array() - X.col(k).mean()).matrix().norm() >
           kVaries * std::sqrt(static_cast<double>(n));
  };
  std::vector<Eigen::Index> taken = {0, 1, 2, 3};
  if (varies(kAlways)) taken.insert(taken.end(), {kAlways, kAlways + 1});
  if (varies(kAll - 1)) taken.push_back(kAll - 1);
  const Eigen::MatrixXd kept = X(Eigen::all, taken);
  scale = kept.colwise().norm();
  return kept * scale.cwiseMax(1e-300).cwiseInverse().asDiagonal();
}

/// Returns the factor by which the variance of a mean grows because neighboring samples share
/// noise.
double shared_noise(const Eigen::VectorXd& r, const std::vector<std::size_t>& samples) {
  double products = 0.0, squares = 0.0;
  for (Eigen::Index i = 1; i < r.size(); ++i) {
    if (samples[static_cast<std::size_t>(i)] != samples[static_cast<std::size_t>(i) - 1] + 1)
      continue;
    products += r[i] * r[i - 1];
    squares += 0.5 * (r[i] * r[i] + r[i - 1] * r[i - 1]);
  }
  const double rho = squares > 0.0 ? std::clamp(products / squares, 0.0, 0.99) : 0.0;
  return (1.0 + rho) / (1.0 - rho);
}

}  // namespace

bool RecordedLag::is_seen() const {
  // A lag counts as seen if it exceeds this number of standard deviations and this length, m.
  constexpr double kDeviations = 4.0, kLeast = 0.01;
  return sigma > kLeast && sigma > kDeviations * deviation;
}

std::optional<RecordedLag> recorded_lag(const Measurement& measured,
                                        const std::string& force,
                                        const std::string& slip,
                                        double most) {
  const Rows rows = rows_of(measured, force, slip, most);
  if (rows.y.size() < kFewest) return std::nullopt;
  const Eigen::Index n = std::ssize(rows.y);
  Eigen::VectorXd scale;
  const Eigen::MatrixXd A = columns_of(rows, scale);
  const Eigen::Index columns = A.cols();
  const Eigen::VectorXd y = Eigen::VectorXd::Map(rows.y.data(), n);
  const numerics::Cholesky normal(A.transpose() * A);
  if (!normal.is_positive_definite()) return std::nullopt;
  const Eigen::VectorXd b = normal.solve(A.transpose() * y), r = y - A * b;
  const double variance = r.squaredNorm() / static_cast<double>(n - columns);
  const double slope = b[0] / scale[0], lag = b[1] / scale[1];
  RecordedLag found;
  found.sigma = -lag / slope;
  // The relaxation length is sigma = -b1/b0. The vector `by` holds its derivatives by b0 and b1,
  // from which its variance is computed.
  Eigen::VectorXd by = Eigen::VectorXd::Zero(columns);
  by[0] = -found.sigma / slope / scale[0];
  by[1] = -1.0 / slope / scale[1];
  found.deviation = std::sqrt(variance * by.dot(normal.solve(by)) * shared_noise(r, rows.samples));
  found.rate = quantile(rows.rates, 0.9);
  found.speed = quantile(rows.speeds, 0.5);
  return found;
}

}  // namespace latsch::cli
