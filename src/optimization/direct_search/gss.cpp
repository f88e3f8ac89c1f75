// SPDX-License-Identifier: Apache-2.0
#include "optimization/direct_search/gss.h"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <optional>
#include <string>

#include "optimization/direct_search/model_step.h"
#include "optimization/problem/feasible_region.h"
#include "optimization/problem/infinity.h"
#include "optimization/problem/option_check.h"
#include "optimization/problem/pending_points.h"
#include "optimization/problem/point_vector.h"
#include "optimization/problem/shared_history.h"
#include "optimization/region/conforming_set.h"

namespace latsch {
namespace {

// Radius within which the quadratic model is minimized, as a share of the step. A larger value
// trusts the model farther away.
constexpr double kReach = 0.8;
// Smallest distance of a proposed point to all known points, as a share of the step. A nearer point
// would give no information.
constexpr double kNew = 0.05;
constexpr double kLongestStep = 0.25;  // longest step, as a share of every variable's range
// Factor by which the step grows after more than kSuccessesToExpand successes in a row.
constexpr double kExpansion = 2.0;
constexpr int kSuccessesToExpand = 4;

// Distance, as a share of the step tolerance, within which a point is moved onto a linear
// constraint.
constexpr double kSnap = 0.5;

constexpr int kNoDirection = -1;

struct Direction {
  Eigen::VectorXd d;
  double step;
};

/// A point that the search has proposed and whose outcome it does not know yet.
struct Proposal {
  Eigen::VectorXd u;
  DesignPoint point;
  double step;  // length of the step, from which the required decrease follows
  // Index in the set of directions `set`; kNoDirection for the start and a model step.
  int direction = kNoDirection;
  int set = 0;
};

void check(const GssOptions& options) {
  const OptionCheck check("GSS");
  check.lengths(options.initial_step, options.step_tolerance, 1.0);
  check.require(options.contraction > 0.0 && options.contraction < 1.0,
                "contraction",
                options.contraction,
                "between 0 and 1");
  check.require(options.sufficient_decrease >= 0.0,
                "sufficient decrease",
                options.sufficient_decrease,
                "0 or more");
  check.require(options.outstanding >= 1, "outstanding", options.outstanding, "1 or more");
}

bool has_place_inside(const DesignSpace& space, const DesignPoint& point) {
  const auto place = space.place(point);
  if (!place) return false;
  const auto is_inside = [](double u) { return u >= 0.0 && u <= 1.0; };
  return std::all_of(place->begin(), place->end(), is_inside);
}

}  // namespace

struct Gss::State {
  DesignSpace space;
  FeasibleRegion region;
  GssOptions options;

  Eigen::VectorXd x;     // the best point, in the unit cube
  double f = kInfinity;  // its value
  std::vector<Direction> directions;
  double length;  // the longest step of the present set of directions
  int set = 0;    // number of the present set of directions
  int turn = 0;
  Eigen::VectorXd last_move;
  int successes = 0;  // number of successes in a row

  SharedHistory<Sample> samples;   // evaluated points whose value is finite
  SharedTable values;              // values of all points
  bool model_is_new = false;       // an outcome arrived since the last model step
  PendingPoints<Proposal> wanted;  // in the order proposed; empty once the search has converged

  State(const DesignSpace& s, const GssOptions& o)
      : space(s),
        region(s),
        options(o),
        x(to_vector(s.to_unit(s.initial()))),
        length(o.initial_step) {
    last_move = Eigen::VectorXd::Zero(x.size());
    start_poll();
    wanted.push_back({x, space.initial(), length});
    fill();
  }

  bool is_better(double value, double step) const {
    return value < f - options.sufficient_decrease * step * step;
  }

  /// Begins a new set of directions around x, ordered so that the one nearest to the last move
  /// comes first.
  void start_poll() {
    ++set;
    directions.clear();
    for (Eigen::VectorXd& d : conforming_set(region, x, length, turn)) {
      directions.push_back({std::move(d), length});
    }
    std::stable_sort(directions.begin(), directions.end(), [&](const auto& a, const auto& b) {
      return a.d.dot(last_move) > b.d.dot(last_move);
    });
  }

  void move_to(const Eigen::VectorXd& u, double value) {
    if (++successes > kSuccessesToExpand) {
      length = std::max(length, std::min(kExpansion * length, kLongestStep));
    }
    last_move = f < kInfinity ? Eigen::VectorXd(u - x) : Eigen::VectorXd::Zero(x.size());
    x = u;
    f = value;
    start_poll();
  }

  void contract(Direction& direction) {
    direction.step *= options.contraction;
    const auto failed = [&](const Direction& d) { return d.step < length; };
    if (!std::all_of(directions.begin(), directions.end(), failed)) return;
    length *= options.contraction;
    ++turn;
    start_poll();
  }

  /// Processes the value of the point `tried`.
  void take(const Proposal& tried, double value) {
    if (is_better(value, tried.step) && region.contains(tried.u)) {
      move_to(tried.u, value);
    } else if (tried.direction == kNoDirection) {
      successes = 0;
    } else if (tried.set == set) {
      successes = 0;
      contract(directions[tried.direction]);
    }
  }

  /// Proposes the point u or, if a constraint lies between x and u, the point of the line from x to
  /// u on that constraint.
  Proposal toward(const Eigen::VectorXd& u, double step) const {
    const Eigen::VectorXd inside =
        region.snapped(region.cut_off(x, u), kSnap * options.step_tolerance);
    return {inside, space.from_unit({inside.begin(), inside.end()}), step};
  }

  std::optional<Proposal> model_step() const {
    const double reach = kReach * length;
    const auto s = latsch::model_step(samples, region, x, reach);
    if (!s) return std::nullopt;
    Proposal step = toward(x + *s, length);
    const auto near = [&](const auto& known) { return (known.u - step.u).norm() < kNew * length; };
    for (int i = 0; i < samples.size(); ++i) {
      if (near(samples[i])) return std::nullopt;
    }
    if (std::any_of(wanted.begin(), wanted.end(), near)) return std::nullopt;
    if (values.find(step.point.bits())) return std::nullopt;
    return step;
  }

  /// Returns a point in the direction with the longest step among those not being tried; nullopt if
  /// there is none or if this step is below the tolerance.
  std::optional<Proposal> poll_step() const {
    int longest = kNoDirection;
    for (int i = 0; i < std::ssize(directions); ++i) {
      const auto is_tried = [&](const Proposal& w) { return w.set == set && w.direction == i; };
      if (std::any_of(wanted.begin(), wanted.end(), is_tried)) continue;
      if (longest == kNoDirection || directions[i].step > directions[longest].step) longest = i;
    }
    if (longest == kNoDirection) return std::nullopt;
    const Direction& direction = directions[longest];
    if (direction.step < options.step_tolerance) return std::nullopt;
    Proposal step = toward(x + direction.step * direction.d, direction.step);
    step.direction = longest;
    step.set = set;
    return step;
  }

  /// Returns the next point that is neither known nor wanted yet.
  std::optional<Proposal> next() {
    if (std::exchange(model_is_new, false)) {
      if (auto step = model_step()) return step;
    }
    while (auto step = poll_step()) {
      // True if a bound leaves almost no room for the step.
      const bool is_cut_off = (step->u - x).norm() < 0.5 * options.step_tolerance;
      if (is_cut_off || wanted.contains(step->point)) {
        contract(directions[step->direction]);
        continue;
      }
      const double* known = values.find(step->point.bits());
      if (!known) return step;
      take(*step, *known);
    }
    return std::nullopt;
  }

  void fill() {
    while (wanted.size() < options.outstanding) {
      auto step = next();
      if (!step) return;
      wanted.push_back(std::move(*step));
    }
  }

  void observe(const DesignPoint& point, double value) {
    const std::optional<Proposal> own = wanted.take(point);
    // An outside source may report points outside of the bounds; they have no value for a search
    // inside them.
    if (!own && !has_place_inside(space, point)) return;
    const Proposal tried = own ? *own : Proposal{to_vector(space.to_unit(point)), point, length};
    values.set(point.bits(), value);
    if (value < kInfinity) {
      samples.push_back({tried.u, value});
      model_is_new = true;
    }
    take(tried, value);
    fill();
  }
};

Gss::Gss(const DesignSpace& space, const GssOptions& options) {
  check(options);
  state_ = std::make_unique<State>(space, options);
}

Gss::~Gss() = default;

std::vector<DesignPoint> Gss::propose(int count) const {
  assert(count >= 1);
  Plan plan(count);
  plan.add(state_->wanted);
  if (plan.is_empty() || plan.is_full()) return plan.points();
  State future = *state_;
  while (!plan.is_full()) {
    const DesignPoint awaited = future.wanted.front().point;
    future.observe(awaited, kInfinity);
    if (future.wanted.empty()) break;
    plan.add(future.wanted.back().point);
  }
  return plan.points();
}

void Gss::observe(const DesignPoint& point, const Result<Score>& outcome) {
  state_->observe(point, outcome ? outcome->value : kInfinity);
}

std::string Gss::ending() const {
  if (!converged()) return {};
  return state_->f < kInfinity ? "where no direction gains with a step of the tolerance"
                               : "without a result: every trial failed";
}

bool Gss::converged() const { return state_->wanted.empty(); }

}  // namespace latsch
