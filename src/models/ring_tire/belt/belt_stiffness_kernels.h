// SPDX-License-Identifier: Apache-2.0
// Stiffness of the belt's elements in the rim's axes (belt_stiffness.cpp), eight nodes at a time.
#include "numerics/kernels/kernel_loops.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// A row of eight segments by weights of the nodes k-1 .. k+2, nothing for a weight of 0.
LATSCH_INLINE Lanes weighted(const double* row, int k, const double (&w)[4]) {
  Lanes sum = w[0] * lanes(row + k - 1) + w[1] * lanes(row + k) + w[2] * lanes(row + k + 1);
  if (w[3] != 0.0) sum += w[3] * lanes(row + k + 2);
  return sum;
}

/// A, B and C of (27), ten rows. In the rim's axes n = a × (t_x, 0, t_z) = (t_z, 0, -t_x). Gives s.
LATSCH_INLINE Lanes bending(const BendRule& rule,
                           double stiffness,
                           double s0,
                           const double* const rows[3],
                           int k,
                           double* const* to) {
  const Lanes cx = weighted(rows[0], k, rule.slope), cz = weighted(rows[2], k, rule.slope);
  const Lanes dx = weighted(rows[0], k, rule.second), dz = weighted(rows[2], k, rule.second);
  const Lanes shorter = 1.0 / sqrt(cx * cx + cz * cz);
  const Lanes tx = cx * shorter, tz = cz * shorter;
  const Lanes s = dx * tz - dz * tx, along = (dx * tx + dz * tz) * shorter;
  const Lanes moment = stiffness * (s - s0) * shorter;  // m/|c|
  const Lanes nn = stiffness * along * along - moment * s * shorter, tn = moment * along;
  const Lanes C = -(stiffness * along);
  const auto put = [&](int row, const Lanes& value) { store(value, to[row] + k); };
  put(ElementStiffness::kA, stiffness * tz * tz);
  put(ElementStiffness::kA + 1, -(stiffness * tz * tx));
  put(ElementStiffness::kA + 2, stiffness * tx * tx);
  put(ElementStiffness::kB, nn * tz * tz + 2.0 * tn * tx * tz);
  put(ElementStiffness::kB + 1, tn * (tz * tz - tx * tx) - nn * tz * tx);
  put(ElementStiffness::kB + 2, nn * tx * tx - 2.0 * tn * tx * tz);
  put(ElementStiffness::kC, C * tz * tz - moment * tx * tz);
  put(ElementStiffness::kC + 1, moment * tx * tx - C * tz * tx);
  put(ElementStiffness::kC + 2, -(moment * tz * tz + C * tx * tz));
  put(ElementStiffness::kC + 3, C * tx * tx + moment * tz * tx);
  return s;
}

/// Of the segments -2 .. nodes and of the knots -1 .. nodes, nodes at x, y, z.
void stiffen(int nodes,
             const BeltLaw& law,
             double scale,
             const double* const rows[3],
             const ElementStiffness& e) {
  const double EI = scale * law.EI / (law.L0 * law.L0 * law.L0);
  const double of = scale * law.L0 / law.stretch0, spring = of * law.EA / law.stretch0;
  const double EI_out = scale * law.EI_out_of_plane / (law.L0 * law.L0 * law.L0);
  const double GJ = scale * law.GJ / law.L0, of_bend = law.tilt_twist / (law.L0 * law.L0);
  by_eight(-2, nodes + 1, [&](int k) {
    const Lanes d[3] = {weighted(rows[0], k, kBetween.slope),
                        weighted(rows[1], k, kBetween.slope),
                        weighted(rows[2], k, kBetween.slope)};
    const Lanes square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], length = sqrt(square);
    const Lanes string = (of * law.T0 + spring * (length - law.stretch0)) / length;  // (1)
    const Lanes more = (spring - string) / square;
    int row = ElementStiffness::kString;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        const Lanes stretched = more * d[i] * d[j];
        store(i == j ? stretched + string : stretched, e.row[row++] + k);
      }
    const Lanes s = bending(kBetween,
                            (1.0 - kKnotShare) * EI,
                            law.s0_between,
                            rows,
                            k,
                            e.row + ElementStiffness::kBetween);
    const Lanes tilted = law.tilt_between * s, turned = of_bend * s;
    store((1.0 - kKnotShare) * EI_out * tilted, e.row[ElementStiffness::kTiltBetween] + k);
    store((1.0 - kKnotShare) * EI_out * tilted * tilted,
          e.row[ElementStiffness::kTiltBetween + 1] + k);
    store(GJ * turned, e.row[ElementStiffness::kTwist] + k);
    store(GJ * turned * turned, e.row[ElementStiffness::kTwist + 1] + k);
  });
  by_eight(-1, nodes + 1, [&](int k) {
    const Lanes s =
        bending(kAtKnot, kKnotShare * EI, law.s0, rows, k, e.row + ElementStiffness::kKnot);
    store(kKnotShare * EI_out * s, e.row[ElementStiffness::kTilt] + k);
    store(kKnotShare * EI_out * s * s, e.row[ElementStiffness::kTilt + 1] + k);
  });
}

/// The in-plane part of the blocks (k, k + j) of eight nodes.
struct PlaneSums {
  Lanes xx, xz, zx, zz;
};

/// (27) of all elements of a rule on both nodes.
template <int kNodes, int j>
LATSCH_INLINE void add_bending(const BendRule& rule, double* const* rows, int k, PlaneSums& sums) {
#pragma GCC unroll 4
  for (int i = 0; i < kNodes - j; ++i) {
    const int at = k - i + 1;  // the element whose node i is k
    const auto value = [&](int row) { return lanes(rows[row] + at); };
    const double bb = rule.second[i] * rule.second[i + j], gg = rule.slope[i] * rule.slope[i + j];
    const double bg = rule.second[i] * rule.slope[i + j], gb = rule.slope[i] * rule.second[i + j];
    sums.xx += bb * value(ElementStiffness::kA) + gg * value(ElementStiffness::kB) +
               (bg + gb) * value(ElementStiffness::kC);
    const Lanes both = bb * value(ElementStiffness::kA + 1) + gg * value(ElementStiffness::kB + 1);
    const Lanes xz = value(ElementStiffness::kC + 1), zx = value(ElementStiffness::kC + 2);
    sums.xz += both + bg * xz + gb * zx;
    sums.zx += both + bg * zx + gb * xz;
    sums.zz += bb * value(ElementStiffness::kA + 2) + gg * value(ElementStiffness::kB + 2) +
               (bg + gb) * value(ElementStiffness::kC + 3);
  }
}

/// What ψ has to do with itself and with travel across the plane.
struct TorsionSums {
  Lanes y_psi, psi_y, psi_psi;
};

/// (4) of all elements of a rule on both nodes; `rows`: EI_o ζ s and EI_o ζ² s².
template <int kNodes, int j>
LATSCH_INLINE void add_tilt(const BendRule& rule, double* const* rows, int k, TorsionSums& sums) {
#pragma GCC unroll 4
  for (int i = 0; i < kNodes - j; ++i) {
    const int at = k - i + 1;
    const Lanes tilt = lanes(rows[0] + at);
    sums.y_psi -= rule.second[i] * rule.place[i + j] * tilt;
    sums.psi_y -= rule.place[i] * rule.second[i + j] * tilt;
    sums.psi_psi += rule.place[i] * rule.place[i + j] * lanes(rows[1] + at);
  }
}

template <int j>
LATSCH_INLINE void gather_blocks(int nodes,
                                 double area,
                                 const ElementStiffness& e,
                                 double* const to[10]) {
  by_eight(0, nodes, [&](int k) {
    Lanes string[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, twist = 0.0, across = 0.0;
#pragma GCC unroll 4
    for (int i = 0; i < 4 - j; ++i) {
      const double w = kBetween.slope[i] * kBetween.slope[i + j];
      for (int entry = 0; entry < 6; ++entry)
        string[entry] += w * lanes(e.row[ElementStiffness::kString + entry] + k - i + 1);
      twist += w * lanes(e.row[ElementStiffness::kTwist] + k - i + 1);
      across += w * lanes(e.row[ElementStiffness::kTwist + 1] + k - i + 1);
    }
    PlaneSums sums{string[0], string[2] - area, string[2] + area, string[5]};  // (2)
    add_bending<4, j>(kBetween, e.row + ElementStiffness::kBetween, k, sums);
    add_bending<3, j>(kAtKnot, e.row + ElementStiffness::kKnot, k, sums);
    TorsionSums torsion{twist, twist, 0.0};  // (5)
    add_tilt<4, j>(kBetween, e.row + ElementStiffness::kTiltBetween, k, torsion);
    add_tilt<3, j>(kAtKnot, e.row + ElementStiffness::kTilt, k, torsion);
    const Lanes values[10] = {sums.xx,
                              string[1],
                              sums.xz,
                              string[3] + across,
                              string[4],
                              sums.zx,
                              sums.zz,
                              torsion.y_psi,
                              torsion.psi_y,
                              torsion.psi_psi};
    for (int entry = 0; entry < 10; ++entry) store(values[entry], to[entry] + k);
  });
}

/// What the elements and the pressure are to the nodes, in place of what stood there: ten rows of each
/// j.
void gather_stiffness(int nodes, double pressure, const ElementStiffness& e, double* const* rows) {
  gather_blocks<0>(nodes, 0.0, e, rows);
  gather_blocks<1>(nodes, kArea1 * pressure, e, rows + 10);
  gather_blocks<2>(nodes, kArea2 * pressure, e, rows + 20);
  gather_blocks<3>(nodes, 0.0, e, rows + 30);
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
