// SPDX-License-Identifier: Apache-2.0
// latsch check: reads a study, its model and its measurements, and says what it understood.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/console/implausible.h"
#include "cli/console/tables.h"
#include "cli/verbs/verbs.h"
#include "correlation/search/study_method.h"
#include "correlation/study/study.h"
#include "correlation/study/study_stages.h"
#include "correlation/study/study_start.h"
#include "correlation/study/variables.h"
#include "correlation/target/tire_trials.h"
#include "evaluation/journal/journal.h"
#include "evaluation/journal/local_file_system.h"
#include "evaluation/outside_program/outside_program.h"
#include "experiment/rigs/tire_rig.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::cli {
namespace {

using correlation::Study;
using correlation::StudyExperiment;

constexpr double kFarSensor =
    0.02;  // m between a measured point and the nearest point of the model

std::string what(const experiment::LoadDeflection& test) {
  const bool radii = !test.loaded_radii.empty();
  return fmt::format("load-deflection at {:.4g} bar, {} {}{}",
                     test.pressure / 1e5,
                     radii ? test.loaded_radii.size() : test.deflections.size(),
                     radii ? "loaded radii" : "deflections",
                     test.ground.mu > 0.0 ? fmt::format(", friction {:.3g}", test.ground.mu) : "");
}

std::string what(const experiment::ModalTest& test) {
  std::string state = "unloaded";
  if (test.deflection) state = fmt::format("pressed {:.4g} mm", *test.deflection * 1e3);
  if (test.load) state = fmt::format("under {:.4g} N", *test.load);
  return fmt::format("modes at {:.4g} bar, {}, {} lowest simulated, {}",
                     test.pressure / 1e5,
                     state,
                     test.count,
                     test.points.cols() > 0 ? fmt::format("shapes at {} points", test.points.cols())
                                            : "no shapes: paired by label");
}

std::string values_in_words(std::size_t count) {
  return fmt::format("{} value{}", count, count == 1 ? "" : "s");
}

void print_experiment(const StudyExperiment& experiment, const fe_tire::Mesh& mesh) {
  const auto& test = experiment.load_case.test;
  say("  {:<16} {}; {} from {}; {}, weight {:g}, exponent {:g}\n",
      experiment.name,
      std::visit([](const auto& t) { return what(t); }, test),
      values_in_words(experiment.modal() ? experiment.modes.size() : experiment.forces.size()),
      experiment.measurement_file.filename().string(),
      experiment.fitted ? "fitted" : "predicted",
      experiment.objective.weight,
      experiment.objective.exponent);
  if (const auto* modal = std::get_if<experiment::ModalTest>(&test);
      modal && modal->points.cols()) {
    const double distance = experiment::nearest_sensors(mesh, modal->points).largest_distance;
    if (distance > kFarSensor) {
      say("  {:<16} a measured point lies {:.0f} mm from the outer surface of the model\n",
          "",
          distance * 1e3);
    }
  }
}

void print_simulator(const Study& study) {
  const Simulator& simulator = *study.simulator;
  if (const std::string program = command(simulator).front(); !can_be_found(program)) {
    throw InputError(
        {study.file.string(), 0},
        fmt::format("simulator.command starts \"{}\", which is no program {}; expected "
                    "one that is installed, or its path with {{study}} for the folder "
                    "of the study",
                    program,
                    program.starts_with('/') ? "there" : "in PATH"));
  }
  say("{}\n\nSimulator: {}{}\n",
      study.title,
      fmt::join(simulator.arguments, " "),
      simulator.timeout > 0.0 ? fmt::format(", {:g} s at most", simulator.timeout) : "");
  for (const OutputReader& output : simulator.outputs) {
    std::string quantities;
    for (const auto& quantity : output.quantities) {
      quantities += fmt::format(" {} [{}]", quantity.name, quantity.unit);
    }
    say("  {:<16} from {}:{}\n", output.name, output.file.string(), quantities);
  }
}

void print_rolling_tire(const Study& study) {
  say("{}\n\nModel {}: {}, {} numbers\n\nTests\n",
      study.title,
      study.model_file.string(),
      study.rolling->kind->in_words,
      study.model.paths().size());
  for (const auto& test : study.rolling->tests) {
    say("  {:<{}} {}\n",
        test.name,
        name_width(study.rolling->tests),
        experiment::in_words(test.test));
  }
}

void print_curves(const Study& study) {
  for (const StudyExperiment& experiment : study.experiments) {
    say("  {:<{}} {} {}; {} from {}; {}, weight {:g}\n",
        experiment.name,
        name_width(study.experiments),
        experiment.curve->compared_name,
        experiment.curve->x.empty() ? "sample by sample" : "over " + experiment.curve->x,
        values_in_words(experiment.curve->y_compared.size()),
        experiment.measurement_file.filename().string(),
        experiment.fitted ? "fitted" : "predicted",
        experiment.objective.weight);
  }
}

/// Gives back the mesh, which experiments are checked against.
fe_tire::Mesh print_tire(const Study& study) {
  const Document initial = correlation::at(study.model, study.space, study.space.initial());
  const auto tire = fe_tire::read_tire(initial.root());
  const fe_tire::Mesh mesh = fe_tire::build_mesh(tire);

  say("{}\n\nModel {}: {}, {}\n  {} HEX8, {} nodes, {} free degrees of freedom, {} sectors\n",
      study.title,
      study.model_file.string(),
      tire.name,
      tire.size,
      mesh.element_count(),
      mesh.nodes(),
      mesh.free_dofs(),
      mesh.sectors);
  return mesh;
}

std::string journal_in_words(const Study& study) {
  const std::string file = study.run.journal.string();
  const auto shared = shared_file_system(study.run.journal);
  return shared ? fmt::format("{} ({}: a rollback log, slower than on a local disk)", file, *shared)
                : file;
}

void answer_check(const Study& study) {
  answer() = {{"title", study.title},
              {"model", study.model_file.string()},
              {"variables", answer_of(study.space)},
              {"method", in_words(method_of(study).method)},
              {"max_steps", study.max_steps},
              {"workers", study.run.workers},
              {"timeout_s", study.run.timeout},
              {"journal", study.run.journal.string()}};
  for (const StudyExperiment& experiment : study.experiments) {
    const std::size_t values = experiment.curve     ? experiment.curve->y_compared.size()
                               : experiment.modal() ? experiment.modes.size()
                                                    : experiment.forces.size();
    answer()["experiments"].push_back({{"name", experiment.name},
                                       {"kind", kind_of(experiment)},
                                       {"values", values},
                                       {"measurement", experiment.measurement_file.string()},
                                       {"fitted", experiment.fitted},
                                       {"weight", experiment.objective.weight}});
  }
}

/// What earlier trials tell: how many failed, why most of them did, and whether the measurements
/// can be compared with those that succeeded.
void print_trials_so_far(const Study& study) {
  if (!std::filesystem::exists(study.run.journal)) return;
  const Journal journal = Journal::read(study.run.journal);
  if (const auto what = difference(journal.identity(), correlation::identity(study))) {
    say("Its journal was made otherwise: {}\n", *what);
    return;
  }
  const Objective target = correlation::objective(study);
  std::map<std::string, long> reasons;
  journal.for_each([&](const Trial& trial) {
    const auto& result = trial.outcome.result;
    const auto score = result ? target(trial.point, *result) : Result<Score>(result.failure());
    if (!score) ++reasons[score.failure().reason];
  });
  long failed = 0;
  const std::pair<const std::string, long>* most = nullptr;
  for (const auto& reason : reasons) {
    failed += reason.second;
    if (!most || reason.second > most->second) most = &reason;
  }
  say("{} trials so far, {} of them without a target{}\n",
      journal.size(),
      failed,
      most ? ", most often because: " + most->first : "");
}

void print_stages(const Study& study) {
  if (!study.stages.empty()) say("\nStages\n");
  for (int k = 0; k < std::ssize(study.stages); ++k) {
    const Study stage = correlation::stage(study, k);
    say("  {:<16} {}; {}, at most {} steps; {}\n",
        stage.stage,
        in_words(study.stages[static_cast<std::size_t>(k)]),
        in_words(method_of(stage).method),
        stage.max_steps,
        stage.run.journal.filename().string());
  }
  const std::string start = in_words(study.start);
  if (!start.empty()) say("\nThe search starts at {}\n", start);
}

void check(const std::string& file) {
  const Study study = correlation::read_study(file);
  reject_implausible(study);
  std::optional<fe_tire::Mesh> mesh;
  if (study.simulator) {
    print_simulator(study);
  } else if (study.rolling) {
    print_rolling_tire(study);
  } else {
    mesh = print_tire(study);
  }
  answer_check(study);
  say("\nVariables\n");
  print_variables(study.space);
  if (!study.space.constraints().empty()) say("\nLinear constraints\n");
  print_constraints(study.space);
  say("\nExperiments\n");
  if (!mesh) print_curves(study);
  for (const StudyExperiment& experiment : study.experiments) {
    if (mesh) print_experiment(experiment, *mesh);
  }
  if (!study.constraints.empty()) say("\nConstraints on channels\n");
  for (const auto& constraint : study.constraints) {
    say("  {:<16} {}\n", constraint.name, in_words(constraint));
  }
  print_stages(study);
  const MethodChoice choice = method_of(study);
  say("\nOptimizer {}, at most {} steps: {}\n"
      "Workers {}, {:g} s a trial at most, journal {}\n"
      "Where a trial fails, {}\n",
      in_words(choice.method),
      study.max_steps,
      choice.reason,
      study.run.workers,
      study.run.timeout,
      journal_in_words(study),
      correlation::in_words(study.run.on_failure));
  print_trials_so_far(study);
  say("\nEverything is in order. Next: latsch run {}\n", file);
}

}  // namespace

void add_check(CommandLine& app, int&) {
  Verb verb = app.add_subcommand(
      "check", "Reads a study, its model and its measurements, and says what it understood");
  verb.footer("Example:\n  latsch check studies/tire_b_twin/study.toml");
  auto file = std::make_shared<std::string>();
  verb.add_option("study", *file, "Study file (TOML)").required();
  verb.callback([file] { check(*file); });
}

}  // namespace latsch::cli
