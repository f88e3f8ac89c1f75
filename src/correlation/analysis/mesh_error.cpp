// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/mesh_error.h"

#include "correlation/study/variables.h"
#include "experiment/rigs/discretization.h"

namespace latsch::correlation {
namespace {

/// Pressure and ground of the first experiment.
void take_conditions(const StudyExperiment& experiment, DiscretizationSettings& settings) {
  std::visit(
      [&](const auto& test) {
        settings.pressure = test.pressure;
        settings.ground = test.ground;
      },
      experiment.load_case.test);
}

}  // namespace

void add_mesh_error(const Study& study,
                    const DesignPoint& point,
                    MeshError extent,
                    report::StudyReport& page) {
  const auto tire = fe_tire::read_tire(at(study.model, study.space, point).root());
  DiscretizationSettings settings;
  settings.element = tire.element;
  settings.refinements = {1, 2, 3};
  take_conditions(study.experiments.front(), settings);
  if (extent == MeshError::also_on_the_ground && page.pictures && page.pictures->loaded) {
    settings.deflection = page.pictures->loaded->curve.back().deflection;
  }
  const auto found = study_discretization(tire, settings);
  if (!found) return;
  for (const auto* rows : {&found->unloaded, &found->loaded}) {
    for (const DiscretizationRow& row : *rows) {
      const std::string state = rows == &found->loaded ? ", on the ground" : "";
      page.discretization.push_back({row.name + state, row.error()});
    }
  }
}

}  // namespace latsch::correlation
