// SPDX-License-Identifier: Apache-2.0
// An observable compares part of a trial's recording with the measurement and shows the result.
//
// An observable knows the channels it needs, its measured values and the size of an error of 100 %.
// It knows no model and no test. Each kind is one file of this folder:
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

/// One experiment at the best point and at the initial point, to be drawn on a page.
struct ShownExperiment {
  std::string name, conditions;
  bool fitted = true;
  bool of_design = false;  // true for the best trial of a design: nothing was fitted
  const Channels& found;
  const Comparison& comparison;
  /// Recording at the initial point; nullptr if the trial there failed.
  const Channels* initial = nullptr;
  const Comparison* initial_comparison = nullptr;
  const report::Band* band = nullptr;  // one value for each row; nullptr: not known
  double weight = 1.0;
};

/// Files of an experiment's measurement.
struct MeasurementFiles {
  std::filesystem::path values, shapes;  // shapes: empty if none are measured
  std::string comment;                   // first line of the files
  /// True if another experiment has just written the file `values`: columns are then added to it.
  bool is_shared = false;
  const Measurement* measurement = nullptr;  // the [measurement.NAME] whose columns are replaced
};

/// Properties of the compared values that are known before the first trial.
struct ComparedValues {
  std::string kind;      // "load_deflection", "modes", "curve", "values": the name in a study
  std::string compared;  // "force", "PSD of response/z"
  /// Abscissa in words, such as "over response/time"; empty if the conditions of the test describe
  /// it.
  std::string over = "";
  /// Value that counts as an error of 100 %, if it is the same for all values: "10 mm"; otherwise
  /// empty.
  std::string whole = "";
  std::string error_name = "d";        // symbol of one error: "dF", "df"
  std::vector<std::string> asks = {};  // needed channels of a trial, "TEST/CHANNEL"
  std::vector<std::string> rows = {};  // name of each value: "10 mm", "radial n=2"
  bool is_sweep = true;                // true if neighboring values may share noise, as in a sweep
  /// True if derivatives of the channels become derivatives of the differences.
  bool passes_slopes = false;
  std::string unit = "1";  // SI unit of the values and of a noise stated as a quantity
  std::string shown = "";  // unit in which values are shown; empty: `unit`
  /// Measured values in `unit`, and for each the size that counts as an error of 100 %. The
  /// simulated value is measured - error scale (Comparison::errors).
  std::vector<double> measured = {}, scales = {};
};

class Observable {
 public:
  explicit Observable(ComparedValues values) : values_(std::move(values)) {}
  virtual ~Observable() = default;

  const std::string& kind() const { return values_.kind; }
  const std::string& over() const { return values_.over; }
  const std::string& whole() const { return values_.whole; }
  const std::string& error_name() const { return values_.error_name; }
  const std::vector<std::string>& asks() const { return values_.asks; }
  std::size_t values() const { return values_.measured.size(); }
  const std::vector<std::string>& rows() const { return values_.rows; }
  bool is_sweep() const { return values_.is_sweep; }
  bool passes_slopes() const { return values_.passes_slopes; }
  const std::string& unit() const { return values_.unit; }
  const std::string& shown_unit() const {
    return values_.shown.empty() ? values_.unit : values_.shown;
  }
  const std::vector<double>& measured_values() const { return values_.measured; }
  const std::vector<double>& scales() const { return values_.scales; }

  virtual std::string compared(const ObjectiveSettings&) const { return values_.compared; }
  /// Returns the standard deviation of every value in units of its difference d as compared.
  virtual std::vector<double> deviations(const MeasurementNoise& noise,
                                         const ObjectiveSettings& settings) const;

  /// Compares the channels with the measurement. Fails if nothing can be compared. A mode without a
  /// partner is no failure.
  virtual Result<Comparison> compare(const Channels& trial,
                                     const ObjectiveSettings& settings) const = 0;
  /// Compares with the simulated curve shifted along its abscissa: a sample at x with the simulated
  /// y(x - shift). Sets the derivatives by the shift. Only a curve with an abscissa has a shift.
  virtual Result<Comparison> compare_shifted(const Channels& trial,
                                             const ObjectiveSettings& settings,
                                             double shift) const;
  /// Returns the shifts that a trial allows: a tenth of the record in either direction; over time,
  /// as far as the simulation covers the measured samples. Fails if it covers them at no shift.
  virtual Result<DelayRange> shift_range(const Channels& trial) const;

  /// Writes the file of a measurement in which the values of a trial replace the measured values.
  /// Returns the files.
  virtual std::vector<std::filesystem::path> write(const Channels& trial,
                                                   const MeasurementFiles& files) const = 0;

  /// Draws the comparison on the page.
  virtual void draw(const ShownExperiment& shown, report::StudyReport& page) const = 0;
  /// Returns a table for the console, one line for each value.
  virtual std::string table(const Channels& trial, const Comparison& comparison) const = 0;
  /// Returns remarks for people on how the values were compared, one sentence each.
  virtual std::vector<std::string> remarks(const Comparison&) const { return {}; }
  /// Returns key and content for the JSON output. Both are a stable interface for programs.
  virtual std::pair<std::string, nlohmann::ordered_json> answer(
      const Channels& trial, const Comparison& comparison) const = 0;

 private:
  ComparedValues values_;
};

/// Returns the channels of one test among those of a trial, under their own names.
Channels recording_of(const std::string& test, const Channels& trial);

/// Returns null if the value is not finite.
nlohmann::ordered_json json_of(double value);
nlohmann::ordered_json json_of(const std::vector<double>& values);

}  // namespace latsch::correlation
