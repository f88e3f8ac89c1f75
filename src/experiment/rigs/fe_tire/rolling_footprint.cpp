// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/rolling_footprint.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

namespace latsch::experiment {
namespace {

/// Width of the pressure's fading at a rectangle's edges, (P.1) of tire_footprint.h.
const double kBlur = std::sqrt(0.5);

/// Returns the numbers of lines by their mean y, from right to left.
std::map<int, int> order_of_lines(const std::vector<fe_tire::RollingPatchPoint>& patch) {
  std::map<int, std::pair<double, int>> sums;
  for (const auto& point : patch) {
    sums[point.line].first += point.y;
    ++sums[point.line].second;
  }
  std::vector<std::pair<double, int>> lines;
  for (const auto& [line, sum] : sums) lines.emplace_back(sum.first / sum.second, line);
  std::ranges::sort(lines);
  std::map<int, int> numbers;
  for (const auto& [y, line] : lines) numbers.emplace(line, static_cast<int>(numbers.size()));
  return numbers;
}

/// Returns the mean of a quantity of the points over the square of a sensor.
double on_sensor(const RollingFootprint& print,
                 const Eigen::Vector2d& at,
                 double side,
                 const std::function<double(const RollingPoint&, const FootprintElement&)>& value) {
  Footprint of = print.footprint;
  for (std::size_t k = 0; k < of.elements.size(); ++k)
    of.elements[k].pressure = value(print.points[k], print.footprint.elements[k]);
  return of.pressure_at(at.x(), at.y(), side);
}

double divided(double a, double b) { return b > 0.0 ? a / b : 0.0; }

/// Largest dimensions of the rectangles, and their area.
void measure_size(Footprint& print) {
  Eigen::Vector2d least = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d most = -least;
  for (const FootprintElement& at : print.elements) {
    const Eigen::Vector2d half(0.5 * at.length, 0.5 * at.width), center(at.x, at.y);
    least = least.cwiseMin(center - half);
    most = most.cwiseMax(center + half);
    print.area += at.area();
  }
  if (print.elements.empty()) return;
  print.length = most.x() - least.x();
  print.width = most.y() - least.y();
}

/// Adds what the sensors read in one state.
void add_sensors(const GroundSensors& sensors,
                 const RollingFootprint& print,
                 std::vector<Channel>& sensed) {
  for (const Eigen::Vector2d& at : sensors.at) {
    const auto mean = [&](const auto& value) { return on_sensor(print, at, sensors.side, value); };
    using Point = const RollingPoint&;
    using Element = const FootprintElement&;
    const double p = mean([](Point k, Element) { return k.pressure; });
    const double t_x = mean([](Point k, Element) { return k.shear_x; });
    const double t_y = mean([](Point k, Element) { return k.shear_y; });
    const double limit = mean([](Point k, Element e) { return e.friction * k.pressure; });
    const double w_x = mean([](Point k, Element) { return k.pressure * k.slide_x; });
    const double w_y = mean([](Point k, Element) { return k.pressure * k.slide_y; });
    const double values[] = {p,
                             t_x,
                             t_y,
                             divided(w_x, p),
                             divided(w_y, p),
                             std::min(1.0, divided(std::hypot(t_x, t_y), limit)),
                             at.x(),
                             at.y()};
    for (std::size_t k = 0; k < sensed.size(); ++k) sensed[k].values.push_back(values[k]);
  }
}

/// Returns a mean of the points, weighted by their forces.
template <class Value>
double weighted(const RollingFootprint& print, const Value& value) {
  double sum = 0.0, load = 0.0;
  for (std::size_t k = 0; k < print.points.size(); ++k) {
    const double force = print.points[k].pressure * print.footprint.elements[k].area();
    sum += force * value(print.points[k]);
    load += force;
  }
  return divided(sum, load);
}

double sliding_speed(const RollingPoint& at) { return std::hypot(at.slide_x, at.slide_y); }

}  // namespace

RollingFootprint footprint_of(const fe_tire::RollingState& state) {
  RollingFootprint print;
  const std::map<int, int> numbers = order_of_lines(state.patch);
  std::vector<fe_tire::RollingPatchPoint> patch = state.patch;
  std::ranges::stable_sort(patch, [&](const auto& a, const auto& b) {
    return std::pair(numbers.at(a.line), -a.x) < std::pair(numbers.at(b.line), -b.x);
  });
  print.footprint.load = state.forces.force.z();
  for (const fe_tire::RollingPatchPoint& at : patch) {
    const double shear = std::hypot(at.shear_x, at.shear_y);
    print.points.push_back({numbers.at(at.line),
                            at.x,
                            at.y,
                            at.pressure,
                            at.shear_x,
                            at.shear_y,
                            at.slide_x,
                            at.slide_y,
                            std::min(1.0, divided(shear, at.limit)),
                            std::abs(at.shear_x * at.slide_x + at.shear_y * at.slide_y)});
    print.footprint.elements.push_back({.x = at.x,
                                        .y = at.y,
                                        .length = at.length,
                                        .width = at.area / at.length,
                                        .pressure = at.pressure,
                                        .shear_x = at.shear_x,
                                        .shear_y = at.shear_y,
                                        .friction = at.limit / at.pressure,
                                        .blur = kBlur});
  }
  measure_size(print.footprint);
  return print;
}

Channels footprint_channels(const GroundSensors& sensors, const std::vector<RolledState>& states) {
  std::vector<RollingFootprint> prints;
  for (const RolledState& rolled : states) prints.push_back(footprint_of(rolled.state));
  Channels channels;
  const auto add = [&](const char* name, const char* unit, const auto& value) {
    std::vector<double> values;
    for (std::size_t k = 0; k < states.size(); ++k) values.push_back(value(states[k], prints[k]));
    channels.add({name, unit, std::move(values)});
  };
  using State = const RolledState&;
  using Print = const RollingFootprint&;
  add("alpha", "rad", [](State s, Print) { return s.state.of.slip_angle; });
  add("kappa", "1", [](State s, Print) { return s.kappa; });
  add("gamma", "rad", [](State s, Print) { return s.state.of.camber; });
  add("Vx", "m/s", [](State s, Print) {
    return s.state.of.speed * std::cos(s.state.of.slip_angle);
  });
  add("load", "N", [](State, Print print) { return print.footprint.load; });
  add("length", "m", [](State, Print print) { return print.footprint.length; });
  add("width", "m", [](State, Print print) { return print.footprint.width; });
  add("area", "m^2", [](State, Print print) { return print.footprint.area; });
  add("mean_pressure", "Pa", [](State, Print print) { return print.footprint.mean_pressure(); });
  add("peak_pressure", "Pa", [&](State, Print print) {
    return print.footprint.peak_pressure(sensors.side);
  });
  add("grip_level", "1", [](State, Print print) { return print.footprint.grip_level(); });
  add("sticking", "1", [](State, Print print) {
    return weighted(print, [](const RollingPoint& at) { return sliding_speed(at) == 0.0; });
  });
  add("sliding_speed", "m/s", [](State, Print print) { return weighted(print, sliding_speed); });
  add("loss_friction", "W", [](State s, Print) { return s.state.forces.friction_power; });
  if (sensors.at.empty()) return channels;
  std::vector<Channel> sensed{{"pressure", "Pa", {}},
                              {"shear_x", "Pa", {}},
                              {"shear_y", "Pa", {}},
                              {"slide_x", "m/s", {}},
                              {"slide_y", "m/s", {}},
                              {"grip", "1", {}},
                              {"sensor_x", "m", {}},
                              {"sensor_y", "m", {}}};
  for (const RollingFootprint& print : prints) add_sensors(sensors, print, sensed);
  for (Channel& channel : sensed) channels.add(std::move(channel));
  return channels;
}

}  // namespace latsch::experiment
