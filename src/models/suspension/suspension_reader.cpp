// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/suspension_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "models/suspension/bushing_reader.h"

namespace latsch::suspension {
namespace {

constexpr std::array<const char*, 6> kAxes = {"x", "y", "z", "about_x", "about_y", "about_z"};

Eigen::Vector3d read_point(const Node& hardpoint, const char* name) {
  const auto values = hardpoint.quantities(name, "m");
  if (values.size() != 3)
    hardpoint.reject(name, fmt::format("has {} values, expected three: x, y, z", values.size()));
  return {values[0], values[1], values[2]};
}

}  // namespace

DoubleWishbone read_suspension(const Node& root) {
  root.choice("kind", {"suspension"});
  root.text("title", "");
  DoubleWishbone corner;
  corner.side = root.choice("side", {"left", "right"}) == "left" ? Side::left : Side::right;
  const std::string on =
      root.choice("pushrod_on", {"upper_wishbone", "lower_wishbone", "upright"}, "upper_wishbone");
  corner.pushrod_on = on == "upper_wishbone"   ? DoubleWishbone::kUpper
                      : on == "lower_wishbone" ? DoubleWishbone::kLower
                                               : DoubleWishbone::kUpright;
  const Node hardpoint = root.table("hardpoint"), bushings = root.table("bushing");
  for (std::size_t i = 0; i < DoubleWishbone::kJoints; ++i) {
    corner.points[i] = read_point(hardpoint, DoubleWishbone::kNames[i]);
    corner.bushings[i] = read_bushing(bushings, DoubleWishbone::kNames[i]);
  }
  corner.wheel_center = read_point(hardpoint, "wheel_center");
  corner.contact = read_point(hardpoint, "contact");
  if ((corner.side == Side::left) != (corner.contact.y() > 0.0))
    root.reject("side",
                fmt::format("is {}, but the contact point has y = {:.4g} m: left is y > 0",
                            root.text("side"),
                            corner.contact.y()));
  root.close();
  std::string fault = corner.fault();
  if (!fault.empty()) throw InputError(hardpoint.place(), fault);
  fault = multibody::Mechanism::fault(corner.bodies(), corner.joints());
  if (!fault.empty()) throw InputError(bushings.place(), fault);
  return corner;
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
