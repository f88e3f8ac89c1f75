// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/residual_trust_region.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "optimization/problem/option_check.h"
#include "optimization/problem/point_vector.h"
#include "optimization/trust_region/lost_variable_trials.h"

namespace latsch {
namespace {

void check(const ResidualTrustRegionOptions& options) {
  const OptionCheck check("residual trust region");
  check.lengths(options.initial_radius, options.step_tolerance, 0.5, "initial radius");
  check.require(options.explained >= 0.0, "explained", options.explained, "0 or more");
  check.require(options.noise_alone >= 0.0, "noise_alone", options.noise_alone, "0 or more");
  check.require(
      options.square_of_data >= 0.0, "square_of_data", options.square_of_data, "0 or more");
  check.require(options.restarts >= 0, "restarts", options.restarts, "0 or more");
  check.require(options.outstanding >= 1, "outstanding", options.outstanding, "1 or more");
}

std::optional<ResidualSample> sample(const TrustBox& box,
                                     const DesignPoint& point,
                                     const Eigen::VectorXd& u,
                                     const Result<Score>& outcome) {
  if (!outcome) return std::nullopt;
  if (outcome->residuals.empty()) {
    throw InputError(
        "residual trust region: the target function gives no residuals; use another method, "
        "such as gss");
  }
  const Eigen::VectorXd r = to_vector(outcome->residuals);
  const bool is_odd = box.memory.size() > 0 && r.size() != box.memory[0].r.size();
  if (is_odd || !std::isfinite(r.squaredNorm())) return std::nullopt;
  return ResidualSample{
      u, r, box.space.unit_jacobian(point, *outcome), r.squaredNorm(), outcome->stand_ins};
}

}  // namespace

ResidualTrustRegion::ResidualTrustRegion(const DesignSpace& space,
                                         const ResidualTrustRegionOptions& options) {
  check(options);
  search_ = std::make_unique<LostVariableTrials>(space, options);
}

ResidualTrustRegion::~ResidualTrustRegion() = default;

/// Returns the outstanding points, then the points that the method would propose next if outcomes
/// were as predicted.
std::vector<DesignPoint> ResidualTrustRegion::propose(int count) const {
  assert(count >= 1);
  Plan plan(count);
  plan.add(search_->wanted());
  if (plan.is_empty() || plan.is_full()) return plan.points();
  LostVariableTrials future = *search_;
  // Without a center the model cannot predict outcomes, so all probes are proposed at once; they
  // will be needed in any case.
  if (!future.run().box().has_center()) {
    future.widen(count);
    plan.add(future.wanted());
  }
  while (!plan.is_full() && future.run().box().has_center() && !future.wanted().empty()) {
    const DesignPoint first = future.wanted().front().point;
    const ResidualSample expected = future.expected(first);
    future.observe(first, expected.u, expected);
    plan.add(future.wanted());
  }
  return plan.points();
}

void ResidualTrustRegion::observe(const DesignPoint& point, const Result<Score>& outcome) {
  const TrustBox& box = search_->run().box();
  const auto place = box.space.place(point);
  // A point from another source that is outside of the cube contains no information for this
  // search.
  if (!place) return;
  const Eigen::VectorXd u = to_vector(*place);
  search_->observe(point, u, sample(box, point, u, outcome));
}

std::string ResidualTrustRegion::ending() const {
  if (!converged()) return {};
  return in_words(search_->run().ending(), search_->run().evidence());
}

std::vector<EndingClaim> ResidualTrustRegion::claims() const {
  if (!converged()) return {};
  return claims_of(search_->run().ending(), search_->run().evidence());
}

/// Plans ahead, as if outcomes were as predicted, until the first step. More points than the probes
/// of a new center do not come before it.
std::optional<double> ResidualTrustRegion::promise() const {
  if (converged() || !search_->run().box().has_center()) return std::nullopt;
  LostVariableTrials future = *search_;
  const double f = future.run().best().f;
  const int most = 2 * (future.run().box().n() + 1);
  for (int k = 0; k < most && future.run().box().has_center() && !future.wanted().empty(); ++k) {
    const Wanted& first = future.wanted().front();
    if (first.kind == Wanted::Kind::step && first.f_center == f)
      return std::max(0.0, 1.0 - first.predicted / f);
    const DesignPoint point = first.point;
    const ResidualSample expected = future.expected(point);
    future.observe(point, expected.u, expected);
  }
  return std::nullopt;
}

bool ResidualTrustRegion::converged() const { return search_->wanted().empty(); }

}  // namespace latsch
