// SPDX-License-Identifier: Apache-2.0
// Tread blocks between belt and road. A block sits at the fraction s of segment k, on one of the
// lines across the width at y; its root is interpolated from the four nodes k-1 .. k+2 by cubic
// splines (Catmull-Rom). With p, x' the belt's middle there and its derivative by s, t along x' in
// the rim's plane, n = a × t outward, H the height from belt to tip, the unloaded tip is
//   T = p + H (n - ν_n t + ψ a) + y (a - ν_a t - ψ n),  ν_n = n . x'/|x'|,  ν_a = a . x'/|x'|  (10)
// The ν turn the section with the belt's slope, so that a force at the tip has its right moment.
// t, n and |x'| are those of the beginning of a Newton solution (the predicted state of a step,
// which is as good as its end to third order): then T is linear in the unknowns and forces have
// an energy. The road below the tip is the plane through G with normal N, its material at v_G.
//   δ = N . (G - T),  F_n = c_n (δ + t_d δ')  where both are positive                        (11)
//   e: tip on the road minus T, in the plane;  F_t = c_t (e + t_d e')  while the tip sticks    (12)
//   |F_t| <= μ_adhesion F_n, else the tip slides: tread_friction.h                            (13)
// A block that comes down within a step starts its e at the touch.
//
// Only blocks near the road are looked at. What a step needs of them is copied to compact arrays,
// one quantity after the other, row by row (a row: the blocks of one line on one segment).
#pragma once

#include <cstdint>
#include <vector>

#include "models/ring_tire/block_forces.h"
#include "models/ring_tire/cyclic_band.h"
#include "models/ring_tire/rim_frame.h"
#include "models/ring_tire/ring_parameters.h"
#include "models/ring_tire/sidewall.h"
#include "models/ring_tire/tread_friction.h"

namespace latsch::ring_tire {

/// A block on the road.
struct BlockContact {
  Eigen::Vector3d tip;    // m, inertial, on the road
  Eigen::Vector3d root;   // m, where the tip would stand without shear: where its force acts
  Eigen::Vector3d force;  // N, on the tire
  double area = 0.0;      // m^2, of tread surface that is the block's
  double pressure = 0.0;  // Pa, on the rubber
  bool sticks = true;
};

class TreadContact {
 public:
  TreadContact(const Tread& tread, double radius, int nodes);

  /// No block touches.
  void reset();
  /// Frames, candidate blocks and the road below them at a predicted end of the step.
  void approach(const NodeValues& q,
                const NodeValues& v,
                const RimFrame& rim,
                const road::Road& road,
                double time,
                const StepRule& rule);
  /// Forces of all blocks at q, v; kept for add_stiffness and commit.
  void add_force(const NodeValues& q, const NodeValues& v, NodeValues& force);
  /// K += scale * stiffness at the last add_force; without the growth of a sliding force with F_n,
  /// which would not be symmetric.
  void add_stiffness(double scale, CyclicBand& K);
  /// Statics: from here on tips give way at the friction of the normal forces at the last
  /// add_force.
  void hold_friction();
  /// The step is done: tips stay where they are on the road.
  void commit();

  /// m, how far the deepest tip would be below the road at q; negative above.
  double deepest(const NodeValues& q, const RimFrame& rim, const road::Road& road, double time);
  /// The blocks that touch, at the last add_force.
  std::vector<BlockContact> footprint() const;
  /// J, in the springs of the blocks.
  double energy() const;
  int candidates() const { return count_; }

 private:
  struct Row {
    int segment, line, begin, end;  // blocks [begin, end)
    int offset;                     // of block `begin` in the compact arrays
  };
  /// One a candidate block.
  enum Column {
    kNx,
    kNy,
    kNz,
    kLevel,
    kVx,
    kVy,
    kVz,
    kMu,  // road: N, N . G, v_G, factor on friction
    kTipX,
    kTipY,
    kTipZ,
    kTouches,  // tip as the road carries it; 0 or 1
    kFx,
    kFy,
    kFz,
    kFn,  // tangential force; normal force
    kEx,
    kEy,
    kEz,
    kGripped,
    kOver,  // e; force over that of a sticking tip; beyond adhesion
    kNewX,
    kNewY,
    kNewZ,  // T on the road
    kHeld,  // force along the road that friction holds, in statics
    kColumns
  };
  /// One a station of the segment at work: columns of (10), their rates, sums over the lines.
  enum StationColumn {
    kP = 0,
    kG = 3,
    kA = 6,
    kRateP = 9,
    kRateG = 12,
    kRateA = 15,
    kSum = 18,
    kSumH = 21,
    kSumY = 24,
    kStationColumns = 27
  };

  std::size_t place(int segment, int line, int block) const {
    return static_cast<std::size_t>((segment * lines_ + line) * blocks_ + block);
  }
  int node(int segment, int m) const { return (segment + m - 1 + nodes_) % nodes_; }
  double* column(Column c) { return memory_.data() + static_cast<std::size_t>(c) * capacity_; }
  const double* column(Column c) const {
    return memory_.data() + static_cast<std::size_t>(c) * capacity_;
  }
  double* at_stations(int c) { return stations_.data() + static_cast<std::size_t>(c * blocks_); }
  /// Of a segment: t, n and |x'| at its stations, seven columns.
  enum FrameColumn { kT = 0, kN = 3, kLength = 6, kFrameColumns = 7 };
  double* frame(int segment, int c) {
    return frames_.data() + static_cast<std::size_t>((segment * kFrameColumns + c) * blocks_);
  }
  Eigen::Vector3d frame_vector(int segment, int c, int block) {
    return {frame(segment, c)[block], frame(segment, c + 1)[block], frame(segment, c + 2)[block]};
  }
  const double* weight(int m) const { return weights_.data() + m * blocks_; }
  const double* slope_weight(int m) const { return weights_.data() + (4 + m) * blocks_; }

  bool near_road(const NodeValues& q,
                 const RimFrame& rim,
                 const road::Road& road,
                 double time,
                 int segment) const;
  void set_frames(const NodeValues& q, int segment);
  void set_stations(const NodeValues& q, const NodeValues& v, int segment, int begin, int end);
  void approach_line(int segment, int line, const road::Road& road, double time);
  void place_ground(const Row& row, int j, const road::GroundPoint& ground, double level);
  BlockColumns block_columns();
  void row_forces(const Row& row);
  void standing_forces(const Row& row);
  void rolling_forces(const Row& row);
  void slide(int at);
  void add_station_forces(int segment, int begin, int end, NodeValues& force);

  int nodes_, lines_, blocks_;
  double height_, half_width_, area_, normal_, tangential_, damping_time_, positive_;
  FrictionLaw law_;
  std::vector<double> line_y_, line_height_;
  std::vector<double> weights_;  // of position and of its derivative by s: eight columns
  // Persistent, one a block: the tip on the road and whether it is there.
  std::vector<double> tip_x_, tip_y_, tip_z_;
  std::vector<std::uint8_t> touches_;
  std::vector<Row> touched_rows_;  // at the last commit
  // Of the step at work.
  StepRule rule_;
  double margin_ = 0.0;  // m
  Eigen::Vector3d a_ = Eigen::Vector3d::UnitY();
  std::vector<Row> rows_;       // segment by segment
  std::vector<double> frames_;  // of the segments with rows
  int count_ = 0;
  std::size_t capacity_;
  std::vector<double> memory_, stations_;
};

}  // namespace latsch::ring_tire
