// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/bushing_reader.h"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "base/error.h"

namespace latsch::suspension {
namespace {

using multibody::BushingParameters;
using multibody::ForcePart;

constexpr std::array<const char*, 6> kBushingAxes = {
    "x", "y", "z", "about_x", "about_y", "about_z"};
constexpr double kRigid = 1e10;     // N/m: 0.1 nm a newton
constexpr double kTurnsFreely = 10;  // N m/rad: enough that no rod spins

struct Units {
  const char *d, *f, *k;
};
Units units_of(std::size_t axis) {
  return axis < 3 ? Units{"m", "N", "N/m"} : Units{"rad", "N m", "N m/rad"};
}

std::optional<double> spring(const std::optional<Node>& node, std::size_t axis) {
  if (!node || !node->has(kBushingAxes[axis])) return std::nullopt;
  return node->quantity(kBushingAxes[axis], units_of(axis).k, Range::not_negative());
}

/// Two numbers of their own units.
std::pair<double, double> read_pair(const Node& table,
                                    const char* key,
                                    const char* first,
                                    const char* second) {
  const std::vector<std::vector<double>> rows = table.rows(key, {first, second});
  if (rows.size() != 1) table.reject(key, "expected two values in double brackets");
  return {rows[0][0], rows[0][1]};
}

/// Parts of one table, of a joint or of all.
void read_parts(const Node& node, std::size_t axis, std::vector<BushingParameters::Part>& parts) {
  const Units unit = units_of(axis);
  const char* const name = kBushingAxes[axis];
  const auto add = [&](ForcePart part) {
    parts.push_back({static_cast<int>(axis), std::move(part)});
  };
  if (const auto curves = node.find_table("curve"); curves && curves->has(name))
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

}  // namespace

multibody::ForceCurve read_curve(const Node& table,
                                 const std::string& key,
                                 const std::string& unit,
                                 const std::string& unit_of_force) {
  std::vector<multibody::ForceCurve::Point> points;
  for (const auto& row : table.rows(key, {unit, unit_of_force}))
    points.emplace_back(row[0], row[1]);
  if (const std::string fault = multibody::ForceCurve::fault(points); !fault.empty())
    table.reject(key, fault);
  return multibody::ForceCurve(std::move(points));
}

BushingParameters read_bushing(const Node& bushings, const std::string& name) {
  const auto all = bushings.find_table("all"), own = bushings.find_table(name);
  BushingParameters bushing;
  multibody::Vector6d k;
  const bool rigid = (own && own->flag("rigid", false)) ||
                     (all && all->flag("rigid", false) && !(own && own->has("rigid")));
  for (std::size_t axis = 0; axis < kBushingAxes.size(); ++axis) {
    const auto common = spring(all, axis);  // asked for, whether it counts or not
    const auto value = spring(own, axis);
    std::vector<BushingParameters::Part> parts;
    if (own) read_parts(*own, axis, parts);
    if (all && parts.empty()) read_parts(*all, axis, parts);
    const bool curved = has_curve(parts, axis);
    if (curved && value)
      own->reject(kBushingAxes[axis],
                  fmt::format("stands beside curve.{}, expected one of them", kBushingAxes[axis]));
    if (!value && !common && !curved && !rigid)
      bushings.reject(
          name, fmt::format("has no {}, expected it here or in [bushing.all]", kBushingAxes[axis]));
    const auto index = static_cast<Eigen::Index>(axis);
    k[index] = rigid ? (axis < 3 ? kRigid : kTurnsFreely) : curved ? 0.0 : value ? *value : *common;
    for (auto& part : parts) bushing.parts.push_back(std::move(part));
  }
  bushing.stiffness = k.head<3>();
  bushing.rotational = k.tail<3>();
  double time = all ? all->quantity("damping", "s", Range::not_negative(), 0.0) : 0.0;
  if (own) time = own->quantity("damping", "s", Range::not_negative(), time);
  bushing.damping = time * bushing.stiffness;
  bushing.rotational_damping = time * bushing.rotational;
  for (const auto& part : bushing.parts)
    if (const std::string fault = multibody::fault_of(part.law); !fault.empty())
      bushings.reject(name, fault);
  return bushing;
}

}  // namespace latsch::suspension
