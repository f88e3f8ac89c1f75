// SPDX-License-Identifier: Apache-2.0
#include "models/tire/free_wheel.h"

#include <algorithm>
#include <cmath>

namespace latsch {
namespace {

Push push_on(const FreeRate& free, double time, double rate) {
  return free.push ? free.push(time, rate) : Push{};
}

double place_after(const FreeRate& free, double step, double rate) {
  return free.place + 0.5 * step * (free.rate + rate);
}

/// Returns T + F - m a1.
double unbraked(const FreeRate& free, double time, double step, double rate, double T) {
  const double a = free.inertia > 0.0 ? 2.0 * (rate - free.rate) / step - free.acceleration : 0.0;
  return T + push_on(free, time, rate).value - free.inertia * a;
}

/// Returns the moment of a dry-friction brake that can bear up to `brake`, N m, on a wheel that
/// turns at `rate` under other moments with the sum `sum`.
double friction(double brake, double rate, double sum) {
  return rate != 0.0 ? -std::copysign(brake, rate) : -std::clamp(sum, -brake, brake);
}

}  // namespace

FreeWheel::Pair FreeWheel::forces(const HubForces& hub, const WheelMotion& motion) {
  return {hub.moment.y(), motion.carrier.row(2) * hub.force};
}

FreeWheel::Pair FreeWheel::guess(double step) const {
  const auto of = [step](const std::optional<FreeRate>& free) {
    return free ? free->rate + step * free->acceleration : 0.0;
  };
  return {of(spin), of(height)};
}

WheelMotion FreeWheel::moved(const WheelMotion& motion, double step, const Pair& rates) const {
  WheelMotion to = motion;
  if (spin) {
    to.spin_rate = rates[0];
    to.spin = place_after(*spin, step, rates[0]);
  }
  if (height) {
    to.velocity.z() = rates[1];
    to.center.z() = place_after(*height, step, rates[1]);
  }
  return to;
}

FreeWheel::Pair FreeWheel::left(double time, double step, const Pair& rates, const Pair& T) const {
  Pair left = Pair::Zero();
  if (spin) {
    left[0] = unbraked(*spin, time, step, rates[0], T[0]);
    left[0] += friction(brake, rates[0], left[0]);
  }
  if (height) left[1] = unbraked(*height, time, step, rates[1], T[1]);
  return left;
}

std::optional<FreeWheel::Pair> FreeWheel::balanced(
    double time, double step, const Pair& rates, const Pair& T, const Matrix& stiffness) const {
  // The trapezoidal rule, linearized at the given rates, is D (w1 - rates) = r + B, with B the
  // brake's moment.
  Matrix D = Matrix::Identity();
  Pair r = Pair::Zero();
  const std::optional<FreeRate>* const all[2] = {&spin, &height};
  for (int i = 0; i < 2; ++i) {
    if (!*all[i]) continue;
    const FreeRate& free = **all[i];
    D(i, i) = 2.0 * free.inertia / step - push_on(free, time, rates[i]).by_rate +
              0.5 * step * stiffness(i, i);
    if (*all[1 - i]) D(i, 1 - i) = 0.5 * step * stiffness(i, 1 - i);
    r[i] = unbraked(free, time, step, rates[i], T[i]);
  }
  // The height is eliminated from the two equations. The spin is then solved alone, with its brake.
  const double firm = D(0, 0) - D(0, 1) * D(1, 0) / D(1, 1);
  if (!(D(1, 1) > 0.0 && firm > 0.0)) return std::nullopt;
  Pair to = Pair::Zero();
  if (spin) {
    const double pull = firm * rates[0] + r[0] - D(0, 1) * r[1] / D(1, 1);
    to[0] = (pull + friction(brake, 0.0, pull)) / firm;
  }
  if (height) to[1] = rates[1] + (r[1] - D(1, 0) * (to[0] - rates[0])) / D(1, 1);
  return to;
}

FreeWheel FreeWheel::after(double time, double step, const Pair& rates, const Pair& T) const {
  FreeWheel to = *this;
  const auto go_on = [&](FreeRate& free, double rate, double of_tire, double most_friction) {
    const double sum = of_tire + push_on(free, time, rate).value;
    free.acceleration = free.inertia > 0.0
                            ? (sum + friction(most_friction, rate, sum)) / free.inertia
                            : (rate - free.rate) / step;
    free.place = place_after(free, step, rate);
    free.rate = rate;
  };
  if (spin) go_on(*to.spin, rates[0], T[0], brake);
  if (height) go_on(*to.height, rates[1], T[1], 0.0);
  return to;
}

}  // namespace latsch
