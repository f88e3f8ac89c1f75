// SPDX-License-Identifier: Apache-2.0
// How far a mesh is from the converged tire: the same tire and the same boundary on finer meshes,
// extrapolated.
//
// A fit absorbs the error of its mesh into the moduli without a word; this study puts a number on
// it.
#pragma once

#include <functional>
#include <map>
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
  /// The loaded ring: on the mesh and on one refined twice, extrapolated by what the unloaded
  /// meshes leave, which where errors cancel is little known (its +- then says so). Thoroughly, in
  /// some five times the time: also refined four times around and along, the three extrapolated,
  /// and what a refinement through the wall changes of the second, of second order. (Three meshes
  /// refined in all directions would have patches that end anywhere in their few sectors.)
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
  /// 116]).
  double uncertainty = 0.0;
  /// A mode that not every mesh has has no converged value.
  bool paired = true;
  /// Meshes in the range where the error falls by an order: else it is not known how far it falls.
  bool asymptotic() const { return paired && order > 0.0; }
  double error() const { return values.front() / converged - 1.0; }  // of the unrefined mesh
  double error_uncertainty() const { return uncertainty / converged; }
};

struct DiscretizationStudy {
  std::vector<DiscretizationRow> unloaded;  // growth, then modes by label
  std::vector<DiscretizationRow> loaded;    // Fz, then modes by label
};

/// What was measured on one mesh, by name and in order: "growth" in m, "Fz ..." in N, all others
/// modes in Hz.
using MeshQuantities = std::vector<std::pair<std::string, double>>;

/// What a mesh refined `refinement` times is still away from the limit, in parts of what it lies
/// beyond the unrefined one: by least squares over the modes whose order is seen; an order of 2
/// where there are none. The unloaded and the loaded tire have the same elements, and errors of
/// their modes the same sources.
struct Remainder {
  double part = 0.0;
  bool observed = false;
  /// What sectors and columns halved without the rows, and then the rows, change in modes of the
  /// unloaded tire, sums of magnitudes, relative, by label. Where the two cancel on the mesh
  /// refined twice, less is seen of them than may be left.
  std::map<std::string, double> apart = {};
  /// Of the mode a row is named by, on the ground or not; of any other quantity their mean square's
  /// root.
  double apart_of(const std::string& row) const;
};
Remainder remainder(const std::vector<int>& refinements,
                    const std::vector<DiscretizationRow>& rows,
                    int refinement);

/// Rows of the quantities of the first mesh; `paired` are those that all meshes have. On the
/// ground a mode is a mixture of wave numbers, and the one it is named by may differ between
/// meshes: a mode without a namesake is the nearest in frequency of those nothing is named by, if
/// one is within 2.5 %. At least three meshes, or the unrefined and another one with the remainder
/// of that; the limit is then between those of first and second order, and uncertain by the
/// farther one, or by that remainder of what changes apart where it is more.
std::vector<DiscretizationRow> discretization_rows(const std::vector<int>& refinements,
                                                   std::vector<MeshQuantities> meshes,
                                                   const Remainder& left = {});

/// `progress` is told each mesh before it is computed.
Result<DiscretizationStudy> study_discretization(
    const fe_tire::TireDescription& tire,
    const DiscretizationSettings& settings,
    const std::function<void(const std::string&)>& progress = {});

}  // namespace latsch
