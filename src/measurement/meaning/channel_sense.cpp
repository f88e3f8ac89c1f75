// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/channel_sense.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>

#include "measurement/meaning/channel_words.h"

namespace latsch {
namespace {

using S = ChannelSense;
using Named = std::pair<std::string_view, S>;

constexpr std::array kSenses = {
    Named{"Fx", S::along_x},
    Named{"Fy", S::along_y},
    Named{"Fz", S::load},
    Named{"Mx", S::about_x},
    Named{"My", S::about_y},
    Named{"Mz", S::about_z},
    Named{"Mzr", S::about_z},
    Named{"alpha", S::slip},
    Named{"phit", S::slip},
    Named{"gamma", S::about_x},
    Named{"Vx", S::along_x},
    Named{"Vy", S::along_y},
    Named{"Vz", S::along_z},
    Named{"dx", S::along_x},
    Named{"dy", S::along_y},
    Named{"dz", S::along_z},
    Named{"x", S::along_x},
    Named{"y", S::along_y},
    Named{"z", S::along_z},
    Named{"ux", S::along_x},
    Named{"uy", S::along_y},
    Named{"uz", S::along_z},
    Named{"ax", S::along_x},
    Named{"ay", S::along_y},
    Named{"az", S::along_z},
    Named{"about_x", S::about_x},
    Named{"about_y", S::about_y},
    Named{"about_z", S::about_z},
    Named{"roll", S::about_x},
    Named{"pitch", S::about_y},
    Named{"yaw", S::about_z},
    Named{"steer", S::about_z},
    Named{"heave", S::along_z},
    Named{"body_z", S::along_z},
    Named{"hub", S::along_z},
    Named{"rack", S::along_y},
    Named{"pad", S::load},
    Named{"axle_roll_center_y", S::along_y},
    Named{"contact_x", S::along_x},
    Named{"contact_y", S::along_y},
    Named{"contact_z", S::along_z},
    Named{"center_x", S::along_x},
    Named{"center_y", S::along_y},
    Named{"center_z", S::along_z},
    Named{"arb_angle", S::about_y},
    Named{"arb_ratio", S::about_y},
    // These quantities do not depend on the axes.
    Named{"time", S::same},
    Named{"omega", S::same},
    Named{"wheel_speed", S::same},
    Named{"speed", S::same},
    Named{"kappa", S::same},
    Named{"p", S::same},
    Named{"loaded_radius", S::same},
    Named{"R_e", S::same},
    Named{"R_l", S::same},
    Named{"rho", S::same},
    Named{"deflection", S::same},
    Named{"force", S::same},
    Named{"spread", S::same},
    Named{"frequency", S::same},
    Named{"tread", S::same},
    Named{"tread_inner", S::same},
    Named{"tread_center", S::same},
    Named{"tread_outer", S::same},
    Named{"road", S::same},
    Named{"ambient", S::same},
    Named{"toe", S::same},
    Named{"camber", S::same},
    Named{"caster", S::same},
    Named{"travel", S::same},
    Named{"kpi", S::same},
    Named{"mechanical_trail", S::same},
    Named{"caster_offset", S::same},
    Named{"caster_trail_hub", S::same},
    Named{"scrub_radius", S::same},
    Named{"kingpin_offset", S::same},
    Named{"bump_steer", S::same},
    Named{"bump_camber", S::same},
    Named{"roll_center", S::same},
    Named{"roll_center_height", S::same},
    Named{"axle_roll_center_height", S::same},
    Named{"spring_length", S::same},
    Named{"motion_ratio", S::same},
    Named{"wheel_rate", S::same},
    Named{"ride_rate", S::same},
    Named{"ride_frequency", S::same},
    Named{"track", S::same},
    Named{"roll_camber", S::same},
    Named{"post", S::same},
    Named{"pushrod", S::same},
    Named{"spring", S::same},
};

// Beginnings of the names of classical compliances, such as lateral_force_toe, and the sense of the
// load. A compliance is the change of toe or camber per unit of this load.
constexpr std::array kActing = {Named{"lateral_force_", S::along_y},
                                Named{"longitudinal_force_", S::along_x},
                                Named{"aligning_torque_", S::about_z}};

constexpr std::array<std::string_view, 8> kWheels = {
    "L", "R", "left", "right", "FL", "FR", "RL", "RR"};

S named(std::string_view name) {
  for (const auto& [known, sense] : kSenses)
    if (known == name) return sense;
  return S::unknown;
}

/// Returns the sense of a quantity under any spelling, for any wheel or frame. The sense says how
/// its sign depends on the axes.
S sense_of(std::string_view quantity) {
  if (const S exact = named(quantity); exact != S::unknown) return exact;
  const std::size_t at = quantity.find_last_of("_ ");
  const std::string_view wheel = at == quantity.npos ? "" : quantity.substr(at + 1);
  const bool has_wheel = std::any_of(
      kWheels.begin(), kWheels.end(), [&](std::string_view one) { return wheel == one; });
  const std::string_view base = has_wheel ? quantity.substr(0, at) : quantity;
  if (const S of_wheel = named(base); of_wheel != S::unknown) return of_wheel;
  if (const auto found = recognized(quantity)) {
    // "Camber" is the angle of a suspension, although it may be the inclination of a tire.
    std::string small(base);
    for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const S kept = found->keeps_name ? named(small) : S::unknown;
    return kept != S::unknown ? kept : named(found->meaning->name);
  }
  constexpr std::string_view kOther = "other_";
  return quantity.starts_with(kOther) ? sense_of(quantity.substr(kOther.size())) : S::unknown;
}

}  // namespace

Eigen::Matrix3d axes_of(AxisConvention convention) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (convention == AxisConvention::adams)
    axes.diagonal() << -1.0, -1.0, 1.0;
  else if (convention != AxisConvention::iso)
    axes.diagonal() << 1.0, -1.0, -1.0;
  return axes;
}

ChannelSenses channel_senses(std::string_view name) {
  for (const auto& [begin, acting] : kActing)
    if (name.starts_with(begin)) return {S::same, acting};
  if (const auto found = recognized(name)) {
    const std::string_view meant = found->meaning->name;
    if (meant == "NFX") return {S::along_x, S::load};
    if (meant == "NFY") return {S::along_y, S::load};
  }
  if (name == "roll_steer") return {S::about_z, S::about_x};
  constexpr std::string_view kBy = "_by_";
  const std::size_t by = name.find(kBy);
  if (by == name.npos) return {sense_of(name)};
  return {sense_of(name.substr(0, by)), sense_of(name.substr(by + kBy.size()))};
}

double sign_to_iso(ChannelSense sense, AxisConvention from) {
  const Eigen::Matrix3d R = axes_of(from);
  const double handed = R.determinant();  // 1 for right-handed axes, as in all conventions
  const double reversed = from == AxisConvention::adapted_sae ? -1.0 : 1.0;
  switch (sense) {
    case S::along_x:
      return R(0, 0);
    case S::along_y:
      return R(1, 1);
    case S::along_z:
      return R(2, 2);
    case S::about_x:
      return handed * R(0, 0);
    case S::about_y:
      return handed * R(1, 1);
    case S::about_z:
      return handed * R(2, 2);
    case S::load:
      return reversed * R(2, 2);
    case S::slip:
      return reversed * R(1, 1);
    case S::same:
    case S::unknown:
      break;
  }
  return 1.0;
}

double sign_to_iso(const ChannelSenses& senses, AxisConvention from) {
  if (!senses.is_known()) return 1.0;
  return sign_to_iso(senses.of, from) * sign_to_iso(senses.by, from);
}

}  // namespace latsch
