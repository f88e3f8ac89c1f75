// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/fe_tire_specimen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "experiment/kinds/fe_variations.h"
#include "experiment/rigs/fe_rolling/ground_friction.h"
#include "experiment/rigs/fe_rolling/slip_record.h"
#include "experiment/rigs/fe_rolling/steady_table.h"
#include "experiment/rigs/fe_tire/rolling_rig.h"
#include "experiment/rigs/slip/rolling_stiffness.h"
#include "models/fe_tire/passage/fe_rolling_tire.h"

namespace latsch::experiment {
namespace {

/// Number of sectors of a tire that rolls.
constexpr int kFewestSectors = 8;
/// Speed at which the limit of friction is described, m/s, before the tire rolls.
constexpr double kUsualSpeed = 60.0 / 3.6;

/// Returns the channels with zero derivatives by the tire's own pressure, which has no effect on a
/// test that states a pressure. Columns follow the order of the paths.
Channels held_at_pressure(const Channels& channels, const std::vector<std::string>& paths) {
  Channels held;
  for (Channel channel : channels.all()) {
    const std::size_t rows = channel.values.size();
    for (std::size_t k = 0; k < paths.size() && !channel.slopes.empty(); ++k)
      if (paths[k] == "pressure") std::fill_n(channel.slopes.begin() + k * rows, rows, 0.0);
    held.add(std::move(channel));
  }
  return held;
}

}  // namespace

void SlopedTire::set(fe_tire::Materials materials) {
  slopes_.reset();
  tire_->set(std::move(materials));
}

Result<fe_tire::TireSlopes*> SlopedTire::slopes_in(const std::vector<std::string>& paths,
                                                   const Document& numbers) {
  if (slopes_ && paths_ == paths) return slopes_.get();
  auto variations = fe_variations(numbers, paths, varied_);
  if (!variations) return variations.failure();
  slopes_ = std::make_unique<fe_tire::TireSlopes>(*tire_, std::move(*variations));
  paths_ = paths;
  return slopes_.get();
}

FeTireSpecimen::FeTireSpecimen(fe_tire::FeTire tire,
                               double pressure,
                               Document numbers,
                               Varied varied)
    : own_(std::move(tire), std::move(varied)),
      pressure_(pressure),
      numbers_(std::move(numbers)),
      rig_(std::make_unique<TireRig>(own_.tire(), pressure)) {}

Result<Channels> FeTireSpecimen::press(const LoadDeflection& test, const Asked& asked) {
  const auto press = [&](TireRig& rig, fe_tire::TireSlopes* slopes) {
    return slopes ? rig.run(test, *slopes, asked.channels) : rig.run(test);
  };
  return drive(press, test.pressure.has_value(), asked);
}

Result<Channels> FeTireSpecimen::vibrate(const ModalTest& test, const Asked& asked) {
  const auto vibrate = [&](TireRig& rig, fe_tire::TireSlopes* slopes) {
    return slopes ? rig.run(test, *slopes, asked.channels) : rig.run(test);
  };
  return drive(vibrate, test.pressure.has_value(), asked);
}

Result<Channels> FeTireSpecimen::drive(const FeTireDrive& drive,
                                       bool states_pressure,
                                       const Asked& asked) {
  if (asked.paths.empty() || asked.channels.empty()) return drive(*rig_, nullptr);
  const auto slopes = own_.slopes_in(asked.paths, numbers_);
  if (!slopes) return slopes.failure();
  const auto channels = drive(*rig_, *slopes);
  if (!channels || !states_pressure) return channels;
  return held_at_pressure(*channels, asked.paths);
}

void FeTireSpecimen::set(fe_tire::Materials materials, double pressure, Document numbers) {
  own_.set(std::move(materials));
  pressure_ = pressure;
  numbers_ = std::move(numbers);
  rig_ = std::make_unique<TireRig>(own_.tire(), pressure);
  rig_->set_rim(rim_);
  rig_->set_losses(losses_);
  rig_->set_friction(friction_);
  rig_->set_reduction(reduced_to_);
}

void FeTireSpecimen::set_rim(std::optional<fe_tire::RimBody> rim) {
  rim_ = rim;
  rig_->set_rim(rim);
}

void FeTireSpecimen::set_losses(fe_tire::LossMaterials losses) {
  losses_ = std::move(losses);
  rig_->set_losses(losses_);
}

void FeTireSpecimen::set_friction(std::optional<fe_tire::RollingFriction> friction) {
  friction_ = friction;
  rig_->set_friction(friction);
}

void FeTireSpecimen::set_reduction(std::optional<double> highest) {
  reduced_to_ = highest;
  rig_->set_reduction(highest);
}

Result<StandingTire> FeTireSpecimen::standing(fe_tire::FeTire& tire,
                                              const FootprintTest& test) const {
  fe_tire::Ground ground;
  ground.mu = test.friction.value_or(0.0);
  return stand_in_states(tire, test.pressure.value_or(pressure_), ground, test);
}

Result<std::vector<StandingFootprint>> FeTireSpecimen::footprints(const FootprintTest& test) {
  SlopedTire& on = for_footprint(test);
  const auto standing = this->standing(on.tire(), test);
  if (!standing) return standing.failure();
  return experiment::footprints(on.tire(), *standing);
}

Result<Channels> FeTireSpecimen::print(const FootprintTest& test, const Asked& asked) {
  SlopedTire& on = for_footprint(test);
  const auto standing = this->standing(on.tire(), test);
  if (!standing) return standing.failure();
  const auto prints = experiment::footprints(on.tire(), *standing);
  const Channels channels = to_channels(test, prints);
  if (asked.paths.empty() || asked.channels.empty()) return channels;
  const auto slopes = on.slopes_in(asked.paths, numbers_);
  if (!slopes) return slopes.failure();
  const auto found = footprint_slopes(test, *standing, prints, **slopes);
  if (!found) return found.failure();
  const Channels sloped = with_slopes(channels, *found);
  return test.pressure ? held_at_pressure(sloped, asked.paths) : sloped;
}

Result<Channels> FeTireSpecimen::steady(const formats::CsvTable& states,
                                        const SteadyConditions& conditions) {
  return roll_table(*rig_, states, conditions);
}

Result<Channels> FeTireSpecimen::steady_with_slopes(const formats::CsvTable& states,
                                                    const SteadyConditions& conditions,
                                                    const Asked& asked) {
  const auto roll = [&](TireRig& rig, fe_tire::TireSlopes* slopes) {
    return roll_table(rig, states, conditions, slopes);
  };
  return drive(roll, false, asked);  // rows with a pressure state it themselves
}

Result<std::vector<std::string>> FeTireSpecimen::steady_in_blocks(
    const formats::CsvTable& states,
    const SteadyConditions& conditions,
    const std::function<void(const Channels&)>& tell) {
  const Status done = roll_table(*rig_, states, conditions, tell);
  if (!done) return done.failure();
  return remarks_on_table(*rig_, states, conditions);
}

std::vector<std::string> FeTireSpecimen::limits_in(const formats::CsvTable& states,
                                                   const SteadyConditions& conditions) {
  return remarks_on_table(*rig_, states, conditions);
}

Result<Channels> FeTireSpecimen::slip_history(const formats::CsvTable& states,
                                              const SlipHistoryConditions& conditions,
                                              const Asked&,
                                              std::vector<std::string>& remarks) {
  return roll_record(*rig_, states, conditions, remarks);
}

Status FeTireSpecimen::history_in_blocks(const formats::CsvTable& states,
                                         const SlipHistoryConditions& conditions,
                                         const std::function<void(const Channels&)>& tell,
                                         std::vector<std::string>& remarks) {
  return roll_record(*rig_, states, conditions, tell, remarks);
}

std::vector<std::string> FeTireSpecimen::limits_in_history(
    const formats::CsvTable& states, const SlipHistoryConditions& conditions) const {
  return remarks_on_record(*rig_, states, conditions);
}

bool rolls(const Test& test) {
  return test.settings_as<SteadyConditions>() || test.settings_as<RollingTest>() ||
         test.settings_as<RollingStiffnessTest>();
}

std::string why_without_rates(const fe_tire::LossMaterials& losses, const Test& test) {
  const auto* steady = test.settings_as<SteadyConditions>();
  const auto* rolling = test.settings_as<RollingTest>();
  if (!rolls(test)) return "";
  if (!losses.is_elastic())
    return "slopes of a rolling tire are known for elastic ones, and this tire has Prony terms or "
           "a loss factor";
  const bool is_smooth =
      (steady && steady->friction == 0.0) || (rolling && rolling->friction == 0.0);
  if (is_smooth)
    return "slopes of a rolling tire are known for ground with friction, and that of the test is 0";
  return "";
}

std::unique_ptr<Tire> FeTireSpecimen::tire(const Inflation& pressure) const {
  const double inflation = pressure.value_or(pressure_);
  if (own_.tire().mesh().sectors < kFewestSectors)
    throw InputError(
        "a finite-element tire rolls in time if its mesh consists of equal sectors: expected a "
        "mesh in which they are found");
  const auto& inflated = rig_->inflated(inflation);
  if (!inflated) throw InputError("the tire does not roll: " + inflated.failure().reason);
  fe_tire::FeRollingSettings settings;
  if (reduced_to_) settings.reduction = {.highest = *reduced_to_};
  return std::make_unique<fe_tire::FeRollingTire>(
      own_.tire(),
      *inflated,
      losses_,
      friction_by_speed(*rig_, friction_of(*rig_, {}), inflation),
      settings);
}

std::vector<std::string> FeTireSpecimen::assumed_in_time() const {
  std::vector<std::string> assumed = {
      "the finite-element tire rolls in time from the steady state of its first motion, without a "
      "run-in; it feels the road through means over the length of an element, with one friction "
      "below the whole tire",
      friction_in_words(*rig_, pressure_, kUsualSpeed)};
  if (reduced_to_)
    assumed.push_back(fmt::format(
        "the tire is reduced to its modes below {:.4g} Hz and to static displacements: it stays as "
        "stiff as in the steady state of its first motion, which counts where its deflection "
        "changes by more than some millimeters (the test drum_cleat says by how much)",
        *reduced_to_));
  if (losses_.is_elastic())
    assumed.emplace_back(
        "the tire has no Prony terms and no loss factor, so nothing but friction damps its "
        "vibration");
  return assumed;
}

std::optional<Rolls::Felt> FeTireSpecimen::felt() const {
  const fe_tire::Mesh& mesh = own_.tire().mesh();
  Felt felt;
  for (const fe_tire::Element& element : mesh.elements)
    if (element.tread)
      for (const int node : element.node)
        felt.half_width =
            std::max(felt.half_width, std::abs(mesh.X(1, node % mesh.nodes_per_sector())));
  double rim = mesh.outer_radius();
  for (const int node : mesh.clamped)
    rim = std::min(rim, std::hypot(mesh.X(0, node), mesh.X(2, node)));
  felt.section = mesh.outer_radius() - rim;
  return felt;
}

std::string why_every_run_fails(const fe_tire::Mesh& mesh, const Test& test) {
  if (const auto* steady = test.settings_as<SteadyConditions>()) return refused_conditions(*steady);
  const auto* modes = test.settings_as<ModalTest>();
  if (!modes) return "";
  const Status near = points_on_tire(mesh, modes->points);
  return near.ok() ? "" : near.failure().reason;
}

}  // namespace latsch::experiment
