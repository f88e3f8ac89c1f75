// SPDX-License-Identifier: Apache-2.0
// Estimates the error of a mesh compared with the converged tire: the same tire with the same
// boundary is computed on finer meshes, and the results are extrapolated. A fit compensates the
// error of its mesh by wrong moduli without showing it; this study quantifies the error.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch {

struct DiscretizationSettings {
  fe_tire::ElementKind element = fe_tire::ElementKind::solid_shell;
  double pressure = 0.0;    // Pa
  double deflection = 0.0;  // m; 0: inflation and unloaded modes only
  fe_tire::Ground ground;
  int modes = 20;
  std::vector<int> refinements = {
      1, 2, 3, 4};  // refinements for inflation and unloaded modes: cheap, one sector
  /// Extrapolates the loaded ring from few meshes (loaded_limits.h): from three with up to eight
  /// times the unknowns or, if true, from five with up to sixteen times, in about four times the
  /// time.
  bool loaded_thoroughly = false;
};

/// Values of one quantity, such as a force or a frequency, on all meshes.
struct DiscretizationRow {
  std::string name;            // "Fz at 25 mm", "radial n=2"
  std::string unit;            // SI
  std::vector<double> values;  // one for each refinement; only the first if `paired` is false
  double converged = 0.0;      // extrapolated
  double order = 0.0;          // observed order, 0 if the values show none
  /// Uncertainty of `converged`: a quarter of its distance from the finest mesh, or, if no order is
  /// observed, three times the largest change between the last meshes, because further changes may
  /// be larger (safety factors 1.25 and 3 of [Roache 1994, J. Fluids Eng. 116]). For a pressed
  /// tire, loaded_limits.h states how the uncertainty is computed.
  double uncertainty = 0.0;
  /// False for a mode that not every mesh has; it has no converged value.
  bool paired = true;
  /// True if the meshes are in the range where the error falls with an order; otherwise its
  /// decrease is not known.
  bool asymptotic() const { return paired && order > 0.0; }
  double error() const { return values.front() / converged - 1.0; }  // error of the unrefined mesh
  double error_uncertainty() const { return uncertainty / converged; }
};

struct DiscretizationStudy {
  std::vector<DiscretizationRow> unloaded;  // growth, then modes by label
  std::vector<DiscretizationRow> loaded;    // Fz, then modes by label
  /// loaded rows by the default method, if `loaded_thoroughly`
  std::vector<DiscretizationRow> loaded_by_few;
};

/// Measured values on one mesh, by name and in order: "growth" in m, "Fz ..." in N, all other names
/// are modes in Hz.
using MeshQuantities = std::vector<std::pair<std::string, double>>;

/// Limit of values on three meshes.
struct MeshLimit {
  double value = 0.0;
  double order = 0.0;        // observed order
  double uncertainty = 0.0;  // see DiscretizationRow::uncertainty
};
MeshLimit mesh_limit(const std::array<int, 3>& refinements, const std::array<double, 3>& values);

/// Returns rows of the quantities of the first mesh; `paired` are those that all meshes have. On
/// the ground a mode is a mixture of wave numbers, and the number in its name may differ between
/// meshes: a mode without a namesake is paired with the unnamed mode nearest in frequency, if one
/// is within 2.5 %. The rows have no limits yet.
std::vector<DiscretizationRow> paired_rows(std::vector<MeshQuantities> meshes);

/// Returns the rows with the limits of the last three meshes.
std::vector<DiscretizationRow> discretization_rows(const std::vector<int>& refinements,
                                                   std::vector<MeshQuantities> meshes);

/// Measured values of a study on the mesh of the tire alone.
struct MeshMeasured {
  MeshQuantities unloaded, loaded;
};
Result<MeshMeasured> measure_mesh(const fe_tire::TireDescription& tire,
                                  const DiscretizationSettings& settings);

/// Computes the study of the discretization; `progress` is called before each mesh is computed.
Result<DiscretizationStudy> study_discretization(
    const fe_tire::TireDescription& tire,
    const DiscretizationSettings& settings,
    const std::function<void(const std::string&)>& progress = {});

}  // namespace latsch
