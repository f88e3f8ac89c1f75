// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/contact/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace latsch::fe_tire {
namespace {

constexpr double kNear = 5e-5, kFar = 2e-4;  // m, heights g_1 and g_2 of (F.1)

/// Samples one after the other along x (axis 0) or y (axis 1).
struct Line {
  const std::vector<int>& samples;
  const Eigen::Matrix3Xd& at;
  int axis;

  int size() const { return static_cast<int>(samples.size()); }
  double place(int k) const { return at(axis, samples[k]); }
  double root(int k) const { return std::sqrt(std::max(at(2, samples[k]), 0.0)); }
  bool touches(int k) const { return at(2, samples[k]) < kNear; }

  /// Where the root passes a value beyond k; nullopt where the line ends or comes down before.
  std::optional<double> passes(double value, int k, int step) const {
    for (int next = k + step; next >= 0 && next < size(); k = next, next += step) {
      if (root(next) < root(k)) return std::nullopt;
      if (root(next) < value) continue;
      const double share = (value - root(k)) / (root(next) - root(k));
      return place(k) + share * (place(next) - place(k));
    }
    return std::nullopt;
  }
  /// The edge beyond the last sample that touches.
  double edge(int last, int step) const {
    const auto near = passes(std::sqrt(kNear), last, step);
    if (!near) return place(last);
    const auto far = passes(std::sqrt(kFar), last, step);
    if (!far) return *near;
    constexpr double kRatio = 1.0;  // sqrt(g_1) / (sqrt(g_2) - sqrt(g_1)), as g_2 = 4 g_1
    return *near - kRatio * (*far - *near);
  }
};

/// Runs of samples that touch.
struct Run {
  int first, last;
  double from, to;  // m, its edges
  double length;    // m; not positive where the edges meet before they leave something
};

std::vector<Run> runs_of(const Line& line) {
  std::vector<Run> runs;
  for (int k = 0; k < line.size(); ++k) {
    if (!line.touches(k)) continue;
    int last = k;
    while (last + 1 < line.size() && line.touches(last + 1)) ++last;
    const double from = line.edge(k, -1), to = line.edge(last, 1);
    const double forward = line.place(line.size() - 1) > line.place(0) ? 1.0 : -1.0;
    runs.push_back({k, last, from, to, forward * (to - from)});
    k = last;
  }
  return runs;
}

struct Extent {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  void add(double at) {
    lowest = std::min(lowest, at);
    highest = std::max(highest, at);
  }
  void add(const Run& run) {
    if (run.length <= 0.0) return;
    add(run.from);
    add(run.to);
  }
  /// With the image under the half turn.
  double length(bool halved) const {
    if (highest < lowest) return 0.0;
    return halved ? 2.0 * std::max(highest, -lowest) : highest - lowest;
  }
};

}  // namespace

FootprintSize footprint_size(const TreadSurface& tread,
                             const Eigen::Matrix3Xd& at,
                             const Eigen::VectorXd& area) {
  FootprintSize size;
  Extent along, across;
  for (const std::vector<int>& samples : tread.lines_around()) {
    const Line line{samples, at, 0};
    for (const Run& run : runs_of(line)) {
      along.add(run);
      double covered = 0.0, touching = 0.0;  // m, m^2
      for (int k = run.first; k <= run.last; ++k) {
        const int before = std::max(k - 1, 0), after = std::min(k + 1, line.size() - 1);
        covered += std::abs(line.place(after) - line.place(before)) / (after - before);
        touching += area[samples[k]];
      }
      // A half ring's lines begin at its middle, half a sample before the first one.
      const bool from_middle = tread.multiplicity() > 1.0 && run.first == 0;
      const double from = from_middle ? 0.0 : run.from;
      size.area += touching * std::max(run.to - from, 0.0) / covered;
    }
  }
  for (const std::vector<int>& samples : tread.lines_across()) {
    const Line line{samples, at, 1};
    for (const Run& run : runs_of(line)) across.add(run);
  }
  const bool halved = tread.multiplicity() > 1.0;
  size.area *= tread.multiplicity();
  size.length = along.length(halved);
  size.width = across.length(halved);
  return size;
}

}  // namespace latsch::fe_tire
