// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/residual_trust_region.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "optimization/least_squares/flat_directions.h"
#include "optimization/least_squares/lost_variables.h"
#include "optimization/least_squares/trust_region_run.h"
#include "optimization/problem/option_check.h"
#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

constexpr double kTest = 0.1;  // of the initial radius: moves that tell which variables are lost
/// Of n + 1 evaluations, to each place where lost variables are felt: one of them are the probes,
/// so two are left for steps.
constexpr int kAllotment = 3;
constexpr double kWorthIt = 0.9;  // of the value: what trials brought

void check(const ResidualTrustRegionOptions& options) {
  const OptionCheck check("residual trust region");
  check.lengths(options.initial_radius, options.step_tolerance, 0.5, "initial radius");
  check.require(options.explained >= 0.0, "explained", options.explained, "0 or more");
  check.require(options.noise_alone >= 0.0, "noise_alone", options.noise_alone, "0 or more");
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

struct ResidualTrustRegion::State {
  TrustRegionRun run;
  std::optional<LostVariables> lost;   // while they are looked for
  Eigen::VectorXd r_settled;           // where the run settled
  PendingPoints<Wanted> look;          // the next point of `lost`; at most one
  std::vector<TrustRegionRun> trials;  // from the places where they are felt
  int allotted = 0;                    // evaluations left to the last of them

  State(const DesignSpace& space, const ResidualTrustRegionOptions& options)
      : run(space, options) {}

  TrustRegionRun& active() { return allotted > 0 ? trials.back() : run; }
  const PendingPoints<Wanted>& wanted() const {
    if (!look.empty()) return look;
    return allotted > 0 ? trials.back().wanted() : run.wanted();
  }

  void observe(const DesignPoint& point,
               const Eigen::VectorXd& u,
               const std::optional<ResidualSample>& sample) {
    if (look.contains(point)) {
      take_look(point, sample);
    } else if (wanted().contains(point)) {
      active().observe(point, u, sample);
      if (allotted > 0) --allotted;
    } else {
      run.observe(point, u, sample);
    }
    if (allotted > 0 && trials.back().wanted().empty()) allotted = 0;
    if (allotted == 0 && look.empty()) look_for_lost_variables();
  }

  void look_for_lost_variables() {
    if (run.has_settled() && !lost) {
      r_settled = run.best().r;
      const Eigen::VectorXd slopes = run.box().slopes().colwise().norm().transpose();
      const Eigen::VectorXd test = kTest * run.options().initial_radius * run.box().draw();
      lost.emplace(run.box().space, run.box().region, run.best().u, slopes, test);
    }
    if (!lost) return;
    const bool may_go_on = std::ssize(trials) < run.restarts_left();
    if (lost->has_next() && may_go_on) {
      look = {run.box().at(lost->next(), Wanted::Kind::start)};
    } else {
      choose();
      look_for_lost_variables();
    }
  }

  /// Where a place is felt, a trial begins.
  void take_look(const DesignPoint& point, const std::optional<ResidualSample>& sample) {
    const bool was_test = lost->is_testing();
    const double factor = lost->factor();
    const bool is_felt = !sample || !is_same(sample->r, r_settled);
    lost->observe(is_felt);
    look.clear();
    if (!is_felt || !sample) return;
    if (was_test) return run.observe(point, sample->u, sample);
    ResidualTrustRegionOptions options = run.options();
    options.restarts = 0;
    // Steps of the felt variables are as long as before, those of the lost ones would be as much
    // shorter as these are now: the geometric mean of both.
    options.initial_radius =
        std::max(options.step_tolerance, std::sqrt(std::min(1.0, factor)) * options.initial_radius);
    trials.emplace_back(run.box().space.starting_at(point), options);
    trials.back().observe(point, sample->u, sample);
    if (!trials.back().box().has_center()) return trials.pop_back();
    allotted = kAllotment * (run.box().n() + 1) + options.outstanding - 1;
  }

  /// The best of all is gone on with. Trials count as restarts where they were in vain.
  void choose() {
    const int restarts_left = run.restarts_left();
    const double f_before = run.best().f;
    for (const TrustRegionRun& trial : trials) {
      if (trial.best().f < run.best().f) run = trial;
    }
    const bool was_in_vain = run.best().f > kWorthIt * f_before;
    run.go_on(restarts_left - (was_in_vain ? static_cast<int>(std::ssize(trials)) : 0));
    trials.clear();
    lost.reset();
  }

  /// Idle workers are sent ahead: to the steps of models, and to further looks as if this one
  /// would tell nothing.
  ResidualSample expected(const DesignPoint& point) {
    return look.empty() ? active().box().expected(point) : run.best();
  }
};

ResidualTrustRegion::ResidualTrustRegion(const DesignSpace& space,
                                         const ResidualTrustRegionOptions& options) {
  check(options);
  state_ = std::make_unique<State>(space, options);
}

ResidualTrustRegion::~ResidualTrustRegion() = default;

std::vector<DesignPoint> ResidualTrustRegion::propose(int count) const {
  assert(count >= 1);
  Plan plan(count);
  plan.add(state_->wanted());
  if (plan.is_empty() || plan.is_full()) return plan.points();
  State future = *state_;
  // Nothing to expect yet: the geometry will be wanted anyway.
  if (!future.run.box().has_center()) {
    future.run.widen(count);
    plan.add(future.wanted());
  }
  while (!plan.is_full() && future.run.box().has_center() && !future.wanted().empty()) {
    const DesignPoint first = future.wanted().front().point;
    const ResidualSample expected = future.expected(first);
    future.observe(first, expected.u, expected);
    plan.add(future.wanted());
  }
  return plan.points();
}

void ResidualTrustRegion::observe(const DesignPoint& point, const Result<Score>& outcome) {
  const TrustBox& box = state_->run.box();
  const auto place = box.space.place(point);
  if (!place) return;  // foreign: nothing can be learned of it
  const Eigen::VectorXd u = to_vector(*place);
  state_->observe(point, u, sample(box, point, u, outcome));
}

std::string ResidualTrustRegion::ending() const {
  if (!converged()) return {};
  std::string words = in_words(state_->run.ending());
  if (state_->run.is_down_to_noise()) {
    words += "; what is left is no more than the stated noise makes of it";
  }
  return words;
}

bool ResidualTrustRegion::converged() const { return state_->wanted().empty(); }

}  // namespace latsch
