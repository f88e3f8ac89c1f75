// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/tire_description.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace latsch::fe_tire {

double WallProfile::at(double q) const {
  if (q <= position.front()) return length.front();
  if (q >= position.back()) return length.back();
  const auto i = std::upper_bound(position.begin(), position.end(), q) - position.begin();
  const double part = (q - position[i - 1]) / (position[i] - position[i - 1]);
  return length[i - 1] + part * (length[i] - length[i - 1]);
}

namespace {

/// Elements up to position q, in units of elements of length 1: the integral of dq / length.
double elements_before(const SpacingProfile& spacing, double q) {
  double count = 0.0, from = 0.0;
  for (std::size_t i = 0; i + 1 < spacing.position.size() && from < q; ++i) {
    const double a = spacing.position[i], b = spacing.position[i + 1];
    const double slope = (spacing.length[i + 1] - spacing.length[i]) / (b - a);
    const double to = std::min(b, q), mean = spacing.length[i] + slope * (0.5 * (a + to) - a);
    const double x =
        0.5 * slope * (to - a) / mean;  // int dq / length = (to - a) / mean * atanh(x) / x
    count += (to - a) / mean * (std::abs(x) < 1e-6 ? 1.0 + x * x / 3.0 : std::atanh(x) / x);
    from = to;
  }
  return count;
}

}  // namespace

std::vector<double> Section::sector_planes(int refinement) const {
  if (sector_zones.empty()) return {};
  const int half = refinement * sectors / 2;
  std::vector<double> theta = {0.0};
  double edge = 0.0;
  const auto fill = [&](int count, double to) {
    const double from = edge;
    for (int k = 1; k <= count; ++k) theta.push_back(from + (to - from) * k / count);
    edge = to;
  };
  for (const SectorZone& zone : sector_zones) {
    fill(refinement * zone.sectors, edge + zone.sectors * zone.width);
  }
  fill(half + 1 - static_cast<int>(theta.size()), std::numbers::pi);
  for (int s = half - 1; s > 0; --s) theta.push_back(2.0 * std::numbers::pi - theta[s]);
  return theta;
}

double Section::station(double column) const {
  const double s = 2.0 * column / meridional - 1.0;
  if (spacing.position.empty()) return s;
  const double wanted = std::abs(s) * elements_before(spacing, 1.0);
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {  // monotone: bisection to the last bit
    const double middle = 0.5 * (low + high);
    (elements_before(spacing, middle) < wanted ? low : high) = middle;
  }
  return std::copysign(high, s);
}

}  // namespace latsch::fe_tire
