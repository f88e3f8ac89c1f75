// SPDX-License-Identifier: Apache-2.0
// The inner loops over tread blocks, eight stations of a segment at once, line after line: one
// pass from the belt's four nodes to the blocks' forces and back to the nodes.
//
// Arrays of blocks hold one line after the other, each `stride` long, a multiple of eight; blocks
// beyond the segment's own are kept off the road by `lift`.
#pragma once

#include <cstdint>

#include "models/ring_tire/tread/tread_friction.h"
#include "models/road/road.h"

namespace latsch::ring_tire {

/// Stations [begin, end) of a segment, multiples of eight like the length of its lines.
struct BlockSpan {
  int stride, begin, end;
};

/// Stations of one segment and the belt there.
struct SegmentStations {
  int stride, begin, end;        // [begin, end): stations at work, multiples of eight
  const double* nodes[4];        // positions and torsions of the four nodes
  const double* rates[4];        // and their rates
  const double* weights;         // of position w and of its derivative d: four columns each
  const double* halves;          // half of what w gains along a block's cell: four columns
  const double* lift;            // m, 0 at a block's own station, else far above any road
  const double *t, *n, *length;  // columns of (10): three, three, one
  const double* a;
};

struct BlockLines {
  int count;
  const double *height, *y;       // of each line
  const double* rise = nullptr;   // m, of a bent section: two a line, at either end of the segment
  const double* share = nullptr;  // of the second, at each station
};

/// What the blocks of a segment know at the beginning of a step.
struct BlockMemory {
  const double *tip[3], *touches;  // tip on the road; share of the block's cell that is there
  const std::uint8_t* entering;    // of each eight stations: not all touch
};

/// What (11) to (14) make of them. On level ground z of F and tip is not written: 0, the height.
struct BlockResults {
  double* F[3];     // tangential force on the tire
  double* Fn;       // normal force
  double* gripped;  // tangential force over that of a sticking tip
  double* share;    // of the block's cell, on the road
  double* slope;    // dF_n/dδ over that of a cell barely pressed; null: linear rubber, the share
  double* tip[3];   // on the road, where the block touches
};

/// One plane z = height under all of a segment.
struct LevelGround {
  double height, velocity[3], friction;
};

/// A plane of its own under each block.
struct BlockGround {
  double* N[3];         // normal
  double* level;        // N . G
  double* velocity[3];  // of its material
  double* friction;     // factor on the tread's own
  double* held;         // force along the road that friction holds, in statics
};

struct BlockLaw {
  double normal, tangential, damping_time, step;
  double by_force;  // pressure on the rubber over F_n
  double bottom;    // m, b of (37); 0: linear rubber
  const FrictionLaw* friction;
};

/// The blocks of a segment in a step, and what becomes of them.
struct BlockStep {
  SegmentStations at;
  BlockLines lines;
  BlockMemory before;
  BlockLaw law;
  BlockResults results;
  double* force[4];  // of the segment's four nodes
  double* moment;    // on the rim: what of theirs about any point the nodes do not carry
};

/// t, n and |x'| of (10) at all stations.
void station_frames(const double* const nodes[4],
                    const double* weights,
                    const double* a,
                    int stride,
                    double* columns);

/// (10) at all stations: nine columns p, G = n - ν_n t + ψ a and A = a - ν_a t - ψ n, so that
/// T = p + H G + y A.
void station_columns(const SegmentStations& at, double* columns);

/// z of the lowest of the lines' tips at all stations, `columns` from station_columns.
void lowest_tips(const double* columns, const BlockLines& lines, int stride, double* z);

/// m, of the lines' tip that is nearest to a drum's surface, how far it is from there at all
/// stations, up to its square over the radius; `columns` from station_columns.
void gaps_to_drum(const double* columns,
                  const BlockLines& lines,
                  int stride,
                  const road::Cylinder& drum,
                  double* gap);

/// The planes of a drum's surface below the blocks at the stations [begin, end), of which a line
/// has `blocks` of its own.
void drum_planes(const BlockSpan& at,
                 const double* columns,
                 const double* lift,
                 const BlockLines& lines,
                 int blocks,
                 const road::Cylinder& drum,
                 const BlockGround& ground);

void find_entering(const BlockSpan& at, int lines, const double* touches, std::uint8_t* entering);

/// (10) to (14) of all blocks at the stations [begin, end). Adds to the forces of the four nodes.
/// Sections are bent where the lines have a rise.
void level_forces(const BlockStep& step, const LevelGround& ground);
void uneven_forces(const BlockStep& step, const BlockGround& ground);
/// Of planes that have no y, nor their velocities.
void drum_forces(const BlockStep& step, const BlockGround& ground);
/// In statics, with what friction holds from hold_friction(): standing_blocks.cpp.
void standing_forces(const BlockStep& step, const BlockGround& ground);
void hold_friction(const BlockSpan& at,
                   int lines,
                   const BlockGround& ground,
                   const BlockLaw& law,
                   const double* Fn);

/// The tips at the end of the step and whether they are on the road; `level`: its height where it
/// is level, else null.
void keep_tips(const BlockSpan& at,
               int lines,
               const BlockResults& results,
               const double* level,
               double* const tip[3],
               double* touches);

/// Stiffness of the blocks, K = k_n N N^T + k_t (1 - N N^T - d d^T where it slides along d), summed
/// over the lines: the six entries xx, xy, xz, yy, yz, zz of K, y K and y^2 K at the stations, 18
/// columns. `normal`, `tangential`: dF/dT of a cell barely pressed.
void level_stiffness(const BlockSpan& at,
                     const BlockLines& lines,
                     const BlockResults& results,
                     double normal,
                     double tangential,
                     double* sums);
void uneven_stiffness(const BlockSpan& at,
                      const BlockLines& lines,
                      const BlockGround& ground,
                      const BlockResults& results,
                      double normal,
                      double tangential,
                      double* sums);

}  // namespace latsch::ring_tire
