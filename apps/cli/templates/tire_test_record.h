// SPDX-License-Identifier: Apache-2.0
// Summary of the samples of a tire test: ranges and levels of the conditions, largest forces,
// slopes at small slip.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/templates/recorded_lag.h"
#include "correlation/laboratory/measurement.h"
#include "models/magic_formula/coefficient_conditions.h"

namespace latsch::cli {

inline constexpr double kDegree = std::numbers::pi / 180.0;
/// largest |kappa| of a wheel that counts as freely rolling
inline constexpr double kFreeRolling = 0.02;
/// Largest slip angle (rad) and longitudinal slip at which forces count as linear.
inline constexpr double kSmallAngle = 1.5 * kDegree, kSmallSlip = 0.02;
/// Least range of the slip angle, rad, that counts as a sweep.
inline constexpr double kLeastSweep = 1.0 * kDegree;

/// Fewest samples with both slips that determine how one slip takes force from the other.
inline constexpr long kFewestCombined = 10;

/// Returns the value below which the share `share` of the finite values lies; 0 if there is none.
double quantile(std::vector<double> values, double share);

/// Returns slope and intercept of the least-squares line through y over x.
std::pair<double, double> line_through(const std::vector<double>& x, const std::vector<double>& y);

/// A recording of a tire test. It refers to the measurement, which must exist as long as the
/// recording.
class TireTest {
 public:
  explicit TireTest(const correlation::Measurement& measured);

  /// lags of Fy and Fx behind the slip; none: not determined
  std::optional<RecordedLag> side_lag, drive_lag;
  bool lags = false;
  /// `combined`: samples have both slips at once, so that combined coefficients are determined
  bool cornering, driving, combined;

  /// Returns the levels of load, camber, pressure and speed among the samples that a stage fits:
  /// those with longitudinal slip if `of_driving`, else those of cornering alone if the test has
  /// both.
  magic_formula::ConditionLevels levels_of(bool of_driving) const;

  /// True if the recording has the channel and any of its values exceeds 0.
  bool has(const std::string& channel) const;
  /// Values of the channel in SI; empty if there is no such channel.
  const std::vector<double>& of(const std::string& channel) const;
  double median(const std::string& channel) const { return quantile(of(channel), 0.5); }
  double spread(const std::string& channel) const {
    return quantile(of(channel), 0.97) - quantile(of(channel), 0.03);
  }
  std::vector<double> magnitudes(const std::string& channel) const;
  /// Returns the grip: the 98 % quantile of a force divided by the load.
  double grip(const std::string& force) const { return quantile(shares(force), 0.98); }
  /// Returns the slope of force over load with respect to the slip, at slips below `most` and with
  /// small values of the other slip.
  double steepness(const std::string& force, const std::string& slip, double most) const;

 private:
  bool has_combined_slips() const;
  std::vector<double> shares(const std::string& force) const;

  const correlation::Measurement& measured_;
};

}  // namespace latsch::cli
