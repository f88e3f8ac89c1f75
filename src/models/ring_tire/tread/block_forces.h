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

/// Stations of one segment and the state of the belt at them.
struct SegmentStations {
  int stride, begin, end;        // [begin, end): stations at work, multiples of eight
  const double* nodes[4];        // positions and torsions of the four nodes
  const double* rates[4];        // rates of these positions and torsions
  const double* weights;         // weights w of position and d of its derivative: four columns each
  const double* halves;          // half of the increase of w along a block's cell: four columns
  const double* lift;            // m, 0 at a block's own station, else far above any road
  const double *t, *n, *length;  // columns of (10): three, three, one
  const double* a;
};

struct BlockLines {
  int count;
  const double *height, *y;  // one for each line
  /// Rise of the lines above `height` because the section is bent or has run-out, m. Each line has
  /// two successive values, at the beginning and at the end of the segment. Null: no rise.
  const double* rise = nullptr;
  const double* share = nullptr;  // weight of the second of these values at each station, 0 to 1
};

/// State of the blocks of a segment at the beginning of a step.
struct BlockMemory {
  const double *tip[3], *touches;  // tip on the road; share of the block's cell on it
  const std::uint8_t* entering;    // for each eight stations: true if not all touch
  const double*
      start;  // at stations that are entering: columns of station_columns and station_rates
};

/// Results of (11) to (14). On level ground z of F and of the tip are not written, because they are
/// 0 and the height.
struct BlockResults {
  double* F[3];     // tangential force on the tire
  double* Fn;       // normal force
  double* gripped;  // tangential force, divided by that of a sticking tip
  double* share;    // share of the block's cell on the road
  /// dF_n/dδ, divided by that of a cell that just touches the road. Null for linear rubber, for
  /// which this ratio is the share.
  double* slope;
  double* tip[3];  // on the road if the block touches
};

/// One plane z = height under all of a segment.
struct LevelGround {
  double height, velocity[3], friction;
};

/// A separate plane under each block.
struct BlockGround {
  double* N[3];         // normal
  double* level;        // N . G
  double* velocity[3];  // velocity of its material
  double* friction;     // factor on the tread's own friction
  double* held;         // in statics: force along the road that friction holds
};

struct BlockLaw {
  double normal, tangential, damping_time, step;
  double by_force;  // pressure on the rubber divided by F_n
  double bottom;    // m, b of (37); 0: linear rubber
  const FrictionLaw* friction;
};

/// One step of the blocks of a segment, with inputs and results.
struct BlockStep {
  SegmentStations at;
  BlockLines lines;
  BlockMemory before;
  BlockLaw law;
  BlockResults results;
  double* force[4];  // forces on the segment's four nodes
  double* moment;    // moment on the rim: the part that the nodes do not carry
};

/// Computes t, n and |x'| of (10) at all stations.
void station_frames(const double* const nodes[4],
                    const double* weights,
                    const double* a,
                    int stride,
                    double* columns);

/// Computes (10) at all stations: nine columns p, G = n - ν_n t + ψ a and A = a - ν_a t - ψ n, so
/// that T = p + H G + y A.
void station_columns(const SegmentStations& at, double* columns);

/// Computes the rates of p, G and A at all stations, nine columns; t, n and a are held.
void station_rates(const SegmentStations& at, double* columns);

/// Computes z of the lowest of the lines' tips at all stations from `columns` of station_columns.
void lowest_tips(const double* columns, const BlockLines& lines, int stride, double* z);

/// Computes the distance, m, of the nearest of the lines' tips from a drum's surface at all
/// stations, up to its square over the radius, from `columns` of station_columns.
void gaps_to_drum(const double* columns,
                  const BlockLines& lines,
                  int stride,
                  const road::Cylinder& drum,
                  double* gap);

/// Computes the planes of a drum's surface below the blocks at the stations [begin, end). A line
/// has `blocks` blocks.
void drum_planes(const BlockSpan& at,
                 const double* columns,
                 const double* lift,
                 const BlockLines& lines,
                 int blocks,
                 const road::Cylinder& drum,
                 const BlockGround& ground);

void find_entering(const BlockSpan& at, int lines, const double* touches, std::uint8_t* entering);

/// Evaluate (10) to (14) for all blocks at the stations [begin, end) and add to the forces of the
/// four nodes. Sections are bent if the lines have a rise.
void level_forces(const BlockStep& step, const LevelGround& ground);
void uneven_forces(const BlockStep& step, const BlockGround& ground);
/// Evaluates planes without y component in normal and velocity.
void drum_forces(const BlockStep& step, const BlockGround& ground);
/// Evaluates statics, with the friction limit of hold_friction(): standing_blocks.cpp.
void standing_forces(const BlockStep& step, const BlockGround& ground);
void hold_friction(const BlockSpan& at,
                   int lines,
                   const BlockGround& ground,
                   const BlockLaw& law,
                   const double* Fn);

/// Stores the tips at the end of the step and whether they are on the road. `level` points to the
/// height of level road, else it is null.
void keep_tips(const BlockSpan& at,
               int lines,
               const BlockResults& results,
               const double* level,
               double* const tip[3],
               double* touches);

/// Stiffness of the blocks, K = k_n N N^T + k_t (1 - N N^T - d d^T if it slides along d), summed
/// over the lines: the six entries xx, xy, xz, yy, yz, zz of K, y K and y^2 K at the stations, 18
/// columns. `normal` and `tangential` are the stiffnesses, N/m, of one block that just touches the
/// road.
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
