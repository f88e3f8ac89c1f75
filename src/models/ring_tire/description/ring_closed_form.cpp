// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/description/ring_closed_form.h"

#include <cmath>
#include <numbers>

namespace latsch::ring_tire {
namespace {

double mass_per_length(const Belt& belt) {
  return belt.mass / (2.0 * std::numbers::pi * belt.radius);
}

double hertz(double omega_squared) { return std::sqrt(omega_squared) / (2.0 * std::numbers::pi); }

}  // namespace

double runout_at(const std::vector<Harmonic>& harmonics, double phi) {
  double sum = 0.0;
  for (std::size_t i = 0; i < harmonics.size(); ++i)
    sum += harmonics[i].amplitude * std::cos((i + 1.0) * (phi - harmonics[i].angle));
  return sum;
}

double in_plane_frequency(const RingParameters& ring, int n) {
  const double R = ring.belt.radius, n2 = static_cast<double>(n) * n;
  const double pb = ring.belt.pressure * ring.belt.pressure_width;
  const double stiffness = ring.belt.bending_in_plane / (R * R * R * R) * n2 * (n2 - 1) * (n2 - 1) +
                           pb / R * n2 * (n2 - 1) + ring.sidewall.tangential.stiffness +
                           n2 * ring.sidewall.radial.stiffness;
  return hertz(stiffness / (mass_per_length(ring.belt) * (1.0 + n2)));
}

double lateral_frequency(const RingParameters& ring) {
  return hertz(ring.sidewall.lateral.stiffness / mass_per_length(ring.belt));
}

double tilt_frequency(const RingParameters& ring) {
  const double r = ring.belt.radius;
  const double free_twist = 1.0 - ring.sidewall.torsion_by_lateral * r;
  const double tension = ring.belt.pressure * ring.belt.pressure_width * r;
  const double stiffness = ring.sidewall.lateral.stiffness * r * r +
                           ring.sidewall.torsion * free_twist * free_twist + tension;
  return hertz(stiffness / (mass_per_length(ring.belt) * r * r + ring.belt.torsion_inertia));
}

}  // namespace latsch::ring_tire
