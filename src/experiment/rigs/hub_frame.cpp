// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/hub_frame.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "base/text.h"

namespace latsch::experiment {
namespace {

constexpr std::array kForces = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};

/// Reads one frame or a list of frames.
std::vector<std::string> stated_frames(const Node& test) {
  try {
    return {test.text("frame")};
  } catch (const InputError&) {
  }
  try {
    return test.texts("frame");
  } catch (const InputError&) {
    test.reject("frame", R"(is no frame such as "W", nor a list of them)");
  }
}

}  // namespace

std::vector<AxisFrame> read_frames(const Node& test, std::vector<AxisFrame> fallback) {
  if (!test.has("frame")) return fallback;
  const auto& known = axis_frame_names();
  std::vector<AxisFrame> frames;
  for (const std::string& name : stated_frames(test)) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      test.reject("frame", "has " + in_quotes(name) + ", expected " + list_of(known));
    const AxisFrame frame = axis_frame_of(name);
    if (std::find(frames.begin(), frames.end(), frame) != frames.end())
      test.reject("frame", "has " + in_quotes(name) + " twice");
    frames.push_back(frame);
  }
  if (frames.empty()) test.reject("frame", "is empty, expected at least one of " + list_of(known));
  return frames;
}

std::string names_of(const std::vector<AxisFrame>& frames) {
  std::string names;
  for (const AxisFrame frame : frames) {
    if (!names.empty()) names += ' ';
    names += name_of(frame);
  }
  return names;
}

std::vector<std::string> force_names(const std::vector<AxisFrame>& frames) {
  std::vector<std::string> names;
  for (const AxisFrame frame : frames)
    for (const std::string force : kForces)
      names.push_back(frames.size() == 1 ? force : force + name_of(frame));
  return names;
}

Wrench in_frame(const HubForces& hub, const WheelMotion& motion, AxisFrame to) {
  // Sine of the angle of the spin axis above the horizontal.
  const double sine = std::clamp(motion.carrier(2, 1), -1.0, 1.0);
  const double gamma = std::asin(sine), loaded_radius = motion.center.z() / std::cos(gamma);
  return latsch::in_frame({hub.force, hub.moment}, AxisFrame::C, to, gamma, loaded_radius);
}

void ForceRecord::add(const HubForces& hub, const WheelMotion& motion) {
  std::size_t column = 0;
  for (const AxisFrame frame : frames_) {
    const Wrench wrench = in_frame(hub, motion, frame);
    for (const double value : wrench.force) values_[column++].push_back(value);
    for (const double value : wrench.moment) values_[column++].push_back(value);
  }
}

const std::vector<double>& ForceRecord::of(const std::string& name) const {
  const auto names = force_names(frames_);
  const auto found = std::find(names.begin(), names.end(), name);
  assert(found != names.end());
  return values_[static_cast<std::size_t>(found - names.begin())];
}

void ForceRecord::add_to(Channels& channels) const {
  const auto names = force_names(frames_);
  for (std::size_t k = 0; k < names.size(); ++k)
    channels.add({names[k], names[k][0] == 'F' ? "N" : "N m", values_[k]});
}

}  // namespace latsch::experiment
