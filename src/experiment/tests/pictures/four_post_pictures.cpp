// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/pictures/four_post_pictures.h"

#include <algorithm>
#include <numbers>

#include "experiment/rigs/car/car_record.h"
#include "report/line_plot.h"

namespace latsch::experiment {
namespace {

constexpr double kWide = 1080.0;  // pixels; width of a history
constexpr double kDegreesOfRadian = 180.0 / std::numbers::pi;

/// Sensors that share a plot: one for each corner, or that of the body.
struct PostFrame {
  const char* title;
  std::string channel;  // name without the corner
  const char* y_title;
  double factor;  // converts from SI
  const char* caption;
  bool logarithmic = false;
};

std::vector<double> times(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

void add_line(report::LinePlot& plot,
              const std::string& name,
              const std::vector<double>& x,
              const std::vector<double>& y,
              double factor) {
  report::PlotLine line;
  line.name = name;
  line.x = x;
  line.y = times(y, factor);
  line.color = static_cast<int>(plot.lines.size());
  plot.lines.push_back(std::move(line));
}

Test::Picture picture_of(const PostFrame& frame,
                         const Channels& channels,
                         const char* x,
                         const char* x_title,
                         double width) {
  report::LinePlot plot{.description = frame.title,
                        .x_title = x_title,
                        .y_title = frame.y_title,
                        .lines = {},
                        .logarithmic_y = frame.logarithmic,
                        .width = width};
  if (channels.find(frame.channel)) {
    add_line(plot, "", channels[x], channels[frame.channel], frame.factor);
  } else {
    const auto names = of_corners(frame.channel);
    for (std::size_t i = 0; i < names.size(); ++i)
      add_line(plot, car::kCornerNames[i], channels[x], channels[names[i]], frame.factor);
  }
  return {frame.title, line_plot(plot), frame.caption};
}

const std::vector<PostFrame>& histories() {
  static const std::vector<PostFrame> all = {
      {"Posts", "post", "height [mm]", 1e3, "Upward."},
      {"Push-rods", "pushrod", "force [kN]", 1e-3, "Compression positive."},
      {"Tires", "Fz", "force [kN]", 1e-3, "Of the road on the tire, upward."},
      {"Hubs", "hub", "acceleration [m/s²]", 1.0, "Of the wheel center, upward."},
      {"Springs", "spring", "extension [mm]", 1e3, "Of the spring units, relative to rest."},
  };
  return all;
}

const std::vector<PostFrame>& over_frequency_frames() {
  static const std::vector<PostFrame> all = {
      {"Density of the posts",
       "psd_post",
       "[mm²/Hz]",
       1e6,
       "Of the mode's signal, one-sided.",
       true},
      {"Density of the push-rods", "psd_pushrod", "[kN²/Hz]", 1e-6, "One-sided.", true},
      {"Push-rods by posts",
       "tf_pushrod",
       "|H1| [N/mm]",
       1e-3,
       "Force by the mode's signal of the posts.",
       true},
      {"Phase of the push-rods",
       "phase_pushrod",
       "[deg]",
       kDegreesOfRadian,
       "Positive: the force leads the posts."},
      {"Hubs by posts", "tf_hub", "|H1| [1/s²]", 1.0, "Acceleration by the posts.", true},
      {"Body by posts",
       "tf_body_z",
       "|H1| [1/s²]",
       1.0,
       "Acceleration of the chassis' center of mass by the posts.",
       true},
      {"Coherence of the push-rods",
       "coherence_pushrod",
       "[1]",
       1.0,
       "1: the whole force is a linear response to the mode's signal that the lines resolve. It "
       "falls where the force does not change its sign with the motion of the posts."},
  };
  return all;
}

}  // namespace

Test::Details four_post_details(const Channels& record, const Channels& over_frequency) {
  Test::Details details;
  for (const PostFrame& frame : histories())
    details.pictures.push_back(picture_of(frame, record, "time", "time [s]", kWide));
  for (const PostFrame& frame : over_frequency_frames())
    details.pictures.push_back(
        picture_of(frame, over_frequency, "frequency", "frequency [Hz]", 520.0));
  details.numbers = over_frequency;
  return details;
}

}  // namespace latsch::experiment
