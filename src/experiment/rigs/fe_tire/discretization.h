// SPDX-License-Identifier: Apache-2.0
// How far a mesh is from the converged tire: the same tire and the same boundary on finer meshes,
// extrapolated.
//
// A fit absorbs the error of its mesh into the moduli without a word; this study puts a number on
// it.
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
      1, 2, 3, 4};  // of inflation and unloaded modes: cheap, one sector
  /// The loaded ring, extrapolated from few meshes (loaded_limits.h): from three of up to eight
  /// times the unknowns or, thoroughly, from five of up to sixteen, in some four times the time.
  bool loaded_thoroughly = false;
};

/// One quantity on all meshes.
struct DiscretizationRow {
  std::string name;            // "Fz at 25 mm", "radial n=2"
  std::string unit;            // SI
  std::vector<double> values;  // one a refinement; of the first alone where `paired` is false
  double converged = 0.0;      // extrapolated
  double order = 0.0;          // observed, 0 where the values show none
  /// How far `converged` itself may be off: a quarter of what it lies beyond the finest mesh, and
  /// where no order is observed three times the largest change between the last meshes, for the
  /// changes to come may be larger (safety factors 1.25 and 3 of [Roache 1994, J. Fluids Eng.
  /// 116]). Of a pressed tire as loaded_limits.h says.
  double uncertainty = 0.0;
  /// A mode that not every mesh has has no converged value.
  bool paired = true;
  /// Meshes in the range where the error falls by an order: else it is not known how far it falls.
  bool asymptotic() const { return paired && order > 0.0; }
  double error() const { return values.front() / converged - 1.0; }  // of the unrefined mesh
  double error_uncertainty() const { return uncertainty / converged; }
};

struct DiscretizationStudy {
  std::vector<DiscretizationRow> unloaded;       // growth, then modes by label
  std::vector<DiscretizationRow> loaded;         // Fz, then modes by label
  std::vector<DiscretizationRow> loaded_by_few;  // where found thoroughly: as it is by default
};

/// What was measured on one mesh, by name and in order: "growth" in m, "Fz ..." in N, all others
/// modes in Hz.
using MeshQuantities = std::vector<std::pair<std::string, double>>;

/// The limit of values on three meshes.
struct MeshLimit {
  double value = 0.0;
  double order = 0.0;        // as in a row
  double uncertainty = 0.0;  // as in a row
};
MeshLimit mesh_limit(const std::array<int, 3>& refinements, const std::array<double, 3>& values);

/// Rows of the quantities of the first mesh; `paired` are those that all meshes have. On the
/// ground a mode is a mixture of wave numbers, and the one it is named by may differ between
/// meshes: a mode without a namesake is the nearest in frequency of those nothing is named by, if
/// one is within 2.5 %. They have no limits yet.
std::vector<DiscretizationRow> paired_rows(std::vector<MeshQuantities> meshes);

/// The same with the limits of the last three meshes.
std::vector<DiscretizationRow> discretization_rows(const std::vector<int>& refinements,
                                                   std::vector<MeshQuantities> meshes);

/// What a study measures, on the mesh of the tire alone.
struct MeshMeasured {
  MeshQuantities unloaded, loaded;
};
Result<MeshMeasured> measure_mesh(const fe_tire::TireDescription& tire,
                                  const DiscretizationSettings& settings);

/// `progress` is told each mesh before it is computed.
Result<DiscretizationStudy> study_discretization(
    const fe_tire::TireDescription& tire,
    const DiscretizationSettings& settings,
    const std::function<void(const std::string&)>& progress = {});

}  // namespace latsch
