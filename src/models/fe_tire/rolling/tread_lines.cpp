// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/tread_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace latsch::fe_tire {
namespace {

/// Difference of angles below which two points lie in one row across, rad.
constexpr double kSameRow = 1e-9;

}  // namespace

TreadLines::TreadLines(const TreadSurface& tread, const Mesh& mesh) {
  const auto& points = tread.points();
  const auto wrapped = [](double angle) {
    return angle > std::numbers::pi ? angle - 2.0 * std::numbers::pi : angle;
  };
  for (const TreadSurface::Point& point : points) {
    double sum = 0.0, weights = 0.0;
    for (int k = 0; k < point.weights; ++k) {
      const TreadSurface::Weight& weight = tread.weights(point)[k];
      sum += weight.w * wrapped(mesh.angle(tread.places()[weight.place].plane));
      weights += weight.w;
    }
    theta.push_back(sum / weights);
  }
  if (points.empty()) return;
  int across = 1;  // points in a row
  while (across < std::ssize(points) && std::abs(theta[across] - theta[0]) < kSameRow) ++across;
  lines.resize(across);
  for (int k = 0; k < std::ssize(points); ++k) lines[k % across].push_back(k);
  for (std::vector<int>& line : lines)
    std::ranges::sort(line, [this](int a, int b) { return theta[a] > theta[b]; });
}

}  // namespace latsch::fe_tire
