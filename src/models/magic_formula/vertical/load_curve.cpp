// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/vertical/load_curve.h"

namespace latsch::magic_formula {
namespace {

double slope_of_line(const Parameters& p, std::size_t i) {
  const auto &x = p.curve_deflection, &F = p.curve_force;
  return (F[i] - F[i - 1]) / (x[i] - x[i - 1]);
}

}  // namespace

double force_on_curve(const Parameters& p, double rho) {
  if (!(rho > 0.0)) return 0.0;
  const auto &x = p.curve_deflection, &F = p.curve_force;
  const std::size_t i = line_of(x, rho);
  return F[i - 1] + (F[i] - F[i - 1]) * (rho - x[i - 1]) / (x[i] - x[i - 1]);
}

double force_on_curve_with_spring(const Parameters& p, double rho, double k) {
  if (!(rho > 0.0)) return 0.0;
  const auto &x = p.curve_deflection, &F = p.curve_force;
  // Finds the line of the curve. x - F/k is the deflection of the curve without that of the series
  // spring; it increases along the curve, because k is greater than every slope.
  std::size_t i = 1;
  while (i + 1 < x.size() && x[i] - F[i] / k < rho) ++i;
  const double C = slope_of_line(p, i);
  return (F[i - 1] + C * (rho - x[i - 1])) / (1.0 - C / k);
}

double nominal_stiffness(const Parameters& p) {
  if (!has_load_curve(p)) return p.VERTICAL_STIFFNESS;
  return slope_of_line(p, line_of(p.curve_force, p.FNOMIN));
}

double initial_stiffness(const Parameters& p) { return slope_of_line(p, 1); }

double greatest_stiffness(const Parameters& p) {
  if (!has_load_curve(p)) return p.VERTICAL_STIFFNESS;
  double most = 0.0;
  for (std::size_t i = 1; i < p.curve_force.size(); ++i) most = std::max(most, slope_of_line(p, i));
  return most;
}

}  // namespace latsch::magic_formula
