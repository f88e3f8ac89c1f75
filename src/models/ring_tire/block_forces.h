// SPDX-License-Identifier: Apache-2.0
// The inner loops over tread blocks: arrays of one quantity each, so that the compiler works on
// several blocks at once.
#pragma once

namespace latsch::ring_tire {

struct BlockColumns {
  // in
  double* N[3];     // normal of the road
  double* level;    // N . G of its plane
  double* road[3];  // its velocity
  double* mu;       // its factor on friction
  double* tip[3];   // where the road carried the tip
  double* touches;  // 1 where the block touched at the beginning of the step, else 0
  // out
  double* F[3];        // tangential force on the tire
  double* Fn;          // normal force
  double* e[3];        // tip minus T in the plane
  double* gripped;     // tangential force over that of a sticking tip
  double* over;        // > 0 where that is more than adhesion holds
  double* on_road[3];  // T moved to the road along N
};

struct BlockLaw {
  double normal, tangential, damping_time, step;
  // μ of adhesion by F_n: c0 + c1 F_n + c2 F_n^2 between the two forces, constant beyond.
  double c0, c1, c2, lowest, highest;
};

/// The belt at the stations of a segment: columns of t, n and |x'|, each `count` long.
struct StationFrames {
  const double *t, *n, *length;
};

/// (10) for all stations [begin, end) of a segment: columns p, G = n - ν_n t + ψ a and A = a - ν_a
/// t
/// - ψ n, nine of them, `stride` long, so that T = p + H G + y A; of `rates` without n and a
/// themselves. `nodes`: the four nodes' values; `weights`: w and its derivative d, four columns
/// each.
void station_columns(const double* const nodes[4],
                     const double* weights,
                     const StationFrames& frames,
                     const double* a,
                     bool rates,
                     int stride,
                     int begin,
                     int end,
                     double* columns);

/// (11) and (12) for blocks [begin, end) of a row; `stations` holds the 18 columns of (10), each
/// `stride` long, `offset` is the row's place in the block columns.
void sticking_forces(const BlockColumns& blocks,
                     const double* stations,
                     int stride,
                     int begin,
                     int end,
                     int offset,
                     double H,
                     double y,
                     const BlockLaw& law);

/// Adds F, H F and y F of a row to the nine columns `sums` of its stations; F = Fn N + tangential.
void add_row_sums(const BlockColumns& blocks,
                  double* sums,
                  int stride,
                  int begin,
                  int end,
                  int offset,
                  double H,
                  double y);

/// Stiffness of a row, K = k_n N N^T + k_t (1 - N N^T - d d^T where it slides along d): adds the
/// six entries xx, xy, xz, yy, yz, zz of K, y K and y^2 K to the 18 columns `sums`. `normal`,
/// `tangential`: dF/dT.
void add_row_stiffness(const BlockColumns& blocks,
                       double* sums,
                       int stride,
                       int begin,
                       int end,
                       int offset,
                       double y,
                       double normal,
                       double tangential);

}  // namespace latsch::ring_tire
