// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study_experiment.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/document_record.h"
#include "base/text.h"
#include "base/toml/toml_text.h"
#include "base/units.h"
#include "correlation/nuisance/shared_numbers.h"
#include "correlation/observable/compared_kinds.h"
#include "correlation/observable/force_curve.h"
#include "correlation/observable/known_channels.h"
#include "correlation/observable/mode_set.h"
#include "experiment/rigs/load_case.h"
#include "formats/tables/measurement_file.h"

namespace latsch::correlation {
namespace {

constexpr long kMostModes = 200;
/// Largest exponent of the errors: with a larger one, errors of some percent give a target that is
/// zero in the printed digits.
constexpr double kLargestExponent = 10.0;

ObjectiveSettings read_objective(const Node& table) {
  ObjectiveSettings settings;
  settings.weight = table.quantity("weight", "1", Range::not_negative(), settings.weight);
  settings.exponent =
      table.quantity("exponent", "1", Range{0.0, kLargestExponent, true}, settings.exponent);
  return settings;
}

/// Returns the measurement file that `key` names; empty if it does not exist but is allowed to be
/// missing.
std::filesystem::path find_file(const Node& table,
                                const std::string& key,
                                const std::filesystem::path& folder,
                                Measurements measurements) {
  const auto file = folder / table.text(key);
  if (std::filesystem::exists(file)) return file;
  if (measurements == Measurements::not_yet) return {};
  table.reject(key,
               "is \"" + table.text(key) +
                   "\", which does not exist; measure it, or write it from the model itself with "
                   "latsch export --measurements");
}

/// Returns the measurement that the key `measurement` names: a [measurement.NAME], or else a file.
std::shared_ptr<const Measurement> read_named_measurement(const Node& table,
                                                          const ExperimentContext& context) {
  const std::string name = table.text("measurement");
  if (auto stated = find(context.laboratory, name)) return stated;
  if (!std::filesystem::exists(context.folder / name) && !context.laboratory.empty()) {
    std::vector<std::string> names;
    for (const auto& one : context.laboratory) names.push_back(one->name());
    table.reject(
        "measurement",
        fmt::format("is {}, which is neither a file nor a [measurement.NAME]{}; there are {}",
                    in_quotes(name),
                    did_you_mean(name, names),
                    list_of(names)));
  }
  return std::make_shared<Measurement>(
      read_measurement(find_file(table, "measurement", context.folder, Measurements::required)));
}

/// Returns the test of [test.NAME] that an experiment names, after a check that the test records
/// `channel`.
const StudyTest& named_test(const Node& table,
                            const std::vector<StudyTest>& tests,
                            const std::string& channel) {
  std::vector<std::string> names;
  for (const StudyTest& test : tests) names.push_back(test.name);
  const StudyTest& test = tests[static_cast<std::size_t>(
      std::find(names.begin(), names.end(), table.choice("test", names)) - names.begin())];
  for (const auto& recorded : test.test->channels())
    if (recorded.name == channel) return test;
  table.reject("test",
               "is " + in_quotes(test.name) + " (" + test.test->in_words() +
                   "), which does not record " + in_quotes(channel));
}

/// Adds the test that an experiment states itself, of a kind with the experiment's name. The
/// identity of the test is made of the keys read for it, and equals that of the same keys in a
/// [test.NAME].
void add_own_test(const Node& table,
                  const ExperimentContext& context,
                  const experiment::MeasuredAbscissa& measured,
                  std::vector<StudyTest>& tests) {
  DocumentRecord keys(table);
  const experiment::TestKind* kind = context.language.find_test(table.text("kind"));
  if (!kind || !kind->read_measured)
    table.reject("kind",
                 "is a test that this program does not have, expected one of " +
                     list_of(context.language.test_names()) + " as [test.NAME]");
  std::shared_ptr<const experiment::Test> test = kind->read_measured(table, measured, keys);
  if (const auto reason = reason_against(*context.kind, *test, context.language))
    table.reject("kind", *reason);
  for (const StudyTest& other : tests) {
    if (other.name == table.name())
      table.reject("kind",
                   "has a test of its own, whose channels have the names of those of [test." +
                       other.name + "]; give one of the two another name");
  }
  keys.put("kind", toml_text(table.text("kind")));
  tests.push_back({table.name(), std::move(test), keys.text(), {}, true});
}

/// Returns the measurement of a load-deflection curve: a table [measurement.NAME], or a file whose
/// columns differ from those of a plain load-deflection table; nullptr for a plain table.
std::shared_ptr<const Measurement> measured_curve(const Node& table,
                                                  const ExperimentContext& context) {
  if (auto stated = find(context.laboratory, table.text("measurement"))) return stated;
  const auto file = find_file(table, "measurement", context.folder, context.measurements);
  if (file.empty() || formats::is_load_deflection_table(file)) return nullptr;
  return std::make_shared<Measurement>(read_measurement(file));
}

std::shared_ptr<const Observable> read_load_deflection(const Node& table,
                                                       const ExperimentContext& context,
                                                       const Measurement* stated,
                                                       ObjectiveSettings& objective,
                                                       std::vector<StudyTest>& tests) {
  LoadDeflectionCurve measured;
  objective.compared = table.choice("compare", {"force", "root_force"}, "force") == "force"
                           ? Compared::force
                           : Compared::root_force;
  const auto file = stated ? stated->files()[0]
                           : find_file(table, "measurement", context.folder, context.measurements);
  if (!file.empty())
    measured = stated ? force_curve_of(*stated) : formats::read_load_deflection(file);
  if (table.has("test")) {
    const StudyTest& test = named_test(table, tests, "force");
    const auto samples = test.test->samples();
    if (samples && !file.empty() && *samples != std::ssize(measured.force))
      table.reject("measurement",
                   fmt::format("has {} values, but the test {} gives {}",
                               measured.force.size(),
                               in_quotes(test.name),
                               *samples));
    return std::make_shared<ForceCurve>(test.name, std::move(measured));
  }
  experiment::MeasuredAbscissa test;
  if (table.has("deflections"))
    test.deflections = table.quantities("deflections", "m", Range::positive());
  if (!file.empty()) {
    const bool radii = measured.abscissa == Abscissa::loaded_radius;
    test.deflections = radii ? std::vector<double>{} : measured.position;
    test.loaded_radii = radii ? measured.position : std::vector<double>{};
  } else if (test.deflections.empty()) {
    table.reject("deflections", "is missing: without a measurement it says where to compute one");
  } else {
    measured.position = test.deflections;
  }
  add_own_test(table, context, test, tests);
  return std::make_shared<ForceCurve>(table.name(), std::move(measured));
}

/// Checks that mode shapes are measured and recorded at the same points.
void check_sensors(const Node& table, const StudyTest& test, const Eigen::Matrix3Xd& points) {
  const auto* modal = test.test->settings_as<experiment::ModalTest>();
  const Eigen::Matrix3Xd recorded = modal ? modal->points : Eigen::Matrix3Xd();
  if (recorded.cols() == points.cols() && recorded == points) return;
  table.reject("shapes",
               fmt::format("has {} sensor points, but [test.{}] records shapes at {}; put points = "
                           "{{from = \"measurement.NAME\"}} into it, of a [measurement.NAME] with "
                           "that file",
                           points.cols(),
                           test.name,
                           recorded.cols() == 0 ? "none" : "others"));
}

std::shared_ptr<const Observable> read_modes(const Node& table,
                                             const ExperimentContext& context,
                                             StudyExperiment& experiment,
                                             std::vector<StudyTest>& tests) {
  ObjectiveSettings& objective = experiment.objective;
  objective.missing_mode =
      table.quantity("missing_mode", "1", Range::not_negative(), objective.missing_mode);
  objective.pairing.min_likeness =
      table.quantity("min_mac", "1", {0.0, 1.0, true}, objective.pairing.min_likeness);

  ModeTable modes;
  long measured = table.integer("measured_modes", 1, kMostModes, 0);
  const auto file = find_file(table, "measurement", context.folder, context.measurements);
  if (!file.empty()) {
    modes = formats::read_modes(file);
    measured = static_cast<long>(modes.modes.size());
  } else if (measured == 0) {
    table.reject("measured_modes", "is missing: without a measurement it says how many to compute");
  }
  experiment.measured_modes = static_cast<int>(measured);
  if (table.has("shapes")) {
    experiment.shapes_file = context.folder / table.text("shapes");
    const auto shapes = find_file(table, "shapes", context.folder, context.measurements);
    if (!file.empty() && !shapes.empty()) formats::read_shapes(shapes, modes);
  }
  if (table.has("test")) {
    const StudyTest& test = named_test(table, tests, "frequency");
    if (!modes.points.empty()) check_sensors(table, test, experiment::sensor_points(modes));
    return std::make_shared<ModeSet>(test.name,
                                     experiment::mode_records(modes),
                                     static_cast<std::size_t>(measured),
                                     experiment::sensor_points(modes));
  }
  const Eigen::Matrix3Xd points = experiment::sensor_points(modes);
  add_own_test(table, context, {.modes = measured, .points = points}, tests);
  return std::make_shared<ModeSet>(
      table.name(), experiment::mode_records(modes), static_cast<std::size_t>(measured), points);
}

/// Returns the noise that the measurement states for the compared channel; none for a spectrum.
std::optional<MeasurementNoise> noise_of(const StudyExperiment& experiment) {
  const std::string channel = channel_part(experiment.observable->asks().back());
  const auto known = Unit::find(experiment.observable->unit());
  for (const std::string& name : {channel, std::string(channel == "force" ? "Fz" : channel)}) {
    const MeasurementNoise* noise = experiment.measurement->noise(name);
    if (noise && known && known->same_dimension(Unit::of(experiment.measurement->unit(name))))
      return *noise;
  }
  return std::nullopt;
}

[[noreturn]] void reject_channel_of_no_test(const Node& table,
                                            const std::string& kind,
                                            const ExperimentContext& context) {
  table.reject("kind",
               "is " + in_quotes(kind) + ", but [test] is missing: a " + context.kind->in_words() +
                   " gives channels by the tests it is driven through, and there is none. Add one "
                   "or more, such as\n\n    [test.cleat]\n    file = \"cleat.toml\"\n\n"
                   "and in cleat.toml, beside the study, its kind: " +
                   list_of(context.language.test_names()) +
                   ". Experiments compare its channels as y = \"cleat/...\"");
}

NuisanceWeights weights_of(const StudyExperiment& experiment) {
  return {stated_deviations(experiment), experiment.objective.weight};
}

/// Compares a trial with an experiment that shares no nuisance number.
Result<Comparison> compared_alone(const StudyExperiment& experiment, const Channels& trial) {
  if (experiment.nuisance.empty())
    return experiment.observable->compare(trial, experiment.objective);
  return compare_with(experiment.nuisance,
                      weights_of(experiment),
                      *experiment.observable,
                      experiment.objective,
                      trial);
}

/// Notes in the ledger of a measurement which channels an experiment compares.
void note_uses(const Measurement& measured, const StudyExperiment& experiment) {
  const std::string by = "experiment " + experiment.name;
  constexpr std::string_view kBy = "_by_";
  for (const std::string& asked : experiment.observable->asks()) {
    const std::string channel = channel_part(asked);
    const std::size_t slope = channel.find(kBy);
    if (measured.has(channel) || slope == channel.npos) {
      measured.note_use(channel, by);
      continue;
    }
    measured.note_use(channel.substr(0, slope), by);
    measured.note_use(channel.substr(slope + kBy.size()), by);
  }
  if (experiment.observable->kind() != "load_deflection") return;
  for (const char* channel : {"deflection", "loaded_radius", "Fz", "spread"})
    measured.note_use(channel, by);
}

}  // namespace

StudyExperiment read_experiment(const Node& table,
                                const ExperimentContext& context,
                                std::vector<StudyTest>& tests) {
  StudyExperiment experiment;
  experiment.name = table.name();
  experiment.objective = read_objective(table);
  experiment.fitted = table.choice("use", {"fit", "predict"}, "fit") == "fit";
  std::vector<std::string> kinds = compared_kind_names();
  if (context.kind) kinds.insert(kinds.begin(), {"load_deflection", "modes"});
  const std::string kind = table.choice("kind", kinds);
  const ComparedKind* compared = find_compared_kind(kind);
  if (compared && tests.empty()) reject_channel_of_no_test(table, kind, context);
  // set if the compared channels come from a measurement
  std::shared_ptr<const Measurement> measured;
  if (compared && (compared->needs_measurement || table.has("measurement")))
    measured = read_named_measurement(table, context);
  if (kind == "load_deflection") measured = measured_curve(table, context);
  const bool is_kept = compared && !compared->needs_measurement;
  if (measured && (measured->is_stated() || is_kept)) experiment.measurement = measured;
  if (measured) {
    experiment.measurement_file = measured->files()[0];
  } else if (!compared) {
    experiment.measurement_file = context.folder / table.text("measurement");
  }
  if (compared) {
    experiment.observable = compared->read(table, known_channels(tests), measured.get());
  } else if (kind == "modes") {
    experiment.observable = read_modes(table, context, experiment, tests);
  } else {
    experiment.observable =
        read_load_deflection(table, context, measured.get(), experiment.objective, tests);
  }
  if (measured) note_uses(*measured, experiment);
  experiment.read_from = measured;
  experiment.estimates_noise = experiment.fitted && is_estimated(table);
  experiment.noise_of_own_stage = experiment.fitted && is_of_own_stage(table);
  if (!is_estimated(table)) {
    experiment.noise = read_noise(table, experiment.observable->unit());
    if (!experiment.noise && experiment.measurement) experiment.noise = noise_of(experiment);
  } else if (table.has("loss")) {
    table.reject("loss",
                 fmt::format("is given beside noise = \"{}\", expected one of the two: far-off "
                             "values would make the noise that they are judged by",
                             table.text("noise")));
  }
  experiment.loss = read_loss(table, experiment.noise.has_value());
  experiment.nuisance = read_nuisance(table,
                                      context.shared_nuisance,
                                      *experiment.observable,
                                      experiment.objective,
                                      experiment.fitted,
                                      experiment.noise || experiment.estimates_noise);
  return experiment;
}

std::string StudyExperiment::measured_in() const {
  if (measurement && measurement->is_stated()) return "measurement " + measurement->name();
  return measurement_file.empty() ? "the study" : measurement_file.filename().string();
}

std::vector<double> stated_deviations(const StudyExperiment& experiment) {
  if (!experiment.noise) return {};
  return experiment.observable->deviations(*experiment.noise, experiment.objective);
}

std::vector<double> fitted_exponents(const std::vector<StudyExperiment>& experiments) {
  std::vector<double> exponents;
  for (const StudyExperiment& experiment : experiments)
    if (experiment.fitted) exponents.push_back(experiment.objective.exponent);
  return exponents;
}

std::string conditions_of(const StudyExperiment& experiment, const std::vector<StudyTest>& tests) {
  if (!experiment.observable->over().empty()) return experiment.observable->over();
  const std::string name = test_of(experiment.observable->asks().front());
  for (const StudyTest& test : tests)
    if (test.name == name) return test.test->conditions();
  return "";
}

bool counts(const StudyExperiment& experiment) {
  return experiment.fitted && experiment.objective.weight > 0.0;
}

std::vector<std::size_t> counted_numbers(const std::vector<StudyExperiment>& experiments,
                                         std::size_t e) {
  const auto& own = experiments[e].nuisance.numbers;
  std::vector<std::size_t> counted;
  for (std::size_t k = 0; k < own.size(); ++k) {
    const bool is_known =
        std::any_of(experiments.begin(),
                    experiments.begin() + static_cast<std::ptrdiff_t>(e),
                    [&](const StudyExperiment& before) {
                      const auto& its = before.nuisance.numbers;
                      return counts(before) &&
                             std::any_of(its.begin(), its.end(), [&](const NuisanceNumber& one) {
                               return one.is_one_with(own[k]);
                             });
                    });
    if (!is_known) counted.push_back(k);
  }
  return counted;
}

Result<std::vector<Comparison>> compare_all(const std::vector<StudyExperiment>& experiments,
                                            const Channels& trial) {
  std::vector<SharingRecording> sharing;
  for (const StudyExperiment& one : experiments)
    if (one.nuisance.shares())
      sharing.push_back(
          {one.nuisance, weights_of(one), *one.observable, one.objective, counts(one)});
  std::vector<Comparison> together;
  if (!sharing.empty()) {
    auto found = compare_together(sharing, trial);
    if (!found) return found.failure();
    together = std::move(*found);
  }
  std::vector<Comparison> all;
  auto next = together.begin();
  for (const StudyExperiment& one : experiments) {
    if (one.nuisance.shares()) {
      all.push_back(std::move(*next++));
      continue;
    }
    auto comparison = compared_alone(one, trial);
    if (!comparison) return comparison.failure();  // a measurement may have grown since the trial
    all.push_back(std::move(*comparison));
  }
  return all;
}

Result<Comparison> comparison_of(const StudyExperiment& experiment,
                                 const std::vector<StudyExperiment>& experiments,
                                 const Channels& trial) {
  if (!experiment.nuisance.shares()) return compared_alone(experiment, trial);
  std::vector<StudyExperiment> sharing{experiment};
  for (const StudyExperiment& other : experiments)
    if (other.name != experiment.name && other.nuisance.shares() && counts(other))
      sharing.push_back(other);
  auto all = compare_all(sharing, trial);
  if (!all) return all.failure();
  return std::move(all->front());
}

Comparison compare(const StudyExperiment& experiment,
                   const std::vector<StudyExperiment>& experiments,
                   const Channels& trial) {
  const auto comparison = comparison_of(experiment, experiments, trial);
  if (comparison) return *comparison;
  throw InputError("experiment " + experiment.name + ": " + comparison.failure().reason);
}

}  // namespace latsch::correlation
