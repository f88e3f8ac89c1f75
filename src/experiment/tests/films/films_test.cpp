// SPDX-License-Identifier: Apache-2.0
// Tests that a page shows what the test computes: forces balance the loads, a linkage that can be
// calculated by hand has the calculated forces, and the wheel loads of a run equal its channels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiment/kinds/pictures/films_of_tests.h"
#include "experiment/language.h"
#include "experiment/tests/films/car_film.h"
#include "experiment/tests/films/rig_film.h"
#include "experiment/tests/films/road_surface.h"
#include "models/road/kerb.h"
#include "models/road/plane_road.h"
#include "models/suspension/corner_testing.h"
#include "report/scene.h"

namespace latsch::experiment {
namespace {

using Eigen::Vector3d;
using report::Scene;
using suspension::DoubleWishbone;

const std::filesystem::path kFilmedStudies = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies";

/// Returns a corner with level wishbones at z = 0.4 and 0.2, a vertical push-rod on the upper one,
/// and a level track-rod in the middle. The parts are nearly rigid, and the joints do not resist
/// rotation.
DoubleWishbone level_corner() {
  DoubleWishbone corner;
  corner.points = {{{0.15, 0.3, 0.4},
                    {-0.15, 0.3, 0.4},
                    {0.15, 0.3, 0.2},
                    {-0.15, 0.3, 0.2},
                    {0.0, 0.6, 0.4},
                    {0.0, 0.6, 0.2},
                    {0.0, 0.55, 0.8},
                    {0.0, 0.55, 0.4},
                    {-0.1, 0.3, 0.3},
                    {-0.1, 0.6, 0.3}}};
  corner.bushings.fill({Vector3d::Constant(1e9), Vector3d::Constant(1e-3)});
  corner.wheel_center = {0.0, 0.7, 0.3};
  corner.contact = {0.0, 0.7, 0.0};
  return corner;
}

struct Filmed {
  Scene scene;
  const Scene::Sequence& sequence() const { return scene.sequences.front(); }
  std::size_t arrow(const std::string& name) const {
    const auto& arrows = sequence().arrows;
    const auto found = std::find_if(
        arrows.begin(), arrows.end(), [&](const Scene::Arrow& one) { return one.name == name; });
    EXPECT_NE(found, arrows.end()) << name;
    return static_cast<std::size_t>(found - arrows.begin());
  }
  Vector3d force(std::size_t step, const std::string& name) const {
    return sequence().steps[step].vectors.col(static_cast<Eigen::Index>(arrow(name)));
  }
  double tension(std::size_t step, const std::string& name) const {
    return sequence().steps[step].field[sequence().arrows[arrow(name)].point];
  }
};

Filmed filmed(const DoubleWishbone& corner, const KcTest& test, int most_steps = 25) {
  const auto fz = test.loads.row(2);
  RigFilm film({"Fz", "N", {fz.begin(), fz.end()}}, most_steps);
  EXPECT_TRUE(run(suspension::compliant_corner(corner), test, {}, film.watcher()));
  Filmed filmed;
  film.add_to(filmed.scene, "test");
  return filmed;
}

KcTest loaded(const std::vector<multibody::Vector6d>& loads) {
  KcTest test;
  test.loads.resize(6, std::ssize(loads));
  for (std::size_t k = 0; k < loads.size(); ++k)
    test.loads.col(static_cast<Eigen::Index>(k)) = loads[k];
  test.stated.fill(true);
  return test;
}

// Equilibrium of the upright under Fy and Fz at the contact point, with the forces U, L and T of
// upper and lower ball joint and track-rod. The lower ball joint has no vertical force, because its
// wishbone rotates freely:
//    -0.2 U_y + 0.1 F_z + 0.2 F_y = 0,  U_y + L_y + F_y = 0,  U_z + F_z = 0,  T_y = 0
// The moments of the upper wishbone about its axis give the force P of the push-rod: 0.3 F_z + 0.25
// P = 0. Compliance moves points by 1e-5 of the lengths.
TEST(RigFilm, ForcesOfALevelLinkageAreThoseWorkedOutByHand) {
  multibody::Vector6d load;
  load << 0.0, 1000.0, 2000.0, 0.0, 0.0, 0.0;
  const Filmed film = filmed(level_corner(), loaded({load}));
  ASSERT_EQ(film.sequence().steps.size(), 1u);
  constexpr double kNear = 0.2;  // N
  // Forces on the wishbones are opposite to those on the upright.
  EXPECT_LT((film.force(0, "ubj") + Vector3d(0.0, 2000.0, -2000.0)).norm(), kNear);
  EXPECT_LT((film.force(0, "lbj") + Vector3d(0.0, -3000.0, 0.0)).norm(), kNear);
  EXPECT_LT(film.force(0, "trackrod_outer").norm(), kNear);
  EXPECT_NEAR(film.tension(0, "ubj"), -2000.0, kNear);
  EXPECT_NEAR(film.tension(0, "lbj"), 3000.0, kNear);
  EXPECT_NEAR(film.tension(0, "pushrod_inner"), -2400.0, kNear);
  EXPECT_NEAR(film.tension(0, "pushrod_outer"), -2400.0, kNear);
  // Each leg has half of the lower wishbone's 3000 N, over the direction cosine of the leg.
  const double along = 1500.0 * 0.3 / std::hypot(0.3, 0.15);
  EXPECT_NEAR(film.tension(0, "lca_front"), along, kNear);
  EXPECT_NEAR(film.tension(0, "lca_rear"), along, kNear);
  EXPECT_EQ(film.force(0, "load on the wheel"), load.head<3>());
}

// Equilibrium is checked in the displaced position, including the moments that the bushings
// transmit.
TEST(RigFilm, JointsOfTheUprightBalanceItsLoad) {
  multibody::Vector6d first, second;
  first << -3000.0, 1500.0, 4000.0, 20.0, -10.0, 80.0;
  second << 500.0, -2500.0, 2500.0, 0.0, 0.0, -120.0;
  const KcTest test = loaded({first, second});
  std::vector<double> moments;
  RigFilm film({"Fz", "N", {4000.0, 2500.0}}, 25);
  const RigWatcher watch = film.watcher();
  const auto done = run(
      suspension::compliant_corner(suspension::race_corner()),
      test,
      {},
      [&](const RigState& state) {
        watch(state);
        const multibody::Motion motion{.poses = state.rest.poses, .memories = &state.rest.memories};
        const auto at = [&](int body, const Vector3d& point) -> Vector3d {
          const auto k = static_cast<std::size_t>(body);
          return state.rest.poses[k].at(point - state.mechanism.bodies()[k].origin);
        };
        Vector3d moment =
            at(state.loads[0].body, state.loads[0].point).cross(state.loads[0].force) +
            state.loads[0].moment;
        for (std::size_t j = 0; j < state.mechanism.joints().size(); ++j) {
          const multibody::Joint& joint = state.mechanism.joints()[j];
          if (joint.b != state.wheels[0].upright) continue;
          const auto wrench = state.assembly.joint_load(static_cast<int>(j), motion);
          moment += at(joint.b, joint.point).cross(wrench.head<3>()) + wrench.tail<3>();
        }
        moments.push_back(moment.norm());
      });
  ASSERT_TRUE(done);
  Filmed seen;
  film.add_to(seen.scene, "test");
  ASSERT_EQ(seen.sequence().steps.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector3d left = seen.force(k, "ubj") + seen.force(k, "lbj") +
                          seen.force(k, "trackrod_outer") -
                          test.loads.col(static_cast<Eigen::Index>(k)).head<3>();
    EXPECT_LT(left.norm(), 1e-4) << k;  // N, residual of the equilibrium for sums of 1e4 N
    EXPECT_LT(moments[k], 1e-4) << k;
    EXPECT_EQ(seen.sequence().steps[k].at, test.loads(2, static_cast<Eigen::Index>(k)));
  }
  // The contact point has moved according to the channels.
  const auto at = seen.sequence().arrows[seen.arrow("load on the wheel")].point;
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector3d moved =
        seen.sequence().steps[k].points.col(at) - seen.scene.meshes[0].points.col(at);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(moved[axis], (*done)[KcTest::kMoved[static_cast<std::size_t>(axis)]][k], 1e-12);
  }
}

TEST(RigFilm, KeepsStatesEvenlyWithFirstAndLast) {
  std::vector<multibody::Vector6d> loads(40, multibody::Vector6d::Zero());
  for (std::size_t k = 0; k < loads.size(); ++k) loads[k][2] = 100.0 * static_cast<double>(k);
  const Filmed film = filmed(suspension::race_corner(), loaded(loads), 9);
  ASSERT_EQ(film.sequence().steps.size(), 9u);
  EXPECT_EQ(film.sequence().steps.front().at, 0.0);
  EXPECT_EQ(film.sequence().steps.back().at, 3900.0);
  EXPECT_EQ(film.sequence().name, "test (9 of them shown, evenly spaced)");
}

TEST(Films, SayHowManyTestsHaveNone) {
  const SpecimenKind& kind = *language().find_kind("car");
  const auto specimen = kind.build(kind.read(kFilmedStudies / "kerb/baseline.toml"));
  const auto test = language().read_test(
      Document::parse("kind = \"axle_kc\"\naxle = \"rear\"\nFz = \"1.5 kN\"\nmode = \"parallel\"\n",
                      "test.toml")
          .root(),
      {});
  Scene scene;
  add_films(std::vector<const experiment::Test*>(26, test.get()), *specimen, scene);
  EXPECT_EQ(scene.sequences.size(), 26u);
  EXPECT_TRUE(scene.remarks.empty());
  add_films(std::vector<const experiment::Test*>(40, test.get()), *specimen, scene);
  ASSERT_EQ(scene.remarks.size(), 1u);
  EXPECT_NE(scene.remarks[0].find("Of 40 tests the first 26"), std::string::npos);
}

Scene scene_of_test(const std::string& car, const std::string& keys, int most_steps) {
  const SpecimenKind& kind = *language().find_kind("car");
  const auto specimen = kind.build(kind.read(kFilmedStudies / car));
  const auto test = language().read_test(Document::parse(keys, "test.toml").root(), {});
  Scene scene;
  const auto done = test->film(*specimen, most_steps, scene);
  EXPECT_TRUE(done.ok()) << done.failure().reason;
  return scene;
}

// Links, rocker and springs of both sides have no weight on the rig, so the chassis carries the
// loads.
TEST(RigFilm, TheChassisBearsTheLoadsOfAnAxle) {
  Filmed film{scene_of_test("kerb/baseline.toml",
                            "kind = \"axle_kc\"\naxle = \"rear\"\nFz = \"1.5 kN\"\n"
                            "Fy = \"700 N\"\nmode = \"parallel\"\n",
                            25)};
  Vector3d sum = Vector3d::Zero();
  int borne = 0;
  for (const char* side : {"RL_", "RR_"})
    for (const char* joint :
         {"uca_front", "uca_rear", "lca_front", "lca_rear", "trackrod_inner", "rocker"}) {
      sum += film.force(0, std::string(side) + joint);
      ++borne;
    }
  for (std::size_t k = 0; k < film.sequence().arrows.size(); ++k) {
    const Scene::Arrow& arrow = film.sequence().arrows[k];
    const bool is_strut = arrow.name.find("spring") != std::string::npos ||
                          arrow.name.find("bar") != std::string::npos ||
                          arrow.name.find("heave") != std::string::npos;
    // the force is recorded on the strut and acts on its rocker in the opposite direction
    if (is_strut)
      sum -= film.sequence().steps[0].vectors.col(static_cast<Eigen::Index>(k));
    else if (arrow.is_load && arrow.unit == "N")
      sum += film.sequence().steps[0].vectors.col(static_cast<Eigen::Index>(k));
  }
  EXPECT_EQ(borne, 12);
  EXPECT_LT(sum.norm(), 1e-3);
  EXPECT_GT(std::abs(film.tension(0, "spring unit RL")), 500.0);
}

TEST(CarFilm, ShowsTheLoadsAndTheWayOfItsChannels) {
  const std::string keys =
      "kind = \"kerb\"\nspeed = \"40 m/s\"\nrun_in = \"0.05 s\"\nduration = \"0.1 s\"\n"
      "[kerb]\nkind = \"kerb\"\nshape = \"sine\"\npitch = \"800 mm\"\nwidth = \"800 mm\"\n"
      "height = \"25 mm\"\ncount = 4\nstart = [\"0 m\", \"0.2 m\"]\n";
  const SpecimenKind& kind = *language().find_kind("car");
  const auto specimen = kind.build(kind.read(kFilmedStudies / "kerb/baseline.toml"));
  const auto test = language().read_test(Document::parse(keys, "test.toml").root(), {});
  const auto channels = test->run(*specimen);
  ASSERT_TRUE(channels);
  const Filmed film{scene_of_test("kerb/baseline.toml", keys, 20)};
  ASSERT_EQ(film.sequence().steps.size(), 20u);  // the 20 of 33 steps in which the loads vary most
  const std::vector<double> times = (*channels)["time"];
  for (const Scene::Step& step : film.sequence().steps) {
    const auto sample = static_cast<std::size_t>(
        std::lower_bound(times.begin(), times.end(), step.at - 1e-9) - times.begin());
    EXPECT_EQ(step.at, times[sample]);
    EXPECT_EQ(step.origin, (*channels)["x"][sample]);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_EQ(step.vectors(2, static_cast<Eigen::Index>(i)),
                (*channels)[of_corners("Fz")[i]][sample]);
    EXPECT_TRUE(step.points.allFinite());
    EXPECT_EQ(step.points.cols(), film.scene.meshes.back().points.cols());
    EXPECT_EQ(std::ssize(step.field), step.points.cols());
  }
  // The road is drawn below the car and includes the crests of the kerb.
  ASSERT_EQ(film.scene.meshes.size(), 2u);
  EXPECT_EQ(film.sequence().ground, film.scene.meshes[0].name);
  EXPECT_NEAR(film.scene.meshes[0].points.row(2).maxCoeff(), 0.025, 3e-4);
  EXPECT_EQ(film.scene.meshes[0].points.row(2).minCoeff(), 0.0);
}

TEST(CarFilm, StandsOnItsPosts) {
  const Filmed film{scene_of_test("four_post/baseline.toml",
                                  "kind = \"four_post\"\nmode = \"roll\"\nfrom = \"2 Hz\"\n"
                                  "to = \"6 Hz\"\nduration = \"0.6 s\"\nstep = \"0.5 ms\"\n",
                                  200)};
  EXPECT_TRUE(film.sequence().ground.empty());
  const Scene::Mesh& mesh = film.scene.meshes.back();
  const auto posts = std::find_if(mesh.parts.begin(),
                                  mesh.parts.end(),
                                  [](const Scene::Part& part) { return part.name == "posts"; });
  ASSERT_NE(posts, mesh.parts.end());
  ASSERT_EQ(posts->count, 8u);
  const auto height = [&](const Scene::Step& step, std::uint32_t post) {
    return step.points(2, mesh.triangles[3 * (posts->first + 2 * post)]);
  };
  double most = 0.0;
  for (const Scene::Step& step : film.sequence().steps) {
    // the left and the right side move in opposite directions
    EXPECT_NEAR(height(step, 0), -height(step, 1), 1e-15);
    most = std::max(most, std::abs(height(step, 0)));
  }
  EXPECT_GT(most, 1e-3);
}

TEST(RoadSurface, HasTheLinesItTakes) {
  const RoadArea area{-5.0, 10.0, -1.0, 1.0};
  EXPECT_EQ(road_surface(road::PlaneRoad{}, area).points.cols(), 4);
  road::Kerb kerb;
  kerb.shape = road::Kerb::Shape::sine;
  kerb.height = 0.025;
  kerb.start = {0.0, 0.1};
  const auto road = kerb_road(kerb);
  const Scene::Mesh mesh = road_surface(road, area);
  EXPECT_LT(mesh.points.cols(), 1000);
  for (Eigen::Index k = 0; k < mesh.points.cols(); ++k)
    EXPECT_EQ(mesh.points(2, k), road.height(mesh.points(0, k), mesh.points(1, k), 0.0));
  // The lines along x are chords: the sine deviates from each of them by no more than the
  // tolerance.
  EXPECT_NEAR(mesh.points.row(2).maxCoeff(), 0.025, 3e-4);
}

}  // namespace
}  // namespace latsch::experiment
