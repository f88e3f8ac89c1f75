// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/pictures/rolling_response_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "report/line_plot.h"

namespace latsch::experiment {
namespace {

constexpr double kWidthOfResponse = 720.0;  // pixels

/// Adds a line of a channel for each state.
void add_response_lines(const Channels& response,
                        const std::string& channel,
                        double factor,
                        report::LinePlot& plot) {
  const auto &state = response["state"], &frequency = response["frequency"];
  const auto& values = response[channel];
  const bool has_several = state.back() > state.front();
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k == 0 || state[k] != state[k - 1]) {
      report::PlotLine line;
      if (has_several)
        line.name = fmt::format("{}, state {:.0f}", channel, state[k]);
      else
        line.name = channel;
      line.color = static_cast<int>(plot.lines.size());
      plot.lines.push_back(std::move(line));
    }
    plot.lines.back().x.push_back(frequency[k]);
    plot.lines.back().y.push_back(factor * values[k]);
  }
}

/// Returns the picture of channels; without any of them it has no lines.
Test::Picture response_picture(const Channels& response,
                               const std::string& title,
                               const std::vector<std::string>& channels,
                               const std::string& y_title,
                               double factor,
                               const char* caption) {
  report::LinePlot plot{.description = title,
                        .x_title = "frequency [Hz]",
                        .y_title = y_title,
                        .lines = {},
                        .width = kWidthOfResponse};
  for (const std::string& channel : channels)
    if (response.find(channel)) add_response_lines(response, channel, factor, plot);
  return {title, plot.lines.empty() ? "" : line_plot(plot), caption};
}

}  // namespace

Test::Details rolling_response_details(const Channels& response) {
  constexpr double kDegreeOfPhase = std::numbers::pi / 180.0;
  Test::Details details;
  const auto add = [&](Test::Picture picture) {
    if (!picture.svg.empty()) details.pictures.push_back(std::move(picture));
  };
  add(response_picture(response,
                       "Relaxation lengths",
                       {"relaxation_side", "relaxation_slip"},
                       "length [m]",
                       1.0,
                       "Of a first-order lag with the force's own phase at each frequency."));
  // The force that a slip makes first, and the moment beside it.
  struct Drawn {
    const char *slip, *in_words, *force;
    const char *unit, *moment_unit;
  };
  static constexpr Drawn kDrawn[] = {
      {"alpha", "slip angle", "Fy", "N/rad", "N m/rad"},
      {"kappa", "slip", "Fx", "N", "N m"},
      {"gamma", "camber", "Fy", "N/rad", "N m/rad"},
      {"phit", "turn slip", "Fy", "N m", "N m^2"},
  };
  for (const Drawn& one : kDrawn) {
    const std::string force = fmt::format("{}_by_{}", one.force, one.slip);
    const std::string moment = fmt::format("Mz_by_{}", one.slip);
    add(response_picture(response,
                         fmt::format("{} by {}: size", one.force, one.in_words),
                         {"tf_" + force},
                         fmt::format("[{}]", one.unit),
                         1.0,
                         ""));
    add(response_picture(response,
                         fmt::format("Mz by {}: size", one.in_words),
                         {"tf_" + moment},
                         fmt::format("[{}]", one.moment_unit),
                         1.0,
                         ""));
    add(response_picture(response,
                         fmt::format("{} and Mz by {}: phase", one.force, one.in_words),
                         {"phase_" + force, "phase_" + moment},
                         "[deg]",
                         1.0 / kDegreeOfPhase,
                         "Positive if the force leads the slip; 180 deg is a force against it."));
  }
  details.numbers = response;
  return details;
}

}  // namespace latsch::experiment
