// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/rolling_forces.h"

#include <Eigen/Geometry>

namespace latsch::fe_tire {

void measure(const TreadBody& body,
             const RollingContactState& contact,
             const RollingCase& of,
             RollingForces& forces,
             std::vector<RollingPatchPoint>& patch) {
  const PosedGround ground({}, {.height = of.height, .camber = of.camber});
  const Eigen::Vector3d hub = ground.in_ground(Eigen::Vector3d::Zero());
  const Eigen::Vector3d axis = ground.in_ground(Eigen::Vector3d::UnitY()) - hub;
  const Eigen::Vector3d down = ground.in_ground(-Eigen::Vector3d::UnitZ()) - hub;
  const Eigen::Vector3d center = hub + hub.z() / -down.z() * down;
  const RollingInput& input = contact.input;
  const GripTractions& t = contact.tractions;
  forces = {};
  patch.clear();
  for (Eigen::Index k = 0; k < input.p.size(); ++k) {
    if (!(input.p[k] > 0.0)) continue;
    const double area = body.area(static_cast<int>(k));
    const Eigen::Vector3d force = area * Eigen::Vector3d(t.t(0, k), t.t(1, k), input.p[k]);
    const Eigen::Vector3d at(input.x(0, k), input.x(1, k), 0.0);
    forces.force += force;
    forces.moment += (at - center).cross(force);
    forces.drive -= axis.dot((at - hub).cross(force));
    forces.friction_power -= area * t.t.col(k).dot(t.w.col(k));
    patch.push_back({at.x() - center.x(),
                     at.y() - center.y(),
                     input.p[k],
                     t.t(0, k),
                     t.t(1, k),
                     t.w(0, k),
                     t.w(1, k),
                     area,
                     contact.state.grip[k] == Grip::sticks});
  }
}

}  // namespace latsch::fe_tire
