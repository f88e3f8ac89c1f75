// SPDX-License-Identifier: Apache-2.0
#include "calculix.h"

#include <fmt/format.h>

#include <cstdlib>

#include "base/scratch_folder_testing.h"
#include "cpu_time.h"
#include "models/fe_tire/contact/ground.h"

namespace latsch::benchmarks {

bool has_calculix() { return std::system("command -v ccx > /dev/null 2>&1") == 0; }

std::optional<CalculixRun> run_calculix(const fe_tire::Mesh& mesh,
                                        const fe_tire::Materials& materials,
                                        const formats::CcxRun& run) {
  const ScratchFolder folder;
  formats::write_ccx_deck(folder / "tire.inp", mesh, materials, run);
  const std::string command = fmt::format(
      "cd '{}' && OMP_NUM_THREADS=1 CCX_NPROC_EQUATION_SOLVER=1 CCX_NPROC_RESULTS=1 ccx -i tire > "
      "tire.log 2>&1",
      folder.path().string());
  const double start = cpu_seconds(RUSAGE_CHILDREN);
  if (std::system(command.c_str()) != 0) return std::nullopt;
  const double seconds = cpu_seconds(RUSAGE_CHILDREN) - start;
  return CalculixRun{formats::read_ccx_results(folder / "tire.dat"), seconds};
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
