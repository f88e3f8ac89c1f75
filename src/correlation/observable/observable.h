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
  double weight = 1.0;
};

/// Where the measurement of an experiment lies.
struct MeasurementFiles {
  std::filesystem::path values, shapes;  // shapes: empty where none are measured
  std::string comment;                   // in their first line
  bool is_shared = false;  // another experiment has just written `values`: columns are added
  const Measurement* measurement = nullptr;  // the [measurement.NAME] whose columns are replaced
};

/// What is known of the values compared before there is a trial.
struct ComparedValues {
  std::string kind;        // "load_deflection", "modes", "curve", "values": as a study names it
  std::string compared;    // "force", "PSD of response/z"
  std::string over = "";   // "over response/time"; empty: the conditions of the test say all
  std::string whole = "";  // an error of 100 %, where the same for all: "10 mm"; else empty
  std::string error_name = "d";        // the sign of one error: "dF", "df"
  std::vector<std::string> asks = {};  // channels of a trial, "TEST/CHANNEL"
  std::vector<std::string> rows = {};  // what each value is called: "10 mm", "radial n=2"
  bool is_sweep = true;                // values beside each other can share noise
  bool passes_slopes = false;          // of the channels to its differences
  std::string unit = "1";              // SI, of what an absolute noise stands beside
  std::string shown = "";              // the unit a person reads them in; empty: that
  /// What was measured, one each, in that unit, and what an error of 100 % of it is: a trial has
  ///   measured - error scale  in its place (Comparison::errors).
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
  /// The deviation of every value in units of its difference d as compared.
  virtual std::vector<double> deviations(const MeasurementNoise& noise,
                                         const ObjectiveSettings& settings) const;

  /// A Failure where the channels leave nothing to compare: a mode without a partner is no failure.
  virtual Result<Comparison> compare(const Channels& trial,
                                     const ObjectiveSettings& settings) const = 0;

  /// Writes what a laboratory would have measured of such a trial. Returns the files.
  virtual std::vector<std::filesystem::path> write(const Channels& trial,
                                                   const MeasurementFiles& files) const = 0;

  /// For the page.
  virtual void draw(const ShownExperiment& shown, report::StudyReport& page) const = 0;
  /// For the console: a table, a line a value.
  virtual std::string table(const Channels& trial, const Comparison& comparison) const = 0;
  /// What a person has to know of how it was compared, a sentence each.
  virtual std::vector<std::string> remarks(const Comparison&) const { return {}; }
  /// For a program: the key and what stands there. Both stay what they are.
  virtual std::pair<std::string, nlohmann::ordered_json> answer(
      const Channels& trial, const Comparison& comparison) const = 0;

 private:
  ComparedValues values_;
};

/// The channels of one test out of those of a trial, under their own names.
Channels recording_of(const std::string& test, const Channels& trial);

/// As JSON has it: null where it is not finite.
nlohmann::ordered_json json_of(double value);
nlohmann::ordered_json json_of(const std::vector<double>& values);

}  // namespace latsch::correlation
