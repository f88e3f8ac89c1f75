// SPDX-License-Identifier: Apache-2.0
// The belt's elements and their forces (belt.h), eight nodes at a time.
#include "numerics/kernels/kernel_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// body(i) for i = begin, begin + 8 .. up to the last eight, which may come twice in part.
template <class Body>
LATSCH_INLINE void by_eight(int begin, int end, const Body& body) {
  for (int i = begin; i < end; i += 8) body(i + 8 <= end ? i : end - 8);
}

/// Elements -1 .. nodes of nodes at x, y, z with torsions (rows of rim_rows.h). In the rim's axes
/// a × (t_x, 0, t_z) = (t_z, 0, -t_x).
void strain(int nodes, const BeltLaw& law, const double* const rows[4], const Elements& e) {
  const double *x = rows[0], *y = rows[1], *z = rows[2], *psi = rows[3];
  const double spring = law.EA / law.L0, bend = law.EI / (law.L0 * law.L0 * law.L0);
  const double over = 1.0 / (law.L0 * law.L0), of_psi = 1.0 / law.R, by_L = 1.0 / law.L0;
  const double of_travel = 1.0 / (law.L0 * law.R);
  by_eight(-1, nodes + 1, [&](int k) {
    const Lanes x0 = lanes(x + k - 1), x1 = lanes(x + k), x2 = lanes(x + k + 1);
    const Lanes y0 = lanes(y + k - 1), y1 = lanes(y + k), y2 = lanes(y + k + 1);
    const Lanes z0 = lanes(z + k - 1), z1 = lanes(z + k), z2 = lanes(z + k + 1);
    const Lanes dx = x2 - x1, dy = y2 - y1, dz = z2 - z1;
    const Lanes chord = sqrt(dx * dx + dy * dy + dz * dz);
    const Lanes tension = (law.T0 + spring * (chord - law.L0)) / chord;  // (1)
    store(tension * dx, e.row[Elements::kString] + k);
    store(tension * dy, e.row[Elements::kString + 1] + k);
    store(tension * dz, e.row[Elements::kString + 2] + k);
    const Lanes cx = x2 - x0, cz = z2 - z0;
    const Lanes sx = (x2 + x0) - 2.0 * x1, sz = (z2 + z0) - 2.0 * z1;
    const Lanes shorter = 1.0 / sqrt(cx * cx + cz * cz);
    const Lanes tx = cx * shorter, tz = cz * shorter;
    const Lanes moment = bend * ((sx * tz - sz * tx) - law.s0);  // (3)
    store(moment * tz, e.row[Elements::kBendX] + k);
    store(-(moment * tx), e.row[Elements::kBendZ] + k);
    store((sx * tx + sz * tz) * shorter, e.row[Elements::kTurning] + k);
    const Lanes psi1 = lanes(psi + k), psi2 = lanes(psi + k + 1);
    store(law.EI_out_of_plane * (((y2 + y0) - 2.0 * y1) * over + psi1 * of_psi),
          e.row[Elements::kLateral] + k);                                                  // (4)
    store(law.GJ * ((psi2 - psi1) * by_L - dy * of_travel), e.row[Elements::kTwist] + k);  // (5)
  });
}

/// What the elements do to the nodes, and the pressure (2).
void gather(int nodes,
            const BeltLaw& law,
            const double* const rows[4],
            const Elements& e,
            double* const forces[4]) {
  const double *x = rows[0], *z = rows[2];
  const double half = 0.5 * law.pressure_width, length = law.L0 / law.R;
  const double by_L = 1.0 / law.L0, by_R = 1.0 / law.R;
  by_eight(0, nodes, [&](int k) {
    const auto at = [&](int row, int node) { return lanes(e.row[row] + node); };
    // At k itself, from the node behind, from the node ahead.
    const Lanes behind = 1.0 - at(Elements::kTurning, k - 1),
                ahead = 1.0 + at(Elements::kTurning, k + 1);
    const auto bending = [&](int row) {
      return 2.0 * at(row, k) - behind * at(row, k - 1) - ahead * at(row, k + 1);
    };
    store((at(Elements::kString, k) - at(Elements::kString, k - 1)) +
              half * (lanes(z + k + 1) - lanes(z + k - 1)) + bending(Elements::kBendX),
          forces[0] + k);
    store((at(Elements::kString + 2, k) - at(Elements::kString + 2, k - 1)) -
              half * (lanes(x + k + 1) - lanes(x + k - 1)) + bending(Elements::kBendZ),
          forces[2] + k);
    const Lanes lateral = at(Elements::kLateral, k);
    const Lanes curving =
        2.0 * lateral - at(Elements::kLateral, k - 1) - at(Elements::kLateral, k + 1);
    const Lanes twisting = at(Elements::kTwist, k) - at(Elements::kTwist, k - 1);
    store((at(Elements::kString + 1, k) - at(Elements::kString + 1, k - 1)) + curving * by_L -
              twisting * by_R,
          forces[1] + k);
    store(twisting - lateral * length, forces[3] + k);
  });
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
