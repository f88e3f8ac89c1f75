// SPDX-License-Identifier: Apache-2.0
#include "oracle_model.h"

#include <stdexcept>

#include "linear_tire.h"

namespace oracle {

using namespace SimTK;

Model::Model(const Case& data, const LoadCase& load_case, Held held)
    : data_(data), matter_(system_), forces_(system_) {
  for (const BodyData& body : data.bodies) {
    const Body::Rigid rigid(
        MassProperties(body.mass, Vec3(0), Inertia(body.moments, body.products)));
    mobilized_.push_back(
        MobilizedBody::Free(matter_.Ground(), Transform(body.center), rigid, Transform()));
  }
  if (data.gravity.norm() > 0.0) Force::UniformGravity(forces_, matter_, data.gravity);
  for (const BushingData& one : data.bushings) bushings_.push_back(add_bushing(one));
  if (held == Held::as_in_statics && !data.held_in_statics.b.empty())
    add_bushing(data.held_in_statics);
  for (const LoadData& load : data.loads) add_load(load);
  for (const LoadData& load : load_case.loads) add_load(load);
  for (const TireData& tire : data.tires)
    Force::Custom(
        forces_,
        new LinearTire(
            named(tire.body), in_body(tire.body, tire.wheel_center), tire, data.road, data.speed));
  system_.realizeTopology();
}

const MobilizedBody& Model::named(const std::string& name) const {
  if (name == "ground") return matter_.getGround();
  for (std::size_t i = 0; i < data_.bodies.size(); ++i)
    if (data_.bodies[i].name == name) return mobilized_[i];
  throw std::runtime_error("there is no body " + name);
}

Vec3 Model::in_body(const std::string& name, const Vec3& point) const {
  for (const BodyData& body : data_.bodies)
    if (body.name == name) return point - body.center;
  return point;
}

Force::LinearBushing Model::add_bushing(const BushingData& one) {
  // In Simbody's 6-vectors the rotational components come first.
  const auto six = [](const Vec3& rotational, const Vec3& along) {
    return Vec6(rotational[0], rotational[1], rotational[2], along[0], along[1], along[2]);
  };
  return Force::LinearBushing(forces_,
                              named(one.a),
                              Transform(in_body(one.a, one.point)),
                              named(one.b),
                              Transform(in_body(one.b, one.point)),
                              six(one.rotational_stiffness, one.stiffness),
                              six(one.rotational_damping, one.damping));
}

void Model::add_load(const LoadData& load) {
  const MobilizedBody& body = named(load.body);
  Force::ConstantForce(forces_, body, in_body(load.body, load.point), load.force);
  Force::ConstantTorque(forces_, body, load.moment);
}

State Model::at_rest() const {
  State state = system_.getDefaultState();
  system_.realizeModel(state);
  return state;
}

SpatialVec Model::wrench(const State& state, int i) const {
  return system_.getRigidBodyForces(state, Stage::Dynamics)[body(i).getMobilizedBodyIndex()];
}

double Model::energy_of_bushings(const State& state) const {
  double energy = 0.0;
  for (const Force::LinearBushing& one : bushings_) energy += one.getPotentialEnergy(state);
  return energy;
}

Vec3 Model::displacement(const State& state, int output) const {
  const OutputPoint& one = data_.outputs[static_cast<std::size_t>(output)];
  const MobilizedBody& body = named(one.body);
  return body.findStationLocationInGround(state, in_body(one.body, one.point)) - one.point;
}

}  // namespace oracle
