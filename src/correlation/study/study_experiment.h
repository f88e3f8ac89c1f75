// SPDX-License-Identifier: Apache-2.0
// One experiment of a study: a test, the measurement, and the method of their comparison. A test is
// stated in its experiment, or separately as [test.NAME] (specimens.h) for several experiments;
// then test = "NAME" replaces the keys of the test. Other kinds of experiments are "curve"
// (observable/curve.h) and "values" (observable/values.h). For writing measurements computed by the
// model itself (a twin), the experiment also states what the laboratory would measure: deflections
// = ["5 mm", "10 mm"], or measured_modes = 12. The keys are in
// correlation/study/keys/experiment_keys.cpp.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/laboratory/measurement_noise.h"
#include "correlation/nuisance/nuisance_numbers.h"
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
  /// true: the noise is estimated by the fit (target/estimated_noise.h)
  bool estimates_noise = false;
  /// true if the noise is the least error that an earlier stage left
  bool noise_of_own_stage = false;
  RobustLoss loss = {};
  std::filesystem::path measurement_file;  // first file of a [measurement.NAME]; empty: none
  /// the measurement; nullptr if the observable itself has read the file
  std::shared_ptr<const Measurement> measurement = {};
  /// The measurement that was read, whether or not the study states it; its ledger is shown.
  std::shared_ptr<const Measurement> read_from = {};
  std::filesystem::path shapes_file;  // empty: no shapes
  int measured_modes = 0;  // number of modes that are measured, or that a twin will write
  std::shared_ptr<const Observable> observable = {};
  Nuisance nuisance = {};  // numbers of the recording that every trial solves

  /// Returns the number of measured values that are compared.
  size_t values() const { return observable->values(); }
  /// Returns the source of the measured values in words: "measurement cornering", "stiffness.csv",
  /// "the study".
  std::string measured_in() const;
};

/// Data that reading an experiment needs.
struct ExperimentContext {
  std::filesystem::path folder;  // folder of measurement files
  Measurements measurements = Measurements::required;
  const experiment::Language& language;
  const Laboratory& laboratory;
  const experiment::SpecimenKind* kind = nullptr;  // kind of the model; nullptr: an outside program
  std::vector<Node> shared_nuisance = {};          // tables [nuisance.NAME]
};

/// Reads one [experiment.NAME] and its measurement files. If the experiment states a test of its
/// own, this test is added to `tests` under the experiment's name.
StudyExperiment read_experiment(const Node& table,
                                const ExperimentContext& context,
                                std::vector<StudyTest>& tests);

/// Returns the stated standard deviation of every value in units of its difference d as compared;
/// empty if no noise is stated.
std::vector<double> stated_deviations(const StudyExperiment& experiment);

/// Returns the exponents of a study's fitted experiments, for target_in_words().
std::vector<double> fitted_exponents(const std::vector<StudyExperiment>& experiments);

/// Returns in words the abscissa of the comparison or, if there is none, the conditions of the
/// test.
std::string conditions_of(const StudyExperiment& experiment, const std::vector<StudyTest>& tests);

/// True if the measured values of the experiment count in the fit: it is fitted and has a weight.
bool counts(const StudyExperiment& experiment);

/// Returns the positions of the nuisance numbers that are counted with experiment `e`: its own, and
/// those that it shares with others, if no counting experiment before it shares them.
std::vector<std::size_t> counted_numbers(const std::vector<StudyExperiment>& experiments,
                                         std::size_t e);

/// Compares the channels of a trial with each of the experiments, at the best nuisance numbers of
/// the recordings. Fails if they leave an experiment nothing to compare.
Result<std::vector<Comparison>> compare_all(const std::vector<StudyExperiment>& experiments,
                                            const Channels& trial);

/// Compares as compare_all() does with one experiment alone. Other counting ones of `experiments`
/// may share nuisance numbers with it. Fails if the channels leave nothing to compare.
Result<Comparison> comparison_of(const StudyExperiment& experiment,
                                 const std::vector<StudyExperiment>& experiments,
                                 const Channels& trial);

/// Compares as comparison_of() does. Throws InputError if the channels leave nothing to compare.
Comparison compare(const StudyExperiment& experiment,
                   const std::vector<StudyExperiment>& experiments,
                   const Channels& trial);

}  // namespace latsch::correlation
