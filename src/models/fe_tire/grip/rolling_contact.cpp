// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/grip/rolling_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace latsch::fe_tire {
namespace {

using Directions = RollingGrip::Directions;

/// The search for an equilibrium: the present state and what it costs.
class RollingSearch {
 public:
  RollingSearch(RollingBody& body,
                const RollingGrip& grip,
                const Eigen::VectorXd& q,
                const GripState& from,
                const RollingContactOptions& options)
      : body_(body), grip_(grip), options_(options), returns_(grip.lines().points(), 0) {
    now_.q = q;
    now_.state = from;
  }

  Result<RollingContactState> run() {
    const RollingContactState start = now_;
    if (run_at_once()) return now_;
    if (!options_.is_careful) return failure("states do not settle");
    const int solves = now_.solves;
    now_ = start;
    now_.solves = solves;
    std::ranges::fill(returns_, 0);
    return run_in_passes();
  }

 private:
  /// Newton's method in which points are released and return after every solution. Returns false if
  /// it does not settle: states may cycle, or a tangent is singular.
  bool run_at_once() {
    const double nearby = options_.nearby * body_.force_scale();
    evaluate(Directions::of_trial, true);
    Directions directions = R_.norm() <= nearby ? Directions::of_trial : Directions::kept;
    for (int k = 0; k < options_.most_at_once; ++k) {
      evaluate(directions, true);
      Eigen::VectorXd dq;
      ++now_.solves;
      if (!body_.solve(now_.q, now_.input, now_.tractions, R_, dq)) return false;
      const bool is_whole = step_at_once(directions, dq);
      const bool has_turned = directions == Directions::of_trial;
      // A step without turning follows one that turned too far.
      directions = is_whole ? Directions::of_trial : Directions::kept;
      // Far from equilibrium pressures are not yet those that limit tractions.
      if (R_.norm() > nearby) continue;
      ++now_.passes;
      const int changed = release() + give_back();
      if (changed <= options_.most_left && has_turned && R_.norm() <= accepted()) return true;
    }
    return false;
  }

  /// Takes the step, or a part of it if directions turn too far. Returns false for a part.
  bool step_at_once(Directions directions, const Eigen::VectorXd& dq) {
    const Eigen::VectorXd q = now_.q;
    const GripState state = now_.state;
    const double before = std::max(R_.norm(), options_.nearby * body_.force_scale());
    double share = 1.0;
    for (int half = 0;; ++half, share *= 0.5) {
      now_.q = q - share * dq;
      evaluate(directions, false);
      const bool is_enough = directions == Directions::kept || R_.norm() <= before;
      if (!is_enough && half < options_.most_parts) {
        now_.state = state;
        continue;
      }
      if (directions == Directions::of_trial) keep_directions();
      return is_enough && share == 1.0;
    }
  }

  /// Active sets of which each is solved before it changes; points return only when it has settled.
  Result<RollingContactState> run_in_passes() {
    evaluate(Directions::kept, true);
    for (; now_.passes < options_.most_passes; ++now_.passes) {
      if (!settle(Directions::kept, 1)) return failure("its tangent is singular");
      if (release() > 0) continue;
      if (!settle(Directions::of_trial, options_.most_iterations))
        return failure("its tangent is singular");
      if (release() > 0 || give_back() > 0) continue;
      if (R_.norm() <= accepted()) return now_;
      // States have settled, the residual has not: sliding points turn back and forth.
      if (is_better_than_before()) continue;
      if (R_.norm() <= options_.rounding * body_.force_scale()) return now_;
      return failure("directions of sliding do not settle");
    }
    return failure("points neither stick nor slide");
  }

  double accepted() const { return options_.tolerance * body_.force_scale(); }

  void evaluate(Directions directions, bool with_derivatives) {
    now_.input = body_.input(now_.q);
    grip_.admit(now_.input, now_.state);
    now_.tractions = grip_.tractions(now_.input, now_.state, directions, with_derivatives);
    R_ = body_.residual(now_.q, now_.input, now_.tractions);
  }

  /// Newton's method with the states as they are. Returns false if its tangent is singular.
  bool settle(Directions directions, int most) {
    for (int iteration = 0; iteration < most; ++iteration) {
      evaluate(directions, true);
      if (iteration > 0 && R_.norm() <= accepted()) return true;
      Eigen::VectorXd dq;
      ++now_.solves;
      if (!body_.solve(now_.q, now_.input, now_.tractions, R_, dq)) return false;
      if (!step(directions, dq)) return true;
    }
    return true;
  }

  /// Returns false if no share of the step reduces the residual.
  bool step(Directions directions, const Eigen::VectorXd& dq) {
    const Eigen::VectorXd q = now_.q;
    const GripState state = now_.state;
    const double norm = R_.norm();
    double share = 1.0;
    for (int half = 0; half <= options_.most_halvings; ++half, share *= 0.5) {
      now_.q = q - share * dq;
      evaluate(directions, false);
      if (directions == Directions::kept || R_.norm() < norm || R_.norm() <= accepted()) {
        if (directions == Directions::of_trial) keep_directions();
        return true;
      }
      now_.state = state;
    }
    now_.q = q;
    evaluate(directions, false);
    return false;
  }

  void keep_directions() {
    for (int k = 0; k < grip_.lines().points(); ++k) {
      if (now_.state.grip[k] == Grip::slides)
        now_.state.direction.col(k) = now_.tractions.t.col(k).normalized();
    }
  }

  /// Lets points slide that stick beyond mu p. Returns their number.
  int release() {
    int count = 0;
    for (int k = 0; k < grip_.lines().points(); ++k) {
      if (now_.state.grip[k] != Grip::sticks) continue;
      const double size = now_.tractions.t.col(k).norm();
      if (size <= (1.0 + options_.excess) * now_.tractions.limit[k]) continue;
      now_.state.grip[k] = Grip::slides;
      now_.state.direction.col(k) = now_.tractions.t.col(k) / size;
      ++count;
    }
    return count;
  }

  /// Lets points stick whose trial traction is below mu p in the direction in which they slide.
  int give_back() {
    int count = 0;
    for (int k = 0; k < grip_.lines().points(); ++k) {
      if (now_.state.grip[k] != Grip::slides || returns_[k] >= options_.most_returns) continue;
      if (!(now_.tractions.limit[k] > 0.0)) continue;  // without friction nothing sticks
      const double along = now_.tractions.trial.col(k).dot(now_.state.direction.col(k));
      if (along >= (1.0 - options_.excess) * now_.tractions.limit[k]) continue;
      now_.state.grip[k] = Grip::sticks;
      ++returns_[k];
      ++count;
    }
    return count;
  }

  bool is_better_than_before() {
    const bool better = R_.norm() < 0.5 * before_;
    before_ = R_.norm();
    return better;
  }

  Failure failure(const std::string& what) const {
    int wrong = 0;
    for (int k = 0; k < grip_.lines().points(); ++k) {
      const double size = now_.tractions.t.col(k).norm();
      wrong += size > (1.0 + 1e-6) * now_.tractions.limit[k] ? 1 : 0;
    }
    return Failure{
        fmt::format("rolling contact: {} after {} passes and {} solves; residual {:.3g} N, {} "
                    "points beyond the "
                    "limit of friction",
                    what,
                    now_.passes,
                    now_.solves,
                    R_.norm(),
                    wrong)};
  }

  RollingBody& body_;
  const RollingGrip& grip_;
  RollingContactOptions options_;
  RollingContactState now_;
  Eigen::VectorXd R_;
  double before_ = std::numeric_limits<double>::infinity();
  std::vector<int> returns_;
};

}  // namespace

Result<RollingContactState> roll(RollingBody& body,
                                 const RollingGrip& grip,
                                 const Eigen::VectorXd& q,
                                 const GripState& from,
                                 const RollingContactOptions& options) {
  const Result<RollingContactState> found = RollingSearch(body, grip, q, from, options).run();
  if (found.ok() || !options.is_careful) return found;
  // Another start, from a penalty so soft that directions settle, ends elsewhere.
  const RollingGrip soft(grip.lines(), grip.friction(), options.softer * grip.stiffness());
  const Result<RollingContactState> near = RollingSearch(body, soft, q, from, options).run();
  if (!near.ok()) return found;
  const auto again = RollingSearch(body, grip, near->q, near->state, options).run();
  return again.ok() ? again : found;
}

}  // namespace latsch::fe_tire
