// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/kinematics_pictures.h"

#include <algorithm>
#include <numbers>

#include "report/line_plot.h"

namespace latsch::experiment {
namespace {

struct ShownCurve {
  const char* channel;
  const char* name;  // in the legend
};
enum class Shown { always, where_wheels_differ };

struct CurveFrame {
  const char* title;
  const char* y_title;
  double factor;  // from SI
  std::vector<ShownCurve> lines;
  const char* caption;
  Shown shown = Shown::always;
};

constexpr double kDegrees = 180.0 / std::numbers::pi, kMillimeters = 1e3;

const std::vector<CurveFrame>& curve_frames() {
  static const std::vector<CurveFrame> all = {
      {"Toe and camber",
       "angle [deg]",
       kDegrees,
       {{"toe", "toe"}, {"camber", "camber"}},
       "Positive: toe-in, top outboard."},
      {"Of the other wheel",
       "angle [deg]",
       kDegrees,
       {{"other_toe", "toe"}, {"other_camber", "camber"}},
       "Positive: toe-in, top outboard.",
       Shown::where_wheels_differ},
      {"Bump steer and bump camber",
       "slope [deg/m]",
       kDegrees,
       {{"bump_steer", "toe by travel"}, {"bump_camber", "camber by travel"}},
       "Exact slopes at each state."},
      {"Caster and kingpin inclination",
       "angle [deg]",
       kDegrees,
       {{"caster", "caster"}, {"kpi", "kingpin inclination"}},
       "Positive: top of the kingpin rearward, inboard."},
      {"Kingpin offsets",
       "[mm]",
       kMillimeters,
       {{"mechanical_trail", "mechanical trail"},
        {"caster_trail_hub", "caster trail at the hub"},
        {"scrub_radius", "scrub radius"},
        {"kingpin_offset", "offset at the wheel center"}},
       "Positive: contact point behind the kingpin, wheel center ahead of it, both outboard of "
       "it."},
      {"Height of the roll center",
       "[mm]",
       kMillimeters,
       {{"axle_roll_center_height", "kinematic"},
        {"force_roll_center_height", "force-based"},
        {"roll_center_height", "of this wheel alone"}},
       "Above the ground; of this wheel alone: above its contact point, in the car's center "
       "plane."},
      {"Lateral place of the roll center",
       "[mm]",
       kMillimeters,
       {{"axle_roll_center_y", "kinematic"}},
       "To the left of the car's center plane.",
       Shown::where_wheels_differ},
      {"Recession",
       "[mm]",
       kMillimeters,
       {{"contact_x", "contact point forward"}, {"center_x", "wheel center forward"}},
       "In the axes of the file."},
      {"Track", "[mm]", kMillimeters, {{"track", "track"}}, "Between the contact points."},
      {"Motion ratio",
       "spring by wheel [1]",
       1.0,
       {{"motion_ratio", "motion ratio"}},
       "Compression of the spring by rise of the contact point."},
      {"Turn of the anti-roll bar",
       "[deg]",
       kDegrees,
       {{"arb_angle", "blade"}},
       "About y, its top forward."},
      {"Rates",
       "[N/mm]",
       1e-3,
       {{"wheel_rate", "wheel rate"}, {"ride_rate", "ride rate"}},
       "The spring as it acts at the contact point, and with the tire in series."},
      {"Anti features",
       "[%]",
       100.0,
       {{"anti_dive", "anti-dive"}, {"anti_lift", "anti-lift"}, {"anti_squat", "anti-squat"}},
       "Share of the load transfer that the links carry."},
      {"Steer angles",
       "[deg]",
       kDegrees,
       {{"steer", "this wheel"}, {"other_steer", "the other"}},
       "Positive to the left.",
       Shown::where_wheels_differ},
      {"Ackermann",
       "[%]",
       100.0,
       {{"ackermann", "Ackermann"}},
       "100 %: both wheels roll about one point on the line of the rear axle."},
  };
  return all;
}

bool is_varied(const std::vector<double>& values) {
  const auto [lower, upper] = std::minmax_element(values.begin(), values.end());
  return *upper > *lower;
}

}  // namespace

Test::Details kinematics_details(const Channels& channels) {
  Test::Details details;
  const bool by_rack = !is_varied(channels["travel"]) && is_varied(channels["rack"]);
  std::vector<double> x = channels[by_rack ? "rack" : "travel"];
  if (x.size() < 2) return details;
  for (double& value : x) value *= kMillimeters;
  const bool are_alike =
      !is_varied(channels["rack"]) && channels["travel"] == channels["other_travel"];
  for (const CurveFrame& frame : curve_frames()) {
    if (are_alike && frame.shown == Shown::where_wheels_differ) continue;
    report::LinePlot plot{.description = frame.title,
                          .x_title = by_rack ? "rack to the left [mm]" : "travel upward [mm]",
                          .y_title = frame.y_title,
                          .lines = {}};
    for (const ShownCurve& shown : frame.lines) {
      const Channel* channel = channels.find(shown.channel);
      if (!channel) continue;
      report::PlotLine line;
      line.name = shown.name;
      line.x = x;
      line.y = channel->values;
      for (double& value : line.y) value *= frame.factor;
      line.color = static_cast<int>(plot.lines.size());
      plot.lines.push_back(std::move(line));
    }
    if (plot.lines.empty()) continue;
    details.pictures.push_back({frame.title, line_plot(plot), frame.caption});
  }
  return details;
}

}  // namespace latsch::experiment
