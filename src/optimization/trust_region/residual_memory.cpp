// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/residual_memory.h"

#include <algorithm>
#include <utility>

#include "optimization/problem/infinity.h"

namespace latsch {
namespace {

// Radius of the ball to avoid around a failure, as a share of its distance to the nearest success.
constexpr double kAvoided = 0.25;
// Multiple of the median of nearby values from which on residuals count as exploded: no model is
// valid up to such values.
constexpr double kExploded = 1e6;
// Limits of the distance of samples that are used in a natural frame. In this frame the residuals
// change by their own size over a distance of 1.
constexpr double kNearInFrame = 0.1;  // the difference to a nearer sample is only noise
constexpr double kFarInFrame = 5.0;   // samples farther away are not used

}  // namespace

const std::vector<int>& ResidualMemory::nearest(int center, const Eigen::VectorXd& h) const {
  if (nearest_.center == center && nearest_.size == size() && nearest_.h == h) {
    return nearest_.indices;
  }
  std::vector<std::pair<double, int>> order;
  for (int i = 0; i < size(); ++i) {
    if (i == center) continue;
    order.push_back({(samples_[i].u - samples_[center].u).cwiseQuotient(h).norm(), i});
  }
  const auto n = static_cast<std::size_t>(samples_[center].u.size());
  const std::size_t count = std::min(order.size(), (n + 1) * (n + 2) / 2 + n);
  std::partial_sort(order.begin(), order.begin() + static_cast<long>(count), order.end());
  order.resize(count);
  nearest_ = {center, size(), h, {}};
  for (const auto& [distance, i] : order) nearest_.indices.push_back(i);
  return nearest_.indices;
}

double ResidualMemory::explosion(int center, const Eigen::VectorXd& h) const {
  std::vector<double> values;
  for (const int i : nearest(center, h)) values.push_back(samples_[i].f);
  if (values.empty()) return kInfinity;
  const auto median = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), median, values.end());
  return kExploded * std::max(*median, samples_[center].f);
}

std::vector<int> ResidualMemory::near(int center, const Eigen::VectorXd& h) const {
  std::vector<int> indices = nearest(center, h);
  const double explosion = this->explosion(center, h);
  std::erase_if(indices, [&](int i) {
    return samples_[i].f > explosion || samples_[i].stand_ins != samples_[center].stand_ins;
  });
  return indices;
}

ResidualSamples ResidualMemory::around(int center, const Eigen::VectorXd& h) const {
  const ResidualSample& c = samples_[center];
  const std::vector<int> indices = near(center, h);
  const auto rows = std::ssize(indices);
  ResidualSamples samples{
      Eigen::MatrixXd(rows, c.u.size()), Eigen::MatrixXd(rows, c.r.size()), c.r, {}};
  if (c.J.size() > 0) samples.slopes = c.J * h.asDiagonal();
  for (Eigen::Index i = 0; i < rows; ++i) {
    samples.Z.row(i) = (samples_[indices[i]].u - c.u).cwiseQuotient(h);
    samples.D.row(i) = samples_[indices[i]].r - c.r;
  }
  return samples;
}

ResidualSamples ResidualMemory::around(int center, const NaturalFrame& frame) const {
  const ResidualSample& c = samples_[center];
  std::vector<std::pair<double, int>> order;
  for (int i = 0; i < size(); ++i) {
    if (i == center || samples_[i].stand_ins != c.stand_ins) continue;
    const double distance = (frame.inverse * (samples_[i].u - c.u)).norm();
    if (distance > kNearInFrame && distance < kFarInFrame) order.push_back({distance, i});
  }
  std::sort(order.begin(), order.end());
  const auto n = static_cast<std::size_t>(frame.axes());
  order.resize(std::min(order.size(), (n + 1) * (n + 2) / 2 + n));
  const auto rows = std::ssize(order);
  ResidualSamples samples{
      Eigen::MatrixXd(rows, frame.axes()), Eigen::MatrixXd(rows, c.r.size()), c.r, {}};
  if (c.J.size() > 0) samples.slopes = c.J * frame.T;
  for (Eigen::Index k = 0; k < rows; ++k) {
    const ResidualSample& sample = samples_[order[static_cast<std::size_t>(k)].second];
    samples.Z.row(k) = frame.inverse * (sample.u - c.u);
    samples.D.row(k) = sample.r - c.r;
  }
  return samples;
}

void ResidualMemory::add(ResidualSample sample) {
  for (FailedPoint& failed : failures_) {
    failed.success = std::min(failed.success, (sample.u - failed.u).norm());
  }
  samples_.push_back(std::move(sample));
}

void ResidualMemory::add_failure(const Eigen::VectorXd& u) {
  double success = kInfinity;
  for (int i = 0; i < size(); ++i) success = std::min(success, (samples_[i].u - u).norm());
  failures_.push_back({u, success});
}

double ResidualMemory::avoided(int i) const {
  return failures_[i].success < kInfinity ? kAvoided * failures_[i].success : 0.0;
}

int ResidualMemory::failure_near(const Eigen::VectorXd& u) const {
  for (int i = 0; i < std::ssize(failures_); ++i) {
    if (u == failures_[i].u || (u - failures_[i].u).norm() < avoided(i)) return i;
  }
  return -1;
}

bool ResidualMemory::knows(const Eigen::VectorXd& u, const Eigen::VectorXd& distance) const {
  for (int i = 0; i < size(); ++i) {
    if (((samples_[i].u - u).array().abs() < distance.array()).all()) return true;
  }
  return false;
}

std::vector<Edge> ResidualMemory::edges(int center, const Eigen::VectorXd& widths) const {
  if (failures_.size() < 2) return {};
  const auto relative = [&](const Eigen::VectorXd& u) {
    return Eigen::VectorXd((u - samples_[center].u).cwiseQuotient(widths));
  };
  std::vector<Eigen::VectorXd> failed, succeeded;
  for (const FailedPoint& f : failures_) failed.push_back(relative(f.u));
  std::stable_sort(failed.begin(), failed.end(), [](const auto& x, const auto& y) {
    return x.squaredNorm() < y.squaredNorm();
  });
  for (const int i : nearest(center, widths)) succeeded.push_back(relative(samples_[i].u));
  return failure_edges(failed, succeeded);
}

}  // namespace latsch
