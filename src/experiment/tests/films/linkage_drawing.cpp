// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/films/linkage_drawing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace latsch::experiment {

using Eigen::Vector3d;
using multibody::Joint;
using multibody::kGround;

LinkageDrawing::LinkageDrawing(const multibody::Mechanism& mechanism,
                               std::vector<int> frame,
                               std::vector<DrawnWheel> wheels)
    : mechanism_(mechanism), frame_(std::move(frame)), wheels_(std::move(wheels)) {
  mesh_.name = "linkage";
  sort_joints();
  for (const int body : links_) add_link(body);
  for (const DrawnWheel& wheel : wheels_) add_upright(wheel);
  add_struts();
}

bool LinkageDrawing::is_frame(int body) const {
  return body == kGround || std::find(frame_.begin(), frame_.end(), body) != frame_.end();
}

bool LinkageDrawing::is_upright(int body) const {
  return std::any_of(wheels_.begin(), wheels_.end(), [&](const DrawnWheel& wheel) {
    return wheel.upright == body;
  });
}

std::string LinkageDrawing::name_of(int body) const {
  const std::string& name = mechanism_.bodies()[static_cast<std::size_t>(body)].name;
  return name.starts_with("the ") ? name.substr(4) : name;
}

std::map<int, int> LinkageDrawing::ways_to_frame() const {
  std::map<int, int> ways;
  bool is_new = true;
  for (int way = 1; is_new; ++way) {
    is_new = false;
    std::vector<int> reached;
    for (const Joint& joint : mechanism_.joints())
      for (const auto& [from, to] : {std::pair{joint.a, joint.b}, {joint.b, joint.a}})
        if (!is_frame(to) && !ways.contains(to) && !is_upright(to) &&
            (is_frame(from) || ways.contains(from)))
          reached.push_back(to);
    for (const int body : reached) is_new |= ways.emplace(body, way).second;
  }
  return ways;
}

void LinkageDrawing::sort_joints() {
  const std::map<int, int> ways = ways_to_frame();
  // Find the links of these wheels: bodies that joints connect to the uprights, directly or through
  // other links, but not through the frame.
  std::set<int> seen;
  for (const DrawnWheel& wheel : wheels_) seen.insert(wheel.upright);
  for (std::size_t before = 0; before != seen.size();) {
    before = seen.size();
    for (const Joint& joint : mechanism_.joints()) {
      if (is_frame(joint.a) || is_frame(joint.b)) continue;
      if (seen.contains(joint.a) || seen.contains(joint.b)) seen.insert({joint.a, joint.b});
    }
  }
  for (const int body : seen)
    if (!is_upright(body)) links_.push_back(body);
  for (std::size_t j = 0; j < mechanism_.joints().size(); ++j) {
    const auto& [name, a, b, point, bushing, axes, driver, along] = mechanism_.joints()[j];
    const int number = static_cast<int>(j);
    const bool is_of_links = !is_frame(a) && !is_upright(a) && seen.contains(a) && seen.contains(b);
    if (is_frame(a) && seen.contains(b) && !is_upright(b)) {
      inner_[b].push_back(number);
    } else if (is_of_links && is_upright(b)) {
      outer_[a].push_back(number);
    } else if (is_of_links && ways.at(a) < ways.at(b)) {
      inner_[b].push_back(number);
      held_[a].push_back(number);
    } else if (is_of_links) {
      outer_[a].push_back(number);
      pushed_[b].push_back(number);
    }
  }
}

LinkageDrawing::Place LinkageDrawing::on(int body, const Vector3d& at_rest) const {
  if (body == kGround) return {body, at_rest};
  return {body, at_rest - mechanism_.bodies()[static_cast<std::size_t>(body)].origin};
}

Vector3d LinkageDrawing::where(const Place& place, const multibody::Poses& poses) const {
  return place.body == kGround ? place.in_body
                               : poses[static_cast<std::size_t>(place.body)].at(place.in_body);
}

Vector3d LinkageDrawing::middle(const std::vector<int>& joints) const {
  Vector3d sum = Vector3d::Zero();
  for (const int joint : joints) sum += mechanism_.joints()[static_cast<std::size_t>(joint)].point;
  return sum / static_cast<double>(joints.size());
}

std::uint32_t LinkageDrawing::add_valued_point(const Place& place, int force) {
  points_.push_back(place);
  values_.push_back(force);
  mesh_.points.conservativeResize(3, std::ssize(points_));
  mesh_.points.col(std::ssize(points_) - 1) = where(place, mechanism_.at_rest());
  return static_cast<std::uint32_t>(points_.size() - 1);
}

std::uint32_t LinkageDrawing::add_point(int body, const Vector3d& at_rest) {
  return add_valued_point(on(body, at_rest), -1);
}

void LinkageDrawing::add_rod(const std::string& name, std::uint32_t from, std::uint32_t to) {
  const auto first = static_cast<std::uint32_t>(mesh_.edges.size() / 2);
  mesh_.edges.insert(mesh_.edges.end(), {from, to});
  if (!mesh_.rods.empty() && mesh_.rods.back().name == name)
    ++mesh_.rods.back().count;
  else
    mesh_.rods.push_back({name, first, 1});
}

void LinkageDrawing::add_circle(const DrawnWheel& wheel) {
  constexpr int kPoints = 36;
  // The wheel rotates about the upright's y axis, according to camber and toe.
  const Vector3d down = wheel.contact - wheel.center;
  const double radius = Vector3d(down.x(), 0.0, down.z()).norm();
  const auto first = static_cast<std::uint32_t>(points_.size());
  for (int k = 0; k < kPoints; ++k) {
    const double phi = 2.0 * std::numbers::pi * k / kPoints;
    add_point(wheel.upright,
              Vector3d(wheel.center.x(), wheel.contact.y(), wheel.center.z()) +
                  radius * Vector3d(std::sin(phi), 0.0, -std::cos(phi)));
  }
  const std::string name = wheel.name.empty() ? "wheel" : wheel.name + " wheel";
  for (std::uint32_t k = 0; k < kPoints; ++k) add_rod(name, first + k, first + (k + 1) % kPoints);
}

int LinkageDrawing::add_force(const Force& force,
                              const std::string& name,
                              std::uint32_t point,
                              bool is_load) {
  assert(arrows_.size() == forces_.size() && "loads come behind");
  forces_.push_back(force);
  arrows_.push_back({name, "N", point, is_load});
  return static_cast<int>(forces_.size()) - 1;
}

void LinkageDrawing::add_load(const std::string& name,
                              const std::string& unit,
                              std::uint32_t point) {
  arrows_.push_back({name, unit, point, true});
}

void LinkageDrawing::add_link(int body) {
  const std::vector<int>&inner = inner_[body], &outer = outer_[body], &held = held_[body];
  const std::vector<int>& outward = outer.empty() ? held : outer;
  const auto& joints = mechanism_.joints();
  const auto at_joint = [&](int j) { return joints[static_cast<std::size_t>(j)].point; };
  if (inner.empty()) return;
  const Vector3d from = middle(inner), to = outward.empty() ? from : middle(outward);
  for (const int j : inner) {
    // The force that drives a rocker rotates it, so it is not the tension of a rod.
    const Force force{
        .joint = j, .is_axial = !outer.empty(), .from = on(body, at_joint(j)), .to = on(body, to)};
    const int number = static_cast<int>(forces_.size());
    const std::uint32_t here = add_valued_point(force.from, number);
    add_force(force, joints[static_cast<std::size_t>(j)].name, here, false);
    if (outward.empty()) continue;
    std::string name = name_of(body);
    if (inner.size() > 1) name += ", " + joints[static_cast<std::size_t>(j)].name;
    add_rod(name, here, add_valued_point(force.to, number));
  }
  for (const int j : outer) {
    const Force force{
        .joint = j, .is_outer = true, .from = on(body, from), .to = on(body, at_joint(j))};
    const int second = joints[static_cast<std::size_t>(j)].b;
    force_at_[j] = static_cast<int>(forces_.size());
    const std::uint32_t there = add_valued_point(on(second, at_joint(j)), force_at_[j]);
    add_force(force, joints[static_cast<std::size_t>(j)].name, there, false);
  }
  const auto add_arm = [&](const Vector3d& end) {
    if ((end - to).norm() > 1e-6) add_rod(name_of(body), add_point(body, to), add_point(body, end));
  };
  for (const int j : pushed_[body]) add_arm(at_joint(j));
  for (const multibody::Strut& strut : mechanism_.struts())
    for (const multibody::StrutLine& line : strut.lines) {
      if (line.a == body)
        add_rod(name_of(body), add_point(body, from), add_point(body, line.point_a));
      if (line.b == body)
        add_rod(name_of(body), add_point(body, from), add_point(body, line.point_b));
    }
}

void LinkageDrawing::add_upright(const DrawnWheel& wheel) {
  const auto& joints = mechanism_.joints();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].b != wheel.upright) continue;
    const Vector3d& point = joints[j].point;
    if (is_frame(joints[j].a)) {
      add_force({.joint = static_cast<int>(j), .is_axial = false},
                joints[j].name,
                add_point(wheel.upright, point),
                true);
      continue;
    }
    add_rod(name_of(wheel.upright),
            add_point(wheel.upright, wheel.center),
            add_valued_point(on(wheel.upright, point), force_at_.at(static_cast<int>(j))));
  }
}

void LinkageDrawing::add_struts() {
  const auto is_ours = [&](int body) {
    return std::find(links_.begin(), links_.end(), body) != links_.end() || is_upright(body);
  };
  for (std::size_t s = 0; s < mechanism_.struts().size(); ++s) {
    const multibody::Strut& strut = mechanism_.struts()[s];
    const std::string name = strut.name.starts_with("the ") ? strut.name.substr(4) : strut.name;
    for (std::size_t l = 0; l < strut.lines.size(); ++l) {
      const multibody::StrutLine& line = strut.lines[l];
      if (!is_ours(line.a) && !is_ours(line.b)) continue;
      const Force force{.joint = -1,
                        .strut = static_cast<int>(s),
                        .line = static_cast<int>(l),
                        .from = on(line.a, line.point_a),
                        .to = on(line.b, line.point_b)};
      const int number = static_cast<int>(forces_.size());
      const std::uint32_t a = add_valued_point(force.from, number),
                          b = add_valued_point(force.to, number);
      add_rod(name, a, b);
      add_force(force, name, b, false);
    }
  }
}

report::Scene::Step LinkageDrawing::step(double at,
                                         const multibody::Assembly& assembly,
                                         const multibody::Motion& motion) const {
  report::Scene::Step step;
  step.at = at;
  step.points.resize(3, std::ssize(points_));
  for (std::size_t k = 0; k < points_.size(); ++k)
    step.points.col(static_cast<Eigen::Index>(k)) = where(points_[k], motion.poses);
  step.vectors = Eigen::Matrix3Xd::Zero(3, std::ssize(arrows_));
  std::vector<float> tensions;
  for (std::size_t f = 0; f < forces_.size(); ++f) {
    const Force& force = forces_[f];
    double tension = std::numeric_limits<double>::quiet_NaN();
    const Vector3d outward =
        (where(force.to, motion.poses) - where(force.from, motion.poses)).normalized();
    auto vector = step.vectors.col(static_cast<Eigen::Index>(f));
    if (force.joint >= 0) {
      // forces are recorded as forces on the second body of the joint
      const double side = force.is_outer ? -1.0 : 1.0;
      vector = side * assembly.joint_load(force.joint, motion).head<3>();
      if (force.is_axial) tension = -side * vector.dot(outward);
    } else {
      const auto& line = mechanism_.struts()[static_cast<std::size_t>(force.strut)]
                             .lines[static_cast<std::size_t>(force.line)];
      tension = line.weight * assembly.strut_force(force.strut, motion);
      vector = tension * outward;
    }
    tensions.push_back(static_cast<float>(tension));
  }
  for (const int force : values_)
    step.field.push_back(force < 0 ? std::numeric_limits<float>::quiet_NaN()
                                   : tensions[static_cast<std::size_t>(force)]);
  return step;
}

}  // namespace latsch::experiment
