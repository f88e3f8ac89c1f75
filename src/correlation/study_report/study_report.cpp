// SPDX-License-Identifier: Apache-2.0
#include "correlation/study_report/study_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <limits>
#include <map>

#include "base/units.h"
#include "correlation/analysis/doe_surface.h"
#include "correlation/analysis/found_tire.h"
#include "correlation/basic_data/slip_plots.h"
#include "correlation/search/study_fit.h"
#include "correlation/study/study_stages.h"
#include "correlation/study/variables.h"
#include "correlation/study_report/report_identifiability.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/tire_trials.h"
#include "evaluation/schedule/scheduler.h"
#include "experiment/kinds/tir_numbers.h"

namespace latsch::correlation {
namespace {

using experiment::LoadDeflection;
using experiment::ModalTest;
using report::StudyReport;

/// The channels of every experiment, predicted ones included.
struct Simulated {
  DesignPoint point;
  Result<Channels> channels;
};

/// As the journal has it: an outside program is not run again for a report.
Simulated recorded(const Journal& journal, const DesignPoint& point) {
  Simulated simulated{point, Failure{"it is not in the journal"}};
  journal.for_each([&](const Trial& trial) {
    if (trial.point == point && trial.outcome.result) simulated.channels = *trial.outcome.result;
  });
  return simulated;
}

std::string conditions_of(const StudyExperiment& experiment) {
  if (experiment.curve) {
    return experiment.curve->x.empty() ? "sample by sample" : "over " + experiment.curve->x;
  }
  const auto text = [](double pressure, const fe_tire::Ground& ground) {
    return format_quantity(pressure, "bar", 4) +
           (ground.mu > 0.0 ? fmt::format(", friction {:.3g}", ground.mu) : "");
  };
  if (const auto* curve = std::get_if<LoadDeflection>(&experiment.load_case.test)) {
    return text(curve->pressure, curve->ground);
  }
  const auto& modal = std::get<ModalTest>(experiment.load_case.test);
  std::string state = ", unloaded";
  if (modal.deflection) state = ", pressed " + format_quantity(*modal.deflection, "mm", 4);
  if (modal.load) state = ", under " + format_quantity(*modal.load, "N", 5);
  return text(modal.pressure, modal.ground) + state;
}

std::string compared_in(const StudyExperiment& experiment) {
  if (experiment.curve) return experiment.curve->compared_name;
  std::string text = experiment.modal()                                 ? "frequency"
                     : experiment.objective.compared == Compared::force ? "force"
                                                                        : "root of force";
  if (experiment.objective.exponent != 1.0) {
    text += fmt::format(", exponent {:g}", experiment.objective.exponent);
  }
  return text;
}

report::ExperimentRow experiment_row(const StudyExperiment& experiment,
                                     const Comparison& found,
                                     const std::optional<Comparison>& initial) {
  report::ExperimentRow row;
  row.name = experiment.name;
  row.kind = experiment.curve ? "curve" : experiment.modal() ? "modes" : "load-deflection";
  row.conditions = conditions_of(experiment);
  row.compared = compared_in(experiment);
  row.fitted = experiment.fitted;
  row.weight = experiment.objective.weight;
  row.values = static_cast<int>(found.errors.size());
  row.value = found.value;
  row.mean_error = found.mean_error;
  row.largest_error = found.largest_error;
  if (initial) row.initial_mean_error = initial->mean_error;
  return row;
}

report::ForceCurve force_curve(const StudyExperiment& experiment,
                               const Channels& found,
                               const std::optional<Channels>& initial) {
  const auto& test = std::get<LoadDeflection>(experiment.load_case.test);
  report::ForceCurve curve;
  curve.experiment = experiment.name;
  curve.conditions = conditions_of(experiment);
  curve.fitted = experiment.fitted;
  curve.over_loaded_radius = !test.loaded_radii.empty();
  curve.abscissa = curve.over_loaded_radius ? test.loaded_radii : test.deflections;
  curve.measured = experiment.forces;
  curve.simulated = found["force"];
  if (initial) curve.initial = (*initial)["force"];
  return curve;
}

std::vector<double> values_of(const Channels& channels, const std::string& name) {
  const Channel* channel = channels.find(name);
  return channel ? channel->values : std::vector<double>{};
}

/// What is compared in the place of the time series: spectra, or forces about their means.
void show_compared(const CurveExperiment& curve,
                   const Channels& found,
                   const std::optional<Channels>& initial,
                   report::MeasuredCurve& picture) {
  const bool is_spectrum = curve.comparison.of_spectrum();
  picture.x_name = is_spectrum ? "frequency" : curve.x;
  picture.y_name = curve.compared_name;
  picture.x_unit = is_spectrum ? curve.x_compared_unit : curve.x_shown;
  picture.y_unit = is_spectrum ? curve.y_compared_unit : curve.y_shown;
  picture.x_measured = picture.x_simulated = curve.x_compared;
  picture.y_measured = curve.y_compared;
  if (const auto simulated = simulated_curve(curve, found)) picture.y_simulated = *simulated;
  if (!initial) return;
  if (const auto simulated = simulated_curve(curve, *initial)) {
    picture.x_initial = curve.x_compared;
    picture.y_initial = *simulated;
  }
}

report::MeasuredCurve measured_curve(const StudyExperiment& experiment,
                                     const Channels& found,
                                     const Comparison& comparison,
                                     const std::optional<Channels>& initial) {
  const CurveExperiment& curve = *experiment.curve;
  report::MeasuredCurve picture;
  picture.experiment = experiment.name;
  picture.conditions = conditions_of(experiment);
  picture.fitted = experiment.fitted;
  picture.x_name = curve.x;
  picture.y_name = curve.y;
  picture.x_unit = curve.x_shown;
  picture.y_unit = curve.y_shown;
  picture.x_measured = curve.x_measured;
  picture.y_measured = curve.y_measured;
  picture.errors = comparison.errors;
  if (curve.comparison.of_spectrum() || curve.comparison.what == ComparedCurve::about_mean) {
    show_compared(curve, found, initial, picture);
    return picture;
  }
  picture.x_simulated = values_of(found, curve.x);
  picture.y_simulated = values_of(found, curve.y);
  if (initial) {
    picture.x_initial = values_of(*initial, curve.x);
    picture.y_initial = values_of(*initial, curve.y);
  }
  return picture;
}

report::ModalComparison modal_comparison(const StudyExperiment& experiment,
                                         const Channels& found,
                                         const Comparison& comparison,
                                         const std::optional<Channels>& initial) {
  report::ModalComparison modal;
  modal.experiment = experiment.name;
  modal.conditions = conditions_of(experiment);
  modal.fitted = experiment.fitted;
  const auto simulated = experiment::mode_records(found);
  std::map<int, double> at_start;  // frequency by measured mode
  if (initial) {
    const auto modes = experiment::mode_records(*initial);
    for (const ModePair& pair : compare(experiment, *initial).pairing.pairs) {
      at_start[pair.measured] = modes[pair.simulated].frequency;
    }
  }
  const bool shapes = std::get<ModalTest>(experiment.load_case.test).points.cols() > 0;
  for (const ModePair& pair : comparison.pairing.pairs) {
    report::ModePair row;
    row.label = experiment.modes[pair.measured].label();
    row.measured = experiment.modes[pair.measured].frequency;
    row.simulated = simulated[pair.simulated].frequency;
    if (const auto at = at_start.find(pair.measured); at != at_start.end())
      row.initial = at->second;
    if (shapes) row.likeness = pair.likeness;
    modal.pairs.push_back(std::move(row));
  }
  for (int i : comparison.pairing.missing) {
    modal.missing.push_back({experiment.modes[i].label(), experiment.modes[i].frequency});
  }
  for (int j : comparison.pairing.extra) {
    modal.extra.push_back({simulated[j].label(), simulated[j].frequency});
  }
  return modal;
}

void add_experiments(const Study& study,
                     const Simulated& found,
                     const Simulated& initial,
                     StudyReport& page) {
  for (const StudyExperiment& experiment : study.experiments) {
    const Channels channels = channels_of(experiment, *found.channels);
    const Comparison comparison = compare(experiment, channels);
    std::optional<Channels> start;
    std::optional<Comparison> start_comparison;
    if (initial.channels) {
      start = channels_of(experiment, *initial.channels);
      start_comparison = compare(experiment, *start);
    }
    page.experiments.push_back(experiment_row(experiment, comparison, start_comparison));
    if (experiment.curve) {
      page.curves.push_back(measured_curve(experiment, channels, comparison, start));
    } else if (experiment.modal()) {
      page.modes.push_back(modal_comparison(experiment, channels, comparison, start));
    } else {
      page.forces.push_back(force_curve(experiment, channels, start));
    }
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

/// "; stage fine, after coarse (40 steps, target 3.2 %)"
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

/// The optimizer's trajectory as far as the journal knows it; none where it was never run.
void add_convergence(const Study& study, const Journal& journal, StudyReport& page) {
  const std::vector<Fit> fits = recorded_fit(study, journal);
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
}

report::RunFacts run_facts(const Study& study, const Journal& journal) {
  report::RunFacts facts;
  facts.method = "design of experiments";
  facts.workers = study.run.workers;
  std::map<std::string, int> reasons;
  double busy = 0.0;  // s, of all workers
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

Result<StudyReport> study_report(const Study& study, const Journal& journal, MeshError mesh_error) {
  const auto best = best_trial(study, journal);
  if (!best) return Failure{"no trial in " + study.run.journal.string() + " succeeded"};

  std::optional<TireTrials> trials;
  if (study.has_fe_tire()) trials.emplace(study);
  // A trial does not depend on others, so the two need not wait for each other.
  const bool beside = trials && study.run.workers > 1;
  auto start = std::async(beside ? std::launch::async : std::launch::deferred, [&] {
    const DesignPoint point = study.space.initial();
    return study.simulator ? recorded(journal, point)
                           : Simulated{point, simulate_all(study, point)};
  });
  const Simulated found = study.simulator
                              ? recorded(journal, best->point)
                              : Simulated{best->point,
                                          trials ? trials->run(best->point, /*predicted=*/true)
                                                 : simulate_all(study, best->point)};
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
  if (study.rolling && study.rolling->kind->steady) {
    page.slip_plots = slip_plots(magic_formula::MagicFormula(
        experiment::parameters_of(at(study.model, study.space, best->point))));
  }
  page.target_definition =
      "mean of the experiments' own targets by their weights; of one, mean |relative "
      "error|^exponent";
  const auto what = recorded_identifiability(study, journal);
  add_variables(study, best->point, what, page);
  if (trials) {
    add_found_tire(study, best->point, *trials, page);
    add_mesh_error(study, best->point, mesh_error, page);
  }
  const Simulated initial = start.get();
  if (initial.channels)
    page.initial_target = objective(study)(initial.point, *initial.channels)->value;
  add_experiments(study, found, initial, page);
  page.run = run_facts(study, journal);
  add_convergence(study, journal, page);
  page.is_of_design = !page.convergence;
  for (report::ForceCurve& curve : page.forces) curve.of_design = page.is_of_design;
  for (report::MeasuredCurve& curve : page.curves) curve.of_design = page.is_of_design;
  const auto rated = rated_trials(study, journal);
  page.surfaces = doe_surfaces(study, rated, best->point);
  page.basins = basins_of(study, rated);
  page.effects = effects_of(study, rated);
  if (what) page.identifiability = identifiability_page(study, *what);
  return page;
}

}  // namespace latsch::correlation
