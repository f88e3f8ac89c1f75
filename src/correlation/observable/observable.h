// SPDX-License-Identifier: Apache-2.0
// What of a trial's recording is compared with what was measured, and how it is shown.
//
// An observable knows the channels it asks for, its measured values and what an error of 100 % is;
// it knows no model and no test. Each kind is one file of this folder:
//
//   force_curve.h   forces over deflections or loaded radii
//   mode_set.h      frequencies of modes, paired by shape or label
//   curve.h         a channel over another one: values, spectra, levels, paths
//   values.h        single values of a channel
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "correlation/laboratory/measurement.h"
#include "correlation/laboratory/measurement_noise.h"
#include "correlation/observable/objective.h"
#include "measurement/channels.h"

namespace latsch::report {
struct Band;
struct StudyReport;
}  // namespace latsch::report

namespace latsch::correlation {

/// One experiment at the point found, beside the point it started from, for a page.
struct ShownExperiment {
  std::string name, conditions;
  bool fitted = true;
  bool of_design = false;  // the best trial of a design: nothing was fitted
  const Channels& found;
  const Comparison& comparison;
  const Channels* initial = nullptr;  // and its comparison; nullptr where that point failed
  const Comparison* initial_comparison = nullptr;
  const report::Band* band = nullptr;  // one value a row; nullptr: not known
};

/// Where the measurement of an experiment lies.
struct MeasurementFiles {
  std::filesystem::path values, shapes;  // shapes: empty where none are measured
  std::string comment;                   // in their first line
  bool is_shared = false;  // another experiment has just written `values`: columns are added
  const Measurement* measurement = nullptr;  // the [measurement.NAME] whose columns are replaced
};

class Observable {
 public:
  virtual ~Observable() = default;

  /// "load_deflection", "modes", "curve", "values": as a study names it.
  virtual std::string kind() const = 0;
  /// What is compared: "root of force", "PSD of response/z".
  virtual std::string compared(const ObjectiveSettings& settings) const = 0;
  /// Over what: "over response/time"; empty where the conditions of the test say all.
  virtual std::string over() const { return ""; }
  /// What an error of 100 % is, where it is the same for all values: "10 mm"; else empty.
  virtual std::string whole() const { return ""; }
  /// The sign of one error: "dF", "df", "d".
  virtual std::string error_name() const { return "d"; }
  /// The channels of a trial it needs, "TEST/CHANNEL".
  virtual std::vector<std::string> asks() const = 0;

  /// Measured values compared.
  virtual std::size_t values() const = 0;
  /// What each of them is called: "10 mm", "radial n=2".
  virtual std::vector<std::string> rows() const = 0;
  /// Whether values beside each other can share noise, as those of one sweep do.
  virtual bool is_sweep() const { return true; }
  /// SI, of what an absolute noise stands beside.
  virtual std::string unit() const = 0;
  /// What was measured, one each, in that unit, and what an error of 100 % of it is: a trial has
  ///   measured - error scale  in its place (Comparison::errors).
  virtual std::vector<double> measured_values() const = 0;
  virtual std::vector<double> scales() const = 0;
  /// The deviation of every value in units of its difference d as compared.
  virtual std::vector<double> deviations(const MeasurementNoise& noise,
                                         const ObjectiveSettings& settings) const = 0;

  /// A Failure where the channels leave nothing to compare: a mode without a partner is no failure.
  virtual Result<Comparison> compare(const Channels& trial,
                                     const ObjectiveSettings& settings) const = 0;

  /// Whether it can tell the slopes of its differences where the channels have theirs.
  virtual bool passes_slopes() const { return false; }

  /// Writes what a laboratory would have measured of such a trial. Returns the files.
  virtual std::vector<std::filesystem::path> write(const Channels& trial,
                                                   const MeasurementFiles& files) const = 0;

  /// For the page.
  virtual void draw(const ShownExperiment& shown, report::StudyReport& page) const = 0;
  /// For the console: a table, a line a value.
  virtual std::string table(const Channels& trial, const Comparison& comparison) const = 0;
  /// For a program: the key and what stands there. Both stay what they are.
  virtual std::pair<std::string, nlohmann::ordered_json> answer(
      const Channels& trial, const Comparison& comparison) const = 0;
};

/// The channels of one test out of those of a trial, under their own names.
Channels recording_of(const std::string& test, const Channels& trial);

/// As JSON has it: null where it is not finite.
nlohmann::ordered_json json_of(double value);
nlohmann::ordered_json json_of(const std::vector<double>& values);

}  // namespace latsch::correlation
