// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "base/file.h"
#include "base/text.h"
#include "correlation/study/linear_constraints.h"
#include "correlation/study/study_stages.h"
#include "correlation/study/study_start.h"
#include "correlation/study/variables.h"
#include "evaluation/trial/encoding.h"
#include "models/fe_tire/description/model_version.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::correlation {
namespace {

std::filesystem::path find_model(const Node& root, const std::filesystem::path& folder) {
  const auto file = (folder / root.text("model")).lexically_normal();
  if (!std::filesystem::exists(file)) {
    root.reject("model", fmt::format("is \"{}\", which does not exist", file.string()));
  }
  return file;
}

/// Without a model they stand for holes in the input files of a simulator.
DesignSpace read_variables(const Node& root, const Document* model) {
  std::vector<DesignVariable> variables;
  for (const Node& table : root.named_tables("variable")) {
    variables.push_back(model ? read_variable(table, *model) : read_free_variable(table));
  }
  if (model) {
    read_ties(root, *model, variables);
  } else if (root.has("tie")) {
    root.reject("tie",
                "needs a model: in the inputs of an outside program write its value instead");
  }
  if (variables.empty())
    root.reject("variable", "is missing, expected at least one [variable.NAME]");
  std::vector<LinearConstraint> constraints;
  for (const Node& table : root.named_tables("linear_constraint")) {
    constraints.push_back(read_linear_constraint(table, variables));
  }
  return DesignSpace(std::move(variables), std::move(constraints));
}

/// Throws InputError where the numbers make no tire.
void build(const Document& model, const experiment::TireKind* rolling) {
  if (rolling) {
    rolling->build(model);
  } else {
    fe_tire::build_mesh(fe_tire::read_tire(model.root()));
  }
}

/// The model has to accept every bound of every variable: better said before the first trial than
/// after a night.
void check_bounds(const Node& root,
                  const Document& model,
                  const experiment::TireKind* rolling,
                  const DesignSpace& space) {
  const auto tables = root.named_tables("variable");
  const auto accept = [&](int i, const char* key, double value) {
    DesignPoint point = space.initial();
    point.values[i] = value;
    const Document changed = at(model, space, point);
    try {
      build(changed, rolling);
    } catch (const InputError& error) {
      tables[i].reject(key, std::string("is a value the model does not accept: ") + error.what());
    }
  };
  for (int i = 0; i < space.size(); ++i) {
    accept(i, "initial", space[i].initial);
    accept(i, "lower", space[i].lower);
    accept(i, "upper", space[i].upper);
  }
}

/// Without the noise of one experiment, the spread of all has to be estimated; then that of the
/// others cannot be taken at its word.
void check_noise(const Node& root, const std::vector<StudyExperiment>& experiments) {
  const auto tables = root.named_tables("experiment");
  bool some = false;
  for (const auto& experiment : experiments) some = some || (experiment.fitted && experiment.noise);
  for (size_t e = 0; e < experiments.size(); ++e) {
    if (!some || !experiments[e].fitted || experiments[e].noise) continue;
    tables[e].reject("noise", "is missing: another experiment states it, expected all or none");
  }
}

/// Against what a prior is weighed has to be known.
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
                                              const std::filesystem::path& folder,
                                              Measurements measurements,
                                              const std::vector<KnownChannel>* known) {
  std::vector<StudyExperiment> experiments;
  double weights = 0.0;
  for (const Node& table : root.named_tables("experiment")) {
    experiments.push_back(read_experiment(table, folder, measurements, known));
    if (experiments.back().fitted) weights += experiments.back().objective.weight;
  }
  if (!(weights > 0.0)) {
    root.reject("experiment", "fits nothing, expected an [experiment.NAME] of positive weight");
  }
  check_noise(root, experiments);
  return experiments;
}

std::string list(const Eigen::Matrix3Xd& points) {
  std::string text;
  for (double x : points.reshaped()) text += fmt::format("{} ", x);
  return text;
}

std::string text_of(const experiment::LoadCase& load_case) {
  const auto* curve = std::get_if<experiment::LoadDeflection>(&load_case.test);
  if (curve) {
    return fmt::format("load_deflection pressure {} mu {} penalty {} deflections {} radii {}",
                       curve->pressure,
                       curve->ground.mu,
                       curve->ground.stiffness,
                       fmt::join(curve->deflections, " "),
                       fmt::join(curve->loaded_radii, " "));
  }
  const auto& modal = std::get<experiment::ModalTest>(load_case.test);
  return fmt::format("modes pressure {} mu {} penalty {} deflection {} load {} count {} points {}",
                     modal.pressure,
                     modal.ground.mu,
                     modal.ground.stiffness,
                     modal.deflection.value_or(0.0),
                     modal.load.value_or(0.0),
                     modal.count,
                     list(modal.points));
}

/// Without empty lines and lines that are comments: a note in a tire file leaves the journal valid.
std::string without_notes(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find_first_not_of(" \t\r");
    if (first != std::string::npos && line[first] != '#') kept += line + '\n';
  }
  return kept;
}

}  // namespace

namespace {

constexpr std::size_t kLargestMeasurement = std::size_t{2} << 30;

/// What stands in the model's place, and its variables.
struct StudyModel {
  std::filesystem::path file;
  Document numbers = Document::parse("", "");
  std::optional<RollingModel> rolling;
  std::optional<Simulator> simulator;
  std::optional<std::vector<KnownChannel>> known;  // not of a finite-element tire
};

bool has_model_table(const Node& root) {
  try {
    return root.find_table("model").has_value();
  } catch (const InputError&) {
    return false;  // a text: the file of a finite-element tire
  }
}

/// Tests are driven by a tire that rolls; [model] is then a table.
bool is_rolling(const Node& root) {
  if (has_model_table(root)) return true;
  if (!root.has("test")) return false;
  root.reject(
      "model",
      "is missing or a text, but [test...] is driven by a tire that rolls. Expected a table "
      "such as\n\n    [model]\n    kind = \"magic_formula\"\n    file = "
      "\"tire.tir\"\n\nwith kind one of " +
          list_of(experiment::tire_kind_names()));
}

StudyModel read_model(const Node& root, const std::filesystem::path& folder) {
  StudyModel model;
  if (root.has("simulator")) return model;
  if (is_rolling(root)) {
    const Node table = root.table("model");
    model.rolling = read_rolling_model(table, root, folder);
    model.known = known_channels(*model.rolling);
    model.file = rolling_tire_file(table, folder);
    model.numbers = model.rolling->kind->read(model.file);
    return model;
  }
  model.file = find_model(root, folder);
  model.numbers = Document::read(model.file);
  fe_tire::read_tire(model.numbers.root());
  return model;
}

/// A misspelled table leaves something else missing: names the first of them that a study has not.
void reject_unknown_table(const std::filesystem::path& file) {
  static const std::vector<std::string> kTables{"model",
                                                "simulator",
                                                "test",
                                                "variable",
                                                "linear_constraint",
                                                "tie",
                                                "constraint",
                                                "experiment",
                                                "target",
                                                "optimizer",
                                                "stage",
                                                "doe",
                                                "run"};
  std::istringstream lines(read_text_file(file));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto from = line.find_first_not_of('[');
    if (from == 0 || from == std::string::npos) continue;
    const std::string name = line.substr(from, line.find_first_of(".]", from) - from);
    if (std::find(kTables.begin(), kTables.end(), name) != kTables.end()) continue;
    const std::string meant = did_you_mean(name, kTables);
    if (meant.empty()) continue;
    throw InputError({file.string(), number}, "unknown table [" + name + "]" + meant);
  }
}

/// The study as it is written, but for what changes no step of a search, and its measurements.
std::string search_key(const Study& study) {
  std::istringstream lines(without_notes(read_text_file(study.file)));
  std::uint64_t state = kHashStart;
  bool counts = true;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) counts = !line.starts_with("[run") && !line.starts_with("[doe");
    if (counts && !line.starts_with("title")) state = hash(line + "\n", state);
  }
  for (const StudyExperiment& experiment : study.experiments) {
    for (const auto& file : {experiment.measurement_file, experiment.shapes_file}) {
      if (std::filesystem::is_regular_file(file)) {
        state = hash(read_text_file(file, kLargestMeasurement), state);
      }
    }
  }
  return fmt::format("{:016x}", state);
}

/// What a trial would complain of, every one of them.
void check_reach(const Node& root, const RollingModel& rolling, const StudyExperiment& experiment) {
  const CurveExperiment& curve = *experiment.curve;
  const std::string& channel = curve.x.empty() ? curve.y : curve.x;
  const std::string name = test_of(channel);
  for (const RollingModel::Test& test : rolling.tests) {
    if (test.name != name) continue;
    const Node table = root.table("experiment").table(experiment.name);
    const auto count = experiment::samples(test.test);
    if (curve.x.empty() && count && *count != std::ssize(curve.y_measured)) {
      table.reject("measurement",
                   fmt::format("has {} values, but the test \"{}\" gives {}: without x they are "
                               "compared one by one",
                               curve.y_measured.size(),
                               name,
                               *count));
    }
    if (curve.x.empty() || curve.comparison.what == ComparedCurve::path) return;
    const auto reach = experiment::reach(test.test, channel.substr(name.size() + 1));
    if (!reach) return;
    const auto [least, most] =
        std::minmax_element(curve.x_measured.begin(), curve.x_measured.end());
    if (reach->from <= *least && *most <= reach->to) return;
    table.reject("measurement",
                 fmt::format("reaches from {:g} to {:g} {}, but the test \"{}\" from {:g} to {:g}; "
                             "make the test longer or the measurement shorter",
                             *least,
                             *most,
                             curve.x_unit,
                             name,
                             reach->from,
                             reach->to));
  }
}

Study read(const Document& document, const std::filesystem::path& file, Measurements measurements) {
  const Node root = document.root();
  const auto folder = file.parent_path();
  const auto table = root.find_table("simulator");
  StudyModel model = read_model(root, folder);

  DesignSpace space = read_variables(root, table ? nullptr : &model.numbers);
  if (table) {
    model.simulator = read_simulator(*table, file, space);
    model.known = known_channels(*model.simulator);
  } else {
    check_bounds(root, model.numbers, model.rolling ? model.rolling->kind : nullptr, space);
  }
  const auto* known = model.known ? &*model.known : nullptr;
  Study study{file,
              root.text("title", file.stem().string()),
              model.file,
              std::move(model.numbers),
              std::move(space),
              read_experiments(root, folder, measurements, known),
              {},
              1000,
              std::nullopt,
              {}};
  check_priors(root, study.space, study.experiments);
  for (const Node& constraint : root.named_tables("constraint")) {
    study.constraints.push_back(read_channel_constraint(constraint, study.experiments, known));
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
  const auto run = root.find_table("run");
  study.run = read_run_settings(run ? &*run : nullptr, file);
  study.run.on_failure.space = study.space;
  study.simulator = std::move(model.simulator);
  study.rolling = std::move(model.rolling);
  for (const StudyExperiment& experiment : study.experiments) {
    if (!study.rolling || !experiment.curve || measurements != Measurements::required) continue;
    if (!experiment.curve->y_measured.empty()) check_reach(root, *study.rolling, experiment);
  }
  study.stages = read_stages(root, document, study);
  root.close();
  study.search_key = search_key(study);
  return study;
}

}  // namespace

Study read_study(const std::filesystem::path& file, Measurements measurements) {
  const Document document = Document::read(file);
  if (document.root().has("kind"))
    document.root().reject("kind",
                           "is " + in_quotes(document.root().text("kind")) +
                               ": that is a tire, a road or a test, expected a study, which has a "
                               "model, [variable.NAME] and [experiment.NAME]");
  try {
    return read(document, file, measurements);
  } catch (const InputError&) {
    reject_unknown_table(file);
    throw;
  }
}

std::vector<std::string> tests_asked_for(const Study& study) {
  std::set<std::string> asked;
  for (const StudyExperiment& experiment : study.experiments) {
    if (!experiment.fitted || !experiment.curve) continue;
    asked.insert(test_of(experiment.curve->y));
    if (!experiment.curve->x.empty()) asked.insert(test_of(experiment.curve->x));
  }
  for (const ChannelConstraint& constraint : study.constraints)
    asked.insert(test_of(constraint.channel));
  return {asked.begin(), asked.end()};
}

StudyIdentity identity(const Study& study) {
  if (study.simulator) return identity(*study.simulator, study.space);
  std::string varied, cases;
  for (const DesignVariable& variable : study.space.variables()) {
    varied += fmt::format("{}: {}\n", variable.name, fmt::join(variable.paths, ", "));
    for (const Follower& follower : variable.followers) {
      varied += fmt::format("  {} times: {}\n", follower.factor, fmt::join(follower.paths, ", "));
    }
  }
  if (study.rolling) {
    const auto asked = tests_asked_for(study);
    varied += "kind: " + study.rolling->kind->name + "\n";
    for (const RollingModel::Test& test : study.rolling->tests) {
      if (std::find(asked.begin(), asked.end(), test.name) == asked.end()) continue;
      cases += fmt::format("{}: {}\n", test.name, without_notes(test.text));
    }
  }
  for (const StudyExperiment& experiment : study.experiments) {
    if (!experiment.fitted || experiment.curve) continue;
    cases += fmt::format("{}: {}\n", experiment.name, text_of(experiment.load_case));
  }
  const std::string version =
      study.rolling
          ? fmt::format("{} {}\n", study.rolling->kind->name, study.rolling->kind->version)
          : fmt::format("fe_tire {}\n", fe_tire::kModelVersion);
  return {{"model", without_notes(study.model.text())},
          {"variables", varied},
          {"experiments", cases},
          {kModelVersionPart, version}};
}

}  // namespace latsch::correlation
