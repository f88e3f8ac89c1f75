// SPDX-License-Identifier: Apache-2.0
// CalculiX, where it is installed, on a deck of a mesh of ours, one thread.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/mesh/ccx_deck.h"
#include "formats/mesh/ccx_results.h"
#include "models/fe_tire/element/materials.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::benchmarks {

/// Whether ccx is on the path.
bool has_calculix();

struct CalculixRun {
  formats::CcxResults results;
  double cpu_seconds = 0.0;
  /// At every increment of the load step, where asked: share of the way, N upward on the tire.
  std::vector<std::pair<double, double>> ground_forces;
};

struct DeckChanges {
  std::string model_cards = {};  // put before the first boundary condition
  bool every_force = false;      // of the ground, not the last one alone
};

/// None where it did not finish.
std::optional<CalculixRun> run_calculix(const fe_tire::Mesh& mesh,
                                        const fe_tire::Materials& materials,
                                        const formats::CcxRun& run,
                                        const DeckChanges& changes = {});

/// A whole trial of a tire: inflated, ground moved by `travel` from `clear` below the undeformed
/// tire, `modes` modes there or of the unloaded tire.
formats::CcxRun calculix_trial(const std::string& title,
                               const fe_tire::Mesh& mesh,
                               double pressure,
                               double clear,
                               double travel,
                               int modes,
                               bool loaded_modes);

}  // namespace latsch::benchmarks
