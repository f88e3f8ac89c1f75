// SPDX-License-Identifier: Apache-2.0
// Records the states of a suspension corner or an axle on a K&C rig as a film: the bodies in their
// displaced positions, the forces in links and joints, and the forces on the wheels.
#pragma once

#include <optional>
#include <string>

#include "experiment/rigs/kc_rig.h"
#include "experiment/tests/films/linkage_drawing.h"
#include "measurement/channels.h"

namespace latsch::experiment {

class RigFilm {
 public:
  /// `told` is the channel whose values label the states, one value for each state; at most
  /// `most_steps` of the states are kept.
  RigFilm(Channel told, int most_steps) : told_(std::move(told)), most_(most_steps) {}

  /// Returns a function that adds states to this object. This object must outlive the function.
  RigWatcher watcher();
  /// Adds a mesh and a sequence with the given name to the scene. If states were omitted, a remark
  /// says so.
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
