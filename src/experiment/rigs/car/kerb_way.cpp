// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/car/kerb_way.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace latsch::experiment {
namespace {

constexpr int kLines = 4;  // lines on either side of the middle, evenly spaced over the tread
// m; a smaller difference in height is below the roughness of a road
constexpr double kUnfelt = 2e-3;
// m, distance between the examined positions; a rise within a shorter distance counts as vertical
constexpr double kAlong = 5e-3;
constexpr double kTeeth = 16.0;  // least number of examined positions in one pitch of the kerb
// m; a smaller difference in height is below the roughness of a road
constexpr double kDiffers = 1e-3;
constexpr double kTouches = 1e-6;  // m, height of a kerb; a smaller one is rounding
// largest number of examined positions of a wheel; on a longer path they are farther apart
constexpr long kMostPlaces = 400'000;

/// Heights of the road below one wheel, at equidistant positions.
struct Trace {
  double x0 = 0.0, along = 0.0;  // m
  std::vector<double> highest;   // m, highest of all lines at each position
  bool differs = false;          // true if the height differs across the width
  // true if the kerb changes the height at any line that the tire model follows
  bool touches = false;
  Unfelt unfelt = {};  // without its corner; its place in the axes of the road
};

/// Returns, by bisection, the distance from the middle, m, at which the road between the middle and
/// a line at `y` rises above the height `felt`.
double edge_beside(const road::Road& road, double x, double middle, double y, double felt) {
  double inside = 0.0, outside = y;
  for (int i = 0; i < 20; ++i) {
    const double at = 0.5 * (inside + outside);
    (road.height(x, middle + at, 0.0) > felt + kUnfelt ? outside : inside) = at;
  }
  return std::abs(outside);
}

Trace trace_of(const KerbTest& test,
               const road::Road& road,
               const Eigen::Vector3d& center,
               double reach,
               double along,
               const TreadWidth& width) {
  Trace trace{.x0 = center.x() - reach, .along = along, .highest = {}};
  double time = -test.run_in, x = -reach;
  const double way = test.speed.area(test.duration) - test.speed.area(-test.run_in);
  for (; x <= way + reach; x += along) {
    // The time at which the wheel reaches the position, because the lateral line may change with
    // time.
    const double speed = test.speed.at(time);
    if (x > 0.0 && speed > 0.0 && time < test.duration) time += along / speed;
    const double y = center.y() + test.line.at(time), at = center.x() + x;
    double low = road.height(at, y, 0.0), high = low, high_at = 0.0;
    double felt_low = low, felt_high = low;
    for (int line = 1; line <= kLines; ++line)
      for (const double side : {-1.0, 1.0}) {
        const double beside = side * width.tread * line / kLines;
        const double z = road.height(at, y + beside, 0.0);
        if (z > high) high_at = beside;
        low = std::min(low, z);
        high = std::max(high, z);
        if (std::abs(beside) > width.felt) continue;
        felt_low = std::min(felt_low, z);
        felt_high = std::max(felt_high, z);
      }
    trace.highest.push_back(high);
    trace.differs = trace.differs || high - low > kDiffers;
    trace.touches = trace.touches || std::max(std::abs(felt_low), std::abs(felt_high)) > kTouches;
    const double rise = high - felt_high;
    if (rise > kUnfelt && rise > trace.unfelt.rise)
      trace.unfelt = {
          .rise = rise, .beside = edge_beside(road, at, y, high_at, felt_high), .place = at};
  }
  return trace;
}

/// Returns the path of the axle of a rigid disk, above its radius.
std::vector<double> envelope(const Trace& trace, double radius) {
  const long count = std::ssize(trace.highest),
             reach = static_cast<long>(std::floor(radius / trace.along));
  std::vector<double> arc(static_cast<std::size_t>(reach) + 1);
  for (long k = 0; k <= reach; ++k) {
    const double d = static_cast<double>(k) * trace.along;
    arc[static_cast<std::size_t>(k)] = std::sqrt(std::max(0.0, radius * radius - d * d)) - radius;
  }
  std::vector<double> path(trace.highest.size());
  for (long i = 0; i < count; ++i) {
    double highest = trace.highest[static_cast<std::size_t>(i)];
    for (long k = std::max(0L, i - reach); k <= std::min(count - 1, i + reach); ++k)
      highest = std::max(highest,
                         trace.highest[static_cast<std::size_t>(k)] +
                             arc[static_cast<std::size_t>(std::abs(k - i))]);
    path[static_cast<std::size_t>(i)] = highest;
  }
  return path;
}

/// Returns the distance of the examined positions, m.
double spacing_of(const KerbTest& test, double way) {
  double along = kAlong;
  if (test.kerb) along = std::min(along, test.kerb->pitch / kTeeth);
  if (test.kerb && test.kerb->shape == road::Kerb::Shape::block)
    along = std::min(along, 0.5 * test.kerb->length);
  return std::max(along, way / static_cast<double>(kMostPlaces));
}

}  // namespace

KerbWay way_of(const KerbTest& test, const car::Car& car, const TreadWidth& width) {
  KerbWay way;
  if (!test.kerb && !test.filed) return way;
  const auto road = road_of(test, car);
  const double driven = test.speed.area(test.duration) - test.speed.area(-test.run_in);
  const double origin = car.parts().corners[car::kFL].wheel_center.x() + test.speed.area(0.0) -
                        test.speed.area(-test.run_in);
  way.first = 1e300;
  way.last = -1e300;
  for (int corner = 0; corner < car::kCorners; ++corner) {
    const Eigen::Vector3d& center =
        car.parts().corners[static_cast<std::size_t>(corner)].wheel_center;
    const double radius = center.z();  // a tire on the ground has this radius within a quarter
    const double along = spacing_of(test, driven + 2.0 * radius);
    const Trace trace = trace_of(test, *road, center, radius, along, width);
    way.first = std::min(way.first, center.x() - origin);
    way.last = std::max(way.last, center.x() - origin + driven);
    way.varies_across = way.varies_across || trace.differs;
    way.meets = way.meets || trace.touches;
    if (trace.unfelt.rise > way.unfelt.rise) {
      way.unfelt = trace.unfelt;
      way.unfelt.corner = corner;
      way.unfelt.place -= origin;
    }
    const std::vector<double> path = envelope(trace, radius);
    const auto length = static_cast<std::size_t>(std::ceil(radius / along));
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const std::size_t to = std::min(i + length, path.size() - 1);
      if (!(path[to] - path[i] > way.rise)) continue;
      way.rise = path[to] - path[i];
      way.radius = radius;
      way.corner = corner;
      way.place = trace.x0 + static_cast<double>(i) * along + radius - origin;
    }
  }
  return way;
}

}  // namespace latsch::experiment
