// SPDX-License-Identifier: Apache-2.0
#include "models/car/car_mechanism.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace latsch::car {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using multibody::Body;
using multibody::BodyMass;
using multibody::Joint;
using multibody::Strut;
using suspension::DoubleWishbone;

Vector3d mirrored(const Vector3d& p) { return {p.x(), -p.y(), p.z()}; }

Matrix3d mirrored(const Matrix3d& inertia) {
  const Matrix3d S = Vector3d(1.0, -1.0, 1.0).asDiagonal();
  return S * inertia * S;
}

Vector3d at_side(bool left, const Vector3d& p) { return left ? p : mirrored(p); }

DoubleWishbone corner_of(const Axle& axle, bool left) {
  DoubleWishbone corner = axle.corner;
  if (left) return corner;
  for (Vector3d& point : corner.points) point = mirrored(point);
  corner.wheel_center = mirrored(corner.wheel_center);
  corner.contact = mirrored(corner.contact);
  corner.side = suspension::Side::right;
  return corner;
}

Body body_of(std::string name, const BodyMass& mass) {
  return {std::move(name), mass.center, mass.mass, mass.inertia};
}

/// Returns a rotation matrix whose third column is the unit vector `axis`.
Matrix3d axes_about(const Vector3d& axis) {
  return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix();
}

class Builder {
 public:
  explicit Builder(const CarParameters& parameters) : car_(parameters) {
    add_chassis();
    for (int corner = 0; corner < kCorners; ++corner) add_corner(corner);
    add_axle(car_.front, kFL, "front");
    add_axle(car_.rear, kRL, "rear");
  }

  CarMechanism build() {
    return {multibody::Mechanism(std::move(bodies_),
                                 std::move(joints_),
                                 std::move(struts_),
                                 kDrivers,
                                 {0.0, 0.0, -car_.gravity}),
            parts_};
  }
  std::string fault() const {
    if (std::string fault = multibody::Mechanism::fault(bodies_, joints_, struts_, kDrivers);
        !fault.empty())
      return fault;
    return multibody::Mechanism::fault_in_motion(bodies_);
  }

 private:
  void add_chassis() {
    const Chassis& chassis = car_.chassis;
    if (!chassis.torsion) {
      bodies_.push_back(body_of("the chassis", chassis.body));
      return;
    }
    // The two halves of the chassis together have the mass, center and inertia of the whole. The
    // distance between the centers of the halves accounts for four fifths of the whole's moments of
    // inertia about y and z; the rest is the inertia of each half.
    const Vector3d I = chassis.body.inertia.diagonal();
    const double front = car_.front.corner.wheel_center.x(),
                 rear = car_.rear.corner.wheel_center.x(), center = chassis.body.center.x();
    const double share = (center - rear) / (front - rear);
    const double spared = 0.8 * std::min({I.y(), I.z(), 0.5 * (I.y() + I.z() - I.x())});
    const double apart =
        std::min(front - rear, std::sqrt(spared / (chassis.body.mass * share * (1.0 - share))));
    const auto half = [&](double part, double x) -> BodyMass {
      BodyMass mass;
      mass.mass = part * chassis.body.mass;
      mass.center = {x, chassis.body.center.y(), chassis.body.center.z()};
      const double away = chassis.body.mass * share * (1.0 - share) * apart * apart;
      Matrix3d own = chassis.body.inertia;
      own(1, 1) -= away;
      own(2, 2) -= away;
      mass.inertia = part * own;
      return mass;
    };
    bodies_.push_back(
        body_of("the front of the chassis", half(share, center + (1.0 - share) * apart)));
    bodies_.push_back(
        body_of("the rear of the chassis", half(1.0 - share, center - share * apart)));
    parts_.chassis_rear = 1;
    const Chassis::Torsion& torsion = *chassis.torsion;
    constexpr double kRigid = 1e9, kRigidTurn = 1e8, kTime = 1e-4;  // N/m, N m/rad, s
    multibody::BushingParameters joint{Vector3d::Constant(kRigid),
                                       {torsion.stiffness, kRigidTurn, kRigidTurn}};
    joint.damping = kTime * joint.stiffness;
    joint.rotational_damping = {torsion.damping, kTime * kRigidTurn, kTime * kRigidTurn};
    joints_.push_back({"chassis_torsion", 0, 1, {torsion.x, 0.0, torsion.z}, joint});
  }

  void add_corner(int which) {
    const Axle& axle = is_front(which) ? car_.front : car_.rear;
    const bool left = is_left(which);
    const DoubleWishbone corner = corner_of(axle, left);
    const std::string name = kCornerNames[static_cast<std::size_t>(which)];
    const int chassis = is_front(which) ? parts_.chassis : parts_.chassis_rear;
    const int first = static_cast<int>(bodies_.size());
    add_links(corner, axle.masses, name);
    add_upright(corner, axle, left, name);
    CornerParts& parts = parts_.corners[static_cast<std::size_t>(which)];
    parts.upright = first + DoubleWishbone::kUpright;
    parts.pushrod = first + DoubleWishbone::kPushrod;
    int rocker = chassis;
    if (axle.inboard) rocker = add_rocker(corner, *axle.inboard, left, chassis, name, parts);
    parts.first_joint = static_cast<int>(joints_.size());
    const auto joints = corner.joints();
    for (int j = 0; j < DoubleWishbone::kJoints; ++j) {
      Joint joint = joints[static_cast<std::size_t>(j)];
      joint.name = name + "_" + joint.name;
      const bool inboard = joint.a == multibody::kGround;
      joint.a = inboard ? chassis : first + joint.a;
      joint.b += first;
      if (j == DoubleWishbone::kPushrodInner) {
        joint.a = rocker;
        parts.pushrod_joint = static_cast<int>(joints_.size());
      }
      if (j == DoubleWishbone::kTrackrodInner && axle.steered) {
        joint.driver = kRackDriver;
        joint.along = Vector3d::UnitY();
      }
      joints_.push_back(std::move(joint));
    }
    parts.wheel_center = corner.wheel_center;
    parts.contact = corner.contact;
    parts.pushrod_inner = corner.points[DoubleWishbone::kPushrodInner];
    parts.pushrod_outer = corner.points[DoubleWishbone::kPushrodOuter];
    const double side = left ? 1.0 : -1.0;
    parts.wheel_axes = (Eigen::AngleAxisd(-side * axle.toe, Vector3d::UnitZ()) *
                        Eigen::AngleAxisd(-side * axle.camber, Vector3d::UnitX()))
                           .toRotationMatrix();
    const Vector3d origin = bodies_[static_cast<std::size_t>(parts.upright)].origin;
    parts.points = corner.wheel();
    for (Vector3d* p : {&parts.points.contact,
                        &parts.points.center,
                        &parts.points.lower_ball_joint,
                        &parts.points.upper_ball_joint})
      *p += corner.wheel_center - origin;
  }

  void add_links(const DoubleWishbone& c, const AxleMasses& masses, const std::string& name) {
    const auto rod = [&](DoubleWishbone::Joint i, DoubleWishbone::Joint j) {
      return std::pair{c.points[i], c.points[j]};
    };
    const double r = masses.rod_radius;
    using W = DoubleWishbone;
    bodies_.push_back(body_of(
        "the upper wishbone " + name,
        multibody::mass_of_rods(
            {rod(W::kUcaFront, W::kUbj), rod(W::kUcaRear, W::kUbj)}, masses.upper_wishbone, r)));
    bodies_.push_back(body_of(
        "the lower wishbone " + name,
        multibody::mass_of_rods(
            {rod(W::kLcaFront, W::kLbj), rod(W::kLcaRear, W::kLbj)}, masses.lower_wishbone, r)));
    // The mass of the upright is set below.
    bodies_.push_back({"the upright " + name, c.wheel_center});
    bodies_.push_back(body_of(
        "the push-rod " + name,
        multibody::mass_of_rods({rod(W::kPushrodInner, W::kPushrodOuter)}, masses.pushrod, r)));
    bodies_.push_back(body_of(
        "the track-rod " + name,
        multibody::mass_of_rods({rod(W::kTrackrodInner, W::kTrackrodOuter)}, masses.trackrod, r)));
  }

  void add_upright(const DoubleWishbone& corner,
                   const Axle& axle,
                   bool left,
                   const std::string& name) {
    BodyMass upright = axle.masses.upright;
    upright.center = corner.wheel_center + at_side(left, upright.center);
    if (!left) upright.inertia = mirrored(upright.inertia);
    const double across = axle.masses.wheel_across;
    // The wheel spins freely about y, so it adds no inertia about y to the upright.
    const BodyMass wheel{
        axle.masses.wheel, corner.wheel_center, Vector3d(across, 0.0, across).asDiagonal()};
    bodies_[bodies_.size() - 5 + DoubleWishbone::kUpright] =
        body_of("the upright " + name, multibody::together(upright, wheel));
  }

  int add_rocker(const DoubleWishbone& corner,
                 const Inboard& inboard,
                 bool left,
                 int chassis,
                 const std::string& name,
                 CornerParts& parts) {
    const int rocker = static_cast<int>(bodies_.size());
    const Vector3d pivot = at_side(left, inboard.pivot), damper = at_side(left, inboard.damper),
                   rod = corner.points[DoubleWishbone::kPushrodInner];
    bodies_.push_back(body_of(
        "the rocker " + name,
        multibody::mass_of_rods({{pivot, rod}, {pivot, damper}}, inboard.rocker_mass, 0.01)));
    // Arm, m, that converts a translational stiffness to one against tilting. If the push-rod has
    // rigid joints, the rocker's bearing must not be softer than these.
    constexpr double kTiltArm = 0.03;
    const multibody::BushingParameters& joint = corner.bushings[DoubleWishbone::kPushrodInner];
    const double stiff = joint.rigid ? std::max(inboard.bearing, joint.stiffness.maxCoeff())
                                     : inboard.bearing,
                 tilt = joint.rigid ? std::max(inboard.bearing_tilt, kTiltArm * kTiltArm * stiff)
                                    : inboard.bearing_tilt;
    multibody::BushingParameters bearing{Vector3d::Constant(stiff), {tilt, tilt, 0.0}};
    bearing.damping = inboard.bearing_damping * bearing.stiffness;
    bearing.rotational_damping = inboard.bearing_damping * bearing.rotational;
    joints_.push_back({name + "_rocker",
                       chassis,
                       rocker,
                       pivot,
                       bearing,
                       axes_about(at_side(left, inboard.axis))});
    parts.unit = static_cast<int>(struts_.size());
    struts_.push_back(
        strut_of("the spring unit " + name,
                 inboard.unit,
                 {{chassis, rocker, at_side(left, inboard.damper_on_chassis), damper, 1.0}}));
    rockers_[is_front(static_cast<int>(&parts - parts_.corners.data())) ? 0 : 1][left ? 0 : 1] =
        rocker;
    return rocker;
  }

  static Strut strut_of(std::string name,
                        const SpringUnit& unit,
                        std::vector<multibody::StrutLine> lines) {
    return {.name = std::move(name),
            .lines = std::move(lines),
            .stiffness = unit.stiffness,
            .damping = unit.damping,
            .inertance = unit.inertance,
            .parts = unit.parts};
  }

  void add_axle(const Axle& axle, int left, const std::string& name) {
    if (!axle.inboard) return;
    const Inboard& inboard = *axle.inboard;
    const auto& rockers = rockers_[is_front(left) ? 0 : 1];
    const int chassis = is_front(left) ? parts_.chassis : parts_.chassis_rear;
    const auto both = [&](const Vector3d& on_chassis,
                          const Vector3d& on_rocker,
                          double right) -> std::vector<multibody::StrutLine> {
      return {{chassis, rockers[0], on_chassis, on_rocker, 1.0},
              {chassis, rockers[1], mirrored(on_chassis), mirrored(on_rocker), right}};
    };
    if (inboard.bar)
      struts_.push_back(strut_of("the " + name + " anti-roll bar",
                                 {.stiffness = inboard.bar->stiffness},
                                 both(inboard.bar->blade, inboard.bar->link, -1.0)));
    if (inboard.heave)
      struts_.push_back(strut_of("the " + name + " heave element",
                                 *inboard.heave,
                                 both(inboard.damper_on_chassis, inboard.damper, 1.0)));
  }

  const CarParameters& car_;
  std::vector<Body> bodies_;
  std::vector<Joint> joints_;
  std::vector<Strut> struts_;
  CarParts parts_;
  std::array<std::array<int, 2>, 2> rockers_{};  // index 1: front, rear; index 2: left, right
};

}  // namespace

CarMechanism build(const CarParameters& parameters) { return Builder(parameters).build(); }

namespace {

std::string fault_of_chassis(const CarParameters& car) {
  const Chassis& chassis = car.chassis;
  if (!(chassis.body.mass > 0.0)) return "the chassis has no mass";
  const double f = car.front.corner.wheel_center.x(), r = car.rear.corner.wheel_center.x();
  const Vector3d& c = chassis.body.center;
  if (!(r < c.x() && c.x() < f))
    return fmt::format(
        "the center of mass of the chassis, x = {:.6g} m, is not between the axles at {:.6g} m and "
        "{:.6g} m: the car would tip over",
        c.x(),
        r,
        f);
  if (const double track = 2.0 * car.front.corner.contact.y(); !(c.z() < f - r + track))
    return fmt::format(
        "the center of mass of the chassis, z = {:.6g} m, is higher than the car is long and wide: "
        "are its numbers millimeters?",
        c.z());
  if (!chassis.torsion) return {};
  if (!(chassis.torsion->stiffness > 0.0)) return "the torsion of the chassis has no stiffness";
  return {};
}

}  // namespace

std::string CarParameters::fault() const {
  for (const auto& [axle, name] : {std::pair{&front, "front"}, {&rear, "rear"}}) {
    if (std::string fault = axle->corner.fault(); !fault.empty())
      return fmt::format("{} suspension: {}", name, fault);
    if (!(axle->masses.wheel_spin > 0.0))
      return fmt::format("the {} wheels have no moment of inertia about their axis (wheel_spin)",
                         name);
    if (axle->corner.side != suspension::Side::left)
      return fmt::format("the {} suspension is a right one: a car is described by its left side",
                         name);
    if (axle->inboard && !(axle->inboard->unit.stiffness > 0.0) && !axle->inboard->heave &&
        axle->inboard->unit.parts.empty())
      return fmt::format("the {} axle has no spring", name);
  }
  if (!(front.corner.wheel_center.x() > rear.corner.wheel_center.x()))
    return "the front axle is not in front of the rear one: x points forward";
  if (std::string fault = fault_of_chassis(*this); !fault.empty()) return fault;
  return Builder(*this).fault();
}

}  // namespace latsch::car
