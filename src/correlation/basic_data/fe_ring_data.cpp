// SPDX-License-Identifier: Apache-2.0
#include "correlation/basic_data/fe_ring_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace latsch::correlation {
namespace {

using fe_tire::ModeType;

constexpr std::array kDeflections{0.010, 0.018, 0.026};  // m
constexpr int kModes = 24;

struct RingNumber {
  const char* path;
  double range;  // of its first guess, either way
};
constexpr std::array kNumbers{RingNumber{"belt.mass", 3.0},
                              RingNumber{"sidewall.radial.stiffness", 4.0},
                              RingNumber{"sidewall.tangential.stiffness", 4.0},
                              RingNumber{"sidewall.lateral.stiffness", 5.0},
                              RingNumber{"sidewall.torsion", 10.0},
                              RingNumber{"sidewall.progressivity", 20.0},
                              RingNumber{"belt.pressure_width", 3.0},
                              RingNumber{"belt.bending_in_plane", 20.0},
                              RingNumber{"belt.bending_lateral", 20.0}};

struct RingMotion {
  const char* name;
  ModeType type;
  int waves;
};
constexpr std::array kMotions{RingMotion{"f1", ModeType::torsional, 0},
                              RingMotion{"f2", ModeType::radial, 1},
                              RingMotion{"f3", ModeType::lateral, 0},
                              RingMotion{"f4", ModeType::lateral, 1},
                              RingMotion{"f5", ModeType::radial, 2},
                              RingMotion{"f6", ModeType::lateral, 2}};

DesignSpace space_around(const Document& known) {
  std::vector<DesignVariable> variables;
  for (const RingNumber& number : kNumbers) {
    const double guess = known.get(number.path);
    variables.push_back({.name = number.path,
                         .paths = {number.path},
                         .lower = guess / number.range,
                         .upper = guess * number.range,
                         .initial = guess,
                         .scale = Scale::logarithmic});
  }
  return DesignSpace(std::move(variables));
}

}  // namespace

Result<RingData> ring_data_of(fe_tire::FeTire& tire, double pressure, const Document& known) {
  const auto inflated = tire.inflate(pressure);
  if (!inflated) return inflated.failure();
  const auto modes = tire.modes(*inflated, kModes);
  if (!modes) return modes.failure();
  const auto loaded = tire.load(*inflated, {kDeflections.begin(), kDeflections.end()}, {});
  if (!loaded) return loaded.failure();
  std::vector<RingTarget> targets;
  for (const fe_tire::LoadPoint& point : loaded->curve)
    targets.push_back({.name = fmt::format("load at {:.0f} mm", 1e3 * point.deflection),
                       .kind = RingTarget::Kind::load,
                       .value = point.Fz,
                       .deflection = point.deflection});
  for (const RingMotion& motion : kMotions) {
    const auto mode = std::find_if(modes->begin(), modes->end(), [&](const fe_tire::Mode& m) {
      return m.type == motion.type && m.n == motion.waves && m.order == 1;
    });
    if (mode == modes->end()) continue;
    targets.push_back({.name = motion.name,
                       .kind = RingTarget::Kind::frequency,
                       .value = mode->frequency,
                       .waves = motion.waves,
                       .lateral = motion.type == ModeType::lateral});
  }
  return RingData{{}, known, space_around(known), std::move(targets)};
}

}  // namespace latsch::correlation
