// SPDX-License-Identifier: Apache-2.0
#include "report/color_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace latsch::report {
namespace {

using Color = std::array<int, 3>;

constexpr std::array<Color, 11> kViridis = {{{68, 1, 84},
                                             {72, 36, 117},
                                             {65, 68, 135},
                                             {53, 95, 141},
                                             {42, 120, 142},
                                             {33, 145, 140},
                                             {34, 168, 132},
                                             {68, 191, 112},
                                             {122, 209, 81},
                                             {189, 223, 38},
                                             {253, 231, 37}}};

constexpr std::array<const char*, 7> kCategories = {
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f"};
constexpr std::array<const char*, 7> kMuted = {
    "#8fb3d1", "#e2b48f", "#93c9b4", "#dbb3cb", "#ecd49b", "#b5dcf0", "#bdbdbd"};

}  // namespace

std::string viridis(double t) {
  const double at = std::clamp(std::isfinite(t) ? t : 0.0, 0.0, 1.0) * (kViridis.size() - 1);
  const auto below = std::min<size_t>(static_cast<size_t>(at), kViridis.size() - 2);
  const double part = at - static_cast<double>(below);
  Color color;
  for (int k = 0; k < 3; ++k) {
    color[k] = static_cast<int>(
        std::lround(kViridis[below][k] * (1.0 - part) + kViridis[below + 1][k] * part));
  }
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

std::string category(int index) { return kCategories[index % kCategories.size()]; }
std::string muted_category(int index) { return kMuted[index % kMuted.size()]; }

}  // namespace latsch::report
