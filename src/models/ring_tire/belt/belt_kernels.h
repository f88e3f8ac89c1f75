// SPDX-License-Identifier: Apache-2.0
// The belt's elements and their forces (belt.h), eight nodes at a time.
#include "numerics/kernels/kernel_loops.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// Evaluates (26) for one row and eight segments.
LATSCH_INLINE Lanes slope_at(const double* row, int k) {
  return 0.125 *
         (5.0 * (lanes(row + k + 1) - lanes(row + k)) + (lanes(row + k + 2) - lanes(row + k - 1)));
}

/// Transpose of slope_at: the contribution of values in the middle of the segments to eight nodes.
LATSCH_INLINE Lanes from_slopes(const double* row, int k) {
  return 0.125 *
         (5.0 * (lanes(row + k) - lanes(row + k - 1)) + (lanes(row + k + 1) - lanes(row + k - 2)));
}

/// Second derivative by s in the middle of eight segments.
LATSCH_INLINE Lanes bend_between(const double* row, int k) {
  return 0.5 * ((lanes(row + k - 1) + lanes(row + k + 2)) - (lanes(row + k) + lanes(row + k + 1)));
}

/// Torsion in the middle of eight segments, times ζ of (4).
LATSCH_INLINE Lanes torsion_between(double zeta, const double* psi, int k) {
  return (zeta / 48.0) *
         ((lanes(psi + k - 1) + lanes(psi + k + 2)) + 23.0 * (lanes(psi + k) + lanes(psi + k + 1)));
}

/// Torsion, and twice the first and the second derivative by s, at eight knots.
LATSCH_INLINE Lanes torsion_at(const double* psi, int k) {
  return (lanes(psi + k - 1) + 4.0 * lanes(psi + k) + lanes(psi + k + 1)) * (1.0 / 6.0);
}
LATSCH_INLINE Lanes gain_at(const double* row, int k) {
  return lanes(row + k + 1) - lanes(row + k - 1);
}
LATSCH_INLINE Lanes bend_at(const double* row, int k) {
  return (lanes(row + k + 1) + lanes(row + k - 1)) - 2.0 * lanes(row + k);
}

/// Evaluates the elements of the segments -2 .. nodes and of the knots -1 .. nodes, with nodes at
/// x, y, z and their torsions (rows of rim_rows.h). In the rim's axes a × (t_x, 0, t_z) = (t_z, 0,
/// -t_x). If `damped`, the rates of the nodes' positions add the damping.
template <bool damped>
LATSCH_INLINE void strain_of(int nodes,
                             const BeltLaw& law,
                             const double* const rows[4],
                             const double* const rates[4],
                             const Elements& e) {
  const double *x = rows[0], *y = rows[1], *z = rows[2], *psi = rows[3];
  const double tau = law.damping_time, tau_spring = law.extension_damping_time;
  const double at_knot = kKnotShare * law.EI / (law.L0 * law.L0 * law.L0);
  const double between = (1.0 - kKnotShare) * law.EI / (law.L0 * law.L0 * law.L0);
  const double spring = law.EA / law.stretch0, of = law.L0 / law.stretch0;
  const double over = 1.0 / (law.L0 * law.L0), by_L = 1.0 / law.L0;
  const double out_of_plane = kKnotShare * law.EI_out_of_plane * over,
               out_of_plane_between = (1.0 - kKnotShare) * law.EI_out_of_plane * over;
  by_eight(-2, nodes + 1, [&](int k) {
    const Lanes dx = slope_at(x, k), dy = slope_at(y, k), dz = slope_at(z, k);
    const Lanes length = sqrt(dx * dx + dy * dy + dz * dz);
    Lanes stretch = length - law.stretch0;
    Lanes vx, vy, vz;
    if constexpr (damped) {
      vx = slope_at(rates[0], k);
      vy = slope_at(rates[1], k);
      vz = slope_at(rates[2], k);
      stretch = stretch + tau_spring * (vx * dx + vy * dy + vz * dz) / length;  // (30)
    }
    const Lanes tension = of * (law.T0 + spring * stretch) / length;  // (1)
    store(tension * dx, e.row[Elements::kString] + k);
    store(tension * dy, e.row[Elements::kString + 1] + k);
    store(tension * dz, e.row[Elements::kString + 2] + k);
    const Lanes sx = bend_between(x, k), sz = bend_between(z, k);
    const Lanes shorter = 1.0 / sqrt(dx * dx + dz * dz);
    const Lanes tx = dx * shorter, tz = dz * shorter;
    const Lanes s = sx * tz - sz * tx;
    const Lanes along = (sx * tx + sz * tz) * shorter;
    const Lanes turned = law.tilt_twist * over * s;
    Lanes bent = s - law.s0_between, twisted = slope_at(psi, k) + dy * turned;
    Lanes s_rate;
    if constexpr (damped) {
      s_rate = (bend_between(rates[0], k) - along * vx) * tz -
               (bend_between(rates[2], k) - along * vz) * tx;
      bent = bent + tau * s_rate;
      twisted = twisted +
                tau * (slope_at(rates[3], k) + vy * turned + (law.tilt_twist * over) * dy * s_rate);
    }
    const Lanes twist = law.GJ * twisted;  // (5), times L0
    store(twist, e.row[Elements::kTwist] + k);
    store(twist * turned, e.row[Elements::kTwistAcross] + k);
    const Lanes torsion = torsion_between(law.tilt_between, psi, k);
    Lanes curved = (bend_between(y, k) - torsion * s) + law.cone_between;
    if constexpr (damped)
      curved =
          curved + tau * (bend_between(rates[1], k) -
                          torsion_between(law.tilt_between, rates[3], k) * s - torsion * s_rate);
    const Lanes lateral = out_of_plane_between * curved;  // (4)
    store(lateral, e.row[Elements::kLateralBetween] + k);
    store(law.tilt_between * by_L * lateral * s, e.row[Elements::kTorsionBetween] + k);
    const Lanes moment =
        between * bent + by_L * ((law.tilt_twist * over) * twist * dy - torsion * lateral);  // (3)
    store(moment * tz, e.row[Elements::kBetweenX] + k);
    store(-(moment * tx), e.row[Elements::kBetweenZ] + k);
    store(along, e.row[Elements::kBetweenTurning] + k);
  });
  by_eight(-1, nodes + 1, [&](int k) {
    const Lanes x0 = lanes(x + k - 1), x1 = lanes(x + k), x2 = lanes(x + k + 1);
    const Lanes y0 = lanes(y + k - 1), y1 = lanes(y + k), y2 = lanes(y + k + 1);
    const Lanes z0 = lanes(z + k - 1), z1 = lanes(z + k), z2 = lanes(z + k + 1);
    const Lanes cx = x2 - x0, cz = z2 - z0;
    const Lanes sx = (x2 + x0) - 2.0 * x1, sz = (z2 + z0) - 2.0 * z1;
    const Lanes shorter = 1.0 / sqrt(cx * cx + cz * cz);
    const Lanes tx = cx * shorter, tz = cz * shorter;
    const Lanes s = sx * tz - sz * tx;
    const Lanes along = (sx * tx + sz * tz) * shorter;
    const Lanes torsion = torsion_at(psi, k);
    Lanes curved = (((y2 + y0) - 2.0 * y1) - torsion * s) + law.cone, bent = s - law.s0;
    if constexpr (damped) {
      const Lanes s_rate = (bend_at(rates[0], k) - along * gain_at(rates[0], k)) * tz -
                           (bend_at(rates[2], k) - along * gain_at(rates[2], k)) * tx;
      bent = bent + tau * s_rate;
      curved =
          curved + tau * (bend_at(rates[1], k) - torsion_at(rates[3], k) * s - torsion * s_rate);
    }
    const Lanes lateral = out_of_plane * curved;  // (4)
    store(lateral, e.row[Elements::kLateral] + k);
    store(by_L * lateral * s, e.row[Elements::kTorsion] + k);
    const Lanes moment = at_knot * bent - by_L * torsion * lateral;  // (3)
    store(moment * tz, e.row[Elements::kBendX] + k);
    store(-(moment * tx), e.row[Elements::kBendZ] + k);
    store(along, e.row[Elements::kTurning] + k);
  });
}

void strain(int nodes, const BeltLaw& law, const double* const rows[4], const Elements& e) {
  strain_of<false>(nodes, law, rows, nullptr, e);
}

void strain_damped(int nodes,
                   const BeltLaw& law,
                   const double* const rows[4],
                   const double* const rates[4],
                   const Elements& e) {
  strain_of<true>(nodes, law, rows, rates, e);
}

/// Sums the forces of the elements on the nodes, and the pressure (2).
void gather(int nodes,
            const BeltLaw& law,
            const double* const rows[4],
            const Elements& e,
            double* const forces[4]) {
  const double *x = rows[0], *z = rows[2];
  const double area1 = law.pressure_width * kArea1, area2 = law.pressure_width * kArea2;
  const double by_L = 1.0 / law.L0;
  by_eight(0, nodes, [&](int k) {
    const auto at = [&](int row, int node) { return lanes(e.row[row] + node); };
    // Factors of the nodes behind and ahead of k.
    const Lanes behind = 1.0 - at(Elements::kTurning, k - 1),
                ahead = 1.0 + at(Elements::kTurning, k + 1);
    const auto turning = [&](int segment) {
      return 0.125 * at(Elements::kBetweenTurning, segment);
    };
    const Lanes first = 0.5 + turning(k + 1), second = 0.5 - 5.0 * turning(k),
                third = 0.5 + 5.0 * turning(k - 1), fourth = 0.5 - turning(k - 2);
    const auto bending = [&](int row, int between) {
      return (2.0 * at(row, k) - behind * at(row, k - 1) - ahead * at(row, k + 1)) +
             ((second * at(between, k) - first * at(between, k + 1)) +
              (third * at(between, k - 1) - fourth * at(between, k - 2)));
    };
    const auto across = [&](const double* row) {
      return area1 * (lanes(row + k + 1) - lanes(row + k - 1)) +
             area2 * (lanes(row + k + 2) - lanes(row + k - 2));
    };
    store(from_slopes(e.row[Elements::kString], k) + across(z) +
              bending(Elements::kBendX, Elements::kBetweenX),
          forces[0] + k);
    store(from_slopes(e.row[Elements::kString + 2], k) - across(x) +
              bending(Elements::kBendZ, Elements::kBetweenZ),
          forces[2] + k);
    const Lanes before = at(Elements::kLateral, k - 1), here = at(Elements::kLateral, k),
                after = at(Elements::kLateral, k + 1);
    const Lanes inner = at(Elements::kLateralBetween, k) + at(Elements::kLateralBetween, k - 1),
                outer = at(Elements::kLateralBetween, k + 1) + at(Elements::kLateralBetween, k - 2);
    store(from_slopes(e.row[Elements::kString + 1], k) +
              ((2.0 * here - before - after) + 0.5 * (inner - outer)) * by_L +
              by_L * from_slopes(e.row[Elements::kTwistAcross], k),
          forces[1] + k);
    const Lanes of_knots = at(Elements::kTorsion, k - 1) + 4.0 * at(Elements::kTorsion, k) +
                           at(Elements::kTorsion, k + 1);
    const Lanes between =
        23.0 * (at(Elements::kTorsionBetween, k) + at(Elements::kTorsionBetween, k - 1)) +
        (at(Elements::kTorsionBetween, k + 1) + at(Elements::kTorsionBetween, k - 2));
    store(by_L * from_slopes(e.row[Elements::kTwist], k) + (1.0 / 6.0) * of_knots +
              (1.0 / 48.0) * between,
          forces[3] + k);
  });
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
