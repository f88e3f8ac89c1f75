// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/suspension_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "measurement/meaning/projection.h"

namespace latsch {
namespace {

using Values = std::vector<double>;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::array<std::string_view, 6> kWheelLoads = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
/// The end of a channel's name that names a wheel, and the sign of y on that wheel's side; 0 if the
/// side is not known.
struct WheelEnd {
  std::string_view end;
  int side;
};
constexpr std::array<WheelEnd, 9> kWheelEnds = {{{"", 0},
                                                 {"_left", 1},
                                                 {"_right", -1},
                                                 {"_L", 1},
                                                 {"_R", -1},
                                                 {"_FL", 1},
                                                 {"_FR", -1},
                                                 {"_RL", 1},
                                                 {"_RR", -1}}};

/// Returns the partial correlation of a motion with a load while the other loads are held constant;
/// 0 if the load does not vary independently of them.
double partial_correlation(Values motion, Values load, std::vector<Values> others) {
  // least share of the load's variation that other loads do not explain
  constexpr double kOwnShare = 1e-4;
  others.insert(others.begin(), Values(motion.size(), 1.0));
  const double whole = dot(load, load);
  for (std::size_t i = 0; i < others.size(); ++i) {
    const double before = dot(others[i], others[i]);
    for (std::size_t j = 0; j < i; ++j)
      if (dot(others[j], others[j]) > 0.0) project_out(others[j], others[i]);
    if (dot(others[i], others[i]) <= kOwnShare * before) {
      std::fill(others[i].begin(), others[i].end(), 0.0);
      continue;
    }
    project_out(others[i], motion);
    project_out(others[i], load);
  }
  const double own = dot(load, load), left = dot(motion, motion);
  if (!(own > kOwnShare * whole) || !(left > 0.0)) return 0.0;
  return dot(motion, load) / std::sqrt(own * left);
}

/// The slope of a motion over a load, if its sign is clear.
struct ClearSlope {
  std::string motion, load;  // names in the table
  double correlation = 0.0;  // +1 or -1 for a slope that is itself a column of the table
  bool rises() const { return correlation > 0.0; }
  /// Returns the words that come after the name of the motion in a message.
  std::string words() const {
    return fmt::format(
        "{} as {} rises (correlation {:+.2f})", rises() ? "rises" : "falls", load, correlation);
  }
};

class WheelTable {
 public:
  WheelTable(const Channels& channels, WheelEnd wheel)
      : channels_(channels), end_(wheel.end), side_(wheel.side) {}

  void check(std::vector<ChannelDoubt>& doubts) const {
    check_caster(doubts);
    const bool moves = find("dx", "m") || find("dy", "m") || find("dz", "m");
    if (const auto slope = slope_of("steer", "Mz"); moves && slope && !slope->rises())
      doubts.push_back({slope->motion,
                        slope->words() +
                            ", but a moment about z turns the wheel to the left, which is positive "
                            "steer in iso axes: is the sign of steer or of Mz another one, or is "
                            "steer a toe angle (front inboard positive)?"});
    check_side(doubts);
    check_travel(doubts);
  }

  int side() const {
    int side = 0;
    for (const Evidence& one : evidence_of_side()) {
      if (side != 0 && one.side != side) return 0;
      side = one.side;
    }
    return side;
  }

 private:
  const Channel* find(std::string_view name, std::string_view unit) const {
    const Channel* found = channels_.find(std::string(name) + end_);
    return found && found->unit == unit ? found : nullptr;
  }

  /// Returns the slope of a motion over a load, from the samples in which all loads and the motion
  /// are numbers, if its sign is clear.
  std::optional<ClearSlope> slope_of(const char* motion, const char* load) const {
    constexpr double kClearly = 0.6;  // least partial correlation
    const std::string stated = std::string(motion) + "_by_" + load;
    if (const Channel* slope = channels_.find(stated + end_)) return sign_of_stated(*slope, load);
    const Channel* y = find(motion, "rad");
    const Channel* x = find(load, *load == 'F' ? "N" : "N m");
    if (!y || !x) return std::nullopt;
    std::vector<const Channel*> others;
    for (const std::string_view name : kWheelLoads)
      if (const Channel* other = find(name, name[0] == 'F' ? "N" : "N m"); other && other != x)
        others.push_back(other);
    Values ys, xs;
    std::vector<Values> zs(others.size());
    const std::size_t count = std::min(y->values.size(), x->values.size());
    for (std::size_t i = 0; i < count; ++i) {
      double sum = y->values[i] + x->values[i];
      for (const Channel* other : others)
        sum += i < other->values.size() ? other->values[i] : std::nan("");
      if (!std::isfinite(sum)) continue;
      ys.push_back(y->values[i]);
      xs.push_back(x->values[i]);
      for (std::size_t k = 0; k < others.size(); ++k) zs[k].push_back(others[k]->values[i]);
    }
    if (ys.size() < others.size() + 4) return std::nullopt;
    const double r = partial_correlation(ys, xs, zs);
    if (!(std::abs(r) > kClearly)) return std::nullopt;
    return ClearSlope{y->name, x->name, r};
  }

  /// Returns the sign of a column that is itself a slope, such as toe_by_Mz, if nearly all of its
  /// values have that sign.
  static std::optional<ClearSlope> sign_of_stated(const Channel& slope, const char* load) {
    constexpr double kNearlyAllSlopes = 0.9;
    long positive = 0, negative = 0;
    for (const double value : slope.values) {
      positive += value > 0.0;
      negative += value < 0.0;
    }
    const double most = kNearlyAllSlopes * static_cast<double>(positive + negative);
    if (positive + negative == 0) return std::nullopt;
    if (static_cast<double>(positive) >= most) return ClearSlope{slope.name, load, 1.0};
    if (static_cast<double>(negative) >= most) return ClearSlope{slope.name, load, -1.0};
    return std::nullopt;
  }

  void check_caster(std::vector<ChannelDoubt>& doubts) const {
    if (const auto slope = slope_of("caster", "Fx"); slope && !slope->rises())
      doubts.push_back(
          {slope->motion,
           slope->words() +
               ", but a force forward at the contact patch turns the top of the kingpin rearward, "
               "which is positive caster: is caster positive with the top forward, or Fx positive "
               "rearward, as in axes of Adams (x rearward, y to the right, z up), which are axes = "
               "\"adams\"? A force at the wheel center may also do this"});
    if (const auto slope = slope_of("caster", "My"); slope && slope->rises())
      doubts.push_back({slope->motion,
                        slope->words() +
                            ", but a moment about y turns the top of the kingpin forward, which "
                            "lowers the caster: is the sign of caster or of My another one?"});
    // smaller caster angles may be changes relative to the rest position
    constexpr double kLeastCaster = 1.0 * kDegree;
    const Channel* caster = find("caster", "rad");
    if (caster && !caster->values.empty() &&
        std::all_of(caster->values.begin(), caster->values.end(), [](double value) {
          return value < -kLeastCaster;
        }))
      doubts.push_back({caster->name,
                        "is below -1 deg in all samples, but nearly all suspensions have the top "
                        "of the kingpin rearward, which is positive: is its sign another one?"});
  }

  struct Evidence {
    ClearSlope slope;
    int side;  // side of the car whose sign the slope has
  };

  /// Returns the sides of the car that the slopes of toe and camber indicate.
  std::vector<Evidence> evidence_of_side() const {
    std::vector<Evidence> evidence;
    for (const auto& [motion, load] : {std::pair{"toe", "Mz"}, {"camber", "Mx"}, {"camber", "Fy"}})
      if (auto slope = slope_of(motion, load)) {
        const int side = slope->rises() ? -1 : 1;
        evidence.push_back({std::move(*slope), side});
      }
    return evidence;
  }

  void check_side(std::vector<ChannelDoubt>& doubts) const {
    const std::vector<Evidence> evidence = evidence_of_side();
    constexpr const char* kSigns =
        "toe is positive with the front inboard, camber with the top outboard, Mz turns to the "
        "left and Fy points to the left in iso axes";
    const auto words = [](int side) { return side > 0 ? "left" : "right"; };
    if (side_ != 0) {
      for (const Evidence& one : evidence)
        if (one.side != side_)
          doubts.push_back(
              {one.slope.motion,
               fmt::format("{}, as on a {} wheel, but the channel is of the {} one ({}): is the "
                           "sign of one of the two another one, or axes not as stated?",
                           one.slope.words(),
                           words(one.side),
                           words(side_),
                           kSigns)});
      return;
    }
    for (std::size_t i = 1; i < evidence.size(); ++i)
      if (evidence[i].side != evidence[0].side) {
        doubts.push_back(
            {evidence[i].slope.motion,
             fmt::format("{}, as on a {} wheel, while {} {}, as on a {} wheel ({}): is the sign of "
                         "one of the four another one, or axes not as stated (Adams has x rearward "
                         "and y to the right)?",
                         evidence[i].slope.words(),
                         words(evidence[i].side),
                         evidence[0].slope.motion,
                         evidence[0].slope.words(),
                         words(evidence[0].side),
                         kSigns)});
        return;
      }
  }

  /// Adds a doubt if the top of the wheel leans outboard as the wheel moves up; on most suspensions
  /// it leans inboard.
  void check_travel(std::vector<ChannelDoubt>& doubts) const {
    constexpr double kLeastTravel = 0.01;          // m, from the lowest to the highest
    constexpr double kLeastGain = 10.0 * kDegree;  // per m: 0.1 degrees in 10 mm
    constexpr double kClearly = 0.9;               // least correlation
    const Channel* camber = find("camber", "rad");
    const Channel* travel = find("travel", "m");
    if (!travel) travel = find("dz", "m");
    if (!camber || !travel) return;
    Values x, y;
    for (std::size_t i = 0; i < std::min(camber->values.size(), travel->values.size()); ++i) {
      if (!std::isfinite(camber->values[i] + travel->values[i])) continue;
      x.push_back(travel->values[i]);
      y.push_back(camber->values[i]);
    }
    if (x.size() < 3) return;
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    if (!(*high - *low > kLeastTravel)) return;
    const Values one(x.size(), 1.0);
    project_out(one, x);
    project_out(one, y);
    const double gain = dot(x, y) / dot(x, x);
    if (!(gain > kLeastGain) || !(dot(x, y) > kClearly * std::sqrt(dot(x, x) * dot(y, y)))) return;
    doubts.push_back(
        {camber->name,
         fmt::format("rises with {} by {:.2g} deg in 10 mm: the top leans outboard as the wheel "
                     "moves up, which few suspensions do; is camber positive with the top "
                     "inboard, or {} positive in rebound?",
                     travel->name,
                     gain * 0.01 / kDegree,
                     travel->name)});
  }

  const Channels& channels_;
  std::string end_;
  int side_;
};

}  // namespace

const std::vector<std::string>& wheel_ends() {
  static const std::vector<std::string> kEnds = [] {
    std::vector<std::string> ends;
    for (const WheelEnd& wheel : kWheelEnds)
      if (!wheel.end.empty()) ends.emplace_back(wheel.end);
    return ends;
  }();
  return kEnds;
}

bool wheel_rolls(const Channels& channels) {
  for (const char* rolling : {"Vx", "omega", "alpha", "kappa"})
    if (channels.find(rolling)) return true;
  return false;
}

std::vector<ChannelDoubt> suspension_doubts(const Channels& channels) {
  std::vector<ChannelDoubt> doubts;
  if (wheel_rolls(channels)) return doubts;
  for (const WheelEnd& wheel : kWheelEnds) WheelTable(channels, wheel).check(doubts);
  for (ChannelDoubt& doubt : doubts) doubt.is_of_sign = true;
  return doubts;
}

int side_of_wheel(const Channels& channels) {
  return wheel_rolls(channels) ? 0 : WheelTable(channels, kWheelEnds[0]).side();
}

}  // namespace latsch
