// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/kc_rig.h"

#include <fmt/format.h>

#include <algorithm>

namespace latsch::experiment {
namespace {

using multibody::Vector6d;

Vector6d as_vector(const suspension::WheelPosition& at) {
  Vector6d v;
  v << at.contact, at.camber, at.toe, at.caster;
  return v;
}

const char* unit_of_moved(int i) { return i < 3 ? "m" : "rad"; }
const char* unit_of_load(int i) { return i < 3 ? "N" : "N m"; }

/// Returns a Failure that names a bushing whose stretch is impossible: stiffnesses are then in
/// another unit, or the loads are too large for any corner.
Status check_bushings(const multibody::Mechanism& mechanism, const multibody::Poses& poses) {
  constexpr double kMostStretch = 0.03;  // m
  const auto pose = [&](int body) {
    return body == multibody::kGround ? multibody::Pose{} : poses[static_cast<std::size_t>(body)];
  };
  double most = 0.0;
  std::size_t torn = 0;
  for (std::size_t i = 0; i < mechanism.joints().size(); ++i) {
    const multibody::Joint& joint = mechanism.joints()[i];
    const double stretch =
        strain_of(mechanism.place(static_cast<int>(i)), pose(joint.a), pose(joint.b)).d.norm();
    if (stretch <= most) continue;
    most = stretch;
    torn = i;
  }
  if (most <= kMostStretch) return {};
  return Failure{fmt::format(
      "the bushing {} is stretched by {:.3g} mm, more than any bushing bears: are stiffnesses N/m "
      "that should be N/mm, or loads N that should be kN?",
      mechanism.joints()[torn].name,
      1e3 * most)};
}

}  // namespace

Result<Channels> run(const suspension::CompliantCorner& corner,
                     const KcTest& test,
                     const KcSlopes& asked,
                     const RigWatcher& watch) {
  const multibody::Mechanism mechanism(corner.bodies, corner.joints);
  const multibody::Assembly assembly(mechanism);
  const RigState::Wheel wheel{"", corner.upright, corner.wheel_center, corner.contact};
  multibody::Equilibrium statics(mechanism);
  const auto upright_body = static_cast<std::size_t>(corner.upright);
  suspension::WheelPoints points = corner.wheel;
  multibody::Load on{corner.upright, corner.contact};
  if (test.at_wheel_center) {
    points.contact = points.center;
    on.point = corner.wheel_center;
  }
  multibody::Rest stands = statics.unloaded();  // friction remembers earlier loads
  const multibody::Poses& poses = stands.poses;
  const Vector6d rest = as_vector(wheel_position(points, poses[upright_body]));
  const Eigen::Index states = test.loads.cols();
  const auto numbers = static_cast<Eigen::Index>(asked.varied.size());
  const auto is_asked = [&](const std::string& channel) {
    return numbers > 0 &&
           std::find(asked.channels.begin(), asked.channels.end(), channel) != asked.channels.end();
  };
  std::vector<int> followed;  // indices of the channels whose slopes are requested
  for (int m = 0; m < 6; ++m) {
    const std::string name = KcTest::kMoved[static_cast<std::size_t>(m)];
    if (is_asked(name) || (test.slopes && is_asked(test.slopes->name(name)))) followed.push_back(m);
  }
  Eigen::MatrixXd moved(states, 6);
  std::vector<Eigen::MatrixXd> slopes(6, Eigen::MatrixXd::Zero(states, numbers));
  for (Eigen::Index i = 0; i < states; ++i) {
    on.force = test.loads.col(i).head<3>();
    on.moment = test.loads.col(i).tail<3>();
    const multibody::RestSettings standing{.loads = {&on, 1}};
    auto found = statics.solve(standing, stands);
    if (!found)
      return Failure{fmt::format("state {} of the K&C rig: {}", i + 1, found.failure().reason)};
    stands = std::move(*found);
    if (const Status held = check_bushings(mechanism, poses); !held)
      return Failure{fmt::format("state {} of the K&C rig: {}", i + 1, held.failure().reason)};
    if (watch) watch({mechanism, assembly, stands, {&on, 1}, {&wheel, 1}, i});
    const multibody::Pose& upright = poses[upright_body];
    moved.row(i) = as_vector(wheel_position(points, upright)) - rest;
    if (followed.empty()) continue;
    if (const Status done = statics.linearize(stands, standing); !done)
      return Failure{fmt::format("state {} of the K&C rig: {}", i + 1, done.failure().reason)};
    Eigen::MatrixXd by_pose =
        Eigen::MatrixXd::Zero(6 * std::ssize(corner.bodies), std::ssize(followed));
    by_pose.middleRows<6>(6 * corner.upright) =
        wheel_slopes(points, upright).transpose()(Eigen::all, followed);
    const Eigen::MatrixXd by_stiffness = statics.by_stiffness(poses, by_pose);
    for (Eigen::Index f = 0; f < std::ssize(followed); ++f)
      for (Eigen::Index v = 0; v < numbers; ++v) {
        double slope = 0.0;
        for (const auto& [joint, axis] : asked.varied[static_cast<std::size_t>(v)])
          slope += by_stiffness(f, 6 * joint + axis);
        const int m = followed[static_cast<std::size_t>(f)];
        slopes[static_cast<std::size_t>(m)](i, v) = slope;
      }
  }
  Channels channels;
  const auto add = [&](std::string name,
                       std::string unit,
                       const Eigen::VectorXd& values,
                       const Eigen::MatrixXd& by) {
    channels.add({std::move(name),
                  std::move(unit),
                  {values.begin(), values.end()},
                  {by.data(), by.data() + by.size()}});
  };
  for (std::size_t i = 0; i < 6; ++i)
    if (test.stated[i])
      add(KcTest::kLoads[i],
          unit_of_load(static_cast<int>(i)),
          test.loads.row(static_cast<Eigen::Index>(i)).transpose(),
          Eigen::MatrixXd::Zero(states, numbers));
  for (int m = 0; m < 6; ++m)
    add(KcTest::kMoved[static_cast<std::size_t>(m)],
        unit_of_moved(m),
        moved.col(m),
        slopes[static_cast<std::size_t>(m)]);
  if (test.slopes)
    add_slopes(*test.slopes, {KcTest::kMoved.begin(), KcTest::kMoved.end()}, channels);
  return with_slopes_of(asked.channels, channels);
}

}  // namespace latsch::experiment
