// SPDX-License-Identifier: Apache-2.0
// Compares the finite-element tire with CalculiX 2.20 on the same input decks: agreement of the
// results, and CPU time with one thread. In the first part, the decks in ../shared/data/ccx, beside
// the project and already computed by CalculiX, are read by our own .inp reader and computed with
// the comparison element. In the second part, the tires A and B of [Hempel & Oertel 2016], exported
// by our own writer, are computed by both programs. A whole trial inflates the tire, presses it by
// 25 mm in five steps, and computes 20 modes of the loaded (B) or unloaded (A) tire. The shipped
// tires have the default element, cords as rebars, and half as many unknowns again; their time is
// compared with that of the same run of CalculiX, which has no rebars.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include "calculix.h"
#include "cpu_time.h"
#include "formats/mesh/inp_tire.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/reference_tires.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

const std::filesystem::path kDecks = LATSCH_SOURCE_DIR "/../shared/data/ccx";
constexpr double kTravel = 0.025;  // m
constexpr int kModes = 20;
constexpr double kClear = 2e-3;  // m, distance of the undeformed tire from the ground
constexpr double kRatio = 30.0;  // least ratio of the CPU time of CalculiX to ours

struct Trial {
  double growth = 0.0;  // m, radial growth of the crown
  double Fz = 0.0;      // N, vertical force at the last deflection
  std::vector<double> frequencies;
};

/// Computes a trial: the ground, `ground_radius` below the wheel center, moves up by `travel` in
/// five steps. There is no ground if `travel` is 0.
Trial run_trial(FeTire& tire,
                double pressure,
                double ground_radius,
                double travel,
                bool loaded_modes,
                double stiffness) {
  Trial trial;
  const Inflated inflated = value_of(tire.inflate(pressure));
  trial.growth = inflated.growth;
  std::vector<Mode> modes;
  if (!loaded_modes) modes = value_of(tire.modes(inflated, kModes));
  if (travel > 0.0) {
    const double from_touch = travel - (ground_radius - inflated.radius);
    std::vector<double> deflections;
    for (int i = 1; i <= 5; ++i) deflections.push_back(from_touch * i / 5);
    const TireState loaded =
        value_of(tire.press(inflated, Ground{stiffness, 0.0}, deflections)).back();
    trial.Fz = tire.stand(loaded).force.z();
    if (loaded_modes) modes = value_of(tire.modes(loaded, kModes));
  }
  for (const Mode& mode : modes) trial.frequencies.push_back(mode.frequency);
  return trial;
}

SolverSettings comparison() {
  SolverSettings settings;
  settings.element = ElementKind::full_integration;
  return settings;
}

double largest_error(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return INFINITY;
  double error = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) error = std::max(error, std::abs(a[i] / b[i] - 1.0));
  return error;
}

void compare_row(Table& table, const std::string& what, double error, double reach) {
  table.row(what,
            fmt::format("{:.4f} %", 100.0 * error),
            fmt::format("<= {:.1f} %", 100.0 * reach),
            error <= reach);
}

/// Compares our results with the CalculiX decks in ../shared/data/ccx, beside the project.
void compare_decks(Table& table) {
  if (!std::filesystem::exists(kDecks)) {
    table.note("agreement with the decks", "skipped: no ../shared/data/ccx beside the project");
    return;
  }
  // No deck prints the growth of the crown; the result file of CalculiX contained 0.833 mm.
  constexpr double kGrowth = 0.833e-3;
  for (const bool loaded : {true, false}) {
    const std::string name = loaded ? "tire_b_loaded" : "tire_b_unloaded";
    const formats::InpTire deck = formats::read_inp_tire(kDecks / (name + ".inp"));
    const formats::CcxResults expected = formats::read_ccx_results(kDecks / (name + ".dat"));
    FeTire tire(deck.mesh, deck.materials, comparison());
    const formats::InpGround ground = deck.ground.value_or(formats::InpGround{});
    const Trial trial = run_trial(
        tire, deck.pressure, ground.radius, loaded ? ground.travel : 0.0, loaded, ground.stiffness);
    if (loaded) {
      compare_row(table, name + ": crown growth", std::abs(trial.growth / kGrowth - 1.0), 1e-3);
      compare_row(table,
                  name + ": Fz",
                  std::abs(trial.Fz / expected.total_force.at("NGR").y() - 1.0),
                  2e-3);
    }
    compare_row(table,
                name + ": 20 modes, largest error",
                largest_error(trial.frequencies, expected.frequencies),
                3e-3);
  }
}

/// Returns the CPU seconds of a trial of a shipped tire, including mesh generation and symbolic
/// factorization. It is the median of several trials, because one takes only a second and other
/// work on the machine changes it by a third; CalculiX runs for a minute, which averages such
/// changes.
double seconds_as_shipped(const TireDescription& description, bool loaded_modes) {
  constexpr int kTrials = 7;
  std::vector<double> seconds;
  for (int i = 0; i < kTrials; ++i) {
    const double start = cpu_seconds();
    FeTire tire(description);
    run_trial(tire,
              description.pressure,
              tire.mesh().outer_radius() + kClear,
              kTravel,
              loaded_modes,
              Ground{}.stiffness);
    seconds.push_back(cpu_seconds() - start);
  }
  std::ranges::nth_element(seconds, seconds.begin() + kTrials / 2);
  return seconds[kTrials / 2];
}

/// Computes one tire in both programs and the shipped tire in ours, and compares results and times.
void race(Table& table,
          const std::string& name,
          const TireDescription& description,
          const std::string& file,
          bool loaded_modes,
          const Options& options) {
  const double start = cpu_seconds();
  const Mesh mesh = build_mesh(description);
  const Materials materials = build_materials(description);
  FeTire tire(mesh, materials, comparison());
  const double prepared = cpu_seconds();
  const double ground_radius = mesh.outer_radius() + kClear;
  const Ground ground;
  const Trial ours =
      run_trial(tire, description.pressure, ground_radius, kTravel, loaded_modes, ground.stiffness);
  const double finished = cpu_seconds();

  const auto calculix = run_calculix(
      mesh,
      materials,
      calculix_trial(
          description.name, mesh, description.pressure, kClear, kTravel, kModes, loaded_modes));
  if (!calculix) {
    table.row(name + ": CalculiX", "did not finish", "finish", false);
    return;
  }
  const double theirs = calculix->cpu_seconds;
  const formats::CcxResults& expected = calculix->results;

  const int crown =
      1 + mesh.sensors[2];  // node number in the deck of the bottom node; -y points outward
  compare_row(table,
              name + ": crown growth, both programs now",
              std::abs(ours.growth * 1e3 / -expected.displacement.at(crown).y() - 1.0),
              1e-3);
  // In the two programs a facet is as long as the contact patch of a coarse mesh, and each
  // integrates the pressure on it in its own way, so Fz is judged with a wide tolerance.
  const double Fz = std::abs(ours.Fz / expected.total_force.at("GROUND").y() - 1.0);
  table.full_row(name + ": Fz, both programs now",
                 fmt::format("{:.4f} %", 100.0 * Fz),
                 "<= 0.2 %",
                 Fz <= 2e-3);
  compare_row(table,
              name + ": 20 modes, both programs now",
              largest_error(ours.frequencies, expected.frequencies),
              3e-3);
  table.note(name + ": CPU of CalculiX", fmt::format("{:.1f} s", theirs));
  table.note(name + ": CPU of our trial", fmt::format("{:.2f} s", finished - prepared));
  table.note(name + ": CPU of our preparation of the mesh",
             fmt::format("{:.2f} s", prepared - start));
  const double ratio = theirs / (finished - start);
  table.full_row(name + ": CPU ratio, preparation included",
                 fmt::format("{:.1f}", ratio),
                 fmt::format(">= {:.0f}", kRatio),
                 ratio >= kRatio);
  if (options.is_smoke()) return;
  const double as_shipped = seconds_as_shipped(shipped_tire(file), loaded_modes);
  table.note(name + ": CPU of our trial, shipped element with rebars, median of seven",
             fmt::format("{:.2f} s", as_shipped));
  table.full_row(name + ": CPU ratio, shipped element with rebars",
                 fmt::format("{:.1f}", theirs / as_shipped),
                 fmt::format(">= {:.0f}", kRatio),
                 theirs >= kRatio * as_shipped);
}

/// Compares meshes whose rows of elements end at plies, where corner nodes are tied by linear
/// equations of the deck. The tire is the shipped section of tire B in 24 sectors with smeared
/// cords and the comparison element, not touching the ground.
void compare_ties(Table& table) {
  TireDescription description = shipped_tire("passenger_225_50R16");
  description.section.sectors = 24;
  description.section.sector_zones.clear();
  description.cord_model = CordModel::smeared;
  const Mesh mesh = build_mesh(description);
  const Materials materials = build_materials(description);
  FeTire tire(mesh, materials, comparison());
  const Trial ours = run_trial(tire, description.pressure, 0.0, 0.0, false, 0.0);
  formats::CcxRun run;
  run.pressure = description.pressure;
  run.modes = kModes;
  run.loaded_modes = false;
  const auto calculix = run_calculix(mesh, materials, run);
  if (!calculix) {
    table.row("tied rows: CalculiX", "did not finish", "finish", false);
    return;
  }
  const formats::CcxResults& expected = calculix->results;
  compare_row(
      table,
      "tied rows: crown growth, both programs now",
      std::abs(ours.growth * 1e3 / -expected.displacement.at(1 + mesh.sensors[2]).y() - 1.0),
      1e-3);
  compare_row(table,
              "tied rows: 20 modes, both programs now",
              largest_error(ours.frequencies, expected.frequencies),
              3e-3);
}

}  // namespace

/// Returns the tire itself, or in a smoke run a copy on a mesh that CalculiX solves in a second.
TireDescription for_race(TireDescription tire, const Options& options) {
  tire.section.meridional = options.size(tire.section.meridional, 13);
  tire.section.sectors = options.size(tire.section.sectors, 12);
  return tire;
}

int run(const Options& options) {
  Table table("ccx", options);
  if (!options.is_smoke()) compare_decks(table);
  if (options.is_smoke() && !has_calculix()) {
    table.skip("CalculiX", "no ccx on the path");
  } else if (options.is_smoke()) {
    race(table, "tire B", for_race(reference_tire_b(), options), "", false, options);
  } else if (!has_calculix()) {
    table.note("CPU time against CalculiX", "skipped: no ccx on the path");
  } else {
    compare_ties(table);
    race(table, "tire B", reference_tire_b(), "passenger_225_50R16", true, options);
    race(table, "tire A", reference_tire_a(), "passenger_235_45R20", false, options);
  }
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
