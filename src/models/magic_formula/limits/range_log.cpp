// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/limits/range_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/magic_formula/vertical/load_curve.h"

namespace latsch::magic_formula {

void InputExtremes::add(const State& s) {
  if (!(s.Fz > 0.0)) return;  // the tire is in the air
  Fz.add(s.Fz);
  kappa.add(s.kappa);
  alpha.add(s.alpha);
  gamma.add(s.gamma);
  p.add(s.p);
  speed.add(std::abs(s.Vx));
}

void InputExtremes::add(const InputExtremes& other) {
  Fz.add(other.Fz);
  kappa.add(other.kappa);
  alpha.add(other.alpha);
  gamma.add(other.gamma);
  p.add(other.p);
  speed.add(other.speed);
  standing.add(other.standing);
}

namespace {

/// Returns a sentence if a load exceeds the last point of the file's deflection-load curve,
/// otherwise an empty text.
std::string beyond_curve(const InputExtremes& inputs, const Parameters& p) {
  constexpr double kRounding = 1e-9;
  const double most = std::max(inputs.Fz.to, inputs.standing.to);
  if (!has_load_curve(p) || !(most > (1.0 + kRounding) * p.curve_force.back())) return "";
  return fmt::format(
      "Fz is {:.4g} N in this test, beyond the last point of [DEFLECTION_LOAD_CURVE], {:.4g} N at "
      "{:.4g} mm: the last line of the curve is continued",
      most,
      p.curve_force.back(),
      1e3 * p.curve_deflection.back());
}

}  // namespace

std::vector<std::string> ranges_left(const InputExtremes& inputs, const Parameters& p) {
  std::vector<std::string> sentences;
  if (std::string beyond = beyond_curve(inputs, p); !beyond.empty())
    sentences.push_back(std::move(beyond));
  if (inputs.Fz.from > inputs.Fz.to) return sentences;
  constexpr double kRounding = 1e-9;
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const auto say = [&](const char* what,
                       double value,
                       const char* side,
                       const char* key,
                       double limit,
                       double scale,
                       const char* unit) {
    sentences.push_back(
        fmt::format("{} is {:.4g}{} in this test, {} {} = {:.4g}{} of the tire's file: the forces "
                    "are those at the limit",
                    what,
                    scale * value,
                    unit,
                    side,
                    key,
                    scale * limit,
                    unit));
  };
  const auto above = [&](const char* what,
                         double value,
                         const char* key,
                         double limit,
                         double scale,
                         const char* unit) {
    if (value > limit + kRounding * std::abs(limit))
      say(what, value, "above", key, limit, scale, unit);
  };
  const auto below = [&](const char* what,
                         double value,
                         const char* key,
                         double limit,
                         double scale,
                         const char* unit) {
    if (value < limit - kRounding * std::abs(limit))
      say(what, value, "below", key, limit, scale, unit);
  };
  above("Fz", inputs.Fz.to, "FZMAX", p.FZMAX, 1.0, " N");
  below("Fz", inputs.Fz.to, "FZMIN", p.FZMIN, 1.0, " N");
  above("kappa", inputs.kappa.to, "KPUMAX", p.KPUMAX, 1.0, "");
  below("kappa", inputs.kappa.from, "KPUMIN", p.KPUMIN, 1.0, "");
  above("alpha", inputs.alpha.to, "ALPMAX", p.ALPMAX, kDegrees, " deg");
  below("alpha", inputs.alpha.from, "ALPMIN", p.ALPMIN, kDegrees, " deg");
  above("gamma", inputs.gamma.to, "CAMMAX", p.CAMMAX, kDegrees, " deg");
  below("gamma", inputs.gamma.from, "CAMMIN", p.CAMMIN, kDegrees, " deg");
  above("The pressure", inputs.p.to, "PRESMAX", p.PRESMAX, 1e-5, " bar");
  below("The pressure", inputs.p.from, "PRESMIN", p.PRESMIN, 1e-5, " bar");
  // Speed, m/s. A test in which the tire is never faster is meant for a standing or parked tire.
  constexpr double kStands = 0.5;
  if (inputs.speed.to > kStands && inputs.speed.to < p.VXLOW)
    sentences.push_back(
        fmt::format("The tire rolls at {:.3g} m/s at most in this test, below VXLOW = {:.3g} m/s "
                    "of its file: its forces fade there as at rest",
                    inputs.speed.to,
                    p.VXLOW));
  return sentences;
}

void RangeLog::add(const State& state) {
  const std::lock_guard lock(mutex_);
  inputs_.add(state);
}

void RangeLog::add_standing(double load) {
  const std::lock_guard lock(mutex_);
  inputs_.standing.add(load);
}

void RangeLog::add(const InputExtremes& inputs) {
  const std::lock_guard lock(mutex_);
  inputs_.add(inputs);
}

InputExtremes RangeLog::inputs() const {
  const std::lock_guard lock(mutex_);
  return inputs_;
}

bool pressure_acts(const Parameters& p) {
  const double all[] = {p.PPX1,
                        p.PPX2,
                        p.PPX3,
                        p.PPX4,
                        p.PPY1,
                        p.PPY2,
                        p.PPY3,
                        p.PPY4,
                        p.PPY5,
                        p.PPZ1,
                        p.PPZ2,
                        p.PPMX1,
                        p.PFZ1,
                        p.QSY8,
                        p.PCFX3,
                        p.PCFY3};
  return std::any_of(std::begin(all), std::end(all), [](double x) { return x != 0.0; });
}

}  // namespace latsch::magic_formula
