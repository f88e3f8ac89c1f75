// SPDX-License-Identifier: Apache-2.0
// The loops of tread_row.h.
#include "models/ring_tire/tread/block_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

template <class Shape>
LATSCH_INLINE void place_tips(const double* columns,
                              const BlockLines& of,
                              int line,
                              int stride,
                              double* const tips[3],
                              const Shape& shape) {
  for (int j = 0; j < stride; j += kWide) {
    const auto H = shape.height(of, line, j);
    for (int i = 0; i < 3; ++i) {
      const auto at = [&](int c) { return lanes(columns + (3 * c + i) * stride + j); };
      store(at_line(at(0), at(1), at(2), H, of.y[line]), tips[i] + j);
    }
  }
}

void line_tips(
    const double* columns, const BlockLines& lines, int line, int stride, double* const tips[3]) {
  if (lines.rise)
    place_tips(columns, lines, line, stride, tips, BentLines{});
  else
    place_tips(columns, lines, line, stride, tips, StraightLines{});
}

bool cell_planes(const CellRow& row, const BlockGround& ground) {
  const Lanes first = lanes(0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0);
  Lanes finite = all(0.0);
  for (int j = row.begin / kWide * kWide; j < row.end; j += kWide) {
    const Lanes number = first + static_cast<double>(j);
    const auto inside = (all(row.begin) <= number) & (number < all(row.end));
    const auto along = [&](const double* border) {
      return lanes(border + j + 1) - lanes(border + j);
    };
    const Lanes dx = along(row.border_x), dy = along(row.border_y);
    const Lanes way2 = dx * dx + dy * dy;
    const Lanes sx = lanes(ground.N[0] + j), sy = lanes(ground.N[1] + j),
                z = lanes(ground.level + j);
    const Lanes foretold = sx * dx + sy * dy;
    const Lanes more = select(
        way2 > 0.0, (along(row.border_height) - foretold) / larger(way2, all(1e-300)), all(0.0));
    const Lanes slope_x = sx + more * dx, slope_y = sy + more * dy;
    const Lanes Nz = 1.0 / sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
    const Lanes Nx = -slope_x * Nz, Ny = -slope_y * Nz;
    const Lanes level = Nx * lanes(row.x + j) + Ny * lanes(row.y + j) + Nz * z;
    const auto set = [&](const Lanes& value, double* column) {
      store(select(inside, value, lanes(column + j)), column + j);
    };
    set(Nx, ground.N[0]);
    set(Ny, ground.N[1]);
    set(Nz, ground.N[2]);
    set(level, ground.level);
    finite += select(inside, 0.0 * level, all(0.0));
  }
  return sum(finite) == 0.0;
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
