// SPDX-License-Identifier: Apache-2.0
// Writes the result of a study as one HTML page that opens without a network. StudyReport is plain
// data in SI units, filled in by the caller; the chapter of an empty part is left out. html() uses
// no studies, journals or files.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/mesh/mesh.h"
#include "report/identifiability.h"
#include "report/line_plot.h"
#include "report/scene.h"

namespace latsch::report {

/// A design variable. Values are in SI; `unit` is the unit in which they are shown ("N/mm^2").
struct Variable {
  std::string name;
  std::string unit = "1";
  double initial = 0.0, found = 0.0, lower = 0.0, upper = 0.0;
  bool logarithmic = false;
  /// The fitted value with as many digits as its uncertainty supports: "73"; empty if no
  /// uncertainty is known.
  std::string known = {};
};

/// One experiment's contribution to the target.
struct ExperimentRow {
  std::string name;
  std::string kind;        // for example "load_deflection", "modes", "curve"
  std::string conditions;  // conditions of the test in words, such as "2.6 bar, friction 0.8"
  /// Compared quantity, such as "force", "root of force", "frequency", with the exponent if it is
  /// not 1.
  std::string compared;
  bool fitted = true;  // false: the experiment is only predicted
  double weight = 1.0;
  int values = 0;      // number of measured values compared
  double value = 0.0;  // T_e
  /// mean of |dF| or |df|, the relative differences of forces or frequencies
  double mean_error = 0.0;
  double largest_error = 0.0;  // largest |dF| or |df|
  /// The experiment's contribution to the target, T_e, as an error in its own measure (1 = 100 %):
  /// the RMS if T_e is a mean square. It is the number that every page shows.
  double error = 0.0;
  std::optional<double> initial_error = {};  // `error` at the initial values of the variables
  std::string measure = "mean";              // name of the measure: "mean", "RMS"
  /// value that corresponds to an error of 100 %, if it is the same for all values: "4000 N"
  std::string whole = "";
  /// The least error that an earlier stage of the fit reached, and the name of that stage; empty if
  /// there is none.
  std::string own_stage = "";
  double own_stage_error = 0.0;
  /// True if the final error is more than a twentieth larger than the one after that stage.
  bool is_spoiled = false;
};

/// Ends of the 95 % band of computed values, which the uncertainty of the variables causes. The
/// vectors are empty if the band is not known; an element is NaN if it is not known for that value.
struct Band {
  std::vector<double> lower, upper;
  /// Number of measured values inside band and noise, such as "19 of 20 measured values"; empty:
  /// not known.
  std::string inside = {};
};

/// Measured and simulated forces of one experiment of kind load_deflection.
struct ComparedForces {
  std::string experiment;
  std::string conditions;  // for example "2.6 bar"
  bool fitted = true;
  /// true: the abscissa is the loaded radius; false: the deflection
  bool over_loaded_radius = false;
  std::vector<double> abscissa;   // m
  std::vector<double> measured;   // N
  std::vector<double> simulated;  // N, at the fitted values of the variables
  std::vector<double> initial;    // N, at the initial values; may be empty
  /// true if these are from the best trial of a design of experiments: nothing was fitted
  bool of_design = false;
  Band band = {};  // N, uncertainty band of `simulated`
};

/// A measured curve y(x) and its simulated counterpart. Values are in SI; the units are those in
/// which they are shown. Without x, samples are counted from 1.
struct MeasuredCurve {
  std::string experiment;
  std::string conditions;  // conditions of the test in words, such as "over response/time"
  bool fitted = true;
  /// names of the axes, such as "time"; if x_name is empty, the abscissa is the sample number
  std::string x_name, y_name;
  std::string x_unit = "1", y_unit = "1";
  std::vector<double> x_measured, y_measured;
  /// (measured - simulated) / scale, one for each sample
  std::vector<double> errors;
  /// all samples that the model computed, at the fitted values
  std::vector<double> x_simulated, y_simulated;
  std::vector<double> x_initial, y_initial;  // at the initial values; may be empty
  /// True if these are from the best trial of a design of experiments: nothing was fitted.
  bool of_design = false;
  std::vector<double> x_band;  // abscissas at which the band is known
  Band band = {};
  /// Samples that belong together, such as those of one load, and are drawn as one line. No pieces:
  /// all samples belong together. With pieces, measured, simulated and initial samples have equal
  /// length and order.
  struct Piece {
    std::string name;       // for example "Fz 1050 N, gamma 2 deg"; may be empty
    std::string level;      // "Fz 1050 N": pieces of the same level share a color
    std::size_t from, end;  // samples from `from` up to but without `end`
  };
  std::vector<Piece> pieces = {};
};

/// A single measured value and its simulated counterpart, in SI; `unit` is the unit in which both
/// are shown.
struct MeasuredValue {
  std::string name;      // name of the experiment and, if it has several values, of the value
  std::string compared;  // name of the compared channel, "A/dz_by_Fz"; may be empty
  std::string unit = "1";
  bool fitted = true;
  double weight = 1.0;
  double measured = 0.0, found = 0.0;
  std::optional<double> initial;       // simulated at the initial values of the variables
  std::optional<double> lower, upper;  // ends of the 95 % band of `found`
};

/// A measured mode and the simulated mode that is paired with it; frequencies in Hz.
struct ComparedModes {
  std::string label;  // "radial n=2"
  double measured = 0.0, simulated = 0.0;
  std::optional<double> initial;   // simulated at the initial values
  std::optional<double> likeness;  // modal assurance criterion (MAC), if shapes were measured
};

struct UnmatchedMode {
  std::string label;
  double frequency = 0.0;  // Hz
};

struct ModalComparison {
  std::string experiment;
  std::string conditions;
  bool fitted = true;
  std::vector<ComparedModes> pairs;    // in the order of the measured modes
  std::vector<UnmatchedMode> missing;  // measured modes without a simulated partner
  std::vector<UnmatchedMode> extra;    // simulated modes without a measured partner
  Band band = {};  // Hz, uncertainty band of the simulated frequencies of `pairs`
};

/// The target of every trial in the order in which the optimizer requested them; NaN: a failed
/// trial.
struct Convergence {
  std::vector<double> target;
};

/// The target as a function of two variables, with the others held constant.
struct Surface {
  std::string x_name, y_name;
  std::string x_unit = "1", y_unit = "1";
  bool x_logarithmic = false, y_logarithmic = false;
  std::vector<double> x, y;  // SI, grid levels in ascending order
  Eigen::MatrixXd target;    // rows along x, columns along y; NaN: a failed trial
  /// The variables held constant and their values, "belt = 22.3 N/mm^2"; may be empty.
  std::string held;
  std::optional<Eigen::Vector2d> initial, found;  // SI, marked points of the study
};

/// A local minimum among the points of a design of experiments.
struct BasinRow {
  double target = 0.0;
  int points = 0;                   // number of points from which descent leads to this minimum
  std::vector<std::string> values;  // the variables' values as text, such as "22.3 N/mm^2"
};

struct Basins {
  std::string design;  // the design in words, such as "full factorial grid, 5 x 5, 25 points"
  std::vector<std::string> variables;
  int count = 0;               // number of local minima
  std::vector<BasinRow> rows;  // the lowest minima in ascending order
  std::string doubt;           // reason why the minima may be unreliable; may be empty
};

/// Morris' elementary effects of one variable on the target, over its whole range.
struct EffectRow {
  std::string variable;
  double mu_star = 0.0, mu = 0.0, sigma = 0.0;
  int effects = 0;  // number of effects evaluated
};

/// Share of the variance that a variable causes, with its 95 % interval; 0 .. 1.
struct ShareOfVariance {
  std::string variable;
  double first = 0.0, first_lower = 0.0, first_upper = 0.0;
  double total = 0.0, total_lower = 0.0, total_upper = 0.0;
};

/// Shares of one response over the points of a design of experiments.
struct SharesOfResponse {
  std::string response;    // "target", "value of NAME", "target of NAME"
  double explained = 0.0;  // share of the variance that the points explain; may be negative
  bool is_trusted = false;
  std::vector<ShareOfVariance> of;  // empty: the response does not vary
};

/// A minimum that a search for several ones has found.
struct FoundMinimum {
  double target = 0.0;
  int times_found = 0;                  // points that belong to it
  bool has_ended = true;                // false: its search was stopped early
  std::vector<std::string> place = {};  // values with units, in the order of RunFacts::variables
};

struct RunFacts {
  std::string method;  // method in words, such as "GSS", "full factorial 5 x 5"
  std::string ended;   // reason why the search ended (Run::ending), such as "at a minimum: ..."
  int trials = 0, failures = 0, workers = 1;
  double wall_time = 0.0;  // s
  double cpu_time = 0.0;   // s, sum over all trials
  /// Reasons of failed trials, and how often each occurred.
  std::vector<std::pair<std::string, int>> failure_reasons;
  /// Part of cpu_time, s, that outside programs used.
  double program_time = 0.0;
  std::vector<std::string> tests = {};  // the tests of `ended` with their numbers, in words
  /// Minima of a search for several ones, lowest first, and the names of its variables.
  std::vector<FoundMinimum> minima = {};
  std::vector<std::string> variables = {};
};

/// Difference between the result on the used mesh and the converged result.
struct DiscretizationError {
  std::string quantity;  // for example "Fz at 25 mm", "radial n=2"
  double error = 0.0;    // relative error of the used mesh
};

/// A cord layer of the mesh; all layers with one name form one ply.
struct Layer {
  std::string name;
  double angle = 0.0;  // rad, angle between cord and circumference at the crown
};

/// The finite-element tire at the fitted values of the variables, for pictures.
struct TirePictures {
  fe_tire::Mesh mesh;
  std::vector<Layer> layers;  // indexed like RebarPlacement::layer; may be empty
  std::optional<fe_tire::Inflated> inflated;
  struct Loaded {
    Eigen::Matrix3Xd u;  // m, displacements of all nodes, in the frame of each node's sector
    fe_tire::Standing standing;
  };
  std::optional<Loaded> loaded;
  bool modes_loaded = false;         // true if the modes are those of the loaded tire
  std::vector<fe_tire::Mode> modes;  // at most about 12 are shown
  /// Names of the modes if their labels are not unique; empty: the labels are used.
  std::vector<std::string> mode_names;
  std::string spin;  // for modes of a rotating tire, "spinning at 90 rad/s"; else empty
  std::string mode_name(std::size_t k) const {
    return mode_names.empty() ? modes[k].label() : mode_names[k];
  }
};

/// One limit of a suite of checks, with all its numbers as text.
struct CheckRow {
  std::string check, what, value, limit, source;
  std::string reason;  // reason why the value could not be computed; else empty
  bool accepted = false;
};

/// The data to which a model was fitted, so that a page can mark curves as assumed or extrapolated.
struct FittedBy {
  std::vector<std::string> paths;  // paths of the parameters that the fit varied
  /// Returns the values (SI) that a condition, for example "alpha", has in the tests of the fitted
  /// experiments.
  std::function<std::vector<double>(const std::string&)> measured_at;
};

struct StudyReport {
  std::string title;
  std::string study_file, model_file;  // file names for the shown command line; may be empty
  std::string tire;                    // name of the tire, such as "Tire B, 225/50R16"
  std::string date;                    // date of the report, such as "2025-03-01"; may be empty
  std::string version;                 // version of the program; may be empty
  double target = 0.0;                 // target at the fitted values of the variables
  std::optional<double> initial_target;
  std::vector<LinePlot> slip_plots;  // force over slip of the fitted tire
  /// Target in words, such as "mean square of the errors, its root 2.45 %"; may be empty.
  std::string target_in_words;
  /// formula of the target in one line, "1/2 (mean |df| + mean |dF|)"; may be empty
  std::string target_definition;
  std::vector<std::string> remarks;  // assumptions and warnings, in sentences

  std::vector<CheckRow> checks;  // rows of a suite of checks, which is reported instead of a target
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
  std::vector<SharesOfResponse> shares;
  std::optional<IdentifiabilityPage> identifiability;
  std::optional<FittedBy> fitted_by;
  std::optional<RunFacts> run;
  /// true if the values are those of the best trial of a design of experiments, not of a fit
  bool is_of_design = false;
  std::vector<DiscretizationError> discretization;
  std::optional<TirePictures> pictures;
  std::optional<Scene> scene;  // body to draw for models other than a finite-element tire
};

struct LivePage;

/// Returns the page in UTF-8. The page needs no other file; names may contain any characters. With
/// `live` (live_page.h) the page opens with interactive views and prints as it does without them.
std::string html(const StudyReport& report, const LivePage* live = nullptr);

}  // namespace latsch::report
