// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/tread/tread_contact.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "models/ring_tire/belt/belt_curve.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Vector3d;

// Margins, m: blocks up to this height above the road take part in a step. It exceeds the
// difference between the predicted and the actual end of a step. A larger margin costs time.
constexpr double kMargin = 5e-4, kStandingMargin = 4e-3;
// Margin of bent sections, which have no inertia, and their largest distance from the belt, m.
constexpr double kBentMargin = 2e-3, kBent = 5e-3;
constexpr double kSteepest = 0.35;  // slope of the tread relative to the road at touch
constexpr double kFar = 1e6;        // m, beyond the range of any road
constexpr int kWide = 8;            // stations processed at once

}  // namespace

RingTreadContact::RingTreadContact(const Tread& tread,
                                   double radius,
                                   int nodes,
                                   const std::vector<Harmonic>& radial_runout)
    : nodes_(nodes),
      lines_(tread.lines),
      blocks_(tread.blocks),
      stride_((tread.blocks + kWide - 1) / kWide * kWide),
      half_cell_rise_(kSteepest * std::numbers::pi * radius / (nodes * tread.blocks)),
      height_(tread.height),
      half_width_(0.5 * tread.width),
      damping_time_(tread.damping_time),
      positive_(tread.positive),
      bottom_(tread.bottoming * tread.height),
      law_(tread.friction),
      row_((tread.blocks + kWide - 1) / kWide * kWide) {
  const int all = nodes * lines_ * blocks_;
  area_ = 2.0 * std::numbers::pi * radius * tread.width / all;
  normal_ = tread.positive * tread.young_modulus * area_ / tread.height;
  tangential_ = tread.shear_ratio * normal_;
  for (int line = 0; line < lines_; ++line) {
    const double y = tread.width * ((line + 0.5) / lines_ - 0.5);
    line_y_.push_back(y);
    const double drop = tread.crown_radius > 0.0 ? 0.5 * y * y / tread.crown_radius : 0.0;
    line_height_.push_back(tread.height - drop);
  }
  weights_.resize(static_cast<std::size_t>(8 * stride_));
  halves_.resize(static_cast<std::size_t>(4 * stride_));
  lift_.resize(static_cast<std::size_t>(stride_));
  share_.resize(static_cast<std::size_t>(stride_));
  for (int j = 0; j < stride_; ++j) {
    const double s = (std::min(j, blocks_ - 1) + 0.5) / blocks_;
    const CurveWeights at = curve_weights(s), begin = curve_weights(s - 0.5 / blocks_),
                       end = curve_weights(s + 0.5 / blocks_);
    for (std::size_t m = 0; m < 4; ++m) {
      const std::size_t stride = static_cast<std::size_t>(stride_), i = static_cast<std::size_t>(j);
      weights_[m * stride + i] = at.place[m];
      weights_[(4 + m) * stride + i] = at.slope[m];
      halves_[m * stride + i] = 0.5 * (end.place[m] - begin.place[m]);
      for (std::size_t o = m; o < 4; ++o)
        for (const double weight : {at.place[m] * at.place[o],
                                    at.place[m] * at.slope[o],
                                    at.slope[m] * at.place[o],
                                    at.slope[m] * at.slope[o]})
          pair_weights_.push_back(weight);
    }
    lift_[static_cast<std::size_t>(j)] = j < blocks_ ? 0.0 : kFar;
    share_[static_cast<std::size_t>(j)] = s;
  }
  none_.resize(static_cast<std::size_t>(lines_ * stride_), 0.0);
  stations_.resize(static_cast<std::size_t>(kStationColumns) * stride_);
  start_frames_.resize(static_cast<std::size_t>(kFrameColumns) * stride_);
  station_stiffness_.resize(static_cast<std::size_t>(stride_));
  if (radial_runout.empty()) return;
  for (int k = 0; k < nodes; ++k)
    runout_.push_back(runout_at(radial_runout, 2.0 * std::numbers::pi * k / nodes));
  for (const Harmonic& harmonic : radial_runout) highest_runout_ += harmonic.amplitude;
  for (int segment = 0; segment < nodes; ++segment)
    for (int line = 0; line < lines_; ++line)
      for (const int k : {segment, (segment + 1) % nodes})
        section_rise_.push_back(runout_[static_cast<std::size_t>(k)]);
}

void RingTreadContact::reset() {
  tips_.reset();
  patches_.clear();
}

/// Returns the rectangle below nodes between two corners, with room for a tread that leans.
road::GroundBox RingTreadContact::below(const Vector3d& low, const Vector3d& high) const {
  const double side = height_ + half_width_;
  return {low.x() - side, high.x() + side, low.y() - side, high.y() + side};
}

/// True if a tip of the segment may be as low as the highest point of the road below it, which is
/// nowhere above `highest`.
bool RingTreadContact::near_road(const NodeValues& q,
                                 const RimFrame& rim,
                                 const road::Road& road,
                                 double time,
                                 double highest,
                                 int segment) const {
  double lowest = q(2, node(segment, 0));
  for (int m = 1; m < 4; ++m) lowest = std::min(lowest, q(2, node(segment, m)));
  if (lowest > rim.center.z()) return false;
  // Distance of tips from the belt: height and half the width, with a lean slightly larger than the
  // rim's.
  constexpr double kLean = 0.2;
  const double reach = 1.1 * height_ + half_width_ * (rim.a.cwiseAbs().z() + kLean * 0.25) +
                       (bends_ ? kBent : 0.0) + highest_runout_;
  lowest -= reach + margin_;
  if (lowest > highest) return false;
  Vector3d low = q.col(node(segment, 0)).head<3>(), high = low;
  for (int m = 1; m < 4; ++m) {
    low = low.cwiseMin(q.col(node(segment, m)).head<3>());
    high = high.cwiseMax(q.col(node(segment, m)).head<3>());
  }
  return lowest <= road.bounds(below(low, high), time).highest;
}

SegmentStations RingTreadContact::stations_of(std::size_t patch,
                                              const NodeValues& q,
                                              const NodeValues& v) const {
  const Patch& of = patches_[patch];
  SegmentStations at;
  at.stride = stride_;
  at.begin = of.begin;
  at.end = of.end;
  for (int m = 0; m < 4; ++m) {
    at.nodes[m] = q.col(node(of.segment, m)).data();
    at.rates[m] = v.col(node(of.segment, m)).data();
  }
  at.weights = weights_.data();
  at.halves = halves_.data();
  at.lift = lift_.data();
  at.t = frame(patch, kT);
  at.n = frame(patch, kN);
  at.length = frame(patch, kLength);
  at.a = a_.data();
  return at;
}

void RingTreadContact::add_patch(const NodeValues& q, int segment) {
  const std::size_t patch = patches_.size();
  patches_.push_back({.segment = segment,
                      .begin = 0,
                      .end = stride_,
                      .level = false,
                      .drum = false,
                      .ground = {}});
  const std::size_t columns = patches_.size() * kColumns * lines_ * stride_;
  if (memory_.size() < columns) memory_.resize(columns);
  const std::size_t frames = patches_.size() * kFrameColumns * stride_;
  if (frames_.size() < frames) frames_.resize(frames);
  const SegmentStations at = stations_of(patch, q, q);
  station_frames(at.nodes, at.weights, at.a, stride_, frame(patch, kT));
  station_columns(at, at_stations(kP));
}

void RingTreadContact::approach(const NodeValues& q,
                                const RimFrame& rim,
                                const road::Road& road,
                                double time,
                                const StepRule& rule,
                                const BeltStart& start) {
  rule_ = rule;
  margin_ = rule.statics() ? kStandingMargin : bends_ ? kBentMargin : kMargin;
  margin_ += half_cell_rise_;
  a_ = rim.a;
  patches_.clear();
  knows_road_ = true;
  const auto places = q.topRows<3>();
  const road::GroundBox tire = below(places.rowwise().minCoeff(), places.rowwise().maxCoeff());
  const double highest = road.bounds(tire, time).highest;
  for (int segment = 0; segment < nodes_; ++segment) {
    if (!near_road(q, rim, road, time, highest, segment)) continue;
    add_patch(q, segment);
    Patch& patch = patches_.back();
    const Ground ground = ground_below(0, lines_ - 1, road, time);
    const Plane* plane = std::get_if<Plane>(&ground);
    if (!rule.statics() && plane && plane->ground.normal == Vector3d::UnitZ())
      find_level_blocks(patch, plane->ground);
    else if (const road::Cylinder* drum = std::get_if<road::Cylinder>(&ground))
      find_blocks_on_drum(patch, *drum);
    else
      find_uneven_blocks(patch, ground, road, time);
    if (patch.begin == patch.end) {
      patches_.pop_back();
      continue;
    }
    place_entering(start);
  }
}

void RingTreadContact::place_entering(const BeltStart& start) {
  const std::size_t patch = patches_.size() - 1, stride = static_cast<std::size_t>(stride_);
  const Patch& of = patches_.back();
  entering_.resize(patches_.size() * stride / kWide);
  start_.resize(patches_.size() * kStartColumns * stride);
  std::uint8_t* const enter = entering(patch);
  find_entering({stride_, of.begin, of.end}, lines_, before(of.segment, TreadTips::kShare), enter);
  if (rule_.statics() ||
      !std::any_of(enter + of.begin / kWide, enter + of.end / kWide, std::identity()))
    return;
  double *const to = &start_[patch * kStartColumns * stride], *const frames = start_frames_.data();
  SegmentStations at = stations_of(patch, *start.q, *start.v);
  station_frames(at.nodes, at.weights, at.a, stride_, frames);
  at.t = frames + kT * stride;
  at.n = frames + kN * stride;
  at.length = frames + kLength * stride;
  station_columns(at, to);
  station_rates(at, to + 9 * stride);
}

/// Returns the rectangle of the ground below the tips of some lines. The lines are nearly straight
/// over a segment: their sagitta is well below a tenth of the length.
road::GroundBox RingTreadContact::below(int first_line, int last_line) const {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const int line : {first_line, last_line})
    for (const int j : {0, blocks_ - 1}) {
      low = low.cwiseMin(tip(line, j));
      high = high.cwiseMax(tip(line, j));
    }
  const double room = 0.1 * (high.x() - low.x());
  return {low.x() - room, high.x() + room, low.y() - room, high.y() + room};
}

/// Returns what the road reports about the area below some lines.
RingTreadContact::Ground RingTreadContact::ground_below(int first_line,
                                                        int last_line,
                                                        const road::Road& road,
                                                        double time) const {
  const road::GroundBox box = below(first_line, last_line);
  const road::GroundBounds bounds = road.bounds(box, time);
  if (bounds.cylinder) return *bounds.cylinder;
  if (!bounds.plane) return Uneven{bounds.highest, bounds.lines_differ};
  const double x = 0.5 * (box.x0 + box.x1), y = 0.5 * (box.y0 + box.y1);
  const road::GroundPoint ground = road.at(x, y, time);
  return Plane{ground, ground.normal.dot(Vector3d(x, y, ground.height))};
}

void RingTreadContact::narrow(Patch& patch, const double* nearest, double reach) const {
  patch.end = blocks_;
  while (patch.begin < patch.end && nearest[patch.begin] > reach) ++patch.begin;
  while (patch.end > patch.begin && nearest[patch.end - 1] > reach) --patch.end;
  widen(patch);
}

/// Widens the span to multiples of the stations processed at once; an empty span becomes 0.
void RingTreadContact::widen(Patch& patch) const {
  if (patch.begin >= patch.end) patch.begin = patch.end = 0;
  patch.begin = patch.begin / kWide * kWide;
  patch.end = (patch.end + kWide - 1) / kWide * kWide;
}

/// Finds the blocks near the road: [begin, end).
void RingTreadContact::find_level_blocks(Patch& patch, const road::GroundPoint& ground) {
  patch.level = true;
  knows_road_ = knows_road_ && std::isfinite(ground.height);
  patch.ground = {.height = ground.height,
                  .velocity = {ground.velocity.x(), ground.velocity.y(), ground.velocity.z()},
                  .friction = ground.friction};
  narrow(patch, find_lowest_tips(), patch.ground.height + margin_);
}

/// Returns z of the lowest of the lines' tips at each station of the last patch.
const double* RingTreadContact::find_lowest_tips() {
  double* lowest = at_stations(kStationColumns - 1);
  if (section_rise_.empty()) {
    lowest_tips(at_stations(kP), lines(), stride_, lowest);
    return lowest;
  }
  for (int j = 0; j < blocks_; ++j) {
    lowest[j] = tip(0, j).z();
    for (int line = 1; line < lines_; ++line) lowest[j] = std::min(lowest[j], tip(line, j).z());
  }
  return lowest;
}

/// Computes the plane of a block's cell on a drum: the tangent, at the mean height over the cell.
void RingTreadContact::find_blocks_on_drum(Patch& patch, const road::Cylinder& drum) {
  patch.drum = true;
  const BlockLines own = lines(patch.segment);
  double* gap = at_stations(kStationColumns - 1);
  gaps_to_drum(at_stations(kP), own, stride_, drum, gap);
  narrow(patch, gap, margin_);
  drum_planes({stride_, patch.begin, patch.end},
              at_stations(kP),
              lift_.data(),
              own,
              blocks_,
              drum,
              ground(patches_.size() - 1));
}

void RingTreadContact::find_uneven_blocks(Patch& patch,
                                          const Ground& ground,
                                          const road::Road& road,
                                          double time) {
  const std::size_t at = patches_.size() - 1;
  const Uneven* uneven = std::get_if<Uneven>(&ground);
  const bool known = !uneven || !uneven->lines_differ;
  if (uneven) {
    narrow(patch, find_lowest_tips(), uneven->highest + margin_);
    if (patch.begin == patch.end) return;
  }
  patch.begin = stride_;
  patch.end = 0;
  for (int line = 0; line < lines_; ++line) {
    const Ground own = known ? ground : ground_below(line, line, road, time);
    for (int c = kNormal; c <= kFriction; ++c)
      std::fill_n(column(at, c) + line * stride_, stride_, c == kLevel ? -kNoRoad : 0.0);
    const auto [begin, end] = find_line(at, line, own, road, time);
    if (begin == end) continue;
    patch.begin = std::min(patch.begin, begin);
    patch.end = std::max(patch.end, end);
  }
  widen(patch);
}

/// Finds the blocks of one line near the road and the planes below them.
std::pair<int, int> RingTreadContact::find_line(
    std::size_t patch, int line, const Ground& ground, const road::Road& road, double time) {
  const Plane* plane = std::get_if<Plane>(&ground);
  if (!plane) {
    const Uneven* uneven = std::get_if<Uneven>(&ground);
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    return place_cells(patch, line, uneven ? uneven->highest : kUnknown, road, time);
  }
  int begin = 0, end = blocks_;
  const auto above = [&](int j) {
    return plane->ground.normal.dot(tip(line, j)) > plane->level + margin_;
  };
  while (begin < end && above(begin)) ++begin;
  while (end > begin && above(end - 1)) --end;
  for (int j = begin; j < end; ++j)
    place_ground(patch, line * stride_ + j, plane->ground, plane->level);
  return {begin, end};
}

/// Computes the plane of each cell of a line near an uneven road: mean height, slope along the cell
/// from end to end, slope across and everything else from the middle. So edges shorter than a cell
/// take effect gradually. No point of the road is above `highest`.
std::pair<int, int> RingTreadContact::place_cells(
    std::size_t patch, int line, double highest, const road::Road& road, double time) {
  row_.place_tips(at_stations(kP), lines(patches_[patch].segment), line);
  const double *x = row_.x(), *y = row_.y(), *z = row_.z();
  int begin = 0, end = blocks_;
  const auto narrow = [&](const auto& height) {
    while (begin < end && z[begin] > height(begin) + margin_) ++begin;
    while (end > begin && z[end - 1] > height(end - 1) + margin_) --end;
  };
  narrow([&](int) { return highest; });
  narrow([&](int j) { return road.height(x[j], y[j], time); });
  if (begin == end) return {begin, end};
  row_.place_borders(begin, end, blocks_);
  BlockGround to = ground(patch);
  const int first = line * stride_;
  for (double** column : {&to.N[0],
                          &to.N[1],
                          &to.N[2],
                          &to.level,
                          &to.velocity[0],
                          &to.velocity[1],
                          &to.velocity[2],
                          &to.friction})
    *column += first;
  const double *border_x = row_.border_x(), *border_y = row_.border_y();
  road.below(
      {end - begin, x + begin, y + begin, border_x + begin, border_y + begin},
      time,
      {.border_height = row_.border_height() + begin,
       .height = row_.height() + begin,
       .mean = to.level + begin,
       .slope = {to.N[0] + begin, to.N[1] + begin},
       .friction = to.friction + begin,
       .velocity = {to.velocity[0] + begin, to.velocity[1] + begin, to.velocity[2] + begin}});
  if (!cell_planes({begin, end, x, y, border_x, border_y, row_.border_height()}, to))
    knows_road_ = false;
  return {begin, end};
}

/// Stores the plane of the road below a block.
void RingTreadContact::place_ground(std::size_t patch,
                                    int block,
                                    const road::GroundPoint& ground,
                                    double level) {
  knows_road_ = knows_road_ && std::isfinite(level);
  const BlockGround to = this->ground(patch);
  for (int i = 0; i < 3; ++i) {
    to.N[i][block] = ground.normal[i];
    to.velocity[i][block] = ground.velocity[i];
  }
  to.level[block] = level;
  to.friction[block] = ground.friction;
}

BlockResults RingTreadContact::results(std::size_t patch) {
  const auto at = [&](int c) { return column(patch, c); };
  return {.F = {at(kF), at(kF + 1), at(kF + 2)},
          .Fn = at(kFn),
          .gripped = at(kGripped),
          .share = at(kShare),
          .slope = bottom_ > 0.0 ? at(kSlope) : nullptr,
          .tip = {at(kTip), at(kTip + 1), at(kTip + 2)}};
}

BlockGround RingTreadContact::ground(std::size_t patch) {
  const auto at = [&](int c) { return column(patch, c); };
  return {.N = {at(kNormal), at(kNormal + 1), at(kNormal + 2)},
          .level = at(kLevel),
          .velocity = {at(kVelocity), at(kVelocity + 1), at(kVelocity + 2)},
          .friction = at(kFriction),
          .held = at(kHeld)};
}

BlockLaw RingTreadContact::block_law() const {
  return {.normal = normal_,
          .tangential = tangential_,
          .damping_time = damping_time_,
          .step = rule_.step,
          .by_force = 1.0 / (positive_ * area_),
          .bottom = bottom_,
          .friction = &law_};
}

void RingTreadContact::hold_friction() {
  for (std::size_t i = 0; i < patches_.size(); ++i)
    ring_tire::hold_friction({stride_, patches_[i].begin, patches_[i].end},
                             lines_,
                             ground(i),
                             block_law(),
                             column(i, kFn));
}

BlockStep RingTreadContact::step_of(std::size_t patch, const NodeValues& q, const NodeValues& v) {
  const int segment = patches_[patch].segment;
  const auto was = [&](TreadTips::Column c) { return before(segment, c); };
  return {.at = stations_of(patch, q, v),
          .lines = lines(segment),
          .before = {.tip = {was(TreadTips::kX), was(TreadTips::kY), was(TreadTips::kZ)},
                     .touches = was(TreadTips::kShare),
                     .entering = entering(patch),
                     .start = &start_[patch * kStartColumns * static_cast<std::size_t>(stride_)]},
          .law = block_law(),
          .results = results(patch),
          .force = {},
          .moment = nullptr};
}

void RingTreadContact::add_patch_force(std::size_t patch, const BlockStep& step) {
  if (rule_.statics())
    standing_forces(step, ground(patch));
  else if (patches_[patch].level)
    level_forces(step, patches_[patch].ground);
  else if (patches_[patch].drum)
    drum_forces(step, ground(patch));
  else
    uneven_forces(step, ground(patch));
}

void RingTreadContact::add_force(const NodeValues& q, const NodeValues& v, NodeValues& force) {
  moment_on_rim_.setZero();
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    BlockStep step = step_of(i, q, v);
    for (int m = 0; m < 4; ++m) step.force[m] = force.col(node(patches_[i].segment, m)).data();
    step.moment = moment_on_rim_.data();
    add_patch_force(i, step);
  }
}

const double* RingTreadContact::before(int segment, TreadTips::Column column) const {
  if (!tips_) return none_.data();
  const auto& segments = tips_->segments;
  const auto at = std::lower_bound(segments.begin(), segments.end(), segment);
  if (at == segments.end() || *at != segment) return none_.data();
  return tips_->column(static_cast<std::size_t>(at - segments.begin()), column);
}

void RingTreadContact::commit() {
  // A memory that nobody else holds is overwritten, after its last holder has finished reading it.
  if (!spare_ || spare_.use_count() > 1) spare_ = std::make_shared<TreadTips>();
  std::atomic_thread_fence(std::memory_order_acquire);
  TreadTips& tips = *spare_;
  tips.blocks = lines_ * stride_;
  tips.segments.clear();
  tips.columns.assign(patches_.size() * TreadTips::kColumns * none_.size(), 0.0);
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const Patch& patch = patches_[i];
    tips.segments.push_back(patch.segment);
    double* const tip[3] = {tips.column(i, TreadTips::kX),
                            tips.column(i, TreadTips::kY),
                            tips.column(i, TreadTips::kZ)};
    keep_tips({stride_, patch.begin, patch.end},
              lines_,
              results(i),
              patch.level ? &patch.ground.height : nullptr,
              tip,
              tips.column(i, TreadTips::kShare));
  }
  std::shared_ptr<TreadTips> before = std::const_pointer_cast<TreadTips>(tips_);
  tips_ = std::move(spare_);
  spare_ = std::move(before);
}

void RingTreadContact::remember(const TreadMemory& memory) {
  patches_.clear();
  tips_ = memory.tips();
}

}  // namespace latsch::ring_tire
