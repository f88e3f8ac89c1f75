// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/kc_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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

/// Returns a Failure that names a bushing with an impossible deformation: stiffnesses are then in
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

bool is_asked(const KcSlopes& asked, const std::string& channel) {
  return !asked.varied.empty() &&
         std::ranges::find(asked.channels, channel) != asked.channels.end();
}

/// Returns the indices of the motion's channels whose slopes are requested.
std::vector<int> followed_channels(const KcTest& test, const KcSlopes& asked) {
  std::vector<int> followed;
  for (int m = 0; m < 6; ++m) {
    const std::string name = KcTest::kMoved[static_cast<std::size_t>(m)];
    if (is_asked(asked, name) || (test.slopes && is_asked(asked, test.slopes->name(name))))
      followed.push_back(m);
  }
  return followed;
}

/// A corner on the rig, which is loaded state by state, and what has been recorded of it.
class KcRun {
 public:
  KcRun(const suspension::CompliantCorner& corner, const KcTest& test, const KcSlopes& asked)
      : corner_(corner),
        test_(test),
        asked_(asked),
        mechanism_(corner.bodies, corner.joints),
        assembly_(mechanism_),
        wheel_{"", corner.upright, corner.wheel_center, corner.contact},
        statics_(mechanism_),
        points_(corner.wheel),
        on_{corner.upright, corner.contact},
        stands_(statics_.unloaded()),
        followed_(followed_channels(test, asked)),
        moved_(test.loads.cols(), 6),
        slopes_(6, Eigen::MatrixXd::Zero(test.loads.cols(), std::ssize(asked.varied))) {
    if (test.at_wheel_center) {
      points_.contact = points_.center;
      on_.point = corner.wheel_center;
    }
    rest_ = as_vector(wheel_position(points_, upright()));
  }

  /// Finds the equilibrium of the corner under the loads of a state, and records its motion.
  Status load(Eigen::Index state, const RigWatcher& watch) {
    on_.force = test_.loads.col(state).head<3>();
    on_.moment = test_.loads.col(state).tail<3>();
    const multibody::RestSettings standing{.loads = {&on_, 1}};
    auto found = statics_.solve(standing, stands_);
    if (!found) return found.failure();
    stands_ = std::move(*found);
    if (const Status held = check_bushings(mechanism_, stands_.poses); !held) return held;
    if (watch) watch({mechanism_, assembly_, stands_, {&on_, 1}, {&wheel_, 1}, state});
    moved_.row(state) = as_vector(wheel_position(points_, upright())) - rest_;
    if (followed_.empty()) return {};
    if (const Status done = statics_.linearize(stands_, standing); !done) return done;
    record_slopes(state);
    return {};
  }

  Channels recorded() const {
    Channels channels;
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(moved_.rows(), slopes_[0].cols());
    for (int i = 0; i < 6; ++i) {
      const auto load = static_cast<std::size_t>(i);
      if (test_.stated[load])
        add(channels, KcTest::kLoads[load], unit_of_load(i), test_.loads.row(i).transpose(), none);
    }
    for (int m = 0; m < 6; ++m) {
      const auto moved = static_cast<std::size_t>(m);
      add(channels, KcTest::kMoved[moved], unit_of_moved(m), moved_.col(m), slopes_[moved]);
    }
    return channels;
  }

 private:
  const multibody::Pose& upright() const {
    return stands_.poses[static_cast<std::size_t>(corner_.upright)];
  }

  /// Records the derivatives of the observed channels by the varied numbers, which are stiffnesses.
  void record_slopes(Eigen::Index state) {
    Eigen::MatrixXd by_pose =
        Eigen::MatrixXd::Zero(6 * std::ssize(corner_.bodies), std::ssize(followed_));
    by_pose.middleRows<6>(6 * corner_.upright) =
        wheel_slopes(points_, upright()).transpose()(Eigen::all, followed_);
    const Eigen::MatrixXd by_stiffness = statics_.by_stiffness(stands_.poses, by_pose);
    for (Eigen::Index f = 0; f < std::ssize(followed_); ++f)
      for (Eigen::Index v = 0; v < std::ssize(asked_.varied); ++v) {
        double slope = 0.0;
        for (const auto& [joint, axis] : asked_.varied[static_cast<std::size_t>(v)])
          slope += by_stiffness(f, 6 * joint + axis);
        const int m = followed_[static_cast<std::size_t>(f)];
        slopes_[static_cast<std::size_t>(m)](state, v) = slope;
      }
  }

  static void add(Channels& channels,
                  std::string name,
                  std::string unit,
                  const Eigen::VectorXd& values,
                  const Eigen::MatrixXd& by) {
    channels.add({std::move(name),
                  std::move(unit),
                  {values.begin(), values.end()},
                  {by.data(), by.data() + by.size()}});
  }

  const suspension::CompliantCorner& corner_;
  const KcTest& test_;
  const KcSlopes& asked_;
  multibody::Mechanism mechanism_;
  multibody::Assembly assembly_;
  RigState::Wheel wheel_;
  multibody::Equilibrium statics_;
  suspension::WheelPoints points_;
  multibody::Load on_;
  multibody::Rest stands_;  // friction remembers earlier loads
  Vector6d rest_;           // the unloaded corner
  std::vector<int> followed_;
  Eigen::MatrixXd moved_;                // [state][channel]
  std::vector<Eigen::MatrixXd> slopes_;  // one for each channel, [state][number]
};

}  // namespace

Result<Channels> run(const suspension::CompliantCorner& corner,
                     const KcTest& test,
                     const KcSlopes& asked,
                     const RigWatcher& watch) {
  KcRun run(corner, test, asked);
  for (Eigen::Index i = 0; i < test.loads.cols(); ++i)
    if (const Status done = run.load(i, watch); !done)
      return Failure{fmt::format("state {} of the K&C rig: {}", i + 1, done.failure().reason)};
  Channels channels = run.recorded();
  if (test.slopes)
    add_slopes(*test.slopes, {KcTest::kMoved.begin(), KcTest::kMoved.end()}, channels);
  return with_slopes_of(asked.channels, channels);
}

}  // namespace latsch::experiment
