// SPDX-License-Identifier: Apache-2.0
// The result of a study as one HTML page that opens without a network.
//
// StudyReport is plain data in SI units, filled in by the caller. An empty part leaves its chapter
// out. html() does not use studies, journals or files.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/element/mesh.h"
#include "report/identifiability.h"
#include "report/line_plot.h"
#include "report/scene.h"

namespace latsch::report {

/// Design variable. Values are in SI; `unit` is what a person reads ("N/mm^2").
struct Variable {
  std::string name;
  std::string unit = "1";
  double initial = 0.0, found = 0.0, lower = 0.0, upper = 0.0;
  bool logarithmic = false;
  std::string known = {};  // number found, with the digits that its uncertainty supports: "73";
                           // empty if no uncertainty is known
};

/// One experiment's part of the target.
struct ExperimentRow {
  std::string name;
  std::string kind;        // for example "load_deflection", "modes", "curve"
  std::string conditions;  // for example "2.6 bar, friction 0.8"
  std::string compared;  // for example "force", "root of force", "frequency", with the exponent if
                         // it is not 1
  bool fitted = true;    // false: predicted only
  double weight = 1.0;
  int values = 0;              // number of measured values compared
  double value = 0.0;          // T_e
  double mean_error = 0.0;     // mean |dF| or mean |df|
  double largest_error = 0.0;  // largest |dF| or |df|
  /// T_e as an error in its own measure, 1 = 100 %: the RMS if T_e is a mean square. It is the
  /// number that every page shows.
  double error = 0.0;
  std::optional<double> initial_error = {};  // likewise at the initial values of the variables
  std::string measure = "mean";              // name of the measure: "RMS"
  std::string whole = "";  // size of 100 % if it is equal for all values: "4000 N"
  /// Least error that an earlier stage of the fit left, and its name; empty if no stage counts.
  std::string own_stage = "";
  double own_stage_error = 0.0;
  bool is_spoiled = false;  // true if the error is more than a twentieth worse than after that
                            // stage
};

/// Limits of the 95 % band of a computed value, due to the uncertainty of the variables; empty: not
/// known, NaN: not known for that value.
struct Band {
  std::vector<double> lower, upper;
  std::string inside = {};  // for example "19 of 20 measured values": inside band and noise; empty:
                            // not known
};

/// Measured and simulated forces of one load-deflection experiment.
struct ComparedForces {
  std::string experiment;
  std::string conditions;  // for example "2.6 bar"
  bool fitted = true;
  bool over_loaded_radius = false;  // abscissa: loaded radius, otherwise deflection
  std::vector<double> abscissa;     // m
  std::vector<double> measured;     // N
  std::vector<double> simulated;    // N, at the found point
  std::vector<double> initial;      // N, at the initial point; may be empty
  bool of_design = false;           // true for the best trial of a design: nothing was fitted
  Band band = {};                   // N, band of `simulated`
};

/// Measured curve y(x) and its simulated counterpart. Values are in SI; the units are those a
/// person reads. Without x, samples are counted from 1.
struct MeasuredCurve {
  std::string experiment;
  std::string conditions;  // for example "over response/time"
  bool fitted = true;
  std::string x_name, y_name;  // for example "time"; x_name empty: sample by sample
  std::string x_unit = "1", y_unit = "1";
  std::vector<double> x_measured, y_measured;
  std::vector<double> errors;                    // (measured - simulated) / scale, one for each
                                                 // sample
  std::vector<double> x_simulated, y_simulated;  // every sample of the program, at the found point
  std::vector<double> x_initial, y_initial;      // at the initial point; may be empty
  bool of_design = false;                        // true for the best trial of a design: nothing was
                                                 // fitted
  std::vector<double> x_band;                    // abscissas at which the band is known
  Band band = {};
  /// Samples that belong together, such as those of one load, drawn as one line. Empty: all samples
  /// belong together. With pieces, measured, simulated and initial samples have equal length and
  /// order.
  struct Piece {
    std::string name;       // for example "Fz 1050 N, gamma 2 deg"; may be empty
    std::string level;      // "Fz 1050 N": pieces with the same one share a color
    std::size_t from, end;  // range of the samples
  };
  std::vector<Piece> pieces = {};
};

/// Single measured value, the target, and its simulated value, in SI; `unit` is what a person
/// reads.
struct MeasuredValue {
  std::string name;      // name of the experiment, and of the value if it has several
  std::string compared;  // compared channel, "A/dz_by_Fz"; may be empty
  std::string unit = "1";
  bool fitted = true;
  double weight = 1.0;
  double measured = 0.0, found = 0.0;
  std::optional<double> initial;       // at the initial values of the variables
  std::optional<double> lower, upper;  // limits of the 95 % band of `found`
};

/// Measured mode and its simulated partner, Hz.
struct ComparedModes {
  std::string label;  // "radial n=2"
  double measured = 0.0, simulated = 0.0;
  std::optional<double> initial;   // simulated at the initial values
  std::optional<double> likeness;  // MAC, if shapes were measured
};

struct UnmatchedMode {
  std::string label;
  double frequency = 0.0;  // Hz
};

struct ModalComparison {
  std::string experiment;
  std::string conditions;
  bool fitted = true;
  std::vector<ComparedModes> pairs;    // in the order of the measurement
  std::vector<UnmatchedMode> missing;  // measured, not simulated
  std::vector<UnmatchedMode> extra;    // simulated, not measured
  Band band = {};                      // Hz, band of the simulated frequencies of `pairs`
};

/// Target of every trial in the order of the optimizer; NaN: a failed trial.
struct Convergence {
  std::vector<double> target;
};

/// The target over two variables, with the others held.
struct Surface {
  std::string x_name, y_name;
  std::string x_unit = "1", y_unit = "1";
  bool x_logarithmic = false, y_logarithmic = false;
  std::vector<double> x, y;                       // SI, ascending levels
  Eigen::MatrixXd target;                         // (x, y); NaN: a failed trial
  std::string held;                               // held variables, "belt = 22.3 N/mm^2"; may be
                                                  // empty
  std::optional<Eigen::Vector2d> initial, found;  // SI; points of the study to mark
};

/// Minimum among the points of a design of experiments.
struct BasinRow {
  double target = 0.0;
  int points = 0;                   // points of the design that lead there
  std::vector<std::string> values;  // one text for each variable, "22.3 N/mm^2"
};

struct Basins {
  std::string design;  // for example "full factorial grid, 5 x 5, 25 points"
  std::vector<std::string> variables;
  int count = 0;               // number of minima
  std::vector<BasinRow> rows;  // lowest first; the first few
  std::string doubt;           // reason not to trust the minima; may be empty
};

/// Morris' elementary effects of one variable on the target, over its whole range.
struct EffectRow {
  std::string variable;
  double mu_star = 0.0, mu = 0.0, sigma = 0.0;
  int effects = 0;  // number of effects evaluated
};

struct RunFacts {
  std::string method;  // for example "GSS", "full factorial 5 x 5"
  std::string ended;   // text of Run::ending, for example "at a minimum: ..."
  int trials = 0, failures = 0, workers = 1;
  double wall_time = 0.0;                                    // s
  double cpu_time = 0.0;                                     // s over all trials
  std::vector<std::pair<std::string, int>> failure_reasons;  // sentence and its number of
                                                             // occurrences
  double program_time = 0.0;                                 // s, part of cpu_time in outside
                                                             // programs
};

/// Distance of the mesh's result from the converged tire.
struct DiscretizationError {
  std::string quantity;  // for example "Fz at 25 mm", "radial n=2"
  double error = 0.0;    // relative error of the mesh used
};

/// Cord layer of the mesh; layers of one name are one ply.
struct Layer {
  std::string name;
  double angle = 0.0;  // rad, from the circumference, at the ply's crossing of the crown
};

/// Data of the pictures: the tire at the found point.
struct TirePictures {
  fe_tire::Mesh mesh;
  std::vector<Layer> layers;  // in the numbering of RebarPlacement::layer; may be empty
  std::optional<fe_tire::Inflated> inflated;
  struct Loaded {
    Eigen::Matrix3Xd u;  // m, displacements of all nodes, sector frames
    fe_tire::Standing standing;
  };
  std::optional<Loaded> loaded;
  bool modes_loaded = false;         // true if the modes belong to the loaded state
  std::vector<fe_tire::Mode> modes;  // at most about 12 are shown
  /// Names of these modes if their labels do not tell them apart; none: their labels.
  std::vector<std::string> mode_names;
  std::string spin;  // in words if the modes belong to a tire that spins: "spinning at 90 rad/s"
  std::string mode_name(std::size_t k) const {
    return mode_names.empty() ? modes[k].label() : mode_names[k];
  }
};

/// One limit of a suite of checks, as text.
struct CheckRow {
  std::string check, what, value, limit, source;
  std::string reason;  // reason why there is no value
  bool accepted = false;
};

/// The data a model was fitted to, so that a page marks assumed and extrapolated curves.
struct FittedBy {
  std::vector<std::string> paths;  // paths of the numbers that were varied
  /// The values (SI) of a condition, "alpha", in the tests of the fitted experiments.
  std::function<std::vector<double>(const std::string&)> measured_at;
};

struct StudyReport {
  std::string title;
  std::string study_file, model_file;  // file names for a command line; may be empty
  std::string tire;                    // for example "Tire B, 225/50R16"
  std::string date;                    // for example "2025-03-01"; may be empty
  std::string version;                 // program version; may be empty
  double target = 0.0;                 // target at the found point
  std::optional<double> initial_target;
  std::vector<LinePlot> slip_plots;  // force over slip of the found tire
  std::string target_in_words;       // for example "mean square of the errors, its root 2.45 %";
                                     // may be empty
  std::string target_definition;     // one line, "1/2 (mean |df| + mean |dF|)"; may be empty
  std::vector<std::string> remarks;  // assumptions and warnings

  std::vector<CheckRow> checks;  // checks of a validation, in place of a target
  std::vector<Variable> variables;
  std::vector<ExperimentRow> experiments;
  std::vector<ComparedForces> forces;
  std::vector<MeasuredCurve> curves;
  std::vector<MeasuredValue> values;
  std::vector<ModalComparison> modes;
  std::optional<Convergence> convergence;
  std::vector<Surface> surfaces;
  std::optional<Basins> basins;
  std::vector<EffectRow> effects;
  std::optional<IdentifiabilityPage> identifiability;
  std::optional<FittedBy> fitted_by;
  std::optional<RunFacts> run;
  bool is_of_design = false;  // true if the found point is the best trial of a design, no fit
  std::vector<DiscretizationError> discretization;
  std::optional<TirePictures> pictures;
  std::optional<Scene> scene;  // body of a model other than a finite-element tire
};

struct LivePage;

/// Returns the page in UTF-8. The page needs no other file; names may hold any characters. With
/// `live` (live_page.h) it opens as interactive views, and prints as it is without them.
std::string html(const StudyReport& report, const LivePage* live = nullptr);

}  // namespace latsch::report
