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

}  // namespace

Corner read_corner(const Node& root) {
  root.choice("kind", {"suspension"});
  root.text("title", "");
  Corner found{read_geometry(root), std::nullopt};
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
  } else if (bushings) {
    root.reject("bushing", "is for double wishbones: five links have no statics");
  }
  root.close();
  if (fault.empty()) fault = found.geometry.fault();
  if (!fault.empty()) throw InputError(hardpoint.place(), fault);
  if (!found.statics) return found;
  const DoubleWishbone& corner = *found.statics;
  fault = multibody::Mechanism::fault(corner.bodies(), corner.joints());
  if (!fault.empty()) throw InputError(bushings->place(), fault);
  return found;
}

DoubleWishbone read_suspension(const Node& root) {
  const Corner found = read_corner(root);
  if (found.statics) return *found.statics;
  if (!found.geometry.kingpin)
    root.reject("type", "is \"five_link\": loads take a double wishbone with its bushings");
  root.reject("bushing", "is not there: loads take the stiffnesses of its joints");
}

std::vector<std::pair<int, int>> stiffnesses_at(const Document& numbers, const std::string& path) {
  const auto index_in = [](const auto& names, const std::string& name) {
    return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::string_view start = "bushing.";
  const std::size_t dot = path.rfind('.');
  if (!path.starts_with(start) || dot < start.size()) return {};
  const std::string name = path.substr(start.size(), dot - start.size());
  const int axis = index_in(kAxes, path.substr(dot + 1));
  if (axis == static_cast<int>(kAxes.size())) return {};
  const int joint = index_in(DoubleWishbone::kNames, name);
  if (joint < DoubleWishbone::kJoints) return {{joint, axis}};
  if (name != "all") return {};
  std::vector<std::pair<int, int>> found;
  const auto paths = numbers.paths();
  for (int i = 0; i < DoubleWishbone::kJoints; ++i) {
    const std::string own = fmt::format("bushing.{}.{}",
                                        DoubleWishbone::kNames[static_cast<std::size_t>(i)],
                                        kAxes[static_cast<std::size_t>(axis)]);
    if (std::find(paths.begin(), paths.end(), own) == paths.end()) found.emplace_back(i, axis);
  }
  return found;
}

}  // namespace latsch::suspension
