// SPDX-License-Identifier: Apache-2.0
// How a tire's equations are solved, and what that took.
#pragma once

#include <optional>

#include "models/fe_tire/contact/tread_surface.h"
#include "models/fe_tire/element/hex8.h"

namespace latsch::fe_tire {

struct SolverSettings {
  ElementKind element = ElementKind::solid_shell;
  /// What the ground feels of the tread; none: the comparison element shows its facets, as the
  /// programs do that it is compared with, the default is smooth.
  std::optional<TreadShape> tread = {};
  TreadShape tread_shape() const {
    if (tread) return *tread;
    return element == ElementKind::solid_shell ? TreadShape::smooth : TreadShape::facets;
  }
  double tolerance = 1e-5;  // residual norm relative to the norm of the pressure load
  int max_iterations = 40;  // Newton iterations a load step
  /// Of its tangents along their diagonal, each a factorization, until the residual has halved:
  /// where they stay indefinite the step is too long.
  int max_shifts = 6;
  /// Of the inverted residual, thrice it of loaded modes; a frequency errs, relatively, by its
  /// square over the relative gap to the next one, a shape by itself over that gap.
  double mode_tolerance = 1e-5;
};

/// What a trial cost: for benchmarks and for the report.
struct SolverCounts {
  int analyses = 0;  // symbolic ones, of the ring
  int assemblies = 0, factorizations = 0, cg_iterations = 0, solves = 0, shifts = 0;
};

}  // namespace latsch::fe_tire
