// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/contact/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace latsch::fe_tire {
namespace {

constexpr double kLowHeight = 3e-4;  // m, lower of the two heights at which (F.1) is fitted
constexpr double kRatio = 4.0;       // ratio of the upper height to the lower one
// Smallest ratio of the lower height to the distance that samples inside the patch have from the
// ground.
constexpr double kBeyondRest = 4.0;

/// Returns half the length a of the patch for which the gap (F.1) has the given ratio g(s_2) /
/// g(s_1). Returns zero if the gap grows more slowly than beside any patch.
double half_length(double s_1, double s_2, double ratio) {
  const auto f = [](double t) { return t * std::sqrt(t * t - 1.0) - std::acosh(t); };
  if (s_2 * s_2 >= ratio * s_1 * s_1) return 0.0;
  // While a grows from low to high, the ratio grows from (s_2 / s_1)^2 to infinity.
  double low = 0.0, high = s_1;
  for (int k = 0; k < 40; ++k) {
    const double a = 0.5 * (low + high);
    (f(s_2 / a) < ratio * f(s_1 / a) ? low : high) = a;
  }
  return low;
}

/// A line of tread samples along x (axis 0) or y (axis 1).
struct Line {
  const std::vector<int>& samples;
  const Eigen::Matrix3Xd& at;
  int axis;
  double near;  // m, lower of the heights at which (F.1) is fitted

  int size() const { return static_cast<int>(samples.size()); }
  double place(int k) const { return at(axis, samples[k]); }
  double root(int k) const { return std::sqrt(std::max(at(2, samples[k]), 0.0)); }
  bool touches(int k) const { return at(2, samples[k]) < near; }

  /// Returns the position at which the surface first rises above `height`, going from sample k in
  /// the direction `step`. Returns nothing if the line ends or descends before.
  std::optional<double> passes(double height, int k, int step) const {
    const double value = std::sqrt(height);
    for (int next = k + step; next >= 0 && next < size(); k = next, next += step) {
      if (root(next) < root(k)) return std::nullopt;
      if (root(next) < value) continue;
      const double share = (value - root(k)) / (root(next) - root(k));
      return place(k) + share * (place(next) - place(k));
    }
    return std::nullopt;
  }
};

/// Consecutive samples that touch the ground, with the edges of this part of the patch.
struct Run {
  int first, last;
  double from, to;  // m, positions of its edges
  // Length, m. It is not positive if both edges coincide before the gap grows like that beside a
  // patch.
  double length;
};

Run run_of(const Line& line, int first, int last, bool from_middle) {
  const auto near = [&](int k, int step) { return line.passes(line.near, k, step); };
  const double from = from_middle ? 0.0 : near(first, -1).value_or(line.place(first));
  const double to = near(last, 1).value_or(line.place(last));
  const double middle = from_middle ? 0.0 : 0.5 * (from + to);
  const auto edge = [&](double at, int k, int step) {
    const auto far = line.passes(kRatio * line.near, k, step);
    if (!near(k, step) || !far) return at;
    const double half = half_length(std::abs(at - middle), std::abs(*far - middle), kRatio);
    return middle + std::copysign(half, at - middle);
  };
  Run run{first, last, from_middle ? 0.0 : edge(from, first, -1), edge(to, last, 1), 0.0};
  const double forward = line.place(line.size() - 1) > line.place(0) ? 1.0 : -1.0;
  run.length = forward * (run.to - run.from);
  return run;
}

/// Finds the groups of consecutive touching samples. If `halved`, the line is half of a symmetric
/// one: its first sample is half a spacing away from the middle.
std::vector<Run> runs_of(const Line& line, bool halved) {
  std::vector<Run> runs;
  for (int k = 0; k < line.size(); ++k) {
    if (!line.touches(k)) continue;
    int last = k;
    while (last + 1 < line.size() && line.touches(last + 1)) ++last;
    runs.push_back(run_of(line, k, last, halved && k == 0));
    k = last;
  }
  return runs;
}

/// Returns the area, m^2, of the strip of samples that the touching part covers. The width of the
/// strip is linear between samples, so that the area changes continuously as samples are added. A
/// sample at the same position as its neighbors has no width.
double covered(const Line& line, const Eigen::VectorXd& area, const Run& run) {
  const int last = line.size() - 1;
  const auto width = [&](int k) {
    const int before = std::max(k - 1, 0), after = std::min(k + 1, last);
    const double along = std::abs(line.place(after) - line.place(before)) / (after - before);
    return along > 0.0 ? area[line.samples[k]] / along : 0.0;
  };
  const auto [from, to] = std::minmax(run.from, run.to);
  const double begin = std::min(line.place(0), line.place(last));
  const double end = std::max(line.place(0), line.place(last));
  const bool forward = line.place(last) > line.place(0);
  double sum = width(forward ? 0 : last) * std::max(std::min(begin, to) - from, 0.0) +
               width(forward ? last : 0) * std::max(to - std::max(end, from), 0.0);
  for (int k = 0; k < last; ++k) {
    const double x = line.place(k), dx = line.place(k + 1) - x;
    const double low = std::max(std::min(x, x + dx), from);
    const double high = std::min(std::max(x, x + dx), to);
    if (!(high > low)) continue;
    const double share = (0.5 * (low + high) - x) / dx;
    sum += (high - low) * ((1.0 - share) * width(k) + share * width(k + 1));
  }
  return sum;
}

/// Returns the heights averaged along lines of samples. The weight is a hat function that reaches
/// one element face to both sides.
Eigen::VectorXd means(const std::vector<std::vector<int>>& lines, const Eigen::VectorXd& height) {
  constexpr int kReach = TreadSurface::kSamples;
  Eigen::VectorXd mean = height;
  for (const std::vector<int>& line : lines) {
    const int size = static_cast<int>(line.size());
    for (int k = 0; k < size; ++k) {
      double sum = 0.0, weights = 0.0;
      for (int at = std::max(k - kReach + 1, 0); at < std::min(k + kReach, size); ++at) {
        const double weight = kReach - std::abs(at - k);
        sum += weight * height[line[at]];
        weights += weight;
      }
      mean[line[k]] = sum / weights;
    }
  }
  return mean;
}

struct Spread {
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
  /// Returns the length including the image under the half turn.
  double length(bool halved) const {
    if (highest < lowest) return 0.0;
    return halved ? 2.0 * std::max(highest, -lowest) : highest - lowest;
  }
};

}  // namespace

FootprintSize footprint_size(const TreadSurface& tread,
                             const Eigen::Matrix3Xd& at,
                             const Eigen::VectorXd& area,
                             double rest) {
  FootprintSize size;
  Spread along, across;
  const bool halved = tread.multiplicity() > 1.0;
  const double near = std::max(kLowHeight, kBeyondRest * rest);
  const std::vector<std::vector<int>> lines_across = tread.lines_across();
  Eigen::Matrix3Xd around = at;
  if (tread.shape() == TreadShape::smooth) {
    const Eigen::VectorXd height = at.row(2);
    around.row(2) = 0.5 * (height + means(lines_across, height)).transpose();  // (F.2)
  }
  for (const std::vector<int>& samples : tread.lines_around()) {
    const Line line{samples, around, 0, near};
    for (const Run& run : runs_of(line, halved)) {
      along.add(run);
      if (run.length > 0.0) size.area += covered(line, area, run);
    }
  }
  if (along.length(halved) == 0.0) return {};  // the gap does not grow as it does beside a patch
  for (const std::vector<int>& samples : lines_across) {
    const Line line{samples, at, 1, near};
    for (const Run& run : runs_of(line, false)) across.add(run);
  }
  size.area *= tread.multiplicity();
  size.length = along.length(halved);
  size.width = across.length(halved);
  return size;
}

}  // namespace latsch::fe_tire
