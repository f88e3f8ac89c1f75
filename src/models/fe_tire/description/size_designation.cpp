// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/size_designation.h"

#include <fmt/format.h>

#include <cmath>
#include <regex>

namespace latsch::fe_tire {
namespace {

constexpr double kInch = 0.0254, kMillimeter = 1e-3;
constexpr double kLargestFlange = 20e-3;  // m, from rim diameter to the clamped bead

}  // namespace

std::optional<SizeDesignation> parse_size(const std::string& text) {
  static const std::regex kMetric(
      R"((?:P|LT)?\s*(\d{2,3})\s*/\s*(\d{2,3})\s*(Z?R|B|D|-)\s*(\d{1,2}(?:\.\d)?)(?:\s.*)?)");
  static const std::regex kRacing(
      R"((\d{1,2}(?:\.\d{1,2})?)\s*[xX]\s*(\d{1,2}(?:\.\d{1,2})?)\s*(R|-)\s*(\d{1,2}(?:\.\d)?)(?:\s.*)?)");
  if (text.size() > 60) return {};
  std::smatch m;
  SizeDesignation size;
  if (std::regex_match(text, m, kMetric)) {
    size.width = std::stod(m[1]) * kMillimeter;
    size.rim_diameter = std::stod(m[4]) * kInch;
    size.outer_diameter = size.rim_diameter + 2.0 * size.width * std::stod(m[2]) / 100.0;
    size.radial = m[3].str().back() == 'R';
  } else if (std::regex_match(text, m, kRacing)) {
    size.metric = false;
    size.outer_diameter = std::stod(m[1]) * kInch;
    size.width = std::stod(m[2]) * kInch;
    size.rim_diameter = std::stod(m[4]) * kInch;
    size.radial = m[3] == "R";
  } else {
    return {};
  }
  if (size.width <= 0.0 || size.outer_diameter <= size.rim_diameter) return {};
  return size;
}

std::string size_conflict(const SizeDesignation& size,
                          double outer_radius,
                          double width,
                          MeridianPoint bead) {
  const double diameter = 2.0 * outer_radius;
  if (std::abs(diameter / size.outer_diameter - 1.0) > 0.02)
    return fmt::format("gives an outer diameter of {:.1f} mm, but the size says {:.1f} mm",
                       1e3 * diameter,
                       1e3 * size.outer_diameter);
  const double least = size.metric ? 0.94 : 0.95, most = size.metric ? 1.06 : 1.33;
  if (width < least * size.width || width > most * size.width)
    return fmt::format("gives a section width of {:.1f} mm, but the size says {:.1f} to {:.1f} mm",
                       1e3 * width,
                       1e3 * least * size.width,
                       1e3 * most * size.width);
  const double rim = 0.5 * size.rim_diameter;
  if (bead.r < rim || bead.r > rim + kLargestFlange)
    return fmt::format(
        "ends at a bead radius of {:.1f} mm, but the rim asks for {:.1f} to {:.1f} mm",
        1e3 * bead.r,
        1e3 * rim,
        1e3 * (rim + kLargestFlange));
  return {};
}

}  // namespace latsch::fe_tire
