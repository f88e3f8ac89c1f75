// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/twin.h"

#include <algorithm>

#include "experiment/rigs/tire_rig.h"
#include "formats/tables/measurement_file.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::correlation {
namespace {

using experiment::LoadDeflection;
using experiment::ModalTest;

fe_tire::FeTire tire_of(const Study& study) {
  const auto description = fe_tire::read_tire(study.model.root());
  fe_tire::SolverSettings settings;
  settings.element = description.element;
  return {fe_tire::build_mesh(description), fe_tire::build_materials(description), settings};
}

constexpr const char* kComment =
    "Not measured: computed by the model itself, latsch export --measurements";

void write_forces(const StudyExperiment& experiment, const Channels& channels) {
  const auto& test = std::get<LoadDeflection>(experiment.load_case.test);
  const bool radii = !test.loaded_radii.empty();
  LoadDeflectionCurve curve;
  curve.abscissa = radii ? Abscissa::loaded_radius : Abscissa::deflection;
  curve.position = radii ? test.loaded_radii : test.deflections;
  curve.force = channels["force"];
  formats::write_load_deflection(experiment.measurement_file, curve, kComment);
}

}  // namespace

Result<std::vector<std::filesystem::path>> write_twin(const Study& study) {
  fe_tire::FeTire tire = tire_of(study);
  std::vector<experiment::LoadCase> cases;
  for (const StudyExperiment& experiment : study.experiments) {
    cases.push_back(experiment.load_case);
    auto* modal = std::get_if<ModalTest>(&cases.back().test);
    if (modal && !experiment.shapes_file.empty() && modal->points.cols() == 0) {
      modal->points = experiment::default_points(tire.mesh());
    }
  }
  const auto results = experiment::run(tire, cases);

  std::vector<std::filesystem::path> written;
  for (size_t e = 0; e < results.size(); ++e) {
    if (!results[e]) return results[e].failure();
    const StudyExperiment& experiment = study.experiments[e];
    written.push_back(experiment.measurement_file);
    if (!experiment.modal()) {
      write_forces(experiment, *results[e]);
      continue;
    }
    auto modes = experiment::mode_records(*results[e]);
    modes.resize(std::min(modes.size(), static_cast<size_t>(experiment.measured_modes)));
    const ModeTable table =
        experiment::mode_table(modes, std::get<ModalTest>(cases[e].test).points);
    formats::write_modes(experiment.measurement_file, table, kComment);
    if (experiment.shapes_file.empty()) continue;
    formats::write_shapes(experiment.shapes_file, table, kComment);
    written.push_back(experiment.shapes_file);
  }
  return written;
}

}  // namespace latsch::correlation
