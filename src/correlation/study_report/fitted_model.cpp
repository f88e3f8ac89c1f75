// SPDX-License-Identifier: Apache-2.0
#include "correlation/study_report/fitted_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text.h"
#include "base/units.h"
#include "correlation/analysis/coefficient_levels.h"
#include "correlation/analysis/identifiability.h"
#include "correlation/search/own_stages.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"
#include "correlation/study/variables.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/compared_trial.h"
#include "correlation/target/study_trials.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

constexpr double kNearestToBound =
    1e-6;  // share of the range; a value nearer to a bound counts as at the bound
constexpr int kDigitsWithoutInterval = 6;  // digits of a value without a known uncertainty

std::string file_as_named(const Study& study, const fs::path& file) {
  const fs::path folder = study.file.parent_path();
  const fs::path name = file.lexically_proximate(folder);
  return name.empty() ? file.string() : name.string();
}

/// SI.
double value_in_si(const DesignSpace& space, int variable, double u) {
  std::vector<double> all(static_cast<std::size_t>(space.size()), 0.5);
  all[static_cast<std::size_t>(variable)] = u;
  return space.from_unit(all).values[static_cast<std::size_t>(variable)];
}

/// Returns " N/mm"; "" for numbers without a unit.
std::string behind_number(const std::string& unit) { return unit == "1" ? "" : " " + unit; }

/// Returns "; at its bound 0.5" if the variable is at a bound, else "".
std::string at_bound_in_words(const DesignSpace& space, const DesignPoint& point, int variable) {
  const auto i = static_cast<std::size_t>(variable);
  const double u = space.to_unit(point)[i];
  if (u > kNearestToBound && u < 1.0 - kNearestToBound) return "";
  const DesignVariable& v = space[variable];
  return "; at its bound " + format_quantity(u < 0.5 ? v.lower : v.upper, v.unit, 5);
}

/// Returns the value with its interval: "-32.1 +- 0.4 (95 %)" or "-32.1 +0.5 -0.3 (95 %)" if both
/// ends lie within the bounds.
std::string with_interval(const Study& study,
                          const DesignPoint& point,
                          int variable,
                          const Interval& interval) {
  const DesignVariable& v = study.space[variable];
  const Unit unit = Unit::of(v.unit);
  const double value = unit.from_si(point.values[static_cast<std::size_t>(variable)]);
  const double below = value - unit.from_si(value_in_si(study.space, variable, interval.lower)),
               above = unit.from_si(value_in_si(study.space, variable, interval.upper)) - value;
  const double half = 0.5 * (below + above);
  // largest relative difference of the two half widths at which the interval is written with +-
  constexpr double kSkew = 0.05;
  const std::string number = format_known(value, half);
  if (std::abs(above - below) <= kSkew * half)
    return fmt::format("{} +- {}{} (95 %)", number, format_number(half, 2), behind_number(v.unit));
  return fmt::format("{} +{} -{}{} (95 %)",
                     number,
                     format_number(above, 2),
                     format_number(below, 2),
                     behind_number(v.unit));
}

/// Returns the stages in which a variable is free, as indices into study.stages.
std::vector<std::size_t> stages_that_move(const Study& study, int variable) {
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < study.stages.size(); ++k) {
    const auto& free = study.stages[k].free;
    if (free.empty() || std::find(free.begin(), free.end(), variable) != free.end())
      all.push_back(k);
  }
  return all;
}

/// Returns the origin of the value of one variable, in words.
std::string origin_of_variable(const Study& weighted,
                               const DesignPoint& point,
                               const std::optional<Identifiability>& what,
                               const std::vector<UntoldCoefficient>& untold,
                               int variable) {
  const DesignVariable& v = weighted.space[variable];
  const std::string value = format_quantity(
      point.values[static_cast<std::size_t>(variable)], v.unit, kDigitsWithoutInterval);
  const std::string bound = at_bound_in_words(weighted.space, point, variable);
  for (const UntoldCoefficient& one : untold)
    if (one.variable == v.name)
      return "assumed: it was free, but the data do not determine it, " + one.reason + bound;
  if (!weighted.stages.empty()) {
    const auto moving = stages_that_move(weighted, variable);
    if (moving.empty()) return "assumed: the study's initial value, no stage moves it";
    const std::string& last = weighted.stages.back().name;
    if (moving.back() + 1 != weighted.stages.size())
      return fmt::format("fitted {} by stage {}, held in the last stage {}, no interval{}",
                         value,
                         weighted.stages[moving.back()].name,
                         last,
                         bound);
  }
  const auto interval = interval_of(weighted, what, point, variable);
  if (!what || !interval)
    return fmt::format("fitted {}, no interval: {}{}",
                       value,
                       what ? "the intervals known are of another point"
                            : "none was computed (latsch identify does)",
                       bound);
  if (std::isnan(what->identification.confidence().sigma))
    return fmt::format(
        "fitted {}, no interval: no more values were measured than are fitted{}", value, bound);
  const bool low = interval->lower > 0.0, high = interval->upper < 1.0;
  if (low && high && interval_source(weighted, *what, variable) == "bounds")
    return fmt::format(
        "fitted {}, its interval is not known: it comes from the bounds alone, {} and {}{}",
        value,
        format_quantity(v.lower, v.unit, 5),
        format_quantity(v.upper, v.unit, 5),
        bound);
  if (low && high) return "fitted " + with_interval(weighted, point, variable, *interval) + bound;
  if (!low && !high)
    return fmt::format(
        "fitted {}, but not determined by the data: 95 % anywhere between {} and "
        "{}{}",
        value,
        format_quantity(v.lower, v.unit, 5),
        format_quantity(v.upper, v.unit, 5),
        bound);
  return fmt::format(
      "fitted {}, 95 %: {}{}",
      value_text(
          weighted.space, variable, point.values[static_cast<std::size_t>(variable)], *interval),
      interval_text(weighted.space, variable, *interval),
      bound);
}

/// Returns the names of the data files: "cornering.dat, drive.dat".
std::string data_files_in_words(const Study& study, const StudyExperiment& experiment) {
  std::vector<std::string> names;
  const auto& read = experiment.measurement ? experiment.measurement : experiment.read_from;
  if (read)
    for (const fs::path& file : read->files()) names.push_back(file_as_named(study, file));
  if (names.empty() && !experiment.measurement_file.empty())
    names.push_back(file_as_named(study, experiment.measurement_file));
  return names.empty() ? "the study itself" : fmt::format("{}", fmt::join(names, ", "));
}

/// Returns a line about the error of an experiment: "Fy: RMS error 2.1 % of 2053 N; cornering/Fy
/// from a.dat, 1800 values".
std::string error_line(const Study& study,
                       const StudyExperiment& experiment,
                       const Result<Channels>& recording) {
  std::string error;
  if (!recording) {
    error = "error not known, " + recording.failure().reason;
  } else if (const auto found = comparison_of(experiment, study.experiments, *recording)) {
    const std::string& whole = experiment.observable->whole();
    error = fmt::format("{} error {:.4g} %{}",
                        measure_in_words(experiment),
                        100.0 * own_measure(experiment, *found),
                        whole.empty() ? "" : " of " + whole);
  } else {
    error = "error not known, " + found.failure().reason;
  }
  return fmt::format("  {}: {}; {} values of {} from {}",
                     experiment.name,
                     error,
                     experiment.values(),
                     experiment.observable->compared(experiment.objective),
                     data_files_in_words(study, experiment));
}

/// Returns the lines about the whole fit, which begin the file.
std::vector<std::string> fit_header(const Study& weighted,
                                    const DesignPoint& point,
                                    const Channels& recorded,
                                    const std::optional<double>& target,
                                    const ExportedBy& by) {
  const std::string date = by.date.empty() ? "" : " on " + by.date;
  std::vector<std::string> lines = {
      fmt::format("{} by Latsch {}{}",
                  target ? "Fitted and exported" : "Not fitted: initial values, exported",
                  by.version,
                  date),
      fmt::format("Study: {} ({})", weighted.title, weighted.file.filename().string()),
      fmt::format("Model file: {}", file_as_named(weighted, weighted.model_file))};
  if (!target) return lines;
  lines.push_back(fmt::format("Target: {:.4g} %, {}",
                              100.0 * *target,
                              target_in_words(fitted_exponents(weighted.experiments), *target)));
  const bool holds_out = std::any_of(weighted.experiments.begin(),
                                     weighted.experiments.end(),
                                     [](const auto& one) { return !one.fitted; });
  Result<Channels> all = recorded;
  if (holds_out && weighted.specimens->may_repeat()) all = simulate_all(weighted, point);
  for (const bool fitted : {true, false}) {
    bool is_first = true;
    for (const StudyExperiment& experiment : weighted.experiments) {
      if (experiment.fitted != fitted) continue;
      if (is_first) lines.emplace_back(fitted ? "Fitted experiments:" : "Held out, not fitted:");
      is_first = false;
      lines.push_back(error_line(weighted, experiment, all));
    }
  }
  if (!holds_out) lines.emplace_back("Held out: nothing, so no prediction error is known");
  return lines;
}

/// Returns the origins of the parameters that variables and ties change, by path.
std::map<std::string, std::string> origins_of_variables(const Study& weighted,
                                                        const DesignPoint& point,
                                                        const Journal& journal) {
  const auto what = recorded_identifiability(weighted, journal);
  const auto untold = untold_coefficients(weighted);
  std::map<std::string, std::string> origins;
  for (int i = 0; i < weighted.space.size(); ++i) {
    const DesignVariable& v = weighted.space[i];
    const std::string origin = origin_of_variable(weighted, point, what, untold, i);
    for (const std::string& path : v.paths) origins[path] = origin;
    for (const Follower& follower : v.followers)
      for (const std::string& path : follower.paths)
        origins[path] = fmt::format("follows {}, {:g} times its value", v.name, follower.factor);
  }
  return origins;
}

/// Adds a remark that the numbers are those of the best trial so far, either of a design of
/// experiments or of a search that has not ended.
void tell_no_end(const Study& study, experiment::Provenance& provenance) {
  provenance.header.insert(provenance.header.begin() + 1,
                           "No search of this study has ended: its best trial so far need not be "
                           "at a minimum");
  const std::string fitted = "fitted ";
  for (const DesignVariable& v : study.space.variables())
    for (const std::string& path : v.paths)
      if (std::string& origin = provenance.origins[path]; origin.starts_with(fitted))
        origin = "best trial so far " + origin.substr(fitted.size());
}

std::map<std::string, std::string> same_origin(const DesignSpace& space, const std::string& words) {
  std::map<std::string, std::string> origins;
  for (const DesignVariable& v : space.variables())
    for (const std::string& path : v.paths) origins[path] = words;
  return origins;
}

}  // namespace

FittedModel fitted_model(const Study& study,
                         const ExportedBy& by,
                         const std::optional<DesignPoint>& wanted) {
  FittedModel model{at(study.model, study.space, wanted.value_or(study.space.initial())), {}};
  experiment::Provenance& provenance = model.provenance;
  provenance.model_name = file_as_named(study, study.model_file);
  provenance.model_file = study.model_file;
  std::optional<Journal> journal;
  if (fs::exists(study.run.journal))
    journal.emplace(Journal::read(study.run.journal, identity(study)));
  const Study weighted = journal ? with_estimated_noise(study, *journal) : study;
  provenance.measured_at = [study](const std::string& condition) {
    return driven_at(study, condition, /*fitted_only=*/true);
  };
  if (journal && !wanted) require_best(weighted, *journal);
  std::optional<RatedTrial> best;
  if (journal) best = best_trial(weighted, *journal);
  if (!best || (wanted && *wanted != best->point)) {
    const std::string words = wanted ? "a point of the study that was asked for, not its best"
                                     : "initial value of the study, not fitted";
    provenance.header = fit_header(weighted, study.space.initial(), {}, std::nullopt, by);
    provenance.origins = same_origin(study.space, "assumed: " + words);
    if (!best) provenance.measured_at = nullptr;
    return model;
  }
  model.is_fitted = true;
  model.search_has_ended = recorded_stages(study, *journal).has_ended;
  model.numbers = at(study.model, study.space, best->point);
  provenance.header =
      fit_header(weighted, best->point, recording_at(best->point, *journal), best->target, by);
  provenance.origins = origins_of_variables(weighted, best->point, *journal);
  if (!model.search_has_ended) tell_no_end(weighted, provenance);
  return model;
}

std::string text_of(const Study& study, const FittedModel& model) {
  return study.specimens->kind()->annotated_text(model.numbers, model.provenance);
}

}  // namespace latsch::correlation
