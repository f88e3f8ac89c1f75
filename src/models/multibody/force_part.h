// SPDX-License-Identifier: Apache-2.0
// Laws of one deflection d, used by an axis of a bushing, a spring-damper unit or a bump stop in
// addition to a linear spring and damper. f is resisting: the element pushes back with -f.
//   ForceCurve as `elastic`   f(d)                      a spring's, a snubber's, a bump stop's
//   ForceCurve as `viscous`   f(d')                     a damper's map
//   Play                      k (|d| - gap) beyond the gap, none within
//   Maxwell                   s' = k d' - s/T           rubber that stiffens with frequency
//   Friction                  s' = k d', |s| <= limit   dry friction, its spring before it slips
// Maxwell and friction parts have a memory. One law serves statics and motion: over a step h from
// d0 to d1, at a constant rate,
//   Maxwell    s1 = e s0 + k T (1 - e)/h (d1 - d0),  e = exp(-h/T); statics, h infinite: s1 = 0
//   Friction   s1 = clamp(s0 + k (d1 - d0))
// Both are exact; for friction this requires that the rate does not change its sign within the
// step. A part with play and friction has a hysteresis loop as wide as the gap and as high as the
// friction.
#pragma once

#include <limits>
#include <string>
#include <variant>

#include "models/multibody/force_curve.h"

namespace latsch::multibody {

struct ElasticCurve {
  ForceCharacteristic curve;
  bool operator==(const ElasticCurve&) const = default;
};
struct ViscousCurve {
  ForceCharacteristic curve;
  bool operator==(const ViscousCurve&) const = default;
};
struct Play {
  double gap = 0.0;        // m or rad, gap to either side
  double stiffness = 0.0;  // N/m, N m/rad
  bool operator==(const Play&) const = default;
};
struct Maxwell {
  double stiffness = 0.0;  // N/m, N m/rad
  double time = 0.0;       // T, s
  bool operator==(const Maxwell&) const = default;
};
struct Friction {
  double stiffness = 0.0;  // stiffness of the friction element before it slips
  double limit = 0.0;      // N, N m
  bool operator==(const Friction&) const = default;
};

using ForcePart = std::variant<ElasticCurve, ViscousCurve, Play, Maxwell, Friction>;

/// State of a force part at the end of the last step: its internal variable s and its deflection d;
/// both are zero at rest.
struct PartMemory {
  double s = 0.0, d = 0.0;
  bool operator==(const PartMemory&) const = default;
};

struct PartForce {
  double f = 0.0, by_d = 0.0, by_rate = 0.0;
  double s = 0.0;  // internal variable s at the end of the step
};

// Step, s, that means statics in the functions below: an infinite one.
constexpr double kStatics = std::numeric_limits<double>::infinity();

PartForce respond(
    const ForcePart& part, double d, double rate, const PartMemory& memory, double step);

/// Returns the energy stored in a force part that it can give back, J.
double stored_energy(const ForcePart& part, double d, const PartMemory& memory);

/// Returns a message that says which number of a force part is invalid, or an empty text.
std::string fault_of(const ForcePart& part);

}  // namespace latsch::multibody
