// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/pictures/fe_tire_pictures.h"

#include <algorithm>

#include "experiment/rigs/fe_tire/deflection_for_load.h"
#include "experiment/rigs/fe_tire/discretization.h"
#include "experiment/tests/load_deflection.h"
#include "experiment/tests/modes.h"
#include "models/fe_tire/description/section_plan.h"
#include "models/fe_tire/motion/spinning_tire.h"

namespace latsch::experiment {
namespace {

constexpr int kShownModes = 12;
constexpr int kPressSteps = 5;
constexpr double kGuessedStiffness =
    2.0e5;  // N/m, start of the search for the deflection under a load

/// Returns the largest deflection of a load-deflection test, m.
double depth(const LoadDeflection& test, double inflated_radius) {
  double deepest = 0.0;
  for (double deflection : test.deflections) deepest = std::max(deepest, deflection);
  for (double radius : test.loaded_radii) deepest = std::max(deepest, inflated_radius - radius);
  return deepest;
}

std::optional<fe_tire::TireState> press(fe_tire::FeTire& tire,
                                        const fe_tire::Inflated& inflated,
                                        double deflection,
                                        const fe_tire::Ground& ground) {
  if (deflection <= 0.0) return std::nullopt;
  std::vector<double> steps;
  for (int i = 1; i <= kPressSteps; ++i) steps.push_back(deflection * i / kPressSteps);
  auto pressed = tire.press(inflated, ground, steps);
  if (!pressed) return std::nullopt;
  return std::move(pressed->back());
}

std::optional<fe_tire::TireState> stand(fe_tire::FeTire& tire,
                                        const fe_tire::Inflated& inflated,
                                        const ModalTest& test) {
  if (test.deflection) return press(tire, inflated, *test.deflection, test.ground);
  auto loaded =
      load_to_force(tire, inflated, *test.load, *test.load / kGuessedStiffness, test.ground);
  if (!loaded) return std::nullopt;
  return std::move(*loaded);
}

/// Adds the modes of a tire that rotates or whose rim moves, each as its shape at one moment.
void add_spinning_modes(fe_tire::FeTire& tire,
                        const ModalTest& test,
                        const std::optional<fe_tire::RimBody>& rim,
                        const fe_tire::Inflated& at_rest,
                        report::TirePictures& pictures) {
  if (test.rim != fe_tire::RimMotion::held && !rim) return;
  fe_tire::SpinningTire spinning(tire);
  const double speed = test.speed ? test.speed->on(at_rest.radius) : 0.0;
  auto state = spinning.inflate(at_rest, speed);
  if (!state) return;
  pictures.inflated = *state;
  const auto modes = spinning.modes(
      *state, {.motion = test.rim, .body = rim.value_or(fe_tire::RimBody{})}, kShownModes);
  if (!modes) return;
  if (test.speed) pictures.spin = "spinning at " + speed_in_words(*test.speed);
  for (const fe_tire::SpinningMode& mode : *modes) {
    fe_tire::Mode& shown = pictures.modes.emplace_back();
    shown.frequency = mode.frequency;
    shown.n = mode.n;
    shown.type = mode.type;
    shown.order = mode.order;
    shown.shape = mode.shape.real();
    pictures.mode_names.push_back(mode.label());
  }
}

void add_modes(fe_tire::FeTire& tire,
               const ModalTest& test,
               double own_pressure,
               const std::optional<fe_tire::RimBody>& rim,
               report::TirePictures& pictures) {
  const auto inflated = tire.inflate(test.pressure.value_or(own_pressure));
  if (!inflated) return;
  if (test.moves()) return add_spinning_modes(tire, test, rim, *inflated, pictures);
  pictures.inflated = *inflated;
  std::optional<fe_tire::TireState> standing;
  if (test.loaded()) {
    standing = stand(tire, *inflated, test);
    if (!standing) return;
    pictures.loaded = {standing->u, tire.stand(*standing)};
  }
  auto modes =
      test.loaded() ? tire.modes(*standing, kShownModes) : tire.modes(*inflated, kShownModes);
  if (!modes) return;
  pictures.modes = std::move(*modes);
  pictures.modes_loaded = test.loaded();
}

void add_load(fe_tire::FeTire& tire,
              const LoadDeflection& test,
              double own_pressure,
              report::TirePictures& pictures) {
  if (pictures.loaded) return;
  auto inflated = tire.inflate(test.pressure.value_or(own_pressure));
  if (!inflated) return;
  const auto standing = press(tire, *inflated, depth(test, inflated->radius), test.ground);
  if (!standing) return;
  pictures.loaded = {standing->u, tire.stand(*standing)};
  pictures.inflated = std::move(*inflated);
}

/// Returns the ply of every cord layer in the mesh, with its angle at the crown.
std::vector<report::Layer> cord_layers(const fe_tire::TireDescription& description) {
  const fe_tire::SectionPlan plan(description);
  std::vector<report::Layer> layers(plan.layers());
  for (int column = 0; column < plan.columns(); ++column) {
    for (const auto& here : plan.plies(column)) {
      const fe_tire::CordPly& ply = description.plies[here.ply];
      layers[here.layer] = {ply.name, ply.cords.angle};
    }
  }
  return layers;
}

}  // namespace

void add_pictures(fe_tire::FeTire& tire,
                  double own_pressure,
                  const std::vector<const Test*>& tests,
                  const std::optional<fe_tire::RimBody>& rim,
                  report::TirePictures pictures,
                  report::StudyReport& page) {
  pictures.mesh = tire.mesh();
  for (const Test* test : tests) {
    const auto* modes = test->settings_as<ModalTest>();
    if (modes && pictures.modes.empty()) add_modes(tire, *modes, own_pressure, rim, pictures);
  }
  for (const Test* test : tests) {
    if (const auto* load = test->settings_as<LoadDeflection>())
      add_load(tire, *load, own_pressure, pictures);
  }
  page.pictures = std::move(pictures);
}

void add_pictures(const fe_tire::TireDescription& description,
                  const std::vector<const Test*>& tests,
                  report::StudyReport& page) {
  page.tire = description.name + ", " + description.size;
  fe_tire::FeTire tire(description);
  report::TirePictures pictures;
  pictures.layers = cord_layers(description);
  add_pictures(tire, description.pressure, tests, description.rim, std::move(pictures), page);
}

void add_mesh_error(const fe_tire::TireDescription& tire,
                    const std::vector<const Test*>& tests,
                    Thoroughness thoroughness,
                    report::StudyReport& page) {
  DiscretizationSettings settings;
  settings.element = tire.element;
  settings.refinements = {1, 2, 3};
  settings.pressure = tire.pressure;
  const auto take_conditions = [&](const auto& test) {
    settings.pressure = test.pressure.value_or(tire.pressure);
    settings.ground = test.ground;
  };
  if (!tests.empty()) {
    const Test& first = *tests.front();
    if (const auto* modes = first.settings_as<ModalTest>()) take_conditions(*modes);
    if (const auto* load = first.settings_as<LoadDeflection>()) take_conditions(*load);
  }
  if (thoroughness == Thoroughness::minutes && page.pictures && page.pictures->loaded)
    settings.deflection = page.pictures->loaded->standing.deflection;
  const auto found = study_discretization(tire, settings);
  if (!found) return;
  for (const auto* rows : {&found->unloaded, &found->loaded}) {
    for (const DiscretizationRow& row : *rows) {
      if (!row.paired) continue;
      const std::string state = rows == &found->loaded ? ", on the ground" : "";
      page.discretization.push_back({row.name + state, row.error()});
    }
  }
}

}  // namespace latsch::experiment
