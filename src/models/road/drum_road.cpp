// SPDX-License-Identifier: Apache-2.0
#include "models/road/drum_road.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace latsch::road {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
// Largest |x| on the drum as a share of its radius R. Beyond it the surface would be steeper than
// three to one.
constexpr double kEdge = 0.95;
// Edges that are shorter than this in plan view, m, count as vertical and have no surface.
constexpr double kVertical = 1e-12;

}  // namespace

DrumRoad::DrumRoad(const Settings& settings)
    : settings_(settings), R_(settings.diameter / 2.0), up_(settings.inner ? 1.0 : -1.0) {
  assert(R_ > 0.0 && fault(settings).empty());
  edge_x_ = kEdge * R_;
  edge_z_ = up_ * (R_ - std::sqrt(R_ * R_ - edge_x_ * edge_x_));
  for (const Cleat& cleat : settings_.cleats) {
    assert(!cleat.profile.empty() && cleat.profile.reach() < R_);
    const double arc = std::max(-cleat.profile.begin(), cleat.profile.end());
    // Seen from above, a corner of a cleat is displaced from its position on the drum by height *
    // tan θ. Inside |x| = 0.95 R, tan θ is below 3.1; the rest of the factor allows for curvature.
    constexpr double kLean = 10.0;
    windows_.push_back((arc / std::cos(cleat.angle) + kLean * cleat.profile.reach()) / R_);
  }
}

std::string DrumRoad::fault(const Settings& settings) {
  const double radius = settings.diameter / 2.0, around = kTurn * radius;
  // Each cleat covers an arc from `from` to `to`, m. The arc of an oblique cleat is longer.
  std::vector<std::pair<double, double>> arcs;
  for (const Cleat& cleat : settings.cleats) {
    const double stretch = 1.0 / std::cos(cleat.angle);
    const double turns = cleat.starting_angle / kTurn;
    const double middle = (turns - std::floor(turns)) * around;
    arcs.emplace_back(middle + stretch * cleat.profile.begin(),
                      middle + stretch * cleat.profile.end());
  }
  std::sort(arcs.begin(), arcs.end());
  constexpr double kRounding = 1e-9;  // tolerance, as a share of the circumference
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const bool is_last = i + 1 == arcs.size();
    const double next = is_last ? arcs.front().first + around : arcs[i + 1].first;
    if (arcs[i].second <= next + kRounding * around) continue;
    const double length = arcs[i].second - arcs[i].first;
    if (arcs.size() == 1)
      return fmt::format(
          "the cleat covers {:.4g} m of a drum that is {:.4g} m around: expected a shorter one",
          length,
          around);
    return fmt::format(
        "the cleats overlap: one covers {:.4g} mm of the drum, which is {:.4g} mm around, but the "
        "next one begins {:.4g} mm behind its begin; expected shorter or fewer cleats",
        1e3 * length,
        1e3 * around,
        1e3 * (next - arcs[i].first));
  }
  return {};
}

std::string DrumRoad::beyond(double x, double) const {
  if (std::abs(x) <= edge_x_) return {};
  return fmt::format(
      "a wheel meets a drum with a radius of {:.4g} m only within {:.4g} m of x = 0", R_, edge_x_);
}

void DrumRoad::raise(int number, double x, double y, double turned, Surface& surface) const {
  const Cleat& cleat = settings_.cleats[number];
  const double middle = cleat.starting_angle - turned - y * std::tan(cleat.angle) / R_;
  // Whole turns of the drum are subtracted such that the middle of the cleat is as near as possible
  // to the point.
  const double theta = middle - kTurn * std::round((middle - std::asin(x / R_)) / kTurn);
  if (std::abs(theta - std::asin(x / R_)) > windows_[number]) return;
  const double stretch = 1.0 / (R_ * std::cos(cleat.angle));
  double x0 = 0.0, z0 = 0.0;
  bool first = true;
  for (const Profile::Point& corner : cleat.profile.points()) {
    const double angle = theta + corner.s * stretch;
    const double r = R_ - up_ * corner.z;
    const double x1 = r * std::sin(angle), z1 = up_ * (R_ - r * std::cos(angle));
    if (!first && (x0 - x) * (x1 - x) <= 0.0 && std::abs(x1 - x0) > kVertical) {
      const double slope = (z1 - z0) / (x1 - x0);
      const double z = z0 + slope * (x - x0);
      if (z > surface.z) surface = {z, slope, number};
    }
    x0 = x1;
    z0 = z1;
    first = false;
  }
}

DrumRoad::Surface DrumRoad::locate(double x, double y, double time) const {
  Surface surface;
  if (std::abs(x) > edge_x_) {
    surface.slope = up_ * std::copysign(kEdge / std::sqrt(1.0 - kEdge * kEdge), x);
    surface.z = edge_z_ + surface.slope * (x - std::copysign(edge_x_, x));
    return surface;
  }
  const double depth = std::sqrt(R_ * R_ - x * x);
  surface.z = up_ * x * x / (R_ + depth);  // computes R - depth without cancellation
  surface.slope = up_ * x / depth;
  if (settings_.cleats.empty()) return surface;
  const double turned = settings_.surface.distance(time) / R_;
  for (int i = 0; i < std::ssize(settings_.cleats); ++i) raise(i, x, y, turned, surface);
  return surface;
}

double DrumRoad::height(double x, double y, double time) const { return locate(x, y, time).z; }

/// Returns the height of the highest point of a cleat between x0 and x1, if the middle of the cleat
/// is anywhere between the angles `first` and `last`. If both angles are equal, the result is
/// exact. Otherwise it is the highest corner of all edges that may be in this interval.
double DrumRoad::highest_of(
    const Cleat& cleat, double x0, double x1, double first, double last) const {
  const double stretch = 1.0 / (R_ * std::cos(cleat.angle));
  struct Swept {
    double left, right, z;
  };
  const auto swept = [&](const Profile::Point& corner) {
    const double r = R_ - up_ * corner.z;
    const double from = first + corner.s * stretch, to = last + corner.s * stretch;
    const double nearest = std::clamp(0.0, from, to);
    const double farthest = std::abs(from) > std::abs(to) ? from : to;
    const double z = up_ * (R_ - r * std::cos(up_ < 0.0 ? nearest : farthest));
    return Swept{r * std::sin(from), r * std::sin(to), z};
  };
  double most = -std::numeric_limits<double>::infinity();
  const auto& points = cleat.profile.points();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Swept a = swept(points[i - 1]), b = swept(points[i]);
    if (std::max(a.right, b.right) < x0 || std::min(a.left, b.left) > x1) continue;
    const double run = b.left - a.left;
    if (first < last || std::abs(run) < kVertical) {
      most = std::max({most, a.z, b.z});
      continue;
    }
    const auto [left, right] = std::minmax(a.left, b.left);
    for (const double x : {std::clamp(x0, left, right), std::clamp(x1, left, right)})
      most = std::max(most, a.z + (b.z - a.z) * (x - a.left) / run);
  }
  return most;
}

/// Returns true if a cleat may be visible in the box. `highest` is then raised to the height of
/// this cleat.
bool DrumRoad::cleat_in(const GroundBox& box, double time, double& highest) const {
  bool seen = false;
  const double turned = settings_.surface.distance(time) / R_;
  const double first = std::asin(box.x0 / R_), last = std::asin(box.x1 / R_);
  for (int i = 0; i < std::ssize(settings_.cleats); ++i) {
    const Cleat& cleat = settings_.cleats[i];
    const double t = -std::tan(cleat.angle) / R_, lean0 = std::min(box.y0 * t, box.y1 * t),
                 lean1 = std::max(box.y0 * t, box.y1 * t);
    const double middle = cleat.starting_angle - turned;
    const double theta = middle - kTurn * std::round((middle - 0.5 * (first + last)) / kTurn);
    if (theta + lean1 + windows_[i] < first || theta + lean0 - windows_[i] > last) continue;
    seen = true;
    highest = std::max(highest, highest_of(cleat, box.x0, box.x1, theta + lean0, theta + lean1));
  }
  return seen;
}

/// The highest point is at the top of an outer drum, at the sides of an inner one, or on a cleat.
GroundBounds DrumRoad::bounds(const GroundBox& box, double time) const {
  const double nearest = std::clamp(0.0, box.x0, box.x1);
  const double farthest = std::max(std::abs(box.x0), std::abs(box.x1));
  const double x = up_ < 0.0 ? nearest : farthest;
  if (farthest > edge_x_) return {};
  GroundBounds bounds{.highest = up_ * x * x / (R_ + std::sqrt(R_ * R_ - x * x))};
  if (settings_.cleats.empty() || !cleat_in(box, time, bounds.highest))
    bounds.cylinder = Cylinder{.x = 0.0,
                               .z = up_ * R_,
                               .radius = R_,
                               .up = up_,
                               .rate = up_ * settings_.surface.speed(time) / R_,
                               .friction = settings_.friction};
  return bounds;
}

GroundPoint DrumRoad::at(double x, double y, double time) const {
  const Surface surface = locate(x, y, time);
  const double above_axis = surface.z - up_ * R_;
  GroundPoint ground;
  ground.height = surface.z;
  double slope_y = 0.0;
  if (surface.cleat >= 0) {
    // At a point displaced by dy along the axle, an oblique cleat is displaced about the axis by dθ
    // = -tan(angle) dy / R. θ grows toward +x on an outer drum, whose top is the road, and on an
    // inner drum, whose floor is the road.
    const double turn = up_ * std::tan(settings_.cleats[surface.cleat].angle) / R_;
    slope_y = (-x - surface.slope * above_axis) * turn;
  }
  ground.normal = Eigen::Vector3d(-surface.slope, -slope_y, 1.0).normalized();
  ground.friction =
      surface.cleat >= 0 ? settings_.cleats[surface.cleat].friction : settings_.friction;
  const double rate = up_ * settings_.surface.speed(time) / R_;  // about +y
  ground.velocity = {rate * above_axis, 0.0, -rate * x};
  ground.turning.y() = rate;
  return ground;
}

std::vector<DrumRoad::Cleat> equally_spaced(int number, const DrumRoad::Cleat& first) {
  std::vector<DrumRoad::Cleat> cleats(number, first);
  for (int i = 0; i < number; ++i) cleats[i].starting_angle += kTurn * i / number;
  return cleats;
}

}  // namespace latsch::road
