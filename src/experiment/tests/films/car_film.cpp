// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/films/car_film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiment/tests/films/road_surface.h"

namespace latsch::experiment {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using report::Scene;

constexpr int kMostAround = 40;  // most points on the outline of a tire
// assumed width of a tire over its radius if its file states no width
constexpr double kWheelWidthOfRadius = 0.6;
constexpr double kPost = 0.36;  // m, side of a post's plate
// m, length of road shown behind the rear axle and before the front one
constexpr double kBefore = 1.2;
constexpr double kBeside = 0.5;  // m, width of road shown beside the wheels

/// Returns every k-th point of a closed line.
Matrix3Xd thinned(const Matrix3Xd& line) {
  const Eigen::Index every = (line.cols() + kMostAround - 1) / kMostAround;
  return line(Eigen::all, Eigen::seq(0, line.cols() - 1, every));
}

/// Returns the circle that represents a tire without a belt, flattened at the road.
Matrix3Xd circle(const WheelMotion& wheel, double radius) {
  Matrix3Xd points(3, kMostAround);
  for (int k = 0; k < kMostAround; ++k) {
    const double phi = 2.0 * std::numbers::pi * k / kMostAround;
    points.col(k) = wheel.center + radius * (std::sin(phi) * wheel.carrier.col(0) -
                                             std::cos(phi) * wheel.carrier.col(2));
  }
  return points;
}

double loaded_radius(const WheelMotion& wheel, double free, const road::Road& road, double time) {
  const Vector3d below = wheel.center - free * wheel.carrier.col(2);
  return std::min(free, wheel.center.z() - road.height(below.x(), below.y(), time));
}

void add_square(
    Scene::Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
  mesh.parts.back().count += 2;
}

void begin_part(Scene::Mesh& mesh, std::string name) {
  mesh.parts.push_back({std::move(name), static_cast<std::uint32_t>(mesh.triangles.size() / 3), 0});
}

/// Box that contains the points at which the links of an axle are attached to the chassis.
struct Span {
  double x0 = std::numeric_limits<double>::infinity(), x1 = -x0, z0 = x0, z1 = -x0, y = 0.0;
};
Span span_of(const car::Car& car, int left) {
  Span span;
  const auto first = car.parts().corners[static_cast<std::size_t>(left)].first_joint;
  for (int j = 0; j < suspension::DoubleWishbone::kJoints; ++j) {
    const multibody::Joint& joint = car.mechanism().joints()[static_cast<std::size_t>(first + j)];
    if (joint.a != car.parts().chassis && joint.a != car.parts().chassis_rear) continue;
    span.x0 = std::min(span.x0, joint.point.x());
    span.x1 = std::max(span.x1, joint.point.x());
    span.z0 = std::min(span.z0, joint.point.z());
    span.z1 = std::max(span.z1, joint.point.z());
    span.y = std::max(span.y, std::abs(joint.point.y()));
  }
  return span;
}

}  // namespace

CarWatcher CarFilm::watcher() {
  return
      [this](const car::Car& car, const car::CarState& state, const road::Road& road, double time) {
        see(car, state, road, time);
      };
}

void CarFilm::begin(const car::Car& car, const car::CarState& state) {
  const car::CarParts& parts = car.parts();
  std::vector<DrawnWheel> wheels;
  for (int corner = 0; corner < car::kCorners; ++corner) {
    const car::CornerParts& of = parts.corners[static_cast<std::size_t>(corner)];
    wheels.push_back({car::kCornerNames[static_cast<std::size_t>(corner)],
                      of.upright,
                      of.wheel_center,
                      of.contact});
    side_ = std::max(side_, std::abs(of.wheel_center.y()) + kBeside);
  }
  rear_ = parts.corners[car::kRL].wheel_center.x() - kBefore;
  front_ = parts.corners[car::kFL].wheel_center.x() + kBefore;
  y_ = state.bodies.poses[static_cast<std::size_t>(parts.chassis)].place.y();
  drawing_.emplace(
      car.mechanism(), std::vector<int>{parts.chassis, parts.chassis_rear}, std::move(wheels));
  mesh_ = drawing_->mesh();
  add_chassis(car);
  add_rings(car, state);
  add_loads();
  if (on_ == On::posts) add_posts(car);
}

void CarFilm::add_chassis(const car::Car& car) {
  const Span front = span_of(car, car::kFL), rear = span_of(car, car::kRL);
  const int fore = car.parts().chassis, aft = car.parts().chassis_rear;
  struct Station {
    int body;
    double x, y, z0, z1;
  };
  const double wheelbase = car.parts().corners[car::kFL].wheel_center.x() -
                           car.parts().corners[car::kRL].wheel_center.x();
  const double high = std::max(front.z1, rear.z1), low = std::min(front.z0, rear.z0),
               wide = std::max(front.y, rear.y);
  const std::vector<Station> stations = {
      {fore, front.x1 + 0.25 * wheelbase, 0.35 * front.y, low, low + 0.4 * (high - low)},
      {fore, front.x1, front.y, front.z0, front.z1},
      {fore, front.x0, front.y, front.z0, front.z1},
      {aft, 0.5 * (front.x0 + rear.x1), wide, low, high},
      {aft, rear.x1, rear.y, rear.z0, rear.z1},
      {aft, rear.x0, rear.y, rear.z0, rear.z1}};
  const auto first = static_cast<std::uint32_t>(mesh_.points.cols());
  for (const Station& at : stations)
    for (const auto& [y, z] :
         {std::pair{-at.y, at.z0}, {at.y, at.z0}, {at.y, at.z1}, {-at.y, at.z1}})
      drawing_->add_point(at.body, {at.x, y, z});
  mesh_.points = drawing_->mesh().points;
  begin_part(mesh_, "chassis");
  const auto sections = static_cast<std::uint32_t>(stations.size());
  for (std::uint32_t s = 0; s + 1 < sections; ++s)
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t a = first + 4 * s, next = (k + 1) % 4;
      add_square(mesh_, a + k, a + next, a + 4 + next, a + 4 + k);
      mesh_.edges.insert(mesh_.edges.end(), {a + k, a + 4 + k, a + k, a + next});
    }
  const std::uint32_t last = first + 4 * (sections - 1);
  add_square(mesh_, first, first + 1, first + 2, first + 3);
  add_square(mesh_, last, last + 1, last + 2, last + 3);
  for (std::uint32_t k = 0; k < 4; ++k)
    mesh_.edges.insert(mesh_.edges.end(), {last + k, last + (k + 1) % 4});
}

void CarFilm::add_rings(const car::Car&, const car::CarState& state) {
  auto at = static_cast<std::uint32_t>(mesh_.points.cols());
  for (std::size_t i = 0; i < rings_.size(); ++i) {
    const Tire& tire = *state.wheels[i].tire;
    Ring& ring = rings_[i];
    const Matrix3Xd belt = tire.outline();
    ring.first = at;
    ring.radius = tire.free_radius();
    ring.points = belt.cols() == 0 ? kMostAround : static_cast<int>(thinned(belt).cols());
    const auto print = tire.footprint();
    ring.width = print && print->width > 0.0 ? print->width : kWheelWidthOfRadius * ring.radius;
    begin_part(mesh_, std::string("tire ") + car::kCornerNames[i]);
    const auto count = static_cast<std::uint32_t>(2 * ring.points);
    for (std::uint32_t k = 0; k < count; k += 2) {
      const std::uint32_t a = at + k, b = a + 1, c = at + (k + 2) % count, d = c + 1;
      add_square(mesh_, a, b, d, c);
      mesh_.edges.insert(mesh_.edges.end(), {a, b, a, c, b, d});
    }
    at += count;
  }
  mesh_.points.conservativeResize(3, at);
}

void CarFilm::add_loads() {
  contacts_ = static_cast<std::uint32_t>(mesh_.points.cols());
  for (std::uint32_t i = 0; i < car::kCorners; ++i)
    arrows_.push_back({std::string("Fz ") + car::kCornerNames[i], "N", contacts_ + i, false});
  mesh_.points.conservativeResize(3, contacts_ + car::kCorners);
}

void CarFilm::add_posts(const car::Car&) {
  posts_ = static_cast<std::uint32_t>(mesh_.points.cols());
  mesh_.points.conservativeResize(3, posts_ + 4 * car::kCorners);
  begin_part(mesh_, "posts");
  for (std::uint32_t i = 0; i < car::kCorners; ++i) {
    const std::uint32_t a = posts_ + 4 * i;
    add_square(mesh_, a, a + 1, a + 2, a + 3);
    for (std::uint32_t k = 0; k < 4; ++k)
      mesh_.edges.insert(mesh_.edges.end(), {a + k, a + (k + 1) % 4});
  }
}

void CarFilm::place_tires(const car::Car& car,
                          const car::CarState& state,
                          const road::Road& road,
                          double time,
                          Scene::Step& step) const {
  const auto on_hubs = car.vertical_forces(state);
  step.vectors = Matrix3Xd::Zero(3, car::kCorners);
  for (std::size_t i = 0; i < rings_.size(); ++i) {
    const car::WheelState& wheel = state.wheels[i];
    const Ring& ring = rings_[i];
    Matrix3Xd belt = wheel.tire->outline();
    belt = belt.cols() == 0
               ? circle(wheel.motion, loaded_radius(wheel.motion, ring.radius, road, time))
               : thinned(belt);
    const Vector3d half = 0.5 * ring.width * wheel.motion.carrier.col(1);
    Eigen::Index lowest = 0;
    belt.row(2).minCoeff(&lowest);
    for (Eigen::Index k = 0; k < belt.cols(); ++k) {
      step.points.col(ring.first + 2 * k) = belt.col(k) - half;
      step.points.col(ring.first + 2 * k + 1) = belt.col(k) + half;
    }
    step.points.col(contacts_ + static_cast<Eigen::Index>(i)) = belt.col(lowest);
    const auto print = wheel.tire->footprint();
    step.vectors(2, static_cast<Eigen::Index>(i)) = print ? print->load : on_hubs[i];
    if (on_ != On::posts) continue;
    const Vector3d& place = car.parts().corners[i].wheel_center;
    const double z = road.height(place.x(), place.y(), time), h = 0.5 * kPost;
    const auto first = posts_ + static_cast<Eigen::Index>(4 * i);
    step.points.col(first) << place.x() - h, place.y() - h, z;
    step.points.col(first + 1) << place.x() + h, place.y() - h, z;
    step.points.col(first + 2) << place.x() + h, place.y() + h, z;
    step.points.col(first + 3) << place.x() - h, place.y() + h, z;
  }
}

void CarFilm::see(const car::Car& car,
                  const car::CarState& state,
                  const road::Road& road,
                  double time) {
  if (time < -kLead) return;
  if (!steps_.empty() && time < steps_.back().at + kInterval - 1e-9) return;
  if (!drawing_) begin(car, state);
  Scene::Step step = drawing_->step(time, car.assembly(), car.motion_of(state));
  const Eigen::Index moved = step.points.cols();
  step.points.conservativeResize(3, mesh_.points.cols());
  step.points.rightCols(mesh_.points.cols() - moved).setZero();
  step.field.resize(static_cast<std::size_t>(mesh_.points.cols()),
                    std::numeric_limits<float>::quiet_NaN());
  place_tires(car, state, road, time, step);
  const int chassis = car.parts().chassis;
  step.origin = state.bodies.poses[static_cast<std::size_t>(chassis)].place.x() -
                car.mechanism().bodies()[static_cast<std::size_t>(chassis)].origin.x();
  step.points.row(0).array() -= step.origin;
  steps_.push_back(std::move(step));
}

void CarFilm::add_to(Scene& scene,
                     const std::string& name,
                     int most_steps,
                     const road::Road* road) {
  if (steps_.empty()) return;
  const auto most = static_cast<std::size_t>(most_steps);
  Scene::Sequence film{.name = name, .along = "time", .unit = "s"};
  if (steps_.size() > most) {
    // Finds the stretch of `most` steps in which the loads change most.
    std::vector<double> sum = {0.0};
    for (std::size_t k = 1; k < steps_.size(); ++k)
      sum.push_back(sum.back() + (steps_[k].vectors - steps_[k - 1].vectors).squaredNorm());
    std::size_t first = 0;
    for (std::size_t k = 0; k + most <= steps_.size(); ++k)
      if (sum[k + most - 1] - sum[k] > sum[first + most - 1] - sum[first]) first = k;
    const auto begin = steps_.begin() + static_cast<std::ptrdiff_t>(first);
    steps_ = {begin, begin + static_cast<std::ptrdiff_t>(most)};
    film.name += fmt::format(
        " ({:.2f} to {:.2f} s, where wheel loads move most)", steps_.front().at, steps_.back().at);
  }
  mesh_.points = steps_.front().points;
  mesh_.name = film.mesh = "car in " + name;
  film.field_name = "axial force, tension positive";
  film.field_unit = "N";
  film.arrows = arrows_;
  if (road) {
    const RoadArea area{
        steps_.front().origin + rear_, steps_.back().origin + front_, y_ - side_, y_ + side_};
    Scene::Mesh surface = road_surface(*road, area);
    surface.name = film.ground = "road of " + name;
    scene.meshes.push_back(std::move(surface));
  }
  film.steps = std::move(steps_);
  scene.meshes.push_back(std::move(mesh_));
  scene.sequences.push_back(std::move(film));
}

}  // namespace latsch::experiment
