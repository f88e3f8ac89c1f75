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
  ring.belt.extension = 1.0e10;  // the closed form's belt does not stretch
  for (SidewallElement* e :
       {&ring.sidewall.radial, &ring.sidewall.tangential, &ring.sidewall.lateral})
    e->dynamic_stiffening = e->friction_stiffening = 0.0;
  return ring;
}

// Closed form of the inextensible ring under pressure on an elastic foundation.
TEST(RingModes, ConvergeToTheClosedFormWithOrderFour) {
  const RingParameters ring = bare_ring();
  EXPECT_LT(error_of(ring, 200, 0), 1e-6);
  for (int n : {1, 2}) EXPECT_LT(error_of(ring, 200, n), 1e-6) << n;
  for (int n : {4, 7}) {  // at n <= 2 what is left is the belt's extension
    const double order = std::log2(error_of(ring, 40, n) / error_of(ring, 80, n));
    EXPECT_NEAR(order, 4.0, 0.1) << n;
  }
}

// Rigid ring on its sidewall: sqrt(k_y/ρA) sideways, and tilt, where lateral travel and torsion go
// together: ω² = (k_y r² + c_ψ + T0)/(m r² + J), T0 for the tension that a tilted ring keeps in the
// plane of the pressure.
TEST(RingModes, LateralTranslationAndTiltHaveTheirClosedForms) {
  RingParameters ring = bare_ring();
  ring.nodes = 200;
  ring.belt.bending_out_of_plane = 1e7;  // rigid: the section turns with the ring
  const auto modes = unloaded_modes(ring, 1);
  EXPECT_NEAR(find_mode(modes, 0, true).frequency / lateral_frequency(ring), 1.0, 1e-5);
  EXPECT_NEAR(find_mode(modes, 1, true).frequency / tilt_frequency(ring), 1.0, 2e-4);
}

// One degree of freedom with a Maxwell element: at ωτ >> 1 its spring adds to the other, at any
// frequency the loss is k_M ωτ/(1 + (ωτ)²).
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

}  // namespace
}  // namespace latsch::ring_tire
