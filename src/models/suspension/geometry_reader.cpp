// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/geometry_reader.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace latsch::suspension {
namespace {

using Eigen::Vector3d;

// Largest distance along x between contact point and wheel center, m.
constexpr double kBelow = 5e-3;
// Smallest distance, m, of the ends of a rocker's arms from one line at which they define a plane.
constexpr double kInLine = 1e-3;

std::optional<Vector3d> find_point(const Node& points, const char* name) {
  if (!points.has(name)) return std::nullopt;
  return read_point(points, name);
}

void read_wishbones(const Node& hardpoint, CornerGeometry& corner) {
  const auto link = [&](const char* inner, const char* outer, const char* name) -> Link {
    return {name, read_point(hardpoint, inner), read_point(hardpoint, outer)};
  };
  corner.linkage.links = {{link("uca_front", "ubj", "uca_front"),
                           link("uca_rear", "ubj", "uca_rear"),
                           link("lca_front", "lbj", "lca_front"),
                           link("lca_rear", "lbj", "lca_rear"),
                           link("trackrod_inner", "trackrod_outer", "trackrod")}};
  const auto& links = corner.linkage.links;
  corner.kingpin = {links[2].outer, links[0].outer};
  if (corner.spring.on == SpringDrive::On::upright) return;
  const std::size_t front = corner.spring.on == SpringDrive::On::upper_wishbone ? 0 : 2;
  corner.spring.hinge_front = links[front].inner;
  corner.spring.hinge_rear = links[front + 1].inner;
  corner.spring.ball = links[front].outer;
}

void read_five_links(const Node& root, CornerGeometry& corner) {
  const auto tables = root.named_tables("link");
  if (tables.size() != Linkage::kLinks)
    root.reject("link", fmt::format("has {} links, expected five", tables.size()));
  std::vector<std::string> names;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    names.push_back(tables[i].name());
    corner.linkage.links[i] = {
        names.back(), read_point(tables[i], "inner"), read_point(tables[i], "outer")};
  }
  const std::string trackrod = root.choice("trackrod", names, names.back());
  corner.linkage.trackrod =
      static_cast<int>(std::find(names.begin(), names.end(), trackrod) - names.begin());
  if (corner.spring.on != SpringDrive::On::upright)
    root.reject("pushrod_on", "is a wishbone, expected \"upright\": five links have none");
}

void read_wheel(const Node& root, const Node& hardpoint, Wheel& wheel) {
  wheel.center = read_point(hardpoint, "wheel_center");
  double toe = 0.0, camber = 0.0;
  if (const auto table = root.find_table("wheel")) {
    toe = table->quantity("toe", "rad", Range::between(-0.5, 0.5), 0.0);
    camber = table->quantity("camber", "rad", Range::between(-0.5, 0.5), 0.0);
  }
  const double outboard = wheel.side == Side::left ? 1.0 : -1.0;
  const double steer = -outboard * toe, lean = -outboard * camber;
  wheel.spin_axis = {
      -std::sin(steer) * std::cos(lean), std::cos(steer) * std::cos(lean), std::sin(lean)};
  const Vector3d to_contact = read_point(hardpoint, "contact") - wheel.center;
  const double ahead = to_contact.dot(Vector3d(std::cos(steer), std::sin(steer), 0.0));
  if (std::abs(ahead) > kBelow)
    hardpoint.reject("contact",
                     fmt::format("is {:.4g} mm {} wheel_center, expected it below",
                                 1e3 * std::abs(ahead),
                                 ahead > 0.0 ? "ahead of" : "behind"));
  wheel.offset = to_contact.dot(wheel.spin_axis);
  wheel.radius = -(to_contact - wheel.offset * wheel.spin_axis).z() / std::cos(lean);
}

Vector3d rocker_axis(const Node& hardpoint, const Lever& rocker, const Vector3d& spring_end) {
  if (const auto second = find_point(hardpoint, "rocker_axis")) {
    if ((*second - rocker.pivot).norm() < kInLine)
      hardpoint.reject("rocker_axis", "is where rocker_pivot is: two points make an axis");
    return (*second - rocker.pivot).normalized();
  }
  const Vector3d arm = rocker.own - rocker.pivot;
  const Vector3d normal = arm.cross(spring_end - rocker.pivot);
  if (!(normal.norm() > kInLine * arm.norm()))
    hardpoint.reject("rocker_pivot",
                     "is in line with pushrod_inner and rocker_damper: no plane, so rocker_axis "
                     "has to be given");
  return normal.normalized();
}

void read_spring(const Node& hardpoint, SpringDrive& spring) {
  spring.outer = read_point(hardpoint, "pushrod_outer");
  spring.inner = read_point(hardpoint, "pushrod_inner");
  const auto pivot = find_point(hardpoint, "rocker_pivot");
  if (!pivot) {
    for (const char* name : {"rocker_axis",
                             "rocker_damper",
                             "damper_chassis",
                             "rocker_arb_link",
                             "arb_link_blade",
                             "arb_center"})
      if (hardpoint.has(name))
        hardpoint.reject(name,
                         "belongs to a rocker, which has no "
                         "rocker_pivot");
    return;
  }
  SpringDrive::Rocker rocker;
  rocker.lever = {"rocker", "push-rod", *pivot, Vector3d::UnitX(), spring.inner, spring.outer};
  rocker.spring_end = read_point(hardpoint, "rocker_damper");
  rocker.spring_on_chassis = read_point(hardpoint, "damper_chassis");
  rocker.lever.axis = rocker_axis(hardpoint, rocker.lever, rocker.spring_end);
  spring.rocker = rocker;
  if (!hardpoint.has("rocker_arb_link")) {
    for (const char* name : {"arb_link_blade", "arb_center"})
      if (hardpoint.has(name))
        hardpoint.reject(name,
                         "belongs to a bar that has no "
                         "rocker_arb_link");
    return;
  }
  spring.blade = {"blade of the anti-roll bar",
                  "link of the anti-roll bar",
                  read_point(hardpoint, "arb_center"),
                  Vector3d::UnitY(),
                  read_point(hardpoint, "arb_link_blade"),
                  read_point(hardpoint, "rocker_arb_link")};
}

void check_side(const Node& hardpoint, const CornerGeometry& corner) {
  const double outboard = corner.linkage.wheel.side == Side::left ? 1.0 : -1.0;
  const auto check = [&](const std::string& name, const Vector3d& point) {
    if (point.y() * outboard > 0.0) return;
    throw InputError(hardpoint.place(),
                     fmt::format("{} has y = {:.4g} m, but the corner is the {} one: left is y > 0",
                                 name,
                                 point.y(),
                                 outboard > 0.0 ? "left" : "right"));
  };
  check("wheel_center", corner.linkage.wheel.center);
  for (const Link& link : corner.linkage.links)
    check(fmt::format("the outer end of {}", link.name), link.outer);
}

}  // namespace

Vector3d read_point(const Node& points, const char* name) {
  const auto values = points.quantities(name, "m");
  if (values.size() != 3)
    points.reject(name, fmt::format("has {} values, expected three: x, y, z", values.size()));
  return {values[0], values[1], values[2]};
}

CornerGeometry read_geometry(const Node& root) {
  CornerGeometry corner;
  const bool has_wishbones =
      root.choice("type", {"double_wishbone", "five_link"}, "double_wishbone") == "double_wishbone";
  const std::string on = root.choice("pushrod_on",
                                     {"upper_wishbone", "lower_wishbone", "upright"},
                                     has_wishbones ? "upper_wishbone" : "upright");
  corner.spring.on = on == "upper_wishbone"   ? SpringDrive::On::upper_wishbone
                     : on == "lower_wishbone" ? SpringDrive::On::lower_wishbone
                                              : SpringDrive::On::upright;
  Wheel& wheel = corner.linkage.wheel;
  wheel.side = root.choice("side", {"left", "right"}) == "left" ? Side::left : Side::right;
  const Node hardpoint = root.table("hardpoint");
  const Vector3d contact = read_point(hardpoint, "contact");
  if ((wheel.side == Side::left) != (contact.y() > 0.0))
    root.reject("side",
                fmt::format("is {}, but the contact point has y = {:.4g} m: left is y > 0",
                            root.text("side"),
                            contact.y()));
  if (has_wishbones)
    read_wishbones(hardpoint, corner);
  else
    read_five_links(root, corner);
  read_wheel(root, hardpoint, wheel);
  read_spring(hardpoint, corner.spring);
  check_side(hardpoint, corner);
  if (const auto spring = root.find_table("spring"))
    corner.rates = {spring->quantity("stiffness", "N/m", Range::positive()),
                    spring->quantity("sprung_mass", "kg", Range::positive()),
                    spring->quantity("tire_stiffness", "N/m", Range::positive())};
  return corner;
}

}  // namespace latsch::suspension
