// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/uff_channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "base/unit_reading.h"

namespace latsch::formats {
namespace {

/// Kinds of quantities by their number in the records of axes, with the exponents of length, force
/// and temperature in the text of the format.
struct UffQuantity {
  long number;
  const char* si_unit;
  int length, force;
};
constexpr std::array<UffQuantity, 11> kQuantities = {{{2, "Pa", -2, 1},
                                                      {8, "m", 1, 0},
                                                      {9, "N", 0, 1},
                                                      {11, "m s^-1", 1, 0},
                                                      {12, "m s^-2", 1, 0},
                                                      {13, "N", 0, 1},
                                                      {15, "Pa", -2, 1},
                                                      {16, "kg", -1, 1},
                                                      {17, "s", 0, 0},
                                                      {18, "Hz", 0, 0},
                                                      {3, "1", 0, 0}}};

const char* word_of_function(long kind) {
  switch (kind) {
    case 1:
      return "";
    case 2:
      return "auto spectrum ";
    case 3:
      return "cross spectrum ";
    case 4:
      return "frf ";
    case 6:
      return "coherence ";
    case 12:
      return "spectrum ";
    default:
      return nullptr;
  }
}

std::string degree_of_freedom(long point, long direction) {
  static constexpr std::array<const char*, 7> kAxes = {"", "X", "Y", "Z", "RX", "RY", "RZ"};
  if (direction < -6 || direction > 6) return fmt::format("{}:{}", point, direction);
  const char* sign = direction < 0 ? "-" : direction > 0 ? "+" : "";
  return fmt::format("{}{}{}", point, sign, kAxes[static_cast<std::size_t>(std::abs(direction))]);
}

std::string uff_name(const UffFunction& function) {
  std::string name = word_of_function(function.kind);
  if (function.point == 0 && function.direction == 0 && !function.title.empty())
    return name + function.title;
  name += degree_of_freedom(function.point, function.direction);
  if (function.kind == 3 || function.kind == 4 || function.kind == 6)
    name += "/" + degree_of_freedom(function.reference_point, function.reference_direction);
  return name;
}

}  // namespace

void UffChannels::doubt_label(const UffAxis& axis,
                              const UffFunction& function,
                              const char* sentence) {
  if (is_doubted_) return;
  is_doubted_ = true;
  file_.doubts.push_back(
      fmt::format("the label of an axis says {} (line {}), {}: the label is taken",
                  in_quotes(axis.unit),
                  function.line,
                  sentence));
}

/// Returns the unit of an axis in words of UDUNITS. If the label is no unit, it follows from the
/// kind of quantity, and the factors of data set 164 convert the numbers to SI.
UffChannels::AxisUnit UffChannels::unit_of(const UffAxis& axis,
                                           const UffFunction& function,
                                           std::string& remark) {
  const auto known =
      std::find_if(kQuantities.begin(), kQuantities.end(), [&](const UffQuantity& one) {
        return one.number == axis.quantity;
      });
  const bool is_known = known != kQuantities.end();
  const double factor =
      is_known ? std::pow(length_, known->length) * std::pow(force_, known->force) : 1.0;
  if (!axis.unit.empty()) {
    if (!is_known) return {axis.unit};
    const auto unit = find_unit(axis.unit, Unit::of(known->si_unit));
    if (!unit) return {axis.unit};
    if (!unit->same_dimension(Unit::of(known->si_unit))) {
      if (!Unit::of(known->si_unit).dimensionless())
        doubt_label(axis, function, "which is not a unit of its kind of quantity");
      return {axis.unit};
    }
    const double in_si = unit->to_si(1.0L) * factor;
    constexpr double kRounding = 1e-4;
    if (factor != 1.0 && std::abs(in_si - 1.0) > kRounding)
      doubt_label(axis, function, "which is not the unit of data set 164");
    return {unit->text()};
  }
  if (!is_known) return {};
  remark = "the unit is that of data set 164 for the kind of quantity";
  if (factor != 1.0)
    remark += fmt::format(": {} {}, converted", format_number(1.0 / factor, 6), known->si_unit);
  return {known->si_unit, 1.0 / factor};
}

std::string UffChannels::place_of(long label) const {
  const auto point = points_.find(label);
  if (point == points_.end()) return "";
  return fmt::format("point {} at {:.6g}, {:.6g}, {:.6g} m",
                     label,
                     point->second.x / length_,
                     point->second.y / length_,
                     point->second.z / length_);
}

/// Returns the group with the abscissa of the function; makes one if there is none.
RecordedGroup& UffChannels::group_of(const UffFunction& function) {
  const std::size_t per = function.layout.per_sample();
  std::vector<double> abscissa(function.samples);
  for (std::size_t i = 0; i < function.samples; ++i)
    abscissa[i] = function.layout.is_even ? function.first + static_cast<double>(i) * function.step
                                          : function.numbers[i * per];
  const bool is_time = function.kind == 1;
  const std::string name = is_time ? "time" : "frequency";
  const auto key_of = [](double value) { return std::isnan(value) ? 0.0 : value; };
  std::vector<std::size_t>& alike =
      groups_alike_[{name, function.samples, key_of(abscissa.front()), key_of(abscissa.back())}];
  for (const std::size_t one : alike)
    if (file_.groups[one].channels.front().values == abscissa) return file_.groups[one];
  budget_.take(function.samples);
  alike.push_back(file_.groups.size());
  RecordedChannel channel{name, function.abscissa.unit, std::move(abscissa), ""};
  const auto unit = find_unit(channel.unit, Unit::of(is_time ? "s" : "Hz"));
  if (channel.unit.empty()) {
    channel.unit = is_time ? "s" : "Hz";
    channel.remark = "the file states no unit of the abscissa: " + channel.unit + " is taken";
  } else if (unit) {
    channel.unit = unit->text();
  }
  file_.groups.push_back({fmt::format("{} {}", name, ++groups_[name]), {}, true});
  file_.groups.back().channels.push_back(std::move(channel));
  return file_.groups.back();
}

void UffChannels::add(UffFunction& function) {
  if (!word_of_function(function.kind)) {
    file_.left_out[fmt::format("function in line {}", function.line)] =
        fmt::format("is of type {}, expected 1, 2, 3, 4, 6 or 12", function.kind);
    return;
  }
  if (function.samples == 0) {
    file_.doubts.push_back(fmt::format("the function in line {} has no sample", function.line));
    return;
  }
  RecordedGroup& group = group_of(function);
  RecordedChannel channel{uff_name(function)};
  const AxisUnit above = unit_of(function.ordinate, function, channel.remark);
  channel.unit = above.unit;
  double factor = above.factor;
  if (function.kind == 4) {
    std::string unused;
    const AxisUnit below = unit_of(function.denominator, function, unused);
    if (!below.unit.empty() && below.unit != "1")
      channel.unit = fmt::format("({})/({})", above.unit.empty() ? "1" : above.unit, below.unit);
    factor /= below.factor;
  }
  if (const std::string place = place_of(function.point); !place.empty())
    channel.remark += (channel.remark.empty() ? "" : "; ") + place;
  if (!function.title.empty() && channel.name.find(function.title) == std::string::npos)
    channel.remark += (channel.remark.empty() ? "" : "; ") + in_quotes(function.title);
  const std::size_t per = function.layout.per_sample();
  const std::size_t skip = function.layout.is_even ? 0 : 1;
  const auto take = [&](const char* part, std::size_t offset) {
    RecordedChannel one = channel;
    one.name += part;
    one.values.reserve(function.samples);
    for (std::size_t i = 0; i < function.samples; ++i)
      one.values.push_back(factor * function.numbers[i * per + skip + offset]);
    group.channels.push_back(std::move(one));
  };
  budget_.take(function.samples * (per - skip));
  take(function.layout.is_complex ? " real" : "", 0);
  if (function.layout.is_complex) take(" imag", 1);
  function.numbers = {};
}

}  // namespace latsch::formats
