// SPDX-License-Identifier: Apache-2.0
// Physical parameters of the flexible ring: a belt of nodes on an elastic sidewall, with tread
// blocks on it. Values per length are per meter of the belt's circumference at rest. The equations
// are in docs/ring_tire.md, the physics is that of [Gipser 1999].
#pragma once

#include <array>
#include <vector>

namespace latsch::ring_tire {

/// Connection of node and rim along one direction: spring, damper, Maxwell element and dry friction
/// in parallel.
struct SidewallElement {
  double stiffness = 0.0;            // N/m per m
  double damping = 0.0;              // N s/m per m
  double dynamic_stiffening = 0.0;   // k_M / k of the Maxwell element
  double friction_stiffening = 0.0;  // stiffness of the friction elements before slip, over k
  double friction_force = 0.0;       // N per m, of all friction elements when they slip
};

/// The sidewall between rim and belt, per length of the circumference.
struct Sidewall {
  SidewallElement radial, tangential, lateral;  // in the directions of the belt's section
  double time_constant = 0.015;                 // s, of the Maxwell elements
  double progressivity = 0.0;         // radial: the slope grows from k to k (1 + progressivity)
  double progressive_travel = 0.015;  // m, travel of half that growth
  double rim_travel = 0.0;            // m, inward, until the belt lies on the rim; 0: no rim
  double rim_stiffness = 0.0;         // N/m per m, from rim_travel on
  double torsion = 0.0;               // N per rad, of the section relative to the rim
  double torsion_damping = 0.0;       // N s per rad
  double torsion_by_lateral = 0.0;    // rad/m, twist of the section caused by lateral travel
};

/// The belt with its plies.
struct Belt {
  double radius = 0.3;                  // m, at rest, inflated
  double mass = 8.0;                    // kg, with the tread
  double torsion_inertia = 0.0;         // kg m, of the section about the circumference, per length
  double extension = 1.0e6;             // N, EA
  double bending_in_plane = 0.0;        // N m^2, EI
  double bending_out_of_plane = 0.0;    // N m^2, EI about the radius
  double twist = 0.0;                   // N m^2, GJ
  double damping_time = 0.0;            // s, damping over stiffness of bending and twist
  double extension_damping_time = 0.0;  // s, of extension
  double bending_twist = 0.0;   // N m^2, D16 of the plies: moment of bending in plane over twist
  double conicity = 0.0;        // rad, torsion of the sections at rest; positive: left edges lower
  double bending_across = 0.0;  // N m, of the section across, per length; 0: it stays straight
  /// Share of the belt's tension that smooths the bends of sections along the ring.
  double section_coupling = 1.0;
  /// Gravity, m/s^2, downward; 0: forces as measured on a rig that is tared.
  double gravity = 0.0;
  double pressure = 0.0;        // Pa
  double pressure_width = 0.0;  // m, of the section whose pressure the belt's tension carries
};

/// Friction coefficient of tread rubber as a function of sliding speed at low, medium and high
/// pressure.
struct TreadFriction {
  std::array<double, 3> pressure = {0.5e5, 2.0e5, 5.0e5};  // Pa
  std::array<double, 3> adhesion = {1.2, 1.1, 1.0};        // at speed 0
  std::array<double, 3> maximum = {1.3, 1.2, 1.1};         // at maximum_speed
  std::array<double, 3> sliding = {1.1, 1.0, 0.9};         // at sliding_speed
  std::array<double, 3> blocking = {0.8, 0.75, 0.7};       // at and above blocking_speed
  double maximum_speed = 0.3;                              // m/s
  double sliding_speed = 5.0;                              // m/s
  double blocking_speed = 20.0;                            // m/s
};

/// The tread's rubber blocks.
struct Tread {
  int lines = 6;                 // across the width
  int blocks = 12;               // number in one line on one segment
  double width = 0.16;           // m
  double height = 0.010;         // m, of the rubber from belt to road
  double crown_radius = 0.0;     // m, of the tread's lateral curvature; 0: flat
  double young_modulus = 5.9e6;  // Pa
  double positive = 0.65;        // share of the surface that is rubber
  /// Share of the height after which a pressed block has no height left; 0: linear rubber.
  double bottoming = 0.0;
  double shear_ratio = 0.333;   // tangential over normal stiffness of a block
  double damping_time = 0.0;    // s, damping over stiffness
  TreadFriction friction = {};  // against the road
};

/// One harmonic of a run-out: amplitude cos(h (φ - angle)) at the angle φ of the belt; h is its
/// number in the list, from 1.
struct Harmonic {
  double amplitude = 0.0;  // m
  double angle = 0.0;      // rad, of the maximum; from the lowest point at spin 0 to the front
};

/// Deviations of a real tire from uniformity around its circumference.
struct Uniformity {
  double imbalance = 0.0;                // kg, on the belt
  double imbalance_angle = 0.0;          // rad, as in Harmonic
  std::vector<Harmonic> radial_runout;   // outward run-out: the tread is thicker there
  std::vector<Harmonic> lateral_runout;  // run-out of the belt at rest, to the left
};

/// Returns the run-out, m, at the angle φ of the belt.
double runout_at(const std::vector<Harmonic>& harmonics, double phi);

struct RingParameters {
  int nodes = 80;              // nodes of the belt, around the circumference
  Belt belt;                   // mass, radius and stiffness of the belt
  Sidewall sidewall;           // stiffness and damping of the sidewall
  Tread tread;                 // blocks and friction of the tread
  Uniformity uniformity = {};  // run-out and imbalance; none by default
};

}  // namespace latsch::ring_tire
