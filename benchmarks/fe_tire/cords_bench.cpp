// SPDX-License-Identifier: Apache-2.0
// Compares cords modeled as rebars in our program with cords modeled as springs and trusses tied to
// the rubber in CalculiX, on the same tire. A 205/55R16 with all its plies, the comparison element
// and equal rubber in both programs is inflated, its modes are computed off the ground, and it is
// pressed on the ground. Only the cords differ (cord_trusses.h): in CalculiX they are separate,
// three in a sector, in pieces of a sixth of an element; a run with fewer shows the remaining
// error. Cords have no mass and equal moduli in compression and tension. CalculiX' trusses are
// compared with its springs on a mesh as coarse as their unknowns require.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "calculix.h"
#include "cord_trusses.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr int kModes = 20, kSteps = 5;
// Distance, m, from the undeformed tire to the ground, and travel, m, of the ground.
constexpr double kClear = 2e-3, kTravel = 27e-3;
constexpr double kForce = 3e-3, kFrequency = 5e-3, kPieces = 1e-3;
constexpr CordFamily kFew{2, 4}, kMany{3, 6};

TireDescription tire_of(int meridional, int sectors) {
  TireDescription tire = shipped_tire("passenger_205_55R16");
  Section& section = tire.section;
  section.columns.clear();
  section.meridional = meridional;
  section.sectors = sectors;
  section.sector_zones.clear();
  section.faces.clear();  // rows of elements that end inside the mesh would have tied corners
  section.first_face_to_bead = false;
  tire.element = ElementKind::full_integration;
  for (CordPly& ply : tire.plies) {
    ply.cords.E_compression = ply.cords.E_tension;
    ply.cords.density = 0.0;
  }
  return tire;
}

struct Answer {
  double growth = 0.0, Fz = 0.0;  // m, N
  std::vector<double> frequencies;
};

Answer ours(const TireDescription& description) {
  FeTire tire(description);
  const Inflated inflated = value_of(tire.inflate(description.pressure));
  Answer answer;
  answer.growth = inflated.growth;
  for (const Mode& mode : value_of(tire.modes(inflated, kModes)))
    answer.frequencies.push_back(mode.frequency);
  const double touch = tire.mesh().outer_radius() + kClear - inflated.radius;
  std::vector<double> way;
  for (int i = 1; i <= kSteps; ++i) way.push_back(kTravel * i / kSteps - touch);
  const TireState pressed = value_of(tire.press(inflated, Ground{}, way)).back();
  answer.Fz = tire.stand(pressed).force.z();
  return answer;
}

/// Results that CalculiX has to compute.
struct Asked {
  bool modes = true, load = false;
};

Answer theirs(const TireDescription& description,
              const CordFamily& family,
              const Asked& asked,
              Table& table) {
  Mesh mesh = build_mesh(description);
  const Materials materials = build_materials(description);
  const CordTrusses cords = cord_trusses(mesh, materials, family);
  for (Element& element : mesh.elements) element.rebars.clear();
  formats::CcxRun run =
      calculix_trial(description.name, mesh, description.pressure, kClear, kTravel, kModes, false);
  if (!asked.modes) run.modes = 0;
  if (!asked.load) run.ground.reset();
  const auto calculix = run_calculix(mesh, materials, run, {.model_cards = cords.cards});
  if (!calculix) throw std::runtime_error("CalculiX did not finish");
  const formats::CcxResults& results = calculix->results;
  Answer answer;
  answer.growth = -1e-3 * results.displacement.at(1 + mesh.sensors[2]).y();
  if (asked.load) answer.Fz = results.total_force.at("GROUND").y();
  answer.frequencies = results.frequencies;
  table.note(
      fmt::format(
          "{} pieces of cords{}", cords.count, family.piece == CordPiece::truss ? ", trusses" : ""),
      fmt::format(
          "{:.1f} cm^3, {:.0f} s CPU of CalculiX", 1e6 * cords.volume, calculix->cpu_seconds));
  return answer;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = a.size() == b.size() ? 0.0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    largest = std::max(largest, std::abs(a[i] / b[i] - 1.0));
  return largest;
}

std::string against(double a, double b, const char* unit) {
  return fmt::format("{:+.3f} % ({:.5g} and {:.5g} {})", 100.0 * (a / b - 1.0), a, b, unit);
}

void within(
    Table& table, const std::string& what, const std::string& value, double error, double reach) {
  table.row(what, value, fmt::format("<= {:g} %", 100.0 * reach), std::abs(error) <= reach);
}

/// In a smoke run the mesh has too few pieces of cord for a judgment.
void compare_rebars(Table& table,
                    const TireDescription& tire,
                    const CordFamily& few_cords,
                    const CordFamily& many_cords,
                    bool is_judged) {
  const double factor = is_judged ? 1.0 : 20.0;  // factor on the tolerances
  const Answer here = ours(tire);
  const Answer few = theirs(tire, few_cords, {}, table);
  const Answer many = theirs(tire, many_cords, {.load = true}, table);
  table.note("growth, 20 modes: fewer cords",
             fmt::format("{}, {:.3f} %",
                         against(1e3 * here.growth, 1e3 * few.growth, "mm"),
                         100.0 * largest_difference(here.frequencies, few.frequencies)));
  within(table,
         "growth, rebars and springs",
         against(1e3 * here.growth, 1e3 * many.growth, "mm"),
         here.growth / many.growth - 1.0,
         factor * kForce);
  within(table,
         "Fz, rebars and springs",
         against(here.Fz, many.Fz, "N"),
         here.Fz / many.Fz - 1.0,
         factor * kForce);
  const double modes = largest_difference(here.frequencies, many.frequencies);
  within(table,
         fmt::format("{} modes off the ground, rebars and springs", kModes),
         fmt::format("at most {:.3f} %", 100.0 * modes),
         modes,
         factor * kFrequency);
}

void compare_trusses(Table& table) {
  const TireDescription tire = tire_of(16, 24);
  CordFamily family{1, 2};
  const Answer springs = theirs(tire, family, {}, table);
  family.piece = CordPiece::truss;
  const Answer trusses = theirs(tire, family, {}, table);
  within(table,
         "growth, CalculiX' trusses and its springs",
         against(1e3 * trusses.growth, 1e3 * springs.growth, "mm"),
         trusses.growth / springs.growth - 1.0,
         kPieces);
  table.note("first mode, the same",
             against(trusses.frequencies.front(), springs.frequencies.front(), "Hz"));
}

}  // namespace

int run(const Options& options) {
  Table table("cords", options);
  if (!has_calculix()) {
    table.skip("cords", "no ccx on the path");
    return table.exit_code();
  }
  if (options.is_smoke()) {
    compare_rebars(table, tire_of(10, 12), {1, 2}, {1, 3}, /*is_judged=*/false);
  } else {
    compare_trusses(table);
    compare_rebars(table, tire_of(20, 60), kFew, kMany, /*is_judged=*/true);
  }
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
