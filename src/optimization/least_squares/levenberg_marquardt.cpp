// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/levenberg_marquardt.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "optimization/least_squares/levenberg_marquardt_step.h"
#include "optimization/least_squares/residual_curvature.h"
#include "optimization/problem/option_check.h"
#include "optimization/problem/pending_points.h"
#include "optimization/problem/point_vector.h"
#include "optimization/region/start_toward_middle.h"

namespace latsch {
namespace {

// A gain is the ratio of the actual decrease of f to that predicted by the linear model. Smallest
// gain of an accepted step.
constexpr double kTaken = 1e-4;
constexpr double kPoorGain = 0.25;      // gain below which the radius is shortened
constexpr double kGainToExpand = 0.75;  // gain above which the radius is lengthened
// Multiple of the step that becomes the radius after a large gain.
constexpr double kExpansionOfRadius = 2.0;
// Multiple of the step that becomes the radius if the evaluation failed.
constexpr double kAfterFailure = 0.25;
// Smallest predicted decrease of a return to the floor of a valley, as a share of that of the step.
constexpr double kWorthReturning = 0.1;
// The search follows the floor of a valley if a step leaves more than this share of f.
constexpr double kSteepDescent = 0.1;
// Multiples of the step that become the radius after a return with a large or a medium gain.
constexpr double kExpansionOnReturn = 10.0, kRadiusOnReturn = 4.0;
// Smallest cosine between a step and the direction along which the curvature of the residuals is
// known.
constexpr double kAlongDescent = 0.8;
// Largest correction of a step for curvature, relative to the step [Transtrum & Sethna, alpha =
// 0.75].
constexpr double kMostTurn = 0.375;
// Smallest predicted decrease of a step corrected for curvature, as a share of that of the straight
// step.
constexpr double kWorthBending = 0.1;
// Limits of the factor by which a poor gain shortens the radius.
constexpr double kLeastCut = 0.1, kMostCut = 0.5;
// Predicted decrease of f, as a share of f, below which no step in the radius is worth an
// evaluation.
constexpr double kPromisesNothing = 1e-10;
constexpr double kPromisesMuch = 1e-6;  // share of f
// Share of the first f below which nothing is left to gain: residuals have decreased by ten digits.
constexpr double kNothingIsLeft = 1e-20;
// Share of the first f below which only rounding errors are left, if steps fail to decrease f:
// residuals have decreased by five digits.
constexpr double kRoundingIsLeft = 1e-10;
// Share of the step tolerance below which a radius is too short to find an improvement.
constexpr double kExhaustedStep = 0.01;
// The range of a variable is too wide for the tolerance if the full step is shorter than the
// tolerance and nevertheless predicts a decrease of kPromisesAllTheSame times f, while f exceeds
// kMuchIsLeft times the first f.
constexpr double kPromisesAllTheSame = 0.1;  // share of f
constexpr double kMuchIsLeft = 1e-6;         // share of the first f
constexpr double kNumbersOfTheCube = 1e-16;  // spacing of neighboring numbers in the unit cube

enum class LevenbergMarquardtEnding {
  none,
  flat,
  short_step,
  nothing_left,
  slow,
  edge,
  rounding,
  rough,
  hopeless
};

/// The residuals, slopes and value known at a point.
struct Linear : Slopes {
  DesignPoint point;
  double f = 0.0;
};

/// A point that the search has proposed and whose outcome it does not know yet: a start, with the
/// number of starts before it, or a step.
struct Attempt {
  Eigen::VectorXd u;
  DesignPoint point;
  int starts = 0;
  std::optional<LevenbergMarquardtStep> step = std::nullopt;
  // The residuals at the end of the step as the linear model predicts them.
  Eigen::VectorXd goal = {};
  // Number of returns since the step that ended on the side of a valley.
  int returns = 0;
  double f_astray = 0.0;  // f at the end of the original step, before all returns
};

void check(const LevenbergMarquardtOptions& options) {
  OptionCheck("Levenberg-Marquardt").lengths(options.initial_step, options.step_tolerance, 1.0);
}

/// Returns the position, as a share of the step, of the minimum of the parabola through f, its
/// slope at the start, and f_end.
double least_of_parabola(double f, double slope, double f_end) {
  const double share = -slope / (f_end - f - 2.0 * slope);  // f + 2 slope t + ... t^2
  return std::clamp(std::isfinite(share) ? share : kLeastCut, kLeastCut, kMostCut);
}

}  // namespace

struct LevenbergMarquardt::State {
  DesignSpace space;
  FeasibleRegion region;
  LevenbergMarquardtOptions options;

  Linear x;  // the best point
  // A second point with known residuals and slopes: the point before x, or the end of a step from x
  // that led up the side of a valley.
  std::optional<Slopes> along;
  std::optional<Linear> foreign;  // best point from other sources
  Eigen::VectorXd D;              // scales of the variables; empty before the first success
  double radius = 0.0;            // Delta
  double f_first = 0.0;
  bool has_failed = false;        // true if the last evaluation failed
  std::vector<double> reached;    // f after every accepted step
  PendingPoints<Attempt> wanted;  // at most one point; empty once the search has converged
  LevenbergMarquardtEnding end = LevenbergMarquardtEnding::none;

  State(const DesignSpace& s, const LevenbergMarquardtOptions& o)
      : space(s), region(s), options(o) {
    wanted.push_back({to_vector(space.to_unit(space.initial())), space.initial()});
  }

  /// One iteration: processes the outcome of an attempt and chooses the next one.
  void take(const Attempt& tried, std::optional<Linear> known) {
    if (tried.step) {
      if (known && returns_from(tried, *known)) return;
      judge(tried, std::move(known));
    } else if (known) {
      begin(std::move(*known));
    } else if (!foreign) {
      return start_again(tried);
    }
    if (foreign && (D.size() == 0 || foreign->f < x.f))
      begin(*std::exchange(foreign, std::nullopt));
    next_step();
  }

  void start_again(const Attempt& failed) {
    const auto start =
        start_toward_middle(space, region, {failed.u, failed.starts}, options.step_tolerance);
    if (start) {
      wanted.push_back({start->u, point_at(start->u), start->attempts});
    } else {
      end = LevenbergMarquardtEnding::hopeless;
    }
  }

  /// Starts at the first successful point, which may come from another source.
  void begin(Linear known) {
    const bool is_first = D.size() == 0;
    along.reset();
    move_to(std::move(known));
    if (!is_first) return;
    radius = options.initial_step * D.norm();
    f_first = x.f;
  }

  void move_to(Linear known) {
    x = std::move(known);
    D = Eigen::VectorXd::Ones(x.u.size());
  }

  bool is_in_valley() const {
    return reached.size() > 1 && x.f > kSteepDescent * reached[reached.size() - 2];
  }

  /// If a step ended on the side of a valley, proposes a step from there down to its floor,
  /// computed from the residuals and slopes on the side, and returns true.
  bool returns_from(const Attempt& tried, const Linear& at) {
    const LevenbergMarquardtStep& step = *tried.step;
    if (tried.returns >= options.most_returns || !is_in_valley() || (foreign && foreign->f < x.f) ||
        (x.f - at.f) / step.promised > kTaken)
      return false;
    const LevenbergMarquardtStep back = return_from(at, step, tried.goal);
    const double f_back = (at.r + at.J * back.p).squaredNorm();
    if (!(x.f - f_back > kWorthReturning * step.promised)) return false;
    const Eigen::VectorXd u = region.nearest(at.u + back.p);
    const double f_astray = tried.returns == 0 ? at.f : tried.f_astray;
    wanted.push_back({u, point_at(u), 0, step, tried.goal, tried.returns + 1, f_astray});
    return true;
  }

  /// Returns the step from the side of a valley to the point where the residuals are those
  /// predicted by the linear model for the original step, and no further: a step that continued
  /// along the valley would leave its floor again.
  LevenbergMarquardtStep return_from(const Linear& at,
                                     const LevenbergMarquardtStep& step,
                                     const Eigen::VectorXd& goal) const {
    const LevenbergMarquardtSteps steps(at.r - goal, at.J, D, at.u, region);
    const LevenbergMarquardtStep back = steps.damped(step.mu);
    return back.length > step.length ? steps.within(step.length) : back;
  }

  /// Sets the radius after a step and its returns to the floor of the valley, by the gain of all
  /// together.
  void judge_returns(const Attempt& tried, double gain) {
    const LevenbergMarquardtStep& step = *tried.step;
    if (gain > kGainToExpand) {
      radius = kExpansionOnReturn * step.length;
    } else if (gain >= kPoorGain) {
      radius = kRadiusOnReturn * step.length;
    } else {
      radius = std::min(radius, step.length) *
               (gain > kTaken ? kMostCut : least_of_parabola(x.f, step.slope, tried.f_astray));
    }
  }

  void judge(const Attempt& tried, std::optional<Linear> known) {
    const LevenbergMarquardtStep& step = *tried.step;
    has_failed = !known;
    if (!known && tried.returns == 0) {
      radius = kAfterFailure * step.length;
      return;
    }
    const double gain = known ? (x.f - known->f) / step.promised : 0.0;
    if (tried.returns > 0) {
      judge_returns(tried, gain);
    } else if (gain < kPoorGain) {
      radius = std::min(radius, step.length) * least_of_parabola(x.f, step.slope, known->f);
    } else if (gain > kGainToExpand || step.mu == 0.0) {
      radius = kExpansionOfRadius * step.length;
    }
    if (!(gain > kTaken)) {
      if (known && tried.returns == 0) along = std::move(*known);
      return;
    }
    along = std::move(x);
    move_to(std::move(*known));
    reached.push_back(x.f);
  }

  /// True if recent steps decreased f only little and the linear model predicts little more. Far
  /// from the end of a long valley steps may also decrease f only little, but the linear model
  /// predicts a large decrease.
  bool is_slow(const LevenbergMarquardtSteps& steps) const {
    constexpr std::size_t kSteps = 3;
    const double little = options.progress_tolerance * x.f;
    return reached.size() > kSteps && reached[reached.size() - 1 - kSteps] - x.f < little &&
           steps.most_promised() < 0.5 * little;
  }

  /// Returns the step corrected by the curvature of the residuals along the step, if the curvature
  /// is known.
  LevenbergMarquardtStep bend(const LevenbergMarquardtStep& step) const {
    if (!along) return step;
    const Eigen::VectorXd s = x.u - along->u;
    if (!(std::abs(s.dot(step.p)) > kAlongDescent * s.norm() * step.p.norm())) return step;
    const Eigen::VectorXd r = x.r + residual_curvature(x, *along, step.p);
    LevenbergMarquardtStep bent = LevenbergMarquardtSteps(r, x.J, D, x.u, region).damped(step.mu);
    bent.promised = x.f - (r + x.J * bent.p).squaredNorm();
    bent.slope = x.r.dot(x.J * bent.p);
    const bool is_trusted = (bent.p - step.p).norm() <= kMostTurn * step.p.norm() &&
                            bent.promised > kWorthBending * step.promised && bent.slope < 0.0;
    return is_trusted ? bent : step;
  }

  void next_step() {
    using End = LevenbergMarquardtEnding;
    const LevenbergMarquardtSteps steps(x.r, x.J, D, x.u, region);
    const auto length = [](const LevenbergMarquardtStep& s) {
      return s.p.lpNorm<Eigen::Infinity>();
    };
    const LevenbergMarquardtStep step = steps.within(radius);
    const bool is_short = length(steps.full()) < options.step_tolerance;
    const bool is_wide = is_short && steps.most_promised() > kPromisesAllTheSame * x.f &&
                         x.f > kMuchIsLeft * f_first;
    const double exhausted = is_wide ? kNumbersOfTheCube : kExhaustedStep * options.step_tolerance;
    if (x.f <= kNothingIsLeft * f_first) {
      end = End::nothing_left;
    } else if (!(steps.most_promised() > options.gain_tolerance * x.f)) {
      end = End::flat;
    } else if (is_short && !is_wide) {
      end = End::short_step;
    } else if (is_slow(steps)) {
      end = End::slow;
    } else if (!(step.promised > kPromisesNothing * x.f) || length(step) < exhausted) {
      const bool promises_much = steps.promised_by_one() > kPromisesMuch * x.f;
      end = has_failed                         ? End::edge
            : !promises_much                   ? End::flat
            : x.f <= kRoundingIsLeft * f_first ? End::rounding
                                               : End::rough;
    } else {
      const LevenbergMarquardtStep bent = bend(step);
      const Eigen::VectorXd u = region.nearest(x.u + bent.p);
      wanted.push_back({u, point_at(u), 0, bent, x.r + x.J * step.p});
    }
  }

  DesignPoint point_at(const Eigen::VectorXd& u) const {
    return space.from_unit({u.begin(), u.end()});
  }

  void observe(const DesignPoint& point, const Result<Score>& outcome) {
    const auto place = space.place(point);
    if (!place) return;
    const std::optional<Attempt> own = wanted.take(point);
    if (outcome && outcome->residuals.empty()) {
      throw InputError(
          "Levenberg-Marquardt: the target function gives no residuals; use another method, such "
          "as gss");
    }
    if (own && outcome && outcome->jacobian.empty()) {
      throw InputError(
          "Levenberg-Marquardt: the target function gives residuals without their derivatives; use "
          "a method that needs none, such as residual_trust_region");
    }
    std::optional<Linear> known = linear(own ? own->u : to_vector(*place), point, outcome);
    if (own) return take(*own, std::move(known));
    if (known && region.contains(known->u) && (!foreign || known->f < foreign->f)) {
      foreign = std::move(known);
    }
  }

  std::optional<Linear> linear(const Eigen::VectorXd& u,
                               const DesignPoint& point,
                               const Result<Score>& outcome) const {
    if (!outcome) return std::nullopt;
    const Eigen::VectorXd r = to_vector(outcome->residuals);
    const bool is_odd = D.size() > 0 && r.size() != x.r.size();
    Eigen::MatrixXd J = space.unit_jacobian(point, *outcome);
    if (is_odd || J.size() == 0 || !std::isfinite(r.squaredNorm())) return std::nullopt;
    return Linear{{u, r, std::move(J)}, point, r.squaredNorm()};
  }
};

LevenbergMarquardt::LevenbergMarquardt(const DesignSpace& space,
                                       const LevenbergMarquardtOptions& options) {
  check(options);
  state_ = std::make_unique<State>(space, options);
}

LevenbergMarquardt::~LevenbergMarquardt() = default;

std::vector<DesignPoint> LevenbergMarquardt::propose(int count) const {
  assert(count >= 1);
  Plan plan(count);
  plan.add(state_->wanted);
  // The next point after a successful step depends on the residuals of this step and cannot be
  // guessed. The next point after a failed evaluation is known and is proposed ahead for idle
  // workers, if evaluations have failed before.
  for (State future = *state_; state_->has_failed && !plan.is_full() && !future.wanted.empty();) {
    const Attempt first = *future.wanted.take(future.wanted.front().point);
    future.take(first, std::nullopt);
    plan.add(future.wanted);
  }
  return plan.points();
}

void LevenbergMarquardt::observe(const DesignPoint& point, const Result<Score>& outcome) {
  state_->observe(point, outcome);
}

bool LevenbergMarquardt::converged() const { return state_->wanted.empty(); }

std::string LevenbergMarquardt::ending() const {
  switch (state_->end) {
    case LevenbergMarquardtEnding::none:
      return "";
    case LevenbergMarquardtEnding::flat:
      return "at a minimum: the slopes of the residuals predict no improvement";
    case LevenbergMarquardtEnding::short_step:
      return "at a minimum: the next step is shorter than the tolerance";
    case LevenbergMarquardtEnding::nothing_left:
      return "with nothing left: the residuals have vanished";
    case LevenbergMarquardtEnding::slow:
      return "in a bent valley or at a kink: three steps together gained less than the noise of "
             "one measured value, and the slopes predict no more";
    case LevenbergMarquardtEnding::edge:
      return "at the edge of failed trials: steps that would gain fail";
    case LevenbergMarquardtEnding::rounding:
      return "with next to nothing left: the residuals are below the accuracy of the trials";
    case LevenbergMarquardtEnding::rough:
      return "on rough ground: steps, however short, do not bring the gain that the derivatives "
             "predict: these are wrong or the residuals are not smooth";
    case LevenbergMarquardtEnding::hopeless:
      return "without a result: every trial failed";
  }
  return "";
}

}  // namespace latsch
