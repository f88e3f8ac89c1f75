// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/identifiability.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "base/text.h"
#include "base/units.h"
#include "correlation/analysis/identification_rounds.h"
#include "correlation/analysis/identification_start.h"
#include "correlation/analysis/refined_shift.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/residuals.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

/// Returns the value, SI, of a variable at u in the unit cube.
double value_at(const DesignSpace& space, int variable, double u) {
  std::vector<double> all(space.size(), 0.5);
  all[variable] = u;
  return space.from_unit(all).values[variable];
}

/// Counts the trials of all rounds, and how many there will be.
class Forecast {
 public:
  RunProgress of(RunProgress progress, const WorkDone& done) {
    // share of the work before which no forecast of the number of trials is made from it
    constexpr double kTellsSomething = 0.03;
    known_ = progress.known;
    progress.known += before_;
    progress.planned = done.share >= kTellsSomething
                           ? before_ + std::lround(static_cast<double>(known_) / done.share)
                           : (done.left > 0 ? progress.known + done.left : 0);
    progress.work = done.work;
    return progress;
  }
  void round_done() {
    before_ += known_;
    known_ = 0;
  }

 private:
  long before_ = 0, known_ = 0;
};

DesignPoint best_of(const Study& study, const Journal& journal, const DesignPoint& otherwise) {
  const auto best = best_trial(study, journal);
  return best ? best->point : otherwise;
}

}  // namespace

Interval reported_interval(const Study& study, const Identifiability& what, int variable) {
  Interval interval = what.identification.confidence().intervals[static_cast<size_t>(variable)];
  if (what.refined_shift) {
    const double shift = (*what.refined_shift)[variable];
    interval.lower += std::min(0.0, shift);
    interval.upper += std::max(0.0, shift);
  }
  const double u = study.space.to_unit(what.best)[static_cast<size_t>(variable)];
  interval.lower = std::min(interval.lower, u);
  interval.upper = std::max(interval.upper, u);
  return interval;
}

std::optional<Interval> interval_of(const Study& study,
                                    const std::optional<Identifiability>& what,
                                    const DesignPoint& point,
                                    int variable) {
  if (!what || what->best != point) return std::nullopt;
  return reported_interval(study, *what, variable);
}

bool is_set_by_bounds(const Identifiability& what, int variable) {
  constexpr double kNeighbors = 1e-15;  // share of the range; the least possible interval has 8e-16
  const Interval& own = what.identification.confidence().intervals[static_cast<size_t>(variable)];
  return own.upper > own.lower && own.upper - own.lower <= kNeighbors;
}

std::string interval_source(const Study& study, const Identifiability& what, int variable) {
  if (std::isnan(what.identification.confidence().sigma)) return "not known";
  const Interval interval = reported_interval(study, what, variable);
  const bool low = interval.lower > 0.0, high = interval.upper < 1.0;
  if (low != high) return "data and a bound";
  return low && !is_set_by_bounds(what, variable) ? "data" : "bounds";
}

std::optional<Result<Identifiability>> identify(const Study& study,
                                                const DesignPoint& point,
                                                Depth depth,
                                                Executor& executor,
                                                Journal& journal,
                                                const RunOptions& options) {
  RunOptions enough = options;
  enough.max_steps = kMostIdentificationTrials;
  // at the end of a profile a trial may fail, which must not end the run
  enough.on_failure.then = FailurePolicy::Then::proceed;
  const Objective residuals = residual_objective(study);
  Forecast forecast;
  const Drive run = [&](Optimizer& optimizer, RefitTrials* refits, const AsksWorkDone& standing) {
    TrialStore* store = refits ? static_cast<TrialStore*>(refits) : &journal;
    const Objective objective = refits ? refits->objective() : residuals;
    enough.on_progress = [&](const RunProgress& progress) {
      if (options.on_progress) options.on_progress(forecast.of(progress, standing()));
    };
    const bool converged =
        run_optimizer(optimizer, objective, executor, store, enough).end == RunEnd::converged;
    forecast.round_done();
    return converged;
  };
  const DesignPoint begin = begin_identification(study, journal, point, depth);
  Identifiability result{
      begin, Identification(study.space, begin, options_for(study, depth)), std::nullopt};
  if (!analyze({study, journal, &journal, run}, result)) return std::nullopt;
  result.point = result.identification.center();
  result.best = best_of(study, journal, result.point);
  result.refined_shift = refined_shift(study, result.identification);
  std::optional<Result<Identifiability>> answer(std::in_place, std::move(result));
  const Result<Identifiability>& found = *answer;
  if (const Status first = found->identification.status(); !first) answer.emplace(first.failure());
  return answer;
}

namespace {

/// Returns the best trial at which the derivatives are known: by the derivatives in its recording
/// (`has_slopes`), or by trials beside it.
std::optional<DesignPoint> best_with_derivatives(const Study& study,
                                                 const Journal& journal,
                                                 bool& has_slopes) {
  auto rated = rated_candidates(study, journal);
  std::stable_sort(
      rated.begin(), rated.end(), [](const auto& a, const auto& b) { return a.target < b.target; });
  std::set<std::string> known, sloping;
  for (const RatedTrial& trial : rated) known.insert(trial.point.bits());
  journal.for_each_asked([&](const Trial& trial) {
    const auto& result = trial.outcome.result;
    if (result && result->has_slopes()) sloping.insert(trial.point.bits());
  });
  const auto has_neighbors = [&](const RatedTrial& trial) {
    if (sloping.contains(trial.point.bits())) return true;
    const auto points =
        Identification(study.space, trial.point, options_for(study, Depth::profiles)).wanted();
    return std::all_of(points.begin(), points.end(), [&](const DesignPoint& point) {
      return known.contains(point.bits());
    });
  };
  const auto best = std::find_if(rated.begin(), rated.end(), has_neighbors);
  if (best == rated.end()) return std::nullopt;
  has_slopes = sloping.contains(best->point.bits());
  return best->point;
}

}  // namespace

std::optional<Identifiability> recorded_identifiability(const Study& study,
                                                        const Journal& journal) {
  bool has_slopes = false;
  const auto best = best_with_derivatives(study, journal, has_slopes);
  if (!best) return std::nullopt;
  const auto read_from = [&](const DesignPoint& point, const IdentificationOptions& options) {
    Identifiability result{point, Identification(study.space, point, options), std::nullopt};
    if (!analyze({study, journal, nullptr, reading(study, journal)}, result) &&
        result.cross_validation && result.cross_validation->left_out().empty()) {
      result.cross_validation.reset();
    }
    return result;
  };
  IdentificationOptions options = options_for(study, Depth::profiles);
  Identifiability result =
      read_from(identification_start(study, journal, *best, Depth::profiles), options);
  if (!result.identification.is_linearized()) {
    options.most_centers = 1;  // other centers are not known
    result = read_from(*best, options);
  }
  if (!result.identification.is_linearized() && has_slopes) {
    options.profiles = false;  // the only derivatives are the slopes of the trial itself
    result = read_from(*best, options);
  }
  if (!result.identification.is_linearized()) return std::nullopt;
  result.point = result.identification.center();
  result.best = best_of(study, journal, result.point);
  result.refined_shift = refined_shift(study, result.identification);
  return result;
}

std::string shift_text(const Study& study, const Identifiability& what, int variable) {
  if (!what.refined_shift) return "";
  const DesignSpace& space = study.space;
  const double u = space.to_unit(what.best)[static_cast<size_t>(variable)];
  const Unit unit = Unit::of(space[variable].unit);
  const auto at = [&](double place) { return unit.from_si(value_at(space, variable, place)); };
  const double shift = at(u + (*what.refined_shift)[variable]) - at(u);
  const Interval interval = reported_interval(study, what, variable);
  const double half = 0.5 * (at(std::min(interval.upper, 1.0)) - at(std::max(interval.lower, 0.0)));
  const std::string number = format_known(shift, half);
  return (shift > 0.0 ? "+" : "") + number +
         (space[variable].unit == "1" ? "" : " " + space[variable].unit);
}

std::string direction_text(const DesignSpace& space, const Eigen::VectorXd& direction) {
  constexpr double kShare = 0.3;  // least component of a unit vector for which a variable is named
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  std::string text;
  for (int i = 0; i < space.size(); ++i) {
    if (std::abs(direction[i]) < kShare) continue;
    text += fmt::format("{}{} {}",
                        text.empty() ? "" : ", ",
                        space[i].name,
                        direction[i] * direction[largest] > 0.0 ? "up" : "down");
  }
  return text;
}

std::string profile_text(const DesignSpace& space, const TargetProfile& profile) {
  const Interval beyond_bounds{-1.0, 2.0};
  std::string text = interval_text(space, profile.variable, profile.interval);
  const auto add = [&](const std::optional<double>& end, bool lower) {
    if (!end) return;
    Interval at = beyond_bounds;
    (lower ? at.lower : at.upper) = *end;
    std::string value = interval_text(space, profile.variable, at);
    value = value.substr(value.find(' ', value.find(' ') + 1) + 1);  // removes "at least"
    text += (lower ? "; below " : "; above ") + value + " the model fails";
  };
  add(profile.lower_end, true);
  add(profile.upper_end, false);
  return text;
}

std::string known_digits(const DesignSpace& space,
                         int variable,
                         double value,
                         const Interval& interval) {
  const Unit unit = Unit::of(space[variable].unit);
  const double lower = unit.from_si(value_at(space, variable, std::max(interval.lower, 0.0)));
  const double upper = unit.from_si(value_at(space, variable, std::min(interval.upper, 1.0)));
  return format_known(unit.from_si(value), 0.5 * (upper - lower));
}

std::string value_text(const DesignSpace& space,
                       int variable,
                       double value,
                       const Interval& interval) {
  const std::string& unit = space[variable].unit;
  return known_digits(space, variable, value, interval) + (unit == "1" ? "" : " " + unit);
}

namespace {

/// Returns the closed end of a half-open interval. Its digits cannot follow from the interval's
/// width, which is infinite.
std::string limit_text(const DesignSpace& space, int variable, double value) {
  constexpr double kKnown = 0.03;  // assumed relative uncertainty, which sets the number of digits
  const std::string& unit = space[variable].unit;
  const double shown = Unit::of(unit).from_si(value);
  return format_known(shown, kKnown * std::abs(shown)) + (unit == "1" ? "" : " " + unit);
}

}  // namespace

std::string interval_text(const DesignSpace& space, int variable, const Interval& interval) {
  const double lower = value_at(space, variable, interval.lower),
               upper = value_at(space, variable, interval.upper);
  const bool low = interval.lower > 0.0, high = interval.upper < 1.0;
  if (low && high) {
    return known_digits(space, variable, lower, interval) + " .. " +
           value_text(space, variable, upper, interval);
  }
  if (low) return "at least " + limit_text(space, variable, lower);
  if (high) return "at most " + limit_text(space, variable, upper);
  return "anywhere between the bounds";
}

namespace {

/// Returns the bound that holds the variable in words; "" if none does.
std::string held_text(const Study& study, const Identifiability& what, int variable) {
  // distance from a bound, as a share of the range, within which a value counts as at the bound
  constexpr double kThere = 1e-6;
  const auto i = static_cast<size_t>(variable);
  const Bound held = what.identification.confidence().held[i];
  if (held == Bound::none) return "";
  const DesignVariable& v = study.space[variable];
  const bool is_lower = held == Bound::lower;
  const double u = study.space.to_unit(what.best)[i];
  const bool is_there = is_lower ? u <= kThere : u >= 1.0 - kThere;
  return fmt::format(", {} its bound {}",
                     is_there ? "held at" : "its least squares at",
                     format_quantity(is_lower ? v.lower : v.upper, v.unit, 5));
}

}  // namespace

std::string interval_text(const Study& study, const Identifiability& what, int variable) {
  const bool is_known = !std::isnan(what.identification.confidence().sigma);
  const Interval interval = reported_interval(study, what, variable);
  return (is_known ? interval_text(study.space, variable, interval) : "not known") +
         (is_known && is_set_by_bounds(what, variable) ? ", set by its bounds" : "") +
         held_text(study, what, variable);
}

}  // namespace latsch::correlation
