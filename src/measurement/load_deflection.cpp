// SPDX-License-Identifier: Apache-2.0
#include "measurement/load_deflection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace latsch {
namespace {

std::string name(Abscissa abscissa) {
  return abscissa == Abscissa::deflection ? "deflection" : "loaded_radius";
}

/// Returns "" if the value is finite and positive (or zero, if `zero_allowed`), else the fault.
std::string fault_of(const std::string& what, double value, const char* unit, bool zero_allowed) {
  if (std::isfinite(value) && (value > 0.0 || (zero_allowed && value == 0.0))) return "";
  return what + " is " + format_number(value) + " " + unit + ", expected " +
         (zero_allowed ? "at least 0 " : "more than 0 ") + unit;
}

}  // namespace

std::optional<MeasurementFault> find_fault(const LoadDeflectionCurve& curve) {
  const std::size_t points = curve.position.size();
  if (points == 0) return MeasurementFault{-1, "holds no point, expected at least one"};
  if (curve.force.size() != points || (!curve.spread.empty() && curve.spread.size() != points))
    return MeasurementFault{-1, "has columns of unequal length"};
  for (std::size_t i = 0; i < points; ++i) {
    const int point = static_cast<int>(i);
    const std::string position = name(curve.abscissa);
    for (const std::string& fault :
         {fault_of(position, curve.position[i], "m", false),
          fault_of("force", curve.force[i], "N", false),
          curve.spread.empty() ? "" : fault_of("spread", curve.spread[i], "N", true)})
      if (!fault.empty()) return MeasurementFault{point, fault};
    if (i == 0) continue;
    const bool rising = curve.position[1] > curve.position[0];
    if (rising ? curve.position[i] <= curve.position[i - 1]
               : curve.position[i] >= curve.position[i - 1])
      return MeasurementFault{point,
                              position + " is " + format_number(curve.position[i]) + " m after " +
                                  format_number(curve.position[i - 1]) +
                                  " m, expected values that all rise or all fall"};
  }
  return std::nullopt;
}

std::string way_out_of(const LoadDeflectionCurve& curve, const MeasurementFault& fault) {
  const auto point = static_cast<std::size_t>(std::max(fault.point, 0));
  if (fault.point < 0 || point >= curve.position.size() || point >= curve.force.size()) return "";
  const auto keep = [&](const char* key, const std::string& statement) {
    return fmt::format(
        "; {} = {{{} = \"{}\"}} in a [measurement.NAME] of the file keeps the others",
        key,
        name(curve.abscissa),
        statement);
  };
  constexpr double kPerMm = 1e-3;
  double least = 0.0;
  for (const double position : curve.position)
    if (position > 0.0 && (least == 0.0 || position < least)) least = position;
  if (curve.position[point] <= 0.0)
    return least == 0.0 ? "" : keep("select", format_number(0.5 * least / kPerMm, 3) + " mm ..");
  const bool all_negative = std::all_of(
      curve.force.begin(), curve.force.end(), [](double force) { return force <= 0.0; });
  if (all_negative && curve.force[point] < 0.0)
    return "; no force is positive: axes = \"sae\" in a [measurement.NAME] of the file reads a "
           "record of SAE axes, and a minus before the column in its table columns turns the force "
           "alone";
  const bool is_point = std::isfinite(curve.position[point]) && curve.force[point] > 0.0;
  const bool has_spread = point < curve.spread.size() && !(curve.spread[point] >= 0.0);
  return is_point && !has_spread ? keep("sweep", "rising") : "";
}

}  // namespace latsch
