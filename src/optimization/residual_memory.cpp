// SPDX-License-Identifier: Apache-2.0
#include "optimization/residual_memory.h"

#include <algorithm>
#include <utility>

#include "optimization/infinity.h"

namespace latsch {
namespace {

constexpr double kAvoided = 0.25;  // of the distance to the nearest success
constexpr double kExploded = 1e6;  // times the median of the values around: no model reaches so far

}  // namespace

std::vector<int> ResidualMemory::nearest(int center, const Eigen::VectorXd& h) const {
  std::vector<std::pair<double, int>> order;
  for (int i = 0; i < size(); ++i) {
    if (i == center) continue;
    order.push_back({(samples_[i].u - samples_[center].u).cwiseQuotient(h).norm(), i});
  }
  std::sort(order.begin(), order.end());
  const auto n = static_cast<std::size_t>(samples_[center].u.size());
  order.resize(std::min(order.size(), (n + 1) * (n + 2) / 2 + n));
  std::vector<int> indices;
  for (const auto& [distance, i] : order) indices.push_back(i);
  return indices;
}

double ResidualMemory::explosion(int center, const Eigen::VectorXd& h) const {
  std::vector<double> values;
  for (const int i : nearest(center, h)) values.push_back(samples_[i].f);
  if (values.empty()) return kInfinity;
  const auto median = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), median, values.end());
  return kExploded * *median;
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

bool ResidualMemory::has_failed_near(const Eigen::VectorXd& u) const {
  return std::any_of(failures_.begin(), failures_.end(), [&](const Eigen::VectorXd& failed) {
    double success = kInfinity;
    for (const ResidualSample& s : samples_) success = std::min(success, (s.u - failed).norm());
    return u == failed || (success < kInfinity && (u - failed).norm() < kAvoided * success);
  });
}

bool ResidualMemory::knows(const Eigen::VectorXd& u, const Eigen::VectorXd& distance) const {
  return std::any_of(samples_.begin(), samples_.end(), [&](const ResidualSample& s) {
    return ((s.u - u).array().abs() < distance.array()).all();
  });
}

}  // namespace latsch
