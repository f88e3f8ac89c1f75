// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/tread_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace latsch::ring_tire {
namespace {

using Eigen::Vector3d;

// m. Blocks as far above the road take part in a step: more than its end can differ from what was
// predicted.
constexpr double kMargin = 5e-4, kStandingMargin = 4e-3;

}  // namespace

TreadContact::TreadContact(const Tread& tread, double radius, int nodes)
    : nodes_(nodes),
      lines_(tread.lines),
      blocks_(tread.blocks),
      height_(tread.height),
      half_width_(0.5 * tread.width),
      damping_time_(tread.damping_time),
      positive_(tread.positive),
      law_(tread.friction) {
  const std::size_t all = static_cast<std::size_t>(nodes) * lines_ * blocks_;
  area_ = 2.0 * std::numbers::pi * radius * tread.width / static_cast<double>(all);
  normal_ = tread.positive * tread.young_modulus * area_ / tread.height;
  tangential_ = tread.shear_ratio * normal_;
  for (int line = 0; line < lines_; ++line) {
    const double y = tread.width * ((line + 0.5) / lines_ - 0.5);
    line_y_.push_back(y);
    const double drop = tread.crown_radius > 0.0 ? 0.5 * y * y / tread.crown_radius : 0.0;
    line_height_.push_back(tread.height - drop);
  }
  weights_.resize(static_cast<std::size_t>(8 * blocks_));
  for (int j = 0; j < blocks_; ++j) {
    const double s = (j + 0.5) / blocks_, s2 = s * s, s3 = s2 * s;
    const double catmull_rom[8] = {0.5 * (-s3 + 2.0 * s2 - s),
                                   0.5 * (3.0 * s3 - 5.0 * s2 + 2.0),
                                   0.5 * (-3.0 * s3 + 4.0 * s2 + s),
                                   0.5 * (s3 - s2),
                                   0.5 * (-3.0 * s2 + 4.0 * s - 1.0),
                                   0.5 * (9.0 * s2 - 10.0 * s),
                                   0.5 * (-9.0 * s2 + 8.0 * s + 1.0),
                                   0.5 * (3.0 * s2 - 2.0 * s)};
    for (int m = 0; m < 8; ++m)
      weights_[static_cast<std::size_t>(m * blocks_ + j)] = catmull_rom[m];
  }
  capacity_ = all;
  tip_x_.resize(all);
  tip_y_.resize(all);
  tip_z_.resize(all);
  touches_.resize(all);
  memory_.resize(all * kColumns);
  frames_.resize(static_cast<std::size_t>(nodes * blocks_ * kFrameColumns));
  stations_.resize(static_cast<std::size_t>(kStationColumns) * blocks_);
  rows_.reserve(static_cast<std::size_t>(nodes) * lines_);
  touched_rows_.reserve(rows_.capacity());
}

void TreadContact::reset() {
  std::fill(touches_.begin(), touches_.end(), std::uint8_t{0});
  touched_rows_.clear();
  rows_.clear();
  count_ = 0;
}

/// Whether a tip of the segment may be as low as the highest point of the road below it.
bool TreadContact::near_road(const NodeValues& q,
                             const RimFrame& rim,
                             const road::Road& road,
                             double time,
                             int segment) const {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (int m = 0; m < 4; ++m) {
    low = low.cwiseMin(q.col(node(segment, m)).head<3>());
    high = high.cwiseMax(q.col(node(segment, m)).head<3>());
  }
  if (low.z() > rim.center.z()) return false;
  // How far tips stand off the belt: height and half the width, leaning a little more than the rim.
  constexpr double kLean = 0.2;
  const double reach = 1.1 * height_ + half_width_ * (rim.a.cwiseAbs().z() + kLean * 0.25);
  const double side = height_ + half_width_;
  const road::GroundBox box{low.x() - side, high.x() + side, low.y() - side, high.y() + side};
  return low.z() - reach <= road.bounds(box, time).highest + margin_;
}

void TreadContact::set_frames(const NodeValues& q, int segment) {
  const auto x = [&](int m) { return q.col(node(segment, m)).head<3>(); };
  for (int j = 0; j < blocks_; ++j) {
    const Vector3d slope = slope_weight(0)[j] * x(0) + slope_weight(1)[j] * x(1) +
                           slope_weight(2)[j] * x(2) + slope_weight(3)[j] * x(3);
    const Vector3d in_plane = slope - a_ * a_.dot(slope);
    const double length = in_plane.norm();
    const Vector3d t = in_plane / length, n = a_.cross(t);
    for (int i = 0; i < 3; ++i) {
      frame(segment, kT + i)[j] = t[i];
      frame(segment, kN + i)[j] = n[i];
    }
    frame(segment, kLength)[j] = length;
  }
}

void TreadContact::set_stations(
    const NodeValues& q, const NodeValues& v, int segment, int begin, int end) {
  const StationFrames frames{frame(segment, kT), frame(segment, kN), frame(segment, kLength)};
  for (const bool rates : {false, true}) {
    const NodeValues& values = rates ? v : q;
    const double* nodes[4];
    for (int m = 0; m < 4; ++m) nodes[m] = values.col(node(segment, m)).data();
    station_columns(nodes,
                    weights_.data(),
                    frames,
                    a_.data(),
                    rates,
                    blocks_,
                    begin,
                    end,
                    at_stations(rates ? kRateP : kP));
  }
}

void TreadContact::approach(const NodeValues& q,
                            const NodeValues& v,
                            const RimFrame& rim,
                            const road::Road& road,
                            double time,
                            const StepRule& rule) {
  rule_ = rule;
  margin_ = rule.statics() ? kStandingMargin : kMargin;
  a_ = rim.a;
  rows_.clear();
  count_ = 0;
  for (int segment = 0; segment < nodes_; ++segment) {
    if (!near_road(q, rim, road, time, segment)) continue;
    set_frames(q, segment);
    set_stations(q, v, segment, 0, blocks_);
    for (int line = 0; line < lines_; ++line) approach_line(segment, line, road, time);
  }
}

void TreadContact::approach_line(int segment, int line, const road::Road& road, double time) {
  const double H = line_height_[static_cast<std::size_t>(line)];
  const double y = line_y_[static_cast<std::size_t>(line)];
  const auto tip = [&](int i, int j) {
    return at_stations(kP + i)[j] + H * at_stations(kG + i)[j] + y * at_stations(kA + i)[j];
  };
  const auto ends = std::minmax({tip(0, 0), tip(0, blocks_ - 1)});
  const auto sides = std::minmax({tip(1, 0), tip(1, blocks_ - 1)});
  // A line is as good as straight over a segment; its sagitta is well below the length.
  const double room = 0.1 * (ends.second - ends.first);
  const road::GroundBox box{
      ends.first - room, ends.second + room, sides.first - room, sides.second + room};
  Row row{segment, line, 0, blocks_, count_};
  if (road.bounds(box, time).plane) {
    const double x = 0.5 * (box.x0 + box.x1), yy = 0.5 * (box.y0 + box.y1);
    const road::GroundPoint ground = road.at(x, yy, time);
    const double level = ground.normal.dot(Vector3d(x, yy, ground.height));
    const auto above = [&](int j) {
      return ground.normal.dot(Vector3d(tip(0, j), tip(1, j), tip(2, j))) > level + margin_;
    };
    while (row.begin < row.end && above(row.begin)) ++row.begin;
    while (row.end > row.begin && above(row.end - 1)) --row.end;
    for (int j = row.begin; j < row.end; ++j) place_ground(row, j, ground, level);
  } else {
    const auto above = [&](int j) {
      return tip(2, j) > road.height(tip(0, j), tip(1, j), time) + margin_;
    };
    while (row.begin < row.end && above(row.begin)) ++row.begin;
    while (row.end > row.begin && above(row.end - 1)) --row.end;
    for (int j = row.begin; j < row.end; ++j) {
      const road::GroundPoint ground = road.at(tip(0, j), tip(1, j), time);
      place_ground(
          row, j, ground, ground.normal.dot(Vector3d(tip(0, j), tip(1, j), ground.height)));
    }
  }
  if (row.begin == row.end) return;
  rows_.push_back(row);
  count_ += row.end - row.begin;
}

/// Block j of a row: the plane of the road below it and where the road carries its tip.
void TreadContact::place_ground(const Row& row,
                                int j,
                                const road::GroundPoint& ground,
                                double level) {
  const int at = row.offset + j - row.begin;
  column(kNx)[at] = ground.normal.x();
  column(kNy)[at] = ground.normal.y();
  column(kNz)[at] = ground.normal.z();
  column(kLevel)[at] = level;
  column(kVx)[at] = ground.velocity.x();
  column(kVy)[at] = ground.velocity.y();
  column(kVz)[at] = ground.velocity.z();
  column(kMu)[at] = ground.friction;
  const std::size_t own = place(row.segment, row.line, j);
  column(kTouches)[at] = touches_[own];
  column(kTipX)[at] = tip_x_[own] + rule_.step * ground.velocity.x();
  column(kTipY)[at] = tip_y_[own] + rule_.step * ground.velocity.y();
  column(kTipZ)[at] = tip_z_[own] + rule_.step * ground.velocity.z();
}

BlockColumns TreadContact::block_columns() {
  return {.N = {column(kNx), column(kNy), column(kNz)},
          .level = column(kLevel),
          .road = {column(kVx), column(kVy), column(kVz)},
          .mu = column(kMu),
          .tip = {column(kTipX), column(kTipY), column(kTipZ)},
          .touches = column(kTouches),
          .F = {column(kFx), column(kFy), column(kFz)},
          .Fn = column(kFn),
          .e = {column(kEx), column(kEy), column(kEz)},
          .gripped = column(kGripped),
          .over = column(kOver),
          .on_road = {column(kNewX), column(kNewY), column(kNewZ)}};
}

void TreadContact::row_forces(const Row& row) {
  const double H = line_height_[static_cast<std::size_t>(row.line)];
  const double y = line_y_[static_cast<std::size_t>(row.line)];
  if (rule_.statics())
    standing_forces(row);
  else
    rolling_forces(row);
  add_row_sums(block_columns(),
               stations_.data() + kSum * blocks_,
               blocks_,
               row.begin,
               row.end,
               row.offset,
               H,
               y);
}

void TreadContact::rolling_forces(const Row& row) {
  const BlockColumns blocks = block_columns();
  const double H = line_height_[static_cast<std::size_t>(row.line)];
  const double y = line_y_[static_cast<std::size_t>(row.line)];
  // Pressure on the rubber is F_n over its area.
  const double by_force = 1.0 / (positive_ * area_);
  const FrictionLaw::Quadratic& mu = law_.adhesion_law();
  const BlockLaw law{.normal = normal_,
                     .tangential = tangential_,
                     .damping_time = damping_time_,
                     .step = rule_.step,
                     .c0 = mu.c0,
                     .c1 = mu.c1 * by_force,
                     .c2 = mu.c2 * by_force * by_force,
                     .lowest = law_.lowest_pressure() / by_force,
                     .highest = law_.highest_pressure() / by_force};
  sticking_forces(blocks, stations_.data(), blocks_, row.begin, row.end, row.offset, H, y, law);
  const int end = row.offset + row.end - row.begin;
  const double* over = column(kOver);
  for (int at = row.offset; at < end; ++at)
    if (over[at] > 0.0) slide(at);
}

/// (13): the tip gives way along the force until friction holds it.
void TreadContact::slide(int at) {
  const Vector3d trial(column(kFx)[at], column(kFy)[at], column(kFz)[at]);
  const double T = trial.norm(), Fn = column(kFn)[at];
  const double p = Fn / (positive_ * area_), factor = column(kMu)[at];
  const double slope = tangential_ * (rule_.step + damping_time_);
  const double v = law_.sliding_speed(T, slope, Fn, p, factor);
  const double F = T - slope * v, slip = v * rule_.step;
  const double gripped = F / T;
  column(kGripped)[at] = gripped;
  column(kFx)[at] *= gripped;
  column(kFy)[at] *= gripped;
  column(kFz)[at] *= gripped;
  const Vector3d back = slip / T * trial;
  column(kEx)[at] -= back.x();
  column(kEy)[at] -= back.y();
  column(kEz)[at] -= back.z();
}

void TreadContact::add_force(const NodeValues& q, const NodeValues& v, NodeValues& force) {
  for (std::size_t i = 0; i < rows_.size();) {
    const int segment = rows_[i].segment;
    std::size_t last = i;
    int begin = blocks_, end = 0;
    for (; last < rows_.size() && rows_[last].segment == segment; ++last) {
      begin = std::min(begin, rows_[last].begin);
      end = std::max(end, rows_[last].end);
    }
    set_stations(q, v, segment, begin, end);
    for (int c = kSum; c < kStationColumns; ++c)
      std::fill(at_stations(c) + begin, at_stations(c) + end, 0.0);
    for (; i < last; ++i) row_forces(rows_[i]);
    add_station_forces(segment, begin, end, force);
  }
}

/// Forces of the lines at one station to its four nodes, by (10).
void TreadContact::add_station_forces(int segment, int begin, int end, NodeValues& force) {
  for (int j = begin; j < end; ++j) {
    const auto sum = [&](int c) {
      return Vector3d(at_stations(c)[j], at_stations(c + 1)[j], at_stations(c + 2)[j]);
    };
    const Vector3d F = sum(kSum), FH = sum(kSumH), Fy = sum(kSumY);
    const Vector3d t = frame_vector(segment, kT, j), n = frame_vector(segment, kN, j);
    const Vector3d turning = -(FH.dot(t) * n + Fy.dot(t) * a_) / frame(segment, kLength)[j];
    const double torsion = FH.dot(a_) - Fy.dot(n);
    for (int m = 0; m < 4; ++m) {
      const double w = weight(m)[j];
      force.col(node(segment, m)).head<3>() += w * F + slope_weight(m)[j] * turning;
      force(3, node(segment, m)) += w * torsion;
    }
  }
}

void TreadContact::commit() {
  for (const Row& row : touched_rows_)
    for (int j = row.begin; j < row.end; ++j) touches_[place(row.segment, row.line, j)] = 0;
  touched_rows_ = rows_;
  for (const Row& row : rows_)
    for (int j = row.begin; j < row.end; ++j) {
      const int at = row.offset + j - row.begin;
      const std::size_t own = place(row.segment, row.line, j);
      touches_[own] = column(kFn)[at] > 0.0;
      tip_x_[own] = column(kNewX)[at] + column(kEx)[at];
      tip_y_[own] = column(kNewY)[at] + column(kEy)[at];
      tip_z_[own] = column(kNewZ)[at] + column(kEz)[at];
    }
}

}  // namespace latsch::ring_tire
