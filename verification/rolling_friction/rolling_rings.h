// SPDX-License-Identifier: Apache-2.0
// Rings that roll with friction and have a closed form: a thick ring of rubber (Carter's line
// contact) and a layer of independent columns on a rigid rim (the brush model). Both are solved by
// RollingTire, as tires are; used by the tests of this folder and the benchmark `rolling`.
#pragma once

#include <array>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::verification {

/// Returns the angles of section planes, rad, the same on both sides of the contact: sectors of the
/// arc `fine` (m, at the radius) up to the arc `reach` from the contact, then each one wider than
/// the one before by `growth`, up to `widest`.
std::vector<double> planes_finer_at_contact(
    double radius, double fine, double reach, double growth, double widest);

/// A ring that rolls: its tire, and the free wheel at a deflection.
class RollingRing {
 public:
  /// `deflection`: m, below first touch; `mu`: coefficient of friction; `curvature`: 1/m, of the
  /// drum, 0: flat ground. Throws std::runtime_error with the reason if the free wheel is not
  /// found.
  RollingRing(fe_tire::Mesh mesh,
              fe_tire::Materials materials,
              double deflection,
              double mu,
              double curvature = 0.0);

  const fe_tire::RollingState& free_wheel() const { return free_; }
  /// Returns the state at a slip against the free wheel and a slip angle (rad), starting from
  /// the free wheel.
  fe_tire::RollingState slipping(double kappa, double alpha);
  /// Returns the state in a turn without slip at a turn slip (1/m), likewise.
  fe_tire::RollingState turning(double turn_slip);

 private:
  fe_tire::FeTire tire_;
  fe_tire::RollingTire rolling_;
  fe_tire::RollingState free_;
};

/// Hertz' pressure p^2 = p_0^2 (1 - x^2/a^2) fitted to the points of the patch.
struct HertzFit {
  double a = 0.0, p_0 = 0.0;  // m, Pa
};
HertzFit fit_hertz(const fe_tire::RollingState& state);
/// The parabola p = p_0 (1 - x^2/a^2) fitted likewise.
HertzFit fit_parabola(const fe_tire::RollingState& state);

/// A thick ring of nearly incompressible rubber: rim at 0.2 m, outer radius 0.3 m, so wide that its
/// strain is plane. `across`: elements across the patch; `drum`: m, radius of the drum, 0: flat
/// ground.
class CarterRing {
 public:
  static constexpr double kE = 1e6, kNu = 0.48, kR = 0.3, kRim = 0.2, kMu = 0.5;
  static constexpr double kHalf = 6e-3;  // m, about the half width of the patch
  static constexpr double kDeflection =
      2e-4;  // m, on flat ground; as much as gives kHalf on a drum
  /// m. A ring that is steered on a drum touches along a slanted line, which raises the lateral
  /// force of one of 1 m by 2.7 % at the largest slip.
  static double width(double drum) { return drum > 0.0 ? 0.3 : 1.0; }
  static double curvature(double drum) { return drum > 0.0 ? 1.0 / drum : 0.0; }
  static double e_star() { return kE / (1.0 - kNu * kNu); }

  /// A slip state of Carter's incompressible cylinder and the force of the ring's rubber at it.
  struct Slip {
    double share;    // Q/(mu P) by Carter, of which the slip follows
    double lateral;  // Q/(mu P) across
    double along;    // Q/(mu P) of a driven ring
  };
  /// Rubber of kNu contracts along the ground under pressure, which adds to the force of a driven
  /// ring at the same slip from the free wheel. The factors of `along` are those of
  /// line_contact.py, an independent program; they do not depend on the radius of a drum, because
  /// slip and pressure grow alike.
  static constexpr std::array<Slip, 3> kSlips{
      {{0.25, 0.25, 1.0046 * 0.25}, {0.5, 0.5, 1.0080 * 0.5}, {0.75, 0.75, 1.0102 * 0.75}}};
  explicit CarterRing(int across, double drum = 0.0);

  RollingRing& ring() { return ring_; }
  /// Radius of the cylinder that touches a plane as the ring touches its ground, m.
  static double radius(double drum) { return 1.0 / (1.0 / kR + curvature(drum)); }

 private:
  RollingRing ring_;
};

/// A layer of columns on a rigid rim which resist compression and lateral shear, and hardly
/// anything else: the brush model. `across`: elements across the patch.
class BrushRing {
 public:
  static constexpr double kR = 0.3, kHeight = 0.01, kWidth = 1.0, kMu = 1.0;
  static constexpr double kShear = 1e7, kRadial = 1e6;  // Pa
  static constexpr double kDeflection = 2e-4;           // m
  static double half_length();
  /// Pa/m, shear of the columns, which become narrower toward the core, and the ground's penalty in
  /// series.
  static double stiffness();
  explicit BrushRing(int across);

  RollingRing& ring() { return ring_; }

 private:
  RollingRing ring_;
};

}  // namespace latsch::verification
