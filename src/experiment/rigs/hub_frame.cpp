// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/hub_frame.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace latsch::experiment {

AxisFrame read_frame(const Node& test, AxisFrame fallback) {
  if (!test.has("frame")) return fallback;
  const std::string name = test.choice("frame", {"W", "H", "C"});
  return name == "W" ? AxisFrame::W : name == "H" ? AxisFrame::H : AxisFrame::C;
}

const char* name_of(AxisFrame frame) {
  return frame == AxisFrame::W ? "W" : frame == AxisFrame::H ? "H" : "C";
}

Wrench in_frame(const HubForces& hub, const WheelMotion& motion, AxisFrame to) {
  const double sine = std::clamp(motion.carrier(2, 1), -1.0, 1.0);  // of the spin axis, upward
  const double gamma = std::asin(sine), loaded_radius = motion.center.z() / std::cos(gamma);
  return latsch::in_frame({hub.force, hub.moment}, AxisFrame::C, to, gamma, loaded_radius);
}

}  // namespace latsch::experiment
