// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/tire_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "experiment/rigs/fe_tire/channel_slopes.h"
#include "experiment/rigs/fe_tire/deflection_for_load.h"
#include "experiment/rigs/mode_record.h"
#include "models/fe_tire/motion/damped_tire.h"

namespace latsch::experiment {
namespace {

using fe_tire::FeTire;
using fe_tire::Inflated;
using fe_tire::Standing;
using fe_tire::TireState;

// stiffness, N/m, for the first guess of the deflection under a load
constexpr double kTypicalStiffness = 2.0e5;
constexpr int kEvenSteps = 5;

/// Returns equal steps of the deflection for a path that the test does not prescribe.
std::vector<double> even_steps(double deflection) {
  std::vector<double> steps;
  for (int i = 1; i < kEvenSteps; ++i) steps.push_back(deflection * i / kEvenSteps);
  steps.push_back(deflection);
  return steps;
}

/// Returns the path to the deepest of the deflections through all that touch the ground.
std::vector<double> way_through(std::vector<double> deflections) {
  std::erase_if(deflections, [](double deflection) { return deflection <= 0.0; });
  std::sort(deflections.begin(), deflections.end());
  deflections.erase(std::unique(deflections.begin(), deflections.end()), deflections.end());
  return deflections.size() == 1 ? even_steps(deflections.front()) : deflections;
}

}  // namespace

const Result<Inflated>& TireRig::inflated(double pressure) {
  if (!inflated_ || pressure_ != pressure) {
    pressed_.reset();
    pressure_ = pressure;
    inflated_.emplace(tire_.inflate(pressure));
  }
  return *inflated_;
}

const Result<std::vector<TireState>>& TireRig::pressed(const std::vector<double>& way,
                                                       const fe_tire::Ground& ground) {
  const bool is_same = pressed_ && pressed_->way == way && pressed_->ground == ground;
  if (!is_same) pressed_.emplace(Pressed{way, ground, tire_.press(**inflated_, ground, way)});
  return pressed_->states;
}

Result<Channels> TireRig::run(const LoadDeflection& test) {
  const auto& inflated = this->inflated(test.pressure.value_or(own_pressure_));
  if (!inflated) return inflated.failure();
  std::vector<double> deflections = test.deflections;
  for (const double radius : test.loaded_radii) deflections.push_back(inflated->radius - radius);
  const std::vector<double> way = way_through(deflections);
  const auto* states = way.empty() ? nullptr : &pressed(way, test.ground);
  if (states && !*states) return states->failure();

  const auto standing_at = [&](double deflection) {
    Standing none;
    none.deflection = deflection;
    none.loaded_radius = inflated->radius - deflection;
    if (deflection <= 0.0) return none;
    const auto at = std::find(way.begin(), way.end(), deflection);
    assert(at != way.end());
    return tire_.stand((**states)[at - way.begin()]);
  };
  Channels channels;
  const char* names[] = {
      "deflection", "loaded_radius", "force", "patch_length", "patch_width", "patch_area"};
  const char* units[] = {"m", "m", "N", "m", "m", "m^2"};
  std::array<std::vector<double>, 6> columns;
  for (const double deflection : deflections) {
    const Standing standing = standing_at(deflection);
    const double row[] = {deflection,
                          standing.loaded_radius,
                          standing.force.z(),
                          standing.patch.length,
                          standing.patch.width,
                          standing.patch.area};
    for (size_t c = 0; c < columns.size(); ++c) columns[c].push_back(row[c]);
  }
  for (size_t c = 0; c < columns.size(); ++c) channels.add({names[c], units[c], columns[c]});
  return channels;
}

Result<Channels> TireRig::run(const ModalTest& test) {
  if (test.moves()) return run_spinning(test);
  const auto found = vibrate(test);
  if (!found) return found.failure();
  return channels_of(test, *found);
}

Result<TireRig::Vibrating> TireRig::vibrate(const ModalTest& test) {
  if (const Status near = points_on_tire(tire_.mesh(), test.points); !near) return near.failure();
  const auto& inflated = this->inflated(test.pressure.value_or(own_pressure_));
  if (!inflated) return inflated.failure();
  Vibrating found;
  if (test.loaded()) {
    auto state = stand(test, *inflated);
    if (!state) return state.failure();
    found.state = std::move(*state);
  }
  if (const Status done = add_modes(found, *inflated, test); !done) return done.failure();
  return found;
}

Failure damping_of_elastic() {
  return Failure{
      "modes: damping = true, but the tire's file states no prony or loss_factor of a rubber or a "
      "layer: state one, or leave damping out"};
}

Status TireRig::add_modes(Vibrating& found, const Inflated& inflated, const ModalTest& test) {
  const int count = test.count;
  if (!test.is_damped) {
    auto modes = found.state ? tire_.modes(*found.state, count) : tire_.modes(inflated, count);
    if (!modes) return modes.failure();
    found.modes = std::move(*modes);
    return {};
  }
  if (losses_.is_elastic()) return damping_of_elastic();
  fe_tire::DampedTire damped(tire_, losses_);
  auto modes = found.state ? damped.modes(*found.state, count) : damped.modes(inflated, count);
  if (!modes) return modes.failure();
  for (fe_tire::DecayingMode& mode : *modes) {
    found.modes.push_back(std::move(mode.mode));
    found.damping.push_back(mode.damping);
  }
  return {};
}

Result<TireState> TireRig::stand(const ModalTest& test, const Inflated& inflated) {
  StandingPose pose{.camber = test.camber};
  if (test.camber != 0.0) pose.poses = FeTire::Poses::any;
  if (test.load)
    return load_to_force(
        tire_, inflated, *test.load, *test.load / kTypicalStiffness, test.ground, pose);
  const std::vector<double> way = even_steps(*test.deflection);
  if (test.camber != 0.0) {
    const auto states = press_down(tire_, inflated, test.ground, pose, way);
    return states ? Result<TireState>(states->back()) : states.failure();
  }
  const auto& states = pressed(way, test.ground);
  return states ? Result<TireState>(states->back()) : states.failure();
}

Channels TireRig::channels_of(const ModalTest& test, const Vibrating& found) {
  const fe_tire::Mesh& mesh = tire_.mesh();
  const auto sensors = nearest_sensors(mesh, test.points).nodes;
  std::vector<ModeRecord> records;
  for (const fe_tire::Mode& mode : found.modes) {
    ModeRecord record{mode.frequency, mode.n, mode.type, mode.phase, {}};
    record.shape.resize(3 * static_cast<Eigen::Index>(sensors.size()));
    for (size_t i = 0; i < sensors.size(); ++i) {
      const int sector = sensors[i] / mesh.nodes_per_sector();
      record.shape.segment<3>(3 * static_cast<Eigen::Index>(i)) =
          mesh.frame(sector) * mode.shape.col(sensors[i]);
    }
    records.push_back(std::move(record));
  }
  Channels channels = to_channels(records);
  if (!found.damping.empty()) channels.add({"damping", "1", found.damping});
  if (!found.state) return channels;
  const Standing standing = tire_.stand(*found.state);
  channels.add({"deflection", "m", {standing.deflection}});
  channels.add({"loaded_radius", "m", {standing.loaded_radius}});
  channels.add({"force", "N", {standing.force.z()}});
  return channels;
}

Result<Channels> TireRig::run(const LoadDeflection& test,
                              fe_tire::TireSlopes& slopes,
                              const Asked& asked) {
  auto channels = run(test);
  if (!channels) return channels;
  const auto of_inflated = slopes.of_inflated(**inflated_);
  if (!of_inflated) return of_inflated.failure();
  const Eigen::RowVectorXd radius = of_inflated->radius;
  const std::vector<double>& deflections = (*channels)["deflection"];
  const bool wants_patch = any_asked(asked, {"patch_length", "patch_width", "patch_area"});
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(std::ssize(deflections), slopes.variables());
  Eigen::MatrixXd deflection = zero, height = zero, force = zero;
  Eigen::MatrixXd length = zero, width = zero, area = zero;
  for (std::size_t i = 0; i < deflections.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    // A deflection is counted from the inflated radius; a loaded radius is the height itself.
    (i < test.deflections.size() ? height : deflection).row(row) = radius;
    if (deflections[i] <= 0.0) continue;
    const auto at = std::find(pressed_->way.begin(), pressed_->way.end(), deflections[i]);
    const TireState& state = (*pressed_->states)[at - pressed_->way.begin()];
    const auto of_state = slopes.of_state(state);
    if (!of_state) return of_state.failure();
    force.row(row) = of_state->force.transpose() + of_state->by_height * height.row(row);
    if (!wants_patch) continue;
    const auto of_patch = slopes.of_patch(state, height.row(row));
    if (!of_patch) return of_patch.failure();
    length.row(row) = of_patch->length;
    width.row(row) = of_patch->width;
    area.row(row) = of_patch->area;
  }
  ChannelSlopes all = {{"deflection", deflection}, {"loaded_radius", height}, {"force", force}};
  if (wants_patch) {
    all.insert(all.end(), {{"patch_length", length}, {"patch_width", width}, {"patch_area", area}});
  }
  return with_slopes(*channels, all);
}

/// Derivatives of the results by every number of the tire.
struct TireRig::StandSlopes {
  Eigen::VectorXd height, deflection, force;  // m, m, N
};

Result<TireRig::StandSlopes> TireRig::slopes_of_stand(const ModalTest& test,
                                                      const TireState& state,
                                                      fe_tire::TireSlopes& slopes,
                                                      const Asked& asked) {
  const auto of_inflated = slopes.of_inflated(**inflated_);
  if (!of_inflated) return of_inflated.failure();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(slopes.variables());
  StandSlopes found{of_inflated->radius, zero, zero};
  if (!test.load && !any_asked(asked, {"force"})) return found;
  const auto of_state = slopes.of_state(state);
  if (!of_state) return of_state.failure();
  if (test.load) {
    found.height = fe_tire::TireSlopes::height_under_load(*of_state);
    found.deflection = of_inflated->radius - found.height;
  } else {
    found.force = of_state->force + of_state->by_height * found.height;
  }
  return found;
}

Result<Channels> TireRig::run(const ModalTest& test,
                              fe_tire::TireSlopes& slopes,
                              const Asked& asked) {
  if (test.moves()) return run_spinning(test);
  const auto found = vibrate(test);
  if (!found) return found.failure();
  const Channels channels = channels_of(test, *found);
  if (test.is_damped) return channels;  // TireSlopes knows elastic modes alone
  if (!found->state) {
    const auto of_modes = slopes.of_modes(**inflated_, found->modes);
    if (!of_modes) return of_modes.failure();
    return with_slopes(channels, {{"frequency", *of_modes}});
  }
  const auto stand = slopes_of_stand(test, *found->state, slopes, asked);
  if (!stand) return stand.failure();
  const auto of_modes = slopes.of_modes(*found->state, found->modes, stand->height);
  if (!of_modes) return of_modes.failure();
  ChannelSlopes all = {{"frequency", *of_modes},
                       {"deflection", stand->deflection.transpose()},
                       {"loaded_radius", stand->height.transpose()}};
  if (any_asked(asked, {"force"})) all.emplace_back("force", stand->force.transpose());
  return with_slopes(channels, all);
}

namespace {

/// Returns the index of the nodal plane nearest to an angle, rad, from the contact.
int nearest_plane(const fe_tire::Mesh& mesh, double angle) {
  int nearest = 0;
  for (int s = 1; s < mesh.sectors; ++s) {
    if (std::abs(mesh.angle(s) - angle) < std::abs(mesh.angle(nearest) - angle)) nearest = s;
  }
  return nearest;
}

}  // namespace

Eigen::Matrix3Xd default_points(const fe_tire::Mesh& mesh) {
  constexpr int kAround = 24, kAcross = 3;
  const int sensors = static_cast<int>(mesh.sensors.size());
  const int across = std::min(kAcross, sensors), around = std::min(kAround, mesh.sectors);
  Eigen::Matrix3Xd points(3, across * around);
  for (int s = 0; s < around; ++s) {
    const int sector = nearest_plane(mesh, 2.0 * std::numbers::pi * s / around);
    for (int i = 0; i < across; ++i) {
      const int sensor = mesh.sensors[(2 * i + 1) * sensors / (2 * across)];
      points.col(s * across + i) = mesh.frame(sector) * mesh.X.col(sensor);
    }
  }
  return points;
}

namespace {

/// Returns the nodes of one sector on outer faces that no other element covers.
std::vector<int> outer_nodes(const fe_tire::Mesh& mesh) {
  const auto face = [&](const fe_tire::Element& element, int first) {
    std::array<int, 4> nodes;
    for (int a = 0; a < 4; ++a) nodes[a] = element.node[first + a];
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  std::set<std::array<int, 4>> inner;
  for (const fe_tire::Element& element : mesh.elements) inner.insert(face(element, 0));
  std::set<int> nodes;
  for (const fe_tire::Element& element : mesh.elements)
    if (!inner.count(face(element, 4)))
      for (int a = 4; a < 8; ++a) nodes.insert(element.node[a] % mesh.nodes_per_sector());
  return {nodes.begin(), nodes.end()};
}

/// Returns the distance from a point to the faces of the elements in the (y, r) plane through the
/// spin axis.
double distance_from_wall(const fe_tire::Mesh& mesh, const Eigen::Vector2d& point) {
  const auto section = [](const Eigen::Vector3d& x) {
    return Eigen::Vector2d(x.y(), std::hypot(x.x(), x.z()));
  };
  double least = std::numeric_limits<double>::infinity();
  for (const fe_tire::Element& element : mesh.elements) {
    const auto X = mesh.coordinates(element);
    for (const auto& [from, to] : {std::pair{0, 3}, {4, 7}}) {
      const Eigen::Vector2d a = section(X.col(from)), b = section(X.col(to)), way = b - a;
      const double at = std::clamp(way.dot(point - a) / way.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (point - a - at * way).norm());
    }
  }
  return least;
}

}  // namespace

NearestSensors nearest_sensors(const fe_tire::Mesh& mesh, const Eigen::Matrix3Xd& points) {
  const std::vector<int> sensors = outer_nodes(mesh);
  NearestSensors nearest;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    int node = 0;
    for (int sector = 0; sector < mesh.sectors; ++sector) {
      const Eigen::Vector3d point = mesh.frame(sector).transpose() * points.col(i);
      for (int sensor : sensors) {
        const double distance = (mesh.X.col(sensor) - point).norm();
        if (distance < least) {
          least = distance;
          node = sector * mesh.nodes_per_sector() + sensor;
        }
      }
    }
    nearest.nodes.push_back(node);
    nearest.largest_distance = std::max(nearest.largest_distance, least);
  }
  return nearest;
}

Status points_on_tire(const fe_tire::Mesh& mesh, const Eigen::Matrix3Xd& points) {
  constexpr double kFar = 0.025;  // m
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d point = points.col(i);
    const double distance = distance_from_wall(mesh, {point.y(), std::hypot(point.x(), point.z())});
    if (distance <= kFar) continue;
    const Eigen::Vector3d mm = 1e3 * point;
    return Failure{
        fmt::format("point {} of those at which motion is recorded, ({:.4g}, {:.4g}, {:.4g}) mm, "
                    "lies {:.4g} mm from "
                    "the wall of the tire, expected at most {:.0f} mm; x, y and z count from the "
                    "wheel's center, x forward, y along the spin axis, z up: is their unit, or "
                    "the order of the columns, another one?",
                    i + 1,
                    mm.x(),
                    mm.y(),
                    mm.z(),
                    1e3 * distance,
                    1e3 * kFar)};
  }
  return {};
}

}  // namespace latsch::experiment
