// SPDX-License-Identifier: Apache-2.0
// The samples of a tire test and what varies in them, at a glance: ranges, levels, grip, slopes.
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
/// Slips up to which forces are straight lines.
inline constexpr double kSmallAngle = 1.5 * kDegree, kSmallSlip = 0.02;

/// The value below which a share of the finite values lies; 0 if there is none.
double quantile(std::vector<double> values, double share);

/// Slope and value at 0 of the line through y over x, least squares.
std::pair<double, double> line_through(const std::vector<double>& x, const std::vector<double>& y);

/// A recording of a tire test; the measurement outlives it.
class TireTest {
 public:
  explicit TireTest(const correlation::Measurement& measured);

  std::optional<RecordedLag> side_lag, drive_lag;  // lags of Fy and Fx; none: cannot be told
  bool lags = false;
  bool cornering, driving, combined;

  /// The levels of the samples that a stage fits: those of driving, or those of cornering alone
  /// where a test has both.
  magic_formula::ConditionLevels levels_of(bool of_driving) const;

  /// True if a channel is there and more than 0.
  bool has(const std::string& channel) const;
  /// SI; empty if there is no such channel.
  const std::vector<double>& of(const std::string& channel) const;
  double median(const std::string& channel) const { return quantile(of(channel), 0.5); }
  double spread(const std::string& channel) const {
    return quantile(of(channel), 0.97) - quantile(of(channel), 0.03);
  }
  std::vector<double> magnitudes(const std::string& channel) const;
  /// Grip: what a force reaches of the load.
  double grip(const std::string& force) const { return quantile(shares(force), 0.98); }
  /// Slope of a force over the load at slips below `most`, where the other slip is small.
  double steepness(const std::string& force, const std::string& slip, double most) const;

 private:
  std::vector<double> shares(const std::string& force) const;

  const correlation::Measurement& measured_;
};

}  // namespace latsch::cli
