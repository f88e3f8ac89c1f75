// SPDX-License-Identifier: Apache-2.0
// What a K&C rig does to a corner or an axle, state by state: its bodies where the loads have moved
// them, the forces in its links and joints, and those on the wheels.
#pragma once

#include <optional>
#include <string>

#include "experiment/rigs/kc_rig.h"
#include "experiment/tests/films/linkage_drawing.h"
#include "measurement/channels.h"

namespace latsch::experiment {

class RigFilm {
 public:
  /// `told`: what its states are told by, a value a state; no more than so many of them are kept.
  RigFilm(Channel told, int most_steps) : told_(std::move(told)), most_(most_steps) {}

  /// Has to be outlived by this.
  RigWatcher watcher();
  /// A mesh and a sequence of that name, which says where some of its states are left out.
  void add_to(report::Scene& scene, const std::string& name);

 private:
  void see(const RigState& state);
  bool is_kept(Eigen::Index state) const;

  Channel told_;
  int most_;
  report::Scene::Mesh mesh_;
  report::Scene::Sequence sequence_;
};

}  // namespace latsch::experiment
