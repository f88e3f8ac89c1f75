// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/tire_rig.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "experiment/rigs/deflection_for_load.h"
#include "experiment/rigs/mode_record.h"

namespace latsch::experiment {
namespace {

using fe_tire::FeTire;
using fe_tire::Inflated;
using fe_tire::Loaded;
using fe_tire::LoadPoint;

constexpr double kTypicalStiffness = 2.0e5;  // N/m, a first guess of the deflection under a load
constexpr int kModalSteps =
    5;  // loading steps to the state of a modal test that has no curve to share

/// What load cases have in common when they share their equilibria.
struct Setup {
  double pressure;
  fe_tire::Ground ground;

  bool operator==(const Setup& other) const {
    return pressure == other.pressure && ground.mu == other.ground.mu &&
           ground.stiffness == other.ground.stiffness;
  }
};

Setup setup_of(const LoadCase& load_case) {
  return std::visit(
      [](const auto& test) {
        return Setup{test.pressure, test.ground};
      },
      load_case.test);
}

/// All tests of one pressure and ground: inflates when first asked, loads once through every
/// deflection.
class Station {
 public:
  Station(FeTire& tire, Setup setup, const std::vector<const LoadCase*>& cases)
      : tire_(tire), setup_(setup), inflated_(tire.inflate(setup.pressure)) {
    if (inflated_) load_through(cases);
  }

  Result<Channels> run(const LoadDeflection& test) const {
    if (!inflated_) return inflated_.failure();
    if (loaded_ && !*loaded_) return loaded_->failure();
    Channels channels;
    const char* names[] = {
        "deflection", "loaded_radius", "force", "patch_length", "patch_width", "patch_area"};
    const char* units[] = {"m", "m", "N", "m", "m", "m^2"};
    std::array<std::vector<double>, 6> columns;
    for (double deflection : deflections_of(test)) {
      const LoadPoint point = point_at(deflection);
      const double row[] = {point.deflection,
                            point.loaded_radius,
                            point.Fz,
                            point.patch.length,
                            point.patch.width,
                            point.patch.area};
      for (size_t c = 0; c < columns.size(); ++c) columns[c].push_back(row[c]);
    }
    for (size_t c = 0; c < columns.size(); ++c) channels.add({names[c], units[c], columns[c]});
    return channels;
  }

  Result<Channels> run(const ModalTest& test) const {
    if (!inflated_) return inflated_.failure();
    if (!test.loaded()) return modal_channels(test, tire_.modes(*inflated_, test.count));
    const Result<Loaded> state = loaded_state(test);
    if (!state) return state.failure();
    auto channels = modal_channels(test, tire_.modes(*state, test.count));
    if (!channels) return channels;
    const LoadPoint& point = state->curve.back();
    channels->add({"deflection", "m", {point.deflection}});
    channels->add({"loaded_radius", "m", {point.loaded_radius}});
    channels->add({"force", "N", {point.Fz}});
    return channels;
  }

 private:
  std::vector<double> deflections_of(const LoadDeflection& test) const {
    std::vector<double> deflections = test.deflections;
    for (double radius : test.loaded_radii) deflections.push_back(inflated_->radius - radius);
    return deflections;
  }

  void load_through(const std::vector<const LoadCase*>& cases) {
    std::vector<double> all;
    for (const LoadCase* load_case : cases) {
      if (const auto* curve = std::get_if<LoadDeflection>(&load_case->test)) {
        const auto some = deflections_of(*curve);
        all.insert(all.end(), some.begin(), some.end());
      } else if (const auto& modal = std::get<ModalTest>(load_case->test); modal.deflection) {
        all.push_back(*modal.deflection);
      }
    }
    std::erase_if(all, [](double deflection) { return deflection <= 0.0; });
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    if (all.empty()) return;
    if (all.size() == 1) all = even_steps(all.front());
    deflections_ = all;
    loaded_ = tire_.load(*inflated_, all, setup_.ground);
  }

  static std::vector<double> even_steps(double deflection) {
    std::vector<double> steps;
    for (int i = 1; i < kModalSteps; ++i) steps.push_back(deflection * i / kModalSteps);
    steps.push_back(deflection);
    return steps;
  }

  LoadPoint point_at(double deflection) const {
    LoadPoint point;
    point.deflection = deflection;
    point.loaded_radius = inflated_->radius - deflection;
    if (deflection <= 0.0) return point;  // no contact
    const auto at = std::find(deflections_.begin(), deflections_.end(), deflection);
    assert(at != deflections_.end());
    return (*loaded_)->curve[at - deflections_.begin()];
  }

  /// Where the shared loading ends deeper than this test, the tire is loaded again up to the test's
  /// own state.
  Result<Loaded> loaded_state(const ModalTest& test) const {
    if (test.load) {
      return load_to_force(tire_, *inflated_, *test.load, guess(*test.load), setup_.ground);
    }
    if (!*loaded_) return loaded_->failure();
    if (*test.deflection == deflections_.back()) return *loaded_;
    const auto end = std::upper_bound(deflections_.begin(), deflections_.end(), *test.deflection);
    return tire_.load(*inflated_, {deflections_.begin(), end}, setup_.ground);
  }

  double guess(double load) const {
    if (!loaded_ || !*loaded_) return load / kTypicalStiffness;
    const LoadPoint& deepest = (*loaded_)->curve.back();
    return deepest.Fz > 0.0 ? deepest.deflection * load / deepest.Fz : load / kTypicalStiffness;
  }

  Result<Channels> modal_channels(const ModalTest& test,
                                  const Result<std::vector<fe_tire::Mode>>& modes) const {
    if (!modes) return modes.failure();
    const fe_tire::Mesh& mesh = tire_.mesh();
    const auto sensors = nearest_sensors(mesh, test.points).nodes;
    std::vector<ModeRecord> records;
    for (const fe_tire::Mode& mode : *modes) {
      ModeRecord record{mode.frequency, mode.n, mode.type, mode.phase, {}};
      record.shape.resize(3 * static_cast<Eigen::Index>(sensors.size()));
      for (size_t i = 0; i < sensors.size(); ++i) {
        const int sector = sensors[i] / mesh.nodes_per_sector();
        record.shape.segment<3>(3 * static_cast<Eigen::Index>(i)) =
            mesh.frame(sector) * mode.shape.col(sensors[i]);
      }
      records.push_back(std::move(record));
    }
    return to_channels(records);
  }

  FeTire& tire_;
  Setup setup_;
  Result<Inflated> inflated_;
  std::vector<double> deflections_;       // of loaded_, ascending
  std::optional<Result<Loaded>> loaded_;  // none: no test here asks for a deflection
};

}  // namespace

std::vector<Result<Channels>> run(FeTire& tire, const std::vector<LoadCase>& cases) {
  std::vector<std::optional<Result<Channels>>> results(cases.size());
  for (size_t first = 0; first < cases.size(); ++first) {
    if (results[first]) continue;
    const Setup setup = setup_of(cases[first]);
    std::vector<const LoadCase*> shared;
    for (const LoadCase& other : cases) {
      if (setup_of(other) == setup) shared.push_back(&other);
    }
    const Station station(tire, setup, shared);
    for (size_t i = first; i < cases.size(); ++i) {
      if (!(setup_of(cases[i]) == setup)) continue;
      auto result = std::visit([&](const auto& test) { return station.run(test); }, cases[i].test);
      if (!result) result = Failure{"experiment " + cases[i].name + ": " + result.failure().reason};
      results[i] = std::move(result);
    }
  }
  std::vector<Result<Channels>> all;
  for (auto& result : results) all.push_back(std::move(*result));
  return all;
}

namespace {

/// The plane nearest to an angle from the contact, rad.
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

NearestSensors nearest_sensors(const fe_tire::Mesh& mesh, const Eigen::Matrix3Xd& points) {
  NearestSensors nearest;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    int node = 0;
    for (int sector = 0; sector < mesh.sectors; ++sector) {
      const Eigen::Vector3d point = mesh.frame(sector).transpose() * points.col(i);
      for (int sensor : mesh.sensors) {
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

}  // namespace latsch::experiment
