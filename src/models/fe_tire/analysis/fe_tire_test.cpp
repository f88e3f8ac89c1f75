// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/fe_tire.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/contact/contact.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {
namespace {

constexpr double kPressure = 2.6e5;

/// Returns the reference tire B on a coarse mesh, for tests of the method rather than of the tire.
TireDescription small_tire() {
  TireDescription tire = reference_tire_b();
  tire.section.meridional = 13;
  tire.section.sectors = 24;
  return tire;
}

FeTire make(const TireDescription& tire, ElementKind kind = ElementKind::full_integration) {
  return FeTire(build_mesh(tire), build_materials(tire), {.element = kind});
}

TEST(FeTire, HarmonicModesEqualThoseOfTheWholeRing) {
  FeTire tire = make(small_tire());
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated) << inflated.failure().reason;
  const auto by_harmonics = tire.modes(*inflated, 20);
  const auto by_ring = tire.modes_full(*inflated, 20);
  ASSERT_TRUE(by_harmonics && by_ring);
  for (int k = 0; k < 20; ++k) {
    EXPECT_NEAR(
        (*by_harmonics)[k].frequency, (*by_ring)[k].frequency, 1e-6 * (*by_ring)[k].frequency)
        << (*by_harmonics)[k].label();
  }
}

TEST(FeTire, HarmonicShapesAreModesOfTheRingsOwnMatrices) {
  // Modes were computed by circumferential harmonics. The equation K phi = omega^2 M phi must hold
  // with K and M that are assembled sector by sector, independently of the harmonics.
  const TireDescription description = small_tire();
  FeTire tire = make(description);
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  const auto modes = tire.modes(*inflated, 8);
  ASSERT_TRUE(modes);

  const Ring ring(build_mesh(description), ElementKind::full_integration);
  const RingUnknowns whole(ring, RingSymmetry::none, {});
  const RingAssembly assembly(whole);
  const RingElements elements(ring, tire.materials());
  AssembledState state = assembly.zero_state();
  state.x = whole.compress(inflated->u.replicate(1, ring.sectors()));
  numerics::SymmetricMatrix K(*assembly.pattern());
  Eigen::VectorXd f;
  ASSERT_TRUE(assembly.assemble(elements, state, kPressure, f, &K, nullptr));
  const numerics::SymmetricMatrix M = assembly.mass(elements);
  for (const Mode& mode : *modes) {
    const Eigen::VectorXd phi = whole.compress(mode.shape);
    Eigen::MatrixXd K_phi(phi.size(), 1), M_phi(phi.size(), 1);
    K.multiply(phi, K_phi);
    M.multiply(phi, M_phi);
    const double omega = 2.0 * M_PI * mode.frequency;
    EXPECT_NEAR(phi.dot(M_phi.col(0)), 1.0, 1e-9) << mode.label();
    EXPECT_LT((K_phi - omega * omega * M_phi).norm(), 1e-4 * K_phi.norm()) << mode.label();
  }
}

TEST(FeTire, InflatedSectorIsAnEquilibriumOfTheWholeRing) {
  const TireDescription description = small_tire();
  FeTire tire = make(description);
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  const Ring ring(build_mesh(description), ElementKind::full_integration);
  const RingUnknowns whole(ring, RingSymmetry::none, {});
  const RingAssembly assembly(whole);
  const RingElements elements(ring, tire.materials());
  AssembledState state = assembly.zero_state();
  state.x = whole.compress(inflated->u.replicate(1, ring.sectors()));
  Eigen::VectorXd residual, pressure_alone;
  ASSERT_TRUE(assembly.assemble(elements, state, kPressure, residual, nullptr, nullptr));
  AssembledState undeformed = assembly.zero_state();
  ASSERT_TRUE(assembly.assemble(elements, undeformed, kPressure, pressure_alone, nullptr, nullptr));
  EXPECT_LT(residual.norm(), 1e-9 * pressure_alone.norm());
}

TEST(FeTire, TangentWithContactAndStickingIsTheDerivativeOfTheForces) {
  const TireDescription description = small_tire();
  FeTire tire = make(description);
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  const Ring ring(build_mesh(description), ElementKind::full_integration);
  const RingUnknowns whole(ring, RingSymmetry::none, {});
  const RingElements elements(ring, tire.materials());
  for (const TreadShape shape : {TreadShape::facets, TreadShape::smooth}) {
    const TreadSurface tread(whole, shape, 0.4);
    const RingAssembly assembly(whole, &tread);
    // The ground is soft and friction is high, so that neither first touch nor slip causes a kink
    // within the finite difference.
    TreadContact contact(tread, {.stiffness = 2e8, .mu = 5.0});
    AssembledState state = assembly.zero_state();
    state.x = whole.compress(inflated->u.replicate(1, ring.sectors()));
    const GroundPose pose = FeTire::below(*inflated, 0.01);
    contact.start(pose, state.x, {});
    contact.start(pose, state.x, contact.anchors(state.x));
    const auto forces = [&](AssembledState at, numerics::SymmetricMatrix* K) {
      Eigen::VectorXd f;
      EXPECT_TRUE(assembly.assemble(elements, at, kPressure, f, K, nullptr));
      const auto touches = contact.touches(tread.displacements(at.x));
      EXPECT_FALSE(touches.empty());
      add_forces(tread, touches, f);
      if (K) add_stiffness(tread, touches, assembly.first_cell(), *K);
      return f;
    };
    numerics::SymmetricMatrix K(*assembly.pattern());
    forces(state, &K);
    // All nodes are displaced, even those at the free inner edge of the bead, but too little for
    // any point to cross the ground.
    Eigen::Matrix3Xd u(3, ring.mesh().nodes());
    for (int k = 0; k < u.cols(); ++k) {
      u.col(k) = Eigen::Vector3d(std::sin(k), std::cos(3 * k), std::sin(2 * k + 1));
    }
    const Eigen::VectorXd d = whole.compress(u);
    Eigen::MatrixXd Kd(d.size(), 1);
    K.multiply(d, Kd);
    const double h = 1e-8;
    AssembledState above = state, below = state;
    above.x += h * d;
    below.x -= h * d;
    const Eigen::VectorXd difference = (forces(above, nullptr) - forces(below, nullptr)) / (2 * h);
    EXPECT_LT((Kd.col(0) - difference).norm(), 1e-5 * difference.norm());
  }
}

TEST(FeTire, TangentOfThePressureIsExactAtAnOpenEdgeToo) {
  // Only the free nodes at the inner edge of the bead are displaced. On soft rubber under high
  // pressure the pressure on them contributes visibly to the tangent.
  const TireDescription description = small_tire();
  const Ring ring(build_mesh(description), ElementKind::full_integration);
  const RingUnknowns whole(ring, RingSymmetry::none, {});
  const RingAssembly assembly(whole);
  Materials soft = build_materials(description);
  for (Solid& solid : soft.solids) solid.law = Hyperelastic::from_young_modulus(1e5, 0.45);
  const RingElements elements(ring, soft);
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, ring.mesh().nodes());
  const int n = ring.mesh().nodes_per_sector();
  int moved_nodes = 0;
  for (int e = 0; e < ring.elements_per_sector(); ++e) {
    for (int k = 0; k < 4; ++k) {
      if (!ring.is_edge_open(e, k)) continue;
      for (int s = 0; s < ring.sectors(); ++s) {
        const int node = s * n + ring.mesh().elements[e].node[k] % n;
        u.col(node) = Eigen::Vector3d(std::sin(s), std::cos(3 * s), std::sin(2 * s + 1));
        ++moved_nodes;
      }
    }
  }
  ASSERT_EQ(moved_nodes, 2 * ring.sectors());  // the nodes at the inner edges of both beads
  const Eigen::VectorXd d = whole.compress(u);
  AssembledState state = assembly.zero_state();
  state.x = 1e-4 * d;
  numerics::SymmetricMatrix K(*assembly.pattern());
  Eigen::VectorXd f, above, below;
  ASSERT_TRUE(assembly.assemble(elements, state, 1e6, f, &K, nullptr));
  Eigen::MatrixXd Kd(d.size(), 1);
  K.multiply(d, Kd);
  const double h = 1e-7;
  AssembledState moved = state;
  moved.x = state.x + h * d;
  ASSERT_TRUE(assembly.assemble(elements, moved, 1e6, above, nullptr, nullptr));
  moved.x = state.x - h * d;
  ASSERT_TRUE(assembly.assemble(elements, moved, 1e6, below, nullptr, nullptr));
  const Eigen::VectorXd difference = (above - below) / (2 * h);
  EXPECT_LT((Kd.col(0) - difference).norm(), 1e-6 * difference.norm());
}

TEST(FeTire, HalfTheRingGivesWhatTheWholeRingGives) {
  // The results of the whole ring must equal those of the even and odd motions of half a ring
  // together.
  const TireDescription description = small_tire();
  FeTire tire = make(description);
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  const auto loaded = tire.press(*inflated, Ground{}, {0.008, 0.016});
  ASSERT_TRUE(loaded) << loaded.failure().reason;
  const auto modes = tire.modes(loaded->back(), 20);
  ASSERT_TRUE(modes) << modes.failure().reason;

  Mesh skewed =
      // Breaks the symmetry, by far less than all other errors of this test.
      build_mesh(description);
  skewed.X(1, 20) += 1e-6;
  FeTire whole(skewed, build_materials(description), {ElementKind::full_integration});
  const auto inflated_whole = whole.inflate(kPressure);
  ASSERT_TRUE(inflated_whole);
  const auto loaded_whole = whole.press(*inflated_whole, Ground{}, {0.008, 0.016});
  ASSERT_TRUE(loaded_whole) << loaded_whole.failure().reason;
  const auto modes_whole = whole.modes(loaded_whole->back(), 20);
  ASSERT_TRUE(modes_whole);
  EXPECT_NEAR(tire.stand((*loaded)[1]).force.z(),
              whole.stand((*loaded_whole)[1]).force.z(),
              1e-4 * tire.stand((*loaded)[1]).force.z());
  EXPECT_NEAR(tire.stand((*loaded)[1]).patch.area,
              whole.stand((*loaded_whole)[1]).patch.area,
              1e-3 * tire.stand((*loaded)[1]).patch.area);
  EXPECT_LT((loaded->back().u - loaded_whole->back().u).norm(), 1e-3 * loaded->back().u.norm());
  for (int k = 0; k < 20; ++k) {
    EXPECT_NEAR(
        (*modes)[k].frequency, (*modes_whole)[k].frequency, 1e-4 * (*modes_whole)[k].frequency)
        << k << " " << (*modes)[k].label();
    const Mesh& mesh = tire.mesh();
    EXPECT_EQ((*modes)[k].shape.cols(), mesh.nodes());
  }
}

/// Returns a tire with narrow sectors near the contact.
TireDescription graded_tire() {
  TireDescription tire = small_tire();
  tire.section.sector_zones = {{3, 8.0 * M_PI / 180.0}, {2, 14.0 * M_PI / 180.0}};
  return tire;
}

/// Returns the whole ring as one mesh that is not divided into sectors.
Mesh without_sectors(const Mesh& mesh) {
  const int n = mesh.nodes_per_sector(), S = mesh.sectors;
  Mesh whole = mesh;
  whole.sectors = 1;
  whole.theta.clear();
  whole.elements.clear();
  whole.clamped.clear();
  whole.sensors.clear();
  whole.X.resize(3, S * n);
  for (int s = 0; s < S; ++s) {
    whole.X.middleCols(s * n, n) = mesh.frame(s) * mesh.X;
    for (int i : mesh.clamped) whole.clamped.push_back(s * n + i);
    for (Element element : mesh.elements) {
      for (int& node : element.node) node = (s + node / n) % S * n + node % n;
      whole.elements.push_back(element);
    }
  }
  return whole;
}

TEST(FeTire, GradedSectorsGiveWhatTheSameMeshGivesWithoutThem) {
  // A mesh without sectors has one frame for all nodes and no symmetry, and it is inflated as a
  // whole. Deflections are counted from the same radius, because on unequal sectors the inflated
  // radius is not unique.
  const TireDescription description = graded_tire();
  SolverSettings settings;
  settings.tread = TreadShape::facets;  // the only surface that a mesh without sectors supports
  // Default elements are arcs in sectors, and bricks in a mesh without them.
  settings.element = ElementKind::full_integration;
  FeTire graded(build_mesh(description), build_materials(description), settings);
  FeTire whole(without_sectors(build_mesh(description)), build_materials(description), settings);
  const auto inflated = graded.inflate(kPressure);
  const auto inflated_whole = whole.inflate(kPressure);
  ASSERT_TRUE(inflated && inflated_whole);
  const double deflection = 0.01;
  const auto loaded = graded.press(*inflated, {}, {deflection});
  const auto loaded_whole =
      whole.press(*inflated_whole, {}, {deflection + inflated_whole->radius - inflated->radius});
  ASSERT_TRUE(loaded && loaded_whole);
  const double Fz = whole.stand((*loaded_whole)[0]).force.z();
  EXPECT_NEAR(graded.stand((*loaded)[0]).force.z(), Fz, 1e-5 * Fz);
  EXPECT_NEAR(
      graded.stand((*loaded)[0]).patch.area, whole.stand((*loaded_whole)[0]).patch.area, 1e-9);
  const auto modes = graded.modes(loaded->back(), 10);
  const auto modes_whole = whole.modes(loaded_whole->back(), 10);
  ASSERT_TRUE(modes && modes_whole);
  for (int k = 0; k < 10; ++k) {
    EXPECT_NEAR((*modes)[k].frequency, (*modes_whole)[k].frequency, 1e-4) << (*modes)[k].label();
    EXPECT_NE((*modes)[k].type, ModeType::other);
    EXPECT_EQ((*modes)[k].phase, (*modes_whole)[k].phase) << (*modes)[k].label();
    EXPECT_NE((*modes)[k].phase, ' ') << (*modes)[k].label();
  }
}

TEST(FeTire, GradingSectorsDoesNotTouchTheFreeTire) {
  FeTire even = make(small_tire()), graded = make(graded_tire());
  const auto a = even.inflate(kPressure), b = graded.inflate(kPressure);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->u, b->u);
  const auto modes_a = even.modes(*a, 10), modes_b = graded.modes(*b, 10);
  ASSERT_TRUE(modes_a && modes_b);
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ((*modes_a)[k].frequency, (*modes_b)[k].frequency);
    EXPECT_EQ((*modes_a)[k].label(), (*modes_b)[k].label());
  }
  EXPECT_EQ(even.total_mass(), graded.total_mass());
}

TEST(FeTire, CordsKeepTheHalfTurnSymmetryAndALopsidedSectionDoesNot) {
  TireDescription tire = small_tire();
  tire.cord_model =
      // Plies at +- angle have no mirror plane, but are symmetric under the half turn.
      CordModel::rebar;
  const Materials materials = build_materials(tire);
  EXPECT_TRUE(find_mirror(build_mesh(tire), materials).has_value());

  Mesh lopsided = build_mesh(tire);
  lopsided.X(2, 3) -= 1e-4;
  EXPECT_FALSE(find_mirror(lopsided, materials).has_value());
  Mesh one_sided_ply = build_mesh(tire);
  one_sided_ply.elements.front().rebars.clear();
  EXPECT_FALSE(find_mirror(one_sided_ply, materials).has_value());
  tire.section.sectors = 25;
  EXPECT_FALSE(find_mirror(build_mesh(tire), materials).has_value());
}

/// Forces on the tire in the wheel frame, N: those with which the rim holds the nodes it clamps
/// (from elements and gas), and the force of the gas on the whole wall.
struct RimForces {
  Eigen::Vector3d held = Eigen::Vector3d::Zero(), gas = Eigen::Vector3d::Zero();
};

RimForces rim_forces(const Ring& ring, const Materials& materials, const TireState& loaded) {
  const Mesh& mesh = ring.mesh();
  const int n = mesh.nodes_per_sector();
  RimForces sum;
  const RingElements elements(ring, materials);
  ElementBatch batch;
  batch.count = 1;
  for (int s = 0; s < ring.sectors(); ++s) {
    for (int e = 0; e < ring.elements_per_sector(); ++e) {
      Matrix38 u;
      for (int a = 0; a < 8; ++a) {
        const int node = mesh.elements[e].node[a];
        const int plane = (s + node / n) % mesh.sectors;
        u.col(a) =
            mesh.frame(s).transpose() * mesh.frame(plane) * loaded.u.col(plane * n + node % n);
      }
      Vector24 f, wall;
      batch.set(0, u, nullptr, 0);
      EXPECT_EQ(elements.evaluate(s, e, loaded.inflated->pressure, Stiffness::none, batch), 1u);
      batch.take(0, f, nullptr, nullptr, 0);
      EXPECT_EQ(elements.evaluate(s, e, 0.0, Stiffness::none, batch), 1u);
      batch.take(0, wall, nullptr, nullptr, 0);
      for (int a = 0; a < 8; ++a) {  // each force is in the frame of its node
        const int node = mesh.elements[e].node[a] % n;
        const int plane = (s + mesh.elements[e].node[a] / n) % mesh.sectors;
        sum.gas -= mesh.frame(plane) * (f - wall).segment<3>(3 * a);
        const bool is_held = std::binary_search(mesh.clamped.begin(), mesh.clamped.end(), node);
        if (is_held) sum.held += mesh.frame(plane) * f.segment<3>(3 * a);
      }
    }
  }
  return sum;
}

TEST(FeTire, GroundAndGasTogetherAreWhatTheRimHolds) {
  // Global equilibrium: the forces of the rim balance those of ground and gas.
  const TireDescription description = small_tire();
  for (const double mu : {0.0, 0.5}) {
    FeTire tire = make(description);
    const auto inflated = tire.inflate(kPressure);
    ASSERT_TRUE(inflated);
    const auto loaded = tire.press(*inflated, Ground{2e10, mu}, {0.005, 0.01});
    ASSERT_TRUE(loaded) << loaded.failure().reason;
    const Ring ring(build_mesh(description), ElementKind::full_integration);
    const RimForces rim = rim_forces(ring, tire.materials(), loaded->back());
    const double Fz = tire.stand(loaded->back()).force.z();
    EXPECT_GT(Fz, 1000.0);
    // Accuracy given by SolverSettings::tolerance.
    EXPECT_NEAR(Fz, -rim.held.z() - rim.gas.z(), 1e-4 * Fz) << mu;
    EXPECT_NEAR(0.0, rim.held.x() + rim.gas.x(), 1e-4 * Fz) << mu;
  }
}

TEST(FeTire, FrictionStiffensTheLoadedModesAndHoldsTheTreadBack) {
  // Friction changes the force only if the mesh is fine enough for points to slide apart within the
  // patch. It adds 0.5 % on the small tire's own mesh, and 1.7, 1.5 and 1.3 % on meshes that are
  // two, three and four times as fine.
  FeTire tire(build_mesh(small_tire(), {2, 2, 1}),
              build_materials(small_tire(), {2, 2, 1}),
              {.element = ElementKind::solid_shell});
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  const auto slick = tire.press(*inflated, Ground{2e10, 0.0}, {0.01, 0.02});
  const auto rough = tire.press(*inflated, Ground{2e10, 0.8}, {0.01, 0.02});
  ASSERT_TRUE(slick && rough);
  // An independent program with another kind of element, another mesh and 25 mm of deflection found
  // that friction (mu = 0.8) raises the force of this tire by 3.1 % and the lowest frequency by 15
  // %.
  const double gain =
      tire.stand(rough->back()).force.z() / tire.stand(slick->back()).force.z() - 1.0;
  EXPECT_GT(gain, 0.01);
  EXPECT_LT(gain, 0.03);
  const auto slick_modes = tire.modes(slick->back(), 5), rough_modes = tire.modes(rough->back(), 5);
  ASSERT_TRUE(slick_modes && rough_modes);
  const double stiffer = (*rough_modes)[0].frequency / (*slick_modes)[0].frequency - 1.0;
  EXPECT_GT(stiffer, 0.05);
  EXPECT_LT(stiffer, 0.3);
}

TEST(FeTire, PointsOfThePatchSlideExactlyWhereShearIsAtTheLimitOfFriction) {
  FeTire tire = make(small_tire());
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  constexpr double kMu = 0.3;
  const auto loaded = tire.press(*inflated, Ground{2e10, kMu}, {0.005, 0.012});
  ASSERT_TRUE(loaded) << loaded.failure().reason;
  int sliding = 0, sticking = 0;
  for (const ContactPatch::Point& point : tire.stand(loaded->back()).patch.points) {
    const double used = std::hypot(point.shear_x, point.shear_y) / (kMu * point.pressure);
    if (point.sticks) {
      EXPECT_LT(used, 1.0 - 1e-9);
    } else {
      EXPECT_NEAR(used, 1.0, 1e-9);
    }
    ++(point.sticks ? sticking : sliding);
  }
  EXPECT_GE(sliding, 4);
  EXPECT_GE(sticking, 4);
}

TEST(FeTire, AStateWithAnInvertedElementHasNoModesAndSaysWhere) {
  const TireDescription description = small_tire();
  FeTire tire = make(description);
  auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  auto loaded = tire.press(*inflated, Ground{}, {0.005});
  ASSERT_TRUE(loaded);
  // Moves the node through the wall, which inverts the element.
  const int node = tire.mesh().elements[5].node[4];
  inflated->u.col(node).z() += 0.1;
  loaded->back().u.col(node).z() += 0.1;
  for (const auto& modes :
       {tire.modes(*inflated, 4), tire.modes_full(*inflated, 4), tire.modes(loaded->back(), 4)}) {
    ASSERT_FALSE(modes);
    EXPECT_NE(modes.failure().reason.find("inverted"), std::string::npos) << modes.failure().reason;
    EXPECT_NE(modes.failure().reason.find("element"), std::string::npos) << modes.failure().reason;
    EXPECT_EQ(modes.failure().reason.find("buckles"), std::string::npos) << modes.failure().reason;
  }
}

TEST(FeTire, HasModesWhereverItCouldBePressed) {
  // Far beyond normal loads, elements bend so much that their enhanced strains can be found only
  // from those of the equilibrium itself. A state that did not store them would have no tangent.
  FeTire tire = make(small_tire(), ElementKind::solid_shell);
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  std::vector<double> steps;
  for (int i = 1; i <= 14; ++i) steps.push_back(0.005 * i);
  const auto loaded = tire.press(*inflated, Ground{}, steps);
  ASSERT_TRUE(loaded) << loaded.failure().reason;
  const auto modes = tire.modes(loaded->back(), 3);
  ASSERT_TRUE(modes) << modes.failure().reason;
  EXPECT_GT(modes->front().frequency, 1.0);
}

TEST(FeTire, ModesThatLanczosDoesNotFindAreAFailure) {
  // A tire without mass cannot vibrate.
  FeTire tire = make(small_tire());
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  Materials weightless = tire.materials();
  for (Solid& solid : weightless.solids) solid.density = 0.0;
  for (CordLayer& layer : weightless.layers) layer.density = 0.0;
  tire.set(weightless);
  const auto modes = tire.modes(*inflated, 4);
  ASSERT_FALSE(modes);
  EXPECT_NE(modes.failure().reason.find("0 of"), std::string::npos) << modes.failure().reason;
}

TEST(FeTire, OneSectorsWorkAnalyzesNoRing) {
  FeTire tire = make(small_tire());
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  ASSERT_TRUE(tire.modes(*inflated, 4));
  EXPECT_EQ(tire.counts().analyses, 0);
  ASSERT_TRUE(tire.press(*inflated, Ground{}, {0.002}));
  EXPECT_EQ(tire.counts().analyses, 1);
  tire.set(tire.materials());
  ASSERT_TRUE(tire.press(*inflated, Ground{}, {0.002}));
  EXPECT_EQ(tire.counts().analyses, 1);  // one analysis per mesh
}

TEST(FeTire, SolvingTwiceGivesTheSameBits) {
  FeTire tire = make(small_tire());
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  const auto first = tire.press(*inflated, Ground{}, {0.01});
  ASSERT_TRUE(tire.press(*inflated, Ground{}, {0.004, 0.02}));  // computes another path in between
  const auto second = tire.press(*inflated, Ground{}, {0.01});
  ASSERT_TRUE(first && second);
  EXPECT_EQ(tire.stand((*first)[0]).force.z(), tire.stand((*second)[0]).force.z());
  EXPECT_EQ(first->back().u, second->back().u);
}

TEST(FeTire, BucklingPressureEndsAsAFailureInWords) {
  FeTire tire = make(small_tire());
  const auto sucked = tire.inflate(-5e6);
  ASSERT_FALSE(sucked);
  EXPECT_NE(sucked.failure().reason.find("bar"), std::string::npos) << sucked.failure().reason;
}

// The walls of this element kind buckle on the path to 65 mm. The solver finds the equilibrium if
// it may shift indefinite tangents.
TEST(FeTire, TangentsThatStayIndefiniteEndAsAFailureInWords) {
  SolverSettings settings{.element = ElementKind::full_integration};
  const auto press = [&](double deflection) {
    FeTire tire(build_mesh(small_tire()), build_materials(small_tire()), settings);
    const auto inflated = tire.inflate(kPressure);
    return tire.press(*inflated, Ground{}, {deflection});
  };
  EXPECT_TRUE(press(0.065));
  settings.max_shifts = 0;
  const auto pressed = press(0.065);
  ASSERT_FALSE(pressed);
  EXPECT_NE(pressed.failure().reason.find("its tangents stay indefinite"), std::string::npos)
      << pressed.failure().reason;
  EXPECT_TRUE(press(0.04));
}

// The step fails and is halved. The factorization left by the failed step must not influence the
// result.
TEST(FeTire, AStepThatIsHalvedEndsWhereItsHalvesLead) {
  SolverSettings impatient;
  impatient.max_iterations = 6;
  int factors = 0;
  const auto press = [&](const std::vector<double>& deflections) {
    FeTire tire(build_mesh(small_tire()), build_materials(small_tire()), impatient);
    const auto inflated = tire.inflate(kPressure);
    auto pressed = tire.press(*inflated, Ground{}, deflections);
    factors = tire.counts().factorizations;
    return pressed;
  };
  const auto by_halves = press({0.01, 0.02});
  const int of_halves = factors;
  const auto halved = press({0.02});
  ASSERT_TRUE(by_halves && halved);
  EXPECT_GT(factors, of_halves);  // proves that the whole step was tried first
  EXPECT_LT((halved->back().u - by_halves->back().u).norm(), 1e-14 * halved->back().u.norm());
}

TEST(FeTire, TooMuchDeflectionEndsAsAFailureNamingStepResidualAndElement) {
  SolverSettings impatient;
  impatient.element = ElementKind::full_integration;
  impatient.max_iterations = 8;
  FeTire tire(build_mesh(small_tire()), build_materials(small_tire()), impatient);
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  double rim = 0.0;
  for (const int node : tire.mesh().clamped)
    rim = std::max(rim, std::hypot(tire.mesh().X(0, node), tire.mesh().X(2, node)));
  constexpr double kFromIt = 1e-3;
  const auto crushed = tire.press(*inflated, Ground{}, {0.01, inflated->radius - rim - kFromIt});
  ASSERT_FALSE(crushed);
  EXPECT_NE(crushed.failure().reason.find("load step 2 of 2"), std::string::npos)
      << crushed.failure().reason;
  EXPECT_NE(crushed.failure().reason.find("element"), std::string::npos);
  const auto inside = tire.press(*inflated, Ground{}, {0.01, inflated->radius - rim + kFromIt});
  ASSERT_FALSE(inside);
  EXPECT_NE(inside.failure().reason.find("the rim holds the tire up to"), std::string::npos)
      << inside.failure().reason;
}

}  // namespace
}  // namespace latsch::fe_tire
