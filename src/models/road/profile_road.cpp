// SPDX-License-Identifier: Apache-2.0
#include "models/road/profile_road.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace latsch::road {
namespace {

// Length of a line, m, below which the difference of two integrals would lose its digits.
constexpr double kShortest = 1e-4;

}  // namespace

ProfileRoad::ProfileRoad(const Settings& settings)
    : settings_(settings), cos_(std::cos(settings.angle)), sin_(std::sin(settings.angle)) {
  assert(!settings_.along.empty() && settings_.pitch >= 0.0 && settings_.count >= 0);
}

Eigen::Vector2d ProfileRoad::local(double x, double y, double time) const {
  const double forward = x - settings_.origin.x() + settings_.belt.distance(time);
  const double left = y - settings_.origin.y();
  return {forward * cos_ + left * sin_, left * cos_ - forward * sin_};
}

/// Returns the index of the repetition that contains the position s.
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
  if (settings_.across) place.across = settings_.across->at(local.y());
  place.on_obstacle = is_on_obstacle(s, local.y());
  return place;
}

bool ProfileRoad::is_on_obstacle(double s, double t) const {
  const auto holds = [](const Profile& profile, double at) {
    return at >= profile.begin() && at <= profile.end();
  };
  return holds(settings_.along, s) && (!settings_.across || holds(*settings_.across, t));
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
  // Positions along the line, 0 to 1, at which the slope changes.
  std::vector<double> corners{0.0, 1.0};
  const auto add_corner = [&](double distance, double run) {
    if (const double u = distance / run; u > 0.0 && u < 1.0) corners.push_back(u);
  };
  const auto add = [&](const Profile& profile, double shift, double start, double run) {
    // Margin, m, larger than rounding errors; add_corner() rejects points outside the line.
    constexpr double kSlack = 1e-6;
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
    // The number of iterations is computed as a difference, because far from the origin adding 1 to
    // a double may not change it.
    for (double i = 0.0; i <= end - start; ++i) {
      const double n = start + i;
      add_corner(n * settings_.pitch - begin.x(), way.x());  // boundary between two repetitions
      add(settings_.along, n * settings_.pitch, begin.x(), way.x());
    }
  }
  std::sort(corners.begin(), corners.end());
  // Two Gauss points per piece integrate polynomials of third degree exactly. They never coincide
  // with a vertical flank.
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
  const double along = place.along.slope * place.across.height;   // derivative of the height by s
  const double across = place.along.height * place.across.slope;  // derivative of the height by t
  GroundPoint ground;
  ground.height = place.along.height * place.across.height;
  ground.normal = Eigen::Vector3d(-along * cos_ + across * sin_, -along * sin_ - across * cos_, 1.0)
                      .normalized();
  ground.friction = place.on_obstacle ? settings_.obstacle_friction : settings_.friction;
  ground.velocity.x() = -settings_.belt.speed(time);
  return ground;
}

/// Positions of a row in the order border, middle, border ... First all positions are computed,
/// then the profiles at all of them, so that the processor can overlap the look-ups.
struct ProfileRoad::RowPlaces {
  static constexpr int kPieces = 16;  // largest number of pieces that are evaluated together
  template <class Value>
  using Of = std::array<Value, 2 * kPieces + 1>;

  std::size_t count;
  Of<double> s, t, number;  // s is measured from the start of its repetition
  Of<Profile::Value> along, across;
  Of<double> height;
  Of<double> area;  // integral of `along`, computed if the profile across is level
  // True: the height factor across is the same at all positions of the row and between them.
  bool level;
};

void ProfileRoad::below(const GroundRow& row, double time, const RowGround& ground) const {
  RowPlaces places;
  for (int first = 0; first < row.count; first += RowPlaces::kPieces) {
    const int end = std::min(row.count, first + RowPlaces::kPieces);
    place(row, first, end, time, places);
    look_up(places);
    describe(row, first, end, time, places, ground);
  }
}

void ProfileRoad::place(
    const GroundRow& row, int first, int end, double time, RowPlaces& places) const {
  const double shift = settings_.belt.distance(time) - settings_.origin.x();
  places.count = static_cast<std::size_t>(2 * (end - first) + 1);
  for (std::size_t i = 0; i < places.count; ++i) {
    const std::size_t j = static_cast<std::size_t>(first) + i / 2;
    const bool border = i % 2 == 0;
    const double forward = (border ? row.border_x : row.x)[j] + shift;
    const double left = (border ? row.border_y : row.y)[j] - settings_.origin.y();
    const double s = forward * cos_ + left * sin_;
    places.t[i] = left * cos_ - forward * sin_;
    places.number[i] = settings_.pitch > 0.0 ? number_at(s) : 0.0;
    places.s[i] = s - places.number[i] * settings_.pitch;
  }
}

void ProfileRoad::look_up(RowPlaces& places) const {
  const std::size_t n = places.count;
  places.level = true;
  if (settings_.across) {
    const auto [low, high] = std::minmax_element(places.t.begin(), places.t.begin() + n);
    const Profile::Value value = settings_.across->at(*low);
    places.level = value.slope == 0.0 && settings_.across->points_between(*low, *high).empty();
    if (places.level) {
      std::fill_n(places.across.begin(), n, value);
    } else {
      Profile::Walk across(*settings_.across);
      for (std::size_t i = 0; i < n; ++i) places.across[i] = across.at(places.t[i]);
    }
  } else {
    std::fill_n(places.across.begin(), n, Profile::Value{1.0, 0.0});
  }
  Profile::Walk along(settings_.along);
  for (std::size_t i = 0; i < n; ++i) {
    places.along[i] = along.at(places.s[i]);
    places.height[i] = places.along[i].height * places.across[i].height;
    if (places.level) places.area[i] = along.area_to(places.s[i]);
  }
}

void ProfileRoad::describe(const GroundRow& row,
                           int first,
                           int end,
                           double time,
                           const RowPlaces& places,
                           const RowGround& ground) const {
  const auto& [count, s, t, number, along, across, height, area, level] = places;
  const double speed = settings_.belt.speed(time);
  ground.border_height[first] = height[0];
  for (int j = first; j < end; ++j) {
    const auto from = static_cast<std::size_t>(2 * (j - first)), middle = from + 1, to = from + 2;
    ground.border_height[j + 1] = height[to];
    ground.height[j] = ground.mean[j] = height[middle];
    const double way = s[to] - s[from];
    if (!is_straight(height[from], height[middle], height[to]))
      ground.mean[j] = level && number[to] == number[from] && std::abs(way) >= kShortest
                           ? across[from].height * (area[to] - area[from]) / way
                           : mean_height({row.border_x[j], row.border_y[j]},
                                         {row.border_x[j + 1], row.border_y[j + 1]},
                                         time);
    // Derivative of the height by s.
    const double by_s = along[middle].slope * across[middle].height;
    // Derivative of the height by t.
    const double by_t = along[middle].height * across[middle].slope;
    ground.slope[0][j] = by_s * cos_ - by_t * sin_;
    ground.slope[1][j] = by_s * sin_ + by_t * cos_;
    ground.friction[j] =
        is_on_obstacle(s[middle], t[middle]) ? settings_.obstacle_friction : settings_.friction;
    ground.velocity[0][j] = -speed;
    ground.velocity[1][j] = ground.velocity[2][j] = 0.0;
  }
}

/// Reports the box as a plane if it lies completely beside the obstacle, or on one straight edge of
/// the profile, and the profile across is constant in it.
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
  const GroundBounds behind = bounds_between({rear, two ? settings_.pitch : beyond.to}, t),
                     ahead = bounds_between({two ? 0.0 : beyond.from, front}, t);
  return {.highest = std::max(behind.highest, ahead.highest),
          .plane = false,
          .lines_differ = behind.lines_differ || ahead.lines_differ};
}

GroundBounds ProfileRoad::bounds_between(Span s, Span t) const {
  const auto corner_in = [](const Profile& profile, const Span& span) {
    return !profile.points_between(span.from, span.to).empty();
  };
  const bool beside = s.to < settings_.along.begin() || s.from > settings_.along.end();
  const Profile::Extremes along = settings_.along.between(s.from, s.to);
  const bool straight = beside || !corner_in(settings_.along, s);
  if (!settings_.across)
    return {.highest = along.highest, .plane = straight, .lines_differ = sin_ != 0.0};
  const Profile::Extremes across = settings_.across->between(t.from, t.to);
  const bool level = along.highest == 0.0 && along.lowest == 0.0;
  const bool uniform = across.lowest == across.highest && !corner_in(*settings_.across, t);
  return {.highest = std::max({along.highest * across.highest,
                               along.highest * across.lowest,
                               along.lowest * across.highest,
                               along.lowest * across.lowest}),
          .plane = uniform ? straight : beside && level,
          .lines_differ = !uniform || sin_ != 0.0};
}

ProfileRoad cleat_road(double x, double height, double length, double bevel, double angle) {
  ProfileRoad::Settings settings;
  settings.along = cleat_profile(height, length, bevel);
  settings.origin.x() = x;
  settings.angle = angle;
  return ProfileRoad(settings);
}

}  // namespace latsch::road
