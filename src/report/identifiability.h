// SPDX-License-Identifier: Apache-2.0
// The chapter of the report on what the data determine: intervals, spectrum, correlations,
// profiles. Plain data like the rest of the report; a part that is empty is left out.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace latsch::report {

/// S over one variable, the others fitted anew.
struct ProfileCurve {
  std::string variable;
  std::string unit = "1";
  bool logarithmic = false;
  std::vector<double> x;           // SI, ascending
  std::vector<std::string> shown;  // x as a person reads them, one each: "73 N/mm^2"
  std::vector<double> rise;        // S - least over the threshold of the interval: 1 ends it
  double found = 0.0;              // SI
  std::string verdict;             // "identifiable"
  std::string interval;            // "9.8 .. 10.3 N/mm^2"
};

struct LeftOutExperiment {
  std::string name;
  double fitted = 0.0, predicted = 0.0;  // root mean square of the relative errors; NaN: unknown
};

/// How uncertain the computed values of an experiment are.
struct BandRow {
  std::string experiment;
  bool fitted = true;
  std::string widest;                // "+- 12 N (3.1 %), 20 mm"; empty: not known
  std::string inside;                // "19 of 20 measured values"
  std::vector<std::string> remarks;  // why it is so wide, or not known
};

struct Gain {
  std::string measurement;
  double shrinkage = 1.0;  // of the volume of the confidence ellipsoid
  std::string helps;       // the variable whose deviation falls most
};

struct Identifiability {
  std::vector<std::string> variables;
  std::vector<std::string> values;          // "10.02 N/mm^2"
  std::vector<std::string> intervals;       // "9.8 .. 10.3 N/mm^2"
  std::vector<std::string> shifts;          // "+0.1 N/mm^2", of a refined model; may be empty
  int residuals = 0;                        // measured values used
  int priors = 0;                           // of variables, which count as one more each
  std::vector<double> deviations;           // a direction each, in ranges, best determined first
  std::vector<std::string> directions;      // "matrix up, carcass down"
  Eigen::MatrixXd correlation;              // of the variables
  std::vector<ProfileCurve> profiles;       // may be empty
  std::vector<LeftOutExperiment> left_out;  // may be empty
  std::vector<BandRow> bands;               // an experiment each; may be empty
  std::vector<Gain> gains;                  // most useful first; may be empty
  std::vector<std::string> remarks;         // what to mind; may be empty
  std::vector<std::string> missed;          // values, what would mend each; may be empty
};

/// The chapter's body.
std::string identifiability_chapter(const Identifiability& what);

}  // namespace latsch::report
