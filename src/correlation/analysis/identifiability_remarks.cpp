// SPDX-License-Identifier: Apache-2.0
// Sentences on a fit and its intervals beside their numbers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/text.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/noise_ratios.h"
#include "correlation/analysis/refined_shift.h"
#include "correlation/target/residuals.h"

namespace latsch::correlation {
namespace {

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

/// Returns the mean square of the residuals in units of the deviation that each has: the root of
/// its weight in units of the spread, 1 for a prior.
double mean_square_over_noise(const Study& study, const Identification& identification) {
  const Eigen::VectorXd& r = identification.linearization().r;
  const auto& used = identification.residuals_used();
  const std::vector<double> deviations = residual_traits(study).deviations;
  double sum = 0.0;
  for (Eigen::Index k = 0; k < r.size(); ++k) {
    const auto place = static_cast<std::size_t>(used[static_cast<std::size_t>(k)]);
    sum += std::pow(r[k] / deviations[place], 2);
  }
  return sum / static_cast<double>(r.size());
}

/// Returns the root mean square of all residuals over their stated noise if chance does not explain
/// it; else 1, also without a stated noise or with a robust loss.
double rms_over_stated_noise(const Study& study, const Identification& identification) {
  constexpr double kOfSharedNoise = 4.0;  // neighbors that share noise are fewer values
  const Confidence& c = identification.confidence();
  const Eigen::VectorXd& r = identification.linearization().r;
  const std::optional<double> sigma = residual_sigma(study);
  if (!sigma || c.with_loss > 0 || r.size() == 0) return 1.0;
  const double ratio = mean_square_over_noise(study, identification) / (*sigma * *sigma);
  const double rare = rare_ratio(static_cast<double>(r.size()));
  return ratio > (c.is_colored ? std::max(rare, kOfSharedNoise) : rare) ? std::sqrt(ratio) : 1.0;
}

/// Returns the names of fitted experiments whose measurement a filter has smoothed; "" if there are
/// none.
std::string filtered_experiments(const Study& study) {
  std::vector<std::string> names;
  for (const StudyExperiment& experiment : study.experiments) {
    if (!counts(experiment) || !experiment.read_from || !experiment.observable->is_sweep())
      continue;
    const std::vector<std::string>& steps = experiment.read_from->one_way();
    if (std::find(steps.begin(), steps.end(), "low_pass") != steps.end())
      names.push_back(experiment.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
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
  if (const std::string words = unlike_spreads_in_words(study, what.identification); !words.empty())
    all.push_back(words);
  if (const std::string words = scarce_estimates_in_words(study, c); !words.empty())
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
  } else if (c.is_colored && c.samples_for_one < 1.0) {
    all.emplace_back(
        "Neighboring values seem to scatter to opposite sides, so that their noise cancels: the "
        "intervals count them as correspondingly more values.");
  } else if (c.is_colored) {
    all.emplace_back(
        "Neighboring values seem to share noise: the intervals count them as correspondingly fewer "
        "values.");
  }
  const std::string filtered = c.is_pattern ? filtered_experiments(study) : "";
  if (!filtered.empty())
    all.push_back(fmt::format(
        "The measurement of {} is low-passed, which makes its noise smooth: the pattern may be "
        "filtered noise, of which the fit cannot tell the size. Fewer samples, some two a period "
        "of "
        "the filter's corner, have noise that neighbors do not share.",
        filtered));
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

/// Adds a remark if the values, which are those of the trial with the least target, are off the
/// least sum of squares, to which the intervals belong.
void remark_on_best(const Study& study, const Identifiability& what, Sentences& all) {
  constexpr double kOff = 0.3;  // standard deviations
  const Confidence& c = what.identification.confidence();
  const auto exponents = fitted_exponents(study.experiments);
  const bool is_least_squares =
      std::all_of(exponents.begin(), exponents.end(), [](double k) { return k == 2.0; });
  if (is_least_squares || what.best.values.empty() || !std::isfinite(c.sigma)) return;
  std::vector<std::string> off;
  const auto best = study.space.to_unit(what.best), center = study.space.to_unit(what.point);
  for (int i = 0; i < study.space.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double deviation = std::sqrt(c.covariance(i, i));
    const double away = std::abs(best[k] - center[k]) / deviation;
    if (std::isfinite(away) && away > kOff)
      off.push_back(fmt::format("{} {:.2g} (there {})",
                                study.space[i].name,
                                away,
                                value_text(study.space, i, what.point.values[k], c.intervals[k])));
  }
  if (off.empty()) return;
  all.push_back(fmt::format(
      "The values are those of the trial with the least target, whose errors count with the "
      "exponent "
      "of their experiment; intervals and the ending of a search by residuals belong to the least "
      "sum of squares, which is off by standard deviations of {}. exponent = 2 in every experiment "
      "makes both one point.",
      fmt::join(off, ", ")));
}

/// Adds remarks on constraints, which the intervals do not know. Returns true if one may hold the
/// fit, so that a gain beyond it is no sign of an early end.
bool remark_on_constraints(const Study& study, const Identifiability& what, Sentences& all) {
  constexpr double kTouches = 1e-6;  // share of the largest term of a sum
  std::vector<std::string> names, equations;
  const DesignPoint& point = what.best.values.empty() ? what.point : what.best;
  for (const LinearConstraint& one : study.space.constraints()) {
    if (one.is_equation()) {
      equations.push_back(one.name);
      continue;
    }
    double largest = 0.0;
    for (std::size_t i = 0; i < point.values.size(); ++i)
      largest = std::max(largest, std::abs(one.coefficients[i] * point.values[i]));
    const double sum = one.sum(point.values);
    if (std::min(std::abs(sum - one.lower), std::abs(one.upper - sum)) <= kTouches * largest)
      names.push_back(one.name);
  }
  if (!equations.empty())
    all.push_back(fmt::format(
        "The intervals keep the linear constraint{} {}: each says how far a variable may move if "
        "the others follow it.",
        equations.size() == 1 ? "" : "s",
        fmt::join(equations, ", ")));
  if (!names.empty())
    all.push_back(
        fmt::format("The linear constraint{} {} hold{} the fit. The intervals do not know {}: they "
                    "say what the "
                    "measured values alone leave open, and are too wide along the constraint.",
                    names.size() == 1 ? "" : "s",
                    fmt::join(names, ", "),
                    names.size() == 1 ? "s" : "",
                    names.size() == 1 ? "it" : "them"));
  if (!study.constraints.empty())
    all.emplace_back(
        "The intervals do not know the constraints on channels: where one of them holds the fit, "
        "an "
        "interval may lie beyond it, or be too wide along it.");
  return !names.empty() || !study.constraints.empty();
}

/// Adds a remark if bounds keep the fit from most of the improvement that the slopes predict,
/// unless stated noise explains what would vanish.
void remark_on_bounds(const Study& study, const Identification& identification, Sentences& all) {
  constexpr double kMuch = 0.5;  // share of the sum of squares
  constexpr double kSeen = 9.0;  // squares of three deviations
  const Confidence& c = identification.confidence();
  if (!(c.share_beyond_bounds > kMuch)) return;
  const auto values = static_cast<double>(identification.linearization().r.size());
  if (residual_sigma(study) && c.with_loss == 0 &&
      c.share_beyond_bounds * values * mean_square_over_noise(study, identification) < kSeen)
    return;
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

std::vector<std::string> remarks(const Study& study, const Identifiability& what) {
  constexpr double kEarly = 1.0;  // multiple of the threshold of an interval; a profile ends there
  const Confidence& c = what.identification.confidence();
  Sentences all;
  remark_on_losses(c, all);
  remark_on_noise(study, what, all);
  remark_on_exact_fit(study, what, all);
  remark_on_best(study, what, all);
  remark_on_bounds(study, what.identification, all);
  remark_on_variables(study, what, all);
  remark_on_refinement(study, what, all);
  // A systematic misfit is larger than the threshold, so that its curvature alone promises a gain.
  constexpr double kOfMisfit = 0.01;  // share of the sum of squares
  const double least_gain =
      c.is_pattern ? kOfMisfit * what.identification.linearization().sum_of_squares() : 0.0;
  const bool is_constrained = remark_on_constraints(study, what, all);
  if (!is_constrained && c.left_to_gain > std::max(kEarly * c.threshold(), least_gain)) {
    all.emplace_back(
        "The search ended early: recomputed derivatives predict a gain larger than an interval, "
        "so "
        "the point is no minimum yet. latsch identify continues from there.");
  }
  remark_on_profiles(what.identification, all);
  return all;
}

}  // namespace latsch::correlation
