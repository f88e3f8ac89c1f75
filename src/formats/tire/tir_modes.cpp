// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_modes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <vector>

namespace latsch::formats {
namespace {

constexpr std::array<const char*, 6> kForces = {"the vertical force alone",
                                                "Fx and My without side force",
                                                "Fy, Mx and Mz without longitudinal force",
                                                "all forces without interaction of the slips",
                                                "all forces in combined slip",
                                                "all forces in combined slip with turn slip"};
constexpr std::array<const char*, 5> kDynamics = {"in steady state",
                                                  "with relaxation",
                                                  "with relaxation that depends on the slip",
                                                  "with a belt on springs",
                                                  "with a belt on springs"};
constexpr int kCombined = 4, kTurnSlip = 5, kRelaxation = 1, kNonlinear = 2;

struct Digits {
  std::size_t forces, dynamics, contact;
};

Digits digits_of(int mode) {
  const auto digits = static_cast<std::size_t>(mode < 0 ? -mode : mode);
  return {digits % 10, digits / 10 % 10, digits / 100};
}

}  // namespace

std::string asked_by_use_mode(const TirFile& tir) {
  const Digits mode = digits_of(tir.parameters.use_mode);
  return fmt::format(
      "{}, {}",
      mode.forces < kForces.size() ? kForces[mode.forces] : "unknown forces",
      mode.dynamics < kDynamics.size() ? kDynamics[mode.dynamics] : "unknown dynamics");
}

std::string unlike_use_mode(const TirFile& tir) {
  const Digits mode = digits_of(tir.parameters.use_mode);
  std::vector<std::string> here;
  if (mode.forces == kTurnSlip)
    here.emplace_back("turn slip is computed only if a test asks for it (turn_slip = \"on\")");
  else if (mode.forces >= kForces.size())
    here.emplace_back(
        "expected a last digit of 0 to 5; all forces are computed here, in combined slip");
  else if (mode.forces != kCombined)
    here.emplace_back("all forces are computed here, in combined slip");
  if (mode.dynamics == kNonlinear)
    here.emplace_back("the relaxation lengths here do not depend on the slip");
  else if (mode.dynamics >= kDynamics.size())
    here.emplace_back(
        "expected 0 to 4 before the last digit; a tire that rolls has relaxation here");
  else if (mode.dynamics > kNonlinear)
    here.emplace_back("a belt is computed here only in a model of kind = \"rigid_ring\"");
  if (mode.contact > 1)
    here.emplace_back(
        "the contact with the road is that of the model here, for any hundreds digit");
  if (here.empty()) return "";
  return fmt::format("USE_MODE is {}: it asks for {}; {}",
                     tir.parameters.use_mode,
                     asked_by_use_mode(tir),
                     fmt::join(here, "; "));
}

}  // namespace latsch::formats
