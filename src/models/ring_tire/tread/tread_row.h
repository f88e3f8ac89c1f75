// SPDX-License-Identifier: Apache-2.0
// A line of a segment's blocks over an uneven road: where its cells are, and the planes that these
// see. Cells are asked for all at once (road::Road::below), planes made eight at a time.
#pragma once

#include <vector>

#include "models/ring_tire/tread/block_forces.h"

namespace latsch::ring_tire {

/// Cells [begin, end) of a line, those of their borders from begin to end.
struct CellRow {
  int begin, end;
  const double *x, *y;  // m, of tips; of eight at a time
  const double *border_x, *border_y, *border_height;
};

/// Below each cell a plane of its mean height, its slope along the cell from end to end, across it
/// that of the middle. `ground` of the row has slopes by x and y in N, mean heights in the level,
/// and then the plane; blocks beyond the row stay. False where a height is not finite.
bool cell_planes(const CellRow& row, const BlockGround& ground);

/// The memory for one line at work.
class TreadRow {
 public:
  /// For lines of that many stations, a multiple of eight.
  explicit TreadRow(int stride) : stride_(stride), memory_(static_cast<std::size_t>(7 * room())) {}

  /// Places of the tips of a line.
  void place_tips(const double* columns, const BlockLines& lines, int line);
  /// And of the borders of the cells [begin, end) of so many.
  void place_borders(int begin, int end, int blocks);
  const double* x() const { return at(0); }
  const double* y() const { return at(1); }
  const double* z() const { return at(2); }
  /// Of the border between the cells j - 1 and j.
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
