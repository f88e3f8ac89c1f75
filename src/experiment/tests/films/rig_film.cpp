// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/films/rig_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace latsch::experiment {
namespace {

using Eigen::Vector3d;

/// Returns a drawing of the linkages of a rig with a force and a moment on each wheel, which follow
/// the forces of the joints.
LinkageDrawing drawing_of(const RigState& state) {
  std::vector<DrawnWheel> wheels;
  for (const RigState::Wheel& wheel : state.wheels)
    wheels.push_back({wheel.name, wheel.upright, wheel.center, wheel.contact});
  LinkageDrawing drawing(state.mechanism, {}, wheels);
  for (std::size_t w = 0; w < wheels.size(); ++w) {
    drawing.add_circle(wheels[w]);
    const std::uint32_t at = drawing.add_point(state.loads[w].body, state.loads[w].point);
    const std::string name = wheels[w].name.empty() ? "" : ", " + wheels[w].name;
    drawing.add_load("load on the wheel" + name, "N", at);
    drawing.add_load("moment on the wheel" + name, "N m", at);
  }
  return drawing;
}

}  // namespace

RigWatcher RigFilm::watcher() {
  return [this](const RigState& state) { see(state); };
}

bool RigFilm::is_kept(Eigen::Index state) const {
  const auto last = static_cast<double>(told_.values.size()) - 1.0;
  if (last < most_) return true;
  // Select the states nearest to evenly spaced ones; first and last are always included.
  const double spacing = last / (most_ - 1);
  const double nearest = std::round(static_cast<double>(state) / spacing) * spacing;
  return std::lround(nearest) == state;
}

void RigFilm::see(const RigState& state) {
  if (!is_kept(state.state)) return;
  const LinkageDrawing drawing = drawing_of(state);
  if (sequence_.steps.empty()) {
    mesh_ = drawing.mesh();
    sequence_.arrows = drawing.arrows();
  }
  report::Scene::Step step = drawing.step(
      told_.values[static_cast<std::size_t>(state.state)],
      state.assembly,
      {.poses = state.rest.poses, .memories = &state.rest.memories, .drivers = state.rest.drivers});
  for (std::size_t w = 0; w < state.loads.size(); ++w) {
    const auto at = drawing.first_load() + static_cast<Eigen::Index>(2 * w);
    step.vectors.col(at) = state.loads[w].force;
    step.vectors.col(at + 1) = state.loads[w].moment;
  }
  sequence_.steps.push_back(std::move(step));
}

void RigFilm::add_to(report::Scene& scene, const std::string& name) {
  if (sequence_.steps.empty()) return;
  mesh_.name = "rig of " + name;
  sequence_.name = name;
  if (std::ssize(told_.values) > most_)
    sequence_.name += fmt::format(" ({} of them shown, evenly spaced)", sequence_.steps.size());
  sequence_.mesh = mesh_.name;
  sequence_.along = told_.name;
  sequence_.unit = told_.unit == "m" ? "mm" : told_.unit;
  if (told_.unit == "m")
    for (report::Scene::Step& step : sequence_.steps) step.at *= 1e3;
  sequence_.field_name = "axial force, tension positive";
  sequence_.field_unit = "N";
  scene.meshes.push_back(std::move(mesh_));
  scene.sequences.push_back(std::move(sequence_));
}

}  // namespace latsch::experiment
