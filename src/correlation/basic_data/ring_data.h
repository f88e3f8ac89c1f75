// SPDX-License-Identifier: Apache-2.0
// From what a user measures of a tire to the numbers of the flexible ring: a weighted fit of the
// model to the data, and what the data leave open.
//
//   tire = "passenger_205_55R16.toml"      # known numbers and first guesses, beside this file
//
//   [variable.radial]                   # what the data have to tell, see variables.h
//   path = "sidewall.radial.stiffness"
//   lower = "0.2 MN/m^2"
//   upper = "1.5 MN/m^2"
//   initial = "0.55 MN/m^2"
//   scale = "logarithmic"
//
//   [target.first_load]                 # what was measured; weight = 1 unless given, 0: only shown
//   kind = "load"                       # at a deflection from first touch, standing
//   deflection = "18.2 mm"
//   value = "3015.5 N"
//   [target.along]
//   kind = "stiffness"                  # direction = "longitudinal", "lateral" (N/m), "torsional"
//   direction = "longitudinal"          # (N m/rad) or "vertical", under `load`
//   load = "5026.7 N"
//   value = "228.755 N/mm"
//   [target.patch]
//   kind = "footprint_length"           # or "footprint_width", standing under `load`
//   load = "4 kN"
//   value = "130 mm"
//   [target.f1]
//   kind = "frequency"                  # of the unloaded tire, rim fixed
//   mode = "f1"
//   value = "54.08 Hz"
//   [target.D1]
//   kind = "damping"                    # of critical, of that mode
//   mode = "f1"
//   value = 0.0902
//
// Modes: f1 rotation and f2 translation in the plane, f3 sideways, f4 tilt, f5 first bending in the
// plane, f6 first bending out of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/document.h"
#include "experiment/rigs/static_stiffness.h"
#include "models/ring_tire/description/ring_parameters.h"
#include "optimization/identifiability/confidence.h"
#include "optimization/problem/design_space.h"

namespace latsch::correlation {

struct RingTarget {
  enum class Kind { load, stiffness, footprint_length, footprint_width, frequency, damping };
  std::string name;
  Kind kind = Kind::load;
  double value = 0.0, weight = 1.0;
  double deflection = 0.0, load = 0.0;  // m, N
  experiment::Direction direction = experiment::Direction::vertical;
  int waves = 0;
  bool lateral = false;
};

struct RingData {
  std::filesystem::path file;
  Document tire;
  DesignSpace space;
  std::vector<RingTarget> targets;
};

/// Throws InputError naming the place, in the data or in the tire.
RingData read_ring_data(const std::filesystem::path& file);

/// What the tire at a point shows, one value a target.
Result<std::vector<double>> shown(const RingData& data, const DesignPoint& point);

struct RingFit {
  DesignPoint point;
  Document tire;               // with the numbers found
  std::vector<double> values;  // of the targets
  int evaluations = 0;
  Confidence confidence;    // of relative errors of `kTypicalError`
  Eigen::VectorXd errors;   // value over target, less 1; also of targets without weight
  Eigen::MatrixXd effects;  // [targets x variables] what a variable's whole range does to it
};

/// A relative error that such measurements typically have: the scale on which a direction of the
/// variables counts as open.
constexpr double kTypicalError = 0.01;

Result<RingFit> fit_ring(const RingData& data, int most_evaluations = 400);

/// Sentences: every target that the tire misses by more than 3 %, the variable that would mend it
/// most easily, and which other target pays for that most.
std::vector<std::string> missed(const RingData& data, const RingFit& fit);

/// Sentences: every direction of the variables along which the data leave more than a tenth of the
/// range open, named by its largest shares.
std::vector<std::string> left_open(const RingData& data, const Confidence& confidence);

}  // namespace latsch::correlation
