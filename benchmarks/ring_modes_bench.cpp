// SPDX-License-Identifier: Apache-2.0
// Modes of the flexible ring against the closed forms, and how the error falls with more nodes.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "models/ring_tire/ring_closed_form.h"
#include "models/ring_tire/ring_modes.h"
#include "models/ring_tire/ring_parameters_testing.h"
#include "table.h"

namespace {

using namespace latsch::ring_tire;

/// Belt that does not stretch and turns as one in tilt: what the closed forms assume.
RingParameters closed_form_ring(int nodes) {
  RingParameters ring = passenger_ring();
  ring.nodes = nodes;
  ring.belt.extension = 1.0e10;
  ring.belt.bending_lateral = 1.0e7;
  return ring;
}

double error_at(int nodes, int n) {
  const RingParameters ring = closed_form_ring(nodes);
  const double found = find_mode(unloaded_modes(ring, n), n, false).frequency;
  return std::abs(found / in_plane_frequency(ring, n) - 1.0);
}

int ring_modes() {
  latsch::benchmarks::Table table("ring_modes");
  for (int n = 0; n <= 2; ++n) {
    const double error = error_at(200, n);
    table.row(fmt::format("in-plane n = {}, 200 nodes", n),
              fmt::format("{:.1e}", error),
              "<= 1e-4",
              error <= 1e-4);
  }
  for (int n : {3, 4, 5, 6, 7}) {
    const double coarse = error_at(100, n), fine = error_at(200, n);
    const double order = std::log2(coarse / fine);
    table.row(fmt::format("in-plane n = {}, order from 100 to 200 nodes", n),
              fmt::format("{:.2f} (error {:.1e})", order, fine),
              "2 +- 0.1",
              std::abs(order - 2.0) <= 0.1);
  }
  const RingParameters ring = closed_form_ring(200);
  const auto modes = unloaded_modes(ring, 1);
  const double lateral = find_mode(modes, 0, true).frequency / lateral_frequency(ring) - 1.0;
  const double tilt = find_mode(modes, 1, true).frequency / tilt_frequency(ring) - 1.0;
  table.row("lateral translation, 200 nodes",
            fmt::format("{:.1e}", std::abs(lateral)),
            "<= 1e-4",
            std::abs(lateral) <= 1e-4);
  table.row(
      "tilt, 200 nodes", fmt::format("{:.1e}", std::abs(tilt)), "<= 1e-3", std::abs(tilt) <= 1e-3);
  return table.exit_code();
}

}  // namespace

int main() { return latsch::benchmarks::guarded(ring_modes); }
