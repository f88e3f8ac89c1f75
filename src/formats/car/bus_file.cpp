// SPDX-License-Identifier: Apache-2.0
#include "formats/car/bus_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/text.h"
#include "base/units.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

using multibody::BushingParameters;
using multibody::ForceCharacteristic;

constexpr std::array<const char*, 6> kBusAxes = {"FX", "FY", "FZ", "TX", "TY", "TZ"};
constexpr std::array<const char*, 6> kBusAxesInWords = {
    "x", "y", "z", "about x", "about y", "about z"};
// deviation of a curve from a straight line, over the largest force, below which the curve counts
// as straight
constexpr double kStraight = 1e-9;

/// Factors that convert deflection and force in the rows of a curve to SI.
struct BusScale {
  double deflection, force;
};

BusScale bus_scale_of(std::size_t axis, const TeimOrbitUnits& units) {
  if (axis < 3) return {units.length(), units.force()};
  return {units.angle(), units.force() * units.length()};
}

/// Throws InputError if the column heads name a force before the deflection.
void refuse_exchanged_columns(const TeimOrbitSection& section, const TeimOrbitTable& table) {
  if (table.heads.size() < 2) return;
  const auto is_force = [](const std::string& head) {
    return head.starts_with("FORCE") || head.starts_with("TORQUE") || head.starts_with("MOMENT") ||
           (head.size() <= 2 && (head.front() == 'F' || head.front() == 'T'));
  };
  if (!is_force(table.heads[0]) || is_force(table.heads[1])) return;
  throw InputError(section.place(table.line),
                   fmt::format("the columns are {{{}}}, expected the deflection before the force: "
                               "exchange the columns",
                               fmt::join(table.heads, " ")));
}

std::vector<ForceCharacteristic::Point> read_points(const TeimOrbitSection& section,
                                                    const BusScale& scale) {
  std::vector<ForceCharacteristic::Point> points;
  const TeimOrbitTable* table = section.find_table("");
  if (table) refuse_exchanged_columns(section, *table);
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
    const ForceCharacteristic::Point point(numbers[0] * scale.deflection, numbers[1] * scale.force);
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
std::optional<double> straight(const std::vector<ForceCharacteristic::Point>& points) {
  double largest = 0.0;
  ForceCharacteristic::Point far{0.0, 0.0};
  for (const ForceCharacteristic::Point& point : points) {
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
              const std::vector<ForceCharacteristic::Point>& points,
              double damping) {
  const auto i = static_cast<Eigen::Index>(axis % 3);
  const std::optional<double> k = straight(points);
  (axis < 3 ? bushing.stiffness : bushing.rotational)[i] = k.value_or(0.0);
  (axis < 3 ? bushing.damping : bushing.rotational_damping)[i] = damping;
  if (!k)
    bushing.parts.push_back(
        {static_cast<int>(axis), multibody::ElasticCurve{ForceCharacteristic(points)}});
}

/// Returns the curve of an axis as points. Throws InputError if the axis has other elastic or
/// friction parts, which a .bus file cannot express.
std::vector<ForceCharacteristic::Point> points_of(const BushingParameters& bushing,
                                                  std::size_t axis,
                                                  const std::string& name) {
  // Ranges of the curve that is written for a stiffness. They are powers of two, so that the
  // stiffness is read back to the last bit.
  const double reach = axis < 3 ? 1.0 / 128.0 : 1.0 / 8.0;  // m, rad
  const double k = (axis < 3 ? bushing.stiffness : bushing.rotational)[static_cast<int>(axis % 3)];
  std::vector<ForceCharacteristic::Point>
      points;  // five points on a straight line, because a spline needs several
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

/// Returns the unit of an axis in the file's own words, such as "newton*mm".
std::string unit_in_words(const TeimOrbitSection& units, const char* key) {
  return units.text(key, "");
}

LedgerRow row_of(const std::string& written, int line, const std::string& taken_as) {
  LedgerRow row;
  row.written = written;
  row.line = line;
  row.taken_as = taken_as;
  Ledger::use(row, "bushing");
  return row;
}

/// Adds a doubt if a curve reaches a deflection that no bushing has, because a unit in [UNITS] is
/// then wrong.
void doubt_reach(const TeimOrbitSection& section,
                 std::size_t axis,
                 const std::vector<ForceCharacteristic::Point>& points,
                 Ledger& ledger) {
  // m; ten times the largest deflection of the softest rubber mounts
  constexpr double kFarthest = 0.3;
  constexpr double kMostTurn = 3.2;  // rad, 180 degrees
  const double most = std::max(std::abs(points.front().first), std::abs(points.back().first));
  if (most <= (axis < 3 ? kFarthest : kMostTurn)) return;
  ledger.doubts.push_back({"[" + section.name() + "]",
                           fmt::format("[{}] reaches {}, which no bushing does: is {} of [UNITS] "
                                       "right?",
                                       section.name(),
                                       format_quantity(most, axis < 3 ? "m" : "rad", 4),
                                       axis < 3 ? "LENGTH" : "ANGLE"),
                           section.place()});
}

/// Adds doubts about a curve whose force resists as a whole but not everywhere.
void doubt_curve(const TeimOrbitSection& section,
                 std::size_t axis,
                 const std::vector<ForceCharacteristic::Point>& points,
                 Ledger& ledger) {
  double largest = 0.0;
  for (const ForceCharacteristic::Point& point : points)
    largest = std::max(largest, std::abs(point.second));
  const std::string name = "[" + section.name() + "]";
  const char* unit = axis < 3 ? "N" : "N m";
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].second < points[i - 1].second) {
      const int line = section.find_table("")->rows[i].line;
      ledger.doubts.push_back(
          {name,
           fmt::format("{} falls from {} to {} while the deflection rises: a bushing whose "
                       "stiffness is negative there; is a sign wrong?",
                       name,
                       format_quantity(points[i - 1].second, unit, 4),
                       format_quantity(points[i].second, unit, 4)),
           section.place(line)});
      break;
    }
  if (points.front().first > 0.0 || points.back().first < 0.0) {
    ledger.doubts.push_back({name,
                             name + " does not contain the deflection 0: the bushing at rest is "
                                    "on the straight continuation of the curve",
                             section.place()});
    return;
  }
  const double at_rest = ForceCharacteristic(points).at(0.0);
  // share of the largest force; a smaller force at rest is rounding
  constexpr double kPreload = 1e-6;
  if (std::abs(at_rest) > kPreload * largest)
    ledger.doubts.push_back({name,
                             fmt::format("{} has {} at the deflection 0: a preload, which moves "
                                         "the suspension at rest",
                                         name,
                                         format_quantity(at_rest, unit, 4)),
                             section.place()});
}

void add_unused(const std::vector<TeimOrbitPart>& unused, const std::string& file, Ledger& ledger) {
  for (const TeimOrbitPart& part : unused) {
    LedgerRow row;
    row.written = part.name;
    row.line = part.line;
    row.remark = "not read here";
    ledger.rows.push_back(std::move(row));
    ledger.doubts.push_back(
        {part.name,
         part.name + " is not read: the bushing is as if the file did not contain it",
         Place{file, part.line}});
  }
}

class BusReading {
 public:
  explicit BusReading(const TeimOrbit& file)
      : file_(file), units_(file.units()), stated_(file.section("UNITS")) {
    result_.ledger.file = file.file();
  }

  BusFile run() {
    for (const char* key : {"LENGTH", "ANGLE", "FORCE", "MASS", "TIME"})
      if (const TeimOrbitEntry* entry = stated_.find(key)) {
        LedgerRow row = row_of(std::string("[UNITS] ") + key, entry->line, "unit");
        row.meaning = entry->value;
        result_.ledger.rows.push_back(std::move(row));
      }
    const TeimOrbitSection& dampings = file_.section("DAMPING");
    for (std::size_t axis = 0; axis < kBusAxes.size(); ++axis) read_axis(axis, dampings);
    result_.unused = file_.unread();
    add_unused(result_.unused, file_.file(), result_.ledger);
    return std::move(result_);
  }

 private:
  void read_axis(std::size_t axis, const TeimOrbitSection& dampings) {
    const std::string name = std::string(kBusAxes[axis]) + "_CURVE",
                      key = std::string(kBusAxes[axis]) + "_DAMPING";
    const double damping = read_damping(axis, dampings, key);
    const BusScale scale = bus_scale_of(axis, units_);
    const TeimOrbitSection& section = file_.section(name);
    const std::vector<ForceCharacteristic::Point> points = read_points(section, scale);
    set_axis(result_.bushing, axis, points, damping);
    const std::string along = (axis < 3 ? "along " : "") + std::string(kBusAxesInWords[axis]);
    LedgerRow row = row_of("[" + name + "]", section.place().line, "spring " + along);
    row.unit_written = unit_of_curve(axis);
    row.unit = axis < 3 ? "N/m" : "N m/rad";
    row.factor = scale.force / scale.deflection;
    result_.ledger.rows.push_back(std::move(row));
    result_.ledger.rows.push_back(
        row_of("[DAMPING] " + key, dampings.find(key)->line, "damper " + along));
    doubt_reach(section, axis, points, result_.ledger);
    doubt_curve(section, axis, points, result_.ledger);
  }

  /// A damping of 0 is 0 in any unit, so only other values need the unit TIME.
  double read_damping(std::size_t axis, const TeimOrbitSection& dampings, const std::string& key) {
    const double written = dampings.number(key);
    double damping = 0.0;
    if (written != 0.0) {
      const BusScale scale = bus_scale_of(axis, units_);
      damping = written * (scale.force * units_.time() / scale.deflection);
    }
    if (!(damping >= 0.0) || !std::isfinite(damping))
      throw InputError(dampings.place(dampings.find(key)->line),
                       fmt::format("{} is {}, expected a finite number that is not negative",
                                   key,
                                   dampings.find(key)->value));
    return damping;
  }

  std::string unit_of_curve(std::size_t axis) const {
    const std::string length = unit_in_words(stated_, "LENGTH"),
                      force = unit_in_words(stated_, "FORCE");
    if (axis < 3) return force + "/" + length;
    return force + "*" + length + "/" + unit_in_words(stated_, "ANGLE");
  }

  const TeimOrbit& file_;
  TeimOrbitUnits units_;
  const TeimOrbitSection& stated_;
  BusFile result_;
};

void refuse_other_type(const TeimOrbit& file) {
  const TeimOrbitSection& header = file.section("MDI_HEADER");
  if (const std::string type = header.text("FILE_TYPE"); lower(type) != "bus")
    throw InputError(header.place(header.find("FILE_TYPE")->line),
                     "FILE_TYPE is " + in_quotes(type) + ", expected \"bus\"");
}

}  // namespace

BusFile bus_file_from(const TeimOrbit& file) {
  refuse_other_type(file);
  // throws, with the lines that the user has to add
  if (!file.find("UNITS")) file.units().length();
  return BusReading(file).run();
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
