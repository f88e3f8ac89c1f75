// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/block_forces.h"

#include "models/ring_tire/lanes.h"

namespace latsch::ring_tire {

LATSCH_RING_CLONES void sticking_forces(const BlockColumns& blocks,
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
  double* new_x = blocks.on_road[0] + offset;
  double* new_y = blocks.on_road[1] + offset;
  double* new_z = blocks.on_road[2] + offset;
  const double normal = law.normal, tangential = law.tangential, td = law.damping_time;
  const double step = law.step;
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
    Fn[i] = on * push;
    Fx[i] = stick * (x - td * (Vx + nx * rate));  // (12)
    Fy[i] = stick * (yy - td * (Vy + ny * rate));
    Fz[i] = stick * (z - td * (Vz + nz * rate));
    ex[i] = x;
    ey[i] = yy;
    ez[i] = z;
    gripped[i] = 1.0;
    new_x[i] = Tx + depth * nx;
    new_y[i] = Ty + depth * ny;
    new_z[i] = Tz + depth * nz;
  }
}

LATSCH_RING_CLONES void add_row_sums(const BlockColumns& blocks,
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

LATSCH_RING_CLONES void add_row_stiffness(const BlockColumns& blocks,
                                          double* sums,
                                          int stride,
                                          int begin,
                                          int end,
                                          int offset,
                                          double y,
                                          double normal,
                                          double tangential) {
  const int count = end - begin;
  const double* Fn = blocks.Fn + offset;
  const double* gripped = blocks.gripped + offset;
  constexpr int kRow[6] = {0, 0, 0, 1, 1, 2}, kColumn[6] = {0, 1, 2, 1, 2, 2};
  const double* Fx = blocks.F[0] + offset;
  const double* Fy = blocks.F[1] + offset;
  const double* Fz = blocks.F[2] + offset;
  for (int c = 0; c < 6; ++c) {
    const double* N1 = blocks.N[kRow[c]] + offset;
    const double* N2 = blocks.N[kColumn[c]] + offset;
    const double* F1 = blocks.F[kRow[c]] + offset;
    const double* F2 = blocks.F[kColumn[c]] + offset;
    const double unit = kRow[c] == kColumn[c] ? 1.0 : 0.0;
    double* sum = sums + c * stride + begin;
    double* sum_y = sums + (6 + c) * stride + begin;
    double* sum_yy = sums + (12 + c) * stride + begin;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      const double size2 = Fx[i] * Fx[i] + Fy[i] * Fy[i] + Fz[i] * Fz[i];
      const double along = gripped[i] < 1.0 ? F1[i] * F2[i] / (size2 + 1e-300) : 0.0;
      const double NN = N1[i] * N2[i];
      const double K =
          Fn[i] > 0.0 ? normal * NN + tangential * gripped[i] * (unit - NN - along) : 0.0;
      sum[i] += K;
      sum_y[i] += y * K;
      sum_yy[i] += y * y * K;
    }
  }
}

}  // namespace latsch::ring_tire
