// SPDX-License-Identifier: Apache-2.0
#include "models/road/profile_road.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace latsch::road {

ProfileRoad::ProfileRoad(const Settings& settings)
    : settings_(settings), cos_(std::cos(settings.angle)), sin_(std::sin(settings.angle)) {
  assert(!settings_.along.empty() && settings_.pitch >= 0.0 && settings_.count >= 0);
}

Eigen::Vector2d ProfileRoad::local(double x, double y, double time) const {
  const double forward = x - settings_.origin.x() + settings_.belt.distance(time);
  const double left = y - settings_.origin.y();
  return {forward * cos_ + left * sin_, left * cos_ - forward * sin_};
}

/// Which of the repetitions a place s belongs to.
double ProfileRoad::number_at(double s) const {
  const double number = s / settings_.pitch;
  if (settings_.count <= 0) return std::floor(number);
  if (!(number > 0.0)) return 0.0;
  return number < settings_.count ? static_cast<int>(number) : settings_.count - 1;
}

ProfileRoad::Place ProfileRoad::locate(const Eigen::Vector2d& local) const {
  double s = local.x();
  if (settings_.pitch > 0.0) {
    s -= number_at(s) * settings_.pitch;
  }
  Place place{settings_.along.at(s), {1.0, 0.0}, true};
  place.on_obstacle = s >= settings_.along.begin() && s <= settings_.along.end();
  if (settings_.across) {
    const double t = local.y();
    place.across = settings_.across->at(t);
    place.on_obstacle =
        place.on_obstacle && t >= settings_.across->begin() && t <= settings_.across->end();
  }
  return place;
}

double ProfileRoad::height_at(const Eigen::Vector2d& local) const {
  const Place place = locate(local);
  return place.along.height * place.across.height;
}

double ProfileRoad::height(double x, double y, double time) const {
  return height_at(local(x, y, time));
}

std::optional<double> ProfileRoad::mean_along(const Eigen::Vector2d& begin,
                                              const Eigen::Vector2d& way) const {
  constexpr double kShortest = 1e-4;  // m: below it areas cancel
  const Profile& along = settings_.along;
  if (along.empty() || std::abs(way.x()) < kShortest) return std::nullopt;
  const Eigen::Vector2d end = begin + way;
  double across = 1.0, shift = 0.0;
  if (settings_.across) {
    const auto [low, high] = std::minmax(begin.y(), end.y());
    if (!settings_.across->points_between(low, high).empty()) return std::nullopt;
    const Profile::Value value = settings_.across->at(low);
    if (value.slope != 0.0) return std::nullopt;
    across = value.height;
  }
  if (settings_.pitch > 0.0) {
    const double number = number_at(begin.x());
    if (number != number_at(end.x())) return std::nullopt;
    shift = number * settings_.pitch;
  }
  return across * (along.area(end.x() - shift) - along.area(begin.x() - shift)) / way.x();
}

double ProfileRoad::mean_height(const Eigen::Vector2d& from,
                                const Eigen::Vector2d& to,
                                double time) const {
  const Eigen::Vector2d begin = local(from.x(), from.y(), time),
                        way = local(to.x(), to.y(), time) - begin;
  if (const auto mean = mean_along(begin, way)) return *mean;
  std::vector<double> corners{0.0, 1.0};  // where on the way
  const auto add_corner = [&](double distance, double run) {
    if (const double u = distance / run; u > 0.0 && u < 1.0) corners.push_back(u);
  };
  const auto add = [&](const Profile& profile, double shift, double start, double run) {
    constexpr double kSlack = 1e-6;  // m, beyond rounding: add_corner() decides
    const double from = std::min(start, start + run) - shift,
                 to = std::max(start, start + run) - shift;
    for (const Profile::Point& p : profile.points_between(from - kSlack, to + kSlack))
      add_corner(p.s + shift - start, run);
  };
  if (settings_.across) add(*settings_.across, 0.0, begin.y(), way.y());
  if (settings_.pitch == 0.0) {
    add(settings_.along, 0.0, begin.x(), way.x());
  } else {
    const double first = std::min(begin.x(), begin.x() + way.x()), last = first + std::abs(way.x());
    const double end = number_at(last), start = number_at(first);
    for (double i = 0.0; i <= end - start; ++i) {  // far out start + i no longer grows by steps
      const double n = start + i;
      add_corner(n * settings_.pitch - begin.x(), way.x());  // the seam
      add(settings_.along, n * settings_.pitch, begin.x(), way.x());
    }
  }
  std::sort(corners.begin(), corners.end());
  // Two points of Gauss a piece: exact to the third degree, and never on a flank.
  const double off = 0.5 / std::sqrt(3.0);
  double sum = 0.0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double length = corners[i] - corners[i - 1];
    if (length == 0.0) continue;
    const double middle = 0.5 * (corners[i] + corners[i - 1]);
    sum += 0.5 * length *
           (height_at(begin + (middle - off * length) * way) +
            height_at(begin + (middle + off * length) * way));
  }
  return sum;
}

GroundPoint ProfileRoad::at(double x, double y, double time) const {
  const Place place = locate(local(x, y, time));
  const double along = place.along.slope * place.across.height;   // dz/ds
  const double across = place.along.height * place.across.slope;  // dz/dt
  GroundPoint ground;
  ground.height = place.along.height * place.across.height;
  ground.normal = Eigen::Vector3d(-along * cos_ + across * sin_, -along * sin_ - across * cos_, 1.0)
                      .normalized();
  ground.friction = place.on_obstacle ? settings_.obstacle_friction : settings_.friction;
  ground.velocity.x() = -settings_.belt.speed(time);
  return ground;
}

/// A plane where the whole box is beside the sections or on one straight piece, as long as what
/// stands across does not change in it.
GroundBounds ProfileRoad::bounds(const GroundBox& box, double time) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double shift = settings_.belt.distance(time) - settings_.origin.x();
  Span s{kInfinity, -kInfinity}, t = s;
  for (const double x : {box.x0, box.x1})
    for (const double y : {box.y0, box.y1}) {
      const double forward = x + shift, left = y - settings_.origin.y();
      s.add(forward * cos_ + left * sin_);
      t.add(left * cos_ - forward * sin_);
    }
  if (settings_.pitch == 0.0) return bounds_between(s, t);
  const double first = number_at(s.from), last = number_at(s.to);
  if (first == last)
    return bounds_between({s.from - first * settings_.pitch, s.to - first * settings_.pitch}, t);
  const bool two = last - first == 1.0;
  const double rear = two ? s.from - first * settings_.pitch : 0.0;
  const double front = two ? s.to - last * settings_.pitch : settings_.pitch;
  const Span beyond{std::min(0.0, s.from - first * settings_.pitch),
                    std::max(settings_.pitch, s.to - last * settings_.pitch)};
  return {std::max({bounds_between({rear, two ? settings_.pitch : beyond.to}, t).highest,
                    bounds_between({two ? 0.0 : beyond.from, front}, t).highest}),
          false};
}

GroundBounds ProfileRoad::bounds_between(Span s, Span t) const {
  const auto corner_in = [](const Profile& profile, const Span& span) {
    return !profile.points_between(span.from, span.to).empty();
  };
  const bool beside = s.to < settings_.along.begin() || s.from > settings_.along.end();
  const Profile::Extremes along = settings_.along.between(s.from, s.to);
  const bool straight = beside || !corner_in(settings_.along, s);
  if (!settings_.across) return {along.highest, straight};
  const Profile::Extremes across = settings_.across->between(t.from, t.to);
  const bool level = along.highest == 0.0 && along.lowest == 0.0;
  const bool uniform = across.lowest == across.highest && !corner_in(*settings_.across, t);
  return {std::max({along.highest * across.highest,
                    along.highest * across.lowest,
                    along.lowest * across.highest,
                    along.lowest * across.lowest}),
          uniform ? straight : beside && level};
}

ProfileRoad cleat_road(double x, double height, double length, double bevel, double angle) {
  ProfileRoad::Settings settings;
  settings.along = cleat_profile(height, length, bevel);
  settings.origin.x() = x;
  settings.angle = angle;
  return ProfileRoad(settings);
}

}  // namespace latsch::road
