// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/tread/block_forces.h"

#define LATSCH_KERNELS_IN "models/ring_tire/tread/block_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

void station_frames(const double* const nodes[4],
                    const double* weights,
                    const double* a,
                    int stride,
                    double* columns) {
  LATSCH_KERNEL(station_frames)(nodes, weights, a, stride, columns);
}

void station_columns(const SegmentStations& at, double* columns) {
  LATSCH_KERNEL(station_columns)(at, columns);
}

void station_rates(const SegmentStations& at, double* columns) {
  LATSCH_KERNEL(station_rates)(at, columns);
}

void lowest_tips(const double* columns, const BlockLines& lines, int stride, double* z) {
  LATSCH_KERNEL(lowest_tips)(columns, lines, stride, z);
}

void gaps_to_drum(const double* columns,
                  const BlockLines& lines,
                  int stride,
                  const road::Cylinder& drum,
                  double* gap) {
  LATSCH_KERNEL(gaps_to_drum)(columns, lines, stride, drum, gap);
}

void drum_planes(const BlockSpan& at,
                 const double* columns,
                 const double* lift,
                 const BlockLines& lines,
                 int blocks,
                 const road::Cylinder& drum,
                 const BlockGround& ground) {
  LATSCH_KERNEL(drum_planes)(at, columns, lift, lines, blocks, drum, ground);
}

void find_entering(const BlockSpan& at, int lines, const double* touches, std::uint8_t* entering) {
  LATSCH_KERNEL(find_entering)(at, lines, touches, entering);
}

void level_forces(const BlockStep& step, const LevelGround& ground) {
  LATSCH_KERNEL(level_forces)(step, ground);
}

void uneven_forces(const BlockStep& step, const BlockGround& ground) {
  LATSCH_KERNEL(uneven_forces)(step, ground);
}

void drum_forces(const BlockStep& step, const BlockGround& ground) {
  LATSCH_KERNEL(drum_forces)(step, ground);
}

void keep_tips(const BlockSpan& at,
               int lines,
               const BlockResults& results,
               const double* level,
               double* const tip[3],
               double* touches) {
  LATSCH_KERNEL(keep_tips)(at, lines, results, level, tip, touches);
}

void level_stiffness(const BlockSpan& at,
                     const BlockLines& lines,
                     const BlockResults& results,
                     double normal,
                     double tangential,
                     double* sums) {
  LATSCH_KERNEL(level_stiffness)(at, lines, results, normal, tangential, sums);
}

void uneven_stiffness(const BlockSpan& at,
                      const BlockLines& lines,
                      const BlockGround& ground,
                      const BlockResults& results,
                      double normal,
                      double tangential,
                      double* sums) {
  LATSCH_KERNEL(uneven_stiffness)(at, lines, ground, results, normal, tangential, sums);
}

}  // namespace latsch::ring_tire
