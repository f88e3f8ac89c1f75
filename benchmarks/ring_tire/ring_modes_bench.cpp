// SPDX-License-Identifier: Apache-2.0
// Modes of the flexible ring tire: agreement with closed forms, and the error as a function of the
// number of nodes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/ring_tire/description/ring_closed_form.h"
#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/ring_modes.h"
#include "models/ring_tire/ring/standing_modes.h"
#include "models/road/plane_road.h"
#include "table.h"

namespace {

using namespace latsch::ring_tire;

/// Returns a ring whose belt does not stretch and tilts as a rigid body, as the closed forms
/// assume.
RingParameters closed_form_ring(int nodes) {
  RingParameters ring = passenger_ring();
  ring.nodes = nodes;
  ring.belt.extension = 1.0e10;
  ring.belt.bending_out_of_plane = 1.0e7;
  return ring;
}

double error_at(int nodes, int n) {
  const RingParameters ring = closed_form_ring(nodes);
  const double found = find_mode(unloaded_modes(ring, n), n, false).frequency;
  return std::abs(found / in_plane_frequency(ring, n) - 1.0);
}

/// Returns the lowest modes of the ring with its axle at a height over the road. The number of
/// tread blocks in a line is 960 for any number of nodes.
std::vector<StandingMode> standing(int nodes, double depth, int count) {
  RingParameters ring = passenger_ring();
  ring.nodes = nodes;
  ring.tread.blocks = 960 / nodes;
  RingTire tire(ring);
  latsch::WheelMotion motion;
  motion.center.z() = tire.free_radius() - depth;
  if (!tire.settle(motion, latsch::road::PlaneRoad(), 0.0)) return {};
  const auto modes = standing_modes(tire, count);
  return modes ? *modes : std::vector<StandingMode>{};
}

/// Returns the largest relative difference of the frequencies; 1 if one side failed.
double difference(const std::vector<StandingMode>& a, const std::vector<StandingMode>& b) {
  if (a.empty() || a.size() != b.size()) return 1.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i].frequency / b[i].frequency - 1.0));
  return largest;
}

/// Adds rows for the modes of a ring that does not roll: off the road, and on it with more nodes.
void standing_rows(latsch::benchmarks::Table& table) {
  constexpr int kCount = 10;
  const auto free = standing(80, -0.01, kCount);
  const auto unloaded = unloaded_modes(passenger_ring(), kCount);
  double worst = free.empty() ? 1.0 : 0.0;
  for (const StandingMode& mode : free) {
    const double expected = find_mode(unloaded, mode.n, mode.lateral).frequency;
    worst = std::max(worst, std::abs(mode.frequency / expected - 1.0));
  }
  table.row("standing modes off the road, 10 lowest against the waves",
            fmt::format("{:.1e}", worst),
            "<= 1e-7",
            worst <= 1e-7);
  const auto fine = standing(320, 0.02, kCount), middle = standing(160, 0.02, kCount);
  const double last = difference(middle, fine);
  const double first = difference(standing(80, 0.02, kCount), middle);
  table.row("standing modes at 20 mm, 10 lowest, 160 against 320 nodes",
            fmt::format("{:.1e} (80 against 160: {:.1e})", last, first),
            "<= 5e-3, falling by 3",
            last <= 5e-3 && 3.0 * last <= first);
}

int ring_modes(const latsch::benchmarks::Options& options) {
  latsch::benchmarks::Table table("ring_modes", options);
  for (int n = 0; n <= 2; ++n) {
    const double error = error_at(200, n);
    table.row(fmt::format("in-plane n = {}, 200 nodes", n),
              fmt::format("{:.1e}", error),
              "<= 1e-4",
              error <= 1e-4);
  }
  for (int n = 3; n <= options.size(7, 4); ++n) {
    const double coarse = error_at(40, n), fine = error_at(80, n);
    const double order = std::log2(coarse / fine);
    table.row(fmt::format("in-plane n = {}, order from 40 to 80 nodes", n),
              fmt::format("{:.2f} (error {:.1e})", order, fine),
              ">= 3.8",
              order >= 3.8);
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
  if (!options.is_smoke()) standing_rows(table);  // half a minute with 320 nodes
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  return latsch::benchmarks::run_benchmark(argc, argv, {}, ring_modes);
}
