// SPDX-License-Identifier: Apache-2.0
// Tread blocks between belt and road. A block sits at the fraction s of segment k, on one of the
// lines across the width at y; its root is a point of the belt's curve, which hangs on the four
// nodes k-1 .. k+2 (belt_curve.h). With p, x' the belt's middle there and its derivative by s, t
// along x' in the rim's plane, n = a × t outward, H the height from belt to tip, the free tip is
//   T = p + H (n - ν_n t + ψ a) + y (a - ν_a t - ψ n),  ν_n = n . x'/|x'|,  ν_a = a . x'/|x'|  (10)
// The ν turn the section with the belt's slope, so that a force at the tip has its right moment.
// t, n and |x'| are those of the beginning of a Newton solution (the predicted state of a step,
// which is as good as its end to third order): then T is linear in the unknowns and forces have
// an energy. The block stands for its cell, from the middle to one neighbor to that to the other;
// p_E: half of what the belt gains along it, ξ = -1 .. 1. The road below is the plane through G
// with normal N, its material at v_G.
//   δ = N . (G - T),  g = -N . p_E,  λ: share of the cell where δ + g ξ > 0
//   F_n = c_n (D + t_d λ δ'),  D: mean of (δ + g ξ)_+; on p_E the mean of c_n ξ (δ + g ξ)_+   (11)
// or, of rubber that bottoms out, of what rubber_law.h makes of (δ + g ξ)_+; λ: dD/dδ
//   e: tip on the road minus T, in the plane;  F_t = λ c_t (e + t_d e')  while the tip sticks (12)
//   |F_t| <= μ_adhesion F_n, else the tip slides: tread_friction.h                            (13)
// What comes down within a step starts its e at the touch; e is the mean over what touches.
//
// Only blocks near the road are looked at: a patch, the stations of one segment that may touch.
// What a step needs of them stands together, one quantity after the other, line by line.
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
  Eigen::Vector3d root;      // m, on the road, where the tip would stand without shear
  Eigen::Vector3d unloaded;  // m, below the road, T of (10): where its force acts
  Eigen::Vector3d force;     // N, on the tire
  Eigen::Vector3d moment;    // N m, of pressure that differs along the cell
  double area = 0.0;         // m^2, of tread surface that is the block's
  double pressure = 0.0;     // Pa, on the rubber
  bool sticks = true;
};

/// What a station does to the four nodes of its segment, of weights w and derivatives d: node m on
/// node o by w_m w_o ww + w_m d_o wd + d_m w_o dw + d_m d_o dd.
struct StationStiffness {
  Eigen::Matrix4d ww = Eigen::Matrix4d::Zero(), wd = ww, dw = ww, dd = ww;
};

/// How the forces of a segment's blocks change with what they hang on at the end of a step: those
/// on its four nodes, four a node, then those on γ of the two in the middle, three a node; by the
/// places of the nodes, whose velocities follow, and by these γ. N/m and the like.
struct PatchSlopes {
  static constexpr int kNodes = 16, kAll = kNodes + 2 * SectionBending::kModes;
  using Matrix = Eigen::Matrix<double, kAll, kAll>;

  int nodes[4];
  Matrix forces = Matrix::Zero();  // of γ: 0 where sections stay straight
  Eigen::Matrix<double, 3, kAll> moment_on_rim = Eigen::Matrix<double, 3, kAll>::Zero();
};

class TreadContact {
 public:
  TreadContact(const Tread& tread,
               double radius,
               int nodes,
               const std::vector<Harmonic>& radial_runout = {});

  /// No block touches.
  void reset();
  TreadMemory memory() const { return TreadMemory(tips_); }
  void remember(const TreadMemory& memory);
  /// Sections bent as they are there from here on: lines stand off the belt by Σ γ_i q_i(y) more.
  void bend(const SectionBending& section);
  /// Nodes that blocks of the patches hang on, in ascending order.
  std::vector<int> nodes_near_road() const;
  /// The blocks' forces on the unknowns of the section, q: of the last add_force.
  Eigen::VectorXd section_forces(const SectionBending& section, const NodeValues& q) const;
  /// How they fall with the unknowns of the belt, B, and with those of the section, A.
  void section_border(const SectionBending& section,
                      const NodeValues& q,
                      bool all_stick,
                      Eigen::MatrixXd& B,
                      Eigen::MatrixXd& A) const;
  /// Frames, candidate blocks and the road below them at a predicted end of the step.
  void approach(const NodeValues& q,
                const RimFrame& rim,
                const road::Road& road,
                double time,
                const StepRule& rule);
  /// Forces of all blocks at q, v; kept for add_stiffness and commit.
  void add_force(const NodeValues& q, const NodeValues& v, NodeValues& force);
  /// N m, of the last add_force: what of the blocks' moment, about any point, the forces on the
  /// nodes do not have. Sections are upright to the rim (10), so it is the rim that holds them.
  const Eigen::Vector3d& moment_on_rim() const { return moment_on_rim_; }
  /// K += scale * stiffness at the last add_force; without the growth of a sliding force with F_n,
  /// which would not be symmetric.
  void add_stiffness(double scale, CyclicBand& K);
  /// The same in turned axes, columns of which are their unit vectors.
  void add_stiffness(double scale, const Eigen::Matrix3d& axes, CyclicBandFactor& K);
  /// What small vibrations about q feel of blocks whose tips all stick, q: of the last add_force.
  /// K: their springs and, since forces keep their direction where the belt turns their arms, the
  /// turning of (10); C: their dampers.
  void add_sticking(const NodeValues& q, CyclicBand& K, CyclicBand& C) const;
  /// Of the patches with blocks on the road at q, v of the last add_force; exact but for rounding
  /// where no block is about to touch, to leave or to slip.
  std::vector<PatchSlopes> patch_slopes(const SectionBending& section,
                                        const NodeValues& q,
                                        const NodeValues& v);
  /// Statics: from here on tips give way at the friction of the normal forces at the last
  /// add_force.
  void hold_friction();
  /// Whether the road of approach() has a height below all blocks.
  bool knows_road() const { return knows_road_; }
  /// The step is done: tips stay where they are on the road.
  void commit();

  /// m, how far the deepest tip would be below the road at q; negative above.
  double deepest(const NodeValues& q, const RimFrame& rim, const road::Road& road, double time);
  /// The blocks that touch, those included whose damper takes all of the spring's force; q: of the
  /// last add_force.
  std::vector<BlockContact> contacts(const NodeValues& q) const;
  /// The same as a plate sees it; x along the unit vector `heading` of the horizontal plane.
  Footprint footprint(const NodeValues& q,
                      const Eigen::Vector3d& center,
                      const Eigen::Vector3d& heading) const;
  /// J, in the springs of the blocks.
  double energy(const NodeValues& q) const;

 private:
  /// Stations [begin, end) of a segment, multiples of eight.
  struct Patch {
    int segment, begin, end;
    bool level;          // one plane z = height under all of it, else one under each block
    bool drum;           // these are those of a drum
    LevelGround ground;  // where it is level
  };
  /// One a block of a patch: results, ground.
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
  static constexpr double kNoRoad = 1e6;  // m, below the blocks of a line that are not looked at
  /// t, n and |x'| at the stations of a patch.
  enum FrameColumn { kT = 0, kN = 3, kLength = 6, kFrameColumns = 7 };
  /// Of the segment at work: columns of (10), or sums over the lines.
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
  /// H of (10), with the bending of the section.
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
  /// Unloaded tip by the columns of (10).
  Eigen::Vector3d tip(const double* columns, int segment, int line, int j) const {
    const double H = height(segment, line, j);
    const double y = line_y_[static_cast<std::size_t>(line)];
    const auto at = [&](int c) { return columns[c * stride_ + j]; };
    return {at(kP) + H * at(kG) + y * at(kA),
            at(kP + 1) + H * at(kG + 1) + y * at(kA + 1),
            at(kP + 2) + H * at(kG + 2) + y * at(kA + 2)};
  }

  /// x, y, z of the tips or shares at the last commit.
  const double* before(int segment, TreadTips::Column column) const;
  bool near_road(const NodeValues& q,
                 const RimFrame& rim,
                 const road::Road& road,
                 double time,
                 double highest,
                 int segment) const;
  road::GroundBox below(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const;
  /// One more patch, all of a segment, with its frames; columns of (10) at_stations.
  void add_patch(const NodeValues& q, int segment);
  /// The road under all of a patch, or of a line of it, where that is one plane or drum.
  struct Plane {
    road::GroundPoint ground;
    double level;  // N . G
  };
  struct Uneven {
    double highest;     // m
    bool lines_differ;  // below one of the lines it may be a plane
  };
  using Ground = std::variant<Uneven, Plane, road::Cylinder>;
  Ground ground_below(int first_line, int last_line, const road::Road& road, double time) const;
  /// Stations of a patch of which the nearest tip is not above `reach`.
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
  /// Half of what the belt gains along a cell.
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
  /// With what a segment's sections are bent by.
  BlockLines lines(int segment) const {
    BlockLines own = lines();
    if (section_rise_.empty()) return own;
    own.rise = &section_rise_[2 * static_cast<std::size_t>(segment * lines_)];
    own.share = share_.data();
    return own;
  }
  BlockLaw block_law() const;
  /// All but the forces' places.
  BlockStep step_of(std::size_t patch, const NodeValues& q, const NodeValues& v);
  template <class Add>
  void find_stiffness(double scale, const Eigen::Matrix3d& axes, const Add& add);
  void add_patch_force(std::size_t patch, const BlockStep& step);
  BlockResults results(std::size_t patch);
  BlockGround ground(std::size_t patch);

  int nodes_, lines_, blocks_, stride_;
  double half_cell_rise_;  // m, the most by which a cell's end may be deeper than its middle
  double height_, half_width_, area_, normal_, tangential_, damping_time_, positive_;
  double bottom_;  // m, b of (37); 0: linear rubber
  FrictionLaw law_;
  std::vector<double> line_y_, line_height_;
  std::vector<double> weights_;       // of position and of its derivative by s: eight columns
  std::vector<double> pair_weights_;  // of pairs of nodes: tread_stiffness.cpp, forty a station
  std::vector<double> halves_;  // half of what that of position gains along a block's cell: four
  std::vector<double> lift_;
  std::vector<double> share_;                 // s of each station
  std::vector<Eigen::Vector3d> line_shapes_;  // q_i at the lines
  std::vector<double> runout_;                // m, of the tread at the nodes; empty: none
  double highest_runout_ = 0.0;
  bool bends_ = false;                     // sections do
  std::vector<double> section_rise_;       // two a line of a segment; empty: bend nor run-out
  std::shared_ptr<const TreadTips> tips_;  // at the last commit; none: no block touched
  std::shared_ptr<TreadTips> spare_;       // of one before, written over where nobody has it
  std::vector<double> none_;               // of a segment that was not near the road
  // Of the step at work.
  StepRule rule_;
  double margin_ = 0.0;  // m
  bool knows_road_ = true;
  Eigen::Vector3d a_ = Eigen::Vector3d::UnitY();
  std::vector<Patch> patches_;  // around the ring
  std::vector<double> frames_, memory_, stations_;
  TreadRow row_;
  Eigen::Vector3d moment_on_rim_ = Eigen::Vector3d::Zero();
  std::vector<std::uint8_t> entering_;  // of each eight stations of a patch
  std::vector<StationStiffness> station_stiffness_;
};

}  // namespace latsch::ring_tire
