// SPDX-License-Identifier: Apache-2.0
// The vertical force of a tire whose file has a [DEFLECTION_LOAD_CURVE]: the points {rho, Fz} are
// joined by straight lines, and the last line is continued beyond the last point.
//
// The curve replaces the whole formula (3) of the vertical force: VERTICAL_STIFFNESS, Q_FZ2, Q_V2,
// Q_FCX, Q_FCY, Q_CAM1 to Q_CAM3 and PFZ1 have no effect on it [Altair MotionView, tire property
// file: VERTICAL_STIFFNESS is required if there is no curve; Project Chrono: the curve takes
// priority over the linear stiffness]. The effective rolling radius (7) and the patch (5), (9),
// (10) keep VERTICAL_STIFFNESS, with which their coefficients were identified.
//
// The curve rises from {0, 0}; its points ascend in both columns. Each function requires a curve.
#pragma once

#include <algorithm>
#include <cstddef>

#include "models/magic_formula/parameters.h"
#include "numerics/kernels/dual_number.h"

namespace latsch::magic_formula {

inline bool has_load_curve(const Parameters& p) { return !p.curve_deflection.empty(); }

/// Returns the index of the point at the upper end of the line that contains x. Values beyond the
/// last point belong to the last line.
inline std::size_t line_of(const std::vector<double>& points, double x) {
  const auto above = std::upper_bound(points.begin(), points.end(), x) - points.begin();
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, std::ssize(points) - 1));
}

/// Returns the force, N, at the deflection `rho`, m; 0 if rho is not positive.
double force_on_curve(const Parameters& p, double rho);

/// Returns the deflection, m, at which the tire carries a force, N. At a point of the curve its
/// derivative is that of the line above the point. K is double or DualNumber.
template <class K>
K deflection_on_curve(const Parameters& p, const K& Fz) {
  const auto &x = p.curve_deflection, &F = p.curve_force;
  const std::size_t i = line_of(F, value(Fz));
  return x[i - 1] + (Fz - F[i - 1]) * ((x[i] - x[i - 1]) / (F[i] - F[i - 1]));
}

/// Returns the force, N, of the curve in series with a linear spring of stiffness k, N/m, if both
/// together are compressed by rho, m. The spring must be stiffer than every line of the curve.
double force_on_curve_with_spring(const Parameters& p, double rho, double k);

/// Returns the stiffness at the nominal load, N/m: the slope of the curve there, or
/// VERTICAL_STIFFNESS if the file has no curve.
double nominal_stiffness(const Parameters& p);

/// Returns the slope of the first line of the curve, N/m, which is the secant stiffness at zero
/// load.
double initial_stiffness(const Parameters& p);

/// Returns the slope of the steepest line of the curve, N/m, or VERTICAL_STIFFNESS if the file has
/// no curve.
double greatest_stiffness(const Parameters& p);

}  // namespace latsch::magic_formula
