// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/usual_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/text.h"
#include "base/units.h"
#include "experiment/language/specimen.h"
#include "experiment/language/usual_car_numbers.h"

namespace latsch::experiment {
namespace {

using Units = std::vector<const char*>;

const Units kPressures{"kPa", "bar", "psi", "MPa", "Pa"};
const Units kModuli{"MPa", "GPa", "kPa", "Pa"};
const Units kTimes{"s", "min", "h", "ms"};
const Units kLengths{"mm", "cm", "m", "in"};
const Units kShortTimes{"ms", "s", "us"};
const Units kUnitsOfForce{"N", "kN", "lbf"};
const Units kDensities{"kg/m^3", "g/cm^3"};
const Units kMasses{"kg", "g", "lb"};
const Units kAreas{"mm^2", "cm^2", "m^2"};
const Units kBeds{"MN/m^2", "kN/m^2", "N/m^2", "N/mm^2"};

/// Returns the usual magnitudes of the numbers in tests and studies.
const std::vector<UsualMagnitude>& of_tests() {
  static const std::vector<UsualMagnitude> all{
      {"run", "timeout", "the time allowed to a trial", "s", 1e-12, 0.1, 1e6, 1e15, kTimes},
      {"simulator", "timeout", "the time allowed to a run", "s", 1e-12, 0.01, 1e6, 1e15, kTimes},
      {"", "pressure", "an inflation pressure", "bar", 0.02, 0.3, 16, 40, kPressures},
      {"experiment", "load", "a wheel load", "N", 5, 100, 6e4, 1e6, kUnitsOfForce},
      {"test", "load", "a wheel load", "N", 5, 100, 6e4, 1e6, kUnitsOfForce},
      {"test", "loads", "a wheel load", "N", 5, 100, 6e4, 1e6, kUnitsOfForce},
      {"test", "speed", "a speed", "km/h", 0, 0.1, 350, 1500, {"km/h", "m/s"}, true},
      {"test", "drum_diameter", "a drum's diameter", "m", 0.1, 0.5, 6, 50, {"m", "mm", "in"}},
  };
  return all;
}

/// Returns the usual magnitudes of the numbers of a finite-element tire.
const std::vector<UsualMagnitude>& of_fe_tires() {
  static const std::vector<UsualMagnitude> all{
      {"rubber", "young_modulus", "a rubber's modulus", "MPa", 0.01, 0.3, 300, 5e3, kModuli},
      {"rubber", "density", "a rubber's density", "kg/m^3", 100, 700, 3000, 2e4, kDensities},
      {"rubber", "loss_factor", "a rubber's loss factor", "1", 1e-6, 0.01, 0.5, 1, {}, true},
      {"layer", "young_modulus", "a layer's modulus", "MPa", 1, 20, 2.5e5, 1.5e6, kModuli},
      {"layer", "density", "a cord's density", "kg/m^3", 50, 200, 9000, 2.5e4, kDensities, true},
      {"layer", "spacing", "a distance of cords", "mm", 0.05, 0.3, 5, 50, kLengths},
      {"layer", "cord_diameter", "a cord's diameter", "mm", 0.01, 0.1, 3, 20, kLengths},
      {"layer", "cord_area", "a cord's cross-section", "mm^2", 1e-4, 5e-3, 7, 300, kAreas},
      {"section", "thickness_inside", "a wall's thickness", "mm", 0.01, 0.3, 50, 200, kLengths},
      {"section", "thickness_outside", "a wall's thickness", "mm", 0.01, 0.3, 50, 200, kLengths},
  };
  return all;
}

/// Returns the usual magnitudes of the numbers of a flexible ring.
const std::vector<UsualMagnitude>& of_rings() {
  const auto bed = [](const char* below) {
    return UsualMagnitude{
        below, "stiffness", "a sidewall's stiffness", "kN/m^2", 3, 15, 2e4, 1e5, kBeds};
  };
  const auto damping = [](const char* below) {
    return UsualMagnitude{
        below, "damping", "a sidewall's damping", "N s/m^2", 1e-3, 0.1, 2e4, 1e6, {}, true};
  };
  static const std::vector<UsualMagnitude> all{
      {"belt", "radius", "a belt's radius", "mm", 30, 80, 1800, 2500, kLengths},
      {"belt", "mass", "a belt's mass", "kg", 0.01, 0.1, 1500, 5e3, kMasses},
      {"belt", "torsion_inertia", "a belt's inertia", "kg m", 1e-7, 1e-5, 5, 100, {}},
      {"belt", "extension", "a belt's stiffness", "kN", 1, 20, 1e5, 1e6, {"MN", "kN", "N"}},
      {"belt",
       "bending_in_plane",
       "a belt's bending stiffness",
       "N m^2",
       1e-6,
       1e-3,
       300,
       1e5,
       {},
       true},
      {"belt",
       "bending_out_of_plane",
       "a belt's bending stiffness",
       "N m^2",
       1e-3,
       0.1,
       5e4,
       1e7,
       {},
       true},
      {"belt",
       "damping_time",
       "a belt's damping over stiffness",
       "ms",
       0,
       0,
       30,
       1e3,
       kShortTimes,
       true},
      {"belt", "pressure_width", "a belt's width", "mm", 2, 10, 1500, 3e3, kLengths, true},
      bed("sidewall.radial"),
      bed("sidewall.tangential"),
      bed("sidewall.lateral"),
      damping("sidewall.radial"),
      damping("sidewall.tangential"),
      damping("sidewall.lateral"),
      {"sidewall",
       "time_constant",
       "a sidewall's time constant",
       "ms",
       0,
       0,
       500,
       1e4,
       kShortTimes,
       true},
      {"sidewall", "progressive_travel", "a sidewall's travel", "mm", 0.5, 2, 500, 5e3, kLengths},
      {"sidewall", "torsion", "a sidewall's torsion", "N/rad", 0.1, 5, 1e6, 1e8, {}, true},
      {"tread", "width", "a tread's width", "mm", 5, 15, 1500, 3e3, kLengths},
      {"tread", "height", "a tread's height", "mm", 0.3, 1, 150, 300, kLengths},
      {"tread", "young_modulus", "a tread's modulus", "MPa", 0.01, 0.3, 300, 5e3, kModuli},
      {"tread",
       "damping_time",
       "a tread's damping over stiffness",
       "ms",
       0,
       0,
       10,
       1e3,
       kShortTimes,
       true},
      {"tread", "shear_ratio", "a ratio of moduli", "1", 0.01, 0.1, 1.5, 10, {}},
  };
  return all;
}

double in_unit(const UsualMagnitude& usual, double si) { return Unit::of(usual.unit).from_si(si); }

/// Returns "; 240 kPa would be usual": the number as written, with the unit that is often confused
/// with the written one.
std::string may_be_meant(const UsualMagnitude& usual, const std::string& written) {
  const auto quantity = parse_quantity(written);
  if (!quantity) return "";
  const auto number = parse_number(quantity->number);
  if (!number) return "";
  for (const char* unit : usual.taken_for) {
    if (quantity->unit.text() == unit) continue;
    if (judged(usual, Unit::of(unit).to_si(*number)) == Seen::usual) {
      return fmt::format("; {} would be usual", in_quotes(quantity->number + " " + unit));
    }
  }
  return "";
}

/// False for the first column of a profile of thicknesses, which is a position.
bool is_meant(const UsualMagnitude& usual, const std::string& path) {
  return !std::string_view(usual.key).starts_with("thickness") || path.ends_with(".1");
}

/// Returns the path within the part of a car: "bushing.all.x" for "front_suspension.bushing.all.x".
std::string_view within_part(std::string_view path) {
  const auto dot = path.find('.');
  if (dot == path.npos) return path;
  const std::string_view first = path.substr(0, dot);
  for (const char* axle : {"front", "rear"})
    for (const char* part : {"_suspension", "_tire", "_tire_right"})
      if (first == std::string(axle) + part) return path.substr(dot + 1);
  return path;
}

/// Returns the number of a key in a table; nullopt if the table has no such key.
std::optional<double> number_at(const Document& document, const std::string& path) {
  const Node root = document.root();
  const auto dot = path.rfind('.');
  std::optional<Node> table = root;
  for (std::size_t begin = 0; dot != path.npos && begin < dot;) {
    const std::size_t end = std::min(path.find('.', begin), dot);
    table = table->find_table(path.substr(begin, end - begin));
    if (!table) return std::nullopt;
    begin = end + 1;
  }
  if (!table->has(path.substr(dot == path.npos ? 0 : dot + 1))) return std::nullopt;
  return document.get(path);
}

/// Returns the largest thickness of the wall, m; 0 if the document describes none.
double thickest_wall(const Document& document) {
  double inside = 0.0, outside = 0.0;
  for (const std::string& path : document.paths()) {
    if (!path.ends_with(".1")) continue;
    if (path.starts_with("section.thickness_inside."))
      inside = std::max(inside, document.get(path));
    if (path.starts_with("section.thickness_outside."))
      outside = std::max(outside, document.get(path));
  }
  return inside + outside;
}

/// Finds plies whose cords would overlap, or whose cords are thicker than the wall that contains
/// them. A cord is at least as wide as the square root of its area, also in a file that states the
/// area per width.
void examine_cords(const Document& document, std::vector<Finding>& found) {
  const double wall = thickest_wall(document);
  for (const Node& layer : document.root().named_tables("layer")) {
    const std::string at = "layer." + layer.name() + ".";
    const auto diameter = number_at(document, at + "cord_diameter");
    const auto area = number_at(document, at + "cord_area");
    const auto spacing = number_at(document, at + "spacing");
    if (!spacing || (!diameter && !area)) continue;
    const double d = diameter ? *diameter : std::sqrt(*area);
    const char* key = diameter ? "cord_diameter" : "cord_area";
    const auto add = [&](const std::string& what) {
      found.push_back({layer.place(key),
                       fmt::format("{}{} makes a cord of {:.3g} mm, {}", at, key, 1e3 * d, what),
                       true});
    };
    constexpr double kRounding = 1e-9;
    if (d > *spacing * (1.0 + kRounding))
      add(
          fmt::format("but spacing sets a cord every {:.3g} mm: the cords overlap. Expected a "
                      "spacing of at least the cord's diameter",
                      1e3 * *spacing));
    else if (wall > 0.0 && d > wall)
      add(fmt::format("but the wall is {:.3g} mm thick at most: the cord does not fit into it",
                      1e3 * wall));
  }
}

/// Finds angles of cords that no tire has together: none of the layers that reach the beads runs
/// across, all layers below the tread are on one side, or all are nearer to the axis.
void examine_angles(const Document& document, std::vector<Finding>& found) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  constexpr double kReachesBead = 0.8;  // share of the half meridian
  constexpr double kSteep = 45.0 * kDegree, kAround = 5.0 * kDegree;
  constexpr double kAcross = 20.0 * kDegree;  // plies of bias tires have some 30 to 40 degrees
  int carcasses = 0, across = 0, belts = 0, left = 0, steep = 0;
  std::optional<Place> carcass, belt;
  for (const Node& layer : document.root().named_tables("layer")) {
    const std::string at = "layer." + layer.name() + ".";
    const auto angle = number_at(document, at + "angle");
    if (!angle) continue;
    const double size = std::abs(std::remainder(*angle, std::numbers::pi));
    if (number_at(document, at + "to").value_or(1.0) > kReachesBead &&
        number_at(document, at + "from").value_or(0.0) < 1.0 - kReachesBead) {
      ++carcasses;
      across += size >= kAcross;
      if (!carcass) carcass = layer.place("angle");
    } else if (size > kAround && !number_at(document, at + "from")) {
      ++belts;
      left += *angle > 0.0;
      steep += size > kSteep;
      if (!belt) belt = layer.place("angle");
    }
  }
  const std::string counted =
      "angles count from the circumference: 90 deg is a radial cord, 0 deg one around the tire";
  if (carcasses > 0 && across == 0)
    found.push_back(
        {*carcass, "no layer that reaches the beads has cords across the tire; " + counted, false});
  if (belts > 1 && (left == 0 || left == belts))
    found.push_back({*belt,
                     fmt::format("the {} layers below the tread have angles of one sign, so that "
                                 "they do not cross: the belt steers the tire to one side",
                                 belts),
                     false});
  if (belts > 1 && steep == belts)
    found.push_back(
        {*belt, "all layers below the tread have angles above 45 deg; " + counted, false});
}

/// Finds cords that are stiffer in compression than in tension, usually because a modulus has one
/// zero too many. A cord buckles, so its modulus in compression is at most that in tension.
void examine_compression(const Document& document, std::vector<Finding>& found) {
  for (const Node& layer : document.root().named_tables("layer")) {
    const std::string at = "layer." + layer.name() + ".";
    const auto tension = number_at(document, at + "young_modulus");
    const auto compression = number_at(document, at + "compression_modulus");
    if (!tension || !compression || *compression <= *tension) continue;
    found.push_back({layer.place("compression_modulus"),
                     fmt::format("{}compression_modulus is {:.4g} MPa, but a cord is at most as "
                                 "stiff as in tension, {:.4g} MPa",
                                 at,
                                 1e-6 * *compression,
                                 1e-6 * *tension)});
  }
}

/// Checks the mass of a ring's belt over the area of its surface; usual values are 3 kg/m^2 for a
/// bicycle, 15 for a car, 60 for a truck.
void examine_belt(const Document& document, std::vector<Finding>& found) {
  const UsualMagnitude usual{
      "", "", "a belt's mass on its surface", "kg/m^2", 0.2, 1, 300, 2e3, {}};
  const auto mass = number_at(document, "belt.mass"), radius = number_at(document, "belt.radius"),
             width = number_at(document, "tread.width");
  if (!mass || !radius || !width) return;
  const double surface = 2.0 * std::numbers::pi * *radius * *width;
  const Seen seen = judged(usual, *mass / surface);
  if (seen == Seen::usual) return;
  found.push_back({document.root().table("belt").place("mass"),
                   fmt::format("belt.mass is {:.4g} kg on the belt's radius and the tread's width, "
                               "{:.3g} kg/m^2, but {}",
                               *mass,
                               *mass / surface,
                               usual_in_words(usual)),
                   seen == Seen::impossible});
}

}  // namespace

Seen judged(const UsualMagnitude& usual, double si) {
  const double value = usual.is_signed ? std::abs(in_unit(usual, si)) : in_unit(usual, si);
  if (value == 0.0 && usual.zero_allowed) return Seen::usual;
  // An inflation pressure of 0 is unusual but possible: a flat tire may be intended.
  if (value == 0.0 && std::string_view(usual.key) == "pressure") return Seen::unusual;
  if (!(value >= usual.least && value <= usual.most)) return Seen::impossible;
  return value < usual.from || value > usual.to ? Seen::unusual : Seen::usual;
}

std::string usual_in_words(const UsualMagnitude& usual) {
  if (usual.from == 0.0)
    return fmt::format("{} is usually at most {:g}{}{}",
                       usual.words,
                       usual.to,
                       std::string_view(usual.unit) == "1" ? "" : " ",
                       std::string_view(usual.unit) == "1" ? "" : usual.unit);
  return fmt::format("{} is usually {:g} to {:g}{}{}",
                     usual.words,
                     usual.from,
                     usual.to,
                     std::string_view(usual.unit) == "1" ? "" : " ",
                     std::string_view(usual.unit) == "1" ? "" : usual.unit);
}

Written written_at(const Document& document, const std::string& path) {
  Node node = document.root();
  std::size_t begin = 0;
  for (;;) {
    const auto end = path.find('.', begin);
    const std::string key = path.substr(begin, end - begin);
    Written written{node.place(key), ""};
    try {
      if (end == path.npos) {
        written.text = node.text(key);
        return written;
      }
      const auto below = node.find_table(key);
      if (!below) return written;
      node = *below;
      begin = end + 1;
    } catch (const InputError&) {  // a list, or a plain number
      return written;
    }
  }
}

std::string key_of(std::string path) {
  for (;;) {
    const auto dot = path.rfind('.');
    if (dot == path.npos) return path;
    const std::string last = path.substr(dot + 1);
    const bool place = last.find_first_not_of("0123456789") == last.npos;
    if (!place && last != "values") return last;
    path.resize(dot);
  }
}

const UsualMagnitude* usual_magnitude(std::string_view path, std::string_view unit) {
  // The pressures of a friction law are contact pressures, not inflation pressures.
  if (path.find("friction.pressure") != path.npos) return nullptr;
  path = within_part(path);
  const std::string key = key_of(std::string(path));
  for (const auto* table :
       {&of_tests(), &of_fe_tires(), &of_rings(), &usual_of_cars(), &usual_of_car_tests()}) {
    for (const UsualMagnitude& usual : *table) {
      const std::string_view below = usual.below;
      const bool is_below =
          below.empty() || (path.starts_with(below) && path.substr(below.size()).starts_with('.'));
      if (key != usual.key || !is_below) continue;
      if (unit.empty() || Unit::of(unit).same_dimension(Unit::of(usual.unit))) return &usual;
    }
  }
  return nullptr;
}

std::optional<Finding> unusual(const UsualMagnitude& usual,
                               const Written& written,
                               const std::string& name,
                               double si) {
  const Seen seen = judged(usual, si);
  if (seen == Seen::usual) return std::nullopt;
  return Finding{written.place,
                 fmt::format("{} is {}, but {}{}",
                             name,
                             written.text.empty() ? format_quantity(si, usual.unit, 4)
                                                  : in_quotes(written.text),
                             usual_in_words(usual),
                             may_be_meant(usual, written.text)),
                 seen == Seen::impossible};
}

std::vector<Finding> unusual_numbers(const Document& document,
                                     const std::string& below,
                                     const std::function<bool(const std::string&)>& passed_over) {
  std::vector<Finding> found;
  for (const std::string& path : document.paths()) {
    if (passed_over && passed_over(path)) continue;
    const std::string whole = below.empty() ? path : below + "." + path;
    if (!usual_magnitude(whole)) continue;
    const UsualMagnitude* usual = usual_magnitude(whole, document.unit(path));
    const double si = document.get(path);
    if (!usual || !std::isfinite(si) || !is_meant(*usual, path)) continue;
    if (const auto one = unusual(*usual, written_at(document, path), path, si))
      found.push_back(*one);
  }
  if (!below.empty()) return found;
  examine_cords(document, found);
  examine_angles(document, found);
  examine_compression(document, found);
  examine_belt(document, found);
  return found;
}

std::vector<Finding> findings_of_model(const SpecimenKind& kind,
                                       const Document& numbers,
                                       const std::filesystem::path& file) {
  std::vector<Finding> found;
  for (const std::string& note : kind.notes(file))
    found.push_back({{file.string(), 0}, note, false, true});
  if (!kind.has_usual_numbers()) return found;
  const auto add = [&](const SpecimenKind& of,
                       const std::filesystem::path& named,
                       std::vector<Finding> unusual) {
    for (Finding& one : unusual) {
      one.place = of.written_place(named, one.place);
      found.push_back(std::move(one));
    }
  };
  const auto parts = kind.parts(file);
  std::set<std::filesystem::path> examined;
  for (const SpecimenKind::Part& part : parts)
    if (part.kind->has_usual_numbers() && examined.insert(part.file).second)
      add(*part.kind, part.file, unusual_numbers(part.kind->read(part.file)));
  // Numbers of a part belong to the part's own file and are examined there.
  const auto is_of_part = [&](const std::string& path) {
    return std::any_of(parts.begin(), parts.end(), [&](const SpecimenKind::Part& part) {
      return path.starts_with(part.key + ".");
    });
  };
  add(kind, file, unusual_numbers(numbers, "", is_of_part));
  return found;
}

std::string in_words(const Finding& finding) {
  const std::string place = finding.place.text();
  return finding.sentence.starts_with(place) ? finding.sentence : place + ": " + finding.sentence;
}

}  // namespace latsch::experiment
