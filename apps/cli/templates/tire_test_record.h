// SPDX-License-Identifier: Apache-2.0
// The samples of a tire test in short form: ranges, levels, grip, slopes.
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
inline constexpr double kFreeRolling = 0.02;  // |kappa| of a wheel that is not driven
/// Slips up to which forces count as linear.
inline constexpr double kSmallAngle = 1.5 * kDegree, kSmallSlip = 0.02;
/// Least range of the slip angle that counts as a sweep, rad.
inline constexpr double kLeastSweep = 1.0 * kDegree;

/// Returns the value below which that share of the finite values lies; 0 if there is none.
double quantile(std::vector<double> values, double share);

/// Returns slope and value at 0 of the least-squares line through y over x.
std::pair<double, double> line_through(const std::vector<double>& x, const std::vector<double>& y);

/// A recording of a tire test; the measurement outlives it.
class TireTest {
 public:
  explicit TireTest(const correlation::Measurement& measured);

  std::optional<RecordedLag> side_lag, drive_lag;  // lags of Fy and Fx; none: not determined
  bool lags = false;
  bool cornering, driving, combined;

  /// The levels of the samples that a stage fits: those of driving, or only those of cornering if a
  /// test has both.
  magic_formula::ConditionLevels levels_of(bool of_driving) const;

  /// True if the recording has the channel with values above 0.
  bool has(const std::string& channel) const;
  /// Values of the channel in SI; empty if there is no such channel.
  const std::vector<double>& of(const std::string& channel) const;
  double median(const std::string& channel) const { return quantile(of(channel), 0.5); }
  double spread(const std::string& channel) const {
    return quantile(of(channel), 0.97) - quantile(of(channel), 0.03);
  }
  std::vector<double> magnitudes(const std::string& channel) const;
  /// Returns the grip: the largest values of a force over the load.
  double grip(const std::string& force) const { return quantile(shares(force), 0.98); }
  /// Slope of a force over the load at slips below `most`, with the other slip small.
  double steepness(const std::string& force, const std::string& slip, double most) const;

 private:
  std::vector<double> shares(const std::string& force) const;

  const correlation::Measurement& measured_;
};

}  // namespace latsch::cli
