// SPDX-License-Identifier: Apache-2.0
// Reader of a tire file: the tables [mesh], [section], [rubber.*], [region.*], [layer.*], [rim],
// [friction] and [reduced], see docs/fe_tire_section.md.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <set>

#include "base/text.h"
#include "models/fe_tire/description/section_check.h"
#include "models/fe_tire/description/section_plan.h"
#include "models/fe_tire/description/size_designation.h"

namespace latsch::fe_tire {
namespace {

constexpr int kMostElements = 2000;  // largest number of elements along one direction
/// Friction that a tire can have with a road; without friction it carries no side force.
constexpr double kLeastFriction = 0.01, kMostFriction = 5.0;
/// Largest power of the pressure by which friction falls: a round limit, not one of a theory.
constexpr double kMostExponent = 0.5;

/// Narrowest and widest peak over the sliding speed, in natural logarithms of it. A narrower peak
/// falls so steeply that no tread slides on it steadily.
constexpr double kNarrowest = 0.3, kWidest = 5.0;

/// Highest frequencies of a reduced tire, Hz: below the first one its belt hardly bends, and above
/// the second one there are so many modes that the full tire is no slower.
constexpr double kLeastReduced = 50.0, kMostReduced = 600.0;

/// Throws InputError if one of two keys that need each other is missing. Returns whether both are
/// there.
bool has_both(const Node& node, const char* a, const char* b, const char* what_they_are) {
  if (node.has(a) != node.has(b))
    node.reject(node.has(a) ? a : b,
                fmt::format("stands without {}: expected both, {}, or neither",
                            node.has(a) ? b : a,
                            what_they_are));
  return node.has(a);
}

/// Reads the table [friction].
RollingFriction read_friction_law(const Node& node) {
  RollingFriction friction;
  const Range usual = Range::between(kLeastFriction, kMostFriction);
  friction.at_rest = node.quantity("static", "1", usual);
  if (has_both(node,
               "pressure",
               "slope_pressure",
               "the contact pressure at which static holds and the power by which friction falls "
               "above it")) {
    friction.p_0 = node.quantity("pressure", "Pa", Range::between(1e3, 1e8));
    friction.a = node.quantity("slope_pressure", "1", Range::between(0.0, kMostExponent));
  }
  if (!has_both(node,
                "peak",
                "peak_speed",
                "the largest coefficient and the sliding speed at which friction has it")) {
    if (node.has("peak_width"))
      node.reject("peak_width", "stands without peak: expected peak and peak_speed beside it");
    return friction;
  }
  const double peak = node.quantity("peak", "1", usual);
  if (peak < friction.at_rest)
    node.reject("peak",
                fmt::format("is {:g}, below static = {:g}: expected the largest coefficient, at "
                            "peak_speed, which is that at rest or more",
                            peak,
                            friction.at_rest));
  friction.peak = peak / friction.at_rest;
  friction.peak_speed = node.quantity("peak_speed", "m/s", Range::between(1e-3, 100.0));
  friction.width =
      node.quantity("peak_width", "1", Range::between(kNarrowest, kWidest), friction.width);
  return friction;
}

/// Reads friction = 1.2, or a table in which it depends on pressure and sliding speed.
std::optional<RollingFriction> read_friction(const Node& root) {
  for (const char* key : {"friction_pressure", "friction_exponent"})
    if (root.has(key))
      root.reject(key,
                  "has become part of a table: expected [friction] with static, pressure and "
                  "slope_pressure in place of friction, friction_pressure and friction_exponent");
  if (!root.has("friction")) return {};
  std::optional<Node> table;
  try {
    table = root.find_table("friction");
  } catch (const InputError&) {  // a number
  }
  if (table) return read_friction_law(*table);
  return RollingFriction{
      .at_rest = root.quantity("friction", "1", Range::between(kLeastFriction, kMostFriction))};
}

Extent read_extent(const Node& node) {
  const Range unit = Range::between(0.0, 1.0);
  const Extent extent{node.quantity("from", "1", unit, 0.0), node.quantity("to", "1", unit, 1.0)};
  if (extent.from >= extent.to)
    node.reject("to", fmt::format("is {}, expected more than from = {}", extent.to, extent.from));
  return extent;
}

WallProfile read_profile(const Node& node, const char* key) {
  WallProfile profile;
  for (const std::vector<double>& row : node.rows(key, {"1", "m"})) {
    if (!profile.position.empty() && row[0] <= profile.position.back())
      node.reject(key,
                  fmt::format("has position {} after {}, expected ascending positions from 0 "
                              "(crown) to 1 (bead)",
                              row[0],
                              profile.position.back()));
    if (row[0] < 0.0 || row[0] > 1.0)
      node.reject(key, fmt::format("has position {}, expected 0 (crown) to 1 (bead)", row[0]));
    profile.position.push_back(row[0]);
    profile.length.push_back(row[1]);
  }
  if (profile.position.empty()) node.reject(key, "is empty, expected rows of position and length");
  return profile;
}

WallProfile read_thickness(const Node& section, const char* key) {
  const WallProfile profile = read_profile(section, key);
  for (std::size_t i = 0; i < profile.length.size(); ++i)
    if (!(profile.length[i] > 0.0))
      section.reject(key,
                     fmt::format("has thickness {} mm at position {}, expected more than 0",
                                 1e3 * profile.length[i],
                                 profile.position[i]));
  return profile;
}

SpacingProfile read_spacing(const Node& mesh) {
  SpacingProfile spacing;
  if (!mesh.has("spacing")) return spacing;
  for (const std::vector<double>& row : mesh.rows("spacing", {"1", "1"})) {
    const double last = spacing.position.empty() ? -1.0 : spacing.position.back();
    if (row[0] <= last || row[0] > 1.0 || !(row[1] > 0.0) || row[1] > 100.0)
      mesh.reject(
          "spacing",
          fmt::format("has the row [{}, {}], expected ascending positions from 0 (crown) to "
                      "1 (bead) and relative lengths above 0 and up to 100",
                      row[0],
                      row[1]));
    spacing.position.push_back(row[0]);
    spacing.length.push_back(row[1]);
  }
  if (spacing.position.size() < 2 || spacing.position.front() != 0.0 ||
      spacing.position.back() != 1.0)
    mesh.reject("spacing", "must have a row at position 0 (crown) and one at 1 (bead)");
  return spacing;
}

/// Reads the positions at which columns end, which replace the number and relative lengths of
/// columns. Returns an empty list if the key is not given.
std::vector<double> read_columns(const Node& mesh) {
  constexpr const char* kKey = "columns";
  if (!mesh.has(kKey)) return {};
  for (const char* other : {"meridional", "spacing"}) {
    if (mesh.has(other)) mesh.reject(other, "is given beside columns, expected one of them");
  }
  const std::vector<double> columns = mesh.quantities(kKey, "1");
  const bool ascending =
      std::ranges::adjacent_find(columns, std::greater_equal<>()) == columns.end();
  if (columns.size() < 3 || columns.size() > kMostElements / 2 || columns.front() != 0.0 ||
      columns.back() != 1.0 || !ascending) {
    mesh.reject(kKey,
                fmt::format("must be ascending positions from 0 (crown) to 1 (bead), 3 to {} of "
                            "them",
                            kMostElements / 2));
  }
  return columns;
}

/// Splits each column into `parts` columns of equal width.
std::vector<double> split(const std::vector<double>& columns, int parts) {
  std::vector<double> ends;
  for (std::size_t j = 0; j + 1 < columns.size(); ++j) {
    for (int k = 0; k < parts; ++k)
      ends.push_back(columns[j] + (columns[j + 1] - columns[j]) * k / parts);
  }
  if (!columns.empty()) ends.push_back(columns.back());
  return ends;
}

/// Throws InputError unless one of the two keys for the columns is given.
void expect_columns(const Node& mesh) {
  if (mesh.has("columns") || mesh.has("meridional")) return;
  for (const std::string& key : mesh.keys()) {
    const std::string meant = did_you_mean(key, {"columns", "meridional"});
    if (!meant.empty()) mesh.reject(key, "is not known" + meant);
  }
  mesh.reject("meridional",
              "is missing, expected the number of columns of elements, or columns, the positions "
              "where they end");
}

/// Reads pairs [count, "width"] of sectors, from the contact upward. All other sectors share the
/// rest of half the ring.
std::vector<SectorZone> read_sector_zones(const Node& mesh, int sectors) {
  constexpr const char* kKey = "sector_zones";
  std::vector<SectorZone> zones;
  if (!mesh.has(kKey)) return zones;
  if (sectors % 2 != 0) {
    mesh.reject(kKey,
                fmt::format("needs an even number of sectors, the same on both sides of the "
                            "contact; found {}",
                            sectors));
  }
  int left = sectors / 2;
  double angle = std::numbers::pi;
  for (const std::vector<double>& row : mesh.rows(kKey, {"1", "rad"})) {
    if (!(row[0] >= 1.0 && row[0] < left && row[0] == std::floor(row[0]) && row[1] > 0.0)) {
      mesh.reject(kKey,
                  fmt::format("has the row [{}, {:.4g} deg], expected a number of sectors from 1 "
                              "to {} and the width of each",
                              row[0],
                              row[1] * 180.0 / std::numbers::pi,
                              left - 1));
    }
    zones.push_back({static_cast<int>(row[0]), row[1]});
    left -= zones.back().sectors;
    angle -= zones.back().sectors * zones.back().width;
  }
  const double widest = std::numbers::pi / 4.0;
  if (angle <= 0.0 || angle / left > widest) {
    mesh.reject(kKey,
                fmt::format("leaves {:.4g} of 180 deg to the {} other sectors, expected more than "
                            "0 and up to 45 deg each",
                            angle * 180.0 / std::numbers::pi,
                            left));
  }
  return zones;
}

std::vector<MeridianPoint> read_contour(const Node& section) {
  std::vector<MeridianPoint> points;
  for (const std::vector<double>& row : section.rows("contour", {"m", "m"})) {
    const MeridianPoint p{row[0], row[1]};
    if (p.r <= 0.0)
      section.reject("contour", fmt::format("has radius {} mm, expected more than 0", 1e3 * p.r));
    if (p.y < 0.0)
      section.reject("contour",
                     fmt::format("has half width {} mm, expected the half with y >= 0", 1e3 * p.y));
    if (!points.empty() && std::hypot(p.y - points.back().y, p.r - points.back().r) < 1e-6)
      section.reject("contour", fmt::format("repeats the point [{}, {}] mm", 1e3 * p.y, 1e3 * p.r));
    points.push_back(p);
  }
  if (points.size() < 3)
    section.reject(
        "contour",
        fmt::format("has {} points, expected at least 3 from crown to bead", points.size()));
  if (points.front().y != 0.0)
    section.reject(
        "contour",
        fmt::format("starts at half width {} mm, expected 0 at the crown", 1e3 * points.front().y));
  return points;
}

Section read_section(const Node& node, const Node& mesh) {
  Section section;
  section.contour = read_contour(node);
  section.inside = read_thickness(node, "thickness_inside");
  section.outside = read_thickness(node, "thickness_outside");
  section.tread_to = node.quantity("tread_to", "1", {0.0, 1.0, true});
  const std::string clamp = node.choice("clamp", {"whole", "inside", "outside"}, "whole");
  section.clamp = clamp == "whole"    ? BeadClamp::whole
                  : clamp == "inside" ? BeadClamp::inside
                                      : BeadClamp::outside;
  expect_columns(mesh);
  const int parts = static_cast<int>(mesh.integer("split_columns", 1, 8, 1));
  section.columns = split(read_columns(mesh), parts);
  section.meridional = section.columns.empty()
                           ? parts * static_cast<int>(mesh.integer("meridional", 4, kMostElements))
                           : 2 * (static_cast<int>(section.columns.size()) - 1);
  section.rows_inside = static_cast<int>(mesh.integer("rows_inside", 1, 20, 1));
  section.rows_outside = static_cast<int>(mesh.integer("rows_outside", 1, 20, 1));
  section.spacing = read_spacing(mesh);
  section.sectors = static_cast<int>(mesh.integer("sectors", 8, kMostElements));
  section.sector_zones = read_sector_zones(mesh, section.sectors);
  if (const std::string conflict = wall_conflict(section); !conflict.empty())
    node.reject("contour", conflict);
  return section;
}

void check_size(const Node& root, TireDescription& tire) {
  const auto size = parse_size(tire.size);
  if (!size)
    root.reject("size",
                fmt::format("is \"{}\", expected a size such as \"225/50R16\", \"16x7.5-10\" or "
                            "\"10.00R20\"",
                            tire.size));
  const OuterSize outer = outer_size(tire.section);
  const std::string conflict =
      size_conflict(*size, outer.radius, outer.width, tire.section.contour.back());
  if (!conflict.empty())
    root.table("section").reject("contour", conflict + fmt::format(" (\"{}\")", tire.size));
}

/// Frequencies between which a stated loss factor holds, Hz: from slow walking to the passage of a
/// patch's edge at high speed. A wider band stiffens the rubber further.
constexpr double kLossFrom = 0.1, kLossTo = 1000.0;

/// Reads the history of a stress: `prony`, rows of a share relative to the relaxed modulus and a
/// relaxation time, or `loss_factor`. Returns no terms if the file has neither.
PronyTerms read_prony(const Node& node) {
  if (node.has("loss_factor")) {
    if (node.has("prony"))
      node.reject("prony", "is given beside loss_factor, expected one of them");
    const double factor = node.quantity("loss_factor", "1", Range::between(0.0, 1.0));
    const auto terms = constant_loss_factor(factor, kLossFrom, kLossTo);
    if (!terms) node.reject("loss_factor", "is not possible: " + terms.failure().reason);
    return *terms;
  }
  PronyTerms terms;
  if (!node.has("prony")) return terms;
  for (const std::vector<double>& row : node.rows("prony", {"1", "s"}))
    terms.push_back({row[0], row[1]});
  if (terms.empty())
    node.reject("prony",
                "is empty, expected rows of a share and a relaxation time such as [0.2, \"1 ms\"]");
  if (const Status good = check(terms); !good.ok()) node.reject("prony", good.failure().reason);
  return terms;
}

Rubber read_rubber(const Node& node) {
  Rubber rubber;
  rubber.name = node.name();
  const std::string law = node.choice("law", {"neo-Hooke", "Mooney-Rivlin"}, "neo-Hooke");
  const double E = node.quantity("young_modulus", "Pa", Range::positive());
  const double ratio =
      law == "Mooney-Rivlin" ? node.quantity("C01_over_C10", "1", Range::not_negative()) : 0.0;
  double nu = 0.0;
  if (node.has("bulk_modulus")) {
    if (node.has("poisson_ratio"))
      node.reject("poisson_ratio", "is given beside bulk_modulus, expected one of them");
    const double K = node.quantity("bulk_modulus", "Pa", Range::positive());
    nu = 0.5 - E / (6.0 * K);
    if (nu <= 0.0)
      node.reject(
          "bulk_modulus",
          fmt::format("is too small for this Young's modulus: Poisson's ratio would be {:.3f}",
                      nu));
  } else {
    nu = node.quantity("poisson_ratio", "1", {0.0, 0.49999, true});
  }
  rubber.law = Hyperelastic::from_young_modulus(E, nu, ratio);
  rubber.density = node.quantity("density", "kg/m^3", Range::positive());
  rubber.prony = read_prony(node);
  return rubber;
}

RubberRegion read_region(const Node& node, const std::vector<Rubber>& rubbers) {
  RubberRegion region;
  region.name = node.name();
  region.extent = read_extent(node);
  const std::string side = node.choice("side", {"both", "inside", "outside"}, "both");
  region.side = side == "both"     ? LineSide::both
                : side == "inside" ? LineSide::inside
                                   : LineSide::outside;
  std::vector<std::string> names;
  names.reserve(rubbers.size());
  for (const Rubber& rubber : rubbers) names.push_back(rubber.name);
  const std::string name = node.choice("rubber", names);
  region.rubber = static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
  return region;
}

/// Reads the cross-sectional area of one cord, m^2.
double cord_area(const Node& node) {
  if (!node.has("cord_diameter")) return node.quantity("cord_area", "m^2", Range::positive());
  if (node.has("cord_area"))
    node.reject("cord_area", "is given beside cord_diameter, expected one of them");
  const double d = node.quantity("cord_diameter", "m", Range::positive());
  return 0.25 * std::numbers::pi * d * d;
}

CordPly read_ply(const Node& node, const Section& section) {
  // 90 deg, with a tolerance for rounding
  constexpr double kRightAngle = 0.5 * std::numbers::pi + 1e-12;
  CordPly ply;
  ply.name = node.name();
  ply.extent = read_extent(node);
  const char* offset_key = node.has("offsets") ? "offsets" : "offset";
  ply.offset = node.has("offsets") ? read_profile(node, "offsets")
                                   : WallProfile{{0.0}, {node.quantity("offset", "m")}};
  ply.lifted = node.flag("lifted", false);
  CordLayer& cords = ply.cords;
  cords.angle = node.quantity("angle", "rad", Range::between(-kRightAngle, kRightAngle));
  cords.thickness = cord_area(node) / node.quantity("spacing", "m", Range::positive());
  cords.E_tension = node.quantity("young_modulus", "Pa", Range::positive());
  cords.E_compression =
      node.quantity("compression_modulus", "Pa", Range::not_negative(), cords.E_tension);
  cords.pretension = node.quantity("pretension", "Pa", {}, 0.0);
  cords.density = node.quantity("density", "kg/m^3", Range::not_negative());
  ply.prony = read_prony(node);
  if (const std::string conflict = ply_conflict(section, ply); !conflict.empty())
    node.reject(offset_key, conflict);
  return ply;
}

/// Reads the rim body. It is optional, because only tests in which the rim moves need it.
std::optional<RimBody> read_rim(const Node& root) {
  const auto node = root.find_table("rim");
  if (!node) return std::nullopt;
  RimBody rim;
  rim.mass = node->quantity("mass", "kg", Range::positive());
  rim.spin_inertia = node->quantity("inertia_spin", "kg m^2", Range::positive());
  rim.diametral_inertia = node->quantity("inertia_diameter", "kg m^2", Range::positive());
  if (rim.spin_inertia > 2.0 * rim.diametral_inertia)
    node->reject(
        "inertia_spin",
        fmt::format("is {:.4g} kg m^2, more than twice the inertia about a diameter, which "
                    "no body has; expected at most {:.4g} kg m^2",
                    rim.spin_inertia,
                    2.0 * rim.diametral_inertia));
  const auto spring = [&](const char* key, const char* unit) {
    return node->quantity(key, unit, Range::not_negative(), 0.0);
  };
  rim.radial_spring = spring("radial_spring", "N/m");
  rim.lateral_spring = spring("lateral_spring", "N/m");
  rim.spin_spring = spring("spin_spring", "N m/rad");
  rim.tilt_spring = spring("tilt_spring", "N m/rad");
  return rim;
}

/// Reads the highest frequency, Hz, of a tire that is reduced in time.
std::optional<double> read_reduction(const Node& root) {
  const auto node = root.find_table("reduced");
  if (!node) return std::nullopt;
  return node->quantity("highest", "Hz", Range::between(kLeastReduced, kMostReduced));
}

/// Reads which plies are faces between rows of elements.
void read_faces(const Node& mesh, TireDescription& tire) {
  constexpr const char* kKey = "faces";
  if (!mesh.has(kKey)) return;
  if (tire.cord_model == CordModel::smeared) {
    mesh.reject(kKey, "is given beside cords = \"smeared\", which has no plies to lie on");
  }
  for (const std::string& name : mesh.texts(kKey)) {
    const auto ply = std::ranges::find(tire.plies, name, &CordPly::name);
    if (ply == tire.plies.end()) {
      mesh.reject(kKey, "names " + in_quotes(name) + ", expected the name of a layer");
    }
    tire.section.faces.push_back(ply->offset);
    const double to = ply->extent.to;
    if (tire.section.faces.size() == 1) tire.section.first_face_to_bead = to == 1.0;
    if (to < 1.0) tire.section.faces_to = std::max(tire.section.faces_to, to);
  }
  if (tire.section.faces_to == 0.0) tire.section.faces_to = 1.0;
  if (const std::string conflict = row_conflict(tire.section); !conflict.empty()) {
    mesh.reject(kKey, conflict);
  }
}

/// Sets the positions where plies and rubbers end as ends of columns, unless all columns have the
/// same length.
void place_ends(TireDescription& tire) {
  const Section& section = tire.section;
  if (section.faces.empty() && section.spacing.position.empty() && section.columns.empty()) return;
  std::set<double> ends;
  for (const CordPly& ply : tire.plies) ends.insert({ply.extent.from, ply.extent.to});
  for (const RubberRegion& region : tire.regions) {
    ends.insert({region.extent.from, region.extent.to});
  }
  ends.erase(0.0);
  ends.erase(1.0);
  tire.section.ends.assign(ends.begin(), ends.end());
}

/// Throws InputError if a region or a layer contains no element, or if an element belongs to no
/// region or to more than one.
void check_plan(const Node& root, const TireDescription& tire) {
  const SectionPlan plan(tire);
  std::vector<char> region_used(tire.regions.size()), ply_used(tire.plies.size());
  for (int column = 0; column < plan.columns(); ++column) {
    for (int row = 0; row < plan.rows(); ++row) region_used[plan.region(column, row)] = 1;
    for (const auto& here : plan.plies(column)) ply_used[here.ply] = 1;
  }
  const auto reject_unused = [&](const char* kind, const std::vector<char>& used) {
    const std::vector<Node> nodes = root.named_tables(kind);
    for (std::size_t i = 0; i < used.size(); ++i)
      if (!used[i])
        nodes[i].reject("to",
                        fmt::format("makes an extent without any element, expected a wider one or "
                                    "more than {} meridional elements",
                                    tire.section.meridional));
  };
  reject_unused("region", region_used);
  reject_unused("layer", ply_used);
}

}  // namespace

TireDescription read_tire(const Node& root) {
  if (root.has("kind"))
    root.reject("kind",
                "is " + in_quotes(root.text("kind")) +
                    ", expected a tire of finite elements, which has no kind but a [mesh]");
  TireDescription tire;
  tire.place = root.place();
  tire.name = root.text("name");
  tire.size = root.text("size");
  tire.pressure = root.quantity("pressure", "Pa", Range::positive());
  const Node mesh = root.table("mesh");
  tire.section = read_section(root.table("section"), mesh);
  const std::string cords = mesh.choice("cords", {"rebar", "smeared"}, "rebar");
  tire.cord_model = cords == "rebar" ? CordModel::rebar : CordModel::smeared;
  const std::string element =
      mesh.choice("element", {"solid_shell", "full_integration"}, "solid_shell");
  tire.element =
      element == "solid_shell" ? ElementKind::solid_shell : ElementKind::full_integration;
  for (const Node& node : root.named_tables("rubber")) tire.rubbers.push_back(read_rubber(node));
  for (const Node& node : root.named_tables("region"))
    tire.regions.push_back(read_region(node, tire.rubbers));
  for (const Node& node : root.named_tables("layer"))
    tire.plies.push_back(read_ply(node, tire.section));
  read_faces(mesh, tire);
  place_ends(tire);
  tire.rim = read_rim(root);
  tire.friction = read_friction(root);
  tire.reduced_to = read_reduction(root);
  root.close();
  check_size(root, tire);
  check_plan(root, tire);
  return tire;
}

}  // namespace latsch::fe_tire
