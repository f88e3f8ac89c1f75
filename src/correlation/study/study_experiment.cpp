// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/study_experiment.h"

#include <cmath>

#include "formats/tables/measurement_file.h"

namespace latsch::correlation {
namespace {

using experiment::LoadDeflection;
using experiment::ModalTest;

constexpr int kMoreModesThanMeasured = 8;  // so that a swapped neighbor is among them
constexpr long kMostModes = 200;

ObjectiveSettings read_objective(const Node& table) {
  ObjectiveSettings settings;
  settings.weight = table.quantity("weight", "1", Range::not_negative(), settings.weight);
  settings.exponent = table.quantity("exponent", "1", Range::positive(), settings.exponent);
  return settings;
}

fe_tire::Ground read_ground(const Node& table) {
  fe_tire::Ground ground;
  ground.mu = table.quantity("friction", "1", Range::between(0.0, 5.0), 0.0);
  return ground;
}

/// The measurement file named by `key`; empty where it does not exist and need not.
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

void read_load_deflection(const Node& table,
                          const std::filesystem::path& folder,
                          Measurements measurements,
                          StudyExperiment& experiment) {
  LoadDeflection test;
  test.pressure = table.quantity("pressure", "Pa", Range::positive());
  test.ground = read_ground(table);
  experiment.objective.compared =
      table.choice("compare", {"force", "root_force"}, "force") == "force" ? Compared::force
                                                                           : Compared::root_force;
  if (table.has("deflections")) {
    test.deflections = table.quantities("deflections", "m", Range::positive());
  }
  const auto file = find_file(table, "measurement", folder, measurements);
  if (!file.empty()) {
    LoadDeflectionCurve curve = formats::read_load_deflection(file);
    const bool radii = curve.abscissa == Abscissa::loaded_radius;
    test.deflections = radii ? std::vector<double>{} : curve.position;
    test.loaded_radii = radii ? curve.position : std::vector<double>{};
    experiment.forces = std::move(curve.force);
  } else if (test.deflections.empty()) {
    table.reject("deflections", "is missing: without a measurement it says where to compute one");
  }
  experiment.load_case.test = std::move(test);
}

void read_state(const Node& table, ModalTest& test) {
  if (table.has("deflection") && table.has("load")) {
    table.reject("load", "stands beside deflection, expected one of them");
  }
  if (table.has("deflection"))
    test.deflection = table.quantity("deflection", "m", Range::positive());
  if (table.has("load")) test.load = table.quantity("load", "N", Range::positive());
}

void read_modal(const Node& table,
                const std::filesystem::path& folder,
                Measurements measurements,
                StudyExperiment& experiment) {
  ModalTest test;
  test.pressure = table.quantity("pressure", "Pa", Range::positive());
  test.ground = read_ground(table);
  read_state(table, test);
  ObjectiveSettings& objective = experiment.objective;
  objective.missing_mode =
      table.quantity("missing_mode", "1", Range::not_negative(), objective.missing_mode);
  objective.pairing.min_likeness =
      table.quantity("min_mac", "1", {0.0, 1.0, true}, objective.pairing.min_likeness);

  ModeTable modes;
  long measured = table.integer("measured_modes", 1, kMostModes, 0);
  const auto file = find_file(table, "measurement", folder, measurements);
  if (!file.empty()) {
    modes = formats::read_modes(file);
    measured = static_cast<long>(modes.modes.size());
  } else if (measured == 0) {
    table.reject("measured_modes", "is missing: without a measurement it says how many to compute");
  }
  if (table.has("shapes")) {
    experiment.shapes_file = folder / table.text("shapes");
    const auto shapes = find_file(table, "shapes", folder, measurements);
    if (!file.empty() && !shapes.empty()) formats::read_shapes(shapes, modes);
  }
  experiment.modes = experiment::mode_records(modes);
  test.points = experiment::sensor_points(modes);
  experiment.measured_modes = static_cast<int>(measured);
  test.count =
      static_cast<int>(table.integer("simulated_modes",
                                     measured,
                                     kMostModes,
                                     std::min(kMostModes, measured + kMoreModesThanMeasured)));
  experiment.load_case.test = std::move(test);
}

}  // namespace

namespace {

/// SI, of what an absolute noise stands beside.
std::string compared_unit(const StudyExperiment& experiment) {
  if (experiment.curve) return experiment.curve->y_compared_unit;
  return experiment.modal() ? "Hz" : "N";
}

}  // namespace

StudyExperiment read_experiment(const Node& table,
                                const std::filesystem::path& folder,
                                Measurements measurements,
                                const std::vector<KnownChannel>* known) {
  StudyExperiment experiment;
  experiment.name = table.name();
  experiment.load_case.name = table.name();
  experiment.objective = read_objective(table);
  experiment.fitted = table.choice("use", {"fit", "predict"}, "fit") == "fit";
  experiment.measurement_file = folder / table.text("measurement");
  if (known) {
    table.choice("kind", {"curve"});
    const auto file = find_file(table, "measurement", folder, Measurements::required);
    experiment.curve = read_curve(table, file, *known);
  } else if (table.choice("kind", {"load_deflection", "modes"}) == "modes") {
    read_modal(table, folder, measurements, experiment);
  } else {
    read_load_deflection(table, folder, measurements, experiment);
  }
  experiment.noise = read_noise(table, compared_unit(experiment));
  experiment.loss = read_loss(table, experiment.noise.has_value());
  return experiment;
}

std::vector<double> stated_deviations(const StudyExperiment& experiment) {
  if (!experiment.noise) return {};
  const auto [relative, absolute] = *experiment.noise;
  std::vector<double> deviations;
  const auto add = [&](double whole) {
    deviations.push_back(std::hypot(relative, absolute / whole));
  };
  if (experiment.curve) {
    for (size_t k = 0; k < experiment.values(); ++k) add(experiment.curve->scale);
    return deviations;
  }
  for (const ModeRecord& mode : experiment.modes) add(mode.frequency);
  for (const double force : experiment.forces) add(force);
  // A root is off by half as much, relative.
  if (experiment.objective.compared == Compared::root_force) {
    for (double& deviation : deviations) deviation *= 0.5;
  }
  return deviations;
}

std::vector<double> fitted_exponents(const std::vector<StudyExperiment>& experiments) {
  std::vector<double> exponents;
  for (const StudyExperiment& experiment : experiments)
    if (experiment.fitted) exponents.push_back(experiment.objective.exponent);
  return exponents;
}

Comparison compare(const StudyExperiment& experiment, const Channels& channels) {
  if (experiment.curve) {
    const auto comparison = compare_curve(*experiment.curve, channels, experiment.objective);
    if (comparison) return *comparison;
    throw InputError("experiment " + experiment.name + ": " + comparison.failure().reason);
  }
  if (experiment.modal()) {
    return compare_modes(
        experiment.modes, experiment::mode_records(channels), experiment.objective);
  }
  return compare_forces(experiment.forces, channels["force"], experiment.objective);
}

}  // namespace latsch::correlation
