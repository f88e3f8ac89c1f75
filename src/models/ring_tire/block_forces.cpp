// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/block_forces.h"

#include "numerics/lanes.h"

namespace latsch::ring_tire {

LATSCH_CLONES void station_columns(const double* const nodes[4],
                                   const double* weights,
                                   const StationFrames& frames,
                                   const double* a,
                                   bool rates,
                                   int stride,
                                   int begin,
                                   int end,
                                   double* columns) {
  const double *w0 = weights, *w1 = w0 + stride, *w2 = w1 + stride, *w3 = w2 + stride;
  const double *d0 = w3 + stride, *d1 = d0 + stride, *d2 = d1 + stride, *d3 = d2 + stride;
  const double *x0 = nodes[0], *x1 = nodes[1], *x2 = nodes[2], *x3 = nodes[3];
  const double *tx = frames.t, *ty = tx + stride, *tz = ty + stride;
  const double *nx = frames.n, *ny = nx + stride, *nz = ny + stride;
  double* p[9];
  for (int c = 0; c < 9; ++c) p[c] = columns + c * stride;
  const double own = rates ? 0.0 : 1.0, ax = a[0], ay = a[1], az = a[2];
#pragma GCC ivdep
  for (int j = begin; j < end; ++j) {
    for (int i = 0; i < 3; ++i)
      p[i][j] = w0[j] * x0[i] + w1[j] * x1[i] + w2[j] * x2[i] + w3[j] * x3[i];
    const double psi = w0[j] * x0[3] + w1[j] * x1[3] + w2[j] * x2[3] + w3[j] * x3[3];
    const double sx = d0[j] * x0[0] + d1[j] * x1[0] + d2[j] * x2[0] + d3[j] * x3[0];
    const double sy = d0[j] * x0[1] + d1[j] * x1[1] + d2[j] * x2[1] + d3[j] * x3[1];
    const double sz = d0[j] * x0[2] + d1[j] * x1[2] + d2[j] * x2[2] + d3[j] * x3[2];
    const double over = 1.0 / frames.length[j];
    const double nu_n = (nx[j] * sx + ny[j] * sy + nz[j] * sz) * over;
    const double nu_a = (ax * sx + ay * sy + az * sz) * over;
    p[3][j] = own * nx[j] - nu_n * tx[j] + psi * ax;
    p[4][j] = own * ny[j] - nu_n * ty[j] + psi * ay;
    p[5][j] = own * nz[j] - nu_n * tz[j] + psi * az;
    p[6][j] = own * ax - nu_a * tx[j] - psi * nx[j];
    p[7][j] = own * ay - nu_a * ty[j] - psi * ny[j];
    p[8][j] = own * az - nu_a * tz[j] - psi * nz[j];
  }
}

LATSCH_CLONES void sticking_forces(const BlockColumns& blocks,
                                   const double* stations,
                                   int stride,
                                   int begin,
                                   int end,
                                   int offset,
                                   double H,
                                   double y,
                                   const BlockLaw& law) {
  const double* s[18];
  for (int c = 0; c < 18; ++c) s[c] = stations + c * stride + begin;
  const int count = end - begin;
  const double* Nx = blocks.N[0] + offset;
  const double* Ny = blocks.N[1] + offset;
  const double* Nz = blocks.N[2] + offset;
  const double* level = blocks.level + offset;
  const double* road_x = blocks.road[0] + offset;
  const double* road_y = blocks.road[1] + offset;
  const double* road_z = blocks.road[2] + offset;
  const double* tip_x = blocks.tip[0] + offset;
  const double* tip_y = blocks.tip[1] + offset;
  const double* tip_z = blocks.tip[2] + offset;
  const double* touches = blocks.touches + offset;
  double* Fx = blocks.F[0] + offset;
  double* Fy = blocks.F[1] + offset;
  double* Fz = blocks.F[2] + offset;
  double* Fn = blocks.Fn + offset;
  double* ex = blocks.e[0] + offset;
  double* ey = blocks.e[1] + offset;
  double* ez = blocks.e[2] + offset;
  double* gripped = blocks.gripped + offset;
  double* over = blocks.over + offset;
  double* new_x = blocks.on_road[0] + offset;
  double* new_y = blocks.on_road[1] + offset;
  double* new_z = blocks.on_road[2] + offset;
  const double normal = law.normal, tangential = law.tangential, td = law.damping_time;
  const double step = law.step, lowest = law.lowest, highest = law.highest;
  const double c0 = law.c0, c1 = law.c1, c2 = law.c2;
  const double* mu = blocks.mu + offset;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double Tx = s[0][i] + H * s[3][i] + y * s[6][i];
    const double Ty = s[1][i] + H * s[4][i] + y * s[7][i];
    const double Tz = s[2][i] + H * s[5][i] + y * s[8][i];
    const double Vx = s[9][i] + H * s[12][i] + y * s[15][i] - road_x[i];
    const double Vy = s[10][i] + H * s[13][i] + y * s[16][i] - road_y[i];
    const double Vz = s[11][i] + H * s[14][i] + y * s[17][i] - road_z[i];
    const double nx = Nx[i], ny = Ny[i], nz = Nz[i];
    const double depth = level[i] - (nx * Tx + ny * Ty + nz * Tz);
    const double rate = -(nx * Vx + ny * Vy + nz * Vz);
    const double on = depth > 0.0 ? 1.0 : 0.0;
    // The damper carries no more than the spring: no jump at the touch and no pull.
    const double fast = td * rate < depth ? td * rate : depth;
    const double push = normal * (depth + (fast > -depth ? fast : -depth));  // (11)
    // Time since the touch, at most the step.
    const double since = depth > 0.0 && rate * step > depth ? depth / rate : step;
    const bool touched = touches[i] > 0.5;
    double x = touched ? tip_x[i] - Tx : -Vx * since;
    double yy = touched ? tip_y[i] - Ty : -Vy * since;
    double z = touched ? tip_z[i] - Tz : -Vz * since;
    const double across = nx * x + ny * yy + nz * z;
    x -= nx * across;
    yy -= ny * across;
    z -= nz * across;
    const double stick = on * tangential;
    const double F = on * push;
    Fn[i] = F;
    const double sx = stick * (x - td * (Vx + nx * rate));  // (12)
    const double sy = stick * (yy - td * (Vy + ny * rate));
    const double sz = stick * (z - td * (Vz + nz * rate));
    Fx[i] = sx;
    Fy[i] = sy;
    Fz[i] = sz;
    const double above = F > lowest ? F : lowest;
    const double inside = above < highest ? above : highest;
    const double limit = mu[i] * (c0 + inside * (c1 + inside * c2)) * F;
    over[i] = sx * sx + sy * sy + sz * sz - limit * limit;  // (13)
    ex[i] = x;
    ey[i] = yy;
    ez[i] = z;
    gripped[i] = 1.0;
    new_x[i] = Tx + depth * nx;
    new_y[i] = Ty + depth * ny;
    new_z[i] = Tz + depth * nz;
  }
}

LATSCH_CLONES void add_row_sums(const BlockColumns& blocks,
                                double* sums,
                                int stride,
                                int begin,
                                int end,
                                int offset,
                                double H,
                                double y) {
  const int count = end - begin;
  const double* Fn = blocks.Fn + offset;
  for (int c = 0; c < 3; ++c) {
    const double* N = blocks.N[c] + offset;
    const double* F = blocks.F[c] + offset;
    double* sum = sums + c * stride + begin;
    double* sum_H = sums + (3 + c) * stride + begin;
    double* sum_y = sums + (6 + c) * stride + begin;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      const double force = Fn[i] * N[i] + F[i];
      sum[i] += force;
      sum_H[i] += H * force;
      sum_y[i] += y * force;
    }
  }
}

LATSCH_CLONES void add_row_stiffness(const BlockColumns& blocks,
                                     double* sums,
                                     int stride,
                                     int begin,
                                     int end,
                                     int offset,
                                     double y,
                                     double normal,
                                     double tangential) {
  constexpr int kRow[6] = {0, 0, 0, 1, 1, 2}, kColumn[6] = {0, 1, 2, 1, 2, 2};
  const double* Fn = blocks.Fn + offset;
  const double* gripped = blocks.gripped + offset;
  const double* Fx = blocks.F[0] + offset;
  const double* Fy = blocks.F[1] + offset;
  const double* Fz = blocks.F[2] + offset;
  constexpr int kChunk = 64;
  double along[kChunk], plane[kChunk], normal_more[kChunk];
  for (int first = 0; first < end - begin; first += kChunk) {
    const int count = end - begin - first < kChunk ? end - begin - first : kChunk;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      const int at = first + i;
      const double size2 = Fx[at] * Fx[at] + Fy[at] * Fy[at] + Fz[at] * Fz[at] + 1e-300;
      const double on = Fn[at] > 0.0 ? 1.0 : 0.0;
      plane[i] = on * tangential * gripped[at];
      along[i] = gripped[at] < 1.0 ? plane[i] / size2 : 0.0;
      normal_more[i] = on * normal - plane[i];
    }
    for (int c = 0; c < 6; ++c) {
      const double* N1 = blocks.N[kRow[c]] + offset + first;
      const double* N2 = blocks.N[kColumn[c]] + offset + first;
      const double* F1 = blocks.F[kRow[c]] + offset + first;
      const double* F2 = blocks.F[kColumn[c]] + offset + first;
      const double unit = kRow[c] == kColumn[c] ? 1.0 : 0.0;
      double* sum = sums + c * stride + begin + first;
      double* sum_y = sums + (6 + c) * stride + begin + first;
      double* sum_yy = sums + (12 + c) * stride + begin + first;
#pragma GCC ivdep
      for (int i = 0; i < count; ++i) {
        const double K =
            normal_more[i] * N1[i] * N2[i] + unit * plane[i] - along[i] * F1[i] * F2[i];
        sum[i] += K;
        sum_y[i] += y * K;
        sum_yy[i] += y * y * K;
      }
    }
  }
}

}  // namespace latsch::ring_tire
