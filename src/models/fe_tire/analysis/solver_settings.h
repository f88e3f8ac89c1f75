// SPDX-License-Identifier: Apache-2.0
// Settings for solving the tire's equations, and counters of the work done.
#pragma once

#include <optional>

#include "models/fe_tire/contact/tread_surface.h"
#include "models/fe_tire/element/hex8.h"

namespace latsch::fe_tire {

struct SolverSettings {
  ElementKind element = ElementKind::solid_shell;
  /// Surface of the tread on which contact is computed. If not set: facets for the comparison
  /// element, as in the programs with which it is compared, and smooth for the default element.
  std::optional<TreadShape> tread = {};
  TreadShape tread_shape() const {
    if (tread) return *tread;
    return element == ElementKind::solid_shell ? TreadShape::smooth : TreadShape::facets;
  }
  double tolerance = 1e-5;  // residual norm relative to the force norm of the pressure
  int max_iterations = 40;  // largest number of Newton iterations per load step
  /// Largest number of shifts of an indefinite tangent along its diagonal until the residual has
  /// halved. Each shift costs a factorization. If the tangent remains indefinite, the step is too
  /// long.
  int max_shifts = 6;
  /// Relative tolerance of the residual of the eigenvalue problem, which is solved for the inverse;
  /// for loaded modes it is three times as large. The relative error of a frequency is its square
  /// divided by the relative gap to the next frequency; the error of a shape is the tolerance
  /// divided by this gap.
  double mode_tolerance = 1e-5;
};

/// Counters of the work done in a trial, for benchmarks and for the report.
struct SolverCounts {
  int analyses = 0;  // symbolic analyses of the ring's matrices
  int assemblies = 0, factorizations = 0, cg_iterations = 0, solves = 0, shifts = 0;
};

}  // namespace latsch::fe_tire
