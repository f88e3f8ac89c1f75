// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_curve.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <vector>

#include "base/units.h"
#include "models/magic_formula/vertical/load_curve.h"

namespace latsch::formats {
namespace {

using magic_formula::Parameters;

constexpr const char* kCurve = "DEFLECTION_LOAD_CURVE";

/// Coefficients of the formula for the vertical force; they have no effect if the file has a curve.
constexpr std::array<std::string_view, 12> kReplaced = {"Q_V2",
                                                        "Q_FZ2",
                                                        "Q_FCX",
                                                        "Q_FCY",
                                                        "Q_FCY2",
                                                        "Q_CAM1",
                                                        "Q_CAM2",
                                                        "Q_CAM3",
                                                        "Q_FYS1",
                                                        "Q_FYS2",
                                                        "Q_FYS3",
                                                        "PFZ1"};

bool heads_deflection(std::string_view head) {
  return head.starts_with("PEN") || head.starts_with("DEF") || head == "RHO";
}

bool heads_force(std::string_view head) {
  return head.starts_with("FZ") || head.starts_with("LOAD") || head.starts_with("FORCE");
}

/// Refuses columns other than deflection and force.
void check_curve_heads(const TeimOrbitSection& curve, const TeimOrbitTable& table) {
  const auto& heads = table.heads;
  if (heads.empty()) return;
  const bool in_order = heads.size() == 2 && !heads_force(heads[0]) && !heads_deflection(heads[1]);
  if (!in_order)
    throw InputError(
        curve.place(table.line),
        fmt::format("the columns of [{}] are {{{}}}, expected {{pen fz}}: deflection and force",
                    kCurve,
                    fmt::join(heads, " ")));
}

class CurveReading {
 public:
  CurveReading(TirFile& tir, const TeimOrbitUnits& units, const TeimOrbitSection& curve)
      : p_(tir.parameters), units_(units), curve_(curve) {}

  void run() {
    for (const TeimOrbitTable& table : curve_.tables()) {
      check_curve_heads(curve_, table);
      for (const TeimOrbitRow& row : table.rows) add(row);
    }
    if (p_.curve_deflection.size() < 2)
      throw InputError(curve_.place(),
                       fmt::format("[{}] has fewer than two points, expected at least {{0, 0}} "
                                   "and one of a load",
                                   kCurve));
  }
  /// Returns the first deflection in the file, m.
  double first() const { return first_; }

 private:
  void add(const TeimOrbitRow& row) {
    auto &x = p_.curve_deflection, &F = p_.curve_force;
    if (row.fields.size() != 2)
      throw InputError(
          curve_.place(row.line),
          fmt::format("a row of [{}] has {} numbers, expected two: deflection and force",
                      kCurve,
                      row.fields.size()));
    const std::vector<double> pen_fz = curve_.numbers(row, 2);
    const double rho = pen_fz[0] * units_.length(), Fz = pen_fz[1] * units_.force();
    if (x.empty()) begin(row, rho, Fz);
    if (!x.empty() && !(rho > x.back() && Fz > F.back()))
      throw InputError(
          curve_.place(row.line),
          fmt::format("[{}] does not rise here: {} is carried at {} and {} at {}; expected "
                      "deflections and forces that rise from row to row",
                      kCurve,
                      format_quantity(F.back(), "N", 6),
                      format_quantity(x.back(), "mm", 6),
                      format_quantity(Fz, "N", 6),
                      format_quantity(rho, "mm", 6)));
    x.push_back(rho);
    F.push_back(Fz);
  }

  /// Adds the point {0, 0} if the curve begins later.
  void begin(const TeimOrbitRow& row, double rho, double Fz) {
    first_ = rho;
    if (rho < 0.0 || Fz < 0.0 || (rho == 0.0 && Fz != 0.0))
      throw InputError(
          curve_.place(row.line),
          fmt::format("[{}] begins with {} at {}: expected {{0, 0}}, no force without deflection",
                      kCurve,
                      format_quantity(Fz, "N", 6),
                      format_quantity(rho, "mm", 6)));
    if (rho == 0.0) return;
    p_.curve_deflection.push_back(0.0);
    p_.curve_force.push_back(0.0);
  }

  Parameters& p_;
  const TeimOrbitUnits& units_;
  const TeimOrbitSection& curve_;
  double first_ = 0.0;
};

/// Throws for a curve that no tire has, and for one that contradicts VERTICAL_STIFFNESS.
void check_curve_size(const Parameters& p, const TeimOrbitSection& curve) {
  constexpr double kFar = 100.0;
  if (p.curve_deflection.back() >= p.UNLOADED_RADIUS)
    throw InputError(
        curve.place(),
        fmt::format("[{}] reaches a deflection of {}, but UNLOADED_RADIUS is {}: are its "
                    "deflections in millimeters, while LENGTH of [UNITS] is another unit?",
                    kCurve,
                    format_quantity(p.curve_deflection.back(), "mm", 6),
                    format_quantity(p.UNLOADED_RADIUS, "mm", 6)));
  const double ratio =
      p.FNOMIN / magic_formula::deflection_on_curve(p, p.FNOMIN) / p.VERTICAL_STIFFNESS;
  if (ratio > kFar || ratio < 1.0 / kFar)
    throw InputError(
        curve.place(),
        fmt::format(
            "[{}] is {:.3g} times {} than VERTICAL_STIFFNESS: is a unit of [UNITS] not that "
            "of the curve?",
            kCurve,
            ratio > 1.0 ? ratio : 1.0 / ratio,
            ratio > 1.0 ? "stiffer" : "softer"));
}

std::string millimeters(double x) { return fmt::format("{:.4g} mm", 1e3 * x); }

}  // namespace

void read_load_curve(TirFile& tir,
                     const TeimOrbitUnits& units,
                     const std::function<void(int line, const std::string&)>& doubt) {
  const TeimOrbitSection* curve = tir.source.find(kCurve);
  if (curve == nullptr) return;
  CurveReading reading(tir, units, *curve);
  reading.run();
  const Parameters& p = tir.parameters;
  check_curve_size(p, *curve);
  const auto &x = p.curve_deflection, &F = p.curve_force;
  const int line = curve->place().line;
  tir.keys.push_back(
      {curve->name(),
       "{pen fz}",
       line,
       "DEFLECTION_LOAD_CURVE",
       fmt::format("{} points to {}, {:.6g} N", x.size(), millimeters(x.back()), F.back())});
  for (const TeimOrbitSection& other : tir.source.sections())
    if (&other != curve && other.name() == kCurve)
      doubt(other.place().line,
            fmt::format("a second [{}] is not used; that of line {} counts", kCurve, line));
  if (reading.first() > 0.0)
    doubt(line,
          fmt::format("[{}] begins at {}: a straight line from {{0, 0}} is assumed before",
                      kCurve,
                      millimeters(reading.first())));
  const double rho = magic_formula::deflection_on_curve(p, p.FNOMIN);
  if (p.FNOMIN > F.back())
    doubt(line,
          fmt::format("[{}] ends at {:.6g} N, below FNOMIN = {:.6g} N: its last line is continued",
                      kCurve,
                      F.back(),
                      p.FNOMIN));
  constexpr double kUnlike = 1.5;
  const double ratio = p.FNOMIN / rho / p.VERTICAL_STIFFNESS;
  if (ratio > kUnlike || ratio < 1.0 / kUnlike)
    doubt(line,
          fmt::format("[{}] carries FNOMIN at {}, VERTICAL_STIFFNESS at {}: the curve counts for "
                      "the vertical force, VERTICAL_STIFFNESS for the effective rolling radius and "
                      "the contact patch",
                      kCurve,
                      millimeters(rho),
                      millimeters(p.FNOMIN / p.VERTICAL_STIFFNESS)));
  std::vector<std::string_view> replaced;
  for (const std::string_view name : kReplaced)
    if (p.*magic_formula::find_parameter(name)->member != 0.0) replaced.push_back(name);
  const auto scale = tir.scales.find("VERTICAL_STIFFNESS");
  if (scale != tir.scales.end() && scale->second != 1.0) replaced.push_back("LCZ");
  if (!replaced.empty())
    doubt(line,
          fmt::format("[{}] replaces the formula of the vertical force: {} {} no effect on it",
                      kCurve,
                      fmt::join(replaced, ", "),
                      replaced.size() == 1 ? "has" : "have"));
}

}  // namespace latsch::formats
