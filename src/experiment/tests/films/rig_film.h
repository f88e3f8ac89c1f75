// SPDX-License-Identifier: Apache-2.0
// A corner or an axle on a K&C rig, state by state: its bodies in their displaced positions, the
// forces in its links and joints, and those on the wheels.
#pragma once

#include <optional>
#include <string>

#include "experiment/rigs/kc_rig.h"
#include "experiment/tests/films/linkage_drawing.h"
#include "measurement/channels.h"

namespace latsch::experiment {

class RigFilm {
 public:
  /// The channel `told` identifies the states, with one value for each; at most `most_steps` of
  /// them are kept.
  RigFilm(Channel told, int most_steps) : told_(std::move(told)), most_(most_steps) {}

  /// This object has to outlive the watcher.
  RigWatcher watcher();
  /// Adds a mesh and a sequence of the given name; a remark says if states are left out.
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
