// SPDX-License-Identifier: Apache-2.0
#include "correlation/study_report/study_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <limits>
#include <map>

#include "correlation/analysis/beyond_data.h"
#include "correlation/analysis/coefficient_levels.h"
#include "correlation/doe/doe_surface.h"
#include "correlation/search/stage_runs.h"
#include "correlation/search/study_method.h"
#include "correlation/study/study_stages.h"
#include "correlation/study/variables.h"
#include "correlation/study_report/report_identifiability.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/compared_trial.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/test_limits.h"
#include "evaluation/schedule/scheduler.h"

namespace latsch::correlation {
namespace {

using report::StudyReport;

/// The channels of every experiment at a point, including those that are only predicted.
struct Simulated {
  DesignPoint point;
  Result<Channels> channels;
};

/// Returns the recording in the journal, because an outside program is not run again for a report.
Simulated recorded(const Journal& journal, const DesignPoint& point) {
  Simulated simulated{point, Failure{"it is not in the journal"}};
  journal.for_each([&](const Trial& trial) {
    if (trial.point == point && trial.outcome.result) simulated.channels = *trial.outcome.result;
  });
  return simulated;
}

std::string compared_in(const StudyExperiment& experiment) {
  std::string text = experiment.observable->compared(experiment.objective);
  if (experiment.objective.exponent != 1.0)
    text += fmt::format(", exponent {:g}", experiment.objective.exponent);
  return text;
}

report::ExperimentRow experiment_row(const StudyExperiment& experiment,
                                     const std::string& conditions,
                                     const Comparison& found,
                                     const std::optional<Comparison>& initial,
                                     const OwnStage& own) {
  report::ExperimentRow row;
  row.name = experiment.name;
  row.kind = experiment.observable->kind();
  row.conditions = conditions;
  row.compared = compared_in(experiment);
  row.fitted = experiment.fitted;
  row.weight = experiment.objective.weight;
  row.values = static_cast<int>(found.errors.size());
  row.value = found.value;
  row.mean_error = found.mean_error;
  row.largest_error = found.largest_error;
  if (initial) row.initial_error = own_measure(experiment, *initial);
  row.error = own_measure(experiment, found);
  row.measure = measure_in_words(experiment);
  row.whole = experiment.observable->whole();
  if (own.is_known()) {
    row.own_stage = own.stage;
    row.own_stage_error = own.error;
    row.is_spoiled = is_spoiled(experiment, own, row.error);
  }
  return row;
}

/// Returns the tests of the experiments; those of fitted experiments come first.
std::vector<const experiment::Test*> tests_shown(const Study& study) {
  const auto asked = tests_asked_for(study);
  const auto is_asked = [&](const StudyTest& test) {
    return std::find(asked.begin(), asked.end(), test.name) != asked.end();
  };
  std::vector<const experiment::Test*> tests;
  for (const bool fitted : {true, false}) {
    for (const StudyTest& test : study.tests)
      if (is_asked(test) == fitted) tests.push_back(test.test.get());
  }
  return tests;
}

void add_experiments(const Study& study,
                     const Simulated& found,
                     const Simulated& initial,
                     const std::vector<ExperimentBand>& bands,
                     const std::vector<OwnStage>& own_stages,
                     StudyReport& page) {
  const Channels* start = initial.channels ? &*initial.channels : nullptr;
  for (size_t e = 0; e < study.experiments.size(); ++e) {
    const StudyExperiment& experiment = study.experiments[e];
    const bool has_band = e < bands.size() && bands[e].is_known();
    const report::Band band =
        has_band ? report::Band{bands[e].lower, bands[e].upper, inside_text(bands[e])}
                 : report::Band{};
    const std::string conditions = conditions_of(experiment, study.tests);
    const Comparison comparison = compare(experiment, study.experiments, *found.channels);
    std::optional<Comparison> at_start;
    if (start) at_start = compare(experiment, study.experiments, *start);
    const OwnStage own = e < own_stages.size() ? own_stages[e] : OwnStage{};
    page.experiments.push_back(experiment_row(experiment, conditions, comparison, at_start, own));
    if (page.experiments.back().is_spoiled)
      page.remarks.push_back(spoiled_in_words(experiment, own, page.experiments.back().error));
    experiment.observable->draw({experiment.name,
                                 conditions,
                                 experiment.fitted,
                                 page.is_of_design,
                                 *found.channels,
                                 comparison,
                                 start,
                                 at_start ? &*at_start : nullptr,
                                 has_band ? &band : nullptr,
                                 experiment.objective.weight},
                                page);
  }
}

void add_variables(const Study& study,
                   const DesignPoint& found,
                   const std::optional<Identifiability>& what,
                   StudyReport& page) {
  for (int i = 0; i < study.space.size(); ++i) {
    const DesignVariable& variable = study.space[i];
    const auto interval = interval_of(study, what, found, i);
    page.variables.push_back(
        {variable.name,
         variable.unit,
         variable.initial,
         found.values[i],
         variable.lower,
         variable.upper,
         variable.scale == Scale::logarithmic,
         interval ? known_digits(study.space, i, found.values[i], *interval) : ""});
  }
}

report::FittedBy fitted_by(const Study& study) {
  report::FittedBy by;
  std::vector<std::string> untold;
  for (const UntoldCoefficient& one : untold_coefficients(study)) untold.push_back(one.variable);
  for (const DesignVariable& v : study.space.variables())
    if (std::find(untold.begin(), untold.end(), v.name) == untold.end())
      by.paths.insert(by.paths.end(), v.paths.begin(), v.paths.end());
  by.measured_at = [study](const std::string& condition) {
    return driven_at(study, condition, /*fitted_only=*/true);
  };
  return by;
}

/// Returns for example "; stage fine, after coarse (40 steps, target 3.2 %)".
std::string stages_before(const Study& study, const std::vector<Fit>& fits) {
  if (study.stages.empty()) return "";
  std::string text = "; stage " + study.stages[fits.size() - 1].name;
  for (std::size_t k = 0; k + 1 < fits.size(); ++k) {
    text += fmt::format("{}{} ({} steps, target {:.4f} %)",
                        k == 0 ? ", after " : ", ",
                        study.stages[k].name,
                        fits[k].run.steps.size(),
                        100.0 * fits[k].run.best()->outcome->value);
  }
  return text;
}

void add_minima(const DesignSpace& space,
                const std::vector<FoundBasin>& basins,
                report::RunFacts& facts) {
  constexpr int kDigits = 5;
  if (basins.empty()) return;
  for (int i = 0; i < space.size(); ++i) facts.variables.push_back(space[i].name);
  for (const FoundBasin& basin : basins) {
    report::FoundMinimum one{
        .target = basin.value, .times_found = basin.hits, .has_ended = basin.has_ended};
    for (int i = 0; i < space.size(); ++i)
      one.place.push_back(format_quantity(
          basin.minimum.values[static_cast<std::size_t>(i)], space[i].unit, kDigits));
    facts.minima.push_back(std::move(one));
  }
}

/// Adds the optimizer's trajectory as far as the journal contains it; nothing if it was never run.
void add_convergence(const Study& study, const std::vector<Fit>& fits, StudyReport& page) {
  if (fits.empty()) return;
  const Run& run = fits.back().run;
  report::Convergence convergence;
  for (const Step& step : run.steps) {
    convergence.target.push_back(step.outcome ? step.outcome->value
                                              : std::numeric_limits<double>::quiet_NaN());
  }
  page.convergence = std::move(convergence);
  const Study last = stage(study, static_cast<int>(fits.size()) - 1);
  page.run->method = fmt::format("{}, {} steps{}",
                                 in_words(method_of(last).method),
                                 run.steps.size(),
                                 stages_before(study, fits));
  page.run->ended = run.ending.empty() ? "not finished" : run.ending;
  page.run->tests = tests_in_words(run.claims);
  add_minima(study.space, run.basins, *page.run);
}

report::RunFacts run_facts(const Study& study, const Journal& journal) {
  report::RunFacts facts;
  facts.method = "design of experiments";
  facts.workers = study.run.workers;
  std::map<std::string, int> reasons;
  double busy = 0.0;  // s, sum over all workers
  journal.for_each([&](const Trial& trial) {
    ++facts.trials;
    busy += trial.outcome.wall_time;
    facts.cpu_time += trial.outcome.cpu_time + trial.outcome.program_time;
    facts.program_time += trial.outcome.program_time;
    if (trial.outcome.result) return;
    ++facts.failures;
    ++reasons[trial.outcome.result.failure().reason];
  });
  facts.wall_time = busy / std::max(1, facts.workers);
  facts.failure_reasons.assign(reasons.begin(), reasons.end());
  return facts;
}

}  // namespace

Result<StudyReport> study_report(const Study& study,
                                 const Journal& journal,
                                 experiment::Thoroughness thoroughness,
                                 const Study* as_read) {
  const auto best = best_trial(study, journal);
  if (!best) return Failure{"no trial in " + study.run.journal.string() + " succeeded"};

  const auto simulated = [&](const DesignPoint& point) {
    return study.specimens->may_repeat() ? Simulated{point, simulate_all(study, point)}
                                         : recorded(journal, point);
  };
  // The initial point and the best point are simulated at the same time, because trials do not
  // depend on each other.
  const bool beside = study.specimens->may_repeat() && study.run.workers > 1;
  auto start = std::async(beside ? std::launch::async : std::launch::deferred,
                          [&] { return simulated(study.space.initial()); });
  const Simulated found = simulated(best->point);
  if (!found.channels) {
    return Failure{"the best trial cannot be repeated with the predictions: " +
                   found.channels.failure().reason};
  }

  StudyReport page;
  page.title = study.title;
  page.study_file = study.file.string();
  page.model_file = study.model_file.string();
  page.target = best->target;
  page.target_in_words = target_in_words(fitted_exponents(study.experiments), best->target);
  page.target_definition =
      "The target is the mean of the experiments' own targets, by their weights. An experiment's "
      "own "
      "target is the mean of |relative error| to the power of its exponent.";
  const auto what = recorded_identifiability(study, journal);
  add_variables(study, best->point, what, page);
  page.fitted_by = fitted_by(study);
  if (const experiment::SpecimenKind* kind = study.specimens->kind())
    kind->draw(at(study.model, study.space, best->point), tests_shown(study), thoroughness, page);
  Simulated initial = start.get();
  if (initial.channels) {
    const auto score = objective(study)(initial.point, *initial.channels);
    if (score)
      page.initial_target = score->value;
    else
      initial.channels = score.failure();
  }
  page.run = run_facts(study, journal);
  const std::vector<Fit> fits = recorded_stages(as_read ? *as_read : study, journal).fits;
  add_convergence(study, fits, page);
  page.is_of_design = !page.convergence;
  std::vector<ExperimentBand> bands;
  if (what) bands = prediction_bands(study, *what, journal, {{best->point, *found.channels}});
  add_experiments(
      study, found, initial, bands, fits.empty() ? std::vector<OwnStage>{} : fits.back().own, page);
  for (const std::string& limit : limits_met_at(study, best->point))
    page.remarks.push_back("Warning: " + limit);
  for (const std::string& words : faults_beyond_data(study, best->point))
    page.remarks.push_back("Warning: " + words);
  for (const std::string& words : untold_in_words(study))
    page.remarks.push_back("Warning: " + words);
  const auto rated = rated_trials(study, journal);
  page.surfaces = doe_surfaces(study, rated, best->point);
  page.basins = basins_of(study, rated);
  page.effects = effects_of(study, rated);
  page.shares = shares_of(study, journal);
  if (what) page.identifiability = identifiability_page(study, *what, bands);
  return page;
}

}  // namespace latsch::correlation
