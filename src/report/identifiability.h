// SPDX-License-Identifier: Apache-2.0
// The chapter of the report on identifiability: intervals, spectrum, correlations, profiles. Its
// data are plain structs; a part without data is left out.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace latsch::report {

/// Profile of a variable: the sum of squares S over fixed values of the variable, with the other
/// variables fitted at each value.
struct ProfileCurve {
  std::string variable;
  std::string unit = "1";
  bool logarithmic = false;
  std::vector<double> x;           // SI, ascending
  std::vector<std::string> shown;  // text for each x: "73 N/mm^2"
  /// Rise of the objective S above its minimum, over the threshold of the interval; the interval
  /// ends where the rise is 1.
  std::vector<double> rise;
  double found = 0.0;    // SI
  std::string verdict;   // "identifiable"
  std::string interval;  // "9.8 .. 10.3 N/mm^2"
};

struct LeftOutExperiment {
  std::string name;
  /// root mean square of the relative errors if the experiment is fitted, and if it is left out and
  /// predicted; NaN: unknown
  double fitted = 0.0, predicted = 0.0;
};

/// Uncertainty of the computed values of an experiment, as text.
struct BandRow {
  std::string experiment;
  bool fitted = true;
  std::string widest;  // largest half width, "+- 12 N (3.1 %), 20 mm"; empty: not known
  std::string inside;  // measured values inside the band, such as "19 of 20 measured values"
  std::vector<std::string> remarks;  // reasons why the band is wide or not known
};

struct Gain {
  std::string measurement;
  double shrinkage = 1.0;  // factor by which the volume of the confidence ellipsoid shrinks
  std::string helps;       // name of the variable whose standard deviation falls most
};

struct IdentifiabilityPage {
  std::vector<std::string> variables;
  std::vector<std::string> values;     // "10.02 N/mm^2"
  std::vector<std::string> intervals;  // "9.8 .. 10.3 N/mm^2"
  /// For each variable, what sets the ends of its interval: "data", "data and a bound", "bounds",
  /// "not known".
  std::vector<std::string> interval_sources = {};
  std::vector<std::string> shifts;  // interval of each variable, "9.8 .. 10.3 N/mm^2"
  int residuals = 0;                // number of measured values used
  /// Number of priors on variables; each counts as one more measured value.
  int priors = 0;
  /// Standard deviation along each principal direction, in units of the variables' ranges; the best
  /// determined direction comes first.
  std::vector<double> deviations;
  /// the principal directions in words, such as "matrix up, carcass down"
  std::vector<std::string> directions;
  Eigen::MatrixXd correlation;              // correlation matrix of the variables
  std::vector<ProfileCurve> profiles;       // may be empty
  std::vector<LeftOutExperiment> left_out;  // may be empty
  std::vector<BandRow> bands;               // one for each experiment; may be empty
  std::vector<Gain> gains;                  // most useful first; may be empty
  std::vector<std::string> remarks;         // warnings; may be empty
  /// measured values that the model misses, and the variable that would correct each; may be empty
  std::vector<std::string> missed;
};

/// Returns the chapter as HTML.
std::string identifiability_chapter(const IdentifiabilityPage& what);

}  // namespace latsch::report
