// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/pictures/kc_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "report/line_plot.h"

namespace latsch::experiment {
namespace {

struct LoopFrame {
  const char* channel;
  const char* title;
  const char* caption;
};

constexpr std::array<LoopFrame, 6> kLoopFrames = {
    {{"dz", "Vertical travel", "Upward."},
     {"dx", "Longitudinal travel", "Forward."},
     {"dy", "Lateral travel", "To the left."},
     {"toe", "Toe", "Positive: toe-in."},
     {"camber", "Camber", "Positive: top outboard."},
     {"caster", "Caster", "Positive: top of the kingpin rearward."}}};

/// Unit in which a channel is shown.
struct ShownUnit {
  const char* name;
  double factor;
};
ShownUnit shown_unit(const std::string& si) {
  if (si == "m") return {"mm", 1e3};
  if (si == "rad") return {"deg", 180.0 / std::numbers::pi};
  if (si == "N") return {"kN", 1e-3};
  return {"N m", 1.0};
}

double range_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

/// Returns the prescribed quantity that varies, preferably a force.
std::string abscissa(const Channels& recorded, const std::vector<std::string>& prescribed) {
  for (const std::string& name : prescribed)
    if (range_of(recorded[name]) > 0.0) return name;
  return "";
}

std::vector<double> in_unit(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

/// Returns the regression line from one end of its window to the other.
report::PlotLine line_of_slope(const SlopesBy& slopes,
                               const Channel& x,
                               const Channel& y,
                               double slope) {
  double low = 1e300, high = -1e300, x_mean = 0.0, y_mean = 0.0, count = 0.0;
  for (std::size_t i = 0; i < x.values.size(); ++i) {
    if (!(x.values[i] >= slopes.from && x.values[i] <= slopes.to)) continue;
    low = std::min(low, x.values[i]);
    high = std::max(high, x.values[i]);
    x_mean += x.values[i];
    y_mean += y.values[i];
    count += 1.0;
  }
  x_mean /= count;
  y_mean /= count;
  const ShownUnit unit_x = shown_unit(x.unit), unit_y = shown_unit(y.unit);
  report::PlotLine line;
  line.x = in_unit({low, high}, unit_x.factor);
  line.y =
      in_unit({y_mean + slope * (low - x_mean), y_mean + slope * (high - x_mean)}, unit_y.factor);
  return line;
}

}  // namespace

std::vector<Test::Picture> loop_pictures(const Channels& recorded,
                                         const std::vector<std::string>& prescribed,
                                         const std::vector<std::string>& endings,
                                         const std::optional<SlopesBy>& slopes) {
  const std::string by = slopes ? slopes->by : abscissa(recorded, prescribed);
  if (by.empty()) return {};
  const Channel& x = *recorded.find(by);
  const ShownUnit unit_x = shown_unit(x.unit);
  std::vector<Test::Picture> pictures;
  for (const LoopFrame& frame : kLoopFrames) {
    const ShownUnit unit_y = shown_unit(recorded.find(frame.channel + endings[0])->unit);
    report::LinePlot plot{.description = frame.title,
                          .x_title = fmt::format("{} [{}]", by, unit_x.name),
                          .y_title = fmt::format("{} [{}]", frame.channel, unit_y.name),
                          .lines = {}};
    std::string caption = frame.caption;
    for (const std::string& ending : endings) {
      const Channel& y = *recorded.find(frame.channel + ending);
      report::PlotLine loop;
      loop.name = y.name;
      loop.x = in_unit(x.values, unit_x.factor);
      loop.y = in_unit(y.values, unit_y.factor);
      loop.color = static_cast<int>(plot.lines.size());
      plot.lines.push_back(loop);
      if (!slopes) continue;
      const double slope = recorded[slopes->name(y.name)][0];
      report::PlotLine line = line_of_slope(*slopes, x, y, slope);
      line.name = slopes->name(y.name);
      line.color = static_cast<int>(plot.lines.size());
      plot.lines.push_back(std::move(line));
      caption += fmt::format(" {}: {:.4g} {}/{}.",
                             slopes->name(y.name),
                             slope * unit_y.factor / unit_x.factor,
                             unit_y.name,
                             unit_x.name);
    }
    pictures.push_back({frame.title, line_plot(plot), caption});
  }
  return pictures;
}

}  // namespace latsch::experiment
