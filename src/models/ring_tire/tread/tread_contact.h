// SPDX-License-Identifier: Apache-2.0
// Tread blocks between belt and road. A block is at the fraction s of segment k, on one of the
// lines across the width at y. Its root is a point of the belt's curve, which depends on the four
// nodes k-1 .. k+2 (belt_curve.h). With p, x' the belt's middle there and its derivative by s, t
// along x' in the rim's plane, n = a × t outward, and H the height from belt to tip, the free tip
// is
//   T = p + H (n - ν_n t + ψ a) + y (a - ν_a t - ψ n),  ν_n = n . x'/|x'|,  ν_a = a . x'/|x'|  (10)
// The ν rotate the section with the belt's slope, so that a force at the tip has its right moment.
// t, n and |x'| are those of the beginning of a Newton solution, the predicted state of a step,
// which equals its end to third order: T is then linear in the unknowns and the forces have an
// energy. The block represents its cell, which ends midway to its neighbors along the line. p_E is
// half of the belt's increment along the cell, ξ = -1 .. 1. The road below is the plane through G
// with normal N; its material moves with v_G.
//   δ = N . (G - T),  g = -N . p_E,  λ: share of the cell where δ + g ξ > 0
//   F_n = c_n (D + t_d λ δ'),  D: mean of (δ + g ξ)_+; on p_E the mean of c_n ξ (δ + g ξ)_+   (11)
// For rubber that bottoms out, rubber_law.h replaces (δ + g ξ)_+, and λ is dD/dδ.
//   e: tip on the road minus T, in the plane;  F_t = λ c_t (e + t_d e')  while the tip sticks (12)
//   |F_t| <= μ_adhesion F_n, else the tip slides: tread_friction.h                            (13)
// The part of a cell that comes down within a step starts its e at first touch; e is the mean over
// the part that touches.
//
// Only blocks near the road are evaluated. A patch has the stations of one segment that may touch.
// Its data for a step are stored together, one quantity after the other, line by line.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "models/ring_tire/belt/cyclic_band.h"
#include "models/ring_tire/belt/rim_frame.h"
#include "models/ring_tire/belt/section_bending.h"
#include "models/ring_tire/belt/sidewall.h"
#include "models/ring_tire/description/ring_parameters.h"
#include "models/ring_tire/tread/block_forces.h"
#include "models/ring_tire/tread/tread_friction.h"
#include "models/ring_tire/tread/tread_memory.h"
#include "models/ring_tire/tread/tread_row.h"
#include "models/tire/footprint.h"

namespace latsch::ring_tire {

/// A block on the road.
struct BlockContact {
  Eigen::Vector3d tip;       // m, inertial, on the road
  Eigen::Vector3d root;      // m, on the road, position of the tip without shear
  Eigen::Vector3d unloaded;  // m, below the road, T of (10): point where the force acts
  Eigen::Vector3d force;     // N, on the tire
  Eigen::Vector3d moment;    // N m, of pressure that varies along the cell
  double area = 0.0;         // m^2, tread surface of the block
  double pressure = 0.0;     // Pa, on the rubber
  bool sticks = true;
};

/// Effect of a station on the four nodes of its segment, with weights w and derivatives d: node m
/// on node o by w_m w_o ww + w_m d_o wd + d_m w_o dw + d_m d_o dd.
struct StationStiffness {
  Eigen::Matrix4d ww = Eigen::Matrix4d::Zero(), wd = ww, dw = ww, dd = ww;
};

/// Derivatives of the forces of a segment's blocks at the end of a step. The forces are those on
/// its four nodes, four components each, then those on γ of the two nodes in the middle, three
/// each. They are differentiated by the positions of the nodes, whose velocities follow, and by
/// these γ. N/m and corresponding units.
struct PatchSlopes {
  static constexpr int kNodes = 16, kAll = kNodes + 2 * SectionBending::kModes;
  using Matrix = Eigen::Matrix<double, kAll, kAll>;

  int nodes[4];
  Matrix forces = Matrix::Zero();  // for γ: 0 if sections stay straight
  Eigen::Matrix<double, 3, kAll> moment_on_rim = Eigen::Matrix<double, 3, kAll>::Zero();
};

/// The belt at the beginning of a step: positions and velocities of its nodes.
struct BeltStart {
  const NodeValues *q, *v;
};

class RingTreadContact {
 public:
  RingTreadContact(const Tread& tread,
                   double radius,
                   int nodes,
                   const std::vector<Harmonic>& radial_runout = {});

  /// Resets the state to no touching block.
  void reset();
  TreadMemory memory() const { return TreadMemory(tips_); }
  void remember(const TreadMemory& memory);
  /// Bends the sections from now on: lines are farther from the belt by Σ γ_i q_i(y).
  void bend(const SectionBending& section);
  /// Returns the nodes that blocks of the patches depend on, in ascending order.
  std::vector<int> nodes_near_road() const;
  /// Returns the blocks' forces on the unknowns of the section; q is that of the last add_force.
  Eigen::VectorXd section_forces(const SectionBending& section, const NodeValues& q) const;
  /// Computes minus the derivatives of the blocks' forces by the unknowns of the belt, B, and of
  /// the section, A.
  void section_border(const SectionBending& section,
                      const NodeValues& q,
                      bool all_stick,
                      Eigen::MatrixXd& B,
                      Eigen::MatrixXd& A) const;
  /// Computes frames, candidate blocks and the road below them at a predicted end of the step.
  /// `start` is the belt at the beginning of the step; statics does not read it.
  void approach(const NodeValues& q,
                const RimFrame& rim,
                const road::Road& road,
                double time,
                const StepRule& rule,
                const BeltStart& start);
  /// Adds the forces of all blocks at q, v; keeps them for add_stiffness and commit.
  void add_force(const NodeValues& q, const NodeValues& v, NodeValues& force);
  /// The part of the blocks' moment in the last add_force, N m, that the forces on the nodes do not
  /// transmit. Sections are upright to the rim (10), so the rim carries it.
  const Eigen::Vector3d& moment_on_rim() const { return moment_on_rim_; }
  /// Adds scale * stiffness at the last add_force to K, without the growth of a sliding force with
  /// F_n, which would not be symmetric.
  void add_stiffness(double scale, CyclicBand& K);
  /// Adds the stiffness in rotated axes, whose unit vectors are the columns of `axes`.
  void add_stiffness(double scale, const Eigen::Matrix3d& axes, CyclicBandFactor& K);
  /// Adds the linearized forces of blocks whose tips all stick, for small vibrations about q of the
  /// last add_force. K gets their springs and the rotation by (10), because forces keep their
  /// direction when the belt rotates their arms; C gets their dampers.
  void add_sticking(const NodeValues& q, CyclicBand& K, CyclicBand& C) const;
  /// Returns the derivatives of the patches with blocks on the road at q, v of the last add_force.
  /// They are exact except for rounding if no block is about to touch, to leave or to slip.
  std::vector<PatchSlopes> patch_slopes(const SectionBending& section,
                                        const NodeValues& q,
                                        const NodeValues& v);
  /// Statics: from now on tips slip at the friction of the normal forces of the last add_force.
  void hold_friction();
  /// True if the road of approach() has a height below all blocks.
  bool knows_road() const { return knows_road_; }
  /// Ends the step: tips stay where they are on the road.
  void commit();

  /// Returns the depth, m, of the deepest tip below the road at q; negative above.
  double deepest(const NodeValues& q, const RimFrame& rim, const road::Road& road, double time);
  /// Returns the blocks that touch, including those whose damper cancels the spring's force. q is
  /// that of the last add_force.
  std::vector<BlockContact> contacts(const NodeValues& q) const;
  /// Returns these blocks as the pressure on a plate; x is along the unit vector `heading` in the
  /// horizontal plane. See footprint.cpp.
  Footprint footprint(const NodeValues& q,
                      const Eigen::Vector3d& center,
                      const Eigen::Vector3d& heading) const;
  /// Energy of the springs of the blocks, J.
  double energy(const NodeValues& q) const;

 private:
  /// Stations [begin, end) of a segment, multiples of eight.
  struct Patch {
    int segment, begin, end;
    bool level;          // one plane z = height under all of it, else one under each block
    bool drum;           // the planes are those of a drum
    LevelGround ground;  // used if `level`
  };
  /// Columns with one value for each block of a patch: results, ground.
  enum Column {
    kF = 0,
    kFn = 3,
    kGripped = 4,
    kTip = 5,
    kNormal = 8,
    kLevel = 11,
    kVelocity = 12,
    kFriction = 15,
    kHeld = 16,
    kShare = 17,
    kSlope = 18,
    kColumns = 19
  };
  static constexpr double kNoRoad = 1e6;  // m, below blocks of a line that are not evaluated
  /// Columns t, n and |x'| at the stations of a patch.
  enum FrameColumn { kT = 0, kN = 3, kLength = 6, kFrameColumns = 7 };
  static constexpr int kStartColumns = 18;  // number of columns of BlockMemory::start
  /// Columns for the current segment: those of (10), or sums over the lines.
  enum StationColumn { kP = 0, kG = 3, kA = 6, kStationColumns = 18 };

  int node(int segment, int m) const { return (segment + m - 1 + nodes_) % nodes_; }
  double* column(std::size_t patch, int c) {
    return memory_.data() + (patch * kColumns + static_cast<std::size_t>(c)) * lines_ * stride_;
  }
  const double* column(std::size_t patch, int c) const {
    return memory_.data() + (patch * kColumns + static_cast<std::size_t>(c)) * lines_ * stride_;
  }
  double* frame(std::size_t patch, int c) {
    return frames_.data() + (patch * kFrameColumns + static_cast<std::size_t>(c)) * stride_;
  }
  const double* frame(std::size_t patch, int c) const {
    return frames_.data() + (patch * kFrameColumns + static_cast<std::size_t>(c)) * stride_;
  }
  std::uint8_t* entering(std::size_t patch) {
    return entering_.data() + patch * static_cast<std::size_t>(stride_ / 8);
  }
  /// Returns H of (10), with the bending of the section.
  double height(int segment, int line, int j) const {
    const double H = line_height_[static_cast<std::size_t>(line)];
    if (section_rise_.empty()) return H;
    const double* rise = &section_rise_[2 * static_cast<std::size_t>(segment * lines_ + line)];
    return H + rise[0] + share_[static_cast<std::size_t>(j)] * (rise[1] - rise[0]);
  }
  Eigen::Vector3d tip(int line, int j) const {
    return tip(stations_.data(), patches_.back().segment, line, j);
  }
  double* at_stations(int c) { return stations_.data() + c * stride_; }
  /// Returns the unloaded tip from the columns of (10).
  Eigen::Vector3d tip(const double* columns, int segment, int line, int j) const {
    const double H = height(segment, line, j);
    const double y = line_y_[static_cast<std::size_t>(line)];
    const auto at = [&](int c) { return columns[c * stride_ + j]; };
    return {at(kP) + H * at(kG) + y * at(kA),
            at(kP + 1) + H * at(kG + 1) + y * at(kA + 1),
            at(kP + 2) + H * at(kG + 2) + y * at(kA + 2)};
  }

  /// Returns x, y, z of the tips or shares at the last commit.
  const double* before(int segment, TreadTips::Column column) const;
  bool near_road(const NodeValues& q,
                 const RimFrame& rim,
                 const road::Road& road,
                 double time,
                 double highest,
                 int segment) const;
  road::GroundBox below(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const;
  /// Adds a patch with all of a segment, its frames, and columns of (10) in at_stations.
  void add_patch(const NodeValues& q, int segment);
  /// Finds out which stations of the last patch have blocks that do not touch yet, and the belt
  /// there at the beginning of the step.
  void place_entering(const BeltStart& start);
  /// The road under all of a patch, or of a line of it, if it is one plane or drum.
  struct Plane {
    road::GroundPoint ground;
    double level;  // N . G
  };
  struct Uneven {
    double highest;     // m
    bool lines_differ;  // there may be a single plane below one of the lines
  };
  using Ground = std::variant<Uneven, Plane, road::Cylinder>;
  Ground ground_below(int first_line, int last_line, const road::Road& road, double time) const;
  /// Reduces a patch to the stations whose nearest tip is not above `reach`.
  void narrow(Patch& patch, const double* nearest, double reach) const;
  void widen(Patch& patch) const;
  const double* find_lowest_tips();
  void find_level_blocks(Patch& patch, const road::GroundPoint& ground);
  void find_blocks_on_drum(Patch& patch, const road::Cylinder& drum);
  void find_uneven_blocks(Patch& patch, const Ground& ground, const road::Road& road, double time);
  std::pair<int, int> place_cells(
      std::size_t patch, int line, double highest, const road::Road& road, double time);
  std::pair<int, int> find_line(
      std::size_t patch, int line, const Ground& ground, const road::Road& road, double time);
  road::GroundBox below(int first_line, int last_line) const;
  void place_ground(std::size_t patch, int block, const road::GroundPoint& ground, double level);
  SegmentStations stations_of(std::size_t patch, const NodeValues& q, const NodeValues& v) const;
  struct ProbedPatch;    // patch_slopes.cpp
  struct BlockState;     // touching_blocks.h
  struct Arms;           // block_arms.h
  struct StationBorder;  // section_contact.cpp
  std::vector<StationBorder> station_borders(const NodeValues& q, bool all_stick) const;
  Arms arms_at(std::size_t patch, int station, double H, double y) const;
  /// Returns half of the belt's increment along a cell.
  Eigen::Vector3d half_cell(std::size_t patch, int station, const NodeValues& q) const {
    Eigen::Vector3d half = Eigen::Vector3d::Zero();
    for (int m = 0; m < 4; ++m)
      half += halves_[static_cast<std::size_t>(m * stride_ + station)] *
              q.col(node(patches_[patch].segment, m)).head<3>();
    return half;
  }
  template <class See>
  void see_blocks(const NodeValues& q, const See& see) const;
  template <class See>
  void see_touching(const NodeValues& q, const See& see) const;
  BlockLines lines() const { return {lines_, line_height_.data(), line_y_.data()}; }
  /// Returns the lines with the bending of a segment's sections.
  BlockLines lines(int segment) const {
    BlockLines own = lines();
    if (section_rise_.empty()) return own;
    own.rise = &section_rise_[2 * static_cast<std::size_t>(segment * lines_)];
    own.share = share_.data();
    return own;
  }
  BlockLaw block_law() const;
  /// Fills everything except the positions of the forces.
  BlockStep step_of(std::size_t patch, const NodeValues& q, const NodeValues& v);
  template <class Add>
  void find_stiffness(double scale, const Eigen::Matrix3d& axes, const Add& add);
  void add_patch_force(std::size_t patch, const BlockStep& step);
  BlockResults results(std::size_t patch);
  BlockGround ground(std::size_t patch);

  int nodes_, lines_, blocks_, stride_;
  double half_cell_rise_;  // m, largest additional depth of a cell's end relative to its middle
  double height_, half_width_, area_, normal_, tangential_, damping_time_, positive_;
  double bottom_;  // m, b of (37); 0: linear rubber
  FrictionLaw law_;
  std::vector<double> line_y_, line_height_;
  std::vector<double> weights_;  // for position and its derivative by s: eight columns
  // Weights for pairs of nodes, forty at each station: tread_stiffness.cpp.
  std::vector<double> pair_weights_;
  // Half of the increase of the position's weights along a block's cell: four columns.
  std::vector<double> halves_;
  std::vector<double> lift_;
  std::vector<double> share_;                 // s of each station
  std::vector<Eigen::Vector3d> line_shapes_;  // q_i at the lines
  std::vector<double> runout_;                // m, of the tread at the nodes; empty: none
  double highest_runout_ = 0.0;
  bool bends_ = false;  // sections bend
  // BlockLines::rise of all segments, one after the other; empty if sections neither bend nor have
  // run-out.
  std::vector<double> section_rise_;
  std::shared_ptr<const TreadTips> tips_;  // at the last commit; null: no block touched
  std::shared_ptr<TreadTips> spare_;       // an earlier one, reused if nobody else holds it
  std::vector<double> none_;               // zeros, for a segment that was not near the road
  // Data of the current step.
  StepRule rule_;
  double margin_ = 0.0;  // m
  bool knows_road_ = true;
  Eigen::Vector3d a_ = Eigen::Vector3d::UnitY();
  std::vector<Patch> patches_;  // around the ring
  std::vector<double> frames_, memory_, stations_;
  std::vector<double> start_, start_frames_;  // BlockMemory::start of the patches; its frames
  TreadRow row_;
  Eigen::Vector3d moment_on_rim_ = Eigen::Vector3d::Zero();
  std::vector<std::uint8_t> entering_;  // for each eight stations of a patch
  std::vector<StationStiffness> station_stiffness_;
};

}  // namespace latsch::ring_tire
