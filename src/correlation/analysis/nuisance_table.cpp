// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/nuisance_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/text.h"
#include "correlation/analysis/identification_rounds.h"
#include "correlation/target/residuals.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

/// Deviations from its prior above which a number is doubtful; chance alone exceeds it once in 370.
constexpr double kFarFromPrior = 3.0;
/// Share of a variable's effect that the numbers leave, below which they act like the variable.
/// Errors of differences leave about 1e-5.
constexpr double kActsAlike = 0.01;
/// Ratio of deviation to value above which a free number is open: a value that is 0 by chance is
/// not as small as that.
constexpr double kOpen = 1e6;
constexpr double kParallel = 0.9;  // cosine above which a number is named for it

bool has_nuisance(const Study& study) {
  return std::any_of(study.experiments.begin(), study.experiments.end(), [](const auto& one) {
    return one.fitted && !one.nuisance.empty();
  });
}

/// Recordings at the center, at the best point and beside the center, by the bits of the point.
class NuisanceTrials {
 public:
  NuisanceTrials(const Study& study, const Identifiability& what, const Journal& journal)
      : study_(study), what_(what) {
    std::set<std::string> wanted{what.point.bits(), what.best.bits()};
    for (int i = 0; i < study.space.size(); ++i)
      for (const auto& term : what.identification.derivative(i)) wanted.insert(term.point.bits());
    journal.for_each([&](const Trial& trial) {
      if (!trial.outcome.result || !wanted.contains(trial.point.bits())) return;
      const auto [at, is_new] = known_.try_emplace(trial.point.bits(), *trial.outcome.result);
      if (!is_new && trial.outcome.result->has_slopes()) at->second = *trial.outcome.result;
    });
  }

  const Channels* at(const DesignPoint& point) const {
    const auto found = known_.find(point.bits());
    return found == known_.end() ? nullptr : &found->second;
  }

  /// Returns the derivatives in the unit cube of the values that `values_at` computes. Where the
  /// model computed its slopes, the jacobian of its scores is used.
  template <class Scored>
  std::optional<Eigen::MatrixXd> slopes(const Scored& scored) const {
    const Channels* center = at(what_.point);
    if (!center) return std::nullopt;
    const auto score = scored(what_.point, *center);
    if (!score) return std::nullopt;
    if (!score->jacobian.empty()) return study_.space.unit_jacobian(what_.point, *score);
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(std::ssize(score->residuals), study_.space.size());
    for (int i = 0; i < study_.space.size(); ++i) {
      for (const auto& [point, weight] : what_.identification.derivative(i)) {
        const Channels* beside = at(point);
        const auto there = beside ? scored(point, *beside) : std::nullopt;
        if (!there) return std::nullopt;
        all.col(i) += weight * to_vector(there->residuals);
      }
    }
    return all;
  }

 private:
  const Study& study_;
  const Identifiability& what_;
  std::map<std::string, Channels> known_;
};

/// Returns a score whose residuals are the nuisance numbers of one experiment.
std::optional<Score> numbers_of(const Study& study,
                                const StudyExperiment& experiment,
                                const Channels& channels) {
  const auto comparison = comparison_of(experiment, study.experiments, channels);
  if (!comparison) return std::nullopt;
  Score score;
  for (const SolvedNumber& number : comparison->nuisance) {
    score.residuals.push_back(number.value);
    score.jacobian.insert(score.jacobian.end(), number.slopes.begin(), number.slopes.end());
  }
  return score;
}

void add_rows(const Study& study,
              const Identifiability& what,
              const NuisanceTrials& trials,
              int e,
              std::vector<NuisanceRow>& rows) {
  const Confidence& c = what.identification.confidence();
  const StudyExperiment& experiment = study.experiments[static_cast<std::size_t>(e)];
  const Channels* best = trials.at(what.best);
  const auto comparison = best ? comparison_of(experiment, study.experiments, *best)
                               : Result<Comparison>(Failure{"not recorded"});
  if (!comparison) return;
  const auto slopes = trials.slopes([&](const DesignPoint&, const Channels& channels) {
    return numbers_of(study, experiment, channels);
  });
  // Without a stated noise, c.sigma is the deviation of a difference over the root of its weight.
  const double unit = experiment.noise ? c.sigma * std::sqrt(experiment.objective.weight) : c.sigma;
  for (const std::size_t k : counted_numbers(study.experiments, static_cast<std::size_t>(e))) {
    const SolvedNumber& solved = comparison->nuisance[k];
    NuisanceRow row{e, experiment.nuisance.numbers[k], solved.value, NAN};
    row.at_end = solved.at_end;
    row.lower = solved.lower;
    row.upper = solved.upper;
    row.is_determined = solved.is_determined;
    if (slopes) {
      const Eigen::VectorXd g = slopes->row(static_cast<Eigen::Index>(k)).transpose();
      // Residuals beyond their stated noise widen the deviation; a prior still bounds it.
      row.deviation = std::min(
          row.number.prior,
          std::sqrt(unit * unit * solved.deviation * solved.deviation + g.dot(c.covariance * g)));
    }
    rows.push_back(std::move(row));
  }
}

/// Returns the study with all numbers held at their values at the center; nullopt if one is not
/// known.
std::optional<Study> with_numbers_held(const Study& study, const Channels& center) {
  Study held = study;
  for (StudyExperiment& experiment : held.experiments) {
    if (experiment.nuisance.empty()) continue;
    const auto comparison = comparison_of(experiment, study.experiments, center);
    if (!comparison) return std::nullopt;
    for (const SolvedNumber& number : comparison->nuisance)
      experiment.nuisance.held.push_back(number.value);
  }
  return held;
}

/// Scalar products of the changes of the residuals by a free number and by a variable.
struct Likeness {
  std::string name;
  double product = 0.0, number = 0.0, variable = 0.0;

  bool is_parallel() const { return std::abs(product) > kParallel * std::sqrt(number * variable); }
};

/// Returns how alike the free numbers and a variable are, which changes the residuals by `moved`.
/// A number that several recordings share is compared over all of them.
std::vector<Likeness> likenesses(const Study& study,
                                 const std::vector<Eigen::Index>& used,
                                 const Eigen::VectorXd& moved,
                                 const Channels& center) {
  const auto known = residual_rows(study);
  std::vector<Likeness> all;
  for (std::size_t e = 0; e < study.experiments.size(); ++e) {
    const StudyExperiment& experiment = study.experiments[e];
    if (!experiment.fitted || experiment.nuisance.empty()) continue;
    const auto comparison = comparison_of(experiment, study.experiments, center);
    if (!comparison) continue;
    for (std::size_t n = 0; n < comparison->nuisance.size(); ++n) {
      const NuisanceNumber& number = experiment.nuisance.numbers[n];
      const std::vector<double>& columns = comparison->nuisance[n].columns;
      if (!number.is_free()) continue;
      const std::string name =
          "the " + number.name() + (number.is_shared() ? "" : " of " + experiment.name);
      auto one = std::find_if(
          all.begin(), all.end(), [&](const Likeness& known) { return known.name == name; });
      if (one == all.end()) one = all.insert(all.end(), {name});
      std::size_t value = 0;
      for (std::size_t k = 0; k < used.size(); ++k) {
        const ResidualRow& row = known[static_cast<std::size_t>(used[k])];
        if (row.experiment != static_cast<int>(e) || value >= columns.size()) continue;
        const double a = columns[value++] / row.unit;
        const double b = moved[static_cast<Eigen::Index>(k)];
        one->product += a * b;
        one->number += a * a;
        one->variable += b * b;
      }
    }
  }
  return all;
}

/// Names the free numbers that act like a variable.
void remark_on_alike(const Study& study,
                     const Identifiability& what,
                     const Eigen::MatrixXd& held_slopes,
                     const Channels& center,
                     NuisanceTable& table) {
  const Eigen::MatrixXd& J = what.identification.linearization().J;
  for (int i = 0; i < study.space.size(); ++i) {
    const Eigen::VectorXd moved = held_slopes.col(i);
    if (!(moved.norm() > 0.0) || J.col(i).norm() > kActsAlike * moved.norm()) continue;
    std::vector<std::string> names;
    for (const Likeness& one :
         likenesses(study, what.identification.residuals_used(), moved, center))
      if (one.is_parallel()) names.push_back(one.name);
    if (names.empty()) names.emplace_back("the nuisance numbers together");
    const std::string last = names.back();
    names.back() = study.space[i].name;
    std::rotate(names.begin(), names.end() - 1, names.end());
    table.remarks.push_back(fmt::format("{} and {} act alike; give {} a prior",
                                        fmt::join(names, ", "),
                                        last,
                                        names.size() == 1 ? "one" : "one of them"));
  }
}

/// Names the variables whose intervals are narrower than they would be with known numbers. Noise
/// that neighbors share is to the fit what an offset is: with V the covariance of the values, X
/// their derivatives by the variables and Y = X less what the numbers explain, least squares have
/// the covariances
///   (Y'Y)^-1 Y'V Y (Y'Y)^-1 with solved and (X'X)^-1 X'V X (X'X)^-1 with known numbers,
/// of which the first is not larger if V is 1, but may be smaller if V holds slow noise that the
/// numbers explain and Y does not follow.
void remark_on_slow_noise(const Study& study, const Confidence& with, NuisanceTable& table) {
  constexpr double kNarrower = 0.99;  // ratio of the widths; rounding of slopes changes less
  if (!with.is_colored) return;
  std::vector<std::string> names;
  for (const NuisanceCost& cost : table.costs)
    if (cost.with.upper - cost.with.lower < kNarrower * (cost.without.upper - cost.without.lower))
      names.push_back(study.space[cost.variable].name);
  if (names.empty()) return;
  table.remarks.push_back(fmt::format(
      "{}: narrower than if the numbers were known, because neighboring values share noise, and "
      "the "
      "solved numbers take its slow part out of the fit",
      fmt::join(names, ", ")));
}

void add_costs(const Study& study,
               const Identifiability& what,
               const NuisanceTrials& trials,
               NuisanceTable& table) {
  const Channels* center = trials.at(what.point);
  const auto held = center ? with_numbers_held(study, *center) : std::nullopt;
  if (!held) return;
  const Objective objective = residual_objective(*held);
  const auto& used = what.identification.residuals_used();
  const auto slopes = trials.slopes([&](const DesignPoint& point, const Channels& channels) {
    const auto score = objective(point, channels);
    return score ? std::optional<Score>(*score) : std::nullopt;
  });
  if (!slopes) return;
  const Eigen::MatrixXd J = (*slopes)(used, Eigen::all);
  remark_on_alike(study, what, J, *center, table);
  if (!study.free.empty()) return;  // the last stage holds variables, whose intervals have no width
  Linearization at = what.identification.linearization();
  at.J = J;
  // The noise is that of the residuals beside all that variables and numbers explain. If it were
  // estimated anew beside the variables alone, chance would make it slower or larger in one of
  // both.
  ConfidenceOptions options = options_for(study, Depth::at_the_point).confidence;
  options.traits = options.traits.of(used);
  const Confidence without = confidence(at, options);
  const Confidence& with = what.identification.confidence();
  for (int i = 0; i < study.space.size(); ++i)
    table.costs.push_back({i,
                           with.intervals[static_cast<std::size_t>(i)],
                           without.intervals[static_cast<std::size_t>(i)]});
  remark_on_slow_noise(study, with, table);
}

}  // namespace

bool NuisanceRow::is_open() const {
  return number.is_free() && deviation > kOpen * std::abs(value);
}

std::string NuisanceRow::in_words() const {
  const std::string name = number.name();
  if (!is_determined)
    return name + (number.is_shared() ? ": the recordings do not determine it"
                                      : ": the recording does not determine it");
  if (is_open()) return name + ": open, because the variables act like it";
  std::string text =
      fmt::format("{}: {} +- {}",
                  name,
                  shown_text(number, value, deviation),
                  std::isfinite(deviation) ? shown_text(number, deviation, deviation) : "unknown");
  text += number.is_free() ? ", free"
                           : ", prior 0 +- " + shown_text(number, number.prior, number.prior);
  if (at_end)
    text += fmt::format(
        ", at the end of its range {} .. {}: a tenth of the record, as far as the simulation "
        "covers "
        "it. The number may be larger: simulate a longer stretch, or select a shorter one",
        shown_text(number, lower, upper - lower),
        shown_text(number, upper, upper - lower));
  if (from_prior() > kFarFromPrior)
    text += fmt::format(", {:.1f} deviations from its prior", from_prior());
  return text;
}

NuisanceTable nuisance_table(const Study& study,
                             const Identifiability& what,
                             const Journal& journal) {
  NuisanceTable table;
  if (!has_nuisance(study) || !std::isfinite(what.identification.confidence().sigma)) return table;
  const NuisanceTrials trials(study, what, journal);
  for (std::size_t e = 0; e < study.experiments.size(); ++e)
    if (study.experiments[e].fitted && !study.experiments[e].nuisance.empty())
      add_rows(study, what, trials, static_cast<int>(e), table.rows);
  add_costs(study, what, trials, table);
  return table;
}

std::string cost_text(const Study& study, const NuisanceCost& cost) {
  return fmt::format("{}: 95 %: {} with the nuisance numbers solved, {} if they were known",
                     study.space[cost.variable].name,
                     interval_text(study.space, cost.variable, cost.with),
                     interval_text(study.space, cost.variable, cost.without));
}

}  // namespace latsch::correlation
