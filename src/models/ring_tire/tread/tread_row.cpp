// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/tread/tread_row.h"

#include <algorithm>

#define LATSCH_KERNELS_IN "models/ring_tire/tread/tread_row_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

bool cell_planes(const CellRow& row, const BlockGround& ground) {
  return LATSCH_KERNEL(cell_planes)(row, ground);
}

void TreadRow::place_tips(const double* columns, const BlockLines& lines, int line) {
  double* const to[3] = {at(0), at(1), at(2)};
  LATSCH_KERNEL(line_tips)(columns, lines, line, stride_, to);
}

void TreadRow::place_borders(int begin, int end, int blocks) {
  const int last = blocks - 1, next = std::min(1, last);
  for (int i = 0; i < 2; ++i) {
    const double* tip = at(i);
    double* border = at(3 + i);
    for (int j = std::max(begin, 1); j <= std::min(end, last); ++j)
      border[j] = 0.5 * (tip[j - 1] + tip[j]);
    if (begin == 0) border[0] = 1.5 * tip[0] - 0.5 * tip[next];
    if (end == blocks) border[blocks] = 1.5 * tip[last] - 0.5 * tip[last - next];
  }
}

}  // namespace latsch::ring_tire
