// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/found_tire.h"

#include <algorithm>

#include "correlation/study/variables.h"
#include "experiment/rigs/deflection_for_load.h"
#include "models/fe_tire/description/section_plan.h"

namespace latsch::correlation {
namespace {

using experiment::LoadDeflection;
using experiment::ModalTest;

constexpr int kShownModes = 12;
constexpr int kSteps = 5;
constexpr double kTypicalStiffness =
    2.0e5;  // N/m, to begin the search for a deflection under a load

/// The deepest deflection of a load-deflection test.
double depth(const LoadDeflection& test, double inflated_radius) {
  double deepest = 0.0;
  for (double deflection : test.deflections) deepest = std::max(deepest, deflection);
  for (double radius : test.loaded_radii) deepest = std::max(deepest, inflated_radius - radius);
  return deepest;
}

std::optional<fe_tire::Loaded> press(fe_tire::FeTire& tire,
                                     const fe_tire::Inflated& inflated,
                                     double deflection,
                                     const fe_tire::Ground& ground) {
  if (deflection <= 0.0) return std::nullopt;
  std::vector<double> steps;
  for (int i = 1; i <= kSteps; ++i) steps.push_back(deflection * i / kSteps);
  auto loaded = tire.load(inflated, steps, ground);
  if (!loaded) return std::nullopt;
  return std::move(*loaded);
}

std::optional<fe_tire::Loaded> stand(fe_tire::FeTire& tire,
                                     const fe_tire::Inflated& inflated,
                                     const ModalTest& test) {
  if (test.deflection) return press(tire, inflated, *test.deflection, test.ground);
  auto loaded = experiment::load_to_force(
      tire, inflated, *test.load, *test.load / kTypicalStiffness, test.ground);
  if (!loaded) return std::nullopt;
  return std::move(*loaded);
}

void add_modes(fe_tire::FeTire& tire, const ModalTest& test, report::TirePictures& pictures) {
  const auto inflated = tire.inflate(test.pressure);
  if (!inflated) return;
  pictures.inflated = *inflated;
  if (test.loaded()) {
    pictures.loaded = stand(tire, *inflated, test);
    if (!pictures.loaded) return;
  }
  auto modes = test.loaded() ? tire.modes(*pictures.loaded, kShownModes)
                             : tire.modes(*inflated, kShownModes);
  if (!modes) return;
  pictures.modes = std::move(*modes);
  pictures.modes_loaded = test.loaded();
}

void add_load(fe_tire::FeTire& tire, const LoadDeflection& test, report::TirePictures& pictures) {
  if (pictures.loaded) return;
  auto inflated = tire.inflate(test.pressure);
  if (!inflated) return;
  pictures.loaded = press(tire, *inflated, depth(test, inflated->radius), test.ground);
  if (pictures.loaded) pictures.inflated = std::move(*inflated);
}

/// The ply of every cord layer of the mesh, with its angle at the crown.
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

void add_found_tire(const Study& study,
                    const DesignPoint& point,
                    TireTrials& trials,
                    report::StudyReport& page) {
  const auto description = fe_tire::read_tire(at(study.model, study.space, point).root());
  page.tire = description.name + ", " + description.size;
  fe_tire::FeTire& tire = trials.tire_at(point);
  report::TirePictures pictures;
  pictures.mesh = tire.mesh();
  pictures.layers = cord_layers(description);
  for (const StudyExperiment& experiment : study.experiments) {
    const auto* modal = std::get_if<ModalTest>(&experiment.load_case.test);
    if (modal && pictures.modes.empty()) add_modes(tire, *modal, pictures);
  }
  for (const StudyExperiment& experiment : study.experiments) {
    const auto* curve = std::get_if<LoadDeflection>(&experiment.load_case.test);
    if (curve && experiment.fitted) add_load(tire, *curve, pictures);
  }
  page.pictures = std::move(pictures);
}

}  // namespace latsch::correlation
