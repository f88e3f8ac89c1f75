// SPDX-License-Identifier: Apache-2.0
#include "formats/road/road_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "base/random.h"
#include "models/road/kerb.h"
#include "models/road/road_reader.h"

namespace latsch::formats {
namespace {

const std::filesystem::path kRoadSamples = LATSCH_SOURCE_DIR "/../shared/data/road";
constexpr double kRounding = 1e-13;
constexpr double kPi = std::numbers::pi;

RoadFile rdf(const std::string& text) { return read_rdf(TeimOrbit::parse(text, "road.rdf")); }

RoadFile road_2d(const std::string& type, const std::string& parameters) {
  return rdf(
      "[UNITS]\nLENGTH = 'mm'\nFORCE = 'newton'\nANGLE = 'degree'\nMASS = 'kg'\nTIME = 'sec'\n"
      "[MODEL]\nMETHOD = '2D'\nROAD_TYPE = '" +
      type + "'\n[PARAMETERS]\n" + parameters);
}
double z(const RoadFile& file, double x, double y = 0.0, double time = 0.0) {
  EXPECT_EQ(file.road->height(x, y, time), file.road->at(x, y, time).height);
  return file.road->height(x, y, time);
}

std::vector<std::string> names_of(const std::vector<TeimOrbitPart>& parts) {
  std::vector<std::string> names;
  for (const TeimOrbitPart& part : parts) names.push_back(part.name);
  return names;
}

void expect_road_message(const std::string& text,
                         const std::string& place,
                         const std::string& words) {
  try {
    // The section [UNITS] follows the text, so that the line numbers of the text do not change.
    rdf(text + "[UNITS]\nLENGTH='meter'\nANGLE='radian'\nTIME='second'\n");
    FAIL() << words;
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find(place), 0u) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }
}

TEST(RdfFile, ObstaclesStandWhereTheirParametersSay) {
  const RoadFile plank =
      road_2d("plank",
              "MU = 0.9\nHEIGHT = 20\nSTART = 1000\nLENGTH = 200\nBEVEL_EDGE_LENGTH = 10\n"
              "MU_FACTOR_CLEAT = 0.5\nCOLOR = 3\n");
  EXPECT_EQ(z(plank, 0.999), 0.0);
  EXPECT_NEAR(z(plank, 1.005), 0.015, kRounding);
  EXPECT_NEAR(z(plank, 1.1), 0.020, kRounding);
  EXPECT_NEAR(z(plank, 1.195), 0.015, kRounding);
  EXPECT_EQ(plank.road->at(1.1, 0, 0).friction, 0.45);
  EXPECT_EQ(plank.road->at(0.1, 0, 0).friction, 0.9);
  EXPECT_EQ(names_of(plank.unused), std::vector<std::string>{"[PARAMETERS] COLOR"});
  EXPECT_TRUE(road_2d("plank", "HEIGHT = 20\nSTART = 1000\nLENGTH = 200\n").unused.empty());
  // Unused keys are reported: a misspelled key, a key in another section, and a key whose value
  // would mean another model.
  EXPECT_EQ(
      names_of(road_2d("flat", "MUE = 0.5\n[GRAPHICS]\nLENGTH = 3\n[OFFSET]\nZ = 1\n").unused),
      (std::vector<std::string>{"[PARAMETERS] MUE", "[GRAPHICS]", "[OFFSET]"}));
  const RoadFile oblique =
      road_2d("plank", "HEIGHT = 20\nSTART = 1000\nLENGTH = 200\nDIRECTION = 45\n");
  EXPECT_EQ(z(oblique, 1.1, 0.0), 0.02);
  EXPECT_EQ(z(oblique, 1.1 - 0.3, 0.3), 0.02);  // the angle is counterclockwise from the axle
  EXPECT_EQ(z(oblique, 1.1 + 0.3, 0.3), 0.0);
  const RoadFile hole = road_2d("pothole", "DEPTH = 50\nSTART = 1000\nLENGTH = 200\nOFFSET = 7\n");
  EXPECT_NEAR(z(hole, 1.1), -0.043, kRounding);
  const RoadFile ramp = road_2d("ramp", "HEIGHT = -100\nSTART = 1000\nSLOPE = 0.5\n");
  EXPECT_NEAR(z(ramp, 1.1), -0.05, kRounding);
  EXPECT_NEAR(z(ramp, 5.0), -0.1, kRounding);
  const RoadFile roof =
      road_2d("roof", "HEIGHT = 100\nSTART = 1000\nLENGTH = 400\nROTATION_ANGLE_XY_PLANE = 90\n");
  EXPECT_NEAR(z(roof, 0.0, 1.1), 0.05, kRounding);
  EXPECT_NEAR(roof.road->at(0.0, 1.1, 0.0).normal.y(), -0.5 / std::hypot(1.0, 0.5), kRounding);
  const RoadFile line = road_2d("poly_line", "(XZ_DATA)\n0 0 0\n900 0 0\n1000 100 -100\n");
  EXPECT_NEAR(z(line, 0.95, 1.0), 0.05, kRounding);
  EXPECT_NEAR(z(line, 0.95, -1.0), -0.05, kRounding);
  EXPECT_EQ(z(road_2d("flat", "MU = 0.7\n"), 3.0), 0.0);
}

TEST(RdfFile, WavesHaveTheirPhaseFromTheIntegralOfTheWaveNumber) {
  const RoadFile sine = road_2d("sine", "AMPLITUDE = 10\nWAVE_LENGTH = 2000\nSTART = 1000\n");
  EXPECT_EQ(z(sine, 0.9), 0.0);
  EXPECT_NEAR(z(sine, 1.5), 0.01, kRounding);
  const std::string sweep =
      "AMPLITUDE_AT_START = 10\nAMPLITUDE_AT_END = 20\nSTART = 0\nEND = 10000\n"
      "WAVE_LENGTH_AT_START = 4000\nWAVE_LENGTH_AT_END = 1000\nSWEEP_TYPE = ";
  for (const int type : {0, 1}) {
    const RoadFile road = road_2d("sweep", sweep + std::to_string(type) + "\n");
    for (const double x : {0.3, 4.1, 9.7}) {
      // Computes the phase of the sweep by Simpson's rule, whose error is far below 1e-12 with 2000
      // intervals.
      double phase = 0.0;
      const auto wave_number = [&](double s) {
        const double length = type == 0 ? 4.0 * std::pow(0.25, s / 10.0) : 4.0 - 0.3 * s;
        return 2.0 * kPi / length;
      };
      constexpr int kPieces = 2000;
      for (int i = 0; i < kPieces; ++i) {
        const double a = x * i / kPieces, h = x / kPieces;
        phase += h / 6.0 * (wave_number(a) + 4.0 * wave_number(a + h / 2) + wave_number(a + h));
      }
      EXPECT_NEAR(z(road, x), (0.01 + 0.001 * x) * std::sin(phase), 1e-12);
      const double h = 1e-6;
      const double slope = (z(road, x + h) - z(road, x - h)) / (2 * h);
      const Eigen::Vector3d normal = road.road->at(x, 0.0, 0.0).normal;
      EXPECT_NEAR(-normal.x() / normal.z(), slope, 1e-8);
    }
  }
}

TEST(RdfFile, DrumTurnsItsCleatsUnderTheTire) {
  const std::string bar = "CLEAT_HEIGHT = 20\nCLEAT_LENGTH = 40\nCLEAT_BEVEL_EDGE_LENGTH = 5\n";
  const RoadFile drum = road_2d("drum",
                                "DIAMETER = -2500\nV = 10000\nNUMBER_CLEATS = 2\n"
                                "CLEAT_STARTING_ANGLE = 90\nMU_FACTOR_CLEAT = 0.9\n" +
                                    bar);
  const double quarter = 2.5 * kPi / 4.0 / 10.0;
  EXPECT_EQ(z(drum, 0, 0, 0.0), 0.0);
  EXPECT_NEAR(z(drum, 0, 0, quarter), 0.02, 1e-4);
  EXPECT_NEAR(z(drum, 0, 0, 3 * quarter), 0.02, 1e-4);
  EXPECT_LT(z(drum, 0.5), 0.0);  // outer
  const RoadFile inner = road_2d("drum",
                                 "DIAMETER = 2500\nV = 10000\nACCELERATION_TIME = 4\n"
                                 "NUMBER_CLEATS = 1\nCLEAT_STARTING_ANGLE = 90\n" +
                                     bar);
  EXPECT_GT(z(inner, 0.5), 0.0);
  EXPECT_NEAR(inner.road->at(0, 0, 2.0).velocity.x(), -5.0, kRounding);
  EXPECT_NEAR(z(inner, 0, 0, std::sqrt(2.5 * kPi / 4.0 * 2.0 / 2.5)), 0.02, 1e-4);
  const RoadFile rounded = road_2d("drum",
                                   "DIAMETER = -2500\nNUMBER_CLEATS = 1\n(TV_DATA)\n0 0\n1 "
                                   "1000\n(XZR_DATA)\n0 0 0\n0 20 10\n40 20 10\n40 0 0\n");
  EXPECT_NEAR(z(rounded, 0), 0.02, 1e-4);
  // The edge is rounded with a radius of 10 mm; at 45 degrees the surface is 10 (1 - cos 45 deg) =
  // 2.93 mm inside of the sharp edge.
  EXPECT_NEAR(z(rounded, 0.02 - 0.00293), 0.02 - 0.00293, 1.5e-4);
  EXPECT_EQ(rounded.road->at(0, 0, 0.5).velocity.x(), -0.5);
}

TEST(RdfFile, SaysWhereAndWhatIsWrong) {
  expect_road_message("[UNITS]\nLENGTH='mm'\n", "road.rdf", "MODEL");
  expect_road_message(
      "[MODEL]\nMETHOD = '2D'\nROAD_TYPE = 'plnak'\n", "road.rdf:3: ", "mean \"plank\"");
  expect_road_message(
      "[MODEL]\nMETHOD = '2D'\nROAD_TYPE = 'stochastic_uneven'\n", "road.rdf:3: ", "OpenCRG");
  expect_road_message("[MODEL]\nMETHOD = 'spline'\n", "road.rdf:1: ", "expected \"2D\"");
  const std::string head =
      "[MODEL]\nMETHOD = '2D'\nROAD_TYPE = 'plank'\n[PARAMETERS]\nHEIGHT = 1\n";
  expect_road_message(head, "road.rdf:4: ", "LENGTH is missing");
  expect_road_message(head + "LENGTH = -5\n", "road.rdf:6: ", "LENGTH is -5");
  expect_road_message(
      head + "LENGTH = 5\nBEVEL_EDGE_LENGTH = 3\n", "road.rdf:7: ", "half of the length");
  expect_road_message(
      "[MODEL]\nMETHOD = '2D'\nROAD_TYPE = 'sweep'\nAMPLITUDE_AT_START = 1\nAMPLITUDE_AT_END = 2\n"
      "WAVE_LENGTH_AT_START = 1\nWAVE_LENGTH_AT_END = 2\nSTART = 0\nEND = 1e-320\n",
      "road.rdf:9: ",
      "behind START");
  const std::string mesh =
      "[MODEL]\nMETHOD = '3D'\n[NODES]\n1 0 0 0\n2 1 0 0\n3 0 1 0\n[ELEMENTS]\n";
  expect_road_message(mesh + "1 2 4 1\n", "road.rdf:8: ", "node 4");
  expect_road_message(mesh + "1 2 2 1\n", "road.rdf:7: ", "seen from above");
  expect_road_message(mesh + "1 2\n", "road.rdf:8: ", "expected 3 numbers");
  expect_road_message(mesh + "NUMBER_OF_ELEMENTS = 5\n1 2 3\n", "road.rdf:8: ", "but 1 follow");
}

/// Returns the error message for a road whose [UNITS] has only these lines.
std::string complaint_of_road(const std::string& units, const std::string& rest) {
  try {
    rdf((units.empty() ? "" : "[UNITS]\n" + units) + rest);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(RdfFile, AMissingUnitOfAQuantityThatTheRoadHasIsRefused) {
  const std::string plank =
      "[MODEL]\nMETHOD='2D'\nROAD_TYPE='plank'\n[PARAMETERS]\nMU=0.8\nOFFSET=10\n"
      "ROTATION_ANGLE_XY_PLANE=0\nHEIGHT=20\nSTART=1000\nLENGTH=500\nDIRECTION=0\n";
  const std::string none = complaint_of_road("", plank);
  EXPECT_EQ(none.find("road.rdf: there is no section [UNITS]"), 0u) << none;
  const std::string silent = complaint_of_road("FORCE='newton'\nANGLE='degree'\n", plank);
  EXPECT_EQ(silent.find("road.rdf:1: [UNITS] has no LENGTH"), 0u) << silent;
  EXPECT_NE(silent.find("add the line LENGTH = 'mm'"), std::string::npos) << silent;
  // All angles of this file are 0, so they need no unit.
  EXPECT_EQ(complaint_of_road("LENGTH='mm'\n", plank), "none");
  const std::string turned = plank.substr(0, plank.find("DIRECTION")) + "DIRECTION=30\n";
  EXPECT_NE(complaint_of_road("LENGTH='mm'\n", turned).find("[UNITS] has no ANGLE"),
            std::string::npos);
  EXPECT_EQ(complaint_of_road("", "[MODEL]\nMETHOD='2D'\nROAD_TYPE='flat'\n"), "none");
  const std::string drum = "[MODEL]\nMETHOD='2D'\nROAD_TYPE='drum'\nDIAMETER=-2500\nV=1000\n";
  EXPECT_NE(complaint_of_road("LENGTH='mm'\n", drum).find("[UNITS] has no TIME"),
            std::string::npos);
  const std::string mesh =
      "[MODEL]\nMETHOD='3D'\n[NODES]\n1 0 0 0\n2 1 0 0\n3 0 1 0\n[ELEMENTS]\n1 2 3 1\n";
  EXPECT_NE(complaint_of_road("ANGLE='degree'\n", mesh).find("[UNITS] has no LENGTH"),
            std::string::npos);
  const std::string spline = "[MODEL]\nMETHOD='3D_SPLINE'\n[DATA_POINTS]\n0 0 0 8\n100 0 0 8\n";
  EXPECT_NE(complaint_of_road("", spline).find("there is no section [UNITS]"), std::string::npos);
}

TEST(RdfFile, AnObstacleHigherThanAMeterIsTold) {
  const std::string rest =
      "[MODEL]\nMETHOD='2D'\nROAD_TYPE='plank'\n[PARAMETERS]\nHEIGHT=20\nSTART=1\nLENGTH=50\n";
  EXPECT_TRUE(rdf("[UNITS]\nLENGTH='mm'\n" + rest).doubts.empty());
  const std::vector<LedgerDoubt> doubts = rdf("[UNITS]\nLENGTH='meter'\n" + rest).doubts;
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].place.line, 7);
  EXPECT_EQ(doubts[0].sentence,
            "HEIGHT is 20 m, higher than any obstacle: is LENGTH of [UNITS] right?");
}

TEST(RdfFile, PartsThatWouldChangeTheSurfaceAreDoubts) {
  const std::string units = "[UNITS]\nLENGTH='m'\nANGLE='radian'\nTIME='second'\n";
  const std::string mesh =
      "[MODEL]\nMETHOD='3D'\n[NODES]\n1 0 0 0\n2 1 0 0\n3 0 1 0\n[ELEMENTS]\n1 2 3 0.9 0.9\n";
  const auto names = [&](const std::string& text) {
    std::vector<std::string> found;
    for (const LedgerDoubt& doubt : rdf(text).doubts)
      found.push_back(doubt.name + ":" + std::to_string(doubt.place.line));
    return found;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(units + mesh), Names{});
  EXPECT_EQ(names(units + "[SCALE]\nX=1\nY=1\nZ=1\n[UP]\nX=0\nY=0\nZ=1\n" + mesh), Names{});
  EXPECT_EQ(names(units + "[SCALE]\nX=1\nY=1\nZ=2\n" + mesh), Names{"[SCALE]:5"});
  EXPECT_EQ(names(units + "[ORIENTATION]\nX=0\nY=1\nZ=0\n" + mesh), Names{"[ORIENTATION]:5"});
  EXPECT_EQ(names(units + "[ORIGIN]\nX=3\n" + mesh), Names{"[ORIGIN]:5"});
  std::string split = mesh;
  split.replace(split.find("0.9 0.9"), 7, "0.9 0.8");
  const RoadFile across = rdf(units + split);
  EXPECT_EQ(names(units + split), Names{"[ELEMENTS] mu_y:12"});
  EXPECT_EQ(names_of(across.unused), Names{"[ELEMENTS] mu_y"});
  EXPECT_EQ(names(units + "[MODEL]\nMETHOD='2D'\nROAD_TYPE='flat'\n[PARAMETERS]\nMUE=1\n"),
            Names{"[PARAMETERS] MUE:9"});
  // A key of another type of road is unused, and causes no doubt.
  const RoadFile flat =
      rdf(units + "[MODEL]\nMETHOD='2D'\nROAD_TYPE='flat'\n[PARAMETERS]\nMU=1\nHEIGHT=2\n");
  EXPECT_TRUE(flat.doubts.empty());
  EXPECT_EQ(names_of(flat.unused), Names{"[PARAMETERS] HEIGHT"});
}

TEST(RdfFile, TrianglesInAnyOrderOfNodesAndOfWinding) {
  const RoadFile file =
      rdf("[UNITS]\nLENGTH='mm'\nFORCE='newton'\nANGLE='degree'\nMASS='kg'\nTIME='sec'\n"
          "[MODEL]\nMETHOD = '3D'\n[REFSYS]\nOFFSET = 0.0 0.0 100.0\nROTATION_ANGLE_XY_PLANE = 90\n"
          "[NODES]\n{ node x_value y_value z_value }\n70 1000 0 0\n3 0 0 0\n12 1000 1000 50\n5 0 "
          "1000 0\n"
          "[ELEMENTS]\n{ node_1 node_2 node_3 mu }\n3 12 70 0.8\n3 5 12 0.6\n");
  // The road is rotated by 90 deg: x of the file is y here.
  EXPECT_NEAR(z(file, -0.25, 0.5), 0.1 + 0.0125, kRounding);
  EXPECT_NEAR(z(file, -0.999999, 0.999999), 0.15, 1e-6);
  EXPECT_EQ(file.road->at(-0.25, 0.5, 0).friction, 0.8);
  EXPECT_EQ(file.road->at(-0.75, 0.5, 0).friction, 0.6);
  EXPECT_GT(file.road->at(-0.25, 0.5, 0).normal.z(), 0.9);
  // beyond the mesh the height is that of the nearest edge
  EXPECT_NEAR(z(file, 0.5, 0.5), 0.1, kRounding);
  EXPECT_NEAR(z(file, -1.5, 1.5), 0.15, kRounding);  // the height of the nearest corner
}

// Reference result without a spatial index: every triangle is tried.
double brute_force(const road::TriangleMesh& mesh, const Eigen::Vector2d& p) {
  double best = -1e300;
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d a = mesh.nodes[triangle.nodes[0]], b = mesh.nodes[triangle.nodes[1]],
                          c = mesh.nodes[triangle.nodes[2]];
    const auto cross = [](const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
      return u.x() * v.y() - u.y() * v.x();
    };
    const double area = cross((b - a).head<2>(), (c - a).head<2>());
    const double s = cross(p - a.head<2>(), (c - a).head<2>()) / area;
    const double t = cross((b - a).head<2>(), p - a.head<2>()) / area;
    if (s < 0.0 || t < 0.0 || s + t > 1.0) continue;
    best = std::max(best, a.z() + s * (b.z() - a.z()) + t * (c.z() - a.z()));
  }
  return best;
}

TEST(TriangleRoad, FindsWhatASearchThroughAllTrianglesFinds) {
  RandomStream random(17, 0);
  road::TriangleMesh mesh;
  constexpr int n = 23;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      mesh.nodes.push_back(
          {i + 0.3 * random.uniform(), 3.0 * j + 0.9 * random.uniform(), random.uniform()});
  for (int i = 0; i + 1 < n; ++i) {
    for (int j = 0; j + 1 < n; ++j) {
      const int k = i * n + j;
      mesh.triangles.push_back({{k, k + 1, k + n}, 1.0});
      mesh.triangles.push_back({{k + n, k + n + 1, k + 1}, 1.0});
    }
  }
  const road::TriangleRoad road(mesh);
  int inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector2d p(25.0 * random.uniform() - 1.0, 70.0 * random.uniform() - 2.0);
    const double expected = brute_force(mesh, p);
    if (expected < -1e299) continue;
    ++inside;
    EXPECT_NEAR(road.height(p.x(), p.y(), 0.0), expected, 1e-12);
  }
  EXPECT_GT(inside, 2000);
}

TEST(RdfFile, WrittenTrianglesComeBackBitForBit) {
  road::TriangleMesh mesh;
  mesh.nodes = {{0.1, 0.0, 1.0 / 3.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 1e-17}};
  mesh.triangles = {{{2, 1, 0}, 0.7}};
  const RoadFile back = rdf(rdf_text(mesh, "a test"));
  ASSERT_TRUE(back.triangles);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(back.triangles->mesh().nodes[i], mesh.nodes[i]);
  EXPECT_EQ(back.triangles->mesh().triangles[0].nodes, mesh.triangles[0].nodes);
  EXPECT_EQ(back.triangles->mesh().triangles[0].friction, 0.7);
}

TEST(RdfFile, KerbsAsTrianglesAreTheSameKerbs) {
  for (const auto shape : {road::Kerb::Shape::saw_tooth,
                           road::Kerb::Shape::block,
                           road::Kerb::Shape::triangle,
                           road::Kerb::Shape::sine}) {
    road::Kerb kerb;
    kerb.shape = shape;
    kerb.height = -0.025;
    kerb.length = 0.4;
    kerb.bevel = 0.01;
    kerb.ramp = shape == road::Kerb::Shape::triangle ? 0.2 : 0.0;
    kerb.start = {1.0, -0.4};
    kerb.angle = 0.3;
    kerb.friction = 0.8;
    const road::ProfileRoad exact = kerb_road(kerb);
    const RoadFile file = rdf(rdf_text(kerb_triangles(kerb, 3.0), "a kerb"));
    for (double s = -1.0; s < 4.0; s += 0.0173) {
      const Eigen::Vector2d p =
          kerb.start + Eigen::Vector2d(s * std::cos(0.3) - 0.35 * std::sin(0.3),
                                       s * std::sin(0.3) + 0.35 * std::cos(0.3));
      // In this file the steep faces of the road extend over 0.01 mm in the longitudinal direction,
      // and so do the ends of the slopes between them.
      EXPECT_NEAR(z(file, p.x(), p.y()), exact.height(p.x(), p.y(), 0.0), 1e-5) << s;
      if (s < -0.01 || (s > 0.01 && s < 3.19) || s > 3.21) {
        EXPECT_EQ(file.road->at(p.x(), p.y(), 0).friction, exact.at(p.x(), p.y(), 0).friction);
      }
    }
  }
}

// The sample describes itself as 4 saw-tooth blocks of 800 x 800 x 25 mm; their falling flanks are
// 0.01 mm long.
TEST(RdfFile, SampleOfAKerbIsTheKerbOfTheGenerator) {
  if (!std::filesystem::exists(kRoadSamples)) GTEST_SKIP() << "no samples in " << kRoadSamples;
  const RoadFile file = read_road_file(kRoadSamples / "kerb_sawtooth_4x800x800x25.rdf");
  EXPECT_EQ(file.kind, "Adams triangles");
  road::Kerb kerb;
  kerb.height = 0.025;
  kerb.start = {0.0, -0.4};
  const road::ProfileRoad expected = kerb_road(kerb);
  for (double x = -2.9; x < 6.1; x += 0.0131) {
    for (const double y : {-0.39, 0.0, 0.3}) {
      const double to_flank = x - 0.8 * std::ceil(x / 0.8);
      if (x > 0.0 && x < 3.2 && to_flank > -1.1e-5) continue;
      EXPECT_NEAR(z(file, x, y), expected.height(x, y, 0.0), 0.025 * 0.00001 / 0.8 * 1.01) << x;
    }
  }
}

const std::string kSplineHead =
    "[UNITS]\nLENGTH='meter'\nFORCE='newton'\nANGLE='degree'\nMASS='kg'\nTIME='sec'\n[MODEL]\n"
    "METHOD = '3D_SPLINE'\n[GLOBAL_PARAMETERS]\nCLOSED_ROAD = 'NO'\nWIDTH = 4\nMU_LEFT = 1.2\n"
    "MU_RIGHT = 0.8\n[DATA_POINTS]\n{X Y Z WIDTH BANK MU_LEFT MU_RIGHT OBSTACLES}\n";

TEST(RdfSpline, APlaneThroughStraightPointsIsThatPlane) {
  const RoadFile road = rdf(kSplineHead + "0 0 0 0 0\n3 0 0.3 6 0 0.5 0.4\n10 0 1 0 0\n");
  EXPECT_EQ(road.kind, "Adams spline");
  for (const double x : {0.1, 1.0, 2.9, 3.1, 7.7}) EXPECT_NEAR(z(road, x, 0.9), 0.1 * x, 1e-12);
  EXPECT_EQ(road.road->at(1.0, 1.0, 0.0).friction, 1.2);   // left
  EXPECT_EQ(road.road->at(1.0, -1.0, 0.0).friction, 0.8);  // right
  // the friction stated in the row applies from this point on
  EXPECT_EQ(road.road->at(5.0, 1.0, 0.0).friction, 0.5);
}

// Points lie on a circle, one every 2 a of angle. The cubic is on the circle at the points; between
// two points its distance from the center is R cos a (1 + sin^2 a / 2).
TEST(RdfSpline, AClosedCircleComesBackToItself) {
  std::string points;
  for (int i = 0; i < 18; ++i) {
    const double angle = i * 20.0 * kPi / 180.0;
    points += std::to_string(20.0 * std::cos(angle)) + " " +
              std::to_string(20.0 * std::sin(angle)) + " 0 2 0\n";
  }
  std::string text = kSplineHead + points;
  text.replace(text.find("'NO'"), 4, "'YES'");
  const RoadFile road = rdf(text);
  double out = 0.0, in = 1e9;
  // every third node lies on the center line
  for (std::size_t i = 1; i < road.triangles->mesh().nodes.size(); i += 3) {
    const double radius = road.triangles->mesh().nodes[i].head<2>().norm();
    out = std::max(out, radius);
    in = std::min(in, radius);
  }
  const double a = 10.0 * kPi / 180.0;
  EXPECT_NEAR(out, 20.0, 1e-5);  // precision of the points in the file
  EXPECT_NEAR(in, 20.0 * std::cos(a) * (1.0 + 0.5 * std::sin(a) * std::sin(a)), 1e-5);
  const auto& nodes = road.triangles->mesh().nodes;
  EXPECT_LT((nodes[1] - nodes[nodes.size() - 2]).norm(), 1e-9);
}

TEST(RdfSpline, SaysWhatIsNotReadAndWhy) {
  expect_road_message(kSplineHead + "0 0 0 4 5\n3 0 0 4 0\n", "road.rdf:16: ", "bank angle");
  expect_road_message(
      kSplineHead + "0 0 0 4 0 1 1 OBSTACLE1\n3 0 0 4 0\n", "road.rdf:16: ", "obstacle");
  expect_road_message(kSplineHead + "0 0 0 4 0\n", "road.rdf:14: ", "expected 2 at least");
  expect_road_message(
      kSplineHead + "0 0 0 4 0\n0 0 1 4 0\n", "road.rdf:17: ", "repeats the point before");
}

TEST(RoadFile, TomlSaysInWordsWhatStandsOnTheRoad) {
  const auto road = [](const std::string& text) {
    return road::read_road(Document::parse(text, "road.toml").root());
  };
  EXPECT_EQ(road("kind = \"cleat\"\nheight = \"20 mm\"\nlength = \"25 mm\"\nplace = \"2 m\"\n")
                ->height(2.0, 0.0, 0.0),
            0.02);
  const auto drum = road(
      "kind = \"drum\"\ndiameter = \"2.5 m\"\nspeed = \"36 km/h\"\ncleats = 1\n"
      "height = \"20 mm\"\nlength = \"25 mm\"\n");
  EXPECT_NEAR(drum->height(0.0, 0.0, 2.5 * kPi / 2.0 / 10.0), 0.02, 1e-4);
  EXPECT_NEAR(
      road("kind = \"kerb\"\nshape = \"saw_tooth\"\npitch = \"800 mm\"\nwidth = \"800 mm\"\n"
           "height = \"-25 mm\"\ncount = 4\nstart = [\"0 m\", \"-0.4 m\"]\n")
          ->height(0.4, 0.0, 0.0),
      -0.0125,
      kRounding);
  EXPECT_NEAR(
      road("kind = \"wave\"\namplitude = \"10 mm\"\nwave_length = \"2 m\"\n")->height(0.5, 0, 0),
      0.01,
      kRounding);
  EXPECT_EQ(road("kind = \"flat\"\nbelt_speed = \"10 m/s\"\n")->at(0, 0, 0).velocity.x(), -10.0);
  EXPECT_THROW(road("kind = \"flat\"\ncleats = 3\n"), InputError);
  EXPECT_THROW(road("kind = \"drum\"\ndiameter = \"-1 m\"\n"), InputError);
  EXPECT_THROW(read_road_file("road.txt"), InputError);
}

}  // namespace
}  // namespace latsch::formats
