// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/standing_rig.h"

#include <cmath>

#include "experiment/rigs/fe_tire/channel_slopes.h"
#include "experiment/rigs/fe_tire/deflection_for_load.h"
#include "models/fe_tire/slopes/tire_slopes.h"

namespace latsch::experiment {
namespace {

using fe_tire::FeTire;
using fe_tire::GroundPose;
using fe_tire::TireState;

constexpr double kTypicalStiffness = 2.0e5;  // N/m, for a first guess of the deflection
constexpr int kSteps = 4;                    // steps of the ground's displacement, because the
                                             // patch slides during it

/// The wheel's travel in a direction is applied as the opposite displacement of the ground.
GroundPose moved(GroundPose pose, Direction direction, double travel) {
  switch (direction) {
    case Direction::vertical:
      pose.height -= travel;
      break;
    case Direction::longitudinal:
      pose.x -= travel;
      break;
    case Direction::lateral:
      pose.y -= travel;
      break;
    case Direction::torsional:
      pose.yaw -= travel;
      break;
  }
  return pose;
}

double reaction(const fe_tire::Standing& standing, Direction direction) {
  switch (direction) {
    case Direction::vertical:
      return -standing.force.z();
    case Direction::longitudinal:
      return standing.force.x();
    case Direction::lateral:
      return standing.force.y();
    case Direction::torsional:
      break;
  }
  return standing.moment.z();
}

/// The states between which a stiffness is computed.
struct Ends {
  TireState first, last;
  double way;  // m or rad, between the states
};

Result<Ends> moved_to_ends(FeTire& tire,
                           const TireState& start,
                           Direction direction,
                           double travel) {
  // Without friction, lifting and pressing follow the same path; with friction only pressing
  // continues from the load.
  const bool both_ways = direction == Direction::vertical && start.ground.mu == 0.0;
  const double from = both_ways ? -travel : 0.0;
  std::vector<GroundPose> poses;
  for (int k = both_ways ? 0 : 1; k <= kSteps; ++k) {
    poses.push_back(moved(start.pose, direction, from + (travel - from) * k / kSteps));
  }
  const auto states = tire.advance(start, poses);
  if (!states) return states.failure();
  return Ends{both_ways ? states->front() : start, states->back(), travel - from};
}

double stiffness(FeTire& tire, const Ends& ends, Direction direction) {
  const double before = reaction(tire.stand(ends.first), direction);
  return (before - reaction(tire.stand(ends.last), direction)) / ends.way;
}

/// Slopes of the vertical stiffness under a constant load: the wheel moves at both ends as it does
/// under the load.
Result<Eigen::RowVectorXd> slopes_of_stiffness(fe_tire::TireSlopes& slopes,
                                               const TireState& loaded,
                                               const Ends& ends) {
  const auto under_load = slopes.of_state(loaded);
  const auto first = slopes.of_state(ends.first), last = slopes.of_state(ends.last);
  for (const auto* of : {&under_load, &first, &last})
    if (!*of) return of->failure();
  const Eigen::VectorXd height = fe_tire::TireSlopes::height_under_load(*under_load);
  const auto force = [&](const fe_tire::TireSlopes::OfState& of) {
    return Eigen::VectorXd(of.force + of.by_height * height);
  };
  return Eigen::RowVectorXd(((force(*last) - force(*first)) / ends.way).transpose());
}

fe_tire::Ground ground_of(const StandingTest& test) {
  fe_tire::Ground ground;
  ground.mu = test.friction.value_or(0.0);
  if (test.cleat) {
    ground.bar = fe_tire::Bar{.height = test.cleat->height,
                              .length = test.cleat->length,
                              .bevel = test.cleat->bevel,
                              .angle = test.cleat->angle};
  }
  return ground;
}

}  // namespace

Result<Channels> stand(FeTire& tire,
                       double own_pressure,
                       const StandingTest& test,
                       fe_tire::TireSlopes* slopes) {
  const fe_tire::Ground ground = ground_of(test);
  bool sideways = false;
  for (const Direction direction : test.directions)
    sideways = sideways || direction != Direction::vertical;
  if (sideways && ground.mu == 0.0)
    throw InputError(
        "a finite-element tire has the friction of its test, and without it slides away: expected "
        "friction = 0.8 or so beside longitudinal, lateral or torsional");
  const auto inflated = tire.inflate(test.pressure.value_or(own_pressure));
  if (!inflated) return inflated.failure();

  std::vector<double> forces, stiffnesses;
  const int variables = slopes ? slopes->variables() : 0;
  Eigen::MatrixXd of_force(std::ssize(test.deflections), variables);
  ChannelSlopes all;
  for (const double deflection : test.deflections) {
    std::vector<GroundPose> poses;
    for (int k = 1; k <= kSteps; ++k) {
      poses.push_back(FeTire::below(*inflated, deflection * k / kSteps));
      if (test.cleat) poses.back().height += test.cleat->height;
    }
    TireState start = tire.over(*inflated, ground);
    if (test.cleat) start.pose.height += test.cleat->height;
    const auto states = tire.advance(start, poses);
    if (!states) return states.failure();
    if (slopes) {
      const auto of_inflated = slopes->of_inflated(*inflated);
      const auto of_state = slopes->of_state(states->back());
      if (!of_inflated) return of_inflated.failure();
      if (!of_state) return of_state.failure();
      of_force.row(std::ssize(forces)) =
          of_state->force + of_state->by_height * of_inflated->radius;
    }
    forces.push_back(tire.stand(states->back()).force.z());
  }
  if (slopes && !test.deflections.empty()) {
    all.emplace_back("force", of_force);
    all.emplace_back("deflection", Eigen::MatrixXd::Zero(of_force.rows(), variables));
  }
  if (test.directions.empty())
    return with_slopes(standing_channels(test, forces, stiffnesses), all);

  StandingPose pose{.camber = test.camber};
  if (sideways || test.camber != 0.0) pose.poses = FeTire::Poses::any;
  const auto loaded =
      load_to_force(tire, *inflated, test.load, test.load / kTypicalStiffness, ground, pose);
  if (!loaded) return loaded.failure();
  for (const Direction direction : test.directions) {
    const double travel = direction == Direction::torsional ? test.twist : test.travel;
    const auto ends = moved_to_ends(tire, *loaded, direction, travel);
    if (!ends) return ends.failure();
    stiffnesses.push_back(stiffness(tire, *ends, direction));
    if (!slopes) continue;
    const auto of = slopes_of_stiffness(*slopes, *loaded, *ends);
    if (!of) return of.failure();
    all.emplace_back(name_of(direction), *of);
  }
  return with_slopes(standing_channels(test, forces, stiffnesses), all);
}

}  // namespace latsch::experiment
