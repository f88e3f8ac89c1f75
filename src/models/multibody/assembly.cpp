// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace latsch::multibody {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Vector6d rate_of(const Motion& motion, int body) {
  if (body == kGround || !motion.rates) return Vector6d::Zero();
  return motion.rates->segment<6>(6 * body);
}

Vector6d acceleration_of(const Motion& motion, int body) {
  if (body == kGround || !motion.accelerations) return Vector6d::Zero();
  return motion.accelerations->segment<6>(6 * body);
}

double driver_of(const Motion& motion, int driver) {
  return driver < 0 || motion.drivers.empty() ? 0.0 : motion.drivers[at(driver)];
}

}  // namespace

Matrix3d turned_inertia(const Body& body, const Pose& pose) {
  return pose.turn * body.inertia * pose.turn.transpose();
}

Assembly::Assembly(const Mechanism& mechanism)
    : mechanism_(mechanism),
      J_(static_cast<int>(mechanism.bodies().size()), mechanism.pairs()),
      driven_(mechanism.joints().size()),
      forces_(6 * static_cast<Eigen::Index>(mechanism.bodies().size())),
      inertia_(mechanism.bodies().size(), Matrix3d::Zero()),
      none_(mechanism.no_memories()) {
  for (std::size_t i = 0; i < mechanism.joints().size(); ++i) {
    const Joint& joint = mechanism.joints()[i];
    if (joint.bushing.parts.empty()) plain_.push_back(static_cast<int>(i));
    const auto place = [&](int row, int column) {
      return row == kGround || column == kGround ? -1 : J_.place(row, column);
    };
    joint_blocks_.push_back({place(joint.a, joint.a),
                             place(joint.a, joint.b),
                             place(joint.b, joint.a),
                             place(joint.b, joint.b)});
  }
}

const Pose& Assembly::pose(const Poses& poses, int body) const {
  return body == kGround ? ground_ : poses[at(body)];
}

void Assembly::add(int body, const Vector6d& wrench) {
  if (body != kGround) forces_.segment<6>(6 * body) += wrench;
}

void Assembly::evaluate(const Motion& motion,
                        std::span<const Load> loads,
                        double load_share,
                        const Outside& outside) {
  forces_.setZero();
  J_.clear();
  turned_ = 0.0;
  add_plain_joints(motion);
  for (std::size_t i = 0; i < mechanism_.joints().size(); ++i)
    if (!mechanism_.joints()[i].bushing.parts.empty()) add_joint(static_cast<int>(i), motion);
  for (std::size_t i = 0; i < mechanism_.struts().size(); ++i)
    add_strut(static_cast<int>(i), motion);
  for (std::size_t i = 0; i < mechanism_.bodies().size(); ++i)
    add_body(static_cast<int>(i), motion);
  for (const Load& load : loads) add_load(load, load_share, motion.poses);
  if (!outside) return;
  outside_.clear();
  outside(motion, outside_);
  for (const BodyForce& wrench : outside_) {
    add(wrench.body, wrench.value);
    J_.block(wrench.body, wrench.body) += wrench.slopes;
  }
}

BushingStrain Assembly::strain(int i, const Motion& motion) const {
  const Joint& joint = mechanism_.joints()[at(i)];
  const Pose &a = pose(motion.poses, joint.a), &b = pose(motion.poses, joint.b);
  if (joint.driver < 0) return strain_of(mechanism_.place(i), a, b);
  BushingPlace place = mechanism_.place(i);
  place.in_a += driver_of(motion, joint.driver) * joint.along;
  return strain_of(place, a, b);
}

void Assembly::add_plain_joints(const Motion& motion) {
  static const Vector6d kStill = Vector6d::Zero();
  // Receives the derivatives of wrenches on the ground, which are not used.
  Matrix6d nowhere = Matrix6d::Zero();
  tasks_.clear();
  for (const int i : plain_) {
    const Joint& joint = mechanism_.joints()[at(i)];
    const Blocks& blocks = joint_blocks_[at(i)];
    const auto block = [&](int place) { return place < 0 ? nowhere.data() : J_.at(place).data(); };
    const auto rates = [&](int body) {
      return body == kGround || !motion.rates ? kStill.data() : motion.rates->data() + 6 * body;
    };
    const auto wrench = [&](int body) {
      return body == kGround ? nowhere.data() : forces_.data() + 6 * body;
    };
    const BushingPlace* place = &mechanism_.place(i);
    if (joint.driver >= 0) {
      driven_[at(i)] = *place;
      driven_[at(i)].in_a += driver_of(motion, joint.driver) * joint.along;
      place = &driven_[at(i)];
    }
    tasks_.push_back({.place = numbers_of(*place),
                      .parameters = numbers_of(joint.bushing),
                      .pose_a = numbers_of(pose(motion.poses, joint.a)),
                      .pose_b = numbers_of(pose(motion.poses, joint.b)),
                      .rates_a = rates(joint.a),
                      .rates_b = rates(joint.b),
                      .on_a = wrench(joint.a),
                      .on_b = wrench(joint.b),
                      .aa = block(blocks.aa),
                      .ab = block(blocks.ab),
                      .ba = block(blocks.ba),
                      .bb = block(blocks.bb)});
  }
  while (tasks_.size() % 4 != 0) {
    BushingTask again = tasks_.back();
    again.on_a = again.on_b = again.aa = again.ab = again.ba = again.bb = nowhere.data();
    tasks_.push_back(again);
  }
  turned_ = add_bushings(tasks_, motion.rates != nullptr, motion.share);
}

void Assembly::add_joint(int i, const Motion& motion) {
  const Joint& joint = mechanism_.joints()[at(i)];
  const BushingStrain s = strain(i, motion);
  turned_ = std::max(turned_, s.q.lpNorm<Eigen::Infinity>());
  const Memories& memories = motion.memories ? *motion.memories : none_;
  const BushingForces forces =
      forces_in_motion(s,
                       rates_of(s, rate_of(motion, joint.a), rate_of(motion, joint.b)),
                       joint.bushing,
                       motion.share,
                       memories.data() + mechanism_.memory_of_joint(i),
                       motion.step,
                       nullptr);
  const BushingWrenches w = wrenches(s, forces);
  const BushingTangent K = tangent(s, forces);
  const Blocks& blocks = joint_blocks_[at(i)];
  add(joint.a, w.on_a);
  add(joint.b, w.on_b);
  if (blocks.aa >= 0) J_.at(blocks.aa) += K.aa;
  if (blocks.bb >= 0) J_.at(blocks.bb) += K.bb;
  if (blocks.ab >= 0) {
    J_.at(blocks.ab) += K.ab;
    J_.at(blocks.ba) += K.ba;
  }
}

Assembly::StrutAnswer Assembly::answer(int i,
                                       const Motion& motion,
                                       PartMemory* kept,
                                       std::vector<LineGeometry>& lines) const {
  const Strut& strut = mechanism_.struts()[at(i)];
  lines.clear();
  StrutAnswer answer{.lines = lines};
  double e = -mechanism_.rest_length(i) - driver_of(motion, strut.driver), rate = 0.0,
         acceleration = 0.0;
  for (std::size_t l = 0; l < strut.lines.size(); ++l) {
    const StrutLine& line = strut.lines[l];
    const auto& [in_a, in_b] = mechanism_.ends(i, static_cast<int>(l));
    const LineGeometry& g = answer.lines.emplace_back(line_geometry(
        pose(motion.poses, line.a), pose(motion.poses, line.b), in_a, in_b, line.weight));
    e += g.weight * g.length;
    if (!motion.rates) continue;
    const Vector6d va = rate_of(motion, line.a), vb = rate_of(motion, line.b);
    rate += g.by_a().dot(va) + g.by_b().dot(vb);
    if (strut.inertance > 0.0 && motion.accelerations)
      acceleration += g.by_a().dot(acceleration_of(motion, line.a)) +
                      g.by_b().dot(acceleration_of(motion, line.b)) + g.centripetal(va, vb);
  }
  answer.force =
      strut.preload + strut.stiffness * e + strut.damping * rate + strut.inertance * acceleration;
  answer.slope =
      strut.stiffness + motion.share * strut.damping + motion.acceleration_share * strut.inertance;
  const Memories& memories = motion.memories ? *motion.memories : none_;
  for (std::size_t p = 0; p < strut.parts.size(); ++p) {
    const PartForce part =
        respond(strut.parts[p], e, rate, memories[mechanism_.memory_of_strut(i) + p], motion.step);
    answer.force += part.f;
    answer.slope += part.by_d + motion.share * part.by_rate;
    if (kept) kept[p] = {part.s, e};
  }
  return answer;
}

void Assembly::add_strut(int i, const Motion& motion) {
  const Strut& strut = mechanism_.struts()[at(i)];
  const StrutAnswer of = answer(i, motion, nullptr, lines_);
  for (std::size_t l = 0; l < strut.lines.size(); ++l) {
    const LineGeometry& g = of.lines[l];
    const std::array<std::pair<int, Vector6d>, 2> mine = {
        {{strut.lines[l].a, g.by_a()}, {strut.lines[l].b, g.by_b()}}};
    for (const auto& [body, by] : mine) {
      if (body == kGround) continue;
      add(body, -of.force * by);
      for (std::size_t k = 0; k < strut.lines.size(); ++k)
        for (const auto& [other, by_other] : {std::pair{strut.lines[k].a, of.lines[k].by_a()},
                                              std::pair{strut.lines[k].b, of.lines[k].by_b()}})
          if (other != kGround) J_.block(body, other) -= of.slope * by * by_other.transpose();
    }
    const LineGeometry::Turning H = g.turning();
    const int a = strut.lines[l].a, b = strut.lines[l].b;
    if (a != kGround) J_.block(a, a) -= of.force * H.aa;
    if (b != kGround) J_.block(b, b) -= of.force * H.bb;
    if (a != kGround && b != kGround) {
      J_.block(a, b) -= of.force * H.ab;
      J_.block(b, a) -= of.force * H.ba;
    }
  }
}

void Assembly::add_body(int i, const Motion& motion) {
  const Body& body = mechanism_.bodies()[at(i)];
  if (body.mass == 0.0) return;
  forces_.segment<3>(6 * i) += body.mass * mechanism_.gravity();
  if (!motion.rates) return;
  Matrix3d& I = inertia_[at(i)];
  I = turned_inertia(body, motion.poses[at(i)]);
  const Vector3d w = motion.rates->segment<3>(6 * i + 3);
  forces_.segment<3>(6 * i + 3) -= w.cross(I * w);
}

void Assembly::add_load(const Load& load, double share, const Poses& poses) {
  const Vector3d F = share * load.force;
  const Vector3d arm =
      poses[at(load.body)].turn * (load.point - mechanism_.bodies()[at(load.body)].origin);
  forces_.segment<3>(6 * load.body) += F;
  forces_.segment<3>(6 * load.body + 3) += arm.cross(F) + share * load.moment;
  J_.block(load.body, load.body).bottomRightCorner<3, 3>() += cross(F) * cross(arm);
}

void Assembly::remember(const Motion& motion, Memories& kept) const {
  const Memories& before = motion.memories ? *motion.memories : none_;
  kept.resize(before.size());
  for (std::size_t i = 0; i < mechanism_.joints().size(); ++i) {
    const Joint& joint = mechanism_.joints()[i];
    if (joint.bushing.parts.empty()) continue;
    const int k = static_cast<int>(i);
    const BushingStrain s = strain(k, motion);
    const std::size_t first = mechanism_.memory_of_joint(k);
    forces_in_motion(s,
                     rates_of(s, rate_of(motion, joint.a), rate_of(motion, joint.b)),
                     joint.bushing,
                     motion.share,
                     before.data() + first,
                     motion.step,
                     kept.data() + first);
  }
  std::vector<LineGeometry> lines;
  for (std::size_t i = 0; i < mechanism_.struts().size(); ++i)
    if (!mechanism_.struts()[i].parts.empty())
      answer(static_cast<int>(i),
             motion,
             kept.data() + mechanism_.memory_of_strut(static_cast<int>(i)),
             lines);
}

Vector6d Assembly::joint_load(int i, const Motion& motion) const {
  const Joint& joint = mechanism_.joints()[at(i)];
  const BushingStrain s = strain(i, motion);
  const Memories& memories = motion.memories ? *motion.memories : none_;
  const BushingForces forces =
      forces_in_motion(s,
                       rates_of(s, rate_of(motion, joint.a), rate_of(motion, joint.b)),
                       joint.bushing,
                       0.0,
                       memories.data() + mechanism_.memory_of_joint(i),
                       motion.step,
                       nullptr);
  Vector6d load;
  load << -(s.axes * forces.f.head<3>()), -(s.axes * (s.N.transpose() * forces.f.tail<3>()));
  return load;
}

double Assembly::strut_force(int strut, const Motion& motion) const {
  std::vector<LineGeometry> lines;
  return answer(strut, motion, nullptr, lines).force;
}

double Assembly::extension(int i, const Poses& poses) const {
  const Strut& strut = mechanism_.struts()[at(i)];
  double e = -mechanism_.rest_length(i);
  for (std::size_t l = 0; l < strut.lines.size(); ++l) {
    const auto& [in_a, in_b] = mechanism_.ends(i, static_cast<int>(l));
    const StrutLine& line = strut.lines[l];
    e += line.weight * (pose(poses, line.b).at(in_b) - pose(poses, line.a).at(in_a)).norm();
  }
  return e;
}

double Assembly::potential_energy(const Motion& motion) const {
  double sum = 0.0;
  const Memories& memories = motion.memories ? *motion.memories : none_;
  for (std::size_t i = 0; i < mechanism_.joints().size(); ++i)
    sum += energy(strain(static_cast<int>(i), motion),
                  mechanism_.joints()[i].bushing,
                  memories.data() + mechanism_.memory_of_joint(static_cast<int>(i)));
  for (std::size_t i = 0; i < mechanism_.struts().size(); ++i) {
    const Strut& strut = mechanism_.struts()[i];
    const int k = static_cast<int>(i);
    const double e = extension(k, motion.poses) - driver_of(motion, strut.driver);
    sum += e * (strut.preload + 0.5 * strut.stiffness * e);
    for (std::size_t p = 0; p < strut.parts.size(); ++p)
      sum += stored_energy(strut.parts[p], e, memories[mechanism_.memory_of_strut(k) + p]);
  }
  for (std::size_t i = 0; i < mechanism_.bodies().size(); ++i) {
    const Body& body = mechanism_.bodies()[i];
    sum -= body.mass * mechanism_.gravity().dot(motion.poses[i].place - body.origin);
  }
  return sum;
}

double Assembly::kinetic_energy(const Poses& poses, const Eigen::VectorXd& rates) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < mechanism_.bodies().size(); ++i) {
    const Body& body = mechanism_.bodies()[i];
    const Vector6d rate = rates.segment<6>(6 * static_cast<Eigen::Index>(i));
    sum += 0.5 * body.mass * rate.head<3>().squaredNorm() +
           0.5 * rate.tail<3>().dot(turned_inertia(body, poses[i]) * rate.tail<3>());
  }
  return sum;
}

std::string Assembly::most_turned(const Poses& poses) const {
  double most = -1.0;
  std::size_t which = 0;
  for (std::size_t i = 0; i < mechanism_.joints().size(); ++i) {
    const double turned = strain(static_cast<int>(i), {.poses = poses}).q.lpNorm<Eigen::Infinity>();
    if (turned > most) {
      most = turned;
      which = i;
    }
  }
  if (mechanism_.joints().empty()) return "no bushing is there";
  return fmt::format("{} is turned most, by {:.3g} deg",
                     mechanism_.joints()[which].name,
                     most * 180.0 / std::numbers::pi);
}

double Assembly::rounding(const Poses& poses) const {
  // Factors of the rounding unit for the error of a sum of forces: at a coordinate of the position
  // at rest, and at a displacement. A body that has moved far has many joints there, so its error
  // is larger: on a car that is 50 m away from its line, up to 8 digits of the forces are lost.
  // Displacements below half a meter matter less than the coordinates at rest.
  constexpr double kAtRest = 4.0, kMoved = 32.0, kNear = 0.5;
  double stiffest = 0.0, far = 0.0, moved = 0.0;
  for (const Joint& joint : mechanism_.joints()) {
    stiffest = std::max(stiffest, joint.bushing.stiffness.maxCoeff());
    far = std::max(far, joint.point.lpNorm<Eigen::Infinity>());
  }
  for (std::size_t i = 0; i < poses.size(); ++i)
    moved =
        std::max(moved, (poses[i].place - mechanism_.bodies()[i].origin).lpNorm<Eigen::Infinity>());
  const double digits = std::max(kAtRest * far, moved > kNear ? kMoved * moved : 0.0);
  return std::numeric_limits<double>::epsilon() * stiffest * digits;
}

}  // namespace latsch::multibody
