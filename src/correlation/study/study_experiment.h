// SPDX-License-Identifier: Apache-2.0
// One experiment of a study: a load case, what the laboratory measured, and how the two are
// compared.
//
//   [experiment.stiffness]
//   kind = "load_deflection"
//   pressure = "2.6 bar"
//   friction = 0.8                     # with the ground; 0 unless given
//   measurement = "stiffness.csv"      # columns deflection (or loaded_radius) and force
//   compare = "force"                  # or "root_force", see objective.h
//   exponent = 1
//   weight = 1
//   noise = "1 %"                      # of a measured value, where known: weights the fit, tells
//                                      # it when to end, and gives the intervals; also "20 N", and
//                                      # loss: measurement_noise.h
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
// To write measurements from the model itself (a twin), also say what the laboratory would measure:
// deflections = ["5 mm", "10 mm"], or measured_modes = 12.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/observable/curve_experiment.h"
#include "correlation/observable/measurement_noise.h"
#include "correlation/observable/objective.h"
#include "experiment/rigs/load_case.h"
#include "measurement/channels.h"

namespace latsch::correlation {

// In a study with [simulator] or [model]: kind = "curve", see curve_experiment.h.
enum class Measurements { required, not_yet };

struct StudyExperiment {
  std::string name;
  experiment::LoadCase load_case;  // at the measured deflections, radii and sensor points
  ObjectiveSettings objective;
  bool fitted = true;                     // false: predicted only
  std::optional<MeasurementNoise> noise;  // standard deviation of a measured value
  RobustLoss loss = {};
  std::filesystem::path measurement_file;
  std::filesystem::path shapes_file;          // empty: no shapes
  std::vector<double> forces;                 // N, measured; load-deflection experiments
  std::vector<ModeRecord> modes;              // measured; modal experiments
  int measured_modes = 0;                     // how many there are, or will be in a twin
  std::optional<CurveExperiment> curve = {};  // of known channels, in the place of all these

  /// Measured values compared.
  size_t values() const {
    return curve ? curve->y_compared.size() : modal() ? modes.size() : forces.size();
  }
  bool modal() const { return std::holds_alternative<experiment::ModalTest>(load_case.test); }
};

/// Reads one [experiment.NAME] and its measurement files, which lie relative to `folder`. With
/// `known` channels it compares curves of them, without those of a finite-element tire.
StudyExperiment read_experiment(const Node& table,
                                const std::filesystem::path& folder,
                                Measurements measurements,
                                const std::vector<KnownChannel>* known = nullptr);

/// The stated deviation of every value in units of its difference d as compared; empty where no
/// noise is stated.
std::vector<double> stated_deviations(const StudyExperiment& experiment);

/// Exponents of a study's fitted experiments, for target_in_words().
std::vector<double> fitted_exponents(const std::vector<StudyExperiment>& experiments);

/// How the channels of its load case differ from the measurement. Throws InputError where channels
/// of a curve do not reach as far as the measurement.
Comparison compare(const StudyExperiment& experiment, const Channels& channels);

}  // namespace latsch::correlation
