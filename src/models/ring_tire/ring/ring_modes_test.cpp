// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/ring_modes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/ring_tire/description/ring_closed_form.h"
#include "models/ring_tire/description/ring_parameters_testing.h"

namespace latsch::ring_tire {
namespace {

double error_of(RingParameters ring, int nodes, int n) {
  ring.nodes = nodes;
  const double found = find_mode(unloaded_modes(ring, n), n, false).frequency;
  return std::abs(found / in_plane_frequency(ring, n) - 1.0);
}

RingParameters bare_ring() {
  RingParameters ring = passenger_ring();
  // Nearly infinite, because the belt of the closed form does not stretch.
  ring.belt.extension = 1.0e10;
  for (SidewallElement* e :
       {&ring.sidewall.radial, &ring.sidewall.tangential, &ring.sidewall.lateral})
    e->dynamic_stiffening = e->friction_stiffening = 0.0;
  return ring;
}

// The frequencies must converge to the closed form of the inextensible ring under pressure on an
// elastic foundation.
TEST(RingModes, ConvergeToTheClosedFormWithOrderFour) {
  const RingParameters ring = bare_ring();
  EXPECT_LT(error_of(ring, 200, 0), 1e-6);
  for (int n : {1, 2}) EXPECT_LT(error_of(ring, 200, n), 1e-6) << n;
  for (int n : {4, 7}) {  // at n <= 2 the belt's extension causes a further difference
    const double order = std::log2(error_of(ring, 40, n) / error_of(ring, 80, n));
    EXPECT_NEAR(order, 4.0, 0.1) << n;
  }
}

// A rigid ring on its sidewall has the lateral frequency sqrt(k_y/ρA). It also has a tilt mode, in
// which lateral displacement and torsion are coupled: ω² = (k_y r² + c_ψ + T0)/(m r² + J). The term
// T0 is due to the belt's tension, which stays in the original plane when the ring tilts.
TEST(RingModes, LateralTranslationAndTiltHaveTheirClosedForms) {
  RingParameters ring = bare_ring();
  ring.nodes = 200;
  ring.belt.bending_out_of_plane = 1e7;  // rigid belt: each section rotates with the ring
  const auto modes = unloaded_modes(ring, 1);
  EXPECT_NEAR(find_mode(modes, 0, true).frequency / lateral_frequency(ring), 1.0, 1e-5);
  EXPECT_NEAR(find_mode(modes, 1, true).frequency / tilt_frequency(ring), 1.0, 2e-4);
}

// A single degree of freedom has a spring and a Maxwell element. At ωτ >> 1 the spring of the
// Maxwell element adds to the other one. At any frequency the loss is k_M ωτ/(1 + (ωτ)²).
TEST(RingModes, DynamicStiffeningRaisesFrequencyAndDamping) {
  RingParameters ring = bare_ring();
  const double before = find_mode(unloaded_modes(ring, 0), 0, true).frequency;
  ring.sidewall.lateral.dynamic_stiffening = 0.2;
  ring.sidewall.lateral.damping = 0.0;
  ring.sidewall.time_constant = 1.0;
  const RingMode mode = find_mode(unloaded_modes(ring, 0), 0, true);
  EXPECT_NEAR(mode.frequency / before, std::sqrt(1.2), 1e-5);
  const double omega = 2.0 * std::numbers::pi * mode.frequency;
  EXPECT_NEAR(mode.damping, 0.5 * 0.2 / 1.2 / omega, 1e-4 / omega);
}

// 2 D ω is the viscosity in a mode divided by its mass. The belt contributes τ times the bending
// stiffness in the closed form of the frequency, τ EI n²(n²-1)²/R⁴ /(ρA (1 + n²)), the sidewall
// (d_t + n² d_r)/(ρA (1 + n²)).
TEST(RingModes, BendingOfTheBeltDampsAsItsClosedForm) {
  RingParameters ring = bare_ring();
  ring.nodes = 200;
  ring.belt.bending_in_plane = 20.0;
  ring.belt.damping_time = 2e-4;
  const double R = ring.belt.radius, per_length = ring.belt.mass / (2.0 * std::numbers::pi * R);
  const auto modes = unloaded_modes(ring, 12);
  for (const int n : {2, 5, 12}) {
    const double n2 = n * n;
    const double viscosity = ring.belt.damping_time * ring.belt.bending_in_plane * n2 * (n2 - 1) *
                                 (n2 - 1) / std::pow(R, 4) +
                             ring.sidewall.tangential.damping + n2 * ring.sidewall.radial.damping;
    const RingMode& mode = find_mode(modes, n, false);
    const double omega = 2.0 * std::numbers::pi * mode.frequency;
    EXPECT_NEAR(mode.damping * 2.0 * omega * per_length * (1.0 + n2) / viscosity, 1.0, 1e-4) << n;
  }
}

// If the sections are held upright, the belt bends laterally with the viscosity τ (EI_o + GJ/n²)
// n⁴/R⁴, to which the sidewall adds d_y. In the mode n = 0, in which the ring expands uniformly,
// extension and bending have τ_e EA/R² + τ EI/R⁴, to which the sidewall adds d_r.
TEST(RingModes, OutOfPlaneBendingTwistAndExtensionDampAsTheirClosedForms) {
  RingParameters ring = bare_ring();
  ring.nodes = 200;
  ring.belt.extension = 2e6;
  ring.sidewall.torsion = 1e9;
  ring.belt.damping_time = 2e-4;
  ring.belt.extension_damping_time = 3e-5;
  const double R = ring.belt.radius, per_length = ring.belt.mass / (2.0 * std::numbers::pi * R);
  const auto modes = unloaded_modes(ring, 6);
  const auto doubled = [&](const RingMode& mode) {
    return mode.damping * 4.0 * std::numbers::pi * mode.frequency * per_length;
  };
  for (const int n : {1, 3, 6}) {
    const double n2 = n * n;
    const double viscosity = ring.belt.damping_time *
                                 (ring.belt.bending_out_of_plane * n2 + ring.belt.twist) * n2 /
                                 std::pow(R, 4) +
                             ring.sidewall.lateral.damping;
    EXPECT_NEAR(doubled(find_mode(modes, n, true)) / viscosity, 1.0, 1e-3) << n;
  }
  EXPECT_NEAR(doubled(find_mode(modes, 0, false, 2)) /
                  (ring.belt.extension_damping_time * ring.belt.extension / (R * R) +
                   ring.belt.damping_time * ring.belt.bending_in_plane / std::pow(R, 4) +
                   ring.sidewall.radial.damping),
              1.0,
              1e-5);
}

}  // namespace
}  // namespace latsch::ring_tire
