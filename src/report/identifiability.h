// SPDX-License-Identifier: Apache-2.0
// The chapter of the report on identifiability: intervals, spectrum, correlations, profiles. The
// data are plain structs; an empty part is left out.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace latsch::report {

/// S over one variable, with the others fitted anew.
struct ProfileCurve {
  std::string variable;
  std::string unit = "1";
  bool logarithmic = false;
  std::vector<double> x;           // SI, ascending
  std::vector<std::string> shown;  // x as text for a person, one for each: "73 N/mm^2"
  /// S minus its minimum, over the threshold of the interval: 1 is its end
  std::vector<double> rise;
  double found = 0.0;    // SI
  std::string verdict;   // "identifiable"
  std::string interval;  // "9.8 .. 10.3 N/mm^2"
};

struct LeftOutExperiment {
  std::string name;
  double fitted = 0.0, predicted = 0.0;  // root mean square of the relative errors; NaN: unknown
};

/// Uncertainty of the computed values of an experiment.
struct BandRow {
  std::string experiment;
  bool fitted = true;
  std::string widest;                // widest band, "+- 12 N (3.1 %), 20 mm"; empty: not known
  std::string inside;                // for example "19 of 20 measured values"
  std::vector<std::string> remarks;  // why the band is wide or not known
};

struct Gain {
  std::string measurement;
  double shrinkage = 1.0;  // factor of the volume of the confidence ellipsoid
  std::string helps;       // variable whose deviation falls most
};

struct IdentifiabilityPage {
  std::vector<std::string> variables;
  std::vector<std::string> values;     // "10.02 N/mm^2"
  std::vector<std::string> intervals;  // "9.8 .. 10.3 N/mm^2"
  /// "data", "data and a bound", "bounds", "not known"
  std::vector<std::string> interval_sources = {};
  std::vector<std::string> shifts;  // interval of each variable, "9.8 .. 10.3 N/mm^2"
  int residuals = 0;                // number of measured values used
  /// number of priors of variables, each counted as one more value
  int priors = 0;
  /// one for each direction, in ranges, best determined first
  std::vector<double> deviations;
  std::vector<std::string> directions;      // for example "matrix up, carcass down"
  Eigen::MatrixXd correlation;              // correlation of the variables
  std::vector<ProfileCurve> profiles;       // may be empty
  std::vector<LeftOutExperiment> left_out;  // may be empty
  std::vector<BandRow> bands;               // one for each experiment; may be empty
  std::vector<Gain> gains;                  // most useful first; may be empty
  std::vector<std::string> remarks;         // warnings; may be empty
  std::vector<std::string> missed;          // missed values and what would mend each; may be empty
};

/// Returns the chapter's body.
std::string identifiability_chapter(const IdentifiabilityPage& what);

}  // namespace latsch::report
