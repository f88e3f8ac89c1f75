// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/footprint_rig.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/document_record.h"
#include "experiment/rigs/drum_rig.h"
#include "models/road/plane_road.h"

namespace latsch::experiment {

FootprintTest read_footprint_test(const Node& root, const MeasuredConditions& measured) {
  root.choice("kind", {"footprint"});
  FootprintTest test;
  if (const auto from = find_measured(root, "loads"))
    test.loads = measured_values(*from, {"Fz", "N", true, "W"}, measured);
  else if (root.has("loads"))
    test.loads = root.quantities("loads", "N", Range::positive());
  if (const auto from = find_measured(root, "deflections"))
    test.deflections = measured_values(*from, {"deflection", "m"}, measured);
  else if (root.has("deflections"))
    test.deflections = root.quantities("deflections", "m", Range::positive());
  if (test.loads.empty() == test.deflections.empty())
    root.reject("loads", "or deflections is required, exactly one of the two");
  test.camber = root.quantity("camber", "rad", Range::between(-0.5, 0.5), 0.0);
  test.pressure = read_pressure(root, measured);
  if (root.has("friction"))
    test.friction = root.quantity("friction", "1", Range::between(0.0, 5.0));
  constexpr double kLeastSensor = 1e-3, kMostSensor = 0.1;  // m
  test.sensor =
      root.quantity("sensor", "m", Range::between(kLeastSensor, kMostSensor), test.sensor);
  if (const auto from = find_measured(root, "sensors")) {
    const Channels at = take_measured(*from,
                                      {{.channel = "x", .unit = "m", .is_needed = true},
                                       {.channel = "y", .unit = "m", .is_needed = true}},
                                      measured);
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i < at["x"].size(); ++i) {
      test.sensors.emplace_back(at["x"][i], at["y"][i]);
      rows.push_back({at["x"][i], at["y"][i]});
    }
    DocumentRecord::stands_for(*from, canonical(rows, {"m", "m"}));
  } else if (root.has("sensors")) {
    for (const std::vector<double>& at : root.rows("sensors", {"m", "m"}))
      test.sensors.emplace_back(at[0], at[1]);
  }
  if (root.has("elements")) {
    constexpr double kShortest = 3e-3, kLongest = 1.0;  // m; shorter ones need too much memory
    const std::vector<double> elements =
        root.quantities("elements", "m", Range::between(kShortest, kLongest));
    if (elements.size() != 2)
      root.reject("elements", "has to be two lengths: around and across, as [\"7 mm\", \"7 mm\"]");
    test.elements = {elements[0], elements[1]};
  }
  root.close();
  return test;
}

Result<std::vector<StandingFootprint>> footprints(Tire& tire, const FootprintTest& test) {
  const road::PlaneRoad ground;
  WheelMotion motion;
  motion.carrier = Eigen::AngleAxisd(test.camber, Eigen::Vector3d::UnitX()).toRotationMatrix();
  std::vector<double> heights;
  for (const double deflection : test.deflections)
    heights.push_back(tire.free_radius() - deflection);
  for (const double load : test.loads) {
    const auto height = height_under_load(tire, ground, motion.carrier, load);
    if (!height) return height.failure();
    heights.push_back(*height);
  }
  std::vector<StandingFootprint> states;
  for (const double height : heights) {
    motion.center.z() = height;
    const auto hub = tire.settle(motion, ground, 0.0);
    if (!hub) return hub.failure();
    auto print = tire.footprint();
    if (!print)
      return Failure{
          "this tire does not know its footprint: a Magic Formula needs the coefficients of its "
          "contact patch"};
    states.push_back({tire.free_radius() - height, std::move(*print)});
  }
  return states;
}

Channels to_channels(const FootprintTest& test, const std::vector<StandingFootprint>& states) {
  Channel load{"load", "N", {}}, deflection{"deflection", "m", {}}, length{"length", "m", {}};
  Channel width{"width", "m", {}}, area{"area", "m^2", {}}, pressure{"mean_pressure", "Pa", {}};
  Channel peak{"peak_pressure", "Pa", {}}, grip{"grip_level", "1", {}};
  Channel sensed{"pressure", "Pa", {}}, x{"sensor_x", "m", {}}, y{"sensor_y", "m", {}};
  for (const StandingFootprint& state : states) {
    load.values.push_back(state.footprint.load);
    deflection.values.push_back(state.deflection);
    length.values.push_back(state.footprint.length);
    width.values.push_back(state.footprint.width);
    area.values.push_back(state.footprint.area);
    pressure.values.push_back(state.footprint.mean_pressure());
    peak.values.push_back(state.footprint.peak_pressure(test.sensor));
    grip.values.push_back(state.footprint.grip_level());
    for (const Eigen::Vector2d& at : test.sensors) {
      sensed.values.push_back(state.footprint.pressure_at(at.x(), at.y(), test.sensor));
      x.values.push_back(at.x());
      y.values.push_back(at.y());
    }
  }
  Channels channels;
  for (Channel* channel : {&load, &deflection, &length, &width, &area, &pressure, &peak, &grip})
    channels.add(std::move(*channel));
  if (!test.sensors.empty())
    for (Channel* channel : {&sensed, &x, &y}) channels.add(std::move(*channel));
  return channels;
}

}  // namespace latsch::experiment
