// SPDX-License-Identifier: Apache-2.0
#include "magic_formula/magic_formula_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "formats/tables/csv_table.h"
#include "formats/tire/tir_file.h"

namespace latsch::verification {

using namespace magic_formula;

std::vector<MagicFormulaPoint> magic_formula_points() {
  const auto table = formats::CsvTable::read(LATSCH_MAGIC_FORMULA_POINTS);
  std::vector<MagicFormulaPoint> points(table.rows());
  const auto fill = [&](const char* column, const char* unit, auto member) {
    const std::vector<double> values = table.numbers(column, unit);
    for (std::size_t i = 0; i < values.size(); ++i) member(points[i]) = values[i];
  };
#define LATSCH_COLUMN(group, name, unit) \
  fill(#name, unit, [](MagicFormulaPoint& p) -> double& { return p.group.name; })
  LATSCH_COLUMN(state, Fz, "N");
  LATSCH_COLUMN(state, kappa, "1");
  LATSCH_COLUMN(state, alpha, "rad");
  LATSCH_COLUMN(state, gamma, "rad");
  LATSCH_COLUMN(state, phit, "1/m");
  LATSCH_COLUMN(state, Vx, "m/s");
  LATSCH_COLUMN(state, p, "Pa");
  LATSCH_COLUMN(expected, Fx, "N");
  LATSCH_COLUMN(expected, Fy, "N");
  LATSCH_COLUMN(expected, Mx, "N m");
  LATSCH_COLUMN(expected, My, "N m");
  LATSCH_COLUMN(expected, Mz, "N m");
  LATSCH_COLUMN(expected, R_e, "m");
  LATSCH_COLUMN(expected, R_l, "m");
  LATSCH_COLUMN(expected, rho, "m");
  LATSCH_COLUMN(expected, t, "m");
  LATSCH_COLUMN(expected, Mzr, "N m");
  LATSCH_COLUMN(expected, mux, "1");
  LATSCH_COLUMN(expected, muy, "1");
  LATSCH_COLUMN(expected, omega, "rad/s");
  LATSCH_COLUMN(expected, Kxk, "N");
  LATSCH_COLUMN(expected, Kya, "N");
  LATSCH_COLUMN(expected, sigma_x, "m");
  LATSCH_COLUMN(expected, sigma_y, "m");
#undef LATSCH_COLUMN
  const std::vector<double> length = table.numbers("length", "m"),
                            width = table.numbers("width", "m");
  for (int i = 0; i < table.rows(); ++i) {
    points[i].expected.a = 0.5 * length[i];
    points[i].expected.b = 0.5 * width[i];
    const std::string version = table.text("version", i);
    points[i].version = version == "52"   ? Version::mf52
                        : version == "61" ? Version::mf61
                                          : Version::mf62;
    points[i].conventions.limits = table.text("limits", i) == "on";
    points[i].conventions.angles =
        table.text("angles", i) == "direct" ? Angles::direct : Angles::tangent;
    points[i].conventions.turn_slip = table.text("turn_slip", i) == "on";
  }
  return points;
}

std::optional<Parameters> sample_tire(Version version) {
  const std::filesystem::path folder = LATSCH_SAMPLE_TIRES;
  const char* name = version == Version::mf52   ? "MagicFormula52_Parameters.tir"
                     : version == Version::mf61 ? "MagicFormula61_Parameters.tir"
                                                : "MagicFormula62_Parameters.tir";
  if (!std::filesystem::exists(folder / name)) return std::nullopt;
  return formats::read_tir(folder / name).parameters;
}

Disagreement disagreement(const MagicFormulaPoint& point, const SteadyState& found) {
  Disagreement d;
  double largest = 0.0;
  const SteadyState& e = point.expected;
  const auto take = [&](const char* name,
                        double& into,
                        double a,
                        double b,
                        double absolute,
                        double relative) {
    const double error = std::abs(a - b) / (absolute + relative * std::abs(b));
    into = std::isfinite(error) ? std::max(into, error) : INFINITY;
    if (!(error <= largest)) {
      largest = error;
      const State& s = point.state;
      d.worst = fmt::format(
          "{} is {:.12g}, not {:.12g}, at Fz {:.1f} kappa {:.3f} alpha {:.3f} gamma {:.3f} phit "
          "{:.3f} Vx {:.2f} p {:.0f} ({}, limits {}, {}, turn slip {})",
          name,
          a,
          b,
          s.Fz,
          s.kappa,
          s.alpha,
          s.gamma,
          s.phit,
          s.Vx,
          s.p,
          point.version == Version::mf52   ? "5.2"
          : point.version == Version::mf61 ? "6.1"
                                           : "6.2",
          point.conventions.limits,
          point.conventions.angles == Angles::direct ? "direct" : "tangent",
          point.conventions.turn_slip);
    }
  };
  constexpr double kForce = 1e-6, kMoment = 1e-7, kRelative = 1e-9;
  // m; the reference program ends its iteration for the rolling radius at this change.
  constexpr double kRadius = 1e-9;
  take("Fx", d.force, found.Fx, e.Fx, kForce, kRelative);
  take("Fy", d.force, found.Fy, e.Fy, kForce, kRelative);
  take("Mx", d.moment, found.Mx, e.Mx, kMoment, kRelative);
  take("My", d.moment, found.My, e.My, kMoment, kRelative);
  take("Mz", d.moment, found.Mz, e.Mz, kMoment, kRelative);
  take("Mzr", d.moment, found.Mzr, e.Mzr, kMoment, kRelative);
  take("Kxk", d.force, found.Kxk, e.Kxk, kForce, kRelative);
  take("Kya", d.force, found.Kya, e.Kya, kForce, kRelative);
  take("R_e", d.radius, found.R_e, e.R_e, kRadius, kRelative);
  take("a", d.radius, found.a, e.a, kRadius, kRelative);
  take("b", d.radius, found.b, e.b, kRadius, kRelative);
  take("t", d.radius, found.t, e.t, kRadius, kRelative);
  take("sigma_x", d.radius, found.sigma_x, e.sigma_x, kRadius, kRelative);
  take("sigma_y", d.radius, found.sigma_y, e.sigma_y, kRadius, kRelative);
  take("mux", d.radius, found.mux, e.mux, kRadius, kRelative);
  take("muy", d.radius, found.muy, e.muy, kRadius, kRelative);
  if (e.R_l > 0.0) {
    take("rho", d.radius, found.rho, e.rho, kRadius, kRelative);
    take("R_l", d.radius, found.R_l, e.R_l, kRadius, kRelative);
  }
  return d;
}

}  // namespace latsch::verification
