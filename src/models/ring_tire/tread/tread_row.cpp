// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/tread/tread_row.h"

#define LATSCH_KERNELS_IN "models/ring_tire/tread/tread_row_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

bool cell_planes(const CellRow& row, const BlockGround& ground) {
  return LATSCH_KERNEL(cell_planes)(row, ground);
}

void TreadRow::place(const double* columns, const BlockLines& lines, int line, int blocks) {
  double* const to[3] = {at(0), at(1), at(2)};
  LATSCH_KERNEL(line_tips)(columns, lines, line, stride_, to);
  for (int i = 0; i < 2; ++i) {
    const double* tip = at(i);
    double* border = at(3 + i);
    for (int j = 1; j < blocks; ++j) border[j] = 0.5 * (tip[j - 1] + tip[j]);
    const int last = blocks - 1, next = blocks > 1 ? 1 : 0;
    border[0] = 1.5 * tip[0] - 0.5 * tip[next];
    border[blocks] = 1.5 * tip[last] - 0.5 * tip[last - next];
  }
}

}  // namespace latsch::ring_tire
