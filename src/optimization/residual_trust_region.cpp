// SPDX-License-Identifier: Apache-2.0
#include "optimization/residual_trust_region.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "optimization/flat_directions.h"
#include "optimization/option_check.h"
#include "optimization/trust_box.h"

namespace latsch {
namespace {

using Kind = Wanted::Kind;

// Of the variance of slopes before anything was known:
constexpr double kUnknown = 0.5;  // a direction to be probed before any step
constexpr double kPoor =
    0.02;  // one to be probed when a step disappoints: no sample within 7 radii

constexpr double kGoodGain = 0.5;
constexpr double kBadGain = 0.1;
constexpr double kGrowth = 2.0;      // of the radius over the step, at least, after a good gain
constexpr double kMostGrowth = 4.0;  // at most
constexpr double kShrinkage = 0.7;   // of the radius after a bad gain
constexpr double kMostShrinkage = 0.1;
constexpr double kWidest = 0.5;  // a box as wide as the cube

constexpr double kSettled = 0.1;  // of the initial radius: below it a flat model is believed

constexpr int kFailuresToShrink = 2;
constexpr int kFailuresToGiveUp = 4;  // in a row: no more probes beside this center
constexpr int kDisappointments = 3;   // in a row, before noise is looked for
constexpr double kDrowned = 1e4;      // noise as large as the slopes

/// Boxes for further steps while the outcome of the first one is awaited.
constexpr std::array kBoxes{1.0, 0.25, 2.0, 0.5, 0.1, 4.0, 0.03, 0.01};
/// Of the initial radius: how far from the best point restarts begin, one after the other.
constexpr std::array kJumps{0.1, 1.0, 0.03, 0.3};

Eigen::VectorXd to_vector(const std::vector<double>& u) {
  return Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size()));
}

void check(const ResidualTrustRegionOptions& options) {
  const OptionCheck check("residual trust region");
  check.lengths(options.initial_radius, options.step_tolerance, 0.5, "initial radius");
  check.require(options.restarts >= 0, "restarts", options.restarts, "0 or more");
  check.require(options.outstanding >= 1, "outstanding", options.outstanding, "1 or more");
}

}  // namespace

struct ResidualTrustRegion::State {
  ResidualTrustRegionOptions options;
  TrustBox box;

  bool is_geometry_doubted = false;  // a step disappointed
  bool has_widened = false;          // the radius, for noise, since the last outcome
  int disappointments = 0;           // in a row
  int failures = 0;                  // in a row
  int explored = 0;                  // points at the end of a run, since its last better one
  int restarts = 0;
  Eigen::MatrixXd flat;        // directions without effect at the best point of all
  int scouts = 0;              // along them, left of this restart
  bool is_scouting = false;    // the start under way is one
  bool is_over = false;        // the last restart failed
  std::vector<Wanted> wanted;  // in the order proposed; empty: converged

  State(const DesignSpace& space, const ResidualTrustRegionOptions& o)
      : options(o), box(space, o.initial_radius, o.seed) {
    wanted.push_back(box.at(box.c(), Kind::start));
    fill();
  }

  int n() const { return box.n(); }

  bool is_step_awaited() const {
    return std::any_of(wanted.begin(), wanted.end(), [&](const Wanted& w) {
      return w.kind == Kind::step && w.center == box.center();
    });
  }

  /// The next point, after those already wanted; nullopt at the end.
  std::optional<Wanted> next() {
    if (is_over) return std::nullopt;
    while (box.radius >= options.step_tolerance && !is_hopeless()) {
      const bool bears_probes = !box.has_center() || failures < kFailuresToGiveUp;
      const OpenDirection open = open_direction();
      if (open.share > kUnknown && bears_probes) {
        if (auto probe = box.probe(open.direction, wanted)) return probe;
      }
      if (!box.has_center()) return box.explore(wanted);
      if (std::exchange(is_geometry_doubted, false) && open.share > kPoor) {
        if (auto probe = box.probe(open.direction, wanted)) return probe;
      }
      const ResidualModel m = box.model(disappointments >= kDisappointments);
      if (box.noise >= kDrowned && !has_widened && box.radius < options.initial_radius) {
        has_widened = true;
        box.radius *= 2.0;
        continue;
      }
      if (is_step_awaited()) return another_step(m);
      const Wanted first = box.step(m, kBoxes.front(), wanted);
      if (first.length > 0.0) return first;
      if (open.share > kPoor && bears_probes) {
        if (auto probe = box.probe(open.direction, wanted)) return probe;
      }
      if (!box.promises(first) && box.radius < kSettled * options.initial_radius) break;
      box.radius *= 0.1;
    }
    if (is_hopeless()) return std::nullopt;
    if (wanted.empty()) return restart();
    // Those under way may lead on; meanwhile idle workers look around, each once.
    return explored++ < options.outstanding ? box.explore(wanted) : std::nullopt;
  }

  struct OpenDirection {
    double share = 0.0;  // of the variance of its slope
    Eigen::VectorXd direction;
  };

  /// The one least known; none where the model brought its slopes, or the region is a point.
  OpenDirection open_direction() const {
    if (box.has_center() && box.memory[box.center()].J.size() > 0) return {};
    const SlopeVariance g = box.geometry(wanted);
    const Eigen::Index last = g.share.size() - 1;
    if (last < 0) return {};
    return {g.share[last], g.directions.col(last)};
  }

  std::optional<Wanted> another_step(const ResidualModel& m) {
    for (std::size_t k = 1; k < kBoxes.size(); ++k) {
      Wanted other = box.step(m, kBoxes[k], wanted);
      if (other.length > 0.0) return other;
    }
    return box.explore(wanted);
  }

  std::optional<Wanted> restart() {
    if (restarts >= options.restarts || box.best() < 0) return std::nullopt;
    if (box.center() == box.best()) {
      const double r = box.memory[box.best()].r.norm();
      flat = flat_directions(box.slopes(), options.initial_radius, r);
    }
    scouts = flat.cols() > 0 ? n() + 1 : 0;
    explored = 0;
    const double jump = kJumps[restarts++ % kJumps.size()] * options.initial_radius;
    box.radius = std::max(jump, options.step_tolerance);
    return start();
  }

  /// Beside the best point: along flat directions as long as there are scouts.
  Wanted start() {
    const Eigen::VectorXd best = box.memory[box.best()].u;
    is_scouting = scouts-- > 0;
    if (is_scouting) {
      const Eigen::VectorXd along = flat * (flat.transpose() * box.draw());
      box.move_to(box.region.nearest(best + options.initial_radius * along));
    } else {
      box.move_to(box.moved(best, box.radius));
    }
    return box.at(box.c(), Kind::start);
  }

  void fill() {
    while (std::ssize(wanted) < options.outstanding) {
      auto next_point = next();
      if (!next_point) return;
      wanted.push_back(std::move(*next_point));
    }
  }

  /// Nothing ever succeeded, in many places.
  bool is_hopeless() const { return box.best() < 0 && failures > 20 * (n() + 1); }

  /// Where a start failed: the next scout or restart; elsewhere, farther and farther away, as long
  /// as nothing ever succeeded.
  void start_again(const Eigen::VectorXd& failed) {
    if (is_hopeless()) return;
    if (box.best() >= 0) {
      auto another = is_scouting ? std::optional(start()) : restart();
      is_over = !another;
      if (another) wanted.push_back(*another);
      return;
    }
    box.move_to(box.moved(failed, options.initial_radius * (1.0 + failures / n())));
    wanted.push_back(box.at(box.c(), Kind::start));
  }

  void take_failure(const Wanted& tried) {
    box.memory.add_failure(tried.u);
    ++failures;
    if (tried.kind == Kind::start && !box.has_center()) return start_again(tried.u);
    if (failures >= kFailuresToGiveUp) {
      box.radius *= 0.1;
    } else if (tried.kind == Kind::step && failures >= kFailuresToShrink) {
      box.radius *= 0.5;
    }
  }

  void take(const Wanted& tried, ResidualSample sample) {
    failures = 0;
    const double gain = (tried.f_center - sample.f) / (tried.f_center - tried.predicted);
    const bool is_of_center = tried.center == box.center();
    if (tried.kind == Kind::start && is_scouting && is_same(sample.r, box.memory[box.best()].r)) {
      wanted.push_back(start());
      return;
    }
    const bool is_best = box.take(std::move(sample));
    if (is_best) explored = 0;
    if (tried.kind != Kind::step) return;
    if (gain > kGoodGain) disappointments = 0;
    if (is_best && gain > kGoodGain) {
      box.radius = std::clamp(box.radius, kGrowth * tried.length, kMostGrowth * tried.length);
      box.radius = std::min(box.radius, kWidest);
    } else if (gain < kBadGain && is_of_center && tried.length <= 1.01 * box.radius) {
      box.radius *= std::clamp(tried.length / box.radius, kMostShrinkage, kShrinkage);
      is_geometry_doubted = true;
      ++disappointments;
    }
  }

  void observe(const DesignPoint& point, const std::optional<ResidualSample>& sample) {
    const auto found = std::find_if(
        wanted.begin(), wanted.end(), [&](const Wanted& w) { return w.point == point; });
    Wanted tried;
    if (found != wanted.end()) {
      tried = *found;
      wanted.erase(found);
    } else {
      tried = {to_vector(box.space.to_unit(point)), point, Kind::probe, box.center(), box.f()};
    }
    has_widened = false;
    if (sample && sample->f < box.explosion() && !box.leaps(*sample)) {
      take(tried, {tried.u, sample->r, sample->J, sample->f, sample->stand_ins});
    } else {
      take_failure(tried);
    }
    fill();
  }

  /// dr/du = dr/dx dx/du
  Eigen::MatrixXd slopes(const DesignPoint& point, const Score& score) const {
    if (score.jacobian.empty()) return {};
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto m = static_cast<Eigen::Index>(score.residuals.size());
    if (std::ssize(score.jacobian) != m * n()) return {};
    const Eigen::MatrixXd J = Eigen::Map<const Rows>(score.jacobian.data(), m, n());
    if (!J.allFinite()) return {};
    return J * to_vector(box.space.unit_slopes(point)).asDiagonal();
  }

  std::optional<ResidualSample> sample(const DesignPoint& point,
                                       const Result<Score>& outcome) const {
    if (!outcome) return std::nullopt;
    if (outcome->residuals.empty()) {
      throw InputError(
          "residual trust region: the target function gives no residuals; use another method, "
          "such as gss");
    }
    const Eigen::VectorXd r = to_vector(outcome->residuals);
    const bool is_odd = box.memory.size() > 0 && r.size() != box.memory[0].r.size();
    if (is_odd || !std::isfinite(r.squaredNorm())) return std::nullopt;
    return ResidualSample{to_vector(box.space.to_unit(point)),
                          r,
                          slopes(point, *outcome),
                          r.squaredNorm(),
                          outcome->stand_ins};
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
  std::vector<DesignPoint> plan;
  const auto take = [&](const std::vector<Wanted>& wanted) {
    for (const Wanted& w : wanted) {
      const bool is_named = std::find(plan.begin(), plan.end(), w.point) != plan.end();
      if (std::ssize(plan) < count && !is_named) plan.push_back(w.point);
    }
  };
  take(state_->wanted);
  if (plan.empty() || std::ssize(plan) == count) return plan;
  State future = *state_;
  if (!future.box.has_center()) {  // nothing to expect yet: the geometry will be wanted anyway
    future.options.outstanding = count;
    future.fill();
    take(future.wanted);
  }
  while (std::ssize(plan) < count && future.box.has_center() && !future.wanted.empty()) {
    const DesignPoint first = future.wanted.front().point;
    future.observe(first, future.box.expected(first));
    take(future.wanted);
  }
  return plan;
}

void ResidualTrustRegion::observe(const DesignPoint& point, const Result<Score>& outcome) {
  state_->observe(point, state_->sample(point, outcome));
}

bool ResidualTrustRegion::converged() const { return state_->wanted.empty(); }

}  // namespace latsch
