// SPDX-License-Identifier: Apache-2.0
// Compares statics of the cases that Simbody also reads with Simbody's results: those committed,
// and those it prints now if it is installed.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <numbers>

#include "models/multibody/equilibrium.h"
#include "models/suspension/suspension_reader.h"
#include "models/suspension/wheel_position.h"
#include "simbody/case_file.h"
#include "simbody/oracle_figures.h"

namespace latsch::verification {
namespace {

using Eigen::Vector3d;
using namespace multibody;

// Tolerance, m, rad, J. In both programs the residuals are below 1e-7 N and the stiffnesses of
// bushings and tires at least 1e5 N/m, so positions agree within 1e-12 m. Energies agree within
// that times loads of some kN.
constexpr double kSame = 1e-10;  // m, rad, J

std::string folder(const std::string& file) { return LATSCH_SIMBODY_CASES "/" + file; }

/// Results by load case, kind and name. The kinds are "point" (displacement), "rotation" (rotation
/// vector of a body) and "energy" (of all bushings, J, in the first of the three numbers).
using Moved = std::map<std::array<std::string, 3>, Vector3d>;

Moved moved(const Figures& figures) {
  Moved moved;
  for (std::size_t i = 0; i < figures.rows.size(); ++i) {
    const std::vector<std::string>& row = figures.rows[i];
    moved[{row[0], row[1], row[2]}] = {
        figures.number(i, 3), figures.number(i, 4), figures.number(i, 5)};
  }
  return moved;
}

double energy_of_bushings(const CaseFile& file, const Poses& poses) {
  const Mechanism mechanism(file.bodies, file.joints);
  const auto pose = [&](int body) {
    return body == kGround ? Pose() : poses[static_cast<std::size_t>(body)];
  };
  double sum = 0.0;
  for (std::size_t i = 0; i < file.joints.size(); ++i) {
    const Joint& joint = file.joints[i];
    sum += energy(strain_of(mechanism.place(static_cast<int>(i)), pose(joint.a), pose(joint.b)),
                  joint.bushing);
  }
  return sum;
}

Moved moved_by_us(const CaseFile& file) {
  const Mechanism mechanism(file.bodies, joints_in_statics(file));
  Equilibrium statics(mechanism, {.force = 1e-7});
  Moved moved;
  for (const LoadCase& one : file.load_cases) {
    const auto poses = statics.solve(loads_of(file, one));
    if (!poses) {
      ADD_FAILURE() << one.name << ": " << poses.failure().reason;
      continue;
    }
    moved[{one.name, "energy", "bushings"}] = {energy_of_bushings(file, *poses), 0.0, 0.0};
    for (const OutputPoint& output : file.outputs)
      moved[{one.name, "point", output.name}] = displacement(file, output, *poses);
    for (std::size_t i = 0; i < file.bodies.size(); ++i) {
      const Eigen::AngleAxisd turn((*poses)[i].turn);
      moved[{one.name, "rotation", file.bodies[i].name}] = turn.angle() * turn.axis();
    }
  }
  return moved;
}

/// Returns the work, J, of the load of a case as the load grows from zero in equal steps.
double work(const CaseFile& file, const LoadCase& load_case, int steps) {
  const Mechanism mechanism(file.bodies, file.joints);
  Equilibrium statics(mechanism, {.force = 1e-7});
  const Load& load = load_case.loads.at(0);
  const std::size_t body = static_cast<std::size_t>(load.body);
  const Vector3d arm = load.point - file.bodies[body].origin;
  Pose before = mechanism.at_rest()[body];
  double work = 0.0;
  for (int i = 1; i <= steps; ++i) {
    Load part = load;
    part.force *= static_cast<double>(i) / steps;
    part.moment *= static_cast<double>(i) / steps;
    const Pose now = (*statics.solve({&part, 1}))[body];
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(now.turn * before.turn.transpose()));
    const double share = (i - 0.5) / steps;
    work += share * (load.force.dot(now.at(arm) - before.at(arm)) +
                     load.moment.dot(turn.angle() * turn.axis()));
    before = now;
  }
  return work;
}

void expect_same(const Moved& found, const Moved& expected, double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [of, by] : expected) {
    const auto place = found.find(of);
    ASSERT_NE(place, found.end()) << of[0] << " " << of[1] << " " << of[2];
    EXPECT_LT((place->second - by).lpNorm<Eigen::Infinity>(), tolerance)
        << of[0] << " " << of[1] << " " << of[2];
  }
}

TEST(SimbodyStatics, CornerStandsWhereSimbodyPutsItUnderFiveLoadsAndTwentyAtRandom) {
  const CaseFile file = read_case_file(folder("fsae_corner.json"));
  ASSERT_EQ(file.load_cases.size(), 25u);
  ASSERT_EQ(Mechanism::fault(file.bodies, file.joints), "");
  expect_same(moved_by_us(file), moved(read_figures(folder("fsae_corner_simbody.csv"))), kSame);
}

TEST(SimbodyStatics, CarStandsWhereSimbodyPutsIt) {
  const CaseFile file = read_case_file(folder("car_21_bodies.json"));
  ASSERT_EQ(file.bodies.size(), 21u);
  ASSERT_EQ(file.joints.size(), 40u);
  expect_same(
      moved_by_us(file), moved(read_figures(folder("car_21_bodies_rest_simbody.csv"))), kSame);
}

// The study's file, as the K&C rig of the program reads it, gives the same corner as the case file
// of the oracle.
TEST(SimbodyStatics, FiveLinksStandWhereSimbodyPutsThem) {
  const CaseFile file = read_case_file(folder("five_links.json"));
  ASSERT_EQ(file.load_cases.size(), 15u);
  const Moved simbodys = moved(read_figures(folder("five_links_simbody.csv")));
  expect_same(moved_by_us(file), simbodys, kSame);
  const auto corner = suspension::read_corner(
      Document::read(LATSCH_SIMBODY_CASES "/../../studies/suspensions/five_link_rear.toml").root());
  ASSERT_TRUE(corner.compliant);
  const auto& [bodies, joints, upright, wheel_center, contact, points] = *corner.compliant;
  const Mechanism mechanism(bodies, joints);
  Equilibrium statics(mechanism, {.force = 1e-7});
  for (const LoadCase& one : file.load_cases) {
    const Load load{upright, contact, one.loads[0].force, one.loads[0].moment};
    const auto poses = statics.solve({&load, 1});
    ASSERT_TRUE(poses) << one.name << ": " << poses.failure().reason;
    const Pose& now = (*poses)[static_cast<std::size_t>(upright)];
    const Vector3d travel = now.at(points.contact) - contact;
    EXPECT_LT((travel - simbodys.at({one.name, "point", "contact"})).norm(), kSame) << one.name;
    const Eigen::AngleAxisd turn(now.turn);
    EXPECT_LT((turn.angle() * turn.axis() - simbodys.at({one.name, "rotation", "upright"})).norm(),
              kSame)
        << one.name;
  }
}

// dx, dy, dz in mm; camber, toe-in and caster in deg. These are the figures of corner_test.cpp, on
// which two other programs agree.
const std::map<std::string, std::array<double, 6>> kPrinted = {
    {"Fz +5 kN", {0.50025, 0.19826, 1.28328, -0.05050, -0.05471, 0.09804}},
    {"Fy -4 kN", {0.02265, -0.56246, -0.16064, 0.07710, 0.33106, -0.02222}},
    {"Fx -4 kN", {-2.09541, 0.02029, -0.38792, 0.01553, -0.16255, -0.39332}},
    {"Mz +200 Nm", {-0.14040, 0.28764, 0.03827, 0.00779, -0.52194, 0.01273}}};

std::array<double, 6> wheel(const CaseFile& file, const Moved& moved, const std::string& of) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const auto at_rest = [&](const std::string& name) {
    for (const OutputPoint& one : file.outputs)
      if (one.name == name) return one.point;
    ADD_FAILURE() << "there is no output " << name;
    return Vector3d(Vector3d::Zero());
  };
  const Vector3d center = at_rest("wheel_center");
  const suspension::WheelPoints points{.contact = at_rest("contact") - center,
                                       .center = Vector3d::Zero(),
                                       .lower_ball_joint = at_rest("lbj") - center,
                                       .upper_ball_joint = at_rest("ubj") - center};
  const Vector3d turn = moved.at({of, "rotation", "upright"});
  const Pose upright{center + moved.at({of, "point", "wheel_center"}),
                     Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()};
  const suspension::WheelPosition now = wheel_position(points, upright),
                                  rest = wheel_position(points, {.place = center});
  const Vector3d d = 1e3 * (now.contact - rest.contact);
  return {d.x(),
          d.y(),
          d.z(),
          (now.camber - rest.camber) / kDegree,
          (now.toe - rest.toe) / kDegree,
          (now.caster - rest.caster) / kDegree};
}

// The load grows in n steps. Its work by the trapezoidal rule has an error of order 2 in 1/n;
// extrapolation removes this term and leaves order 4. With 16 steps the relative error is about
// 1e-12.
TEST(SimbodyStatics, EnergyOfTheBushingsIsTheWorkOfTheLoad) {
  const CaseFile file = read_case_file(folder("fsae_corner.json"));
  const Moved simbodys = moved(read_figures(folder("fsae_corner_simbody.csv")));
  for (const LoadCase& one : file.load_cases) {
    const double energy = simbodys.at({one.name, "energy", "bushings"}).x();
    const double coarse = work(file, one, 8), fine = work(file, one, 16);
    const double work = fine + (fine - coarse) / 3.0;
    EXPECT_NEAR(work, energy, 1e-10 * energy) << one.name;
  }
}

TEST(SimbodyStatics, BothGiveThePrintedDigits) {
  const CaseFile file = read_case_file(folder("fsae_corner.json"));
  const Moved ours = moved_by_us(file),
              simbodys = moved(read_figures(folder("fsae_corner_simbody.csv")));
  for (const auto& [of, printed] : kPrinted)
    for (std::size_t i = 0; i < printed.size(); ++i) {
      EXPECT_NEAR(wheel(file, ours, of)[i], printed[i], 0.5e-5 + 1e-9) << of << " " << i;
      EXPECT_NEAR(wheel(file, simbodys, of)[i], printed[i], 0.5e-5 + 1e-9) << of << " " << i;
    }
}

TEST(SimbodyStatics, CommittedFiguresAreThoseItPrintsToday) {
  for (const std::array<std::string, 2>& one :
       {std::array<std::string, 2>{"fsae_corner.json", "fsae_corner_simbody.csv"},
        {"five_links.json", "five_links_simbody.csv"},
        {"car_21_bodies.json", "car_21_bodies_rest_simbody.csv"}}) {
    const auto today = figures_of_oracle("statics '" + folder(one[0]) + "'");
    if (!today) GTEST_SKIP() << "Simbody (libsimbody-dev) is not installed: no oracle was built";
    expect_same(moved(*today), moved(read_figures(folder(one[1]))), 1e-11);
  }
}

}  // namespace
}  // namespace latsch::verification
