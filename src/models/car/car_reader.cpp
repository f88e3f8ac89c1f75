// SPDX-License-Identifier: Apache-2.0
#include "models/car/car_reader.h"

#include <fmt/format.h>

#include "base/error.h"
#include "models/suspension/bushing_reader.h"
#include "models/suspension/suspension_reader.h"

namespace latsch::car {
namespace {

using Eigen::Vector3d;

Vector3d read_three(const Node& node, const char* key, const char* unit) {
  const std::vector<double> values = node.quantities(key, unit);
  if (values.size() != 3)
    node.reject(key, fmt::format("has {} values, expected three", values.size()));
  return {values[0], values[1], values[2]};
}

Chassis read_chassis(const Node& node) {
  Chassis chassis;
  chassis.body.mass = node.quantity("mass", "kg", Range::positive());
  chassis.body.center = read_three(node, "center", "m");
  const Vector3d moments = node.has("inertia") ? read_three(node, "inertia", "kg m^2")
                                               : Vector3d(node.quantity("inertia_xx", "kg m^2"),
                                                          node.quantity("inertia_yy", "kg m^2"),
                                                          node.quantity("inertia_zz", "kg m^2"));
  chassis.body.inertia = moments.asDiagonal();
  const double xz = node.quantity("inertia_xz", "kg m^2", {}, 0.0);
  chassis.body.inertia(0, 2) = chassis.body.inertia(2, 0) = -xz;
  if (!node.has("torsion")) return chassis;
  Chassis::Torsion torsion{
      node.quantity("torsion", "N m/rad", Range::positive()),
      node.quantity("torsion_damping", "N m s/rad", Range::not_negative(), 0.0),
      chassis.body.center.x(),
      chassis.body.center.z()};
  if (node.has("torsion_at")) {
    const auto at = node.quantities("torsion_at", "m");
    if (at.size() != 2) node.reject("torsion_at", "expected two values, x and z");
    torsion.x = at[0];
    torsion.z = at[1];
  }
  chassis.torsion = torsion;
  return chassis;
}

SpringUnit read_unit(const Node& node) {
  SpringUnit unit;
  unit.stiffness = node.quantity("stiffness", "N/m", Range::not_negative(), 0.0);
  if (node.has("damper")) {
    if (node.has("damping")) node.reject("damper", "is given beside damping, expected one of them");
    unit.parts.push_back(
        multibody::ViscousCurve{suspension::read_curve(node, "damper", "m/s", "N")});
  } else {
    unit.damping = node.quantity("damping", "N s/m", Range::not_negative(), 0.0);
  }
  unit.inertance = node.quantity("inertance", "kg", Range::not_negative(), 0.0);
  if (node.has("curve"))
    unit.parts.push_back(
        multibody::ElasticCurve{suspension::read_curve(node, "curve", "m", "N", unit.stiffness)});
  return unit;
}

AxleMasses read_masses(const Node& axle) {
  AxleMasses masses;
  const Node mass = axle.table("mass"), inertia = axle.table("inertia");
  masses.upper_wishbone = mass.quantity("upper_wishbone", "kg", Range::positive());
  masses.lower_wishbone = mass.quantity("lower_wishbone", "kg", Range::positive());
  masses.pushrod = mass.quantity("pushrod", "kg", Range::positive());
  masses.trackrod = mass.quantity("trackrod", "kg", Range::positive());
  masses.upright.mass = mass.quantity("upright", "kg", Range::positive());
  masses.upright.inertia = read_three(inertia, "upright", "kg m^2").asDiagonal();
  masses.wheel = mass.quantity("wheel", "kg", Range::not_negative());
  masses.wheel_spin = inertia.quantity("wheel_spin", "kg m^2", Range::positive());
  masses.wheel_across = inertia.quantity("wheel_across", "kg m^2", Range::not_negative());
  return masses;
}

/// Reads the rocker of an axle. Its hardpoints are among those of the suspension.
Inboard read_inboard(const Node& axle, const Node& suspension, const Vector3d& rod) {
  const Node points = suspension.table("hardpoint");
  Inboard inboard;
  inboard.pivot = read_three(points, "rocker_pivot", "m");
  inboard.damper = read_three(points, "rocker_damper", "m");
  inboard.damper_on_chassis = read_three(points, "damper_chassis", "m");
  const Vector3d axis = points.has("rocker_axis")
                            ? Vector3d(read_three(points, "rocker_axis", "m") - inboard.pivot)
                            : (rod - inboard.pivot).cross(inboard.damper - inboard.pivot);
  if (!(axis.norm() > 1e-6))
    points.reject("rocker_pivot", "is in line with the ends of its arms: the rocker has no axis");
  inboard.axis = axis.normalized();
  inboard.unit = read_unit(axle.table("spring"));
  inboard.rocker_mass = axle.table("mass").quantity("rocker", "kg", Range::positive());
  if (const auto bar = axle.find_table("anti_roll_bar"))
    inboard.bar = Inboard::AntiRollBar{read_three(points, "rocker_arb_link", "m"),
                                       read_three(points, "arb_link_blade", "m"),
                                       bar->quantity("stiffness", "N/m", Range::positive())};
  if (const auto third = axle.find_table("third")) inboard.heave = read_unit(*third);
  return inboard;
}

Axle read_axle(const Node& root, const std::string& name) {
  const Node node = root.table(name), suspension = root.table(name + "_suspension");
  Axle axle;
  axle.corner = suspension::read_suspension(suspension);
  axle.masses = read_masses(node);
  axle.camber = node.quantity("camber", "rad", Range::between(-0.5, 0.5), 0.0);
  axle.toe = node.quantity("toe", "rad", Range::between(-0.5, 0.5), 0.0);
  const bool is_locked = node.flag("locked", false);
  // The springs may be locked, that is replaced by bars. The file may then still contain the keys
  // of the springs, which are checked.
  if (is_locked && node.table("mass").has("rocker"))
    node.table("mass").quantity("rocker", "kg", Range::positive());
  if (is_locked && !node.has("spring")) return axle;
  const Inboard inboard =
      read_inboard(node, suspension, axle.corner.points[suspension::DoubleWishbone::kPushrodInner]);
  if (!is_locked) axle.inboard = inboard;
  return axle;
}

std::optional<AeroMap> read_aero(const Node& root) {
  const auto node = root.find_table("aero");
  if (!node) return std::nullopt;
  AeroMap aero;
  aero.area = node->quantity("area", "m^2", Range::positive());
  aero.density = node->quantity("density", "kg/m^3", Range::positive(), aero.density);
  aero.drag = node->quantity("drag", "1", Range::not_negative(), 0.0);
  aero.drag_height = node->quantity("drag_height", "m", Range::not_negative(), 0.0);
  if (node->has("floor")) {
    const auto floor = node->quantities("floor", "m");
    if (floor.size() != 2) node->reject("floor", "expected two values, front and rear");
    aero.floor_front = floor[0];
    aero.floor_rear = floor[1];
  }
  std::vector<AeroMap::Row> rows;
  for (const auto& row : node->rows("map", {"m", "m", "1", "1"}))
    rows.push_back({row[0], row[1], row[2], row[3]});
  if (const std::string fault = AeroMap::fault(rows); !fault.empty()) node->reject("map", fault);
  node->close();
  if (rows.size() > 1 && !node->has("floor"))
    node->reject("map", "depends on heights of the floor: floor is missing");
  aero.set_rows(rows);
  return aero;
}

std::optional<SpringTireParameters> read_spring_tire(const Node& root, const std::string& name) {
  const auto tire = root.table(name).find_table("spring_tire");
  if (!tire) return std::nullopt;
  return SpringTireParameters{tire->quantity("radius", "m", Range::positive()),
                              tire->quantity("stiffness", "N/m", Range::positive()),
                              tire->quantity("damping", "N s/m", Range::not_negative(), 0.0)};
}

}  // namespace

CarFile read_car(const Node& root) {
  root.choice("kind", {"car"});
  root.text("title", "");
  CarFile file;
  file.parameters.chassis = read_chassis(root.table("chassis"));
  file.parameters.front = read_axle(root, "front");
  file.parameters.rear = read_axle(root, "rear");
  file.parameters.front.steered = true;
  file.parameters.gravity =
      root.quantity("gravity", "m/s^2", Range::not_negative(), file.parameters.gravity);
  file.parameters.aero = read_aero(root);
  file.front_spring_tire = read_spring_tire(root, "front");
  file.rear_spring_tire = read_spring_tire(root, "rear");
  if (const auto driver = root.find_table("driver")) {
    file.driver_line = driver->quantity("line", "m", Range::between(-10.0, 10.0), 0.0);
    const std::string axle = driver->choice("drives", {"rear", "front", "both"}, "rear");
    if (axle == "front") file.drives = {1.0, 0.0};
    if (axle == "both") file.drives = {0.5, 0.5};
    driver->close();
  }
  root.table("chassis").close();
  root.table("front").close();
  root.table("rear").close();
  if (const std::string fault = file.parameters.fault(); !fault.empty())
    throw InputError(root.place(), fault);
  return file;
}

}  // namespace latsch::car
