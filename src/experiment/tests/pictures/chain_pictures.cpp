// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/pictures/chain_pictures.h"

#include <fmt/format.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "report/line_plot.h"

namespace latsch::experiment {
namespace {

/// Channels that share a plot.
struct ChainFrame {
  const char* title;
  std::vector<const char*> channels;
  const char* y_title;
  double factor;  // converts from SI
};

const std::vector<ChainFrame>& frames() {
  static const std::vector<ChainFrame> all = {
      {"Displacement", {"u_x", "u_y", "u_z"}, "u [mm]", 1e3},
      {"Velocity", {"v_x", "v_y", "v_z"}, "v [m/s]", 1.0},
      {"Acceleration", {"a_x", "a_y", "a_z"}, "a [m/s²]", 1.0},
      {"Strain", {"E_rr", "E_tt", "E_yy", "G_rt", "G_ty", "G_ry"}, "E [%]", 1e2},
      {"Stress", {"S_rr", "S_tt", "S_yy", "S_rt", "S_ty", "S_ry"}, "S [MPa]", 1e-6},
      {"Force of the cords", {"cord_force"}, "[N/mm]", 1e-3},
      {"Stored energy", {"energy"}, "[kJ/m³]", 1e-3},
      {"Dissipation", {"dissipation"}, "[kW/m³]", 1e-3},
  };
  return all;
}

/// Values of one chain.
struct ChainPart {
  std::size_t first, last;
};

/// Returns the parts of the channels with one state and one position.
std::vector<ChainPart> parts_of(const Channels& chains) {
  const auto &state = chains["state"], &position = chains["position"];
  std::vector<ChainPart> parts;
  for (std::size_t k = 0; k < state.size(); ++k) {
    if (k == 0 || state[k] != state[k - 1] || position[k] != position[k - 1])
      parts.push_back({k, k});
    parts.back().last = k + 1;
  }
  return parts;
}

/// True if a picture would show nothing: the force of cords on a face, or the dissipation of a tire
/// without losses.
bool is_zero(const ChainFrame& frame, const Channels& chains, const ChainPart& part) {
  for (const char* name : frame.channels)
    for (std::size_t k = part.first; k < part.last; ++k)
      if (chains[name][k] != 0.0) return false;
  return true;
}

Test::Picture picture_of_chain(const ChainFrame& frame,
                               const Channels& chains,
                               const ChainPart& part) {
  constexpr double kDegree = std::numbers::pi / 180.0, kPlotWidth = 1080.0;  // pixels
  report::LinePlot plot{.description = frame.title,
                        .x_title = "theta [deg], 0 at the contact, leading edge to the right",
                        .y_title = frame.y_title,
                        .lines = {},
                        .width = kPlotWidth};
  for (const char* name : frame.channels) {
    report::PlotLine line;
    line.name = frame.channels.size() > 1 ? name : "";
    line.color = static_cast<int>(plot.lines.size());
    for (std::size_t k = part.first; k < part.last; ++k) {
      line.x.push_back(chains["theta"][k] / kDegree);
      line.y.push_back(frame.factor * chains[name][k]);
    }
    plot.lines.push_back(std::move(line));
  }
  const std::string title = fmt::format("State {:.0f}, position {:.3g}: {}",
                                        chains["state"][part.first],
                                        chains["position"][part.first],
                                        frame.title);
  return {title, line_plot(plot), "Material passes from the right to the left."};
}

}  // namespace

Test::Details chain_details(const Channels& chains) {
  Test::Details details;
  for (const ChainPart& part : parts_of(chains)) {
    for (const ChainFrame& frame : frames()) {
      if (is_zero(frame, chains, part)) continue;
      details.pictures.push_back(picture_of_chain(frame, chains, part));
    }
  }
  details.numbers = chains;
  return details;
}

}  // namespace latsch::experiment
