// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <sstream>

#include "base/document_record.h"
#include "base/file.h"
#include "base/text.h"
#include "correlation/laboratory/virtual_recording.h"
#include "correlation/observable/curve.h"
#include "correlation/observable/values.h"
#include "correlation/study/keys/declared_keys.h"
#include "correlation/study/ledgers/study_ledgers.h"
#include "correlation/study/linear_constraints.h"
#include "correlation/study/program_specimens.h"
#include "correlation/study/refinement.h"
#include "correlation/study/simulator_settings.h"
#include "correlation/study/study_slopes.h"
#include "correlation/study/study_stages.h"
#include "correlation/study/study_start.h"
#include "correlation/study/variables.h"
#include "evaluation/trial/encoding.h"
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& study_keys();

namespace {

/// Reads the variables. Without a model they fill placeholders in the input files of a simulator.
DesignSpace read_variables(const Node& root,
                           const Document* model,
                           const experiment::SpecimenKind* kind) {
  std::vector<DesignVariable> variables;
  for (const Node& table : root.named_tables("variable")) {
    variables.push_back(model ? read_variable(table, *model) : read_free_variable(table));
  }
  if (model) {
    for (DesignVariable& variable : read_varied(root, *model, *kind))
      variables.push_back(std::move(variable));
    read_ties(root, *model, variables);
  } else if (root.has("tie")) {
    root.reject("tie",
                "needs a model: in the inputs of an outside program write its value instead");
  }
  if (variables.empty())
    root.reject("variable", "is missing, expected at least one [variable.NAME], or vary");
  std::vector<LinearConstraint> constraints;
  for (const Node& table : root.named_tables("linear_constraint")) {
    constraints.push_back(read_linear_constraint(table, variables));
  }
  return DesignSpace(std::move(variables), std::move(constraints));
}

/// Throws for a variable whose parameter must be a whole number, such as a mode or a number of
/// elements: the values between whole bounds are not whole.
void expect_continuous(const Node& root,
                       const experiment::SpecimenKind& kind,
                       const DesignVariable& variable,
                       const std::function<Document(double)>& model_with) {
  // share of the range at which no usual bounds give a whole number
  constexpr double kBetween = 0.41421356;
  if (variable.unit != "1") return;
  try {
    kind.check(model_with(variable.lower + kBetween * (variable.upper - variable.lower)));
  } catch (const InputError& error) {
    if (std::string(error.what()).find("expected an integer") == std::string::npos) return;
    for (const Node& table : root.named_tables("variable"))
      if (table.name() == variable.name)
        table.reject(table.has("paths") ? "paths" : "path",
                     "leads to " + in_quotes(variable.paths.front()) +
                         ", which is a whole number, such as a mode or a count of elements, and "
                         "has no values between that a fit could try; expected another number");
  }
}

/// Checks that the model accepts every bound of every variable, so that an error appears before the
/// first trial and not after hours.
void check_bounds(const Node& root,
                  const Document& model,
                  const experiment::SpecimenKind& kind,
                  const DesignSpace& space) {
  const auto tables = root.named_tables("variable");
  const auto changed = [&](int i, double value) {
    DesignPoint point = space.initial();
    point.values[i] = value;
    return at(model, space, point);
  };
  const auto accept = [&](int i, const char* key, double value) {
    try {
      kind.check(changed(i, value));
    } catch (const InputError& error) {
      const std::string why = std::string("a value the model does not accept: ") + error.what();
      if (i < std::ssize(tables)) tables[i].reject(key, "is " + why);
      root.reject("vary", fmt::format("has {}, whose usual {} is {}", space[i].name, key, why));
    }
  };
  for (int i = 0; i < space.size(); ++i) {
    accept(i, "initial", space[i].initial);
    accept(i, "lower", space[i].lower);
    accept(i, "upper", space[i].upper);
    expect_continuous(root, kind, space[i], [&](double value) { return changed(i, value); });
  }
}

/// Throws if some experiments state their noise and others do not: the spread of all would have to
/// be estimated, and the stated noise could not be used as an absolute value.
void check_noise(const Node& root, const std::vector<StudyExperiment>& experiments) {
  const auto tables = root.named_tables("experiment");
  const bool estimated = std::any_of(
      experiments.begin(), experiments.end(), [](const auto& one) { return one.estimates_noise; });
  const bool of_own_stage = std::any_of(experiments.begin(),
                                        experiments.end(),
                                        [](const auto& one) { return one.noise_of_own_stage; });
  for (size_t e = 0; estimated && e < experiments.size(); ++e) {
    if (!experiments[e].fitted) continue;
    if (!experiments[e].estimates_noise || experiments[e].noise_of_own_stage != of_own_stage)
      tables[e].reject(
          "noise",
          fmt::format("is not \"{}\", but that of another experiment is, expected all or none",
                      of_own_stage ? "own_stage" : "estimated"));
  }
  bool some = false;
  for (const auto& experiment : experiments) some = some || (experiment.fitted && experiment.noise);
  for (size_t e = 0; e < experiments.size(); ++e) {
    if (!some || !experiments[e].fitted || experiments[e].noise) continue;
    tables[e].reject("noise", "is missing: another experiment states it, expected all or none");
  }
}

/// Throws InputError if there are priors but no stated noise, because priors are weighted relative
/// to the noise.
void check_priors(const Node& root,
                  const DesignSpace& space,
                  const std::vector<StudyExperiment>& experiments) {
  const bool stated = std::all_of(experiments.begin(), experiments.end(), [](const auto& e) {
    return e.noise || !e.fitted || !(e.objective.weight > 0.0);
  });
  const auto tables = root.named_tables("variable");
  for (int i = 0; i < space.size(); ++i) {
    if (stated || !space[i].prior) continue;
    tables[static_cast<size_t>(i)].reject(
        "prior",
        "is weighed against the measured values, expected noise in every fitted "
        "experiment, such as noise = \"2 %\"");
  }
}

std::vector<StudyExperiment> read_experiments(const Node& root,
                                              const ExperimentContext& context,
                                              std::vector<StudyTest>& tests) {
  std::vector<StudyExperiment> experiments;
  double weights = 0.0;
  for (const Node& table : root.named_tables("experiment")) {
    experiments.push_back(read_experiment(table, context, tests));
    if (experiments.back().fitted) weights += experiments.back().objective.weight;
  }
  if (!(weights > 0.0)) {
    root.reject("experiment", "fits nothing, expected an [experiment.NAME] of positive weight");
  }
  check_noise(root, experiments);
  std::vector<const Nuisance*> recordings;
  for (const StudyExperiment& experiment : experiments) recordings.push_back(&experiment.nuisance);
  expect_named(context.shared_nuisance, recordings);
  return experiments;
}

constexpr std::size_t kLargestMeasurement = std::size_t{2} << 30;

/// Throws for the first unknown table whose name resembles a known one: otherwise the message would
/// only say that the known table is missing.
void reject_unknown_table(const std::filesystem::path& file) {
  std::vector<std::string> known;
  for (const auto& key : study_keys().sentences) known.push_back(key.path);
  std::istringstream lines(read_text_file(file));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto from = line.find_first_not_of('[');
    if (from == 0 || from == std::string::npos) continue;
    const std::string name = line.substr(from, line.find_first_of(".]", from) - from);
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string meant = did_you_mean(name, known);
    if (meant.empty()) continue;
    throw InputError({file.string(), number}, "unknown table [" + name + "]" + meant);
  }
}

/// Returns a hash of the study without notes and formatting, without the given tables, and with the
/// content of its measurements. Its tests are in the identity of its journal, wherever they are
/// stated.
std::string key_without(const std::set<std::string>& tables, const Study& study) {
  std::istringstream lines(canonical_text(Document::read(study.file)));
  std::uint64_t state = kHashStart;
  for (std::string line; std::getline(lines, line);) {
    const std::string top = line.substr(0, line.find_first_of(". "));
    if (!tables.contains(top)) state = hash(line + "\n", state);
  }
  for (const StudyExperiment& experiment : study.experiments) {
    std::vector<std::filesystem::path> files{experiment.measurement_file, experiment.shapes_file};
    if (experiment.measurement) files = experiment.measurement->files();
    for (const auto& file : files) {
      if (std::filesystem::is_regular_file(file)) {
        state = hash(read_text_file(file, kLargestMeasurement), state);
      }
    }
  }
  return fmt::format("{:016x}", state);
}

/// Throws for everything that would make every trial fail. `of` names the owner of a test that is
/// not the study's own: "[refined.test.pressed]".
void check_reach(const Node& root,
                 const std::vector<StudyTest>& tests,
                 const StudyExperiment& experiment,
                 const CurveMeasurement& curve,
                 const std::string& of = "") {
  const std::string& channel = curve.x.empty() ? curve.y : curve.x;
  const std::string name = test_of(channel);
  const auto test = std::find_if(
      tests.begin(), tests.end(), [&](const StudyTest& one) { return one.name == name; });
  if (test == tests.end()) return;
  const Node table = root.table("experiment").table(experiment.name);
  const auto count = test->test->samples_of(channel.substr(name.size() + 1));
  if (curve.x.empty() && count && *count != std::ssize(curve.y_measured)) {
    table.reject("measurement",
                 fmt::format("has {} values, but the test \"{}\" gives {}: without x they are "
                             "compared one by one",
                             curve.y_measured.size(),
                             name,
                             *count));
  }
  if (curve.x.empty() || curve.comparison.what == ComparedCurve::path) return;
  const auto reach = test->test->reach(channel.substr(name.size() + 1));
  if (!reach) return;
  const auto [least, most] = std::minmax_element(curve.x_measured.begin(), curve.x_measured.end());
  const bool is_within = reach->from <= *least && *most <= reach->to;
  const double room = (*least - reach->from) + (reach->to - *most);
  // share of the record; a smaller range is only rounding of the times
  constexpr double kNoRoom = 1e-9;
  const auto& numbers = experiment.nuisance.numbers;
  const bool asks_delay =
      curve.fits_delay || std::any_of(numbers.begin(), numbers.end(), [](const auto& one) {
        return one.kind == NuisanceKind::delay;
      });
  if (is_within && asks_delay && room <= kNoRoom * (*most - *least))
    table.reject(
        "nuisance",
        fmt::format("asks for a delay, but the measurement and the test \"{}\"{} both reach "
                    "from {:g} to {:g} {}, which leaves no room for one; select a shorter "
                    "part of the recording or make the test longer",
                    name,
                    of,
                    *least,
                    *most,
                    curve.x_unit));
  if (is_within) return;
  table.reject("measurement",
               fmt::format("reaches from {:g} to {:g} {}, but the test \"{}\"{} from {:g} to {:g}; "
                           "make the test longer or the measurement shorter",
                           *least,
                           *most,
                           curve.x_unit,
                           name,
                           of,
                           reach->from,
                           reach->to));
}

/// Checks the number of single values: all values of the channel, one of them, or one for each
/// mode.
void check_count(const Node& root,
                 const std::vector<StudyTest>& tests,
                 const StudyExperiment& experiment,
                 const Values::Measurement& measured) {
  const std::string name = test_of(measured.channel);
  const auto test = std::find_if(
      tests.begin(), tests.end(), [&](const StudyTest& one) { return one.name == name; });
  if (test == tests.end() || !measured.modes.empty() || !measured.of.empty()) return;
  const std::string channel = measured.channel.substr(name.size() + 1);
  const auto count = test->test->samples_of(channel);
  if (!count || *count == std::ssize(measured.values)) return;
  root.table("experiment")
      .table(experiment.name)
      .reject("channel",
              fmt::format(
                  "is {}, of which the test \"{}\" gives {} value{}, but {} {} measured{}",
                  in_quotes(measured.channel),
                  name,
                  *count,
                  *count == 1 ? "" : "s",
                  measured.values.size(),
                  measured.values.size() == 1 ? "is" : "are",
                  measured.values.size() == 1 ? "; of = \"largest\" takes one of several" : ""));
}

/// The model with its tests or an external simulator, and the variables.
struct WhatVaries {
  StudyModel model;
  DesignSpace space;
  std::vector<StudyTest> tests;
};

WhatVaries read_what_varies(const Node& root,
                            const std::filesystem::path& file,
                            const experiment::Language& language,
                            const Laboratory& laboratory) {
  if (const auto table = root.find_table("simulator")) {
    DesignSpace space = read_variables(root, nullptr, nullptr);
    const Simulator simulator = read_simulator(*table, file, space);
    StudyModel model;
    model.specimens = specimens_of(simulator);
    return {std::move(model), std::move(space), {test_of(simulator)}};
  }
  StudyModel model = read_model(root, file.parent_path(), language);
  const experiment::SpecimenKind& kind = *model.specimens->kind();
  auto tests = read_tests(root, file.parent_path(), kind, language, laboratory);
  DesignSpace space = read_variables(root, &model.numbers, &kind);
  check_bounds(root, model.numbers, kind, space);
  return {std::move(model), std::move(space), std::move(tests)};
}

/// Throws for a test that the model cannot undergo with the numbers in its file.
void check_tests(const Node& root, const Study& study) {
  const experiment::SpecimenKind* kind = study.specimens->kind();
  if (!kind) return;
  for (const StudyTest& test : study.tests) {
    const std::string fault = kind->remark(study.model, *test.test);
    if (fault.empty()) continue;
    const Node table = root.table(test.is_own ? "experiment" : "test").table(test.name);
    const char* key = table.has("shapes") ? "shapes" : table.has("points") ? "points" : "kind";
    table.reject(key, "makes every trial fail: " + fault);
  }
}

/// Reads a study. `root` is the document's root, through which all keys are read.
Study read(const Document& document,
           const Node& root,
           const std::filesystem::path& file,
           Measurements measurements,
           const experiment::Language& language) {
  const auto folder = file.parent_path();
  const Laboratory laboratory = read_laboratory(root, folder);
  WhatVaries what = read_what_varies(root, file, language, laboratory);
  const ExperimentContext context{folder,
                                  measurements,
                                  language,
                                  laboratory,
                                  what.model.specimens->kind(),
                                  root.named_tables("nuisance")};
  Study study{file,
              root.text("title", file.stem().string()),
              what.model.file,
              std::move(what.model.numbers),
              std::move(what.space),
              read_experiments(root, context, what.tests),
              {},
              1000,
              std::nullopt,
              {}};
  study.specimens = std::move(what.model.specimens);
  study.tests = std::move(what.tests);
  study.laboratory = laboratory;
  check_tests(root, study);
  check_priors(root, study.space, study.experiments);
  for (const Node& constraint : root.named_tables("constraint")) {
    study.constraints.push_back(read_channel_constraint(constraint, known_channels(study.tests)));
  }
  if (const auto optimizer = root.find_table("optimizer")) {
    for (const char* key :
         {"workers", "timeout", "memory", "on_failure", "journal", "stragglers", "look_ahead"})
      if (optimizer->has(key)) optimizer->reject(key, "belongs into [run]");
    study.optimizer = read_optimizer(*optimizer, study.space, !study.constraints.empty());
    study.max_steps = optimizer->integer("max_steps", 1, kMostSteps, study.max_steps);
    study.start = read_start(*optimizer, folder, root.has("doe"));
  }
  if (const auto doe = root.find_table("doe")) study.doe = read_design(*doe, study.space);
  if (const auto posterior = root.find_table("posterior"))
    study.posterior = read_posterior(*posterior);
  if (const auto selection = root.find_table("selection"))
    study.selection = read_coefficient_selection(*selection, study.space);
  if (const auto design = root.find_table("design"))
    study.campaign = read_campaign(*design, root, study, language);
  const auto run = root.find_table("run");
  study.run = read_run_settings(run ? &*run : nullptr, file);
  study.run.on_failure.space = study.space;
  for (const StudyExperiment& experiment : study.experiments) {
    const auto* curve = dynamic_cast<const Curve*>(experiment.observable.get());
    if (curve && measurements == Measurements::required)
      check_reach(root, study.tests, experiment, curve->measured());
    if (const auto* values = dynamic_cast<const Values*>(experiment.observable.get()))
      check_count(root, study.tests, experiment, values->measured());
  }
  study.asks_slopes = asks_slopes(study);
  if (study.optimizer.method == name(Method::levenberg_marquardt)) {
    if (const auto reason = reason_without_slopes(study))
      root.table("optimizer")
          .reject("method",
                  "is \"levenberg_marquardt\", which goes by the slopes of the residuals, but " +
                      *reason + "; expected \"auto\" or another method");
  }
  study.stages = read_stages(root, document, study);
  study.refinement = read_refinement(root, document, study, language, laboratory);
  if (study.refinement && measurements == Measurements::required)
    for (const StudyExperiment& experiment : study.experiments)
      if (const auto* curve = dynamic_cast<const Curve*>(experiment.observable.get()))
        check_reach(root, study.refinement->tests, experiment, curve->measured(), " of [refined]");
  root.close();
  if (measurements == Measurements::required) refuse_doubtful(ledgers_of(study));
  study.search_key = key_without(
      {"run", "doe", "refined", "posterior", "selection", "design", "title", "test"}, study);
  study.target_key = key_without(
      {"run", "doe", "refined", "posterior", "selection", "design", "title", "test", "optimizer"},
      study);
  return study;
}

}  // namespace

Study read_study(const std::filesystem::path& file,
                 const experiment::Language& language,
                 Measurements measurements) {
  const Document document = Document::read(file);
  if (document.root().has("kind"))
    document.root().reject("kind",
                           "is " + in_quotes(document.root().text("kind")) +
                               ": that is a model, a road or a test, expected a study, which has a "
                               "model, [variable.NAME] and [experiment.NAME]");
  if (measurements == Measurements::required) refuse_outdated_recordings(file, language);
  try {
    return read(document, document.root(), file, measurements, language);
  } catch (const InputError&) {
    reject_unknown_table(file);
    throw;
  }
}

std::map<std::string, DeclaredKey> keys_of_study(const std::filesystem::path& file,
                                                 const experiment::Language& language) {
  const Document document = Document::read(file);
  const DocumentRecord record(document.root());
  read(document, record.node(), file, Measurements::required, language);
  return record.keys();
}

std::vector<std::string> tests_asked_for(const Study& study) {
  std::set<std::string> asked;
  for (const StudyExperiment& experiment : study.experiments) {
    if (!experiment.fitted) continue;
    for (const std::string& channel : experiment.observable->asks()) asked.insert(test_of(channel));
  }
  for (const ChannelConstraint& constraint : study.constraints)
    asked.insert(test_of(constraint.channel));
  std::vector<std::string> names;
  for (const StudyTest& test : study.tests)
    if (test.name.empty() || asked.contains(test.name)) names.push_back(test.name);
  return names;
}

StudyIdentity identity(const Study& study) { return study.specimens->identity(study); }

}  // namespace latsch::correlation
