// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/limits/file_ranges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace latsch::magic_formula {

std::span<const FileRange> file_ranges() {
  using P = Parameters;
  constexpr double kDegrees = 180.0 / std::numbers::pi, kKilo = 1e-3;
  static const auto Fz = [](const State& s) { return s.Fz; };
  static const auto kappa = [](const State& s) { return s.kappa; };
  static const auto alpha = [](const State& s) { return s.alpha; };
  static const auto gamma = [](const State& s) { return s.gamma; };
  static const auto p = [](const State& s) { return s.p; };
  static const auto speed = [](const State& s) { return std::abs(s.Vx); };
  static const FileRange kRanges[] = {
      {"Fz", "FZMIN", false, &P::FZMIN, Fz, 1.0, " N"},
      {"Fz", "FZMAX", true, &P::FZMAX, Fz, 1.0, " N"},
      {"kappa", "KPUMIN", false, &P::KPUMIN, kappa, 1.0, ""},
      {"kappa", "KPUMAX", true, &P::KPUMAX, kappa, 1.0, ""},
      {"alpha", "ALPMIN", false, &P::ALPMIN, alpha, kDegrees, " deg"},
      {"alpha", "ALPMAX", true, &P::ALPMAX, alpha, kDegrees, " deg"},
      {"gamma", "CAMMIN", false, &P::CAMMIN, gamma, kDegrees, " deg"},
      {"gamma", "CAMMAX", true, &P::CAMMAX, gamma, kDegrees, " deg"},
      {"the pressure", "PRESMIN", false, &P::PRESMIN, p, kKilo, " kPa"},
      {"the pressure", "PRESMAX", true, &P::PRESMAX, p, kKilo, " kPa"},
      {"the speed", "VXLOW", false, &P::VXLOW, speed, 1.0, " m/s"},
  };
  return kRanges;
}

bool is_end_of_range(std::string_view key) {
  return std::ranges::any_of(file_ranges(), [&](const FileRange& one) { return one.key == key; });
}

}  // namespace latsch::magic_formula
