// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/bushing_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"

namespace latsch::suspension {
namespace {

using multibody::BushingParameters;
using multibody::ForcePart;

constexpr std::array<const char*, 6> kBushingAxes = {
    "x", "y", "z", "about_x", "about_y", "about_z"};
constexpr double kRigid = 1e10;  // N/m: a joint of this stiffness yields by 0.1 nm per newton

struct Units {
  const char *d, *f, *k, *c;
};
Units units_of(std::size_t axis) {
  return axis < 3 ? Units{"m", "N", "N/m", "N s/m"} : Units{"rad", "N m", "N m/rad", "N m s/rad"};
}

std::optional<double> spring(const std::optional<Node>& node, std::size_t axis) {
  if (!node || !node->has(kBushingAxes[axis])) return std::nullopt;
  return node->quantity(kBushingAxes[axis], units_of(axis).k, Range::not_negative());
}

/// Reads an array of two numbers, each with its own unit.
std::pair<double, double> read_pair(const Node& table,
                                    const char* key,
                                    const char* first,
                                    const char* second) {
  const std::vector<std::vector<double>> rows = table.rows(key, {first, second});
  if (rows.size() != 1) table.reject(key, "expected two values in double brackets");
  return {rows[0][0], rows[0][1]};
}

std::optional<double> viscous(const std::optional<Node>& node, std::size_t axis) {
  const auto dampers = node ? node->find_table("viscous") : std::nullopt;
  if (!dampers || !dampers->has(kBushingAxes[axis])) return std::nullopt;
  return dampers->quantity(kBushingAxes[axis], units_of(axis).c, Range::not_negative());
}

/// Returns the damping of an axis with the stiffness k. The joint's own keys have priority over
/// those of [bushing.all].
double damping_of(const std::optional<Node>& own,
                  const std::optional<Node>& all,
                  std::size_t axis,
                  double k) {
  const auto time = [](const std::optional<Node>& node) -> std::optional<double> {
    if (!node || !node->has("damping")) return std::nullopt;
    return node->quantity("damping", "s", Range::not_negative());
  };
  // The common values are read in any case, so that their keys count as known.
  const auto common = viscous(all, axis), common_time = time(all);
  const auto value = viscous(own, axis), own_time = time(own);
  if (value) return *value;
  if (own_time) return *own_time * k;
  if (common) return *common;
  return common_time.value_or(0.0) * k;
}

/// Reads the force parts of one table: a joint's own or [bushing.all]. The curve of [bushing.all]
/// is skipped if the joint has a stiffness of its own.
void read_parts(const Node& node,
                std::size_t axis,
                bool with_curve,
                std::vector<BushingParameters::Part>& parts) {
  const Units unit = units_of(axis);
  const char* const name = kBushingAxes[axis];
  const auto add = [&](ForcePart part) {
    parts.push_back({static_cast<int>(axis), std::move(part)});
  };
  if (const auto curves = node.find_table("curve"); curves && curves->has(name) && with_curve)
    add(multibody::ElasticCurve{read_curve(*curves, name, unit.d, unit.f)});
  if (const auto play = node.find_table("play"); play && play->has(name)) {
    const auto [gap, stiffness] = read_pair(*play, name, unit.d, unit.k);
    add(multibody::Play{gap, stiffness});
  }
  if (const auto friction = node.find_table("friction"); friction && friction->has(name)) {
    const auto [limit, stiffness] = read_pair(*friction, name, unit.f, unit.k);
    add(multibody::Friction{stiffness, limit});
  }
  if (const auto maxwell = node.find_table("maxwell"); maxwell && maxwell->has(name)) {
    const auto [stiffness, time] = read_pair(*maxwell, name, unit.k, "s");
    add(multibody::Maxwell{stiffness, time});
  }
}

bool has_curve(const std::vector<BushingParameters::Part>& parts, std::size_t axis) {
  for (const auto& part : parts)
    if (part.axis == static_cast<int>(axis) &&
        std::holds_alternative<multibody::ElasticCurve>(part.law))
      return true;
  return false;
}

/// Throws InputError for a force curve that drives the motion instead of resisting it. Its force at
/// zero deflection is a preload and is not counted.
void refuse_driving(const Node& table,
                    const std::string& key,
                    const std::string& unit,
                    const std::string& unit_of_force,
                    const multibody::ForceCharacteristic& curve,
                    double beside) {
  constexpr double kRounding = 1e-9;  // tolerance, as a share of the largest force
  double most = 0.0;
  for (const auto& [x, f] : curve.points()) most = std::max(most, std::abs(f));
  for (const auto& [x, f] : curve.points()) {
    const double force = f - curve.at(0.0) + beside * x;
    if (x == 0.0 || !(std::copysign(force, force * x) < -kRounding * most)) continue;
    table.reject(key,
                 fmt::format("has {} at {}{}: it drives the motion on instead of resisting it; "
                             "expected a force with the sign of the {}. Is a sign wrong?",
                             format_quantity(f, unit_of_force, 4),
                             format_quantity(x, unit, 4),
                             beside > 0.0 ? ", more than the stiffness beside it resists" : "",
                             unit == "m/s"   ? "rate of extension"
                             : unit == "rad" ? "angle"
                                             : "deflection, in extension positive"));
  }
}

}  // namespace

multibody::ForceCharacteristic read_curve(const Node& table,
                                          const std::string& key,
                                          const std::string& unit,
                                          const std::string& unit_of_force,
                                          double beside) {
  std::vector<multibody::ForceCharacteristic::Point> points;
  for (const auto& row : table.rows(key, {unit, unit_of_force}))
    points.emplace_back(row[0], row[1]);
  if (const std::string fault = multibody::ForceCharacteristic::fault(points); !fault.empty())
    table.reject(key, fault);
  multibody::ForceCharacteristic curve(std::move(points));
  refuse_driving(table, key, unit, unit_of_force, curve, beside);
  return curve;
}

BushingParameters read_bushing(const Node& bushings, const std::string& name) {
  const auto all = bushings.find_table("all"), own = bushings.find_table(name);
  BushingParameters bushing;
  multibody::Vector6d k, c;
  const bool rigid = (own && own->flag("rigid", false)) ||
                     (all && all->flag("rigid", false) && !(own && own->has("rigid")));
  for (std::size_t axis = 0; axis < kBushingAxes.size(); ++axis) {
    // The common stiffness is read even if it is not used, so that its key counts as known.
    const auto common = spring(all, axis);
    const auto value = spring(own, axis);
    std::vector<BushingParameters::Part> parts;
    if (own) read_parts(*own, axis, true, parts);
    if (all && parts.empty()) read_parts(*all, axis, !value, parts);
    const bool curved = has_curve(parts, axis);
    if (curved && value)
      own->reject(
          kBushingAxes[axis],
          fmt::format("is given beside curve.{}, expected one of them", kBushingAxes[axis]));
    if (!value && !common && !curved && !rigid)
      bushings.reject(
          name, fmt::format("has no {}, expected it here or in [bushing.all]", kBushingAxes[axis]));
    const auto index = static_cast<Eigen::Index>(axis);
    k[index] = rigid ? (axis < 3 ? kRigid : 0.0) : curved ? 0.0 : value ? *value : *common;
    c[index] = damping_of(own, all, axis, k[index]);
    for (auto& part : parts) bushing.parts.push_back(std::move(part));
  }
  bushing.stiffness = k.head<3>();
  bushing.rotational = k.tail<3>();
  bushing.damping = c.head<3>();
  bushing.rotational_damping = c.tail<3>();
  bushing.rigid = rigid;
  for (const auto& part : bushing.parts)
    if (const std::string fault = multibody::fault_of(part.law); !fault.empty())
      bushings.reject(name, fault);
  return bushing;
}

std::vector<std::string> bushing_lines(const BushingParameters& bushing) {
  std::vector<std::string> lines;
  for (std::size_t axis = 0; axis < kBushingAxes.size(); ++axis) {
    const auto i = static_cast<Eigen::Index>(axis % 3);
    const Units unit = units_of(axis);
    const char* const name = kBushingAxes[axis];
    std::string curve;
    for (const BushingParameters::Part& part : bushing.parts) {
      if (part.axis != static_cast<int>(axis)) continue;
      assert(curve.empty() && std::holds_alternative<multibody::ElasticCurve>(part.law));
      for (const auto& [x, f] : std::get<multibody::ElasticCurve>(part.law).curve.points())
        curve += fmt::format("{}[\"{} {}\", \"{} {}\"]",
                             curve.empty() ? "" : ", ",
                             format_number(x),
                             unit.d,
                             format_number(f),
                             unit.f);
    }
    const double k = (axis < 3 ? bushing.stiffness : bushing.rotational)[i];
    const double c = (axis < 3 ? bushing.damping : bushing.rotational_damping)[i];
    assert(curve.empty() || k == 0.0);
    lines.push_back(curve.empty() ? fmt::format("{} = \"{} {}\"", name, format_number(k), unit.k)
                                  : fmt::format("curve.{} = [{}]", name, curve));
    lines.push_back(fmt::format("viscous.{} = \"{} {}\"", name, format_number(c), unit.c));
  }
  return lines;
}

const std::vector<std::string>& keys_in_place_of_a_file() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all(kBushingAxes.begin(), kBushingAxes.end());
    for (const char* key : {"rigid", "damping", "curve", "viscous"}) all.push_back(key);
    return all;
  }();
  return keys;
}

}  // namespace latsch::suspension
