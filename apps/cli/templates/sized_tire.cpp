// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/sized_tire.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/document.h"
#include "base/text.h"
#include "base/units.h"
#include "cli/templates/placed_tire.h"
#include "cli/templates/tire_lines.h"
#include "experiment/rigs/fe_tire/column_placement.h"
#include "models/fe_tire/description/size_designation.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::cli {
namespace {

using fe_tire::Contour;
using fe_tire::MeridianPoint;
using fe_tire::SizeDesignation;
using fe_tire::TireDescription;

constexpr double kInch = 0.0254;

SizeDesignation size_of(const std::string& text) {
  const auto size = fe_tire::parse_size(text);
  if (!size) {
    throw InputError("--size is " + in_quotes(text) +
                     ", expected a size such as \"275/35R19\" or \"16x7.5-10\"");
  }
  // Limits of the usual sizes. For other sizes the template would be stretched too far.
  const double height = 0.5 * (size->outer_diameter - size->rim_diameter);
  const bool usual =
      size->metric ? height > 0.06 && height < 0.18 && size->width > 0.12 && size->width < 0.36 &&
                         height > 0.24 * size->width && height < 0.86 * size->width &&
                         size->rim_diameter > 9.5 * kInch && size->rim_diameter < 24.5 * kInch
                   : height > 0.05 && height < 0.12 && size->width > 0.12 && size->width < 0.3 &&
                         size->outer_diameter < 0.6;
  if (!usual) {
    throw InputError(fmt::format(
        "--size is {}, a section {:.0f} mm wide and {:.0f} mm high on a rim of {:.0f} inches: "
        "there is no template near it. "
        "Expected a car tire (width 125 to 355 mm, height 25 to 85 % of it and 60 to 180 mm, rim "
        "10 to 24 inches) or a small race tire such as 16x7.5-10; write any other tire by hand, "
        "docs/fe_tire_section.md says how",
        in_quotes(text),
        1e3 * size->width,
        1e3 * height,
        size->rim_diameter / kInch));
  }
  return *size;
}

/// Returns half the width, m, of the measuring rim of a tire of the given size.
double half_rim(const SizeDesignation& size) {
  if (!size.metric) return 0.5 * (size.width - 0.5 * kInch);
  const double aspect = 0.5 * (size.outer_diameter - size.rim_diameter) / size.width;
  const double share = aspect >= 0.745   ? 0.70
                       : aspect >= 0.595 ? 0.75
                       : aspect >= 0.495 ? 0.80
                       : aspect >= 0.445 ? 0.85
                                         : 0.90;
  return 0.5 * std::round(2.0 * share * size.width / kInch) / 2.0 * kInch;
}

/// Maps points on the contour of the template tire to points on the contour of another size.
class Stretch {
 public:
  Stretch(const TireDescription& from, const SizeDesignation& to)
      : old_(from.section.contour), bead_(old_.back()), crown_(old_.front()) {
    const SizeDesignation size = *fe_tire::parse_size(from.size);
    const auto widest = std::max_element(
        old_.begin(), old_.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
    widest_ = widest->r;
    width_ = to.width / size.width;
    rim_ = (bead_.y + half_rim(to) - half_rim(size)) / bead_.y;
    bead_r_ = bead_.r + 0.5 * (to.rim_diameter - size.rim_diameter);
    crown_r_ = crown_.r + 0.5 * (to.outer_diameter - size.outer_diameter);
    tabulate(from);
  }

  MeridianPoint at(const MeridianPoint& p) const {
    const double up = std::clamp((p.r - bead_.r) / (widest_ - bead_.r), 0.0, 1.0);
    const double high = (p.r - bead_.r) / (crown_.r - bead_.r);
    return {p.y * (rim_ + up * (width_ - rim_)), bead_r_ + high * (crown_r_ - bead_r_)};
  }

  /// Returns the new position along the wall, 0 to 1, of the point with the old position `old`.
  double position(double old) const {
    const double k = std::clamp(old, 0.0, 1.0) * static_cast<double>(arc_.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(k), arc_.size() - 2);
    const double s = arc_[i] + (k - static_cast<double>(i)) * (arc_[i + 1] - arc_[i]);
    return s / arc_.back();
  }

 private:
  void tabulate(const TireDescription& from) {
    constexpr int kPoints = 400;
    const Contour contour(from.section.contour);
    MeridianPoint last = at(contour.point(0.0));
    arc_.push_back(0.0);
    for (int i = 1; i <= kPoints; ++i) {
      const MeridianPoint here = at(contour.point(-static_cast<double>(i) / kPoints));
      arc_.push_back(arc_.back() + std::hypot(here.y - last.y, here.r - last.r));
      last = here;
    }
  }

  std::vector<MeridianPoint> old_;
  MeridianPoint bead_, crown_;
  double widest_ = 0.0, width_ = 1.0, rim_ = 1.0, bead_r_ = 0.0, crown_r_ = 0.0;
  std::vector<double> arc_;  // m, arc length on the new contour at equal steps of the old position
};

/// Rounds to a multiple of 1/`parts`, so that the number has a short decimal form.
double rounded(double value, double parts) { return std::round(value * parts) / parts; }

/// True if the number at a path of a tire file is a position along the wall.
bool is_position(const std::string& path) {
  if (path == "section.tread_to") return true;
  const bool placed = path.starts_with("region.") || path.starts_with("layer.");
  if (placed && (path.ends_with(".from") || path.ends_with(".to"))) return true;
  const bool profile =
      path.starts_with("section.thickness_") || path.find(".offsets.") != path.npos;
  return profile && path.ends_with(".0");
}

/// Returns the text with the value of the key `key` replaced in its line.
std::string with_line(std::string_view text, const std::string& key, const std::string& value) {
  return by_lines(text, [&](const std::string& line) {
    return line.starts_with(key + " =") ? fmt::format("{} = {}\n", key, value) : line;
  });
}

/// Replaces the opening comment of the template, which describes another tire.
std::string with_head(std::string_view text, const std::string& head) {
  while (text.starts_with('#')) text.remove_prefix(text.find('\n') + 1);
  return head + std::string(text);
}

}  // namespace

std::string template_of(const std::string& size) {
  const SizeDesignation wanted = size_of(size);
  if (!wanted.metric) return "race_16x7.5-10";
  const double height = 0.5 * (wanted.outer_diameter - wanted.rim_diameter);
  return height >= 0.495 * wanted.width ? "passenger_205_55R16" : "passenger_235_45R20";
}

/// Returns one and a half times the unknowns of tires B and A in [Hempel & Oertel 2016].
int most_unknowns(const std::string& size) {
  return template_of(size) == "passenger_235_45R20" ? 40500 : 23220;
}

std::string stretched_tire(std::string_view text, const std::string& size) {
  const SizeDesignation wanted = size_of(size);
  const TireDescription old = fe_tire::read_tire(Document::parse(text, "template").root());
  const Stretch stretch(old, wanted);
  const std::string head = fmt::format(
      "# A {}, drawn from a {}: its contour stretched to this size on a rim {:g} inches wide.\n"
      "# Assumed: everything but the size. Replace what you know: contour, thicknesses, cords, "
      "rubbers.\n"
      "# \"position\" counts along the wall from the crown (0) to the bead (1).\n",
      size,
      old.size,
      2.0 * half_rim(wanted) / kInch);
  Document tire = Document::parse(
      with_head(by_lines(text,
                         [&](const std::string& line) {
                           const char* key = line.starts_with("name =")   ? "name"
                                             : line.starts_with("size =") ? "size"
                                                                          : nullptr;
                           return key ? fmt::format("{} = \"{}\"\n", key, size) : line;
                         }),
                head),
      "--size " + size);
  for (std::size_t i = 0; i < old.section.contour.size(); ++i) {
    const MeridianPoint p = stretch.at(old.section.contour[i]);
    tire.set(fmt::format("section.contour.{}.0", i), rounded(p.y, 1e4));
    tire.set(fmt::format("section.contour.{}.1", i), rounded(p.r, 1e4));
  }
  for (const std::string& path : tire.paths()) {
    if (is_position(path)) tire.set(path, rounded(stretch.position(tire.get(path)), 1e3));
  }
  // a coarse mesh with equal columns needs no placement
  if (old.section.columns.empty()) return tire.text();
  std::vector<double> columns = old.section.columns;
  for (double& q : columns) q = rounded(stretch.position(q), 1e4);
  std::string stretched = placed_tire(tire.text(), columns, old.section.sectors);
  // Walls higher than the template's bend more in the crown, so more columns there are worth more
  // than the narrowest sectors in the contact, whose effect on the vertical force is 0.1 %.
  if (template_of(size) == "passenger_205_55R16") {
    stretched = with_line(stretched, "sector_zones", "[[4, \"3.2 deg\"], [2, \"5 deg\"]]");
  }
  return stretched;
}

std::string with_placed_mesh(const std::string& stretched,
                             const std::string& size,
                             const std::function<void(const std::string&)>& progress) {
  const TireDescription tire =
      fe_tire::read_tire(Document::parse(stretched, "--size " + size).root());
  if (tire.section.columns.empty()) return stretched;
  const auto placement = place_columns(
      tire, {.unknowns = most_unknowns(size), .rounds = 4, .choose_sectors = true}, progress);
  if (!placement) {
    throw InputError("--size " + size + ": no mesh found: " + placement.failure().reason);
  }
  return placed_tire(stretched, placement->columns, placement->sectors);
}

std::string sized_tire(std::string_view text, const std::string& size) {
  return with_placed_mesh(stretched_tire(text, size), size);
}

std::string inflated_size_in_words(const Document& tire,
                                   const std::string& size,
                                   const experiment::Language& language) {
  const std::string contour = "its contour is drawn to the size without pressure";
  const auto test = language.read_test(
      Document::parse("test = {kind = \"inflation\"}", "inflation").root().table("test"), {});
  const auto inflated = test->run(*language.find_kind("fe_tire")->build(tire));
  if (!inflated) return contour;  // check says why the tire does not inflate
  const double diameter = 2.0 * (*inflated)["outer_radius"].front();
  const double wanted = size_of(size).outer_diameter;
  return fmt::format(
      "inflated to {} the tire is {:.1f} mm high (outer diameter) and {:.1f} mm wide, {:+.1f} % of "
      "the diameter of its size, {:.1f} mm: {}, and the crown grows by {:.1f} mm. If the size is "
      "that of the inflated tire, subtract the growth from the radii of the contour",
      format_quantity((*inflated)["pressure"].front(), "kPa", 4),
      1e3 * diameter,
      1e3 * (*inflated)["section_width"].front(),
      100.0 * (diameter / wanted - 1.0),
      1e3 * wanted,
      contour,
      1e3 * (*inflated)["growth"].front());
}

std::string coarse_tire(const std::string& text) {
  return by_lines(text, [](const std::string& line) -> std::string {
    if (line.starts_with("columns =")) return "meridional = 16\n";
    if (line.starts_with("sectors =")) return "sectors = 24\n";
    const bool of_fine_mesh = line.starts_with("sector_zones =") ||
                              line.starts_with("# Narrow at") || line.starts_with("# Short ") ||
                              line.starts_with("faces =") || line.starts_with("# Rows of ");
    return of_fine_mesh ? "" : line;
  });
}

}  // namespace latsch::cli
