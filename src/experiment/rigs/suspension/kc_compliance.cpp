// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/suspension/kc_compliance.h"

#include <fmt/format.h>

#include "models/multibody/equilibrium.h"
#include "models/suspension/axle_compliance.h"

namespace latsch::experiment {
namespace {

constexpr std::array<const char*, 6> kResponses = {
    "dx", "dy", "dz", "about_x", "about_y", "about_z"};

const char* compliance_unit(std::size_t response, std::size_t load) {
  if (response < 3) return load < 3 ? "m/N" : "1/N";  // m/(N m) = 1/N
  return load < 3 ? "rad/N" : "rad/(N m)";
}

}  // namespace

Result<Channels> compliance_matrices(const suspension::CompliantCorner& corner,
                                     const KcTest& test) {
  const int upright = corner.upright;
  const multibody::Mechanism mechanism(corner.bodies, corner.joints);
  multibody::Equilibrium statics(mechanism);
  multibody::Load on{upright, test.at_wheel_center ? corner.wheel_center : corner.contact};
  multibody::Poses poses = mechanism.at_rest();
  std::array<std::vector<double>, 36> values;
  for (Eigen::Index i = 0; i < test.loads.cols(); ++i) {
    on.force = test.loads.col(i).head<3>();
    on.moment = test.loads.col(i).tail<3>();
    auto found = statics.solve({&on, 1}, &poses);
    if (!found)
      return Failure{fmt::format("state {} of the K&C rig: {}", i + 1, found.failure().reason)};
    poses = std::move(*found);
    if (const Status done = statics.linearize(poses, {&on, 1}); !done)
      return Failure{fmt::format("state {} of the K&C rig: {}", i + 1, done.failure().reason)};
    const Eigen::Vector3d arm =
        poses[static_cast<std::size_t>(upright)].turn * (on.point - corner.wheel_center);
    const multibody::Matrix6d C =
        suspension::travel_at(arm, statics.compliance(upright, upright, arm));
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k].push_back(C(static_cast<Eigen::Index>(k / 6), static_cast<Eigen::Index>(k % 6)));
  }
  Channels channels;
  for (std::size_t k = 0; k < values.size(); ++k)
    channels.add({fmt::format("{}_by_{}", kResponses[k / 6], KcTest::kLoads[k % 6]),
                  compliance_unit(k / 6, k % 6),
                  std::move(values[k])});
  return channels;
}

}  // namespace latsch::experiment
