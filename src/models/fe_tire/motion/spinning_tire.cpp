// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/spinning_tire.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/analysis/inflation.h"
#include "models/fe_tire/analysis/modes.h"
#include "models/fe_tire/motion/spin.h"
#include "models/fe_tire/motion/standing_wave.h"

namespace latsch::fe_tire {
namespace {

constexpr double kMostGrowth = 0.1;  // share of the section height; beyond it a tire has long burst
constexpr double kHighest = 1e4;     // rad/s, where the search for a standing wave ends
constexpr double kSameSpeed = 1e-6;  // relative change of the critical speed in the last step
constexpr int kMostSteps = 20;
constexpr double kToKilometersPerHour = 3.6;

double rim_radius(const Mesh& mesh) {
  double radius = mesh.outer_radius();
  for (const int node : mesh.clamped)
    radius = std::min(radius, std::hypot(mesh.X(0, node), mesh.X(2, node)));
  return radius;
}

/// Grows an inflated tire by rotation, without any check of its waves.
Result<Inflated> grown(const RingElements& elements,
                       const Inflated& at_rest,
                       const SectorFlow& flow,
                       double speed,
                       const SolverSettings& settings) {
  const LinearLoad load{flow.W.harmonic(0), flow.w_0};
  auto spinning = load_sector(elements, at_rest, load, speed * speed, settings);
  if (!spinning)
    return Failure{
        fmt::format("the tire has no equilibrium at {:.5g} rad/s: of its centrifugal "
                    "load {}",
                    speed,
                    spinning.failure().reason)};
  spinning->spin = speed;
  return spinning;
}

/// Returns the tangent of a sector about the state, without inertia.
Result<SectorBlocks> sector_tangent(const RingElements& elements, const Inflated& state) {
  const Ring& ring = elements.ring();
  SectorBlocks K(ring);
  Eigen::VectorXd f, alpha = state.alpha;
  int worst = 0;
  if (!assemble_sector(elements, ring.compress(state.u), state.pressure, alpha, f, &K, &worst))
    return no_tangent(ring, worst);
  return K;
}

Failure not_of_equal_sectors() {
  return Failure{
      "a mesh without equal sectors has no state in which it spins steadily: expected a tire of "
      "equal sectors"};
}

}  // namespace

SpinningTire::SpinningTire(FeTire& tire) : tire_(tire) {}

Result<Inflated> SpinningTire::inflate(const Inflated& at_rest, double speed) {
  const RingElements& elements = tire_.impl_->even_elements();
  const Ring& ring = elements.ring();
  if (ring.sectors() == 1) return not_of_equal_sectors();
  const SectorFlow flow(elements);
  auto spinning = grown(elements, at_rest, flow, speed, tire_.impl_->settings);
  if (spinning) {
    const auto K = sector_tangent(elements, *spinning);
    if (!K) return K.failure();
    if (!holds_every_wave(*K, flow, ring, std::abs(speed))) {
      const auto wave = standing_wave(at_rest);
      return wave ? above(*wave, speed) : wave.failure();
    }
  } else {
    const auto wave = standing_wave(at_rest);
    if (wave && wave->speed < std::abs(speed)) return above(*wave, speed);
    return spinning;
  }
  const double height = at_rest.radius - rim_radius(ring.mesh());
  if (spinning->radius - at_rest.radius > kMostGrowth * height && height > 0.0)
    return Failure{fmt::format(
        "at {:.5g} rad/s the tire's radius grows by {:.3g} mm, more than a tenth of its section "
        "height of {:.4g} mm: expected a lower speed",
        speed,
        1e3 * (spinning->radius - at_rest.radius),
        1e3 * height)};
  return spinning;
}

Result<StandingWave> SpinningTire::standing_wave(const Inflated& at_rest) {
  const RingElements& elements = tire_.impl_->even_elements();
  const Ring& ring = elements.ring();
  if (ring.sectors() == 1) return not_of_equal_sectors();
  const SectorFlow flow(elements);
  // The critical speed of the tire that has grown at `speed`, and the tire's radius.
  double radius = at_rest.radius;
  const auto critical = [&](double speed) -> Result<CriticalWave> {
    auto state = speed == 0.0 ? Result<Inflated>(at_rest)
                              : grown(elements, at_rest, flow, speed, tire_.impl_->settings);
    if (!state) return state.failure();
    radius = state->radius;
    const auto K = sector_tangent(elements, *state);
    if (!K) return K.failure();
    const auto wave = critical_wave(*K, flow, ring, kHighest);
    if (!wave)
      return Failure{fmt::format(
          "there is no standing wave below {:.4g} rad/s, or the tire buckles at rest", kHighest)};
    return *wave;
  };
  // Secant method for g(speed) = speed, where g is the critical speed of the tire at `speed`.
  auto last = critical(0.0);
  if (!last) return last.failure();
  double last_speed = 0.0, speed = last->speed;
  for (int step = 0; step < kMostSteps; ++step) {
    const auto now = critical(speed);
    if (!now) return now.failure();
    if (std::abs(now->speed - speed) <= kSameSpeed * speed)
      return StandingWave{
          now->speed, radius, now->n, static_cast<int>(ring.sectors() / (2.0 * std::numbers::pi))};
    const double slope = (now->speed - last->speed) / (speed - last_speed);
    const double next = std::abs(slope) < 0.9 ? speed + (now->speed - speed) / (1.0 - slope)
                                              : 0.5 * (now->speed + speed);
    last_speed = speed;
    last = now;
    speed = next;
  }
  return Failure{
      fmt::format("the standing-wave speed was not found in {} steps; it is near {:.5g} "
                  "rad/s",
                  kMostSteps,
                  speed)};
}

Failure SpinningTire::above(const StandingWave& wave, double speed) {
  return Failure{fmt::format(
      "the tire spins at {:.5g} rad/s ({:.4g} km/h at its radius), not below its standing-wave "
      "speed of {:.5g} rad/s ({:.4g} km/h), at which nothing holds a wave of n = {}{}: expected a "
      "lower speed",
      speed,
      kToKilometersPerHour * speed * wave.radius,
      wave.speed,
      kToKilometersPerHour * wave.speed * wave.radius,
      wave.n,
      wave.n <= wave.resolved ? std::string()
                              : fmt::format(" (the sectors resolve waves up to n = {}; finer "
                                            "sectors would give a lower speed, rubber that is "
                                            "stiffer at the frequency of the wave a higher one)",
                                            wave.resolved))};
}

}  // namespace latsch::fe_tire
