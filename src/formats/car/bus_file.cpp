// SPDX-License-Identifier: Apache-2.0
#include "formats/car/bus_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/text.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

using multibody::BushingParameters;
using multibody::ForceCurve;

constexpr std::array<const char*, 6> kBusAxes = {"FX", "FY", "FZ", "TX", "TY", "TZ"};
constexpr std::array<const char*, 6> kBusAxesInWords = {
    "x", "y", "z", "about x", "about y", "about z"};
constexpr double kStraight = 1e-9;  // share of the largest force; smaller deviations from a
                                    // straight line are ignored

/// SI values of one unit of a row's two numbers and of a damping.
struct BusScale {
  double deflection, force, damping;
};

BusScale bus_scale_of(std::size_t axis, const TeimOrbitUnits& units) {
  if (axis < 3) return {units.length, units.force, units.force * units.time / units.length};
  const double torque = units.force * units.length;
  return {units.angle, torque, torque * units.time / units.angle};
}

std::vector<ForceCurve::Point> read_points(const TeimOrbitSection& section, const BusScale& scale) {
  std::vector<ForceCurve::Point> points;
  const TeimOrbitTable* table = section.find_table("");
  const std::size_t rows = table ? table->rows.size() : 0;
  if (rows < 2)
    throw InputError(section.place(),
                     fmt::format("[{}] has {} {}, two at least are needed",
                                 section.name(),
                                 rows,
                                 rows == 1 ? "row" : "rows"));
  for (const TeimOrbitRow& row : table->rows) {
    const std::vector<double> numbers = section.numbers(row, 2);
    if (numbers.size() > 2)
      throw InputError(
          section.place(row.line),
          fmt::format("a row of {} numbers, expected a deflection and a force", numbers.size()));
    const ForceCurve::Point point(numbers[0] * scale.deflection, numbers[1] * scale.force);
    if (!std::isfinite(point.first) || !std::isfinite(point.second))
      throw InputError(section.place(row.line), "a number that is too large");
    if (!points.empty() && !(point.first > points.back().first))
      throw InputError(
          section.place(row.line),
          fmt::format("the deflection {} does not rise: expected more than that of the "
                      "row before",
                      row.fields[0]));
    points.push_back(point);
  }
  if (points.back().second < points.front().second)
    throw InputError(section.place(),
                     fmt::format("[{}] falls: expected the force that resists, which rises with "
                                 "the deflection",
                                 section.name()));
  return points;
}

/// Returns the stiffness if the points are on a straight line through the origin.
std::optional<double> straight(const std::vector<ForceCurve::Point>& points) {
  double largest = 0.0;
  ForceCurve::Point far{0.0, 0.0};
  for (const ForceCurve::Point& point : points) {
    largest = std::max(largest, std::abs(point.second));
    if (std::abs(point.first) > std::abs(far.first)) far = point;
  }
  const double k = far.second / far.first;
  if (!std::isfinite(k)) return std::nullopt;
  for (const auto& [x, f] : points)
    if (!(std::abs(f - k * x) <= kStraight * largest)) return std::nullopt;
  return k;
}

void set_axis(BushingParameters& bushing,
              std::size_t axis,
              const std::vector<ForceCurve::Point>& points,
              double damping) {
  const auto i = static_cast<Eigen::Index>(axis % 3);
  const std::optional<double> k = straight(points);
  (axis < 3 ? bushing.stiffness : bushing.rotational)[i] = k.value_or(0.0);
  (axis < 3 ? bushing.damping : bushing.rotational_damping)[i] = damping;
  if (!k)
    bushing.parts.push_back({static_cast<int>(axis), multibody::ElasticCurve{ForceCurve(points)}});
}

/// Returns the curve of an axis as points. Throws InputError if the axis has further parts.
std::vector<ForceCurve::Point> points_of(const BushingParameters& bushing,
                                         std::size_t axis,
                                         const std::string& name) {
  // These are powers of two, so that the stiffness is read back to the last bit.
  const double reach = axis < 3 ? 1.0 / 128.0 : 1.0 / 8.0;  // m, rad
  const double k = (axis < 3 ? bushing.stiffness : bushing.rotational)[static_cast<int>(axis % 3)];
  std::vector<ForceCurve::Point> points;  // five on a straight line, as a spline needs several
  for (const double share : {-1.0, -0.5, 0.0, 0.5, 1.0})
    points.emplace_back(share * reach, k * share * reach + 0.0);  // + 0.0 turns -0 into 0
  bool is_curved = false;
  for (const BushingParameters::Part& part : bushing.parts) {
    if (part.axis != static_cast<int>(axis)) continue;
    const auto* curve = std::get_if<multibody::ElasticCurve>(&part.law);
    if (!curve || is_curved || k != 0.0)
      throw InputError(fmt::format(
          "{} has more than a stiffness or a curve {}, which a .bus file cannot express: "
          "expected one "
          "of them, without play, friction and Maxwell elements",
          name,
          axis < 3 ? "along " + std::string(kBusAxesInWords[axis]) : kBusAxesInWords[axis]));
    points = curve->curve.points();
    is_curved = true;
  }
  return points;
}

}  // namespace

BusFile bus_file_from(const TeimOrbit& file) {
  const TeimOrbitSection& header = file.section("MDI_HEADER");
  if (const std::string type = header.text("FILE_TYPE"); lower(type) != "bus")
    throw InputError(header.place(header.find("FILE_TYPE")->line),
                     "FILE_TYPE is " + in_quotes(type) + ", expected \"bus\"");
  file.section("UNITS");
  const TeimOrbitUnits units = file.units();
  const TeimOrbitSection& dampings = file.section("DAMPING");
  BusFile result;
  for (std::size_t axis = 0; axis < kBusAxes.size(); ++axis) {
    const BusScale scale = bus_scale_of(axis, units);
    const std::string curve = std::string(kBusAxes[axis]) + "_CURVE",
                      key = std::string(kBusAxes[axis]) + "_DAMPING";
    const double damping = dampings.number(key) * scale.damping;
    if (!(damping >= 0.0) || !std::isfinite(damping))
      throw InputError(dampings.place(dampings.find(key)->line),
                       fmt::format("{} is {}, expected a finite number that is not negative",
                                   key,
                                   dampings.find(key)->value));
    set_axis(result.bushing, axis, read_points(file.section(curve), scale), damping);
  }
  result.unused = file.unread();
  return result;
}

BusFile read_bus_file(const std::filesystem::path& file) {
  return bus_file_from(TeimOrbit::read(file));
}

std::string bus_text(const BushingParameters& bushing, const std::string& name) {
  std::string text =
      "$ " + name +
      "\n[MDI_HEADER]\nFILE_TYPE = 'bus'\nFILE_VERSION = 4.0\nFILE_FORMAT = 'ASCII'\n"
      "[UNITS]\nLENGTH = 'meter'\nANGLE = 'radians'\nFORCE = 'newton'\nMASS = 'kg'\n"
      "TIME = 'second'\n[DAMPING]\n";
  for (std::size_t axis = 0; axis < kBusAxes.size(); ++axis) {
    const auto i = static_cast<Eigen::Index>(axis % 3);
    const double c = (axis < 3 ? bushing.damping : bushing.rotational_damping)[i];
    text += fmt::format("{}_DAMPING = {}\n", kBusAxes[axis], format_number(c));
  }
  for (std::size_t axis = 0; axis < kBusAxes.size(); ++axis) {
    text += fmt::format("[{}_CURVE]\n{{{} {}}}\n",
                        kBusAxes[axis],
                        axis < 3 ? "x" : "angle",
                        axis < 3 ? "force" : "torque");
    for (const auto& [x, f] : points_of(bushing, axis, name))
      text += fmt::format(" {} {}\n", format_number(x), format_number(f));
  }
  return text;
}

}  // namespace latsch::formats
