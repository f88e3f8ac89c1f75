// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/channel_checks.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "base/text.h"
#include "base/units.h"
#include "measurement/meaning/channel_words.h"
#include "measurement/meaning/suspension_checks.h"

namespace latsch {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNearlyAll = 0.9;  // share of the samples

/// Usual range of a channel, in `unit`: values from `from` to `to` are usual, values below `least`
/// or above `most` impossible.
struct UsualRange {
  std::string_view channel, unit;
  double least, from, to, most;
  std::string_view hint;
};

constexpr std::string_view kRadians = "is it in deg, and the file says rad, or says nothing?";
constexpr std::string_view kLengths = "is it in m, cm, mm or in?";
constexpr std::array kRanges = {
    UsualRange{"alpha", "deg", -90, -90, 90, 90, kRadians},
    UsualRange{"gamma", "deg", -90, -65, 65, 90, kRadians},
    UsualRange{"toe", "deg", -90, -90, 90, 90, kRadians},
    UsualRange{"camber", "deg", -90, -65, 65, 90, kRadians},
    UsualRange{"caster", "deg", -90, -90, 90, 90, kRadians},
    UsualRange{"Vx", "km/h", -1500, 0, 250, 1500, "is it in another unit?"},
    UsualRange{"omega", "rad/s", -1e4, -1e3, 1e3, 1e4, "is it in another unit?"},
    UsualRange{"p", "kPa", 2, 20, 1200, 4000, "is it in kPa, bar, psi or Pa?"},
    UsualRange{"tread", "degC", -100, 0, 300, 1000, "is it in K, degC or degF?"},
    UsualRange{"tread_inner", "degC", -100, 0, 300, 1000, "is it in K, degC or degF?"},
    UsualRange{"tread_center", "degC", -100, 0, 300, 1000, "is it in K, degC or degF?"},
    UsualRange{"tread_outer", "degC", -100, 0, 300, 1000, "is it in K, degC or degF?"},
    UsualRange{"road", "degC", -100, 0, 300, 1000, "is it in K, degC or degF?"},
    UsualRange{"ambient", "degC", -100, 0, 300, 1000, "is it in K, degC or degF?"},
    UsualRange{"loaded_radius", "m", 0.01, 0.05, 3, 10, "is it in m, cm, mm or in?"},
    UsualRange{"R_e", "m", 0.01, 0.05, 3, 10, "is it in m, cm, mm or in?"},
    UsualRange{"kappa", "1", -100, -1.05, 1.5, 100, "is it in percent? Its unit is then %"},
    UsualRange{"dx", "m", -10, -0.1, 0.1, 10, kLengths},
    UsualRange{"dy", "m", -10, -0.1, 0.1, 10, kLengths},
    UsualRange{"dz", "m", -10, -0.5, 0.5, 10, kLengths},
    UsualRange{"travel", "m", -10, -0.5, 0.5, 10, kLengths},
    UsualRange{"deflection", "m", -10, -0.5, 0.5, 10, kLengths},
    UsualRange{"rack", "m", -10, -0.3, 0.3, 10, kLengths},
    UsualRange{"mux", "1", -kInfinity, 0, 3, kInfinity, "is it a coefficient?"},
    UsualRange{"muy", "1", -kInfinity, 0, 3, kInfinity, "is it a coefficient?"},
    UsualRange{"friction", "1", -kInfinity, 0, 3, kInfinity, "is it a coefficient?"},
    UsualRange{"Fx", "N", -1e6, -2e5, 2e5, 1e6, "is it in N, kN or lbf?"},
    UsualRange{"Fy", "N", -1e6, -2e5, 2e5, 1e6, "is it in N, kN or lbf?"},
    UsualRange{"Fz", "N", -1e6, -1e6, 2e5, 1e6, "is it in N, kN or lbf?"},
    UsualRange{"load", "N", -1e6, 0, 2e5, 1e6, "a load on a tire is positive"},
    UsualRange{"Mx", "N m", -1e6, -1e5, 1e5, 1e6, "is it in N m, kN m or ft lbf?"},
    UsualRange{"My", "N m", -1e6, -1e5, 1e5, 1e6, "is it in N m, kN m or ft lbf?"},
    UsualRange{"Mz", "N m", -1e6, -1e5, 1e5, 1e6, "is it in N m, kN m or ft lbf?"},
};

/// Returns the name in the vocabulary, without frame and wheel; the name itself if the vocabulary
/// lacks it.
std::string base_name(const Channel& channel) {
  for (const UsualRange& range : kRanges)
    if (range.channel == channel.name) return channel.name;
  const auto found = recognized(channel.name);
  return found ? std::string(found->meaning->name) : channel.name;
}

struct Counted {
  std::size_t count = 0, first = 0;
};
Counted count_where(const std::vector<double>& values, const std::function<bool(double)>& odd) {
  Counted counted;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i]) || !odd(values[i])) continue;
    if (counted.count++ == 0) counted.first = i;
  }
  return counted;
}

std::size_t numbers_in(const std::vector<double>& values) {
  return count_where(values, [](double) { return true; }).count;
}

std::string reach_in_words(const Channel& channel, std::string_view unit) {
  double low = kInfinity, high = -kInfinity;
  for (const double value : channel.values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  const Unit shown = Unit::of(unit);
  return fmt::format("it goes from {} to {}{}",
                     format_number(shown.from_si(low) + 0.0, 4),  // no "-0"
                     format_number(shown.from_si(high) + 0.0, 4),
                     unit == "1" ? "" : " " + std::string(unit));
}

std::string of_samples(std::size_t count, std::size_t all) {
  if (count == all) return all == 1 ? "in the one sample" : fmt::format("in all {} samples", all);
  return fmt::format("in {} of {} samples", count, all);
}

std::string limits_in_words(const UsualRange& range) {
  const std::string unit = range.unit == "1" ? "" : " " + std::string(range.unit);
  return fmt::format("{} .. {}{}", format_number(range.from, 4), format_number(range.to, 4), unit);
}

std::optional<ChannelDoubt> out_of_range(const Channel& channel, const UsualRange& range) {
  const Unit unit = Unit::of(range.unit);
  if (!unit.same_dimension(Unit::of(channel.unit))) return std::nullopt;
  const double rounding = 1e-9;
  const auto outside = [&](double low, double high) {
    const double from = unit.to_si(low), to = unit.to_si(high);
    const double slack = rounding * std::max(std::abs(from), std::abs(to));
    return [=](double value) {
      return (std::isfinite(low) && value < from - slack) ||
             (std::isfinite(high) && value > to + slack);
    };
  };
  const std::size_t all = numbers_in(channel.values);
  if (all == 0) return std::nullopt;
  const Counted impossible = count_where(channel.values, outside(range.least, range.most));
  const Counted unusual = count_where(channel.values, outside(range.from, range.to));
  if (unusual.count == 0) return std::nullopt;
  const bool is_error =
      static_cast<double>(impossible.count) >= kNearlyAll * static_cast<double>(all);
  return ChannelDoubt{channel.name,
                      fmt::format("is outside of {} {}: {}; {}",
                                  limits_in_words(range),
                                  of_samples(unusual.count, all),
                                  reach_in_words(channel, range.unit),
                                  range.hint),
                      unusual.first,
                      is_error};
}

/// Checks that the loads are positive, as those of a wheel on the ground.
std::optional<ChannelDoubt> sign_of_load(const Channel& channel) {
  // share of the largest load; smaller loads are noise about 0 while the wheel has no contact
  constexpr double kHop = 0.02;
  constexpr double kLeast = 5.0;  // N; the load of every tire is larger
  const std::size_t all = numbers_in(channel.values);
  if (all == 0) return std::nullopt;
  // ratio of the mean load to the largest load below which a channel contains changes of a load,
  // not loads
  constexpr double kAboutZero = 0.05;
  double most = 0.0, sum = 0.0;
  for (const double value : channel.values)
    if (!std::isnan(value)) most = std::max(most, std::abs(value)), sum += value;
  const Counted below = count_where(channel.values, [](double value) { return value < 0.0; });
  const Counted odd =
      count_where(channel.values, [&](double value) { return value < -kHop * most; });
  const auto loaded = static_cast<double>(count_where(channel.values, [&](double value) {
                                            return std::abs(value) > kHop * most;
                                          }).count);
  // Rows without load, such as the first one of a K&C table, do not tell the sign.
  const bool all_loaded_below = static_cast<double>(odd.count) > kNearlyAll * loaded;
  const bool all_below = static_cast<double>(below.count) > kNearlyAll * static_cast<double>(all) ||
                         (all_loaded_below && 2.0 * loaded >= static_cast<double>(all));
  const bool is_change = std::abs(sum) < kAboutZero * most * static_cast<double>(all);
  if (all_below || (odd.count > 0 && !is_change)) {
    const Counted& counted = all_below ? below : odd;
    return ChannelDoubt{channel.name,
                        fmt::format("is below 0 {}: {}, where a load on a tire is positive",
                                    of_samples(counted.count, all),
                                    reach_in_words(channel, "N")),
                        counted.first,
                        all_below,
                        all_below,
                        all_below || all_loaded_below};
  }
  if (most < kLeast && most > 0.0)
    return ChannelDoubt{channel.name,
                        "is never above " + format_quantity(most, "N", 3) +
                            ", less than any tire carries; is it in N, kN or lbf?"};
  return std::nullopt;
}

/// Returns the only channel with this meaning; nullptr if there is none or if there are several
/// (wheels of a car).
const Channel* only(const Channels& channels, std::string_view meaning) {
  const Channel* found = nullptr;
  for (const Channel& channel : channels.all()) {
    if (base_name(channel) != meaning) continue;
    if (channel.name == meaning) return &channel;
    if (found) return nullptr;
    found = &channel;
  }
  return found;
}

/// Returns the correlation about zero, not about the means, because a force changes its sign
/// together with its slip.
double correlation(const Channel& a,
                   const Channel& b,
                   const std::function<bool(std::size_t)>& counts) {
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < std::min(a.values.size(), b.values.size()); ++i) {
    const double x = a.values[i], y = b.values[i];
    if (std::isnan(x * y) || !counts(i)) continue;
    aa += x * x, bb += y * y, ab += x * y;
  }
  return aa * bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

struct Pair {
  std::string_view a, b;
  double sign;       // expected sign of their product
  double most_of_a;  // SI; only samples with a smaller |a| count
  std::string_view law;
};

constexpr double kSmallSlip = 0.07;  // rad, 4 deg: beyond it the aligning moment changes its sign
constexpr std::array kPairs = {
    Pair{"alpha", "Fy", -1.0, kInfinity, "a side force acts against its slip angle"},
    Pair{"alpha", "Mz", 1.0, kSmallSlip, "the moment aligns the wheel"},
    Pair{"kappa", "Fx", 1.0, kInfinity, "a driven wheel pushes forward"},
    Pair{"dx", "Fx", 1.0, kInfinity, "a suspension moves along the force"},
    Pair{"dy", "Fy", 1.0, kInfinity, "a suspension moves along the force"},
    Pair{"dz", "Fz", 1.0, kInfinity, "a suspension moves along the force"},
    Pair{"Vx", "omega", 1.0, kInfinity, "a wheel rolls in its direction of travel"},
};

void check_pair(const Pair& pair,
                const Channel* a,
                const Channel* b,
                std::vector<ChannelDoubt>& doubts) {
  constexpr double kClearly = 0.5;
  if (!a || !b || a->unit != find_meaning(pair.a)->unit || b->unit != find_meaning(pair.b)->unit)
    return;
  const double r =
      correlation(*a, *b, [&](std::size_t i) { return std::abs(a->values[i]) <= pair.most_of_a; });
  if (r * pair.sign > -kClearly) return;
  doubts.push_back({b->name,
                    fmt::format("has {} sign as {} (correlation {:+.2f}), but in iso axes {}: "
                                "is one of the two signs wrong, or are the axes not as stated?",
                                pair.sign < 0.0 ? "the same" : "not the same",
                                a->name,
                                r,
                                pair.law),
                    0,
                    false,
                    false,
                    true});
}

void check_pairs(const Channels& channels, std::vector<ChannelDoubt>& doubts) {
  for (const Pair& pair : kPairs) {
    const Channel *a = only(channels, pair.a), *b = only(channels, pair.b);
    check_pair(pair, a, b, doubts);
    // A K&C table of both wheels has each pair twice.
    if ((a && b) || !pair.a.starts_with('d') || wheel_rolls(channels)) continue;
    for (const std::string& end : wheel_ends())
      check_pair(pair,
                 channels.find(std::string(pair.a) + end),
                 channels.find(std::string(pair.b) + end),
                 doubts);
  }
}

/// A motion, the force in its direction, and the usual range of the stiffness between the two,
/// N/mm.
struct UsualStiffness {
  std::string_view motion, force;
  double least, most;
};
// The ranges are wide: the upright of a race car has 50 kN/mm along y, the hub of a comfortable car
// 0.2 kN/mm along x. If a motion in mm is read as m, the stiffness is a thousandth and lies below
// every range.
constexpr std::array kStiffnesses = {UsualStiffness{"dx", "Fx", 100, 2e5},
                                     UsualStiffness{"dy", "Fy", 100, 2e5},
                                     UsualStiffness{"dz", "Fz", 1, 2e4},
                                     UsualStiffness{"travel", "Fz", 1, 2e4},
                                     UsualStiffness{"deflection", "Fz", 10, 1e4}};

/// Returns the stiffness, N/m, as the ratio of the range of the force to that of the motion;
/// nullopt unless the two are clearly correlated.
std::optional<double> stiffness_of(const Channel& motion, const Channel& force) {
  constexpr double kClearly = 0.9;  // least correlation
  constexpr std::size_t kFewest = 3;
  double x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0, n = 0.0;
  for (std::size_t i = 0; i < std::min(motion.values.size(), force.values.size()); ++i) {
    const double d = motion.values[i], F = force.values[i];
    if (!std::isfinite(d + F)) continue;
    x += d, y += F, xx += d * d, yy += F * F, xy += d * F, n += 1.0;
  }
  if (n < kFewest) return std::nullopt;
  const double dd = xx - x * x / n, FF = yy - y * y / n, dF = xy - x * y / n;
  if (!(dd > 0.0) || !(FF > 0.0) || !(std::abs(dF) > kClearly * std::sqrt(dd * FF)))
    return std::nullopt;
  return std::sqrt(FF / dd);
}

/// Adds a doubt if the stiffness, force over motion, is outside of its usual range. A displacement
/// in mm that was read as m may still lie within the usual range of displacements.
void check_stiffness(const Channels& channels, std::vector<ChannelDoubt>& doubts) {
  constexpr double kPerMm = 1e-3;  // N/mm in N/m
  for (const Channel& motion : channels.all()) {
    const std::string name = base_name(motion);
    for (const UsualStiffness& usual : kStiffnesses) {
      if (name != usual.motion || motion.unit != "m") continue;
      const std::string end =
          motion.name.starts_with(usual.motion) ? motion.name.substr(usual.motion.size()) : "";
      const Channel* force = channels.find(std::string(usual.force) + end);
      const auto stiffness =
          force && force->unit == "N" ? stiffness_of(motion, *force) : std::nullopt;
      if (!stiffness || (*stiffness * kPerMm >= usual.least && *stiffness * kPerMm <= usual.most))
        continue;
      doubts.push_back(
          {motion.name,
           fmt::format("has a stiffness of {} N/mm against {}, expected {:g} .. {:g} N/mm; {}",
                       format_number(*stiffness * kPerMm, 3),
                       force->name,
                       usual.least,
                       usual.most,
                       kLengths)});
    }
  }
}

/// Checks that a horizontal force is at most three times the load.
void check_friction(const Channels& channels, std::vector<ChannelDoubt>& doubts) {
  constexpr double kMostFriction = 3.0;
  constexpr double kLeastLoad = 0.2;  // share of the median load: below it the wheel nearly hops
  const Channel* Fz = only(channels, "Fz");
  if (!Fz || Fz->unit != "N") return;
  std::vector<double> loads;
  for (const double value : Fz->values)
    if (value > 0.0) loads.push_back(value);
  // the channel holds changes of a load, not loads
  if (2 * loads.size() <= Fz->values.size()) return;
  const auto middle = loads.begin() + static_cast<std::ptrdiff_t>(loads.size() / 2);
  std::nth_element(loads.begin(), middle, loads.end());
  const double least = kLeastLoad * *middle;
  for (const char* name : {"Fx", "Fy"}) {
    const Channel* force = only(channels, name);
    if (!force || force->unit != "N") continue;
    std::size_t count = 0, first = 0, all = 0;
    double most = 0.0;
    for (std::size_t i = 0; i < std::min(force->values.size(), Fz->values.size()); ++i) {
      if (!(Fz->values[i] >= least) || std::isnan(force->values[i])) continue;
      ++all;
      const double friction = std::abs(force->values[i]) / Fz->values[i];
      most = std::max(most, friction);
      if (friction > kMostFriction && count++ == 0) first = i;
    }
    if (count == 0) continue;
    doubts.push_back({force->name,
                      fmt::format("is more than {} times the load {} {}, at most {} times: no "
                                  "tire has such a friction; is one of the two in another unit, or "
                                  "a spike?",
                                  kMostFriction,
                                  Fz->name,
                                  of_samples(count, all),
                                  format_number(most, 3)),
                      first});
  }
}

/// Fits Fy / Fz = a(Fz, alpha) alpha + b gamma + c(Fz) at small slip angles, where a is linear in
/// Fz and in alpha^2 and c is linear in Fz; b must be negative in iso axes. Without these terms the
/// spread of a record over several loads hides b.
void check_inclination(const Channels& channels, std::vector<ChannelDoubt>& doubts) {
  constexpr double kLeastSpread = 0.01;  // rad; least spread of gamma
  constexpr double kClearly = 8.0;       // least ratio of b to its standard deviation
  constexpr double kOwnPart = 1e-6;      // least share of gamma^2 that the other terms leave
  constexpr Eigen::Index kFewest = 12, kTerms = 5;
  const Channel *Fy = only(channels, "Fy"), *Fz = only(channels, "Fz"),
                *alpha = only(channels, "alpha"), *gamma = only(channels, "gamma");
  if (!Fy || !Fz || !alpha || !gamma || gamma->unit != "rad" || alpha->unit != "rad") return;
  std::vector<std::size_t> small;
  double load = 0.0, low = kInfinity, high = -kInfinity;
  for (std::size_t i = 0; i < Fy->values.size(); ++i) {
    const double a = alpha->values[i], g = gamma->values[i], N = Fz->values[i];
    if (!std::isfinite(a * g * Fy->values[i] / N) || std::abs(a) > 0.5 * kSmallSlip || !(N > 0.0))
      continue;
    small.push_back(i);
    load += N;
    low = std::min(low, g), high = std::max(high, g);
  }
  const auto count = static_cast<Eigen::Index>(small.size());
  if (count < kFewest || high - low < kLeastSpread) return;
  load /= static_cast<double>(count);
  Eigen::MatrixXd terms(count, kTerms);
  Eigen::VectorXd lean(count), side(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t k = small[static_cast<std::size_t>(i)];
    const double a = alpha->values[k] / kSmallSlip, z = Fz->values[k] / load - 1.0;
    terms.row(i) << 1.0, a, z, a * z, a * a * a;
    lean[i] = gamma->values[k];
    side[i] = Fy->values[k] / Fz->values[k];
  }
  const auto slip = terms.col(1);
  const bool falls = (slip.array() - slip.mean()).matrix().dot(side) < 0.0;
  // b is the slope of what the other terms leave of Fy / Fz over what they leave of gamma.
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> others(terms);
  const double all = lean.squaredNorm();
  lean -= terms * others.solve(lean);
  side -= terms * others.solve(side);
  const double own = lean.squaredNorm();
  if (!falls || own <= kOwnPart * all) return;
  const double b = lean.dot(side) / own;
  const double variance = (side - b * lean).squaredNorm() / static_cast<double>(count - kTerms - 1);
  if (!(b > kClearly * std::sqrt(std::max(variance, 1e-12) / own))) return;
  doubts.push_back({gamma->name,
                    fmt::format("raises Fy: Fy / Fz grows by {:.3g} a degree at small {}, but in "
                                "iso axes a tire whose top leans to the right pulls to the right: "
                                "is the sign of the inclination wrong?",
                                b * std::numbers::pi / 180.0,
                                alpha->name),
                    0,
                    false,
                    false,
                    true});
}

/// Checks that the time rises from each sample to the next one of its run.
void check_time(const Channels& channels,
                const std::vector<std::size_t>& breaks,
                std::vector<ChannelDoubt>& doubts) {
  const Channel* time = only(channels, "time");
  if (!time || time->unit != "s") return;
  const std::vector<double>& t = time->values;
  constexpr std::size_t kShortestRun = 3;  // samples
  std::size_t back = 0, first_back = 0, same = 0, first_same = 0, steps = 0, begin = 0;
  // A run is at least three samples. If the time then returns to the value at which the run began,
  // another run begins.
  const auto begins_anew = [&](std::size_t i) {
    return i - begin >= kShortestRun && std::abs(t[i] - t[begin]) <= t[begin + 1] - t[begin];
  };
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (std::isnan(t[i]) || std::isnan(t[i - 1]) ||
        std::find(breaks.begin(), breaks.end(), i) != breaks.end()) {
      begin = i;
      continue;
    }
    ++steps;
    if (t[i] < t[i - 1] && begins_anew(i)) {
      begin = i;
      continue;
    }
    if (t[i] < t[i - 1] && back++ == 0) first_back = i;
    if (t[i] == t[i - 1] && same++ == 0) first_same = i;
  }
  const auto in_words = [&](std::size_t i) {
    return fmt::format("from {} to {} s", format_number(t[i - 1], 9), format_number(t[i], 9));
  };
  if (back > 0)
    doubts.push_back(
        {time->name,
         fmt::format("goes back {}, first {}: {}",
                     of_samples(back, t.size()),
                     in_words(first_back),
                     2 * back < steps ? "are the rows not in order, or does another run begin?"
                                      : "is its sign wrong?"),
         first_back});
  if (same > 0)
    doubts.push_back({time->name,
                      fmt::format("repeats {}, first at {} s: did a row come twice, or is it "
                                  "rounded?",
                                  of_samples(same, t.size()),
                                  format_number(t[first_same], 9)),
                      first_same});
}

/// Checks two lengths of a header: the rim must be smaller than its tire.
void check_rim(const Channels& channels, std::vector<ChannelDoubt>& doubts) {
  const Channel *rim = channels.find("RIMDIAME"), *tire = channels.find("OVALLDIA");
  double factor = 1.0;
  if (!tire) tire = channels.find("RFREE"), factor = 2.0;
  if (!rim || !tire || rim->values.empty() || tire->values.empty() || rim->unit != "m" ||
      tire->unit != "m" || rim->values[0] < factor * tire->values[0])
    return;
  doubts.push_back({"RIMDIAME",
                    fmt::format("is {}, not below the diameter of the tire, {}",
                                format_quantity(rim->values[0], "m", 4),
                                format_quantity(factor * tire->values[0], "m", 4)),
                    0,
                    true});
}

}  // namespace

std::vector<ChannelDoubt> doubts_about(const Channels& channels,
                                       const std::vector<std::size_t>& breaks) {
  std::vector<ChannelDoubt> doubts;
  for (const Channel& channel : channels.all()) {
    const std::string name = base_name(channel);
    if (name == "Fz" && channel.unit == "N" && channel.name != "load")
      if (auto doubt = sign_of_load(channel)) {
        doubts.push_back(std::move(*doubt));
        continue;
      }
    for (const UsualRange& range : kRanges)
      if (range.channel == name)
        if (auto doubt = out_of_range(channel, range)) doubts.push_back(std::move(*doubt));
  }
  const bool is_turned = std::any_of(
      doubts.begin(), doubts.end(), [](const ChannelDoubt& one) { return one.all_loads_negative; });
  if (!is_turned) {
    check_friction(channels, doubts);
    check_pairs(channels, doubts);
    check_stiffness(channels, doubts);
    check_inclination(channels, doubts);
    for (ChannelDoubt& doubt : suspension_doubts(channels)) doubts.push_back(std::move(doubt));
  }
  check_time(channels, breaks, doubts);
  check_rim(channels, doubts);
  return doubts;
}

std::vector<ChannelDoubt> gaps_in(const Channels& channels) {
  std::vector<ChannelDoubt> gaps;
  for (const Channel& channel : channels.all()) {
    const auto is_gap = [](double x) { return std::isnan(x); };
    const auto first = std::find_if(channel.values.begin(), channel.values.end(), is_gap);
    const auto count = std::count_if(channel.values.begin(), channel.values.end(), is_gap);
    if (count == 0 || count == std::ssize(channel.values)) continue;
    gaps.push_back({channel.name,
                    fmt::format("is empty in {} of {} samples, first in sample {}",
                                count,
                                channel.values.size(),
                                first - channel.values.begin() + 1),
                    static_cast<std::size_t>(first - channel.values.begin())});
  }
  return gaps;
}

}  // namespace latsch
