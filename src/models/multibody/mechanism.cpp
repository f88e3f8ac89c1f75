// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/mechanism.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace latsch::multibody {

namespace {

/// Returns a message if an element refers to a body that does not exist or joins a body to itself.
std::string fault_of_ends(const std::string& name, int a, int b, int bodies) {
  for (const int body : {a, b})
    if (body < kGround || body >= bodies)
      return fmt::format("{} joins a body that is not there", name);
  if (a == b) return fmt::format("{} joins a body with itself", name);
  return {};
}

bool not_negative(const Eigen::Vector3d& k) { return k.allFinite() && k.minCoeff() >= 0.0; }

std::string fault_of_bushing(const std::string& name, const BushingParameters& bushing) {
  if (!not_negative(bushing.stiffness) ||
      (!(bushing.stiffness.maxCoeff() > 0.0) && bushing.parts.empty()))
    return fmt::format(
        "the bushing {} has no stiffness: it needs stiffnesses (N/m) that are not negative, and at "
        "least one above zero",
        name);
  if (!not_negative(bushing.rotational))
    return fmt::format("the bushing {} has a rotational stiffness that is negative or not a number",
                       name);
  if (!not_negative(bushing.damping) || !not_negative(bushing.rotational_damping))
    return fmt::format("the bushing {} has a damping that is negative or not a number", name);
  for (const auto& part : bushing.parts)
    if (const std::string fault = fault_of(part.law); !fault.empty())
      return fmt::format("the bushing {}: {}", name, fault);
  return {};
}

/// Returns true if the joint resists a rotation about that axis, however weakly.
bool holds_about(const Joint& joint, const Eigen::Vector3d& axis) {
  const auto resists = [&](const BushingParameters::Part& part) {
    return part.axis >= 3 && joint.axes.col(part.axis - 3).dot(axis) != 0.0;
  };
  return joint.bushing.rotational.dot((joint.axes.transpose() * axis).cwiseAbs2()) > 0.0 ||
         std::any_of(joint.bushing.parts.begin(), joint.bushing.parts.end(), resists);
}

/// Returns a message if all joints of a rod lie on one line and none of them resists a rotation of
/// the rod about it.
std::string fault_of_spin(const std::string& rod, const std::vector<const Joint*>& joints) {
  constexpr double kNear = 1e-6;  // m
  const auto from_first = [&](const Joint* joint) -> Eigen::Vector3d {
    return joint->point - joints[0]->point;
  };
  const Joint* far =
      *std::max_element(joints.begin(), joints.end(), [&](const Joint* a, const Joint* b) {
        return from_first(a).norm() < from_first(b).norm();
      });
  if (!(from_first(far).norm() > kNear)) return {};
  const Eigen::Vector3d line = from_first(far).normalized();
  for (const Joint* joint : joints)
    if (from_first(joint).cross(line).norm() > kNear || holds_about(*joint, line)) return {};
  return fmt::format(
      "{} spins freely from {} to {}: the bushings there have no rotational stiffness (about_x, "
      "about_y, about_z), one of them needs some",
      rod,
      joints[0]->name,
      far->name);
}

std::string fault_of_strut(const Strut& strut, int bodies, int drivers) {
  if (strut.lines.empty()) return fmt::format("{} has no line to act along", strut.name);
  if (strut.driver < -1 || strut.driver >= drivers)
    return fmt::format("{} has a driver that is not there", strut.name);
  for (const StrutLine& line : strut.lines) {
    if (std::string fault = fault_of_ends(strut.name, line.a, line.b, bodies); !fault.empty())
      return fault;
    if (!((line.point_b - line.point_a).norm() > 1e-6) || !std::isfinite(line.weight))
      return fmt::format("both ends of {} coincide, or are undefined", strut.name);
  }
  for (const double number : {strut.stiffness, strut.damping, strut.inertance})
    if (!(number >= 0.0) || !std::isfinite(number))
      return fmt::format(
          "{} has a stiffness, damping or inertance that is negative or not a number", strut.name);
  if (!std::isfinite(strut.preload))
    return fmt::format("the preload of {} is not a number", strut.name);
  for (const ForcePart& part : strut.parts)
    if (const std::string fault = fault_of(part); !fault.empty())
      return fmt::format("{}: {}", strut.name, fault);
  return {};
}

/// Checks massless bodies with joints and no struts for free spin. Bodies with mass are not
/// checked, because they may spin in motion.
std::string fault_of_rods(const std::vector<Body>& bodies,
                          const std::vector<Joint>& joints,
                          const std::vector<Strut>& struts) {
  for (int i = 0; i < static_cast<int>(bodies.size()); ++i) {
    const Body& body = bodies[static_cast<std::size_t>(i)];
    const bool has_strut = std::any_of(struts.begin(), struts.end(), [&](const Strut& strut) {
      return std::any_of(strut.lines.begin(), strut.lines.end(), [&](const StrutLine& line) {
        return line.a == i || line.b == i;
      });
    });
    if (body.mass > 0.0 || has_strut) continue;
    std::vector<const Joint*> own;
    for (const Joint& joint : joints)
      if (joint.a == i || joint.b == i) own.push_back(&joint);
    if (std::string fault = fault_of_spin(body.name, own); !fault.empty()) return fault;
  }
  return {};
}

}  // namespace

std::string Mechanism::fault(const std::vector<Body>& bodies,
                             const std::vector<Joint>& joints,
                             const std::vector<Strut>& struts,
                             int drivers) {
  const int count = static_cast<int>(bodies.size());
  std::vector<bool> held(bodies.size(), false);
  for (const Body& body : bodies)
    if (!body.origin.allFinite())
      return fmt::format("the position of {} is not a number", body.name);
  const auto hold = [&](int body) {
    if (body != kGround) held[static_cast<std::size_t>(body)] = true;
  };
  for (const Joint& joint : joints) {
    if (std::string fault = fault_of_ends(joint.name, joint.a, joint.b, count); !fault.empty())
      return fault;
    if (!joint.point.allFinite())
      return fmt::format("the position of {} is not a number", joint.name);
    if (joint.driver < -1 || joint.driver >= drivers)
      return fmt::format("{} has a driver that is not there", joint.name);
    if (std::string fault = fault_of_bushing(joint.name, joint.bushing); !fault.empty())
      return fault;
    hold(joint.a);
    hold(joint.b);
  }
  for (const Strut& strut : struts)
    if (std::string fault = fault_of_strut(strut, count, drivers); !fault.empty()) return fault;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!held[i] && !(bodies[i].mass > 0.0))
      return fmt::format("nothing holds {}: it has no joint", bodies[i].name);
  return fault_of_rods(bodies, joints, struts);
}

std::string Mechanism::fault_in_motion(const std::vector<Body>& bodies) {
  for (const Body& body : bodies) {
    if (!(body.mass > 0.0) || !std::isfinite(body.mass))
      return fmt::format("{} has no mass: what moves needs one above zero", body.name);
    const Eigen::Matrix3d& I = body.inertia;
    if (!I.allFinite() || (I - I.transpose()).norm() > 1e-9 * I.norm())
      return fmt::format("the inertia of {} is not symmetric or no number", body.name);
    // The matrix trace(I)/2 - I holds the second moments of mass. A real body has positive ones,
    // since I1 < I2 + I3.
    const Eigen::Matrix3d moments = 0.5 * I.trace() * Eigen::Matrix3d::Identity() - I;
    const double slack = 1e-9 * I.trace();
    const bool possible = I.trace() > 0.0 && moments.diagonal().minCoeff() >= -slack &&
                          moments.determinant() >= -slack * I.trace() * I.trace() &&
                          I.determinant() > 0.0;
    if (!possible)
      return fmt::format(
          "the inertia of {} is none of a body: each moment is positive and below the sum of the "
          "other two",
          body.name);
  }
  return {};
}

Mechanism::Mechanism(std::vector<Body> bodies,
                     std::vector<Joint> joints,
                     std::vector<Strut> struts,
                     int drivers,
                     const Eigen::Vector3d& gravity)
    : bodies_(std::move(bodies)),
      joints_(std::move(joints)),
      struts_(std::move(struts)),
      drivers_(drivers),
      gravity_(gravity) {
  assert(fault(bodies_, joints_, struts_, drivers_).empty());
  const auto from_origin = [&](int body, const Eigen::Vector3d& point) -> Eigen::Vector3d {
    return body == kGround ? point : point - bodies_[static_cast<std::size_t>(body)].origin;
  };
  for (const Joint& joint : joints_) {
    places_.push_back({from_origin(joint.a, joint.point),
                       from_origin(joint.b, joint.point),
                       joint.axes,
                       joint.axes});
    joint_memory_.push_back(memories_);
    memories_ += joint.bushing.parts.size();
  }
  for (const Strut& strut : struts_) {
    auto& ends = ends_.emplace_back();
    double length = 0.0;
    for (const StrutLine& line : strut.lines) {
      ends.emplace_back(from_origin(line.a, line.point_a), from_origin(line.b, line.point_b));
      length += line.weight * (line.point_b - line.point_a).norm();
    }
    rest_lengths_.push_back(length);
    strut_memory_.push_back(memories_);
    memories_ += strut.parts.size();
  }
}

double Mechanism::mass() const {
  double sum = 0.0;
  for (const Body& body : bodies_) sum += body.mass;
  return sum;
}

Poses Mechanism::at_rest() const {
  Poses poses;
  for (const Body& body : bodies_) poses.push_back({.place = body.origin});
  return poses;
}

std::vector<std::pair<int, int>> Mechanism::pairs() const {
  std::vector<std::pair<int, int>> pairs;
  for (const Joint& joint : joints_)
    if (joint.a != kGround && joint.b != kGround) pairs.emplace_back(joint.a, joint.b);
  for (const Strut& strut : struts_) {
    std::vector<int> bodies;
    for (const StrutLine& line : strut.lines)
      for (const int body : {line.a, line.b})
        if (body != kGround) bodies.push_back(body);
    for (const int i : bodies)
      for (const int j : bodies)
        if (i < j) pairs.emplace_back(i, j);
  }
  return pairs;
}

}  // namespace latsch::multibody
