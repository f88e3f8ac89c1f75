// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/suspension/kc_senses.h"

#include <array>
#include <utility>

namespace latsch::experiment {
namespace {

using suspension::Sense;
using Named = std::pair<std::string_view, Sense>;

constexpr std::array<Named, 14> kSenses = {{{"dx", Sense::along_x},
                                            {"dy", Sense::along_y},
                                            {"dz", Sense::along_z},
                                            {"about_x", Sense::about_x},
                                            {"about_y", Sense::about_y},
                                            {"about_z", Sense::about_z},
                                            {"Fx", Sense::along_x},
                                            {"Fy", Sense::along_y},
                                            {"Fz", Sense::along_z},
                                            {"Mx", Sense::about_x},
                                            {"My", Sense::about_y},
                                            {"Mz", Sense::about_z},
                                            {"rack", Sense::along_y},
                                            {"pad", Sense::along_z}}};
// Classical compliances: toe or camber by what acts.
constexpr std::array<Named, 3> kActing = {{{"lateral_force_", Sense::along_y},
                                           {"longitudinal_force_", Sense::along_x},
                                           {"aligning_torque_", Sense::about_z}}};

Sense sense_of(std::string_view quantity) {
  if (quantity.ends_with("_L") || quantity.ends_with("_R")) quantity.remove_suffix(2);
  for (const auto& [name, sense] : kSenses)
    if (quantity == name) return sense;
  return Sense::same;
}

}  // namespace

suspension::SignSense kc_sense(std::string_view channel) {
  for (const auto& [begin, acting] : kActing)
    if (channel.starts_with(begin)) return {.by = acting};
  constexpr std::string_view kBy = "_by_";
  const std::size_t by = channel.find(kBy);
  if (by == std::string_view::npos) return {.of = sense_of(channel)};
  return {.of = sense_of(channel.substr(0, by)), .by = sense_of(channel.substr(by + kBy.size()))};
}

}  // namespace latsch::experiment
