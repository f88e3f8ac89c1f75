// SPDX-License-Identifier: Apache-2.0
#include "formats/car/car_file_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/units.h"

namespace latsch::formats {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Describes a curve of force over a deflection or a velocity for the check of its signs: keys,
/// units and the words of the messages.
struct SignedCurve {
  const char *key, *x_unit, *y_unit;
  const char* moves;  // "the velocity"
  // predicate of the message if the curve falls: "the damping is negative there"
  const char* falls_to;
};
constexpr SignedCurve kDamper{
    "damper", "m/s", "N", "the velocity", "it adds energy there, instead of damping"};
constexpr SignedCurve kSpring{
    "curve", "m", "N", "the extension", "it pushes on in the direction in which it is moved"};

class CarFileDoubts {
 public:
  std::vector<LedgerDoubt> run(const Node& root) {
    if (!root.has("kind")) return {};
    const std::string kind = root.text("kind");
    if (kind == "car") {
      for (const char* axle : {"front", "rear"}) check_axle(root, axle);
      check_aero(root);
    }
    if (kind != "suspension") return std::move(doubts_);
    check_caster(root);
    if (root.has("bushing"))
      for (const Node& bushing : root.named_tables("bushing")) check_bushing(bushing);
    return std::move(doubts_);
  }

 private:
  void doubt(const Node& node, const char* key, const std::string& sentence) {
    const std::string name = node.path().empty() ? key : node.path() + "." + key;
    doubts_.push_back({name, name + " " + sentence, node.place(key)});
  }

  /// Returns the rows of a key in SI; empty if the reader of the model will refuse them.
  static Rows rows_of(const Node& node, const char* key, const std::vector<std::string>& units) {
    if (!node.has(key)) return {};
    try {
      return node.rows(key, units);
    } catch (const InputError&) {
      return {};
    }
  }

  void check_axle(const Node& root, const char* axle) {
    const auto node = root.find_table(axle);
    if (!node) return;
    for (const char* part : {"spring", "third"}) {
      const auto unit = node->find_table(part);
      if (!unit) continue;
      check_damper(*unit);
      check_spring(*unit);
    }
  }

  /// Adds a doubt if the curve falls somewhere; returns true in that case.
  bool check_rise(const Node& node, const SignedCurve& curve, const Rows& rows) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
      if (!(rows[i][1] < rows[i - 1][1])) continue;
      doubt(node,
            curve.key,
            fmt::format("falls from {} at {} to {} at {}, while {} rises: {}; is a sign wrong?",
                        format_quantity(rows[i - 1][1], curve.y_unit, 4),
                        format_quantity(rows[i - 1][0], curve.x_unit, 4),
                        format_quantity(rows[i][1], curve.y_unit, 4),
                        format_quantity(rows[i][0], curve.x_unit, 4),
                        curve.moves,
                        curve.falls_to));
      return true;
    }
    return false;
  }

  void check_damper(const Node& unit) {
    const Rows rows = rows_of(unit, "damper", {"m/s", "N"});
    if (rows.size() < 2 || check_rise(unit, kDamper, rows)) return;
    double most = 0.0, at_rest = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      most = std::max(most, std::abs(rows[i][1]));
      if (i == 0 || rows[i - 1][0] > 0.0 || rows[i][0] < 0.0) continue;
      const double part = -rows[i - 1][0] / (rows[i][0] - rows[i - 1][0]);
      at_rest = rows[i - 1][1] + part * (rows[i][1] - rows[i - 1][1]);
    }
    constexpr double kAtRest = 1e-3;  // share of the largest force
    if (std::abs(at_rest) > kAtRest * most)
      doubt(unit,
            "damper",
            fmt::format("has {} at rest: a preload, as by gas, which moves the car at rest; a "
                        "damper alone has none",
                        format_quantity(at_rest, "N", 4)));
  }

  void check_spring(const Node& unit) {
    const Rows rows = rows_of(unit, "curve", {"m", "N"});
    if (rows.size() < 2 || check_rise(unit, kSpring, rows)) return;
    double compressed = 0.0, extended = 0.0;
    for (const auto& row : rows)
      (row[0] < 0.0 ? compressed : extended) =
          std::max(row[0] < 0.0 ? compressed : extended, std::abs(row[1]));
    if (compressed == 0.0 && extended > 0.0)
      doubt(unit,
            "curve",
            "acts in extension alone, as a stop in droop does: extension is positive, so a bump "
            "stop has negative deflections and forces");
  }

  /// Adds a doubt about a caster below 0, which suggests the axes of Adams, whose x points
  /// rearward.
  void check_caster(const Node& root) {
    const auto points = root.find_table("hardpoint");
    if (!points) return;
    const auto upper = place_of(*points, "ubj"), lower = place_of(*points, "lbj");
    if (upper.size() != 3 || lower.size() != 3 || !(upper[2] > lower[2])) return;
    constexpr double kDegree = std::numbers::pi / 180.0;
    constexpr double kLeast = -1.0;  // degrees; a slightly negative caster is intended
    const double caster = std::atan2(lower[0] - upper[0], upper[2] - lower[2]) / kDegree;
    if (caster >= kLeast) return;
    doubt(*points,
          "ubj",
          fmt::format("is {} before lbj: a caster of {:.2g} deg, where nearly all suspensions have "
                      "a positive one. Do the points have axes of Adams (x rearward, y to the "
                      "right)? Here x points forward and y to the left",
                      format_quantity(upper[0] - lower[0], "m", 3),
                      caster));
  }

  static std::vector<double> place_of(const Node& points, const char* key) {
    if (!points.has(key)) return {};
    try {
      return points.quantities(key, "m");
    } catch (const InputError&) {
      return {};
    }
  }

  void check_bushing(const Node& bushing) {
    const auto curves = bushing.find_table("curve");
    if (!curves) return;
    for (const char* axis : {"x", "y", "z", "about_x", "about_y", "about_z"}) {
      const bool turns = axis[1] == 'b';
      const SignedCurve curve{axis,
                              turns ? "rad" : "m",
                              turns ? "N m" : "N",
                              "the deflection",
                              "the stiffness is negative there"};
      check_rise(*curves, curve, rows_of(*curves, axis, {curve.x_unit, curve.y_unit}));
    }
  }

  void check_aero(const Node& root) {
    const auto aero = root.find_table("aero");
    if (!aero) return;
    const Rows rows = rows_of(*aero, "map", {"m", "m", "1", "1"});
    const auto lifts = [](const std::vector<double>& row) { return row[2] < 0.0 || row[3] < 0.0; };
    const auto count = std::count_if(rows.begin(), rows.end(), lifts);
    if (count == 0) return;
    const auto& first = *std::find_if(rows.begin(), rows.end(), lifts);
    doubt(*aero,
          "map",
          fmt::format("has a coefficient below 0 in {} of {} rows, first {:g} in front and {:g} at "
                      "the rear: the air lifts the car there, because downforce is positive; is "
                      "the map one of lift coefficients?",
                      count,
                      rows.size(),
                      first[2],
                      first[3]));
  }

  std::vector<LedgerDoubt> doubts_;
};

}  // namespace

std::vector<LedgerDoubt> doubts_of_car_file(const Node& root) { return CarFileDoubts().run(root); }

}  // namespace latsch::formats
