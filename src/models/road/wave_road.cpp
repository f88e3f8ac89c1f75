// SPDX-License-Identifier: Apache-2.0
#include "models/road/wave_road.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace latsch::road {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace

WaveRoad::WaveRoad(const Settings& settings) : settings_(settings) {
  const double length = settings.end - settings.start;
  assert(length > 0.0 && settings.wave_length_begin > 0.0 && settings.wave_length_end > 0.0);
  growth_ = (settings.amplitude_end - settings.amplitude_begin) / length;
  stretch_ = settings.exponential
                 ? std::log(settings.wave_length_end / settings.wave_length_begin) / length
                 : (settings.wave_length_end - settings.wave_length_begin) / length;
}

GroundPoint WaveRoad::at(double x, double, double) const {
  GroundPoint ground;
  ground.friction = settings_.friction;
  if (x < settings_.start || x > settings_.end) return ground;
  const double s = x - settings_.start;
  const double first = settings_.wave_length_begin;
  const double k = stretch_;
  double phase = kTurn * s / first;
  double wave_length = first;
  if (settings_.exponential) {
    wave_length = first * std::exp(k * s);
    if (k != 0.0) phase = -kTurn * std::expm1(-k * s) / (k * first);
  } else {
    wave_length = first + k * s;
    if (k != 0.0) phase = kTurn * std::log1p(k * s / first) / k;
  }
  const double amplitude = settings_.amplitude_begin + growth_ * s;
  ground.height = amplitude * std::sin(phase);
  const double slope =
      growth_ * std::sin(phase) + amplitude * std::cos(phase) * kTurn / wave_length;
  ground.normal = Eigen::Vector3d(-slope, 0.0, 1.0).normalized();
  return ground;
}

double WaveRoad::mean_height(const Eigen::Vector2d& from,
                             const Eigen::Vector2d& to,
                             double time) const {
  // Longest line for the quadrature rule as a share of the wave length; its relative error there is
  // (π share)^6 / 3.15e4.
  constexpr double kShort = 0.05;
  const auto [low, high] = std::minmax(from.x(), to.x());
  const auto length_at = [&](double x) {
    const double s = x - settings_.start;
    return settings_.exponential ? settings_.wave_length_begin * std::exp(stretch_ * s)
                                 : settings_.wave_length_begin + stretch_ * s;
  };
  if (!(low >= settings_.start && high <= settings_.end &&
        high - low <= kShort * std::min(length_at(low), length_at(high))))
    return Road::mean_height(from, to, time);
  const double middle = 0.5 * (low + high), off = 0.5 * std::sqrt(0.6) * (high - low);
  const auto z = [&](double x) { return at(x, 0.0, time).height; };
  return (5.0 * (z(middle - off) + z(middle + off)) + 8.0 * z(middle)) / 18.0;
}

/// The amplitude is a linear function of x, so its maximum in a box is at one of its ends.
GroundBounds WaveRoad::bounds(const GroundBox& box, double) const {
  const double from = std::max(box.x0, settings_.start), to = std::min(box.x1, settings_.end);
  if (from > to) return {0.0, true};
  const auto amplitude = [&](double x) {
    return std::abs(settings_.amplitude_begin + growth_ * (x - settings_.start));
  };
  return {std::max(amplitude(from), amplitude(to)), false};
}

}  // namespace latsch::road
