// SPDX-License-Identifier: Apache-2.0
// Compares a curve y(x) of channels that a test records with a measured one.
//
// The error of sample i is
//
//   d_i = (y_i^mea - y^sim(x_i^mea)) / scale
//
// with the simulated curve linear between its samples.
//
// The keys are in correlation/observable/keys/curve_keys.cpp.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/document.h"
#include "correlation/laboratory/measurement.h"
#include "correlation/laboratory/natural_abscissa.h"
#include "correlation/observable/curve_comparison.h"
#include "correlation/observable/known_channels.h"
#include "correlation/observable/observable.h"

namespace latsch::report {
struct MeasuredCurve;
}

namespace latsch::correlation {

struct CurveMeasurement {
  std::string x;  // channel; empty: compared sample by sample
  std::string y;
  std::string x_unit = "1", y_unit = "1";      // SI
  std::string x_shown = "1", y_shown = "1";    // units people read
  std::vector<double> x_measured, y_measured;  // SI
  double scale = 1.0;                          // size of an error of 100 %

  std::optional<NaturalAbscissa> natural;  // without x: channel over which the samples are drawn
  CurveComparison comparison;
  bool fits_delay = false;
  /// Measured values as compared: the measured curve itself, or its spectrum over Hz.
  std::string compared_name;                     // "response/z", "PSD of response/z"
  std::string x_compared_unit, y_compared_unit;  // SI
  std::vector<double> x_compared, y_compared;
};

class Curve : public Observable {
 public:
  explicit Curve(CurveMeasurement measured);

  const CurveMeasurement& measured() const { return c_; }
  /// Returns the simulated values as compared, one for each of y_compared; for `path`, the measured
  /// value minus the point's distance from the path. Fails if there are too few values, if x does
  /// not rise (except for `path`), or if the measurement extends beyond the simulation.
  Result<SimulatedValues> simulated(const Channels& trial) const;

  Result<Comparison> compare(const Channels& trial,
                             const ObjectiveSettings& settings) const override;
  Result<Comparison> compare_shifted(const Channels& trial,
                                     const ObjectiveSettings& settings,
                                     double shift) const override;
  Result<DelayRange> shift_range(const Channels& trial) const override;
  std::vector<std::filesystem::path> write(const Channels& trial,
                                           const MeasurementFiles& files) const override;
  void draw(const ShownExperiment& shown, report::StudyReport& page) const override;
  std::string table(const Channels& trial, const Comparison& comparison) const override;
  std::pair<std::string, nlohmann::ordered_json> answer(
      const Channels& trial, const Comparison& comparison) const override;

 private:
  /// Returns the simulated y, or another channel, at every measured sample.
  Result<SimulatedValues> samples(const Channels& trial, const std::string& y_name) const;
  /// Returns y at every measured sample, shifted by the delay that fits best.
  Result<SimulatedValues> delayed_samples(const Channels& trial) const;
  /// Returns x and another channel of equal length. Fails if one is missing.
  Result<std::pair<const Channel*, const Channel*>> channels_of(const Channels& trial,
                                                                const std::string& y_name) const;

  /// Draws, without x, over the natural abscissa, group by group.
  void draw_over_natural(const ShownExperiment& shown, report::MeasuredCurve& picture) const;
  /// Returns the abscissas of a trial for drawing, shifted by its fitted delay.
  std::vector<double> shown_abscissas(const Channels& trial) const;

  CurveMeasurement c_;
};

/// Throws InputError if there is no such channel or the measurement lacks these columns.
std::shared_ptr<const Curve> read_curve(const Node& table,
                                        const Measurement& measurement,
                                        const std::vector<KnownChannel>& channels);

}  // namespace latsch::correlation
