// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/fresh_slopes.h"

namespace latsch {
namespace {

constexpr double kReach = 2.0;    // of the frame's axes: the longest step
constexpr double kShorter = 0.3;  // of that, after a step that disappointed
constexpr int kMostMisses = 3;
constexpr double kFarther = 3.0;  // in the noise
/// Of the deviation that noise makes of the target: a step that promised less and disappoints says
/// nothing about slopes. Of 689 noisy runs (the Moré-Wild problems, 13 draws) solved within 10 and
/// 100 (n + 1): 606 and 657 by 0.5, with four restarts; 599 and 654 by 0, that is any step, with
/// three; 608 and 654 by 2, with five.
constexpr double kTelling = 0.5;
constexpr double kWorthARound = 1.0 - 1e-5;  // of the value: another one
constexpr int kMostRounds = 8;

}  // namespace

FreshSlopes::FreshSlopes(TrustBox& box, const Options& options) : options_(options) {
  begin_round(box, box.slopes());
}

void FreshSlopes::begin_round(const TrustBox& box, const Eigen::MatrixXd& J) {
  frame_ = box.natural_frame(J, change_, options_.shortest);
  axis_ = 0;
  misses_ = 0;
  has_failed_ = false;
  has_disappointed_ = false;
  reach_ = kReach;
  f_begin_ = box.f();
  ++rounds_;
}

std::optional<Wanted> FreshSlopes::next(TrustBox& box, const PendingPoints<Wanted>& wanted) {
  while (true) {
    while (axis_ < frame_.axes()) {
      if (auto probe = box.probe_by(frame_.T.col(axis_++), wanted)) return probe;
    }
    if (!wanted.empty()) return std::nullopt;
    double noise = 0.0;
    const ResidualKriging m = box.natural_model(frame_, noise);
    deviation_ = m.target_deviation();
    const Wanted step = box.natural_step(m, frame_, reach_, wanted);
    const bool is_promising = step.length > 0.0;
    if (is_promising && misses_ < kMostMisses) return step;
    const bool goes_farther = !pays_another_round(box) && noise > 0.0 && change_ < kFarther;
    if (!pays_another_round(box) && !goes_farther) {
      ending_ = is_promising && has_failed_ ? Ending::edge
                : noise > 0.0               ? Ending::noise
                : is_promising              ? Ending::rough
                                            : Ending::verified;
      return std::nullopt;
    }
    if (goes_farther) change_ = kFarther;
    begin_round(box, m.jacobian(Eigen::VectorXd::Zero(frame_.axes())) * frame_.inverse);
  }
}

bool FreshSlopes::pays_another_round(const TrustBox& box) const {
  const bool has_gained = box.f() < kWorthARound * f_begin_ && box.f() > options_.f_least;
  const bool was_wrong = has_disappointed_ && !box.is_down_to(options_.noise_alone);
  return (has_gained || was_wrong) && rounds_ < kMostRounds;
}

void FreshSlopes::observe_failed_step() {
  ++misses_;
  has_failed_ = true;
}

void FreshSlopes::observe_step(bool is_bad, double promise) {
  misses_ = is_bad ? misses_ + 1 : 0;
  has_failed_ = false;
  if (!is_bad) return;
  has_disappointed_ |= promise >= kTelling * deviation_;
  reach_ *= kShorter;
}

}  // namespace latsch
