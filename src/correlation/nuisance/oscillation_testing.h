// SPDX-License-Identifier: Apache-2.0
// A decaying oscillation with its exact slopes, as the simulation of tests of nuisance numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "measurement/channels.h"

namespace latsch::correlation {

inline constexpr int kRecorded = 120;
inline constexpr double kRecordedStep = 0.01;  // s
inline constexpr double kRecordedNoise = 0.05;

/// Decaying oscillation a exp(-k t) cos(9 t + 0.4), simulated from -0.4 to 1.6 s.
inline Channels oscillation(double a, double k) {
  Channel t{"out/t", "s", {}}, y{"out/y", "N", {}};
  std::vector<double> by_k;
  for (int i = 0; i <= 2000; ++i) {
    const double at = -0.4 + 1e-3 * i, shape = std::exp(-k * at) * std::cos(9.0 * at + 0.4);
    t.values.push_back(at);
    y.values.push_back(a * shape);
    y.slopes.push_back(shape);
    by_k.push_back(-at * a * shape);
  }
  y.slopes.insert(y.slopes.end(), by_k.begin(), by_k.end());
  t.slopes.assign(y.slopes.size(), 0.0);
  Channels channels;
  channels.add(t);
  channels.add(y);
  return channels;
}

/// Returns the simulated curve at t and its slopes by a, k and t.
struct CurvePoint {
  double y, by_a, by_k, by_t;
};
inline CurvePoint oscillation_at(const Channels& channels, double t) {
  const Channel& x = *channels.find("out/t");
  const Channel& y = *channels.find("out/y");
  const std::size_t n = x.values.size();
  const auto right = std::upper_bound(x.values.begin(), x.values.end() - 1, t);
  const auto r = static_cast<std::size_t>(right - x.values.begin()), l = r - 1;
  const double share = (t - x.values[l]) / (x.values[r] - x.values[l]);
  const auto between = [&](const std::vector<double>& v, std::size_t from) {
    return v[from + l] + share * (v[from + r] - v[from + l]);
  };
  return {between(y.values, 0),
          between(y.slopes, 0),
          between(y.slopes, n),
          (y.values[r] - y.values[l]) / (x.values[r] - x.values[l])};
}

}  // namespace latsch::correlation
