// SPDX-License-Identifier: Apache-2.0
#include "measurement/axes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "measurement/meaning/channel_sense.h"

namespace latsch {
namespace {

using Eigen::Vector3d;

/// Returns the sign factors that convert Fx, Fy, Fz and Mx, My, Mz to iso.
Wrench signs(AxisConvention from) {
  const auto sign = [&](ChannelSense sense) { return sign_to_iso(sense, from); };
  return {{sign(ChannelSense::along_x), sign(ChannelSense::along_y), sign(ChannelSense::load)},
          {sign(ChannelSense::about_x), sign(ChannelSense::about_y), sign(ChannelSense::about_z)}};
}

}  // namespace

const std::vector<std::string>& axis_convention_names() {
  static const std::vector<std::string> kNames = {"iso", "adapted_sae", "sae", "adams"};
  return kNames;
}

AxisConvention axis_convention_of(std::string_view name) {
  const auto& names = axis_convention_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw InputError("axes are " + in_quotes(name) + ", expected " + list_of(names));
  }
  return static_cast<AxisConvention>(found - names.begin());
}

const std::vector<std::string>& axis_frame_names() {
  static const std::vector<std::string> kNames = {"W", "H", "C"};
  return kNames;
}

std::string name_of(AxisFrame frame) { return axis_frame_names()[static_cast<std::size_t>(frame)]; }

AxisFrame axis_frame_of(std::string_view name) {
  const auto& names = axis_frame_names();
  const auto found = std::find(names.begin(), names.end(), name);
  assert(found != names.end());
  return static_cast<AxisFrame>(found - names.begin());
}

Wrench to_iso(const Wrench& wrench, AxisConvention from) {
  const Wrench factors = signs(from);
  return {wrench.force.cwiseProduct(factors.force), wrench.moment.cwiseProduct(factors.moment)};
}

WheelSlip to_iso(const WheelSlip& slip, AxisConvention from) {
  return {sign_to_iso(ChannelSense::slip, from) * slip.alpha,
          sign_to_iso(ChannelSense::about_x, from) * slip.gamma,
          slip.kappa};
}

Wrench in_frame(
    const Wrench& wrench, AxisFrame from, AxisFrame to, double gamma, double loaded_radius) {
  // rotation of the axes of frame C into those of frame H
  const Eigen::AngleAxisd lean(gamma, Vector3d::UnitX());
  const Vector3d to_contact = lean * Vector3d(0.0, 0.0, -loaded_radius);
  Wrench in_H = wrench;
  if (from == AxisFrame::C) {
    in_H = {lean * wrench.force, lean * wrench.moment};
  } else if (from == AxisFrame::W) {
    in_H.moment += to_contact.cross(wrench.force);
  }
  if (to == AxisFrame::C) {
    return {lean.inverse() * in_H.force, lean.inverse() * in_H.moment};
  }
  if (to == AxisFrame::W) in_H.moment -= to_contact.cross(in_H.force);
  return in_H;
}

Channels to_iso(const Channels& channels, AxisConvention from) {
  Channels result;
  for (Channel channel : channels.all()) {
    const double sign = sign_to_iso(channel_senses(channel.name), from);
    for (auto* numbers : {&channel.values, &channel.slopes})
      for (double& value : *numbers) value *= sign;
    result.add(std::move(channel));
  }
  return result;
}

}  // namespace latsch
