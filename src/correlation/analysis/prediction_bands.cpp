// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/prediction_bands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "base/text.h"
#include "base/units.h"
#include "correlation/analysis/measurement_gains.h"
#include "correlation/target/predictions.h"
#include "correlation/target/residuals.h"
#include "optimization/identifiability/prediction_band.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Recordings from all journals, keyed by the bits of the point.
using Recordings = std::multimap<std::string, Channels>;

Recordings recordings_around(const Study& study,
                             const Identifiability& what,
                             const Journal& journal,
                             const std::vector<KnownTrial>& others) {
  std::set<std::string> wanted{what.best.bits()};
  for (const DesignPoint& point : prediction_points(study, what)) wanted.insert(point.bits());
  for (int i = 0; i < study.space.size(); ++i) {
    for (const auto& term : what.identification.derivative(i)) wanted.insert(term.point.bits());
  }
  Recordings known;
  const auto take = [&](const Trial& trial) {
    if (trial.outcome.result && wanted.contains(trial.point.bits()))
      known.emplace(trial.point.bits(), *trial.outcome.result);
  };
  journal.for_each(take);
  const Study all = with_predictions(study);
  if (has_predictions(study) && std::filesystem::exists(all.run.journal)) {
    const Journal predicted = Journal::read(all.run.journal);
    if (predicted.identity() == identity(all)) predicted.for_each(take);
  }
  for (const KnownTrial& one : others) known.emplace(one.point.bits(), one.channels);
  return known;
}

/// Errors of an experiment at a point; NaN if a value was not computed. If a delay is fitted, it is
/// the last row, s.
struct Errors {
  Eigen::VectorXd values;
  Eigen::MatrixXd slopes;  // derivatives in the unit cube; empty: not known
  std::optional<FittedDelay> delay = {};
};

Errors errors_of(const Study& study,
                 const StudyExperiment& experiment,
                 const DesignPoint& point,
                 Comparison comparison) {
  for (const int missing : comparison.pairing.missing)
    comparison.errors[static_cast<size_t>(missing)] = kNaN;
  std::vector<double> slopes = std::move(comparison.slopes);
  if (const auto& delay = comparison.delay) {
    comparison.errors.push_back(delay->value);
    if (!slopes.empty()) slopes.insert(slopes.end(), delay->slopes.begin(), delay->slopes.end());
  }
  Errors errors{to_vector(comparison.errors), {}, comparison.delay};
  // for roots of forces there are no recorded derivatives
  if (experiment.objective.compared != Compared::force) return errors;
  Score score;
  score.residuals = comparison.errors;
  score.jacobian = std::move(slopes);
  errors.slopes = study.space.unit_jacobian(point, score);
  return errors;
}

class ComputedValues {
 public:
  ComputedValues(const Study& study, const Identifiability& what, const Recordings& known)
      : study_(study), what_(what), known_(known), beside_(prediction_points(study, what)) {}

  /// Returns the errors at a point. If there are several trials, one with derivatives is preferred.
  std::optional<Errors> at(const StudyExperiment& experiment, const DesignPoint& point) const {
    std::optional<Errors> found;
    const auto [first, end] = known_.equal_range(point.bits());
    for (auto one = first; one != end; ++one) {
      const Channels& channels = one->second;
      const auto asked = experiment.observable->asks();
      const auto is_there = [&](const std::string& name) { return channels.find(name) != nullptr; };
      if (!std::all_of(asked.begin(), asked.end(), is_there)) continue;
      auto comparison = comparison_of(experiment, study_.experiments, channels);
      if (!comparison) continue;
      Errors errors = errors_of(study_, experiment, point, std::move(*comparison));
      if (!found || errors.slopes.size() > 0) found = std::move(errors);
    }
    return found;
  }

  /// Returns the derivatives of the errors by u, the variables in the unit cube, one row for each
  /// value; nullopt if a trial beside the point is missing.
  std::optional<Eigen::MatrixXd> slopes(const StudyExperiment& experiment,
                                        const Errors& center) const {
    if (center.slopes.size() > 0) return center.slopes;
    Eigen::MatrixXd all(center.values.size(), study_.space.size());
    for (int i = 0; i < study_.space.size(); ++i) {
      if (!study_.free.empty() && !std::binary_search(study_.free.begin(), study_.free.end(), i)) {
        all.col(i).setZero();  // the last stage holds this variable constant
        continue;
      }
      auto column = by_terms(experiment, i);
      if (!column) column = by_one_step(experiment, center, i);
      if (!column) return std::nullopt;
      all.col(i) = *column;
    }
    return all;
  }

 private:
  std::optional<Eigen::VectorXd> by_terms(const StudyExperiment& experiment, int variable) const {
    Eigen::VectorXd sum;
    const auto terms = what_.identification.derivative(variable);
    for (const auto& [point, weight] : terms) {
      const auto errors = at(experiment, point);
      if (!errors) return std::nullopt;
      if (sum.size() == 0) sum = Eigen::VectorXd::Zero(errors->values.size());
      sum += weight * errors->values;
    }
    return terms.empty() ? std::nullopt : std::optional(sum);
  }

  std::optional<Eigen::VectorXd> by_one_step(const StudyExperiment& experiment,
                                             const Errors& center,
                                             int variable) const {
    const DesignPoint& point = beside_[static_cast<size_t>(variable) + 1];
    const auto errors = at(experiment, point);
    if (!errors) return std::nullopt;
    const auto i = static_cast<size_t>(variable);
    const double h = study_.space.to_unit(point)[i] - study_.space.to_unit(what_.point)[i];
    return Eigen::VectorXd((errors->values - center.values) / h);
  }

  const Study& study_;
  const Identifiability& what_;
  const Recordings& known_;
  std::vector<DesignPoint> beside_;
};

/// Returns the standard deviations of the measured values as shares of their scales.
std::vector<double> noise_of(const Study& study,
                             const Confidence& c,
                             const StudyExperiment& experiment) {
  const ObjectiveSettings plain;  // compares the values themselves, not their roots
  const bool is_stated = residual_sigma(study).has_value();
  const auto noise = experiment.noise ? experiment.noise
                     : is_stated      ? typical_noise(study)
                                      : std::nullopt;
  const bool counts = experiment.fitted && experiment.objective.weight > 0.0;
  if (noise) {
    auto deviations = experiment.observable->deviations(*noise, plain);
    if (is_stated || counts) {
      for (double& one : deviations) one *= c.sigma;
    }
    return deviations;
  }
  // With a relative noise of 1 the weight of each compared value is known; all values together
  // determine one common spread.
  const MeasurementNoise whole{.relative = 1.0};
  const auto compared = experiment.observable->deviations(whole, experiment.objective);
  auto deviations = experiment.observable->deviations(whole, plain);
  for (size_t k = 0; k < deviations.size(); ++k)
    deviations[k] *=
        c.sigma / compared[k] / (counts ? std::sqrt(experiment.objective.weight) : 1.0);
  return deviations;
}

void count_inside(const StudyExperiment& experiment, double t, ExperimentBand& band) {
  const auto measured = experiment.observable->measured_values();
  for (size_t k = 0; k < measured.size(); ++k) {
    const double off = measured[k] - band.computed[k];
    const double side =
        off < 0.0 ? band.computed[k] - band.lower[k] : band.upper[k] - band.computed[k];
    const double reach = std::hypot(side, t * band.noise[k]);
    if (!std::isfinite(off) || !std::isfinite(reach)) continue;
    ++band.compared;
    if (std::abs(off) <= reach) ++band.inside;
  }
}

/// Returns the band of a fitted delay. `of_difference` is the standard deviation of a difference in
/// units of its scale; `moved` is the band that the uncertainty of the variables causes.
DelayBand delay_band(const FittedDelay& delay,
                     const PredictionBand& moved,
                     double of_difference,
                     double t) {
  const double own = t * of_difference / std::sqrt(delay.stiffness);
  return {delay.value,
          delay.value - std::hypot(moved.lower, own),
          delay.value + std::hypot(moved.upper, own),
          delay.at_end};
}

void say_what_shapes_it(const Study& study,
                        const Confidence& c,
                        const std::set<int>& open,
                        const std::set<int>& held,
                        ExperimentBand& band) {
  for (const int k : open) {
    band.remarks.push_back(
        fmt::format("the data do not determine \"{}\", which affects it: the band is as wide as "
                    "the "
                    "bounds of the variables allow, by the slopes at the point",
                    direction_text(study.space, c.free.axes.col(k))));
  }
  for (const int i : held) {
    band.remarks.push_back(fmt::format("{} is held at its bound: the band extends to one side only",
                                       study.space[i].name));
  }
}

void fill(const Study& study,
          const Identifiability& what,
          const PredictionBands& bands,
          const ComputedValues& computed,
          const StudyExperiment& experiment,
          ExperimentBand& band) {
  const Confidence& c = what.identification.confidence();
  const auto center = computed.at(experiment, what.point);
  const auto best = computed.at(experiment, what.best);
  const auto slopes = center ? computed.slopes(experiment, *center) : std::nullopt;
  if (!slopes) {
    band.remarks.emplace_back(
        "not known: a trial at or beside the best point failed or is missing; latsch identify "
        "runs missing ones");
    return;
  }
  const auto measured = experiment.observable->measured_values(),
             scales = experiment.observable->scales();
  band.noise = noise_of(study, c, experiment);
  if (center->delay) {
    double square = 0.0;
    for (const double one : band.noise) square += one * one;
    band.delay = delay_band(best && best->delay ? *best->delay : *center->delay,
                            bands.of(slopes->bottomRows(1).transpose()),
                            std::sqrt(square / static_cast<double>(band.noise.size())),
                            c.free.t);
  }
  std::set<int> open, held;
  for (size_t k = 0; k < measured.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const double at_center = measured[k] - scales[k] * center->values[row];
    const double at_best = best ? measured[k] - scales[k] * best->values[row] : at_center;
    const Eigen::VectorXd g = -scales[k] * slopes->row(row).transpose();
    band.noise[k] *= scales[k];
    band.computed.push_back(at_best);
    if (!g.allFinite() || !std::isfinite(at_center)) {
      band.lower.push_back(kNaN);
      band.upper.push_back(kNaN);
      continue;
    }
    const PredictionBand one = bands.of(g);
    // The best trial can be another point, as in reported_interval().
    band.lower.push_back(std::fmin(at_center + one.lower, at_best));
    band.upper.push_back(std::fmax(at_center + one.upper, at_best));
    if (one.open >= 0) open.insert(one.open);
    if (one.held >= 0) held.insert(one.held);
  }
  count_inside(experiment, c.free.t, band);
  say_what_shapes_it(study, c, open, held, band);
}

}  // namespace

std::vector<ExperimentBand> prediction_bands(const Study& study,
                                             const Identifiability& what,
                                             const Journal& journal,
                                             const std::vector<KnownTrial>& others) {
  std::vector<ExperimentBand> all(study.experiments.size());
  const Confidence& c = what.identification.confidence();
  if (!std::isfinite(c.sigma)) {
    for (ExperimentBand& band : all) {
      band.remarks.emplace_back(
          "not known: there are no more measured values than variables, so their noise has to be "
          "stated");
    }
    return all;
  }
  const Recordings known = recordings_around(study, what, journal, others);
  const ComputedValues computed(study, what, known);
  const PredictionBands bands(what.identification.linearization().u, c);
  for (size_t e = 0; e < all.size(); ++e)
    fill(study, what, bands, computed, study.experiments[e], all[e]);
  NuisanceTable table = nuisance_table(study, what, journal);
  if (table.empty()) return all;
  ExperimentBand& first = all[static_cast<size_t>(table.rows.front().experiment)];
  first.nuisance_costs = std::move(table.costs);
  first.nuisance_remarks = std::move(table.remarks);
  for (NuisanceRow& row : table.rows)
    all[static_cast<size_t>(row.experiment)].nuisance.push_back(std::move(row));
  return all;
}

std::string DelayBand::in_words() const {
  const auto ms = [&](double seconds) {
    return format_known(1e3 * seconds, 0.5e3 * (upper - lower));
  };
  if (at_end || !std::isfinite(upper - lower))
    return fmt::format(
        "{:.4g} ms, at the end of its search range: a tenth of the record, as far as the "
        "simulation extends",
        1e3 * value);
  return fmt::format("{} ms, 95 %: {} .. {} ms", ms(value), ms(lower), ms(upper));
}

std::string widest_text(const StudyExperiment& experiment, const ExperimentBand& band) {
  const auto scales = experiment.observable->scales();
  const auto width = [&](size_t k) { return (band.upper[k] - band.lower[k]) / scales[k]; };
  std::optional<size_t> widest;
  for (size_t k = 0; k < band.lower.size(); ++k) {
    if (std::isfinite(width(k)) && (!widest || width(k) > width(*widest))) widest = k;
  }
  if (!widest) return "";
  const size_t k = *widest;
  const std::string unit = experiment.observable->shown_unit();
  const auto read_in = Unit::find(unit);  // a level in dB has no unit to convert to
  // Differences are converted without the offset of the unit, such as that of degrees Celsius.
  const double times = read_in && unit != experiment.observable->unit()
                           ? read_in->from_si(1.0) - read_in->from_si(0.0)
                           : 1.0;
  const double down = times * (band.computed[k] - band.lower[k]),
               up = times * (band.upper[k] - band.computed[k]);
  const double half = 0.5 * (up + down);
  constexpr double kAlike = 0.01;  // share of the half width: a smaller asymmetry is not shown
  const auto shown = [&](double value) { return format_known(value, half); };
  const std::string ends = std::abs(up - down) <= kAlike * half
                               ? "+- " + shown(half)
                               : fmt::format("-{} .. +{}", shown(down), shown(up));
  return fmt::format("{}{} ({} %), {}",
                     ends,
                     unit == "1" ? "" : " " + unit,
                     format_known(50.0 * width(k), 50.0 * width(k)),
                     experiment.observable->rows()[k]);
}

std::string inside_text(const ExperimentBand& band) {
  if (band.compared == 0) return "";
  return fmt::format(
      "{} of {} measured value{}", band.inside, band.compared, band.compared == 1 ? "" : "s");
}

}  // namespace latsch::correlation
