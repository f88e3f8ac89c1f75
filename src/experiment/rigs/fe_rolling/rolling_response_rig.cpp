// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/rolling_response_rig.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "experiment/rigs/fe_rolling/response_swings.h"

namespace latsch::experiment {
namespace {

using fe_tire::RollingResponse;
using fe_tire::SlipInput;
using fe_tire::SlipResponse;

/// Responses of one state: [frequency][slip].
using SlipResponses = std::vector<std::vector<SlipResponse>>;

constexpr const char* kResponseForces[] = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
/// Least slip of the state with which a wheel turns fast enough to have slips of its own.
constexpr double kLeastSlip = -0.95;
/// Swings over which slopes are compared with those of steady states: rad, 1, rad, 1/m.
constexpr double kSwingOfAngle = 0.1 * std::numbers::pi / 180.0, kSwingOfSlip = 1e-3,
                 kSwingOfCamber = 0.2 * std::numbers::pi / 180.0, kSwingOfTurn = 1e-3;

std::complex<double> part_of_response(const SlipResponse& response, int k) {
  return k < 3 ? response.force[k] : response.moment[k - 3];
}

double speed_along(const RolledState& rolled) {
  return rolled.state.of.speed * std::cos(rolled.state.of.slip_angle);
}

/// Throws InputError if the way that a state rolls in one radian of the highest frequency is
/// shorter than a sector at the ground.
void check_sectors(const TireRig& rig, const RollingResponseTest& test) {
  const fe_tire::Mesh& mesh = rig.tire().mesh();
  const double sector = mesh.outer_radius() * mesh.angle(1);
  for (std::size_t k = 0; k < test.states.rows.size(); ++k) {
    const double highest = test.states.rows[k].speed / (2.0 * std::numbers::pi * sector);
    if (test.frequencies.back() <= highest) continue;
    throw InputError(fmt::format(
        "frequencies reach {:g} Hz, and at {:.4g} km/h of state {} the wheel then rolls less than "
        "a sector of the mesh, {:.0f} mm, in a radian of the change: expected {:.4g} Hz at most, "
        "or narrower sectors (mesh.sector_zones)",
        test.frequencies.back(),
        3.6 * test.states.rows[k].speed,
        k + 1,
        1e3 * sector,
        highest));
  }
}

}  // namespace

const std::vector<ResponseSlip>& response_slips() {
  static const std::vector<ResponseSlip> all = {
      {"alpha",
       "slip angle",
       "N/rad",
       "N m/rad",
       SlipInput::angle,
       "relaxation_side",
       1,
       1,
       kSwingOfAngle,
       "deg"},
      {"kappa", "slip", "N", "N m", SlipInput::spin, "relaxation_slip", 0, 0, kSwingOfSlip},
      {"gamma",
       "camber",
       "N/rad",
       "N m/rad",
       SlipInput::camber,
       nullptr,
       0,
       1,
       kSwingOfCamber,
       "deg"},
      {"phit", "turn slip", "N m", "N m^2", SlipInput::turn, nullptr, 0, 5, kSwingOfTurn, "1/m"}};
  return all;
}

Channels rolling_response_channels(const RollingResponseTest& test,
                                   const std::vector<SlipResponses>& responses,
                                   const std::vector<RolledState>& states) {
  Channels channels;
  const auto add = [&](const std::string& name, const std::string& unit, const auto& value) {
    std::vector<double> values;
    for (std::size_t s = 0; s < responses.size(); ++s)
      for (std::size_t k = 0; k < test.frequencies.size(); ++k) values.push_back(value(s, k));
    channels.add({name, unit, std::move(values)});
  };
  using Index = std::size_t;
  add("state", "1", [](Index s, Index) { return static_cast<double>(s + 1); });
  add("frequency", "Hz", [&](Index, Index k) { return test.frequencies[k]; });
  add("path_frequency", "rad/m", [&](Index s, Index k) {
    return 2.0 * std::numbers::pi * test.frequencies[k] / speed_along(states[s]);
  });
  for (Index j = 0; j < test.slips.size(); ++j) {
    const ResponseSlip& slip = test.slips[j];
    for (int force = 0; force < 6; ++force) {
      const std::string name = fmt::format("{}_by_{}", kResponseForces[force], slip.name);
      const std::string unit = force < 3 ? slip.force_unit : slip.moment_unit;
      const auto at = [&, force, j](Index s, Index k) {
        return part_of_response(responses[s][k][j], force);
      };
      add("re_" + name, unit, [&](Index s, Index k) { return at(s, k).real(); });
      add("im_" + name, unit, [&](Index s, Index k) { return at(s, k).imag(); });
      add("tf_" + name, unit, [&](Index s, Index k) { return std::abs(at(s, k)); });
      add("phase_" + name, "rad", [&](Index s, Index k) { return std::arg(at(s, k)); });
    }
    if (slip.relaxation == nullptr) continue;
    add(slip.relaxation, "m", [&](Index s, Index k) {
      return fe_tire::relaxation_length(part_of_response(responses[s][k][j], slip.force),
                                        test.frequencies[k],
                                        speed_along(states[s]));
    });
  }
  return channels;
}

Result<Channels> rolling_response(TireRig& rig,
                                  const RollingResponseTest& test,
                                  std::vector<std::string>* remarks) {
  check_sectors(rig, test);
  const auto states = roll_states(rig, test.states);
  if (!states) return states.failure();
  std::vector<SlipInput> inputs;
  for (const ResponseSlip& slip : test.slips) inputs.push_back(slip.input);
  std::vector<SlipResponses> responses;
  for (std::size_t s = 0; s < states->size(); ++s) {
    const RolledState& rolled = (*states)[s];
    const auto in_state = [&](const std::string& why) {
      return Failure{fmt::format("state {} of {}: {}", s + 1, states->size(), why)};
    };
    if (rolled.kappa < kLeastSlip)
      return in_state(fmt::format(
          "the wheel is locked or nearly so, kappa {:g}: expected {:g} or more, because a wheel "
          "that hardly turns has no response to a slip",
          rolled.kappa,
          kLeastSlip));
    const auto& round = rig.inflated(rolled.state.pressure);
    if (!round) return in_state(round.failure().reason);
    const auto response = RollingResponse::about(rig.tire(), rolled.state, rig.losses(), *round);
    if (!response) return in_state(response.failure().reason);
    SlipResponses& of = responses.emplace_back();
    for (const double frequency : test.frequencies) {
      of.push_back(response->at(frequency, inputs, test.axle));
      for (std::size_t j = 0; j < inputs.size(); ++j) {
        if (inputs[j] != SlipInput::spin) continue;
        // 1 + kappa is proportional to the spin.
        of.back()[j].force /= 1.0 + rolled.kappa;
        of.back()[j].moment /= 1.0 + rolled.kappa;
      }
    }
    if (remarks == nullptr) continue;
    const auto at_rest = response->at(0.0, inputs, test.axle);
    for (std::string& words : swings_in_words(rig, test, rolled, at_rest, s + 1))
      remarks->push_back(std::move(words));
  }
  return rolling_response_channels(test, responses, *states);
}

}  // namespace latsch::experiment
