// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/explained_point.h"

#include <algorithm>
#include <utility>

#include "optimization/least_squares/residual_kriging.h"

namespace latsch {
namespace {

constexpr double kSame = 0.01;       // distance in the unit cube below which points are one
constexpr std::ptrdiff_t kMost = 8;  // most trials of a model, in n + 1
constexpr int kSteps = 16;           // on the way from the minimum to the point

/// Returns the trials beside the minimum and the point, the nearest ones to either, as samples
/// around the minimum in units of h.
ResidualSamples samples_of(const KnownResiduals& minimum,
                           const KnownResiduals& point,
                           const std::vector<KnownResiduals>& known,
                           double h) {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const double to_minimum = (known[i].u - minimum.u).norm();
    const double to_point = (known[i].u - point.u).norm();
    if (to_point == 0.0 || to_minimum == 0.0 || known[i].r.size() != point.r.size()) continue;
    near.emplace_back(std::min(to_minimum, to_point), i);
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(std::ssize(near), kMost * (minimum.u.size() + 1)));
  const auto count = static_cast<Eigen::Index>(near.size());
  ResidualSamples samples;
  samples.r_c = minimum.r;
  samples.Z.resize(count, minimum.u.size());
  samples.D.resize(count, minimum.r.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    const KnownResiduals& one = known[near[static_cast<std::size_t>(k)].second];
    samples.Z.row(k) = (one.u - minimum.u).transpose() / h;
    samples.D.row(k) = (one.r - minimum.r).transpose();
  }
  return samples;
}

}  // namespace

bool is_explained_by(const KnownResiduals& minimum,
                     const KnownResiduals& point,
                     const std::vector<KnownResiduals>& known,
                     double largest_error) {
  if (minimum.r.size() != point.r.size()) return false;
  const double h = (point.u - minimum.u).norm();
  if (h < kSame) return true;
  const ResidualSamples samples = samples_of(minimum, point, known, h);
  if (samples.Z.rows() <= minimum.u.size()) return false;
  const ResidualKriging model(samples, 0.0);
  const Eigen::VectorXd way = (point.u - minimum.u) / h;
  const double error = (model.residuals(way) - point.r).norm();
  if (!(error <= largest_error * (point.r - minimum.r).norm())) return false;
  double before = minimum.r.squaredNorm();
  for (int k = 1; k <= kSteps; ++k) {
    const double S = model.residuals(way * k / kSteps).squaredNorm();
    if (S < before) return false;
    before = S;
  }
  return true;
}

}  // namespace latsch
