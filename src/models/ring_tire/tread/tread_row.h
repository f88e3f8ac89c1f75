// SPDX-License-Identifier: Apache-2.0
// A line of a segment's blocks over an uneven road: the positions of its cells, and the planes
// below them. The road is evaluated for all cells at once (road::Road::below), planes are computed
// eight at a time.
#pragma once

#include <vector>

#include "models/ring_tire/tread/block_forces.h"

namespace latsch::ring_tire {

/// Cells [begin, end) of a line, and their borders from begin to end.
struct CellRow {
  int begin, end;
  const double *x, *y;  // coordinates of the blocks' tips, m; read eight at a time
  const double *border_x, *border_y, *border_height;
};

/// Computes below each cell a plane of its mean height, with the slope along the cell from end to
/// end and the slope across at the middle. On input `ground` of the row has slopes by x and y in N
/// and mean heights in the level; on output the plane. Blocks beyond the row are not changed.
/// Returns false if a height is not finite.
bool cell_planes(const CellRow& row, const BlockGround& ground);

/// Work memory for one line.
class TreadRow {
 public:
  /// For lines of the given number of stations, a multiple of eight.
  explicit TreadRow(int stride) : stride_(stride), memory_(static_cast<std::size_t>(7 * room())) {}

  /// Computes the positions of the tips of a line.
  void place_tips(const double* columns, const BlockLines& lines, int line);
  /// Computes the borders of the cells [begin, end) of `blocks` cells.
  void place_borders(int begin, int end, int blocks);
  const double* x() const { return at(0); }
  const double* y() const { return at(1); }
  const double* z() const { return at(2); }
  /// Borders between the cells j - 1 and j.
  const double* border_x() const { return at(3); }
  const double* border_y() const { return at(4); }
  double* border_height() { return at(5); }
  double* height() { return at(6); }

 private:
  int room() const { return stride_ + 8; }
  double* at(int column) { return memory_.data() + column * room(); }
  const double* at(int column) const { return memory_.data() + column * room(); }

  int stride_;
  std::vector<double> memory_;
};

}  // namespace latsch::ring_tire
