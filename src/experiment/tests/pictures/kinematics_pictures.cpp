// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/pictures/kinematics_pictures.h"

#include <algorithm>
#include <numbers>

#include "report/line_plot.h"

namespace latsch::experiment {
namespace {

using suspension::Sense;
using suspension::SignView;

struct ShownCurve {
  const char* channel;
  const char* name;  // in the legend
};
enum class Shown { always, where_wheels_differ };

struct CurveFrame {
  const char* title;
  const char* y_title;
  double factor;  // converts from SI
  std::vector<ShownCurve> lines;
  const char* caption;
  Shown shown = Shown::always;
  Sense positive = Sense::same;  // positive direction, which the caption names
};

constexpr double kDegrees = 180.0 / std::numbers::pi, kMillimeters = 1e3;

std::vector<CurveFrame> angle_frames() {
  return {
      {"Toe and camber",
       "angle [deg]",
       kDegrees,
       {{"toe", "toe"}, {"camber", "camber"}},
       "Positive: toe-in, top outboard."},
      {"Toe and camber of the other wheel",
       "angle [deg]",
       kDegrees,
       {{"other_toe", "toe"}, {"other_camber", "camber"}},
       "Positive: toe-in, top outboard.",
       Shown::where_wheels_differ},
      {"Bump steer and bump camber",
       "slope [deg/m]",
       kDegrees,
       {{"bump_steer", "toe per travel"}, {"bump_camber", "camber per travel"}},
       "Exact slopes at each state."},
      {"Caster and kingpin inclination",
       "angle [deg]",
       kDegrees,
       {{"caster", "caster"}, {"kpi", "kingpin inclination"}},
       "Positive: top of the kingpin rearward, inboard."},
  };
}

std::vector<CurveFrame> length_frames() {
  return {
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
      {"Lateral position of the roll center",
       "[mm]",
       kMillimeters,
       {{"axle_roll_center_y", "kinematic"}},
       "From the car's center plane.",
       Shown::where_wheels_differ,
       Sense::along_y},
      {"Recession",
       "[mm]",
       kMillimeters,
       {{"contact_x", "contact point"}, {"center_x", "wheel center"}},
       "In the axes of the file.",
       Shown::always,
       Sense::along_x},
      {"Track", "[mm]", kMillimeters, {{"track", "track"}}, "Between the contact points."},
  };
}

std::vector<CurveFrame> spring_frames() {
  return {
      {"Motion ratio",
       "spring per wheel travel [1]",
       1.0,
       {{"motion_ratio", "motion ratio"}},
       "Compression of the spring per rise of the contact point."},
      {"Turn of the anti-roll bar",
       "[deg]",
       kDegrees,
       {{"arb_angle", "blade"}},
       "About y.",
       Shown::always,
       Sense::about_y},
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
  };
}

std::vector<CurveFrame> steer_frames() {
  return {
      {"Steer angles",
       "[deg]",
       kDegrees,
       {{"steer", "this wheel"}, {"other_steer", "the other"}},
       "Against straight ahead.",
       Shown::where_wheels_differ,
       Sense::about_z},
      {"Ackermann",
       "[%]",
       100.0,
       {{"ackermann", "Ackermann"}},
       "100 %: both wheels roll about one point on the line of the rear axle."},
  };
}

bool is_varied(const std::vector<double>& values) {
  const auto [lower, upper] = std::minmax_element(values.begin(), values.end());
  return *upper > *lower;
}

/// Returns the positive direction: "to the left".
const char* way(Sense sense, SignView view) {
  const bool as_iso = suspension::sign(view, sense) > 0.0;
  switch (sense) {
    case Sense::along_x:
      return as_iso ? "forward" : "rearward";
    case Sense::along_y:
    case Sense::about_z:
      return as_iso ? "to the left" : "to the right";
    case Sense::about_y:
      return as_iso ? "its top forward" : "its top rearward";
    case Sense::along_z:
      return as_iso ? "upward" : "downward";
    case Sense::about_x:
      return as_iso ? "left side up" : "left side down";
    case Sense::same:
      break;
  }
  return "";
}

std::string caption_of(const CurveFrame& frame, SignView view) {
  if (frame.positive == Sense::same) return frame.caption;
  return std::string(frame.caption) + " Positive: " + way(frame.positive, view) + ".";
}

/// Abscissa that all frames of a page share.
struct Abscissa {
  std::string title;
  std::vector<double> values;
};

Abscissa abscissa_of(const Channels& channels, SignView view) {
  const bool by_rack = !is_varied(channels["travel"]) && is_varied(channels["rack"]);
  Abscissa x{
      by_rack ? std::string("rack ") + way(Sense::along_y, view) + " [mm]" : "travel upward [mm]",
      channels[by_rack ? "rack" : "travel"]};
  for (double& value : x.values) value *= kMillimeters;
  return x;
}

report::LinePlot plot_of(const CurveFrame& frame, const Channels& channels, const Abscissa& x) {
  report::LinePlot plot{
      .description = frame.title, .x_title = x.title, .y_title = frame.y_title, .lines = {}};
  for (const ShownCurve& shown : frame.lines) {
    const Channel* channel = channels.find(shown.channel);
    if (!channel) continue;
    report::PlotLine line{.name = shown.name, .x = x.values, .y = channel->values, .spread = {}};
    for (double& value : line.y) value *= frame.factor;
    line.color = static_cast<int>(plot.lines.size());
    plot.lines.push_back(std::move(line));
  }
  return plot;
}

}  // namespace

Test::Details kinematics_details(const Channels& channels, SignView view) {
  Test::Details details;
  const Abscissa x = abscissa_of(channels, view);
  if (x.values.size() < 2) return details;
  const bool are_alike =
      !is_varied(channels["rack"]) && channels["travel"] == channels["other_travel"];
  for (const auto& frames : {angle_frames(), length_frames(), spring_frames(), steer_frames()})
    for (const CurveFrame& frame : frames) {
      if (are_alike && frame.shown == Shown::where_wheels_differ) continue;
      const report::LinePlot plot = plot_of(frame, channels, x);
      if (plot.lines.empty()) continue;
      details.pictures.push_back({frame.title, line_plot(plot), caption_of(frame, view)});
    }
  return details;
}

}  // namespace latsch::experiment
