// SPDX-License-Identifier: Apache-2.0
#include "oracle_bushing.h"

#include <Simbody.h>

#include <array>
#include <cstdio>
#include <random>
#include <vector>

namespace oracle {
namespace {

using namespace SimTK;

constexpr int kRows = 12;  // number of rows; the bushings of the first half have no damping
constexpr unsigned kSeed = 20;

// Bounds of the magnitudes of random values: position, m, displacement, m, rotation, rad, velocity,
// m/s, and angular velocity, rad/s. They exceed those of any real bushing by far.
constexpr double kPoint = 0.5, kTravel = 0.02, kTurn = 0.4, kVelocity = 2.0, kSpin = 20.0;

const std::array<const char*, 17> kVectors = {"point",
                                              "a_travel",
                                              "a_rotation",
                                              "a_velocity",
                                              "a_spin",
                                              "b_travel",
                                              "b_rotation",
                                              "b_velocity",
                                              "b_spin",
                                              "stiffness",
                                              "rotational_stiffness",
                                              "damping",
                                              "rotational_damping",
                                              "force_on_a",
                                              "moment_on_a",
                                              "force_on_b",
                                              "moment_on_b"};

class Draws {
 public:
  /// Returns a random number between -reach and reach, from integers that are identical in every
  /// standard library.
  double number(double reach) {
    return reach * (2.0 * static_cast<double>(generator_()) / 4294967295.0 - 1.0);
  }
  Vec3 vector(double reach) {
    const double x = number(reach), y = number(reach), z = number(reach);
    return {x, y, z};
  }
  Vec3 between(double low, double high) {
    return Vec3(0.5 * (low + high)) + vector(0.5 * (high - low));
  }

 private:
  std::mt19937 generator_{kSeed};
};

struct Motion {
  Vec3 travel, rotation, velocity, spin;
};

Motion draw(Draws& draws) {
  const Vec3 travel = draws.vector(kTravel), rotation = draws.vector(kTurn);
  const Vec3 velocity = draws.vector(kVelocity);
  return {travel, rotation, velocity, draws.vector(kSpin)};
}

void set(const MobilizedBody& body, State& state, const MultibodySystem& system, const Motion& is) {
  const Rotation turn(is.rotation.norm(), UnitVec3(is.rotation));
  body.setQToFitTransform(state, Transform(turn, is.travel));
  system.realize(state, Stage::Position);
  body.setUToFitVelocity(state, SpatialVec(is.spin, is.velocity));
}

void print(const std::vector<Vec3>& row) {
  for (std::size_t i = 0; i < row.size(); ++i)
    std::printf("%s%.17g,%.17g,%.17g", i == 0 ? "" : ",", row[i][0], row[i][1], row[i][2]);
  std::printf("\n");
}

void print_row(Draws& draws, bool damped) {
  const Vec3 point = draws.vector(kPoint);
  const Motion a = draw(draws), b = draw(draws);
  const Vec3 k = draws.between(1e5, 3e7), kr = draws.between(50.0, 500.0);
  const Vec3 c = damped ? draws.between(1e2, 5e3) : Vec3(0);
  const Vec3 cr = damped ? draws.between(0.1, 2.0) : Vec3(0);

  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  const Body::Rigid rigid(MassProperties(1.0, Vec3(0), Inertia(1.0)));
  const MobilizedBody::Free on_a(matter.Ground(), rigid), on_b(matter.Ground(), rigid);
  Force::LinearBushing(forces,
                       on_a,
                       Transform(point),
                       on_b,
                       Transform(point),
                       Vec6(kr[0], kr[1], kr[2], k[0], k[1], k[2]),
                       Vec6(cr[0], cr[1], cr[2], c[0], c[1], c[2]));
  State state = system.realizeTopology();
  system.realizeModel(state);
  system.realize(state, Stage::Position);
  set(on_a, state, system, a);
  set(on_b, state, system, b);
  system.realize(state, Stage::Dynamics);
  const Vector_<SpatialVec>& wrench = system.getRigidBodyForces(state, Stage::Dynamics);
  const SpatialVec& w_a = wrench[on_a.getMobilizedBodyIndex()];
  const SpatialVec& w_b = wrench[on_b.getMobilizedBodyIndex()];
  print({point,
         a.travel,
         a.rotation,
         a.velocity,
         a.spin,
         b.travel,
         b.rotation,
         b.velocity,
         b.spin,
         k,
         kr,
         c,
         cr,
         w_a[1],
         w_a[0],
         w_b[1],
         w_b[0]});
}

}  // namespace

void print_bushing_wrenches() {
  for (const char* name : kVectors)
    for (const char axis : {'x', 'y', 'z'})
      std::printf("%s%s_%c", name == kVectors[0] && axis == 'x' ? "" : ",", name, axis);
  std::printf("\n");
  Draws draws;
  for (int row = 0; row < kRows; ++row) print_row(draws, row >= kRows / 2);
}

}  // namespace oracle
