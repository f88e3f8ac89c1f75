// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/suspension_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "models/suspension/bushing_reader.h"
#include "models/suspension/geometry_reader.h"

namespace latsch::suspension {
namespace {

constexpr std::array<const char*, 6> kAxes = {"x", "y", "z", "about_x", "about_y", "about_z"};

DoubleWishbone read_double_wishbone(const Node& hardpoint, const CornerGeometry& geometry) {
  DoubleWishbone corner;
  corner.side = geometry.linkage.wheel.side;
  corner.pushrod_on = geometry.spring.on == SpringDrive::On::upper_wishbone ? DoubleWishbone::kUpper
                      : geometry.spring.on == SpringDrive::On::lower_wishbone
                          ? DoubleWishbone::kLower
                          : DoubleWishbone::kUpright;
  for (std::size_t i = 0; i < DoubleWishbone::kJoints; ++i)
    corner.points[i] = read_point(hardpoint, DoubleWishbone::kNames[i]);
  corner.wheel_center = read_point(hardpoint, "wheel_center");
  corner.contact = read_point(hardpoint, "contact");
  return corner;
}

CompliantCorner read_five_links(const Node& hardpoint,
                                const CornerGeometry& geometry,
                                const std::vector<BushingParameters>& bushings) {
  auto corner = compliant_five_links(geometry, read_point(hardpoint, "contact"), bushings);
  if (!corner) throw InputError(hardpoint.place(), corner.failure().reason);
  return std::move(*corner);
}

}  // namespace

SuspensionCorner read_corner(const Node& root) {
  root.choice("kind", {"suspension"});
  root.text("title", "");
  SuspensionCorner found{read_geometry(root), std::nullopt, std::nullopt};
  const Node hardpoint = root.table("hardpoint");
  const auto bushings = root.find_table("bushing");
  std::string fault;
  if (found.geometry.kingpin) {
    DoubleWishbone corner = read_double_wishbone(hardpoint, found.geometry);
    fault = corner.fault();
    if (bushings) {
      for (std::size_t i = 0; i < DoubleWishbone::kJoints; ++i)
        corner.bushings[i] = read_bushing(*bushings, DoubleWishbone::kNames[i]);
      found.statics = corner;
    }
  }
  std::vector<BushingParameters> of_links;
  if (bushings && !found.geometry.kingpin)
    for (const std::string& name : joints_of_five_links(found.geometry))
      of_links.push_back(read_bushing(*bushings, name));
  root.close();
  if (fault.empty()) fault = found.geometry.fault();
  if (!fault.empty()) throw InputError(hardpoint.place(), fault);
  if (!bushings) return found;
  found.compliant = found.statics ? compliant_corner(*found.statics)
                                  : read_five_links(hardpoint, found.geometry, of_links);
  fault = multibody::Mechanism::fault(found.compliant->bodies, found.compliant->joints);
  if (!fault.empty()) throw InputError(bushings->place(), fault);
  return found;
}

DoubleWishbone read_suspension(const Node& root) {
  const SuspensionCorner found = read_corner(root);
  if (found.statics) return *found.statics;
  if (!found.geometry.kingpin)
    root.reject("type",
                "is \"five_link\": a car, and an export of bushings, need double wishbones with "
                "their bushings");
  root.reject("bushing", "is missing: loads need the stiffnesses of its joints");
}

bool is_stiffness(const std::string& path) {
  const std::string_view start = "bushing.";
  const std::size_t dot = path.rfind('.');
  if (!path.starts_with(start) || dot < start.size()) return false;
  return path.find('.', start.size()) == dot &&
         std::find(kAxes.begin(), kAxes.end(), path.substr(dot + 1)) != kAxes.end();
}

std::vector<std::pair<int, int>> stiffnesses_at(const Document& numbers,
                                                const std::string& path,
                                                const std::vector<multibody::Joint>& joints) {
  if (!is_stiffness(path)) return {};
  const std::size_t start = std::string_view("bushing.").size(), dot = path.rfind('.');
  const std::string name = path.substr(start, dot - start), axis = path.substr(dot + 1);
  const int index = static_cast<int>(std::find(kAxes.begin(), kAxes.end(), axis) - kAxes.begin());
  const auto paths = numbers.paths();
  std::vector<std::pair<int, int>> found;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::string own = fmt::format("bushing.{}.{}", joints[i].name, axis);
    const bool is_own = std::find(paths.begin(), paths.end(), own) != paths.end();
    if (name == joints[i].name || (name == "all" && !is_own))
      found.emplace_back(static_cast<int>(i), index);
  }
  return found;
}

}  // namespace latsch::suspension
