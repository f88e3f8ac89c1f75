// SPDX-License-Identifier: Apache-2.0
// Follower pressure on a bilinear face with 2x2 Gauss points: n dA = (x_xi cross x_eta) dxi deta.
// The gas has the potential -p V. For a closed surface, or one whose boundary is fixed, the load
// stiffness is therefore symmetric and equals the sum of the symmetric parts of all faces.
// [Schweizerhof & Ramm 1984, Computers & Structures 18] At an open edge that is not fixed, the
// volume and thus the load would be undefined, so a seal closes it.
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_PRESSURE) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_PRESSURE
#undef LATSCH_FE_TIRE_PRESSURE
#else
#define LATSCH_FE_TIRE_PRESSURE
#endif

#include "models/fe_tire/element/hex8_sums.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

/// Adds the forces of the pressure p on the face with corners at x[3 a + i]. `node` holds the node
/// numbers of the corners in the sums; -1: the corner is fixed.
LATSCH_INLINE void add_face_pressure(
    const V* x, const int* node, double p, bool stiffness, NodalSums& sums) {
  V w[6][3];  // K_ab = [w]x for the pairs b > a
  for (V& v : std::span(&w[0][0], 18)) v = 0.0;
  for (int q = 0; q < 4; ++q) {
    double N[4], N_xi[4], N_eta[4];
    V x_xi[3], x_eta[3];
    for (int i = 0; i < 3; ++i) x_xi[i] = x_eta[i] = 0.0;
    for (int a = 0; a < 4; ++a) {
      const double s = 1.0 + kGauss * kXi[q] * kXi[a];
      const double t = 1.0 + kGauss * kEta[q] * kEta[a];
      N[a] = 0.25 * s * t;
      N_xi[a] = 0.25 * kXi[a] * t;
      N_eta[a] = 0.25 * s * kEta[a];
      for (int i = 0; i < 3; ++i) {
        x_xi[i] += N_xi[a] * x[3 * a + i];
        x_eta[i] += N_eta[a] * x[3 * a + i];
      }
    }
    const V n[3] = {x_xi[1] * x_eta[2] - x_xi[2] * x_eta[1],
                    x_xi[2] * x_eta[0] - x_xi[0] * x_eta[2],
                    x_xi[0] * x_eta[1] - x_xi[1] * x_eta[0]};
    for (int a = 0; a < 4; ++a) {
      for (int i = 0; node[a] >= 0 && i < 3; ++i) sums.f[3 * node[a] + i] -= (p * N[a]) * n[i];
    }
    if (!stiffness) continue;
    for (int a = 0, pair = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b, ++pair) {
        // Derivative of the normal: dn/dx_b = N_b,eta [x_xi]x - N_b,xi [x_eta]x. The matrix [w]x of
        // a cross product is minus its own transpose.
        const double s = -0.5 * p * (N[a] * N_eta[b] - N[b] * N_eta[a]);
        const double t = -0.5 * p * (N[a] * N_xi[b] - N[b] * N_xi[a]);
        for (int i = 0; i < 3; ++i) w[pair][i] += s * x_xi[i] - t * x_eta[i];
      }
    }
  }
  if (!stiffness) return;
  for (int a = 0, pair = 0; a < 4; ++a) {
    for (int b = a + 1; b < 4; ++b, ++pair) {
      if (node[a] < 0 || node[b] < 0) continue;
      const int row = 3 * std::max(node[a], node[b]), column = 3 * std::min(node[a], node[b]);
      // The block below the diagonal is -[w]x, or [w]x if a has the lower row.
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const V entry = node[a] < node[b] ? w[pair][i] : -w[pair][i];
        sums.K[ElementBatch::entry(row + j, column + k)] += entry;
        sums.K[ElementBatch::entry(row + k, column + j)] -= entry;
      }
    }
  }
}

/// Edges of the pressurized face at which further faces close the volume of the gas.
struct GasEdges {
  unsigned open = 0;    // sealed edges; bit k: from node k to node k + 1
  bool is_arc = false;  // true: the edges along eta are walled off to the axis, see add_pressure()
};

/// Adds the forces of pressure on the triangle between the center of the wheel and the edge from
/// `from` to `to`. Nodes are -1 if the corner is fixed.
LATSCH_INLINE void add_wall_pressure(const V* from,
                                     const V* to,
                                     int from_node,
                                     int to_node,
                                     double p,
                                     bool stiffness,
                                     NodalSums& sums) {
  const int node[4] = {from_node, to_node, -1, -1};
  V wall[12];
  for (int i = 0; i < 3; ++i) {
    wall[i] = from[i];
    wall[3 + i] = to[i];
    wall[6 + i] = wall[9 + i] = 0.0;
  }
  add_face_pressure(wall, node, p, stiffness, sums);
}

/// Adds the forces of pressure on the face of nodes 0-3 at x[3 a + i], and on the seals of its open
/// edges. A seal is a strip between the current position of an edge and its position in the element
/// X without load. The prisms of neighboring arcs do not meet, so each of them is closed by walls
/// between its sides and the center of the wheel. Then the gas has a potential in every element.
void add_pressure(
    const double* X, const V* x, const GasEdges& edges, double p, bool stiffness, NodalSums& sums) {
  constexpr int kFace[4] = {0, 1, 2, 3};
  add_face_pressure(x, kFace, p, stiffness, sums);
  if (edges.is_arc) {
    add_wall_pressure(x + 6, x + 3, 2, 1, p, stiffness, sums);
    add_wall_pressure(x, x + 9, 0, 3, p, stiffness, sums);
  }
  for (int k = 0; k < 4; ++k) {
    if (!(edges.open >> k & 1)) continue;
    const int a = k, b = (k + 1) % 4;
    // The edge runs in the direction opposite to that in the face.
    const int node[4] = {b, a, -1, -1};
    V strip[12];
    for (int i = 0; i < 3; ++i) {
      strip[i] = x[3 * b + i];
      strip[3 + i] = x[3 * a + i];
      strip[6 + i] = X[3 * a + i];
      strip[9 + i] = X[3 * b + i];
    }
    add_face_pressure(strip, node, p, stiffness, sums);
    if (edges.is_arc) {
      add_wall_pressure(strip + 6, strip + 3, -1, a, p, stiffness, sums);
      add_wall_pressure(strip, strip + 9, b, -1, p, stiffness, sums);
    }
  }
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
