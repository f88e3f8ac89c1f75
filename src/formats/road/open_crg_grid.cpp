// SPDX-License-Identifier: Apache-2.0
#include "formats/road/open_crg_grid.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace latsch::formats {
namespace {

using Eigen::Vector2d;
using road::CrgGrid;
using Kind = OpenCrgHeader::Channel::Kind;

constexpr double kDefaultIncrement = 0.01;  // m, default of OpenCRG along u and v
constexpr double kLeastSpacing = 1e-6;      // m, least value allowed by OpenCRG
// relative tolerance that OpenCRG allows for the spacing of the points of the reference line
constexpr double kEvenLine = 3e-2;
constexpr double kLargestPlace = 1e9;  // m; no road is longer, no position farther away
constexpr double kMostRows = 1e8;

Vector2d direction(double phi) { return {std::cos(phi), std::sin(phi)}; }

class GridBuilding {
 public:
  GridBuilding(const OpenCrgHeader& header, const OpenCrgRecords& records)
      : header_(header), records_(records) {}

  CrgGrid run(int& gaps) {
    read_u();
    read_v();
    read_line();
    read_heights();
    scale_grid();
    gaps = fill_gaps();
    read_options();
    move();
    return std::move(grid_);
  }

 private:
  double road(const char* name, double fallback) const {
    return header_.value(header_.road, name, fallback);
  }
  bool has_road(const char* name) const { return header_.road.contains(name); }
  double modifier(const char* name, double fallback) const {
    return header_.value(header_.modifiers, name, fallback);
  }
  bool has_modifier(const char* name) const { return header_.modifiers.contains(name); }

  [[noreturn]] void fail(const std::string& message, int line = 0) const {
    throw InputError({header_.file, line}, message);
  }

  int column_of(Kind kind) const {
    for (std::size_t i = 0; i < header_.channels.size(); ++i)
      if (header_.channels[i].kind == kind) return static_cast<int>(i);
    return -1;
  }

  /// Returns the values of a channel, empty if the file has none. `first` is the first row in which
  /// a value is required.
  std::vector<double> column(Kind kind, const char* name, int first = 0) const {
    const int at = column_of(kind);
    if (at < 0) return {};
    std::vector<double> values(records_.rows);
    for (int row = 0; row < records_.rows; ++row) {
      values[row] = records_.at(row, at);
      if (row >= first && !(std::abs(values[row]) < kLargestPlace)) {
        const bool binary = header_.format.size() > 2 && header_.format[2] == 'B';
        fail(fmt::format("record {} has no {} of the reference line{}",
                         row + 1,
                         name,
                         binary ? ": binary data are damaged if a program has converted their "
                                  "line ends like those of a text"
                                : ""));
      }
    }
    return values;
  }

  void read_u() {
    const std::vector<double> u = column(Kind::u, "u");
    grid_.u_begin = road("reference_line_start_u", u.empty() ? 0.0 : u.front());
    grid_.u_increment = road("reference_line_increment", kDefaultIncrement);
    if (!u.empty()) {
      grid_.u_begin = u.front();
      grid_.u_increment = (u.back() - u.front()) / (records_.rows - 1);
      for (int row = 1; row < records_.rows; ++row) {
        const double step = u[row] - u[row - 1];
        if (!(std::abs(step - grid_.u_increment) <= kEvenLine * grid_.u_increment)) {
          fail(fmt::format("record {} is {} m in u behind the one before, expected {} m",
                           row + 1,
                           step,
                           grid_.u_increment));
        }
      }
    }
    grid_.u_increment *= positive_scale("scale_length");
    if (!(grid_.u_increment >= kLeastSpacing)) {
      fail(fmt::format("has rows every {} m, expected at least 1e-6 m", grid_.u_increment));
    }
    if (!(std::abs(grid_.u_begin) + grid_.u_increment * records_.rows < kLargestPlace)) {
      fail("goes further than 1e9 m");
    }
  }

  double positive_scale(const char* name) const {
    const double scale = modifier(name, 1.0);
    if (scale <= 0.0 || scale > kLargestPlace) {
      header_.reject(header_.modifiers, name, "expected a number above 0");
    }
    return scale;
  }

  /// Reads the positions of the sections and the channel of each, both from right to left.
  void read_v() {
    const auto& channels = header_.channels;
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (channels[i].kind > Kind::section_place) continue;
      if (!sections_.empty() && channels[i].kind != channels[sections_.front()].kind) {
        fail("is a section by number among sections by position, expected all alike",
             channels[i].line);
      }
      sections_.push_back(i);
    }
    if (sections_.size() < 2) {
      fail(fmt::format("has {} long sections, expected at least 2", sections_.size()));
    }
    std::stable_sort(sections_.begin(), sections_.end(), [&](std::size_t a, std::size_t b) {
      return channels[a].place < channels[b].place;
    });
    const bool by_number = channels[sections_.front()].kind == Kind::section_number;
    const double first = by_number ? first_v() : 0.0;
    const double step = by_number ? road("long_section_v_increment", default_v_step()) : 1.0;
    const double scale = positive_scale("scale_width");
    for (std::size_t i = 0; i < sections_.size(); ++i) {
      const auto& channel = channels[sections_[i]];
      if (by_number && channel.place != static_cast<double>(i + 1)) {
        fail(fmt::format("long section {} is missing or comes twice", i + 1), channel.line);
      }
      const double place = by_number ? first + step * static_cast<double>(i) : channel.place;
      grid_.v.push_back(scale * place);
      if (!(std::abs(grid_.v[i]) < kLargestPlace)) fail("is a section too far aside", channel.line);
      if (i > 0 && !(grid_.v[i] - grid_.v[i - 1] >= kLeastSpacing)) {
        fail("is a long section less than 1e-6 m beside another", channel.line);
      }
    }
  }

  double default_v_step() const {
    if (!has_road("long_section_v_right") || !has_road("long_section_v_left")) {
      return kDefaultIncrement;
    }
    return (road("long_section_v_left", 0.0) - road("long_section_v_right", 0.0)) /
           static_cast<double>(sections_.size() - 1);
  }

  double first_v() const {
    const double width = road("long_section_v_increment", default_v_step()) *
                         static_cast<double>(sections_.size() - 1);
    if (has_road("long_section_v_right")) return road("long_section_v_right", 0.0);
    return road("long_section_v_left", width / 2.0) - width;
  }

  void read_line() {
    grid_.line.resize(records_.rows);
    const auto x = column(Kind::x, "x"), y = column(Kind::y, "y");
    if (x.empty() != y.empty()) fail("has one of the channels x and y, expected both or none");
    if (!x.empty()) {
      for (int row = 0; row < records_.rows; ++row) grid_.line[row] = {x[row], y[row]};
      check_spacing();
      return;
    }
    const Vector2d begin(road("reference_line_start_x", 0.0), road("reference_line_start_y", 0.0));
    const bool has_end = has_road("reference_line_end_x") && has_road("reference_line_end_y");
    const Vector2d end(road("reference_line_end_x", 0.0), road("reference_line_end_y", 0.0));
    for (const double place : {begin.x(), begin.y(), end.x(), end.y()}) {
      if (std::abs(place) > kLargestPlace) fail("has a reference line further away than 1e9 m");
    }
    std::vector<double> phi = column(Kind::phi, "phi", 1);
    const bool bent = !phi.empty();
    if (!bent) {
      double heading = road("reference_line_start_phi", 0.0);
      if (has_end && !has_road("reference_line_start_phi")) {
        heading = std::atan2(end.y() - begin.y(), end.x() - begin.x());
      }
      phi.assign(records_.rows, heading);
    }
    const double curvature = modifier("scale_curvature", 1.0);
    const double first = road("reference_line_start_phi", phi[1]);
    for (double& heading : phi) heading = first + curvature * (heading - first);
    const bool changed = has_modifier("scale_curvature") || has_modifier("scale_length");
    sum_headings(phi, begin, bent && has_end && !changed ? &end : nullptr);
  }

  /// Sums the headings forward to the points of the line. If there is a stated end, blends these
  /// points with the backward sums from that end.
  void sum_headings(const std::vector<double>& phi, const Vector2d& begin, const Vector2d* end) {
    const double step = grid_.u_increment;
    const int last = records_.rows - 1;
    grid_.line[0] = begin;
    for (int i = 1; i <= last; ++i) grid_.line[i] = grid_.line[i - 1] + step * direction(phi[i]);
    if (!end) return;
    // The sum from the end and that from the start differ by the same vector at all points, which
    // is the gap at the end.
    const Vector2d gap = *end - grid_.line[last];
    if (gap.norm() > 0.1 * step * last) {
      fail(
          fmt::format("has a reference line that ends {:.3g} m from the end that the header "
                      "states",
                      gap.norm()));
    }
    const std::vector<Vector2d> forward = grid_.line;
    for (int i = 1; i <= last; ++i) {
      const double part = static_cast<double>(i) / last;
      grid_.line[i] =
          (1.0 - part) * (grid_.line[i - 1] + step * direction(phi[i])) + part * (forward[i] + gap);
    }
  }

  void check_spacing() {
    double length = 0.0;
    for (int row = 1; row < records_.rows; ++row) {
      length += (grid_.line[row] - grid_.line[row - 1]).norm();
    }
    const double even = length / (records_.rows - 1);
    for (int row = 1; row < records_.rows; ++row) {
      const double step = (grid_.line[row] - grid_.line[row - 1]).norm();
      if (!(even >= kLeastSpacing && std::abs(step - even) <= kEvenLine * even)) {
        fail(fmt::format(
            "record {} stands {} m from the one before, expected {} m", row + 1, step, even));
      }
    }
    grid_.u_increment = even;
  }

  void read_heights() {
    const int rows = records_.rows;
    const double z = road("reference_line_start_z", 0.0);
    std::vector<double> slope = column(Kind::slope, "slope", 1);
    if (slope.empty()) slope.assign(rows, road("reference_line_start_s", 0.0));
    const double steeper = modifier("scale_slope", 1.0);
    grid_.line_height.assign(rows, z);
    for (int i = 1; i < rows; ++i) {
      grid_.line_height[i] = grid_.line_height[i - 1] + steeper * slope[i] * grid_.u_increment;
    }
    const bool level =
        std::all_of(slope.begin() + 1, slope.end(), [](double s) { return s == 0.0; });
    const bool changed = has_modifier("scale_slope") || has_modifier("scale_length");
    if (has_road("reference_line_end_z") && !level && !changed) {
      blend_heights(road("reference_line_end_z", 0.0) - grid_.line_height.back());
    }
    grid_.banking = column(Kind::banking, "banking");
    const double bank = road("reference_line_start_b", 0.0);
    if (grid_.banking.empty() && bank != 0.0) grid_.banking.assign(rows, bank);
    for (double& value : grid_.banking) value *= modifier("scale_banking", 1.0);
    grid_.z.resize(static_cast<std::size_t>(rows) * sections_.size());
    const double higher = modifier("scale_z_grid", 1.0);
    for (int row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < sections_.size(); ++i) {
        grid_.z[row * sections_.size() + i] = higher * records_.at(row, sections_[i]);
      }
    }
  }

  void blend_heights(double gap) {
    const std::vector<double> forward = grid_.line_height;
    const int last = records_.rows - 1;
    for (int i = 1; i <= last; ++i) {
      const double part = static_cast<double>(i) / last;
      const double step = forward[i] - forward[i - 1];
      grid_.line_height[i] =
          (1.0 - part) * (grid_.line_height[i - 1] + step) + part * (forward[i] + gap);
    }
  }

  void scale_grid() {
    for (const double z : grid_.z) {
      if (std::abs(z) > kLargestPlace) fail("has a height above 1e9 m");
    }
    for (const auto* heights : {&grid_.line_height, &grid_.banking}) {
      for (const double z : *heights)
        if (!(std::abs(z) < kLargestPlace)) fail("has a reference line higher than 1e9 m");
    }
  }

  /// Fills missing heights as grid_nan_mode says: 0 leaves no road, 1 sets zero, 2 takes the
  /// nearest height in the row. Returns the number of missing heights.
  int fill_gaps() {
    const double mode = modifier("grid_nan_mode", 2.0);
    if (mode != 0.0 && mode != 1.0 && mode != 2.0) {
      header_.reject(header_.modifiers, "grid_nan_mode", "expected 0, 1 or 2");
    }
    const double offset = mode == 0.0 ? 0.0 : modifier("grid_nan_offset", 0.0);
    const std::size_t columns = sections_.size();
    std::vector<bool> missing(grid_.z.size());
    int gaps = 0;
    for (std::size_t i = 0; i < grid_.z.size(); ++i) {
      missing[i] = std::isnan(grid_.z[i]);
      gaps += missing[i] ? 1 : 0;
    }
    if (gaps == 0) return 0;
    // a row without any height takes the heights of the previous row
    std::vector<double> fallback(columns, 0.0);
    for (std::size_t row = 0; row < grid_.z.size(); row += columns) {
      fill_row(&grid_.z[row], mode == 1.0 ? &offset : nullptr, offset, fallback);
    }
    if (mode == 0.0) grid_.missing = std::move(missing);
    return gaps;
  }

  void fill_row(double* z,
                const double* value,
                double offset,
                std::vector<double>& fallback) const {
    const int columns = static_cast<int>(fallback.size());
    const auto there = std::find_if(z, z + columns, [](double h) { return !std::isnan(h); });
    if (there == z + columns && !value) {
      std::copy(fallback.begin(), fallback.end(), z);
      return;
    }
    double last = there == z + columns ? 0.0 : *there;
    for (int i = 0; i < columns; ++i) {
      if (!std::isnan(z[i])) {
        last = z[i];
      } else {
        z[i] = value ? *value : last + offset;
      }
    }
    std::copy(z, z + columns, fallback.begin());
  }

  void read_options() {
    grid_.border_u = border("border_mode_u");
    grid_.border_v = border("border_mode_v");
    const auto length = [&](const char* name, double fallback, bool negative) {
      const double value = header_.value(header_.options, name, fallback);
      if (std::abs(value) > kLargestPlace || (value < 0.0 && !negative)) {
        header_.reject(header_.options, name, "expected a length");
      }
      return value;
    };
    grid_.border_offset_u = length("border_offset_u", 0.0, true);
    grid_.border_offset_v = length("border_offset_v", 0.0, true);
    grid_.smooth_begin = length("border_smooth_ubeg", 0.0, false);
    grid_.smooth_end = length("border_smooth_uend", 0.0, false);
    grid_.closed = header_.value(header_.options, "refline_continuation", 0.0) == 1.0;
  }

  CrgGrid::Border border(const char* name) const {
    const double mode = header_.value(header_.options, name, 2.0);
    for (const auto known : {CrgGrid::Border::none,
                             CrgGrid::Border::zero,
                             CrgGrid::Border::keep,
                             CrgGrid::Border::repeat,
                             CrgGrid::Border::reflect}) {
      if (mode == static_cast<double>(known)) return known;
    }
    header_.reject(header_.options, name, "expected 0, 1, 2, 3 or 4");
  }

  void move() {
    for (const auto& [name, value] : header_.modifiers) {
      if (std::abs(value.number) > kLargestPlace) {
        header_.reject(header_.modifiers, name, "expected a number below 1e9");
      }
    }
    const bool by_point =
        std::any_of(header_.modifiers.begin(), header_.modifiers.end(), [](const auto& statement) {
          return statement.first.starts_with("refpoint_");
        });
    if (by_point) return move_by_point();
    const Vector2d center(modifier("refline_rotcenter_x", grid_.line[0].x()),
                          modifier("refline_rotcenter_y", grid_.line[0].y()));
    transform(center,
              modifier("refline_offset_phi", 0.0),
              {modifier("refline_offset_x", 0.0), modifier("refline_offset_y", 0.0)},
              modifier("refline_offset_z", 0.0));
  }

  /// Moves the point (u, v) of the surface to (x, y, z) with heading phi.
  void move_by_point() {
    const road::CrgRoad unmoved(grid_);
    const auto place = [&](const char* absolute,
                           const std::string& stem,
                           double from,
                           double to,
                           double fallback) {
      if (has_modifier(absolute)) return modifier(absolute, 0.0);
      if (!has_modifier((stem + "_fraction").c_str())) return fallback;
      return from + modifier((stem + "_fraction").c_str(), 0.0) * (to - from) +
             modifier((stem + "_offset").c_str(), 0.0);
    };
    const double u = place("refpoint_u", "refpoint_u", grid_.u_begin, grid_.u_end(), grid_.u_begin);
    const double v = place("refpoint_v", "refpoint_v", grid_.v.front(), grid_.v.back(), 0.0);
    const Vector2d from = unmoved.point({u, v});
    const int row =
        std::clamp(static_cast<int>((u - grid_.u_begin) / grid_.u_increment), 0, records_.rows - 2);
    const Vector2d along = grid_.line[row + 1] - grid_.line[row];
    transform(from,
              modifier("refpoint_phi", 0.0) - std::atan2(along.y(), along.x()),
              Vector2d(modifier("refpoint_x", 0.0), modifier("refpoint_y", 0.0)) - from,
              modifier("refpoint_z", 0.0) - unmoved.elevation({u, v}).value_or(0.0));
  }

  void transform(const Vector2d& center, double angle, const Vector2d& way, double up) {
    if (angle == 0.0 && way.isZero(0.0) && up == 0.0) return;
    const Eigen::Rotation2Dd turn(angle);
    for (Vector2d& point : grid_.line) point = center + turn * (point - center) + way;
    for (double& height : grid_.line_height) height += up;
  }

  const OpenCrgHeader& header_;
  const OpenCrgRecords& records_;
  std::vector<std::size_t> sections_;
  CrgGrid grid_;
};

}  // namespace

std::optional<long> expected_open_crg_rows(const OpenCrgHeader& header) {
  const auto end = header.find(header.road, "reference_line_end_u");
  if (!end) return std::nullopt;
  const double begin = header.value(header.road, "reference_line_start_u", 0.0);
  const double step = header.value(header.road, "reference_line_increment", kDefaultIncrement);
  if (step <= 0.0)
    header.reject(header.road, "reference_line_increment", "expected a number above 0");
  const double rows = (*end - begin) / step;
  if (!(rows >= 0.5 && rows <= kMostRows)) {
    header.reject(header.road,
                  "reference_line_end_u",
                  fmt::format("which means {} rows, expected 2 to 1e8", std::round(rows) + 1.0));
  }
  return std::lround(rows) + 1;
}

road::CrgGrid open_crg_grid(const OpenCrgHeader& header, const OpenCrgRecords& records, int& gaps) {
  return GridBuilding(header, records).run(gaps);
}

}  // namespace latsch::formats
