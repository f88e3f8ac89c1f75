// SPDX-License-Identifier: Apache-2.0
// CPU time of a trial of the finite-element tire as a function of the size of its mesh. Tire B as
// shipped (inflated, pressed by 25 mm in five steps, 20 modes in the loaded state) is computed with
// two and four times its sectors, and with twice the elements along the section and through the
// wall. The cost of nested dissection of a ring is proportional to its number of sectors; the nodes
// that touch the ground form a dense matrix, whose share of the cost grows.
#include <fmt/format.h>

#include <cmath>

#include "cpu_time.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"
#include "shipped_tires.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using namespace fe_tire;

constexpr double kTravel = 0.025;  // m
constexpr int kModes = 20, kSteps = 5;
// largest exponent e in: CPU time is proportional to (number of sectors)^e
constexpr double kReach = 1.2;

struct Trial {
  int unknowns = 0;
  double seconds = 0.0;  // CPU seconds, including the construction of the tire
};

Trial run_trial(const TireDescription& description, const MeshRefinement& refinement) {
  const double start = cpu_seconds();
  SolverSettings settings;
  settings.element = description.element;
  FeTire tire(
      build_mesh(description, refinement), build_materials(description, refinement), settings);
  const Inflated inflated = value_of(tire.inflate(description.pressure));
  std::vector<double> deflections;
  for (int i = 1; i <= kSteps; ++i) deflections.push_back(kTravel * i / kSteps);
  const TireState loaded = value_of(tire.press(inflated, Ground{}, deflections)).back();
  value_of(tire.modes(loaded, kModes));
  return {tire.mesh().free_dofs(), cpu_seconds() - start};
}

}  // namespace

int run(const Options& options) {
  Table table("mesh_cost", options);
  const TireDescription tire = tire_for(options, "passenger_225_50R16");
  const auto trial = [&](const std::string& what, const MeshRefinement& refinement) {
    const Trial result = run_trial(tire, refinement);
    table.note(what, fmt::format("{} unknowns, {:.2f} s CPU", result.unknowns, result.seconds));
    return result;
  };
  const Trial shipped = trial("as shipped", 1);
  const Trial twice = trial("twice the sectors", {2, 1, 1});
  if (options.is_smoke()) {
    table.row("unknowns with twice the sectors",
              fmt::format("{}", twice.unknowns),
              fmt::format("{}", 2 * shipped.unknowns),
              twice.unknowns == 2 * shipped.unknowns);
    return table.exit_code();
  }
  const Trial four = trial("four times the sectors", {4, 1, 1});
  const Trial section = trial("twice the elements along and through the wall", {1, 2, 2});
  const double exponent = std::log2(twice.seconds / shipped.seconds);
  table.row("exponent in the sectors",
            fmt::format("{:.2f}", exponent),
            fmt::format("<= {:.1f}", kReach),
            exponent <= kReach);
  table.note("the same from twice to four times",
             fmt::format("{:.2f}", std::log2(four.seconds / twice.seconds)));
  table.note("exponent in the unknowns of the section",
             fmt::format("{:.2f}",
                         std::log(section.seconds / shipped.seconds) /
                             std::log(static_cast<double>(section.unknowns) / shipped.unknowns)));
  return table.exit_code();
}

}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, latsch::benchmarks::run);
}
