// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/grip/tread_past.h"

#include <algorithm>
#include <array>
#include <utility>

namespace latsch::fe_tire {
namespace {

/// Weights of three instants in the parabola through them.
std::array<double, 3> parabola(const std::array<double, 3>& t, double at) {
  std::array<double, 3> weights;
  for (int j = 0; j < 3; ++j) {
    const double a = t[(j + 1) % 3], b = t[(j + 2) % 3];
    weights[j] = (at - a) * (at - b) / ((t[j] - a) * (t[j] - b));
  }
  return weights;
}

/// Weights of three instants, the latest first, in the straight lines through them.
std::array<double, 3> lines_through(const std::array<double, 3>& t, double at) {
  const int from = at >= t[1] ? 0 : 1;
  const double share = std::min(1.0, (t[from] - at) / (t[from] - t[from + 1]));
  std::array<double, 3> weights = {0.0, 0.0, 0.0};
  weights[from] = 1.0 - share;
  weights[from + 1] = share;
  return weights;
}

}  // namespace

TreadPast::TreadPast(Instant steady, double longest) : longest_(longest) {
  // A steady state is the same at all times.
  for (const double time : {0.0, -longest, -2.0 * longest}) {
    instants_.push_back(steady);
    times_.push_back(time);
  }
}

void TreadPast::add(Instant next, double step) {
  instants_.push_front(std::move(next));
  times_.push_front(times_.front() + step);
  // Two instants before the longest delay remain, for a parabola.
  while (times_.size() > 3 && times_[times_.size() - 3] < times_.front() - longest_) {
    instants_.pop_back();
    times_.pop_back();
  }
}

Upstream TreadPast::upstream(const std::vector<int>& points,
                             const RollingLines& lines,
                             double step) const {
  const int n = lines.points(), last = static_cast<int>(times_.size());
  Upstream upstream{
      Eigen::VectorXd::Zero(n), Eigen::Matrix3Xd::Zero(3, n), Eigen::Matrix2Xd::Zero(2, n), {}};
  const double now = times_.front() + step;
  // Number 0 is now, number 1 the latest instant.
  const auto time = [&](int number) { return number == 0 ? now : times_[number - 1]; };
  for (const RollingLines::Line& line : lines.lines) {
    for (int k = line.first + 1; k < line.last; ++k) {
      const int before = points[k - 1];
      const double at = now - lines.time[k];
      int first = 0;
      while (first + 3 <= last && time(first + 2) > at) ++first;
      first = std::min(first, last - 2);
      const std::array<double, 3> times = {time(first), time(first + 1), time(first + 2)};
      const auto touches = [&](int number) {
        return number == 0 || instants_[number - 1].x(2, before) < 0.0;
      };
      const bool all = touches(first) && touches(first + 1) && touches(first + 2);
      const std::array<double, 3> weights = all ? parabola(times, at) : lines_through(times, at);
      for (int j = 0; j < 3; ++j) {
        if (first + j == 0) {
          upstream.now[k] = weights[j];
          continue;
        }
        const Instant& instant = instants_[first + j - 1];
        upstream.x.col(k) += weights[j] * instant.x.col(before);
        upstream.t.col(k) += weights[j] * instant.t.col(before);
      }
    }
  }
  return upstream;
}

}  // namespace latsch::fe_tire
