// SPDX-License-Identifier: Apache-2.0
// Settings for solving a tire's equations, and counts of the work done.
#pragma once

#include <optional>

#include "models/fe_tire/contact/tread_surface.h"
#include "models/fe_tire/element/hex8.h"

namespace latsch::fe_tire {

struct SolverSettings {
  ElementKind element = ElementKind::solid_shell;
  /// Tread surface that the ground feels. None: facets for the comparison element, as in the
  /// programs it is compared with, smooth for the default element.
  std::optional<TreadShape> tread = {};
  TreadShape tread_shape() const {
    if (tread) return *tread;
    return element == ElementKind::solid_shell ? TreadShape::smooth : TreadShape::facets;
  }
  double tolerance = 1e-5;  // residual norm relative to the norm of the pressure load
  int max_iterations = 40;  // Newton iterations a load step
  /// Most shifts of an indefinite tangent along its diagonal, each a factorization, until the
  /// residual has halved. If the tangent stays indefinite, the step is too long.
  int max_shifts = 6;
  /// Tolerance of the residual of the inverted problem, three times as large for loaded modes. The
  /// relative error of a frequency is the square of this over the relative gap to the next
  /// frequency; the error of a shape is this over that gap.
  double mode_tolerance = 1e-5;
};

/// Work done in a trial, for benchmarks and for the report.
struct SolverCounts {
  int analyses = 0;  // symbolic analyses of the ring
  int assemblies = 0, factorizations = 0, cg_iterations = 0, solves = 0, shifts = 0;
};

}  // namespace latsch::fe_tire
