// SPDX-License-Identifier: Apache-2.0
#include "measurement/axes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace latsch {
namespace {

using Eigen::Vector3d;

std::string capitals(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

/// Factors of Fx, Fy, Fz and of Mx, My, Mz.
Wrench signs(AxisConvention from) {
  switch (from) {
    case AxisConvention::iso:
      return {{1, 1, 1}, {1, 1, 1}};
    case AxisConvention::adapted_sae:
      return {{1, -1, 1}, {1, -1, -1}};
    case AxisConvention::sae:
      return {{1, -1, -1}, {1, -1, -1}};
  }
  return {};
}

double sign_of_alpha(AxisConvention from) { return from == AxisConvention::sae ? -1.0 : 1.0; }

/// 1 for a channel that is the same in every convention.
double sign_of(const std::string& channel, AxisConvention from) {
  const std::string name = capitals(channel);
  if (name == "SLIPANGL" || name == "ALPHA" || name == "SA") return sign_of_alpha(from);
  const bool framed =
      name.size() == 3 && std::string_view("WHC").find(name[2]) != std::string::npos;
  if (name.size() != 2 && !framed) return 1.0;
  const std::size_t axis = std::string_view("XYZ").find(name[1]);
  if (axis == std::string::npos || (name[0] != 'F' && name[0] != 'M')) return 1.0;
  const Wrench factors = signs(from);
  return name[0] == 'F' ? factors.force[axis] : factors.moment[axis];
}

}  // namespace

const std::vector<std::string>& axis_convention_names() {
  static const std::vector<std::string> kNames = {"iso", "adapted_sae", "sae"};
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
  return {sign_of_alpha(from) * slip.alpha, slip.gamma, slip.kappa};
}

Wrench in_frame(
    const Wrench& wrench, AxisFrame from, AxisFrame to, double gamma, double loaded_radius) {
  const Eigen::AngleAxisd lean(gamma, Vector3d::UnitX());  // from the axes of C to those of H
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

double kappa_of_bounded_slip(double lambda) {
  assert(lambda > -1.0 && lambda <= 1.0);
  return lambda >= 0.0 ? -lambda : -lambda / (1.0 + lambda);
}

double bounded_slip_of_kappa(double kappa) {
  assert(kappa >= -1.0);
  return kappa <= 0.0 ? -kappa : -kappa / (1.0 + kappa);
}

Channels to_iso(const Channels& channels, AxisConvention from) {
  Channels result;
  for (Channel channel : channels.all()) {
    const double sign = sign_of(channel.name, from);
    for (double& value : channel.values) value *= sign;
    result.add(std::move(channel));
  }
  return result;
}

}  // namespace latsch
