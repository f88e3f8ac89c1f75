// SPDX-License-Identifier: Apache-2.0
#include "exchange/unit/car_input_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/tire/rolls.h"

namespace latsch::exchange {
namespace {

constexpr double kMostTravel = 0.15;   // m, of a rack, as in usual_car_numbers.h
constexpr double kMostRate = 2.0;      // m/s, of a rack
constexpr double kMostSpeed = 97.0;    // m/s, 350 km/h
constexpr double kMostWeights = 20.0;  // multiples of the weight; of torques at a lever of 1 m
constexpr double kDeepest = 0.6;       // share of a tire's radius

struct Limit {
  double most;
  const char* asks;  // the likely cause
};

/// Returns the greatest usual value of a variable; 0 if there is none.
Limit limit_of(const std::string& name, double weight) {
  if (name == "rack.travel") return {kMostTravel, "is it in m?"};
  if (name == "rack.velocity") return {kMostRate, "is it in m/s?"};
  if (name == "speed" || name == "guide.speed") return {kMostSpeed, "is it in m/s?"};
  if (name.starts_with("drive.") || name.starts_with("brake.") || name.starts_with("load.M"))
    return {kMostWeights * weight, "is it in N m?"};
  if (name.starts_with("load.F")) return {kMostWeights * weight, "is it in N?"};
  return {0.0, ""};
}

}  // namespace

void CarInputWatch::add(const ExchangedVariable& variable, double value) {
  Greatest& known = greatest_[variable.name];
  known.unit = variable.unit;
  if (std::abs(value) > std::abs(known.value)) known.value = value;
}

void CarInputWatch::add_brake(const ExchangedVariable& variable, double value) {
  add(variable, value);
  if (value < 0.0 && negative_brake_.empty())
    negative_brake_ = fmt::format(
        "{} was {:.4g} N m: a largest torque of a brake is not negative, and 0 was used; a torque "
        "that drives backward is drive.*",
        variable.name,
        value);
}

void CarInputWatch::add_way(double metres) { way_ = std::max(way_, metres); }

void CarInputWatch::add_deflection(double deflection, double free_radius) {
  if (!(deflection > deflection_)) return;
  deflection_ = deflection;
  free_radius_ = free_radius;
}

std::vector<std::string> CarInputWatch::sentences() const {
  std::vector<std::string> all;
  for (const auto& [name, met] : greatest_) {
    const Limit limit = limit_of(name, weight_);
    if (limit.most > 0.0 && std::abs(met.value) > limit.most)
      all.push_back(fmt::format("{} was {:.4g} {}, beyond the {:.4g} {} of any car like this: {}",
                                name,
                                met.value,
                                met.unit,
                                limit.most,
                                met.unit,
                                limit.asks));
    const bool is_switch = name == "guide.is_given" || name == "road.continues";
    if (is_switch && met.value != 0.0 && met.value != 1.0)
      all.push_back(
          fmt::format("{} was {:g}: expected 0 or 1; it was taken as 1", name, met.value));
  }
  if (!negative_brake_.empty()) all.push_back(negative_brake_);
  if (way_ > kFarthestStep * (1.0 + 1e-9))
    all.push_back(
        fmt::format("a step of the car moved it by {:.3g} mm, more than the {:.3g} mm that a test "
                    "of a tire allows: forces that change within a step are lost; lower "
                    "step.longest",
                    1e3 * way_,
                    1e3 * kFarthestStep));
  if (free_radius_ > 0.0 && deflection_ > kDeepest * free_radius_)
    all.push_back(fmt::format(
        "a tire was pressed by {:.4g} mm, deeper than the section of a tire with a radius of "
        "{:.4g} mm: are the loads in N and the heights of the road in m?",
        1e3 * deflection_,
        1e3 * free_radius_));
  return all;
}

}  // namespace latsch::exchange
