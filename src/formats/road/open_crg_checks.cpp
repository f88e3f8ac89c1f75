// SPDX-License-Identifier: Apache-2.0
#include "formats/road/open_crg_checks.h"

#include <fmt/format.h>

#include <cmath>

#include "base/text.h"

namespace latsch::formats {
namespace {

/// Relative tolerance of the stated end of the line: headings and slopes in files have seven
/// digits, and programs integrate them in different ways. A larger value would hide contradictions.
constexpr double kSameEnd = 1e-2;

class Settling {
 public:
  explicit Settling(OpenCrgHeader& header) : header_(header), modifiers_(header.modifiers) {}

  void run() {
    for (const char* name : {"scale_z_grid", "scale_slope", "scale_banking"}) ignore_zero(name);
    if (has_modifier("refpoint_")) {
      settle_place("refpoint_u", false);
      settle_place("refpoint_v", true);
      for (const char* name : {"refline_offset_x",
                               "refline_offset_y",
                               "refline_offset_z",
                               "refline_offset_phi",
                               "refline_rotcenter_x",
                               "refline_rotcenter_y"})
        idle(name, "the road is placed by its reference point");
    }
    if (header_.value(modifiers_, "grid_nan_mode", 2.0) == 0.0)
      idle("grid_nan_offset", "grid_nan_mode = 0 leaves gaps open");
    const double closed = header_.value(header_.options, "refline_continuation", 0.0);
    if (closed != 0.0 && closed != 1.0)
      header_.reject(header_.options, "refline_continuation", "expected 0 or 1");
  }

 private:
  bool has_modifier(std::string_view beginning) const {
    const auto first = modifiers_.lower_bound(beginning);
    return first != modifiers_.end() && first->first.starts_with(beginning);
  }

  void warn(const OpenCrgHeader::Value& value, const std::string& text) {
    header_.warnings.push_back(fmt::format("{}:{}: {}", value.file, value.line, text));
  }

  void ignore_zero(const char* name) {
    const auto found = modifiers_.find(name);
    if (found == modifiers_.end() || found->second.number != 0.0) return;
    warn(found->second,
         fmt::format("{} = 0 is ignored, as the standard says of factors on heights", name));
    modifiers_.erase(found);
  }

  void idle(const char* name, const char* why) {
    const auto found = modifiers_.find(name);
    if (found == modifiers_.end() || found->second.number == 0.0) return;
    warn(found->second, fmt::format("{} has no effect: {}", name, why));
  }

  void settle_place(const std::string& stem, bool from_line) {
    const auto place = modifiers_.find(stem), part = modifiers_.find(stem + "_fraction"),
               offset = modifiers_.find(stem + "_offset");
    const bool both = place != modifiers_.end() && part != modifiers_.end();
    if (both)
      header_.reject(
          modifiers_, stem, "but " + stem + "_fraction states another position; keep one of them");
    if (part != modifiers_.end() && !(part->second.number >= 0.0 && part->second.number <= 1.0))
      header_.reject(modifiers_, stem + "_fraction", "expected 0 to 1");
    if (offset == modifiers_.end()) return;
    if (place != modifiers_.end()) {
      if (offset->second.number != 0.0)
        warn(offset->second, fmt::format("{} is added to {}", stem + "_offset", stem));
      place->second.number += offset->second.number;
    } else if (part == modifiers_.end() && from_line) {
      warn(offset->second, fmt::format("{}_offset counts from the reference line", stem));
      modifiers_[stem] = offset->second;
    } else if (part == modifiers_.end()) {
      modifiers_[stem + "_fraction"] = {0.0, offset->second.line, offset->second.file};
    }
  }

  OpenCrgHeader& header_;
  OpenCrgHeader::Values& modifiers_;
};

}  // namespace

void settle_open_crg_modifiers(OpenCrgHeader& header) { Settling(header).run(); }

void compare_open_crg_end(OpenCrgHeader& header, const OpenCrgEnd& last) {
  const auto compare = [&](const char* end, const char* start, double channel, bool angle) {
    const auto stated = header.road.find(end);
    if (stated == header.road.end()) return;
    const bool by_channel = !std::isnan(channel);
    // Without a channel the line keeps its initial heading; a straight line without a stated
    // heading runs through its end, so there is nothing to check.
    if (!by_channel && angle && !header.road.contains(start)) return;
    const double line = by_channel ? channel : header.value(header.road, start, 0.0);
    double off = stated->second.number - line;
    if (angle) off = std::remainder(off, 2.0 * std::acos(-1.0));
    if (std::abs(off) <= kSameEnd) return;
    header.warnings.push_back(
        fmt::format("{}:{}: {} is {}, but the line ends with {} {}",
                    stated->second.file,
                    stated->second.line,
                    end,
                    format_number(stated->second.number),
                    format_number(line),
                    by_channel ? "by its channel, which counts"
                               : std::string("by ") + start + ", which counts all along it"));
  };
  compare("reference_line_end_phi", "reference_line_start_phi", last.phi, true);
  compare("reference_line_end_s", "reference_line_start_s", last.slope, false);
  compare("reference_line_end_b", "reference_line_start_b", last.banking, false);
}

}  // namespace latsch::formats
