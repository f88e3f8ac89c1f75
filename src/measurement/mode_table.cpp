// SPDX-License-Identifier: Apache-2.0
#include "measurement/mode_table.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace latsch {
namespace {

std::string fault_of_shape(const std::vector<double>& shape, std::size_t points) {
  if (shape.size() != 3 * points)
    return "shape has " + std::to_string(shape.size()) + " values, expected " +
           std::to_string(3 * points) + ": x, y, z of every sensor point";
  if (!std::all_of(shape.begin(), shape.end(), [](double u) { return std::isfinite(u); }))
    return "shape holds a number that is not finite";
  if (std::all_of(shape.begin(), shape.end(), [](double u) { return u == 0.0; }))
    return "shape is zero everywhere";
  return "";
}

std::string fault_of(const MeasuredMode& mode, std::size_t points) {
  if (!std::isfinite(mode.frequency) || mode.frequency <= 0.0)
    return "frequency is " + format_number(mode.frequency) + " Hz, expected more than 0 Hz";
  if (mode.n && *mode.n < 0)
    return "n is " + std::to_string(*mode.n) + ", expected a number of waves, 0 or more";
  if (mode.phase != ' ' && mode.phase != 's' && mode.phase != 'a')
    return "phase is " + in_quotes(std::string_view(&mode.phase, 1)) +
           ", expected \"s\", \"a\" or nothing";
  return points == 0 && mode.shape.empty() ? "" : fault_of_shape(mode.shape, points);
}

}  // namespace

std::optional<MeasurementFault> find_fault(const ModeTable& table) {
  if (table.modes.empty()) return MeasurementFault{-1, "holds no mode, expected at least one"};
  for (std::size_t i = 0; i < table.modes.size(); ++i)
    if (const std::string fault = fault_of(table.modes[i], table.points.size()); !fault.empty())
      return MeasurementFault{static_cast<int>(i), fault};
  for (const std::array<double, 3>& point : table.points)
    for (const double x : point)
      if (!std::isfinite(x)) return MeasurementFault{-1, "has a sensor point that is not finite"};
  return std::nullopt;
}

}  // namespace latsch
