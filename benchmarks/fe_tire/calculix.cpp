// SPDX-License-Identifier: Apache-2.0
#include "calculix.h"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "cpu_time.h"
#include "models/fe_tire/contact/ground.h"

namespace latsch::benchmarks {

bool has_calculix() { return std::system("command -v ccx > /dev/null 2>&1") == 0; }

namespace {

/// Makes the load step print the contact forces at every increment. The text searched for ends the
/// last step that writes all displacements only at its end; that step then writes after every
/// increment.
void print_every_force(std::string& text) {
  constexpr std::string_view kEnd = "RF\n*NODE FILE,FREQUENCY=100";
  const auto at = text.find(kEnd);
  if (at == std::string::npos) throw std::runtime_error("a deck without a load step");
  text.replace(at, kEnd.size(), "RF\n*NODE FILE,FREQUENCY=1");
}

/// Reads the contact forces of the load step, which begins at time 1. The vertical axis is y in the
/// deck.
std::vector<std::pair<double, double>> forces_of(const std::string& dat) {
  std::vector<std::pair<double, double>> forces;
  constexpr std::string_view kTitle = "for set GROUND and time";
  for (auto at = dat.find(kTitle); at != std::string::npos; at = dat.find(kTitle, at + 1)) {
    std::istringstream numbers(dat.substr(at + kTitle.size(), 200));
    double time = 0.0, x = 0.0, y = 0.0;
    if (!(numbers >> time >> x >> y)) throw std::runtime_error("no force below its title");
    forces.emplace_back(time - 1.0, y);
  }
  return forces;
}

}  // namespace

std::optional<CalculixRun> run_calculix(const fe_tire::Mesh& mesh,
                                        const fe_tire::Materials& materials,
                                        const formats::CcxRun& run,
                                        const DeckChanges& changes) {
  const ScratchFolder folder;
  std::ostringstream deck;
  formats::write_ccx_deck(deck, mesh, materials, run);
  std::string text = std::move(deck).str();
  text.insert(text.find("*BOUNDARY"), changes.model_cards);
  if (changes.every_force) print_every_force(text);
  write_text_file(folder / "tire.inp", text);
  const std::string command = fmt::format(
      "cd '{}' && OMP_NUM_THREADS=1 CCX_NPROC_EQUATION_SOLVER=1 CCX_NPROC_RESULTS=1 ccx -i tire > "
      "tire.log 2>&1",
      folder.path().string());
  const double start = cpu_seconds(RUSAGE_CHILDREN);
  if (std::system(command.c_str()) != 0) return std::nullopt;
  const double seconds = cpu_seconds(RUSAGE_CHILDREN) - start;
  CalculixRun result{formats::read_ccx_results(folder / "tire.dat"), seconds, {}};
  if (changes.every_force) {
    result.ground_forces = forces_of(read_text_file(folder / "tire.dat"));
    result.results.total_force.at("GROUND").y() = result.ground_forces.back().second;
  }
  return result;
}

formats::CcxRun calculix_trial(const std::string& title,
                               const fe_tire::Mesh& mesh,
                               double pressure,
                               double clear,
                               double travel,
                               int modes,
                               bool loaded_modes) {
  formats::CcxRun run;
  run.title = title;
  run.pressure = pressure;
  run.ground =
      formats::CcxGround{mesh.outer_radius() + clear, travel, fe_tire::Ground{}.stiffness, 0.0};
  run.modes = modes;
  run.loaded_modes = loaded_modes;
  return run;
}

}  // namespace latsch::benchmarks
