// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study_stages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "base/text.h"
#include "correlation/study/study_slopes.h"

namespace latsch::correlation {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns the value at a path such as "mesh.sectors" in a stage's table `model`, in the unit of
/// the model's parameter.
double read_number(const Node& stage, const std::string& path, const std::string& unit) {
  Node table = stage.table("model");
  std::size_t from = 0;
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', from)) {
    table = table.table(path.substr(from, dot - from));
    from = dot + 1;
  }
  return table.quantity(path.substr(from), unit);
}

void check_model(const Node& table, const Study& changed) {
  try {
    changed.specimens->check(changed);
  } catch (const InputError& error) {
    table.reject("model", std::string("makes a model that is not accepted: ") + error.what());
  }
}

bool varies(const Study& study, const std::string& path) {
  return std::any_of(study.space.variables().begin(),
                     study.space.variables().end(),
                     [&](const DesignVariable& variable) {
                       return std::find(variable.paths.begin(), variable.paths.end(), path) !=
                              variable.paths.end();
                     });
}

}  // namespace

std::vector<std::pair<std::string, double>> read_changed_numbers(const Node& table,
                                                                 const Document& text,
                                                                 const Study& study) {
  std::vector<std::pair<std::string, double>> numbers;
  if (!table.has("model")) return numbers;
  if (!study.specimens->kind()) {
    table.reject("model", "has numbers of the model, but the study uses an outside program");
  }
  const std::string prefix = table.path() + ".model.";
  Study changed = study;
  for (const std::string& path : text.paths()) {
    if (!path.starts_with(prefix)) continue;
    const std::string target = path.substr(prefix.size());
    try {
      const double value = read_number(table, target, study.model.unit(target));
      if (varies(study, target))
        table.reject("model", "sets " + target + ", which is a variable of the study");
      changed.model.set(target, value);
      numbers.emplace_back(target, value);
    } catch (const InputError& error) {
      if (!error.place().file.empty() && error.place().file == study.file.string()) throw;
      table.reject("model", std::string("leads to no number of the model: ") + error.what());
    }
  }
  if (numbers.empty()) {
    table.reject("model", "has no number, expected one such as model.mesh.sectors = 30");
  }
  check_model(table, changed);
  return numbers;
}

namespace {

/// Reads a list of names, each of which must be known; empty if the key is absent.
std::vector<std::string> read_names(const Node& table,
                                    const char* key,
                                    const std::vector<std::string>& known) {
  if (!table.has(key)) return {};
  const std::vector<std::string> names = table.texts(key);
  if (names.empty()) table.reject(key, "is empty, expected at least one of " + list_of(known));
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (!contains(known, *name))
      table.reject(key,
                   "has " + in_quotes(*name) + did_you_mean(*name, known) + ", expected some of " +
                       list_of(known));
    if (std::find(names.begin(), name, *name) != name)
      table.reject(key, "has " + in_quotes(*name) + " twice");
  }
  return names;
}

std::vector<int> read_free(const Node& table, const DesignSpace& space) {
  std::vector<std::string> known;
  for (const DesignVariable& variable : space.variables()) known.push_back(variable.name);
  const std::vector<std::string> names = read_names(table, "free", known);
  std::vector<int> free;
  for (int i = 0; i < space.size(); ++i)
    if (contains(names, space[i].name)) free.push_back(i);
  return free;
}

std::vector<std::string> read_counting(const Node& table, const Study& study) {
  std::vector<std::string> known;
  for (const StudyExperiment& experiment : study.experiments)
    if (experiment.fitted && experiment.objective.weight > 0.0) known.push_back(experiment.name);
  return read_names(table, "experiments", known);
}

StageSettings read_stage(const Node& table, const Document& text, const Study& study) {
  StageSettings stage{.name = table.name(),
                      .optimizer = study.optimizer,
                      .max_steps = study.max_steps,
                      .start = study.start};
  stage.numbers = read_changed_numbers(table, text, study);
  stage.free = read_free(table, study.space);
  stage.experiments = read_counting(table, study);
  stage.bounds = table.quantity("bounds", "1", Range{0.0, 1.0, true}, 1.0);
  if (has_optimizer_keys(table)) {
    stage.optimizer = read_optimizer(table, study.space, !study.constraints.empty());
  }
  stage.max_steps = table.integer("max_steps", 1, kMostSteps, study.max_steps);
  return stage;
}

/// Checks that an experiment with noise = "own_stage" has an earlier stage with the study's own
/// model.
void check_own_stages(const Node& root,
                      const Study& study,
                      const std::vector<StageSettings>& stages) {
  const auto wanting = std::find_if(study.experiments.begin(),
                                    study.experiments.end(),
                                    [](const auto& one) { return one.noise_of_own_stage; });
  if (wanting == study.experiments.end()) return;
  const bool has_earlier =
      std::ssize(stages) > 1 && std::any_of(stages.begin(), stages.end() - 1, [](const auto& one) {
        return one.numbers.empty();
      });
  if (!has_earlier)
    root.table("experiment")
        .table(wanting->name)
        .reject("noise",
                "is \"own_stage\", but no stage before the last one has the unchanged model; "
                "expected a [stage.NAME] with experiments = [\"" +
                    wanting->name + "\"] before it, or noise = \"estimated\"");
}

/// Adds the stages that the estimation of noise needs: one before the others, and a repetition of
/// the last one.
void add_rounds_of_noise(const Study& study, std::vector<StageSettings>& stages) {
  if (std::none_of(study.experiments.begin(), study.experiments.end(), [](const auto& one) {
        return one.estimates_noise && !one.noise_of_own_stage;
      }))
    return;
  if (stages.empty()) {
    StageSettings all;
    all.name = "alike";
    all.optimizer = study.optimizer;
    all.max_steps = study.max_steps;
    all.start = study.start;
    stages.push_back(all);
    all.name = "weighted";
    stages.push_back(all);
  }
  stages.push_back(stages.back());
  stages.back().name += "_anew";
  stages.back().bounds = 1.0;
}

std::filesystem::path journal_of(const Study& study, const std::string& stage) {
  const auto& whole = study.run.journal;
  return whole.parent_path() / (whole.stem().string() + "." + stage + whole.extension().string());
}

}  // namespace

std::vector<StageSettings> read_stages(const Node& root, const Document& text, const Study& study) {
  std::vector<StageSettings> stages;
  const std::vector<Node> tables = root.named_tables("stage");
  for (const Node& table : tables) stages.push_back(read_stage(table, text, study));
  if (!stages.empty() && !stages.back().numbers.empty()) {
    tables.back().reject("model",
                         "has other numbers in the last stage, whose result is the study's: "
                         "expected a last stage with the model as it is");
  }
  if (!stages.empty() && stages.front().bounds != 1.0) {
    tables.front().reject("bounds",
                          "is of the first stage, before which there is no best point: give "
                          "[variable...] tighter bounds");
  }
  check_own_stages(root, study, stages);
  add_rounds_of_noise(study, stages);
  return stages;
}

Study stage(const Study& study, int k, const std::optional<DesignPoint>& best_before) {
  Study part = study;
  part.stages.clear();
  if (study.stages.empty()) return part;
  const StageSettings& settings = study.stages[static_cast<std::size_t>(k)];
  part.stage = settings.name;
  part.search_key += "/" + settings.name;
  part.optimizer = settings.optimizer;
  part.max_steps = settings.max_steps;
  part.free = settings.free;
  for (StudyExperiment& experiment : part.experiments) {
    if (!settings.experiments.empty() && !contains(settings.experiments, experiment.name))
      experiment.objective.weight = 0.0;
  }
  part.start = k == 0 ? settings.start : StartSettings{};
  for (const auto& [path, value] : settings.numbers) part.model.set(path, value);
  if (!settings.numbers.empty()) part.run.journal = journal_of(study, settings.name);
  if (best_before) {
    part.space = settings.bounds < 1.0 ? study.space.tightened(*best_before, settings.bounds)
                                       : study.space.starting_at(*best_before);
  }
  if (best_before && !part.free.empty()) part.held_at = best_before;
  if (k == 0 && !part.free.empty()) part.held_at = study.space.initial();
  part.run.on_failure.space = part.space;
  part.asks_slopes = asks_slopes(part);
  return part;
}

std::vector<Study> stages_of(const Study& study) {
  std::vector<Study> stages{stage(study, 0)};
  for (int k = 1; k < std::ssize(study.stages); ++k) stages.push_back(stage(study, k));
  return stages;
}

Study stage_called(const Study& study, const std::string& name) {
  for (int k = 0; k < std::ssize(study.stages); ++k) {
    if (study.stages[static_cast<std::size_t>(k)].name == name) return stage(study, k);
  }
  throw InputError({study.file.string(), 0}, "has no stage " + in_quotes(name));
}

std::string in_words(const StageSettings& stage) {
  std::string text;
  for (const auto& [path, value] : stage.numbers) {
    text += fmt::format("{}{} = {:g}", text.empty() ? "" : ", ", path, value);
  }
  if (text.empty()) text = "the model as it is";
  if (!stage.free.empty()) text += fmt::format(", {} free", stage.free.size());
  if (!stage.experiments.empty())
    text += fmt::format(", fitted to {}", fmt::join(stage.experiments, ", "));
  if (stage.bounds < 1.0) text += fmt::format(", bounds {:g} as wide", stage.bounds);
  return text;
}

}  // namespace latsch::correlation
