// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/force_part.h"

#include <algorithm>
#include <cmath>

namespace latsch::multibody {
namespace {

struct Response {
  double d, rate;
  const PartMemory& memory;
  double step;

  PartForce operator()(const ElasticCurve& part) const {
    return {.f = part.curve.at(d), .by_d = part.curve.slope(d)};
  }
  PartForce operator()(const ViscousCurve& part) const {
    if (step == kStatics) return {};
    return {.f = part.curve.at(rate), .by_rate = part.curve.slope(rate)};
  }
  PartForce operator()(const Play& part) const {
    const double beyond = std::abs(d) - part.gap;
    if (beyond <= 0.0) return {};
    return {.f = std::copysign(part.stiffness * beyond, d), .by_d = part.stiffness};
  }
  PartForce operator()(const Maxwell& part) const {
    if (step == kStatics) return {};
    const double left = std::exp(-step / part.time);
    const double k = step > 0.0 ? part.stiffness * part.time / step * (1.0 - left) : part.stiffness;
    const double s = left * memory.s + k * (d - memory.d);
    return {.f = s, .by_d = k, .s = s};
  }
  PartForce operator()(const Friction& part) const {
    const double sticking = memory.s + part.stiffness * (d - memory.d);
    const double s = std::clamp(sticking, -part.limit, part.limit);
    // The true slope is 0 during slip. If nothing else holds the joint, as within play, Newton's
    // method needs a slope that is not zero, so this share of the stiffness is used as slope. The
    // force is exact.
    constexpr double kSlipping = 1e-2;
    return {.f = s, .by_d = (s == sticking ? 1.0 : kSlipping) * part.stiffness, .s = s};
  }
};

struct Stored {
  double d;
  const PartMemory& memory;

  double operator()(const ElasticCurve& part) const { return part.curve.area(d); }
  double operator()(const ViscousCurve&) const { return 0.0; }
  double operator()(const Play& part) const {
    const double beyond = std::max(std::abs(d) - part.gap, 0.0);
    return 0.5 * part.stiffness * beyond * beyond;
  }
  double operator()(const Maxwell& part) const {
    return 0.5 * memory.s * memory.s / part.stiffness;
  }
  double operator()(const Friction& part) const {
    return 0.5 * memory.s * memory.s / part.stiffness;
  }
};

bool positive(double x) { return std::isfinite(x) && x > 0.0; }

}  // namespace

PartForce respond(
    const ForcePart& part, double d, double rate, const PartMemory& memory, double step) {
  return std::visit(Response{d, rate, memory, step}, part);
}

double stored_energy(const ForcePart& part, double d, const PartMemory& memory) {
  return std::visit(Stored{d, memory}, part);
}

std::string fault_of(const ForcePart& part) {
  if (const auto* play = std::get_if<Play>(&part))
    if (!positive(play->stiffness) || !(play->gap >= 0.0) || !std::isfinite(play->gap))
      return "play needs a gap that is not negative and a stiffness above zero";
  if (const auto* maxwell = std::get_if<Maxwell>(&part))
    if (!positive(maxwell->stiffness) || !positive(maxwell->time))
      return "a Maxwell part needs a stiffness and a time above zero";
  if (const auto* friction = std::get_if<Friction>(&part))
    if (!positive(friction->stiffness) || !positive(friction->limit))
      return "friction needs a stiffness before it slips and a limit above zero";
  return {};
}

}  // namespace latsch::multibody
