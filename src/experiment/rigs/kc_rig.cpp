// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/kc_rig.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/multibody/equilibrium.h"

namespace latsch::experiment {
namespace {

using multibody::Vector6d;
using suspension::DoubleWishbone;

Vector6d as_vector(const suspension::WheelPosition& at) {
  Vector6d v;
  v << at.contact, at.camber, at.toe, at.caster;
  return v;
}

const char* unit_of_moved(int i) { return i < 3 ? "m" : "rad"; }
const char* unit_of_load(int i) { return i < 3 ? "N" : "N m"; }

}  // namespace

std::string KcTest::slope_name(int moved) const {
  return fmt::format("{}_by_{}",
                     kMoved[static_cast<std::size_t>(moved)],
                     kLoads[static_cast<std::size_t>(*slopes_by)]);
}

std::string KcTest::slope_unit(int moved) const {
  if (*slopes_by >= 3 && moved < 3) return "1/N";  // m/(N m)
  return unit_of_moved(moved) + std::string(*slopes_by < 3 ? "/N" : "/(N m)");
}

Eigen::VectorXd KcTest::slope_weights() const {
  const Eigen::VectorXd load = loads.row(*slopes_by);
  Eigen::VectorXd inside(load.size());
  for (Eigen::Index i = 0; i < load.size(); ++i)
    inside[i] = load[i] >= window.first && load[i] <= window.second ? 1.0 : 0.0;
  if (inside.sum() < 2.0) return {};
  const Eigen::VectorXd from_mean =
      inside.cwiseProduct((load.array() - load.dot(inside) / inside.sum()).matrix());
  const double square = from_mean.squaredNorm();
  if (!(square > 1e-12 * load.squaredNorm())) return {};
  return from_mean / square;
}

Result<Channels> run(const DoubleWishbone& corner, const KcTest& test, const KcSlopes& asked) {
  const multibody::Mechanism mechanism(corner.bodies(), corner.joints());
  multibody::Equilibrium statics(mechanism);
  suspension::WheelPoints points = corner.wheel();
  multibody::Load on{DoubleWishbone::kUpright, corner.contact};
  if (test.at_wheel_center) {
    points.contact = points.center;
    on.point = corner.wheel_center;
  }
  multibody::Rest stands = statics.unloaded();  // friction remembers the loads before
  const multibody::Poses& poses = stands.poses;
  const Vector6d rest = as_vector(wheel_position(points, poses[DoubleWishbone::kUpright]));
  const Eigen::Index states = test.loads.cols();
  const auto numbers = static_cast<Eigen::Index>(asked.varied.size());
  const auto is_asked = [&](const std::string& channel) {
    return numbers > 0 &&
           std::find(asked.channels.begin(), asked.channels.end(), channel) != asked.channels.end();
  };
  std::vector<int> followed;  // what moves whose slopes are wanted
  for (int m = 0; m < 6; ++m)
    if (is_asked(KcTest::kMoved[static_cast<std::size_t>(m)]) ||
        (test.slopes_by && is_asked(test.slope_name(m))))
      followed.push_back(m);
  Eigen::MatrixXd moved(states, 6);
  std::vector<Eigen::MatrixXd> slopes(6, Eigen::MatrixXd(states, numbers));
  for (Eigen::Index i = 0; i < states; ++i) {
    on.force = test.loads.col(i).head<3>();
    on.moment = test.loads.col(i).tail<3>();
    const multibody::Standing standing{.loads = {&on, 1}};
    auto found = statics.solve(standing, stands);
    if (!found)
      return Failure{fmt::format("state {} of the K&C rig: {}", i + 1, found.failure().reason)};
    stands = std::move(*found);
    const multibody::Pose& upright = poses[DoubleWishbone::kUpright];
    moved.row(i) = as_vector(wheel_position(points, upright)) - rest;
    if (followed.empty()) continue;
    if (const std::string trouble = statics.linearize(stands, standing); !trouble.empty())
      return Failure{fmt::format("state {} of the K&C rig: {}", i + 1, trouble)};
    Eigen::MatrixXd by_pose =
        Eigen::MatrixXd::Zero(6 * DoubleWishbone::kBodies, std::ssize(followed));
    by_pose.middleRows<6>(6 * DoubleWishbone::kUpright) =
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
  const auto add = [&](const std::string& name,
                       std::string unit,
                       const Eigen::VectorXd& values,
                       const Eigen::MatrixXd& by) {
    Channel channel{name, std::move(unit), {values.begin(), values.end()}};
    if (is_asked(name)) channel.slopes.assign(by.data(), by.data() + by.size());
    channels.add(std::move(channel));
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
  if (!test.slopes_by) return channels;
  const Eigen::RowVectorXd w = test.slope_weights().transpose();
  for (int m = 0; m < 6; ++m)
    add(test.slope_name(m),
        test.slope_unit(m),
        w * moved.col(m),
        w * slopes[static_cast<std::size_t>(m)]);
  return channels;
}

}  // namespace latsch::experiment
