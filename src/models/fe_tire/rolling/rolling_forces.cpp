// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_forces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace latsch::fe_tire {

namespace {

/// Line of every point, and the length around for which it stands: half the way between its
/// neighbors on the line.
struct PlaceOnLine {
  int line = 0;
  double length = 0.0;  // m
};

std::vector<PlaceOnLine> places_on_lines(const RollingLines& lines, const Eigen::Matrix2Xd& x) {
  std::vector<PlaceOnLine> places(lines.points());
  for (std::size_t of = 0; of < lines.lines.size(); ++of) {
    const auto [first, last] = lines.lines[of];
    for (int k = first; k < last; ++k) {
      const int before = std::max(first, k - 1), after = std::min(last - 1, k + 1);
      const int steps = std::max(1, after - before);
      places[k] = {static_cast<int>(of), (x.col(before) - x.col(after)).norm() / steps};
    }
  }
  return places;
}

}  // namespace

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
  const std::vector<PlaceOnLine> places = places_on_lines(body.lines(), input.x);
  forces = {};
  patch.clear();
  for (int k = 0; k < input.p.size(); ++k) {
    if (!(input.p[k] > 0.0)) continue;
    const double area = body.area(k);
    const Eigen::Vector3d force = body.force(k, input, t), at = body.place(k, input);
    forces.force += force;
    forces.traction += area * t.t.col(k);
    forces.moment += (at - center).cross(force);
    forces.drive -= axis.dot((at - hub).cross(force));
    forces.friction_power -= area * t.t.col(k).dot(t.w.col(k));
    patch.push_back({input.x(0, k) - center.x(),
                     input.x(1, k) - center.y(),
                     input.p[k],
                     t.t(0, k),
                     t.t(1, k),
                     t.w(0, k),
                     t.w(1, k),
                     area,
                     contact.state.grip[k] == Grip::sticks,
                     t.limit[k],
                     places[k].length,
                     places[k].line});
  }
}

double power_balance(const RollingState& state) {
  const RollingCase& of = state.of;
  const Eigen::Vector2d& F = state.forces.traction;
  const double V_x = of.speed * std::cos(of.slip_angle), V_y = of.speed * std::sin(of.slip_angle);
  // The turning wheel carries the contact center around the point below the wheel center.
  const double offset = of.height * std::tan(of.camber);  // to the left, as the top is to the right
  const double turning = -of.turn_slip * of.speed;
  const double about_hub = state.forces.moment.z() - offset * F.x();
  return state.forces.drive * of.spin - F.x() * V_x - F.y() * V_y - about_hub * turning -
         state.forces.friction_power;
}

}  // namespace latsch::fe_tire
