// SPDX-License-Identifier: Apache-2.0
// Stiffness of the belt's elements in the rim's axes (belt_stiffness.cpp), eight nodes at a time.
#include "numerics/kernels/kernel_loops.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// Sums a row for eight segments with weights of the nodes k-1 .. k+2; skips a fourth weight of 0.
LATSCH_INLINE Lanes weighted(const double* row, int k, const double (&w)[4]) {
  Lanes sum = w[0] * lanes(row + k - 1) + w[1] * lanes(row + k) + w[2] * lanes(row + k + 1);
  if (w[3] != 0.0) sum += w[3] * lanes(row + k + 2);
  return sum;
}

/// s of (3), which depends on these. In the rim's axes n = a × (t_x, 0, t_z) = (t_z, 0, -t_x).
struct Bend {
  Lanes tx, tz, shorter, s, along;
};

LATSCH_INLINE Bend bend_of(const BendRule& rule, const double* const rows[4], int k) {
  const Lanes cx = weighted(rows[0], k, rule.slope), cz = weighted(rows[2], k, rule.slope);
  const Lanes dx = weighted(rows[0], k, rule.second), dz = weighted(rows[2], k, rule.second);
  const Lanes shorter = 1.0 / sqrt(cx * cx + cz * cz);
  const Lanes tx = cx * shorter, tz = cz * shorter;
  return {tx, tz, shorter, dx * tz - dz * tx, (dx * tx + dz * tz) * shorter};
}

/// Computes A, B and C of (27), ten rows, from the stiffness κ and the moment m.
LATSCH_INLINE void bending(
    const Bend& bend, const Lanes& stiffness, const Lanes& m, int k, double* const* to) {
  const auto& [tx, tz, shorter, s, along] = bend;
  const Lanes moment = m * shorter;
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
  put(ElementStiffness::kAlong, along);
  put(ElementStiffness::kNx, tz);
  put(ElementStiffness::kNz, -tx);
}

/// First and second derivative by s that (4), and (5) where it is evaluated, add to (3).
struct BySlope {
  Lanes moment, stiffness;
};

/// Evaluates (4), EI (u'' - ζ ψ s)²/2, for one rule; the stress may have another EI.
LATSCH_INLINE BySlope tilting(const BendRule& rule,
                              double stress_EI,
                              double EI,
                              double zeta,
                              double cone,
                              const Lanes& s,
                              const double* const rows[4],
                              int k,
                              double* const* to) {
  const Lanes tilt = zeta * weighted(rows[3], k, rule.place);
  const Lanes lateral = stress_EI * ((weighted(rows[1], k, rule.second) - tilt * s) + cone);
  const auto put = [&](int row, const Lanes& value) { store(value, to[row] + k); };
  put(ElementStiffness::kTilt, -(EI * zeta * s));
  put(ElementStiffness::kTiltTilt, EI * zeta * zeta * s * s);
  put(ElementStiffness::kBendS, -(EI * tilt));
  put(ElementStiffness::kTorsionS, zeta * (EI * tilt * s - lateral));
  return {-(lateral * tilt), EI * tilt * tilt};
}

/// Evaluates the segments -2 .. nodes and the knots -1 .. nodes, with nodes at x, y, z and their
/// torsions. `law` gives the stresses and `stretch` the stiffnesses of the strains.
void stiffen(int nodes,
             const BeltLaw& law,
             const BeltLaw& stretch,
             double scale,
             const double* const rows[4],
             const ElementStiffness& e) {
  const double cube = law.L0 * law.L0 * law.L0, stress_EI = scale * law.EI / cube,
               stress_EI_out = scale * law.EI_out_of_plane / cube;
  const double EI = scale * stretch.EI / cube, EI_out = scale * stretch.EI_out_of_plane / cube;
  const double stress_GJ = scale * law.GJ / law.L0, GJ = scale * stretch.GJ / law.L0;
  const double by_s = law.tilt_twist / (law.L0 * law.L0);
  const double of = scale * law.L0 / law.stretch0, stress_spring = of * law.EA / law.stretch0,
               spring = of * stretch.EA / law.stretch0;
  by_eight(-2, nodes + 1, [&](int k) {
    const Lanes d[3] = {weighted(rows[0], k, kBetween.slope),
                        weighted(rows[1], k, kBetween.slope),
                        weighted(rows[2], k, kBetween.slope)};
    const Lanes square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], length = sqrt(square);
    const Lanes string = (of * law.T0 + stress_spring * (length - law.stretch0)) / length;  // (1)
    const Lanes more = (spring - string) / square;
    int row = ElementStiffness::kString;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        const Lanes stretched = more * d[i] * d[j];
        store(i == j ? stretched + string : stretched, e.row[row++] + k);
      }
    double* const* const to = e.row + ElementStiffness::kBetween;
    constexpr double kShare = 1.0 - kKnotShare;
    const Bend bend = bend_of(kBetween, rows, k);
    const BySlope tilt = tilting(kBetween,
                                 kShare * stress_EI_out,
                                 kShare * EI_out,
                                 law.tilt_between,
                                 law.cone_between,
                                 bend.s,
                                 rows,
                                 k,
                                 to);
    const Lanes turned = by_s * d[1], follows = by_s * bend.s;  // (5): ψ' + u' by_s s
    const Lanes twist = stress_GJ * (weighted(rows[3], k, kBetween.slope) + d[1] * follows);
    store(GJ * follows, e.row[ElementStiffness::kTwist] + k);
    store(GJ * follows * follows, e.row[ElementStiffness::kTwist + 1] + k);
    store(by_s * twist + GJ * turned * follows, to[ElementStiffness::kSlopeS] + k);
    store(GJ * turned, to[ElementStiffness::kTwistS] + k);
    bending(bend,
            kShare * EI + tilt.stiffness + GJ * turned * turned,
            kShare * stress_EI * (bend.s - law.s0_between) + tilt.moment + twist * turned,
            k,
            to);
  });
  by_eight(-1, nodes + 1, [&](int k) {
    double* const* const to = e.row + ElementStiffness::kKnot;
    const Bend bend = bend_of(kAtKnot, rows, k);
    const BySlope tilt = tilting(kAtKnot,
                                 kKnotShare * stress_EI_out,
                                 kKnotShare * EI_out,
                                 1.0,
                                 law.cone,
                                 bend.s,
                                 rows,
                                 k,
                                 to);
    bending(bend,
            kKnotShare * EI + tilt.stiffness,
            kKnotShare * stress_EI * (bend.s - law.s0) + tilt.moment,
            k,
            to);
  });
}

/// Blocks (k, k + j) of eight nodes; rows and columns: x, lateral, z, torsion.
struct BlockSums {
  Lanes of[4][4];
};

/// Adds (27) and the coupling by (4) and (5), of all elements of a rule that contain both nodes.
/// `twists` is true if the rule evaluates (5).
template <int kNodes, int j, bool twists>
LATSCH_INLINE void add_bending(const BendRule& rule, double* const* rows, int k, BlockSums& sums) {
  enum { x, y, z, psi };
  auto& to = sums.of;
#pragma GCC unroll 4
  for (int i = 0; i < kNodes - j; ++i) {
    const int at = k - i + 1, n = i + j;  // the element whose node i is k and node n is k + j
    const auto value = [&](int row) { return lanes(rows[row] + at); };
    const double bb = rule.second[i] * rule.second[n], gg = rule.slope[i] * rule.slope[n];
    const double bg = rule.second[i] * rule.slope[n], gb = rule.slope[i] * rule.second[n];
    to[x][x] += bb * value(ElementStiffness::kA) + gg * value(ElementStiffness::kB) +
                (bg + gb) * value(ElementStiffness::kC);
    const Lanes both = bb * value(ElementStiffness::kA + 1) + gg * value(ElementStiffness::kB + 1);
    const Lanes xz = value(ElementStiffness::kC + 1), zx = value(ElementStiffness::kC + 2);
    to[x][z] += both + bg * xz + gb * zx;
    to[z][x] += both + bg * zx + gb * xz;
    to[z][z] += bb * value(ElementStiffness::kA + 2) + gg * value(ElementStiffness::kB + 2) +
                (bg + gb) * value(ElementStiffness::kC + 3);

    const Lanes tilt = value(ElementStiffness::kTilt);
    to[y][psi] += rule.second[i] * rule.place[n] * tilt;
    to[psi][y] += rule.place[i] * rule.second[n] * tilt;
    to[psi][psi] += rule.place[i] * rule.place[n] * value(ElementStiffness::kTiltTilt);

    const auto across = [&](int node) {
      const Lanes bent = rule.second[node] * value(ElementStiffness::kBendS);
      return twists ? bent + rule.slope[node] * value(ElementStiffness::kSlopeS) : bent;
    };
    const auto torsion = [&](int node) {
      const Lanes placed = rule.place[node] * value(ElementStiffness::kTorsionS);
      return twists ? placed + rule.slope[node] * value(ElementStiffness::kTwistS) : placed;
    };
    const auto bent = [&](int node) {
      return rule.second[node] - rule.slope[node] * value(ElementStiffness::kAlong);
    };
    const Lanes ahead = bent(n), here = bent(i);
    const Lanes nx = value(ElementStiffness::kNx), nz = value(ElementStiffness::kNz);
    const Lanes y_s = across(i) * ahead, s_y = across(n) * here;
    const Lanes psi_s = torsion(i) * ahead, s_psi = torsion(n) * here;
    to[y][x] += y_s * nx;
    to[y][z] += y_s * nz;
    to[x][y] += s_y * nx;
    to[z][y] += s_y * nz;
    to[psi][x] += psi_s * nx;
    to[psi][z] += psi_s * nz;
    to[x][psi] += s_psi * nx;
    to[z][psi] += s_psi * nz;
  }
}

template <int j>
LATSCH_INLINE void gather_blocks(int nodes,
                                 double area,
                                 const ElementStiffness& e,
                                 double* const to[16]) {
  by_eight(0, nodes, [&](int k) {
    Lanes string[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, twist = 0.0, turning = 0.0;
#pragma GCC unroll 4
    for (int i = 0; i < 4 - j; ++i) {
      const double w = kBetween.slope[i] * kBetween.slope[i + j];
      const auto value = [&](int row) { return w * lanes(e.row[row] + k - i + 1); };
      for (int entry = 0; entry < 6; ++entry)
        string[entry] += value(ElementStiffness::kString + entry);
      twist += value(ElementStiffness::kTwist);
      turning += value(ElementStiffness::kTwist + 1);
    }
    BlockSums sums{{{string[0], string[1], string[2] - area, 0.0},
                    {string[1], string[3] + turning, string[4], twist},
                    {string[2] + area, string[4], string[5], 0.0},  // (2)
                    {0.0, twist, 0.0, 0.0}}};
    add_bending<4, j, true>(kBetween, e.row + ElementStiffness::kBetween, k, sums);
    add_bending<3, j, false>(kAtKnot, e.row + ElementStiffness::kKnot, k, sums);
    for (int entry = 0; entry < 16; ++entry) store(sums.of[entry / 4][entry % 4], to[entry] + k);
  });
}

/// Computes the stiffness of the elements and the pressure for the nodes and overwrites `rows`:
/// sixteen rows for each j.
void gather_stiffness(int nodes, double pressure, const ElementStiffness& e, double* const* rows) {
  gather_blocks<0>(nodes, 0.0, e, rows);
  gather_blocks<1>(nodes, kArea1 * pressure, e, rows + 16);
  gather_blocks<2>(nodes, kArea2 * pressure, e, rows + 32);
  gather_blocks<3>(nodes, 0.0, e, rows + 48);
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
