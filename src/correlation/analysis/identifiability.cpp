// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/identifiability.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "base/text.h"
#include "base/units.h"
#include "correlation/analysis/identification_rounds.h"
#include "correlation/analysis/identification_start.h"
#include "correlation/analysis/noise_ratios.h"
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

/// Returns in words the names of the variables for which `holds` is true: "a, b and c".
std::string names_where(const Study& study, const std::function<bool(int)>& holds) {
  std::vector<std::string> names;
  for (int i = 0; i < study.space.size(); ++i) {
    if (holds(i)) names.push_back(study.space[i].name);
  }
  if (names.size() < 2) return names.empty() ? "" : names.front();
  const std::string last = names.back();
  names.pop_back();
  return fmt::format("{} and {}", fmt::join(names, ", "), last);
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

namespace {

/// True if the interval of a variable comes from its bounds alone: the data determine it so exactly
/// that the interval is as narrow as the spacing of representable numbers between these bounds.
bool is_set_by_bounds(const Identifiability& what, int variable) {
  constexpr double kNeighbors = 1e-15;  // share of the range; the least possible interval has 8e-16
  const Interval& own = what.identification.confidence().intervals[static_cast<size_t>(variable)];
  return own.upper > own.lower && own.upper - own.lower <= kNeighbors;
}

using Sentences = std::vector<std::string>;

/// Adds remarks about values beyond the scale of a robust loss.
void remark_on_losses(const Confidence& c, Sentences& all) {
  if (c.beyond == 0) return;
  std::string text = fmt::format(
      "{} of {} values {} beyond the corner of {} loss: fit and intervals count {} no more than a "
      "value at the corner.",
      c.beyond,
      c.with_loss,
      c.beyond == 1 ? "lies" : "lie",
      c.beyond == 1 ? "its" : "their",
      c.beyond == 1 ? "it" : "each");
  // standard deviations, which chance exceeds once in a thousand cases
  constexpr double kRare = 3.1;
  const double expected = c.expected_beyond * c.with_loss;
  const double chance = kRare * std::sqrt(expected * (1.0 - c.expected_beyond));
  if (c.expected_beyond > 0.0 && c.beyond > expected + chance + 1.0) {
    text += fmt::format(
        " The stated noise leaves some {:.0f} there: it is too small, or the others are wrong.",
        expected);
  }
  all.push_back(std::move(text));
  if (c.noise.size() - c.beyond <= c.singular_values.size()) {
    all.emplace_back(
        "No more values lie inside the corner than there are variables, so they do not determine "
        "these: a larger loss_scale lets more values count.");
  }
}

/// Returns the root mean square of all residuals over their stated noise if chance does not explain
/// it; else 1, also without a stated noise or with a robust loss.
double rms_over_stated_noise(const Study& study, const Identification& identification) {
  constexpr double kOfSharedNoise = 4.0;  // neighbors that share noise are fewer values
  const Confidence& c = identification.confidence();
  const Eigen::VectorXd& r = identification.linearization().r;
  const std::optional<double> sigma = residual_sigma(study);
  if (!sigma || c.with_loss > 0 || r.size() == 0) return 1.0;
  const double ratio = r.squaredNorm() / (static_cast<double>(r.size()) * *sigma * *sigma);
  const double rare = rare_ratio(static_cast<double>(r.size()));
  return ratio > (c.is_colored ? std::max(rare, kOfSharedNoise) : rare) ? std::sqrt(ratio) : 1.0;
}

/// Adds remarks about the noise that the intervals assume.
void remark_on_noise(const Study& study, const Identifiability& what, Sentences& all) {
  const Confidence& c = what.identification.confidence();
  const std::vector<NoiseRatio> ratios = c.sigma > 0.0 && c.with_loss == 0
                                             ? noise_ratios(study, what.identification)
                                             : std::vector<NoiseRatio>();
  if (c.excess > 1.0) {
    all.push_back(fmt::format(
        "The residuals are {:.2g} times their stated noise{}: a stated noise or the deviation of a "
        "prior is too small, the model cannot follow the measurement, or the search ended early. "
        "The intervals of all variables use the observed spread.",
        c.excess,
        in_words(ratios)));
  }
  const double whole = c.excess > 1.0 ? 1.0 : rms_over_stated_noise(study, what.identification);
  if (whole > 1.0) {
    all.push_back(fmt::format(
        "The residuals are {:.2g} times their stated noise{}, although their slopes promise values "
        "that explain them: bounds, or an early end of the search, keep the fit from them. The "
        "intervals count the stated noise alone and do not say how far the values are from those "
        "of "
        "a model that fits.",
        whole,
        in_words(ratios)));
  }
  if (const std::string words = large_noise_in_words(study, ratios); !words.empty())
    all.push_back(words);
  if (std::isnan(c.sigma)) {
    all.emplace_back(
        "There are no more measured values than variables, so the fit does not show how exact "
        "they are: no interval is known. State the noise of the experiments.");
  }
  if (c.is_pattern) {
    all.emplace_back(
        "The residuals are a systematic misfit and no noise: they vary smoothly along the curves, "
        "or a bound causes them. The intervals follow from their size; they do not say how far the "
        "values are from those of a model that fits.");
  } else if (c.is_colored) {
    all.emplace_back(
        "Neighboring values seem to share noise: the intervals count them as correspondingly fewer "
        "values.");
  }
}

/// Adds a remark if the fit is as exact as only computed values allow. The spread of its residuals
/// is then rounding, and intervals by this spread say nothing about a laboratory's values.
void remark_on_exact_fit(const Study& study, const Identifiability& what, Sentences& all) {
  constexpr double kExact = 1e-6;  // deviation of a difference, as a share of its scale
  constexpr double kUsual = 0.01;  // noise of a usual measurement, as a share of the scale
  const Confidence& c = what.identification.confidence();
  if (!(c.sigma <= kExact) || !study.free.empty()) return;
  for (const StudyExperiment& experiment : study.experiments)
    if (experiment.fitted && (experiment.noise || experiment.objective.weight != 1.0)) return;
  ConfidenceOptions options = options_for(study, Depth::at_the_point).confidence;
  options.sigma = kUsual;
  options.traits = options.traits.of(what.identification.residuals_used());
  const Confidence usual = confidence(what.identification.linearization(), options);
  std::vector<std::string> intervals;
  for (int i = 0; i < study.space.size(); ++i)
    intervals.push_back(
        study.space[i].name + " " +
        interval_text(study.space, i, usual.intervals[static_cast<std::size_t>(i)]));
  all.push_back(
      fmt::format("The fit leaves {:.1g} of the values: this is rounding and no noise, and so are "
                  "the intervals. "
                  "With noise of 1 % of the values they would be: {}. State the noise of the "
                  "experiments to have "
                  "them everywhere.",
                  c.sigma,
                  fmt::join(intervals, "; ")));
}

/// Adds a remark if bounds keep the fit from most of the improvement that the slopes predict.
void remark_on_bounds(const Study& study, const Confidence& c, Sentences& all) {
  constexpr double kMuch = 0.5;  // share of the sum of squares
  if (!(c.share_beyond_bounds > kMuch)) return;
  const std::string held =
      names_where(study, [&](int i) { return c.held[static_cast<size_t>(i)] != Bound::none; });
  const bool is_one = held.find(" and ") == std::string::npos;
  all.push_back(fmt::format(
      "{} {} held at {}: beyond {}, {:.0f} % of the sum of squares would vanish, by the slopes. "
      "All "
      "other intervals hold for {} at {}; the true values lie outside of the bounds, or the model "
      "is wrong.",
      held,
      is_one ? "is" : "are",
      is_one ? "its bound" : "their bounds",
      is_one ? "it" : "them",
      // 100 % would claim that the fit is exact beyond the bound
      std::min(99.0, 100.0 * c.share_beyond_bounds),
      held,
      is_one ? "this bound" : "these bounds"));
}

/// Adds remarks about variables whose interval or derivative is doubtful.
void remark_on_variables(const Study& study, const Identifiability& what, Sentences& all) {
  const Identification& identification = what.identification;
  const std::string set_by_bounds =
      names_where(study, [&](int i) { return is_set_by_bounds(what, i); });
  if (!set_by_bounds.empty()) {
    all.push_back("The interval of " + set_by_bounds +
                  " comes from the bounds alone: they are so far apart that the numbers between "
                  "them differ by more than the data leave open. Narrower bounds show what the "
                  "data tell.");
  }
  const auto& slopes = identification.slopes();
  const std::string rough = names_where(
      study, [&](int i) { return slopes[static_cast<size_t>(i)] == SlopeQuality::rough; });
  if (!rough.empty()) {
    all.push_back("No step gives a straight difference in " + rough +
                  ": the model is rough or strongly curved there, so its linear interval is a "
                  "guess.");
  }
  const std::string one_sided = names_where(
      study, [&](int i) { return slopes[static_cast<size_t>(i)] == SlopeQuality::one_sided; });
  if (!one_sided.empty()) {
    all.push_back("Beside the point the model fails in " + one_sided +
                  ": its derivative is that of a single step.");
  }
  for (const Eigen::VectorXd& direction : identification.unknown_directions()) {
    all.push_back("Along " + direction_text(study.space, direction) +
                  " differences contain only their own errors: as far as they show, the data do "
                  "not determine it.");
  }
}

/// Adds remarks about mesh and step.
void remark_on_refinement(const Study& study, const Identifiability& what, Sentences& all) {
  const Confidence& c = what.identification.confidence();
  if (study.refinement && !what.refined_shift) {
    all.emplace_back(
        "The refined model was not evaluated there, or failed: the intervals do not include the "
        "effect of mesh and step.");
  }
  if (what.refined_shift) {
    const std::string moved = names_where(study, [&](int i) {
      const Interval& own = c.intervals[static_cast<size_t>(i)];
      return std::abs((*what.refined_shift)[i]) > 0.5 * (own.upper - own.lower);
    });
    if (!moved.empty()) {
      all.push_back("Mesh and step change more than the noise in " + moved +
                    ": fit the refined model instead.");
    }
  }
}

/// Adds a remark if refits of the profiles did not converge.
void remark_on_profiles(const Identification& identification, Sentences& all) {
  int refits = 0, failed = 0;
  for (const TargetProfile& profile : identification.profiles()) {
    refits += static_cast<int>(profile.points.size());
    failed += profile.unconverged();
  }
  if (failed > 0) {
    all.push_back(fmt::format(
        "{} of {} refits of the profiles did not converge; intervals there may be wider.",
        failed,
        refits));
  }
}

}  // namespace

std::string interval_source(const Study& study, const Identifiability& what, int variable) {
  if (std::isnan(what.identification.confidence().sigma)) return "not known";
  const Interval interval = reported_interval(study, what, variable);
  const bool low = interval.lower > 0.0, high = interval.upper < 1.0;
  if (low != high) return "data and a bound";
  return low && !is_set_by_bounds(what, variable) ? "data" : "bounds";
}

std::vector<std::string> remarks(const Study& study, const Identifiability& what) {
  constexpr double kEarly = 1.0;  // multiple of the threshold of an interval; a profile ends there
  const Confidence& c = what.identification.confidence();
  Sentences all;
  remark_on_losses(c, all);
  remark_on_noise(study, what, all);
  remark_on_exact_fit(study, what, all);
  remark_on_bounds(study, c, all);
  remark_on_variables(study, what, all);
  remark_on_refinement(study, what, all);
  // A systematic misfit is larger than the threshold, so that its curvature alone promises a gain.
  constexpr double kOfMisfit = 0.01;  // share of the sum of squares
  const double least_gain =
      c.is_pattern ? kOfMisfit * what.identification.linearization().sum_of_squares() : 0.0;
  if (c.left_to_gain > std::max(kEarly * c.threshold(), least_gain)) {
    all.emplace_back(
        "The search ended early: recomputed derivatives predict a gain larger than an interval, "
        "so "
        "the point is no minimum yet. latsch identify continues from there.");
  }
  remark_on_profiles(what.identification, all);
  return all;
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
