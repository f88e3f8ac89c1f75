// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/description/ring_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace latsch::ring_tire {
namespace {

constexpr long kMostNodes = 1000, kMostBlocks = 500, kMostLines = 100;

SidewallElement read_element(const Node& node) {
  SidewallElement e;
  e.stiffness = node.quantity("stiffness", "N/m^2", Range::positive());
  e.damping = node.quantity("damping", "N s/m^2", Range::not_negative());
  e.dynamic_stiffening =
      node.quantity("dynamic_stiffening", "1", Range::not_negative(), e.dynamic_stiffening);
  e.friction_stiffening =
      node.quantity("friction_stiffening", "1", Range::not_negative(), e.friction_stiffening);
  e.friction_force =
      node.quantity("friction_force", "N/m", Range::not_negative(), e.friction_force);
  return e;
}

/// Reads the contact of the belt with the rim.
void read_rim(const Node& node, Sidewall& s) {
  s.rim_travel = node.quantity("travel", "m", Range::positive());
  s.rim_stiffness = node.quantity("stiffness", "N/m^2", Range::positive());
}

/// Scales the springs with the pressure: the share `pressure_share` of each is due to the pressure
/// at `reference_pressure`, the rest is the sidewall's own.
void stiffen_by_pressure(const Node& node, double pressure, Sidewall& s) {
  const double share = node.quantity("pressure_share", "1", Range::between(0.0, 1.0), 0.0);
  if (share == 0.0 && !node.has("reference_pressure")) return;
  const double reference = node.quantity("reference_pressure", "Pa", Range::positive());
  const double factor = 1.0 + share * (pressure / reference - 1.0);
  if (!(factor > 0.0))
    node.reject("pressure_share", "leaves a sidewall without stiffness at this pressure");
  for (SidewallElement* e : {&s.radial, &s.tangential, &s.lateral}) e->stiffness *= factor;
}

Sidewall read_sidewall(const Node& node, double pressure) {
  Sidewall s;
  s.radial = read_element(node.table("radial"));
  s.tangential = read_element(node.table("tangential"));
  s.lateral = read_element(node.table("lateral"));
  s.time_constant = node.quantity("time_constant", "s", Range::positive(), s.time_constant);
  s.progressivity = node.quantity("progressivity", "1", Range::not_negative(), s.progressivity);
  s.progressive_travel =
      node.quantity("progressive_travel", "m", Range::positive(), s.progressive_travel);
  stiffen_by_pressure(node, pressure, s);
  if (const auto rim = node.find_table("rim")) read_rim(*rim, s);
  s.torsion = node.quantity("torsion", "N/rad", Range::not_negative());
  s.torsion_damping = node.quantity("torsion_damping", "N s/rad", Range::not_negative(), 0.0);
  s.torsion_by_lateral = node.quantity("torsion_by_lateral", "rad/m", {}, 0.0);
  return s;
}

/// Rejects keys that have other meanings elsewhere.
void reject_old_names(const Node& belt) {
  for (const auto& [old, now] : {std::pair{"bending_lateral", "bending_out_of_plane"},
                                 std::pair{"section_bending", "bending_across"}}) {
    if (belt.has(old)) belt.reject(old, fmt::format("is called {} now", now));
  }
}

Belt read_belt(const Node& node, double pressure) {
  reject_old_names(node);
  Belt belt;
  belt.radius = node.quantity("radius", "m", Range::positive());
  belt.mass = node.quantity("mass", "kg", Range::positive());
  belt.torsion_inertia = node.quantity("torsion_inertia", "kg m", Range::positive());
  belt.extension = node.quantity("extension", "N", Range::positive());
  belt.bending_in_plane = node.quantity("bending_in_plane", "N m^2", Range::not_negative());
  belt.bending_out_of_plane = node.quantity("bending_out_of_plane", "N m^2", Range::not_negative());
  belt.twist = node.quantity("twist", "N m^2", Range::not_negative());
  belt.bending_twist = node.quantity("bending_twist", "N m^2", {}, 0.0);
  if (belt.bending_twist * belt.bending_twist > belt.bending_in_plane * belt.twist)
    node.reject("bending_twist",
                fmt::format("leaves a belt that bends and twists by itself, expected at most the "
                            "root of bending_in_plane times twist, {:.3g} N m^2",
                            std::sqrt(belt.bending_in_plane * belt.twist)));
  belt.conicity = node.quantity("conicity", "rad", Range::between(-0.1, 0.1), 0.0);
  belt.damping_time = node.quantity("damping_time", "s", Range::not_negative(), 0.0);
  belt.extension_damping_time =
      node.quantity("extension_damping_time", "s", Range::not_negative(), 0.0);
  belt.bending_across = node.quantity("bending_across", "N m", Range::not_negative(), 0.0);
  belt.section_coupling = node.quantity("section_coupling", "1", Range::not_negative(), 1.0);
  belt.gravity = node.quantity("gravity", "m/s^2", Range::not_negative(), 0.0);
  belt.pressure = pressure;
  belt.pressure_width = node.quantity("pressure_width", "m", Range::not_negative());
  return belt;
}

std::array<double, 3> three(const Node& node, const char* key, const char* unit) {
  const auto values = node.quantities(key, unit, Range::not_negative());
  if (values.size() != 3)
    node.reject(key,
                fmt::format("has {} values, expected three: at low, medium and high pressure",
                            values.size()));
  return {values[0], values[1], values[2]};
}

TreadFriction read_friction(const Node& node) {
  TreadFriction f;
  f.pressure = three(node, "pressure", "Pa");
  if (!(f.pressure[0] < f.pressure[1] && f.pressure[1] < f.pressure[2]))
    node.reject("pressure", "does not rise, expected low, medium and high pressure");
  f.adhesion = three(node, "adhesion", "1");
  f.maximum = three(node, "maximum", "1");
  f.sliding = three(node, "sliding", "1");
  f.blocking = three(node, "blocking", "1");
  f.maximum_speed = node.quantity("maximum_speed", "m/s", Range::positive());
  f.sliding_speed = node.quantity("sliding_speed", "m/s", {f.maximum_speed, 1e3, true});
  f.blocking_speed = node.quantity("blocking_speed", "m/s", {f.sliding_speed, 1e3, true});
  return f;
}

double read_modulus(const Node& node) {
  if (!node.has("shore_a")) return node.quantity("young_modulus", "Pa", Range::positive());
  if (node.has("young_modulus"))
    node.reject("young_modulus", "is given beside shore_a, expected one of them");
  return young_modulus_of_shore_a(node.quantity("shore_a", "1", Range::between(20.0, 95.0)));
}

Tread read_tread(const Node& node) {
  Tread tread;
  tread.lines = static_cast<int>(node.integer("lines", 1, kMostLines, tread.lines));
  tread.blocks = static_cast<int>(node.integer("blocks", 1, kMostBlocks, tread.blocks));
  tread.width = node.quantity("width", "m", Range::positive());
  tread.height = node.quantity("height", "m", Range::positive());
  tread.crown_radius = node.quantity("crown_radius", "m", Range::positive(), 0.0);
  tread.young_modulus = read_modulus(node);
  tread.positive = node.quantity("positive", "1", {0.0, 1.0, true}, tread.positive);
  tread.bottoming = node.quantity("bottoming", "1", Range::between(0.0, 1.0), 0.0);
  tread.shear_ratio = node.quantity("shear_ratio", "1", Range::positive(), tread.shear_ratio);
  tread.damping_time = node.quantity("damping_time", "s", Range::not_negative(), 0.0);
  if (const auto friction = node.find_table("friction")) tread.friction = read_friction(*friction);
  return tread;
}

std::vector<Harmonic> read_runout(const Node& node,
                                  const std::string& key,
                                  double most,
                                  int nodes) {
  if (!node.has(key)) return {};
  const auto amplitudes = node.quantities(key, "m", Range::between(0.0, most));
  const std::string of_angles = key + "_angle";
  std::vector<double> angles(amplitudes.size(), 0.0);
  if (node.has(of_angles)) angles = node.quantities(of_angles, "rad");
  if (angles.size() != amplitudes.size())
    node.reject(of_angles,
                fmt::format("has {} values, expected one for each of the {} harmonics of {}",
                            angles.size(),
                            amplitudes.size(),
                            key));
  if (4 * amplitudes.size() > static_cast<std::size_t>(nodes))
    node.reject(key, "has more harmonics than the belt shows, expected four nodes for each");
  std::vector<Harmonic> harmonics;
  for (std::size_t i = 0; i < amplitudes.size(); ++i)
    harmonics.push_back({.amplitude = amplitudes[i], .angle = angles[i]});
  return harmonics;
}

Uniformity read_uniformity(const Node& node, const RingParameters& ring) {
  Uniformity u;
  u.imbalance = node.quantity("imbalance", "kg", Range::between(0.0, ring.belt.mass), 0.0);
  u.imbalance_angle = node.quantity("imbalance_angle", "rad", {}, 0.0);
  constexpr double kMost = 0.01;  // m
  u.radial_runout = read_runout(node, "radial_runout", kMost, ring.nodes);
  u.lateral_runout = read_runout(node, "lateral_runout", kMost, ring.nodes);
  return u;
}

}  // namespace

double young_modulus_of_shore_a(double hardness) {
  return std::pow(10.0, 5.33905 + 0.020477 * hardness);
}

RingParameters read_ring_tire(const Node& root) {
  root.choice("kind", {"ring_tire"});
  root.choice("side", {"left", "right"}, "left");  // also used by car_kind.cpp
  root.text("title", "");
  RingParameters ring;
  const Node belt = root.table("belt");
  ring.nodes = static_cast<int>(belt.integer("nodes", 16, kMostNodes, ring.nodes));
  const double pressure = root.quantity("pressure", "Pa", Range::not_negative());
  ring.belt = read_belt(belt, pressure);
  ring.sidewall = read_sidewall(root.table("sidewall"), pressure);
  if (ring.sidewall.rim_travel >= ring.belt.radius)
    root.table("sidewall")
        .table("rim")
        .reject("travel", "reaches the axle, expected less than the belt's radius");
  ring.tread = read_tread(root.table("tread"));
  if (ring.tread.crown_radius > 0.0) {
    const double half = 0.5 * ring.tread.width;
    if (half * half > 2.0 * ring.tread.crown_radius * ring.tread.height)
      root.table("tread").reject("crown_radius",
                                 "is so small that the shoulders have no rubber, expected more");
  }
  if (const auto node = root.find_table("uniformity"))
    ring.uniformity = read_uniformity(*node, ring);
  root.close();
  return ring;
}

}  // namespace latsch::ring_tire
