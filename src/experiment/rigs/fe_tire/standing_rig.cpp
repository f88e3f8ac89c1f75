// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/standing_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiment/rigs/fe_tire/channel_slopes.h"
#include "experiment/rigs/fe_tire/deflection_for_load.h"
#include "models/fe_tire/slopes/tire_slopes.h"

namespace latsch::experiment {
namespace {

using fe_tire::FeTire;
using fe_tire::GroundPose;
using fe_tire::TireState;

constexpr double kUsualTireStiffness = 2.0e5;  // N/m, for a first guess of the deflection
// number of steps in which the ground is displaced: several, because the contact patch slides
// meanwhile
constexpr int kSteps = 4;

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
  double way;  // displacement between two states, m or rad
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

bool moves_sideways(const StandingTest& test) {
  return std::ranges::any_of(test.directions,
                             [](Direction direction) { return direction != Direction::vertical; });
}

/// Throws InputError for a direction that needs friction.
void require_friction(const StandingTest& test, const fe_tire::Ground& ground) {
  if (moves_sideways(test) && ground.mu == 0.0)
    throw InputError(
        "a finite-element tire has the friction of its test, and without it slides away: expected "
        "friction = 0.8 or so beside longitudinal, lateral or torsional");
}

/// Throws InputError for a cleat as high as the section, which the rim would hit.
void refuse_high_cleat(const FeTire& tire, const StandingTest& test) {
  if (!test.cleat) return;
  const fe_tire::Mesh& mesh = tire.mesh();
  double rim = mesh.outer_radius();
  for (const int node : mesh.clamped)
    rim = std::min(rim, std::hypot(mesh.X(0, node), mesh.X(2, node)));
  const double section = mesh.outer_radius() - rim;
  if (test.cleat->height < section) return;
  throw InputError(
      fmt::format("cleat.height is {:.4g} mm, but the section of this tire is {:.4g} mm high: the "
                  "rim would hit the cleat; expected a lower one",
                  1e3 * test.cleat->height,
                  1e3 * section));
}

/// The tire on the ground and what has been recorded of it so far.
struct StandingRun {
  FeTire& tire;
  const StandingTest& test;
  const fe_tire::Inflated& inflated;
  fe_tire::Ground ground;
  fe_tire::TireSlopes* slopes;  // null: none are requested
  std::vector<double> forces = {}, stiffnesses = {};
  ChannelSlopes of_channels = {};
};

/// Presses the tire to a deflection, in steps.
Result<TireState> pressed(StandingRun& run, double deflection) {
  const double cleat = run.test.cleat ? run.test.cleat->height : 0.0;
  std::vector<GroundPose> poses;
  for (int k = 1; k <= kSteps; ++k) {
    poses.push_back(FeTire::below(run.inflated, deflection * k / kSteps));
    if (run.test.cleat) poses.back().height += cleat;
  }
  TireState start = run.tire.over(run.inflated, run.ground);
  if (run.test.cleat) start.pose.height += cleat;
  auto states = run.tire.advance(start, poses);
  if (!states) return states.failure();
  return std::move(states->back());
}

/// Returns the derivatives of the force at a constant deflection.
Result<Eigen::VectorXd> slopes_of_force(const StandingRun& run, const TireState& state) {
  const auto of_inflated = run.slopes->of_inflated(run.inflated);
  const auto of_state = run.slopes->of_state(state);
  if (!of_inflated) return of_inflated.failure();
  if (!of_state) return of_state.failure();
  return Eigen::VectorXd(of_state->force + of_state->by_height * of_inflated->radius);
}

/// Records the forces of all deflections.
Status press_all(StandingRun& run) {
  const int variables = run.slopes ? run.slopes->variables() : 0;
  Eigen::MatrixXd of_force(std::ssize(run.test.deflections), variables);
  for (const double deflection : run.test.deflections) {
    const auto state = pressed(run, deflection);
    if (!state) return state.failure();
    if (run.slopes) {
      const auto slopes = slopes_of_force(run, *state);
      if (!slopes) return slopes.failure();
      of_force.row(std::ssize(run.forces)) = *slopes;
    }
    run.forces.push_back(run.tire.stand(*state).force.z());
  }
  if (run.slopes && !run.test.deflections.empty()) {
    run.of_channels.emplace_back("force", of_force);
    run.of_channels.emplace_back("deflection", Eigen::MatrixXd::Zero(of_force.rows(), variables));
  }
  return {};
}

/// Records the stiffnesses in all directions under the load.
Status move_all(StandingRun& run) {
  const StandingTest& test = run.test;
  if (test.directions.empty()) return {};
  StandingPose pose{.camber = test.camber};
  if (moves_sideways(test) || test.camber != 0.0) pose.poses = FeTire::Poses::any;
  const auto loaded = load_to_force(
      run.tire, run.inflated, test.load, test.load / kUsualTireStiffness, run.ground, pose);
  if (!loaded) return loaded.failure();
  for (const Direction direction : test.directions) {
    const double travel = direction == Direction::torsional ? test.twist : test.travel;
    const auto ends = moved_to_ends(run.tire, *loaded, direction, travel);
    if (!ends) return ends.failure();
    run.stiffnesses.push_back(stiffness(run.tire, *ends, direction));
    if (!run.slopes) continue;
    const auto of = slopes_of_stiffness(*run.slopes, *loaded, *ends);
    if (!of) return of.failure();
    run.of_channels.emplace_back(name_of(direction), *of);
  }
  return {};
}

}  // namespace

Result<Channels> stand(FeTire& tire,
                       double own_pressure,
                       const StandingTest& test,
                       fe_tire::TireSlopes* slopes) {
  const fe_tire::Ground ground = ground_of(test);
  require_friction(test, ground);
  refuse_high_cleat(tire, test);
  const auto inflated = tire.inflate(test.pressure.value_or(own_pressure));
  if (!inflated) return inflated.failure();
  StandingRun run{tire, test, *inflated, ground, slopes};
  if (const Status done = press_all(run); !done) return done.failure();
  if (const Status done = move_all(run); !done) return done.failure();
  return with_slopes(standing_channels(test, run.forces, run.stiffnesses), run.of_channels);
}

}  // namespace latsch::experiment
