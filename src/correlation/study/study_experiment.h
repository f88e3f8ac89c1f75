// SPDX-License-Identifier: Apache-2.0
// One experiment of a study: a test, what the laboratory measured, and how its recording is
// compared.
//
// A test stands in its experiment, or by itself as [test.NAME] (specimens.h), for several of them:
// test = "NAME" in the place of the keys that say what is done.
//
//   [experiment.stiffness]
//   kind = "load_deflection"
//   pressure = "2.6 bar"               # the tire's own unless given
//   friction = 0.8                     # with the ground; 0 unless given
//   measurement = "stiffness.csv"      # columns deflection (or loaded_radius) and force; or the
//                                      # name of a [measurement.NAME]
//   compare = "force"                  # or "root_force", see objective.h
//   exponent = 1
//   weight = 1
//   noise = "1 %"                      # of a measured value, where known: weights the fit, tells
//                                      # it when to end, and gives the intervals; also "20 N",
//                                      # "estimated" by the fit, "own_stage", which is the error
//                                      # an earlier stage left, and loss: measurement_noise.h
//   use = "fit"                        # or "predict": compared in the report, not fitted
//
//   [experiment.modes]
//   kind = "modes"
//   pressure = "2.6 bar"
//   deflection = "25 mm"               # or load = "4 kN"; neither: unloaded
//   measurement = "modes.csv"          # column frequency; n, type, phase where known
//   shapes = "mode_shapes.csv"         # where measured: modes are then paired by MAC
//   min_mac = 0.5
//   missing_mode = 1                   # |df| of a measured mode without a partner
//   simulated_modes = 28               # lowest modes computed; 8 more than measured unless given
//
// Other kinds: "curve" (observable/curve.h), "values" (observable/values.h).
//
// To write measurements from the model itself (a twin), also say what the laboratory would measure:
// deflections = ["5 mm", "10 mm"], or measured_modes = 12.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/laboratory/measurement_noise.h"
#include "correlation/observable/objective.h"
#include "correlation/observable/observable.h"
#include "correlation/study/specimens.h"
#include "measurement/channels.h"

namespace latsch::correlation {

enum class Measurements { required, not_yet };

struct StudyExperiment {
  std::string name;
  ObjectiveSettings objective;
  bool fitted = true;                     // false: predicted only
  std::optional<MeasurementNoise> noise;  // standard deviation of a measured value
  bool estimates_noise = false;           // by the fit: target/estimated_noise.h sets it
  bool noise_of_own_stage = false;        // it is the least error that an earlier stage left
  RobustLoss loss = {};
  std::filesystem::path measurement_file;  // of a [measurement.NAME] the first; empty: none
  std::shared_ptr<const Measurement> measurement = {};  // nullptr: the observable read the file
  std::shared_ptr<const Measurement> read_from = {};    // the same, stated or not: its ledger
  std::filesystem::path shapes_file;                    // empty: no shapes
  int measured_modes = 0;                               // how many there are, or will be in a twin
  std::shared_ptr<const Observable> observable = {};

  /// Measured values compared.
  size_t values() const { return observable->values(); }
  /// Where they stand, for people: "measurement cornering", "stiffness.csv", "the study".
  std::string measured_in() const;
};

/// Against what an experiment is read.
struct ExperimentContext {
  std::filesystem::path folder;  // of measurement files
  Measurements measurements = Measurements::required;
  const experiment::Language& language;
  const Laboratory& laboratory;
  const experiment::SpecimenKind* kind = nullptr;  // of the model; nullptr: an outside program
};

/// Reads one [experiment.NAME] and its measurement files. A test of its own is added to the tests,
/// under the name of the experiment.
StudyExperiment read_experiment(const Node& table,
                                const ExperimentContext& context,
                                std::vector<StudyTest>& tests);

/// The stated deviation of every value in units of its difference d as compared; empty where no
/// noise is stated.
std::vector<double> stated_deviations(const StudyExperiment& experiment);

/// Exponents of a study's fitted experiments, for target_in_words().
std::vector<double> fitted_exponents(const std::vector<StudyExperiment>& experiments);

/// Over what it is compared, or what was done.
std::string conditions_of(const StudyExperiment& experiment, const std::vector<StudyTest>& tests);

/// How the channels of a trial differ from the measurement. Throws InputError where they leave
/// nothing to compare.
Comparison compare(const StudyExperiment& experiment, const Channels& trial);

}  // namespace latsch::correlation
