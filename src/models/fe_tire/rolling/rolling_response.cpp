// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_response.h"

#include <Eigen/LU>
#include <numbers>
#include <optional>

#include "models/fe_tire/analysis/fe_tire_impl.h"

namespace latsch::fe_tire {

using Complex = std::complex<double>;

double relaxation_length(const Complex& force, double frequency, double speed) {
  return -speed / (2.0 * std::numbers::pi * frequency) * force.imag() / force.real();
}

RollingResponse::RollingResponse(std::unique_ptr<const LinearPatch> patch)
    : patch_(std::move(patch)) {}
RollingResponse::RollingResponse(RollingResponse&&) noexcept = default;
RollingResponse::~RollingResponse() = default;

int RollingResponse::size() const { return static_cast<int>(patch_->T().rows()); }

Result<RollingResponse> RollingResponse::about(const FeTire& tire, const RollingState& state) {
  return about(tire, state, {}, {});
}

Result<std::unique_ptr<LinearPatch>> RollingResponse::patch_about(const FeTire& tire,
                                                                  const RollingState& state,
                                                                  const LossMaterials& losses,
                                                                  const Inflated& round) {
  if (state.of.curvature != 0.0)
    return Failure{
        "the response of a tire that rolls on a drum is not computed: expected flat ground"};
  const RingElements& elements = tire.impl_->elements();
  std::optional<RollingHistory> history;
  if (!losses.is_elastic()) history.emplace(elements, losses, round);
  auto patch = std::make_unique<LinearPatch>(elements, tire.impl_->settings.tread_shape());
  const Status done = patch->evaluate(state, history ? &*history : nullptr);
  if (!done) return done.failure();
  return patch;
}

Result<RollingResponse> RollingResponse::about(const FeTire& tire,
                                               const RollingState& state,
                                               const LossMaterials& losses,
                                               const Inflated& round) {
  if (state.of.friction.at_rest == 0.0)
    return Failure{
        "the response of a tire that rolls without friction to a slip is nothing: expected "
        "friction"};
  auto patch = patch_about(tire, state, losses, round);
  if (!patch) return patch.failure();
  if ((*patch)->body().rows().empty())
    return Failure{"the tread of the rolling tire is off the ground"};
  return RollingResponse(*std::move(patch));
}

std::vector<SlipResponse> RollingResponse::at(double frequency,
                                              const std::vector<SlipInput>& inputs,
                                              Axle axle) const {
  const LinearPatch& patch = *patch_;
  const double omega = 2.0 * std::numbers::pi * frequency;
  const HarmonicContact contact = patch.contact();
  const auto count = std::ssize(inputs);
  std::vector<PointMotion> motions;
  for (const SlipInput input : inputs) motions.push_back(patch.motion_by(input));
  motions.push_back(patch.motion_along(Eigen::Vector3d::UnitZ()));
  Eigen::MatrixXcd right = contact.forces_by(omega, motions);
  for (Eigen::Index k = 0; k < count; ++k) right.col(k) -= patch.residual_by(inputs[k]);
  const Eigen::MatrixXcd Z = patch.T().cast<Complex>() - contact.tangent(omega);
  const Eigen::MatrixXcd q = Z.partialPivLu().solve(right);

  const SlipResponse raised =
      patch.measured(omega, q.col(count), motions.back(), patch.center_by_rise());
  std::vector<SlipResponse> found;
  for (Eigen::Index k = 0; k < count; ++k) {
    SlipResponse one = patch.measured(omega, q.col(k), motions[k], Eigen::Vector3d::Zero());
    if (axle == Axle::follows) {
      const Complex rise = -one.force.z() / raised.force.z();
      one.force += rise * raised.force;
      one.moment += rise * raised.moment;
    }
    found.push_back(one);
  }
  return found;
}

}  // namespace latsch::fe_tire
