// SPDX-License-Identifier: Apache-2.0
#include "formats/road/open_crg_contradictions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.h"

namespace latsch::formats {
namespace {

using Eigen::Vector2d;
using Kind = OpenCrgHeader::Channel::Kind;

// Largest differences that are accepted between two statements of the same quantity, which arise
// because files contain few digits and programs integrate differently.
constexpr double kOfSpacing = 1e-2;  // share of the spacing of the rows or sections
// share of the spacing if it follows from points; OpenCRG allows 3 %
constexpr double kOfPoints = 5e-2;
constexpr double kOfLength = 1e-2;  // share of the length of the reference line
constexpr double kAngle = 1e-2;     // rad; the same value is used for slopes
constexpr double kHeight = 1e-3;    // m
constexpr double kMostTurns = 1.0;  // largest heading, in turns
constexpr double kSteepest = 1.0;   // largest slope, m/m

class Contradictions {
 public:
  Contradictions(OpenCrgHeader& header, const OpenCrgRecords& records, const road::CrgGrid& grid)
      : header_(header), records_(records), grid_(grid), rows_(grid.rows()) {}

  void run() {
    doubt_sizes();
    compare_rows();
    compare_sections();
    compare_points();
    compare_headings();
    compare_heights();
    compare_globe();
  }

 private:
  void warn(int line, const std::string& file, const std::string& text) {
    header_.warnings.push_back(fmt::format("{}:{}: {}", file, line, text));
  }

  /// Warns of headings and slopes that are probably stated in degrees or percent; the units of the
  /// standard are rad and m/m.
  void doubt_sizes() {
    const double pi = std::numbers::pi;
    for (const auto& [name, value] : header_.road) {
      const double size = std::abs(value.number);
      const bool is_heading = name.ends_with("_phi");
      const bool is_slope =
          name.starts_with("reference_line_") && (name.ends_with("_s") || name.ends_with("_b"));
      if (is_heading && size > kMostTurns * 2.0 * pi)
        warn(value.line,
             value.file,
             fmt::format("{} is {} rad, {:.3g} turns: is it in degrees?",
                         name,
                         format_number(value.number),
                         size / (2.0 * pi)));
      if (is_slope && size > kSteepest)
        warn(value.line,
             value.file,
             fmt::format("{} is {} m/m, steeper than 45 deg: is it in per cent?",
                         name,
                         format_number(value.number)));
      const bool is_latitude = name.ends_with("_lat"), is_longitude = name.ends_with("_lon");
      if ((is_latitude && size > 90.0) || (is_longitude && size > 180.0))
        warn(value.line,
             value.file,
             fmt::format("{} is {} deg, which no place on the globe has",
                         name,
                         format_number(value.number)));
    }
    for (const auto& [kind, name] : {std::pair{Kind::slope, "slope"}, {Kind::banking, "banking"}}) {
      if (!has(kind)) continue;
      double most = 0.0;
      for (int row = 1; row < rows_; ++row) most = std::max(most, std::abs(at(kind, row)));
      const auto& channel = header_.channels[static_cast<std::size_t>(column_of(kind))];
      if (most > kSteepest)
        warn(
            channel.line,
            header_.file,
            fmt::format("channel {} goes up to {:.3g} m/m, steeper than 45 deg: is it in per cent?",
                        name,
                        most));
    }
  }

  /// Warns if the value in block $ROAD_CRG differs by more than `slack` from the value `counts`,
  /// which is the one used.
  void compare(const char* name, double counts, double slack, const std::string& source) {
    const auto stated = header_.road.find(name);
    if (stated == header_.road.end()) return;
    const double value = stated->second.number;
    if (std::abs(value - counts) <= slack + 1e-6 * std::abs(value)) return;
    warn(stated->second.line,
         stated->second.file,
         fmt::format("{} is {}, but it is {} by {}, which counts",
                     name,
                     format_number(value),
                     format_number(counts, 6),
                     source));
  }

  void compare_angle(const char* name, double counts, double slack, const std::string& source) {
    const auto stated = header_.road.find(name);
    if (stated == header_.road.end()) return;
    const double off = std::remainder(stated->second.number - counts, 2.0 * std::numbers::pi);
    compare(name, stated->second.number - off, slack, source);
  }

  int column_of(Kind kind) const {
    for (std::size_t i = 0; i < header_.channels.size(); ++i)
      if (header_.channels[i].kind == kind) return static_cast<int>(i);
    return -1;
  }
  bool has(Kind kind) const { return column_of(kind) >= 0; }
  bool has_road(const char* name) const { return header_.road.contains(name); }
  double road(const char* name) const { return header_.value(header_.road, name, 0.0); }

  /// Returns the value of a channel in a row; NaN if there is none.
  double at(Kind kind, int row) const {
    return records_.at(std::min(row, rows_ - 1), static_cast<std::size_t>(column_of(kind)));
  }

  double length() const { return grid_.u_increment * (rows_ - 1); }

  void compare_rows() {
    const double slack = kOfSpacing * grid_.u_increment;
    if (has(Kind::u)) {
      compare("reference_line_start_u", grid_.u_begin, slack, "channel u");
      compare("reference_line_end_u", grid_.u_end(), slack, "channel u");
      compare("reference_line_increment", grid_.u_increment, slack, "channel u");
    } else if (has(Kind::x)) {
      compare("reference_line_increment",
              grid_.u_increment,
              kOfPoints * grid_.u_increment,
              "the points of channels x and y");
    }
    if (!header_.virtual_u) return;
    const auto& [begin, step, line] = *header_.virtual_u;
    if (std::abs(begin - grid_.u_begin) <= slack && std::abs(step - grid_.u_increment) <= slack)
      return;
    warn(line,
         header_.file,
         fmt::format("the virtual channel u begins at {} with steps of {}, but the road at {} with "
                     "steps of {}, which count",
                     format_number(begin),
                     format_number(step),
                     format_number(grid_.u_begin, 6),
                     format_number(grid_.u_increment, 6)));
  }

  void compare_sections() {
    const auto& v = grid_.v;
    double least = HUGE_VAL;
    for (std::size_t i = 1; i < v.size(); ++i) least = std::min(least, v[i] - v[i - 1]);
    const double slack = kOfSpacing * least;
    if (!has(Kind::section_place)) {
      compare("long_section_v_left",
              v.back(),
              slack,
              "long_section_v_right, long_section_v_increment and the number of sections");
      return;
    }
    const char* places = "the positions of the long sections";
    compare("long_section_v_right", v.front(), slack, places);
    compare("long_section_v_left", v.back(), slack, places);
    if (!has_road("long_section_v_increment")) return;
    double worst = least;
    for (std::size_t i = 1; i < v.size(); ++i) {
      const double step = v[i] - v[i - 1], stated = road("long_section_v_increment");
      if (std::abs(step - stated) > std::abs(worst - stated)) worst = step;
    }
    compare("long_section_v_increment", worst, slack, places);
  }

  void compare_points() {
    if (has(Kind::x)) {
      const double slack = kOfSpacing * grid_.u_increment;
      const Vector2d first = grid_.line.front(), last = grid_.line.back();
      compare("reference_line_start_x", first.x(), slack, "channel x");
      compare("reference_line_start_y", first.y(), slack, "channel y");
      compare("reference_line_end_x", last.x(), slack, "channel x");
      compare("reference_line_end_y", last.y(), slack, "channel y");
      return;
    }
    // If headings and the end point are both stated, the line is drawn to this end point, and the
    // difference is spread along the line.
    const bool has_end = has_road("reference_line_end_x") && has_road("reference_line_end_y");
    const bool is_spread = has(Kind::phi) && has_end;
    const Vector2d last = is_spread ? end_by_headings() : grid_.line.back();
    if (!is_spread) {
      const char* line = "start, heading and length of the reference line";
      compare("reference_line_end_x", last.x(), kOfLength * length(), line);
      compare("reference_line_end_y", last.y(), kOfLength * length(), line);
      return;
    }
    const Vector2d end(road("reference_line_end_x"), road("reference_line_end_y"));
    const double gap = (end - last).norm();
    if (gap <= kOfLength * length()) return;
    const auto& stated = header_.road.find("reference_line_end_x")->second;
    warn(stated.line,
         stated.file,
         fmt::format("the end of the reference line is stated {:.3g} m from that by channel phi: "
                     "the difference is spread over the {:.4g} m of the line",
                     gap,
                     length()));
  }

  Vector2d end_by_headings() const {
    Vector2d point = grid_.line.front();
    for (int row = 1; row < rows_; ++row) {
      const double phi = at(Kind::phi, row);
      point += grid_.u_increment * Vector2d(std::cos(phi), std::sin(phi));
    }
    return point;
  }

  double direction(int row) const {
    const Vector2d along =
        grid_.line[static_cast<std::size_t>(row)] - grid_.line[static_cast<std::size_t>(row) - 1];
    return std::atan2(along.y(), along.x());
  }

  /// Compares the stated headings with those of the first and last interval of the line. The turn
  /// within such an interval is accepted.
  void compare_headings() {
    const bool by_points = has(Kind::x);
    if (!by_points && !has(Kind::phi)) return;
    const char* source = by_points ? "channels x and y" : "channel phi";
    const auto heading = [&](int row) { return by_points ? direction(row) : at(Kind::phi, row); };
    const auto turn = [&](int row) {
      return std::abs(std::remainder(heading(row + 1) - heading(row), 2.0 * std::numbers::pi));
    };
    const double first = rows_ > 2 ? turn(1) : 0.0, last = rows_ > 2 ? turn(rows_ - 2) : 0.0;
    compare_angle("reference_line_start_phi", heading(1), kAngle + 2.0 * first, source);
    if (by_points)  // headings of channel phi are compared in open_crg_checks.h
      compare_angle("reference_line_end_phi", heading(rows_ - 1), kAngle + 2.0 * last, source);
    if (!by_points || !has(Kind::phi)) return;
    double most = 0.0;
    for (int row = 1; row < rows_; ++row) {
      const double off =
          std::remainder(at(Kind::phi, row) - direction(row), 2.0 * std::numbers::pi);
      if (std::isfinite(off)) most = std::max(most, std::abs(off));
    }
    const auto& channel = header_.channels[static_cast<std::size_t>(column_of(Kind::phi))];
    if (most > kAngle + 2.0 * std::max(first, last))
      warn(channel.line,
           header_.file,
           fmt::format("channel phi differs by up to {:.3g} rad from the points of channels x and "
                       "y, which count",
                       most));
  }

  void compare_heights() {
    if (has(Kind::slope))
      compare("reference_line_start_s", at(Kind::slope, 1), kAngle, "channel slope");
    if (has(Kind::banking))
      compare("reference_line_start_b", at(Kind::banking, 0), kAngle, "channel banking");
    const double start = road("reference_line_start_z");
    double rise = 0.0;
    bool is_level = true;
    for (int row = 1; row < rows_; ++row) {
      const double slope = has(Kind::slope) ? at(Kind::slope, row) : road("reference_line_start_s");
      rise += slope * grid_.u_increment;
      is_level = is_level && slope == 0.0;
    }
    if (is_level)
      return compare("reference_line_end_z", start, kHeight, "its start and a slope of 0");
    const double gap = road("reference_line_end_z") - start - rise;
    if (!has_road("reference_line_end_z") || std::abs(gap) <= kHeight + kOfLength * std::abs(rise))
      return;
    const auto& stated = header_.road.find("reference_line_end_z")->second;
    warn(stated.line,
         stated.file,
         fmt::format("reference_line_end_z is {}, but the slope leads to {:.4g} m: the difference "
                     "is spread over the {:.4g} m of the line",
                     format_number(stated.number),
                     start + rise,
                     length()));
  }

  /// Compares the distance of start and end on the globe with the length of the line, which is at
  /// least that distance.
  void compare_globe() {
    for (const char* end : {"start", "end"})
      for (const char* angle : {"lat", "lon"})
        if (!has_road(fmt::format("reference_line_{}_{}", end, angle).c_str())) return;
    constexpr double kRadius = 6.371e6;                      // m, mean radius of the earth
    constexpr double kOfGlobe = 1e-2, kLeastOfGlobe = 10.0;  // share; m, as few digits are usual
    const auto radians = [&](const char* name) { return road(name) * std::numbers::pi / 180.0; };
    const double first = radians("reference_line_start_lat"),
                 last = radians("reference_line_end_lat"),
                 east = radians("reference_line_end_lon") - radians("reference_line_start_lon");
    // haversine formula
    const double h = std::pow(std::sin((last - first) / 2.0), 2) +
                     std::cos(first) * std::cos(last) * std::pow(std::sin(east / 2.0), 2);
    const double apart = 2.0 * kRadius * std::asin(std::min(1.0, std::sqrt(std::abs(h))));
    if (apart <= length() * (1.0 + kOfGlobe) + kLeastOfGlobe) return;
    const auto& stated = header_.road.find("reference_line_end_lat")->second;
    warn(stated.line,
         stated.file,
         fmt::format("start and end of the reference line are {:.4g} m apart by latitude and "
                     "longitude, but the line is {:.4g} m long: its length counts, and the "
                     "position on the globe does not",
                     apart,
                     length()));
  }

  OpenCrgHeader& header_;
  const OpenCrgRecords& records_;
  const road::CrgGrid& grid_;
  int rows_;
};

}  // namespace

void warn_of_contradictions(OpenCrgHeader& header,
                            const OpenCrgRecords& records,
                            const road::CrgGrid& grid) {
  Contradictions(header, records, grid).run();
}

}  // namespace latsch::formats
