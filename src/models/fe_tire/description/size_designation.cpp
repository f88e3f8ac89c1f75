// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/size_designation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <regex>

#include "base/text.h"

namespace latsch::fe_tire {
namespace {

constexpr double kInch = 0.0254, kMillimeter = 1e-3;
constexpr double kLargestFlange = 20e-3;  // m, largest distance between rim and clamped bead
// Share of the rim's diameter; larger than 20 mm for large rims.
constexpr double kFlangeOfRim = 0.04;
constexpr double kSmallestMetricRim = 100.0;    // rim diameters from here on are in mm
constexpr double kSmallestMillimeters = 200.0;  // outer diameters from here on are in mm
// Largest rim of a metric tire of motorcycle width, inches.
constexpr double kLargestOfMotorcycles = 24.5;
constexpr double kHeightOfSeries82 = 0.82, kHeightOfInches = 0.95;

const char* const kPrefix = R"(\s*(?:P|LT|ST|T|C|IF|VF|H|B)?\s*)";
const char* const kConstruction = R"(\s*([ZVHS]?R|B|D|-)\s*)";
const char* const kRim = R"((\d{1,3}(?:\.\d)?)(?:LT|CP|C|M/C|NHS|XL)?(?:\s.*)?)";

/// Converts a text to capitals, and the multiplication sign to X.
std::string plain(const std::string& text) {
  static const std::string kTimes = "\u00d7";
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, kTimes.size(), kTimes) == 0) {
      result += 'X';
      i += kTimes.size() - 1;
    } else {
      result += static_cast<char>(std::toupper(static_cast<unsigned char>(text[i])));
    }
  }
  return result;
}

/// Returns the number that the text is, with a decimal point; the expressions of this file match
/// nothing else.
double decimal(const std::string& text) { return parse_number(text).value_or(0.0); }

double rim_of(const std::string& text) {
  const double rim = decimal(text);
  return rim >= kSmallestMetricRim ? rim * kMillimeter : rim * kInch;
}

bool is_radial(const std::string& construction) { return construction.back() == 'R'; }

/// Reads a designation of width, aspect ratio and rim.
SizeDesignation with_ratio(const std::smatch& m) {
  SizeDesignation size;
  const double width = decimal(m[1]);
  size.metric = width >= 100.0 || decimal(m[4]) < kLargestOfMotorcycles;
  size.width = width * (size.metric ? kMillimeter : kInch);
  size.rim_diameter = size.metric ? rim_of(m[4]) : decimal(m[4]) * kInch;
  size.outer_diameter = size.rim_diameter + 2.0 * size.width * decimal(m[2]) / 100.0;
  size.radial = is_radial(m[3]);
  return size;
}

/// Reads a designation of width and rim.
SizeDesignation without_ratio(const std::smatch& m) {
  SizeDesignation size;
  const double width = decimal(m[1]);
  size.metric = width >= 100.0;
  size.width = width * (size.metric ? kMillimeter : kInch);
  size.rim_diameter = decimal(m[3]) * kInch;
  const double height = size.metric ? kHeightOfSeries82 : kHeightOfInches;
  size.outer_diameter = size.rim_diameter + 2.0 * height * size.width;
  size.radial = is_radial(m[2]);
  size.diameter_tolerance = size.metric ? 0.03 : 0.08;
  if (!size.metric) size.most_width = 1.15;
  return size;
}

/// Reads a designation of outer diameter, width and rim.
SizeDesignation with_diameter(const std::smatch& m) {
  SizeDesignation size;
  const double outer = decimal(m[1]);
  const double unit = outer >= kSmallestMillimeters ? kMillimeter : kInch;
  size.metric = false;
  size.outer_diameter = outer * unit;
  size.width = decimal(m[2]) * unit;
  size.rim_diameter = decimal(m[4]) * kInch;
  size.radial = is_radial(m[3]);
  size.least_width = 0.95;
  size.most_width = 1.33;
  return size;
}

}  // namespace

std::optional<SizeDesignation> parse_size(const std::string& text) {
  static const std::regex kWithRatio(std::string(kPrefix) + R"((\d{2,3})\s*/\s*(\d{2,3}))" +
                                     kConstruction + kRim);
  static const std::regex kWithoutRatio(std::string(kPrefix) + R"((\d{1,3}(?:\.\d{1,2})?))" +
                                        kConstruction + kRim);
  static const std::regex kWithDiameter(std::string(kPrefix) +
                                        R"((\d{1,4}(?:\.\d{1,2})?)\s*X\s*(\d{1,3}(?:\.\d{1,2})?))" +
                                        kConstruction + kRim);
  if (text.size() > 60) return {};
  const std::string capital = plain(text);
  std::smatch m;
  SizeDesignation size;
  if (std::regex_match(capital, m, kWithRatio)) {
    size = with_ratio(m);
  } else if (std::regex_match(capital, m, kWithDiameter)) {
    size = with_diameter(m);
  } else if (std::regex_match(capital, m, kWithoutRatio)) {
    size = without_ratio(m);
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
  if (std::abs(diameter / size.outer_diameter - 1.0) > size.diameter_tolerance)
    return fmt::format("gives an outer diameter of {:.1f} mm, but the size says {:.1f} mm",
                       1e3 * diameter,
                       1e3 * size.outer_diameter);
  const double least = size.least_width, most = size.most_width;
  if (width < least * size.width || width > most * size.width)
    return fmt::format("gives a section width of {:.1f} mm, but the size says {:.1f} to {:.1f} mm",
                       1e3 * width,
                       1e3 * least * size.width,
                       1e3 * most * size.width);
  const double rim = 0.5 * size.rim_diameter;
  const double flange = std::max(kLargestFlange, kFlangeOfRim * size.rim_diameter);
  if (bead.r < rim || bead.r > rim + flange)
    return fmt::format(
        "ends at a bead radius of {:.1f} mm, but the rim asks for {:.1f} to {:.1f} mm",
        1e3 * bead.r,
        1e3 * rim,
        1e3 * (rim + flange));
  return {};
}

}  // namespace latsch::fe_tire
