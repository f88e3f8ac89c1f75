// SPDX-License-Identifier: Apache-2.0
// Runs CalculiX, if it is installed, on a deck of one of our meshes, with one thread.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/mesh/ccx_deck.h"
#include "formats/mesh/ccx_results.h"
#include "models/fe_tire/mesh/materials.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::benchmarks {

/// True if ccx is on the path.
bool has_calculix();

struct CalculixRun {
  formats::CcxResults results;
  double cpu_seconds = 0.0;
  /// Filled if forces at every increment are requested: the share of the ground's travel, and the
  /// upward force on the tire, N.
  std::vector<std::pair<double, double>> ground_forces;
};

struct DeckChanges {
  std::string model_cards = {};  // inserted before the first boundary condition
  bool every_force = false;      // prints the ground's force at every increment, not just the last
};

/// Returns nothing if CalculiX did not finish.
std::optional<CalculixRun> run_calculix(const fe_tire::Mesh& mesh,
                                        const fe_tire::Materials& materials,
                                        const formats::CcxRun& run,
                                        const DeckChanges& changes = {});

/// Returns the definition of a whole trial of a tire for CalculiX: the tire is inflated, the ground
/// starts `clear` below the undeformed tire and moves up by `travel`, and `modes` modes are
/// computed in that state, or for the unloaded tire.
formats::CcxRun calculix_trial(const std::string& title,
                               const fe_tire::Mesh& mesh,
                               double pressure,
                               double clear,
                               double travel,
                               int modes,
                               bool loaded_modes);

}  // namespace latsch::benchmarks
