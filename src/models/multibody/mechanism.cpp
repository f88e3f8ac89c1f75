// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/mechanism.h"

#include <fmt/format.h>

#include <cassert>

namespace latsch::multibody {

std::string Mechanism::fault(const std::vector<Body>& bodies, const std::vector<Joint>& joints) {
  const int count = static_cast<int>(bodies.size());
  std::vector<bool> held(bodies.size(), false);
  for (const Body& body : bodies)
    if (!body.origin.allFinite())
      return fmt::format("{} is at a place that is no number", body.name);
  for (const Joint& joint : joints) {
    for (const int body : {joint.a, joint.b}) {
      if (body < kGround || body >= count)
        return fmt::format("{} joins a body that is not there", joint.name);
      if (body != kGround) held[static_cast<std::size_t>(body)] = true;
    }
    if (joint.a == joint.b) return fmt::format("{} joins a body with itself", joint.name);
    if (!joint.point.allFinite())
      return fmt::format("{} is at a place that is no number", joint.name);
    const auto positive = [](const Eigen::Vector3d& k) {
      return k.allFinite() && k.minCoeff() >= 0.0 && k.maxCoeff() > 0.0;
    };
    if (!positive(joint.bushing.stiffness))
      return fmt::format(
          "the bushing {} has no stiffness: numbers of N/m not below zero, one of them above, are "
          "needed",
          joint.name);
    const Eigen::Vector3d& c = joint.bushing.rotational;
    if (!c.allFinite() || c.minCoeff() < 0.0)
      return fmt::format(
          "the bushing {} has a rotational stiffness below zero or that is no number", joint.name);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!held[i]) return fmt::format("nothing holds {}: it has no joint", bodies[i].name);
  return {};
}

Mechanism::Mechanism(std::vector<Body> bodies, std::vector<Joint> joints)
    : bodies_(std::move(bodies)), joints_(std::move(joints)) {
  assert(fault(bodies_, joints_).empty());
  const auto from_origin = [&](int body, const Eigen::Vector3d& point) -> Eigen::Vector3d {
    return body == kGround ? point : point - bodies_[static_cast<std::size_t>(body)].origin;
  };
  for (const Joint& joint : joints_)
    places_.push_back({from_origin(joint.a, joint.point),
                       from_origin(joint.b, joint.point),
                       joint.axes,
                       joint.axes});
}

void Mechanism::set_bushings(const std::vector<BushingParameters>& bushings) {
  assert(bushings.size() == joints_.size());
  for (std::size_t i = 0; i < bushings.size(); ++i) joints_[i].bushing = bushings[i];
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
  return pairs;
}

}  // namespace latsch::multibody
