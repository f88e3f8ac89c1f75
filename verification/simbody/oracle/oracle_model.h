// SPDX-License-Identifier: Apache-2.0
// A case as a Simbody system: every body is free relative to the ground (MobilizedBody::Free),
// bushings are the library's own Force::LinearBushing, loads are ConstantForce and ConstantTorque,
// and the tires are our own force elements. No joint is a constraint.
//
// Force::LinearBushing has the same law as our bushings: body-fixed 1-2-3 angles, generalized
// forces -(k q + c q'), and a force along the axes of the first body that acts on the second body
// at that body's point and, reversed, on the first body at the same position. `simbody_oracle
// bushing` prints its wrenches, which the tests compare with formulas.
#pragma once

#include <Simbody.h>

#include <memory>
#include <string>
#include <vector>

#include "oracle_case.h"

namespace oracle {

class Model {
 public:
  enum class Held { as_in_statics, free };

  /// Applies the loads of this load case in addition to those that all cases have.
  Model(const Case& data, const LoadCase& load_case, Held held);

  const SimTK::MultibodySystem& system() const { return system_; }
  SimTK::State at_rest() const;

  int bodies() const { return static_cast<int>(mobilized_.size()); }
  const SimTK::MobilizedBody& body(int i) const { return mobilized_[static_cast<std::size_t>(i)]; }
  /// Returns the sum of the forces of all elements on a body: moment about the body's origin and
  /// force, in the ground's axes.
  SimTK::SpatialVec wrench(const SimTK::State& state, int body) const;
  double energy_of_bushings(const SimTK::State& state) const;  // J
  /// Returns the displacement of output point i from its position at rest.
  SimTK::Vec3 displacement(const SimTK::State& state, int output) const;
  const Case& data() const { return data_; }

 private:
  const SimTK::MobilizedBody& named(const std::string& name) const;
  SimTK::Vec3 in_body(const std::string& body, const SimTK::Vec3& point) const;
  SimTK::Force::LinearBushing add_bushing(const BushingData& data);
  void add_load(const LoadData& load);

  const Case& data_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  std::vector<SimTK::MobilizedBody> mobilized_;
  std::vector<SimTK::Force::LinearBushing> bushings_;
};

}  // namespace oracle
