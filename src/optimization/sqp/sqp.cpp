// SPDX-License-Identifier: Apache-2.0
#include "optimization/sqp/sqp.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <optional>

#include "optimization/problem/option_check.h"
#include "optimization/problem/pending_points.h"
#include "optimization/problem/point_vector.h"
#include "optimization/region/difference_directions.h"
#include "optimization/region/start_toward_middle.h"
#include "optimization/sqp/damped_bfgs.h"
#include "optimization/sqp/l1_merit.h"
#include "optimization/sqp/sqp_step.h"

namespace latsch {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Smallest decrease of the merit function as a share of the predicted one.
constexpr double kEta = 1e-4;
// Factors of the step length after a step without improvement and after a failed evaluation.
constexpr double kShorter = 0.5;
constexpr double kFailed = 0.25;
// Longest step of a variable as a share of its range.
constexpr double kLongest = 0.5;
// Largest growth of the limit on the step length, relative to the accepted step.
constexpr double kReachGrowth = 4.0;
// Share of the step tolerance below which a line search ends.
constexpr double kExhausted = 0.1;
// Multiples of a difference's length that are tried one after the other if the evaluation fails.
constexpr std::array kAttempts{1.0, -1.0, 0.25, -0.25};

enum class Phase { start, differences, search, ended };

/// A point that the search has proposed and whose outcome it does not know yet.
struct WantedPoint {
  VectorXd u;
  DesignPoint point;
  int column = 0;  // index of the direction of a difference
  // Index in kAttempts or, for a start, number of calls of start_toward_middle.
  int attempt = 0;
};

void check(const SqpOptions& options) {
  const OptionCheck check("SQP");
  check.lengths(options.initial_step, options.step_tolerance, 0.5);
  check.require(options.difference > 0.0 && options.difference <= options.step_tolerance,
                "difference",
                options.difference,
                "above 0 and up to the step tolerance");
}

}  // namespace

struct Sqp::State {
  struct Iterate {
    VectorXd u;
    DesignPoint point;
    Score score;
    SmoothValues values;
  };

  DesignSpace space;
  FeasibleRegion region;
  SqpOptions options;
  Phase phase = Phase::start;
  PendingPoints<WantedPoint> wanted;  // in the order proposed; empty once the search has converged

  Iterate x;                       // the present point
  std::optional<Iterate> foreign;  // best point from other sources
  // The model's own derivatives at x. If there are none, J is empty, and D and S hold the
  // directions and the differences at x.
  MatrixXd J;
  MatrixXd D, S;
  SmoothSlopes slopes, before;  // slopes at x and at the previous point
  MatrixXd B;
  bool b_is_new = true;     // B was built from the step length alone
  bool has_slopes = false;  // slopes at the previous point are known
  SqpStep step;
  L1Merit merit;
  double longest;
  double share = 1.0;            // share a of the step in the line search
  std::optional<VectorXd> bent;  // end of the second-order correction being tried
  bool is_corrected = false;     // true if a correction of this step d was tried
  VectorXd last_move;

  State(const DesignSpace& s, const SqpOptions& o)
      : space(s), region(s), options(o), longest(o.initial_step) {
    wanted.push_back({to_vector(space.to_unit(space.initial())), space.initial()});
  }

  WantedPoint at(const VectorXd& u, int column = 0, int attempt = 0) const {
    return {u, space.from_unit({u.begin(), u.end()}), column, attempt};
  }

  /// The loop of algorithm 18.3 [Nocedal & Wright]. When it needs outcomes it lists the points and
  /// returns. Each outcome calls it again, and it continues where it stopped.
  void go_on(const WantedPoint& tried, const std::optional<Iterate>& known) {
    if (phase == Phase::differences) {
      take_difference(tried, known);
    } else if (phase == Phase::start ? begins(tried, known) : takes_step(tried, known)) {
      ask_slopes();
    }
    if (!wanted.empty() || phase == Phase::ended) return;
    take_slopes();    // f, c and their slopes at x
    update_b();       // B
    solve_program();  // step d and multipliers; raises mu above the multipliers
    // Begins with a = 1; takes_step() shortens a until phi falls enough; x <- x + a d.
    begin_search();
  }

  // Initial point ---------------------------------------------------------------------------

  /// Returns true if the search can begin at the point or at one from another source. If it cannot,
  /// another start is proposed; if none is left, the search ends.
  bool begins(const WantedPoint& tried, const std::optional<Iterate>& known) {
    if (known || foreign) {
      x = known ? *known : *std::exchange(foreign, std::nullopt);
      return true;
    }
    const auto start =
        start_toward_middle(space, region, {tried.u, tried.attempt}, options.step_tolerance);
    if (start) {
      wanted = {at(start->u, 0, start->attempts)};
    } else {
      phase = Phase::ended;
    }
    return false;
  }

  // Slopes at x ------------------------------------------------------------------------------

  /// Returns the model's own derivatives if the problem has no nonlinear constraints. Otherwise the
  /// result is empty, because derivatives of these constraints are not known.
  MatrixXd known_jacobian(const Iterate& at) const {
    if (!at.score.constraints.empty() || !at.score.equations.empty()) return {};
    return space.unit_jacobian(at.point, at.score);
  }

  PendingPoints<WantedPoint> differences_at(const VectorXd& u) const {
    PendingPoints<WantedPoint> points;
    const MatrixXd directions = difference_directions(region, u, options.difference);
    for (int k = 0; k < directions.cols(); ++k) {
      points.push_back(at(u + options.difference * directions.col(k), k));
    }
    return points;
  }

  void ask_slopes() {
    const bool is_comparable = foreign && same_shape(foreign->values, x.values);
    if (is_comparable && is_better(foreign->score, x.score)) {
      x = *std::exchange(foreign, std::nullopt);
      has_slopes = false;  // slopes of the Lagrangian along the last step are not known
    }
    J = known_jacobian(x);
    if (J.size() > 0) return;
    D = difference_directions(region, x.u, options.difference);
    S = MatrixXd::Zero(all_values(x.values).size(), D.cols());
    wanted = differences_at(x.u);
    phase = Phase::differences;
    if (wanted.empty()) phase = Phase::ended;  // the region is a single point
  }

  void take_difference(const WantedPoint& tried, const std::optional<Iterate>& known) {
    if (known && same_shape(known->values, x.values)) {
      const double length = options.difference * kAttempts[tried.attempt];
      S.col(tried.column) = (all_values(known->values) - all_values(x.values)) / length;
    } else {
      for (int k = tried.attempt + 1; k < std::ssize(kAttempts); ++k) {
        const VectorXd u = x.u + options.difference * kAttempts[k] * D.col(tried.column);
        if (!region.contains(u)) continue;
        wanted.push_back(at(u, tried.column, k));
        return;
      }
    }
  }

  void take_slopes() {
    before = std::exchange(slopes, slopes_at(x.values, J.size() > 0 ? J : jacobian_of(S, D)));
  }

  // Matrix B --------------------------------------------------------------------------------

  VectorXd slope_of_lagrangian(const SmoothSlopes& at) const {
    return at.g + at.c.transpose() * step.mu + at.h.transpose() * step.lambda;
  }

  /// Sets B to a multiple of the unit matrix such that the step of steepest descent has the longest
  /// allowed length.
  void renew_b() {
    const auto n = x.u.size();
    const double steepest = std::max(slopes.g.norm(), std::numeric_limits<double>::min());
    B = steepest / longest * MatrixXd::Identity(n, n);
    b_is_new = true;
  }

  void update_b() {
    if (slopes.r.size() > 0) {
      B = 2.0 * slopes.r.transpose() * slopes.r;
      b_is_new = false;
    } else if (has_slopes) {
      const VectorXd y = slope_of_lagrangian(slopes) - slope_of_lagrangian(before);
      B = damped_bfgs(std::move(B), last_move, y, b_is_new);
      b_is_new = false;
    } else {
      renew_b();
    }
    has_slopes = true;
  }

  // Step d, and share a of the line search --------------------------------------------------

  void solve_program() {
    step = sqp_step(B, x.values, slopes, region, x.u, longest);  // (18.11)
    merit.raise_above(step);
  }

  /// The end of a step lies inside the region except for rounding, which `nearest` removes.
  void begin_search() {
    share = 1.0;
    bent.reset();
    is_corrected = false;
    phase = Phase::search;
    wanted = {at(region.nearest(x.u + step.d))};
    if (!(step.d.norm() > 0.0)) give_up();
  }

  bool is_last() const {
    return step.d.lpNorm<Eigen::Infinity>() < options.step_tolerance && !b_is_new;
  }

  /// Returns true if the point is accepted. If it is not, another step is proposed, or the search
  /// ends.
  bool takes_step(const WantedPoint& tried, const std::optional<Iterate>& known) {
    const double predicted = merit.slope(x.values, slopes, step.d);
    const bool fits = known && same_shape(known->values, x.values);
    const double gain = fits ? merit(x.values) - merit(known->values) : 0.0;
    if (fits && gain > 0.0 && gain >= -kEta * share * predicted) {  // (18.28)
      return accepts(tried, *known);
    }
    const bool is_bent = fits && !bent && !is_corrected && share == 1.0 &&
                         known->values.violation() > x.values.violation();
    if (is_last()) {
      give_up();
    } else if (is_bent) {
      correct(*known);
    } else {
      shorten(known ? kShorter : kFailed);
    }
    return false;
  }

  void shorten(double factor) {
    bent.reset();
    share *= factor;
    if (share * step.d.lpNorm<Eigen::Infinity>() < kExhausted * options.step_tolerance) {
      return give_up();
    }
    wanted = {at(region.nearest(x.u + share * step.d))};
  }

  /// Computes the second-order correction: solves the program with the constraint values at the end
  /// of the step.
  void correct(const Iterate& end) {
    SmoothValues values = x.values;
    values.c = end.values.c - slopes.c * step.d;
    values.h = end.values.h - slopes.h * step.d;
    bent = sqp_step(B, values, slopes, region, x.u, longest).d;
    is_corrected = true;
    wanted = {at(region.nearest(x.u + *bent))};
  }

  /// Makes the point the present one. Returns false if the search ends there.
  bool accepts(const WantedPoint& tried, const Iterate& known) {
    last_move = tried.u - x.u;
    const double length = last_move.lpNorm<Eigen::Infinity>();
    const bool ends = is_last();
    longest = share == 1.0 ? std::min(std::max(longest, kReachGrowth * length), kLongest)
                           : std::max(2.0 * length, options.step_tolerance);
    x = known;
    if (ends) phase = Phase::ended;
    return !ends;
  }

  /// Resets B to a multiple of the unit matrix if no step along d improves. If this has been done
  /// already, ends the search.
  void give_up() {
    wanted.clear();
    if (b_is_new || slopes.r.size() > 0 || is_last()) {
      phase = Phase::ended;
      return;
    }
    longest = std::max(options.step_tolerance, share * step.d.lpNorm<Eigen::Infinity>());
    renew_b();
    solve_program();
    begin_search();
  }

  // Outcomes ---------------------------------------------------------------------------------

  void observe(const DesignPoint& point, const Result<Score>& outcome) {
    std::optional<Iterate> known;
    const auto place = space.place(point);
    if (!place) return;
    const std::optional<WantedPoint> tried = wanted.take(point);
    const VectorXd u = tried ? tried->u : to_vector(*place);
    if (outcome) {
      if (auto values = smooth_values(*outcome)) known = Iterate{u, point, *outcome, *values};
    }
    if (!tried) return look_at_foreign(known);
    go_on(*tried, known);
  }

  void look_at_foreign(const std::optional<Iterate>& known) {
    if (!known || !region.contains(known->u)) return;
    if (!foreign || is_better(known->score, foreign->score)) foreign = known;
  }

  /// Returns the points that the search will evaluate next once the outstanding outcomes are known.
  PendingPoints<WantedPoint> speculation() const {
    if (phase != Phase::start && phase != Phase::search) return {};
    PendingPoints<WantedPoint> points = differences_at(wanted.front().u);
    if (phase == Phase::search) {
      points.push_back(at(region.nearest(x.u + kShorter * share * step.d)));
    }
    return points;
  }
};

Sqp::Sqp(const DesignSpace& space, const SqpOptions& options) {
  check(options);
  state_ = std::make_unique<State>(space, options);
}

Sqp::~Sqp() = default;

std::vector<DesignPoint> Sqp::propose(int count) const {
  assert(count >= 1);
  Plan plan(count);
  plan.add(state_->wanted);
  if (!plan.is_empty() && !plan.is_full()) plan.add(state_->speculation());
  return plan.points();
}

void Sqp::observe(const DesignPoint& point, const Result<Score>& outcome) {
  state_->observe(point, outcome);
}

bool Sqp::converged() const { return state_->wanted.empty(); }

}  // namespace latsch
