// SPDX-License-Identifier: Apache-2.0
// Compares footprint and load of shipped tires, from the first millimeter of deflection on, with
// refined meshes. The quantities are length, width, area and peak pressure of the contact patch,
// and Fz. The test "footprint" uses a separate mesh with short elements below the tread; Fz is also
// computed on the tire's own mesh, which all other tests use. Rows are judged from a deflection of
// one millimeter on, because before that a patch is shorter than an element.
//
// In the reference mesh, every sector of the first zone of sectors, which contains the contact, is
// divided into four. Every element along the section is divided into four too, or into two if its
// columns are half as long. A mesh shows pressures as means over the area of a node, so peaks rise
// with refinement; they are therefore compared as sensors of 15 mm would measure them, at any
// place. The lengths of the elements were chosen on all four tires from a few candidates. The race
// tire is pressed to 10 mm only: beyond that it stands on the edges of its tread. The first rows
// show friction for every shipped tire: loads every 2.5 mm, as in studies, compared with steps of a
// tenth of that.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "experiment/rigs/fe_tire/tire_footprint.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/fine_tread.h"
#include "models/fe_tire/description/tire_description.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr double kEarly = 2.5e-3;  // m, deflection up to which errors count as early
// deflection, m, above which the contact patch is at least as long as an element of the tire's own
// mesh
constexpr double kFirst = 1e-3;
// Residual tolerance for the reference mesh: sums over its many elements have more rounding error
// than the default allows.
constexpr double kTolerance = 3e-4;
constexpr double kSensor = 15e-3;  // m, side of a square pressure sensor

/// Returns the tire with every sector of the contact zone divided into four, and every element
/// along the section into `along_section`.
FeTire refined(TireDescription tire, int along_section) {
  constexpr int kParts = 4;
  SectorZone& contact = tire.section.sector_zones.front();
  tire.section.sectors += 2 * (kParts - 1) * contact.sectors;
  contact = {kParts * contact.sectors, contact.width / kParts};
  const MeshRefinement along(1, along_section, 1);
  return FeTire(build_mesh(tire, along),
                build_materials(tire, along),
                {.element = tire.element, .tolerance = kTolerance});
}

struct Quantity {
  const char* name;
  double reach;
  std::function<double(const Standing&)> of;
};

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all = {
      {"Fz", 0.01, [](const Standing& s) { return s.force.z(); }},
      {"length", 0.03, [](const Standing& s) { return s.patch.length; }},
      {"width", 0.03, [](const Standing& s) { return s.patch.width; }},
      {"area", 0.03, [](const Standing& s) { return s.patch.area; }},
      {"peak pressure", 0.10, [](const Standing& s) {
         return experiment::footprint_of(s, 0.0).peak_pressure(kSensor);
       }}};
  return all;
}

std::vector<Standing> pressed(FeTire& tire,
                              double pressure,
                              const Ground& ground,
                              const std::vector<double>& deflections) {
  const Inflated inflated = value_of(tire.inflate(pressure));
  std::vector<Standing> standing;
  for (const TireState& state : value_of(tire.press(inflated, ground, deflections)))
    standing.push_back(tire.stand(state));
  return standing;
}

/// Relative errors as text, "+0.3 -1.2 ...", and the largest of their magnitudes.
struct Errors {
  std::string text;
  double worst = 0.0;
  void add(double error) {
    text += fmt::format("{}{:+.1f}", text.empty() ? "" : " ", 100.0 * error);
    worst = std::max(worst, std::abs(error));
  }
};

void compare(const std::string& name, double deepest, int along_section, Table& table) {
  const TireDescription description = shipped_tire(name);
  std::vector<double> deflections;
  for (const double millimeters : {0.5, 1.0, 1.75, 2.5, 5.0, 7.5, 10.0, 15.0, 20.0, 25.0}) {
    if (1e-3 * millimeters <= deepest) deflections.push_back(1e-3 * millimeters);
  }
  FeTire own(description), tire(with_split_tread(description, split_of(description, {}))),
      fine = refined(description, along_section);
  const auto of_own_mesh = pressed(own, description.pressure, {}, deflections);
  const auto ours = pressed(tire, description.pressure, {}, deflections);
  const auto judge = pressed(fine, description.pressure, {}, deflections);
  for (std::size_t i = 0; i < ours.size(); ++i) {
    std::string text;
    for (const Quantity& quantity : quantities())
      text += fmt::format(
          "{} {:.4g} ({:.4g})  ", quantity.name, quantity.of(ours[i]), quantity.of(judge[i]));
    table.note(fmt::format("{}, {:.4g} mm, SI (refined)", name, 1e3 * deflections[i]), text);
  }
  // Adds rows for the errors of a quantity, at small and at larger deflections. Errors below a
  // given deflection are printed but not judged.
  const auto rows = [&](const std::string& what,
                        const Quantity& quantity,
                        const std::vector<Standing>& of,
                        double from) {
    Errors told, early, late;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const double error = quantity.of(of[i]) / quantity.of(judge[i]) - 1.0;
      (deflections[i] < from ? told : deflections[i] <= kEarly ? early : late).add(error);
    }
    const auto row = [&](const std::string& where, const Errors& errors) {
      table.row(fmt::format("{}: {}, {}", name, what, where),
                errors.text + " %",
                fmt::format("<= {:.0f} %", 100.0 * quantity.reach),
                errors.worst <= quantity.reach);
    };
    if (!told.text.empty()) table.note(fmt::format("{}: {}, before", name, what), told.text + " %");
    row(fmt::format("{:.3g} to 2.5 mm", 1e3 * from), early);
    row("deeper", late);
  };
  for (const Quantity& quantity : quantities())
    rows(quantity.name, quantity, ours, deflections.front());
  rows("Fz on the tire's own mesh", quantities().front(), of_own_mesh, kFirst);
}

void compare_friction(const std::string& name, const Options& options, Table& table) {
  constexpr double kReach = 3e-3;
  const TireDescription description = tire_for(options, name);
  FeTire tire(description);
  const Ground ground{.mu = 0.8};
  constexpr double kStep = 2.5e-3;  // m
  constexpr int kFewParts = 3;
  const int load_count = options.size(4, 1), fine_parts = options.size(10, 4);
  // Returns Fz at the prescribed deflections, each reached from the one before in `parts` steps.
  const auto loads = [&](int parts) {
    std::vector<double> deflections, Fz;
    for (int i = 1; i <= load_count * parts; ++i) deflections.push_back(kStep * i / parts);
    const auto standing = pressed(tire, description.pressure, ground, deflections);
    for (int i = 1; i <= load_count; ++i) Fz.push_back(standing[i * parts - 1].force.z());
    return Fz;
  };
  const std::vector<double> ours = loads(1), few = loads(kFewParts), judge = loads(fine_parts);
  Errors errors, errors_of_few;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    errors.add(ours[i] / judge[i] - 1.0);
    errors_of_few.add(few[i] / judge[i] - 1.0);
  }
  table.full_row(name + ": Fz on friction 0.8, every 2.5 mm to 10 mm, against steps of a tenth",
                 fmt::format("{} %, at most {:.2f} %", errors.text, 100.0 * errors.worst),
                 fmt::format("<= {:.1f} %", 100.0 * kReach),
                 errors.worst <= kReach);
  table.note(
      name + ": the same asked for every 0.83 mm",
      fmt::format("{} %, at most {:.2f} %", errors_of_few.text, 100.0 * errors_of_few.worst));
}

/// Shows friction on a coarse tire. Its contact patch must be symmetric and have the area that load
/// and pressure imply, within a factor.
void smoke(const Options& options, Table& table) {
  compare_friction("passenger_205_55R16", options, table);
  FeTire tire(tire_for(options, "passenger_205_55R16"));
  const Standing standing = pressed(tire, 2.6e5, {}, {0.01, 0.02}).back();
  for (const Quantity& quantity : quantities())
    table.note(quantity.name, fmt::format("{:.4g}, SI", quantity.of(standing)));
  const double mean = standing.force.z() / standing.patch.area;
  table.row("mean pressure of the patch over the inflation's",
            fmt::format("{:.2f}", mean / 2.6e5),
            "0.5 .. 3",
            mean > 0.5 * 2.6e5 && mean < 3.0 * 2.6e5);
}

}  // namespace

int run(const Options& options) {
  Table table("footprint", options);
  if (options.is_smoke()) {
    smoke(options, table);
    return table.exit_code();
  }
  for (const char* tire : {"passenger_205_55R16",
                           "race_16x7.5-10",
                           "passenger_225_50R16",
                           "passenger_235_45R20",
                           "comparison_225_50R16",
                           "comparison_235_45R20"}) {
    compare_friction(tire, options, table);
  }
  if (options.text("WHAT") == "friction") return table.exit_code();
  compare("passenger_205_55R16", 0.025, 4, table);
  compare("race_16x7.5-10", 0.010, 4, table);
  compare("passenger_225_50R16", 0.025, 4, table);
  compare("passenger_235_45R20", 0.025, 2, table);
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(
      argc, argv, {{"WHAT", "", "friction: that alone"}}, latsch::benchmarks::run);
}
