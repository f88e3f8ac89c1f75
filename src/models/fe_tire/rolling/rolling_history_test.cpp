// SPDX-License-Identifier: Apache-2.0
// Forces of the history against closed forms, and the equilibrium of a tire that rolls with them.
#include "models/fe_tire/rolling/rolling_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/element/hex8_shape.h"
#include "models/fe_tire/history/point_strains.h"
#include "models/fe_tire/motion/spinning_tire.h"
#include "models/fe_tire/rolling/rolling_losses.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::fe_tire {
namespace {

constexpr double kInside = 2.6e5, kTurning = 60.0;  // Pa, rad/s

/// Tire B with few columns, whose rubbers and cords have Prony terms.
TireDescription relaxing_tire(int sectors, bool is_zoned = false) {
  TireDescription tire = reference_tire_b();
  tire.element = ElementKind::solid_shell;
  tire.section.meridional = 13;
  tire.section.sectors = sectors;
  if (is_zoned) tire.section.sector_zones = {{8, 0.035}, {8, 0.07}};
  for (Rubber& rubber : tire.rubbers) rubber.prony = {{0.3, 2e-3}, {0.2, 2e-2}};
  for (CordPly& ply : tire.plies) ply.prony = {{0.05, 1e-2}};
  return tire;
}

/// The whole ring of a tire with its history.
struct Turning {
  Ring ring;
  RingElements elements;
  RingUnknowns unknowns;
  RingAssembly assembly;
  RollingHistory history;

  Turning(const TireDescription& tire, const Mesh& mesh, const Inflated& round)
      : ring(mesh, tire.element),
        elements(ring, build_materials(tire)),
        unknowns(ring, RingSymmetry::none, {}),
        assembly(unknowns),
        history(elements, build_losses(tire), round) {}

  /// Returns the forces of the history at displacements u and given enhanced strains alpha.
  Eigen::VectorXd forces(const Eigen::Matrix3Xd& u, const Eigen::VectorXd& alpha) {
    AssembledState state{unknowns.compress(u), alpha};
    history.update(unknowns, state, kTurning);
    Eigen::VectorXd with, without;
    AssembledState again = state;
    EXPECT_TRUE(assembly.assemble(history.elements(), state, 0.0, with, nullptr, nullptr));
    EXPECT_TRUE(assembly.assemble(elements, again, 0.0, without, nullptr, nullptr));
    return with - without;
  }
};

Inflated unloaded(const Mesh& mesh) {
  Inflated still;
  still.u = Eigen::Matrix3Xd::Zero(3, mesh.nodes_per_sector());
  still.alpha = Eigen::VectorXd::Zero(8 * std::ssize(mesh.elements));
  return still;
}

/// u_y = a cos(n theta - phase) at all places of the section: a pure shear along the
/// circumference.
Eigen::Matrix3Xd turning_wave(const Mesh& mesh, double a, int n, double phase) {
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, mesh.nodes());
  for (int s = 0; s < mesh.sectors; ++s)
    u.middleCols(s * mesh.nodes_per_sector(), mesh.nodes_per_sector())
        .row(1)
        .setConstant(a * std::cos(n * mesh.angle(s) - phase));
  return u;
}

/// Work of the relaxed shear stress on the wave: with the shear gamma = a n/r sin(n theta), half
/// the integral of G (a n/r)^2 over the volume. All of tire B's rubber has the same modulus.
double elastic_work(const TireDescription& tire, const Mesh& mesh, double a, int n) {
  const Materials materials = build_materials(tire);
  const double G = 2.0 * std::get<Hyperelastic>(materials.solids[0].law).C10;
  double sum = 0.0;
  for (int s = 0; s < mesh.sectors; ++s) {
    for (const Element& element : mesh.elements) {
      const HexShape shape =
          make_shape(ElementKind::full_integration, mesh.coordinates(element, s));
      for (int q = 0; q < 8; ++q) {
        const Eigen::Vector3d X =
            shape.X * shape_functions(kGauss * kXi[q], kGauss * kEta[q], kGauss * kZeta[q]);
        sum += shape.dV[q] * std::pow(a * n, 2) / (X.x() * X.x() + X.z() * X.z());
      }
    }
  }
  return 0.5 * G * sum;
}

/// Error of the history's forces on a wave: their work on the wave over that of the relaxed stress
/// is the complex modulus. Material that flows toward decreasing theta sees cos(n theta) as Re
/// e^(i n Omega t), so its stress is G' cos(n theta) + G'' sin(n theta).
std::complex<double> error_of_history(bool is_zoned, int sectors, int n) {
  TireDescription tire = relaxing_tire(sectors, is_zoned);
  for (CordPly& ply : tire.plies) ply.prony.clear();
  Mesh mesh = build_mesh(tire);
  mesh.clamped.clear();  // the wave moves the rim, too
  Turning turning(tire, mesh, unloaded(mesh));
  constexpr double kSmall = 1e-6;  // m
  const Eigen::Matrix3Xd u = turning_wave(mesh, kSmall, n, 0.0);
  const Eigen::VectorXd alpha = turning.assembly.zero_state().alpha;
  const Eigen::VectorXd h = turning.forces(u, alpha);
  const Eigen::VectorXd x = turning.unknowns.compress(u);
  const Eigen::VectorXd y =
      turning.unknowns.compress(turning_wave(mesh, kSmall, n, 0.5 * std::numbers::pi));
  const double elastic = elastic_work(tire, mesh, kSmall, n);
  const std::complex<double> found(h.dot(x) / elastic, h.dot(y) / elastic);
  const std::complex<double> expected = relative_modulus(tire.rubbers[0].prony, n * kTurning) - 1.0;
  return found - expected;
}

TEST(RollingHistory, OfAWaveIsTheComplexModulusWithSecondOrder) {
  const std::complex<double> coarse = error_of_history(false, 60, 4),
                             fine = error_of_history(false, 120, 4);
  EXPECT_LT(std::abs(coarse), 0.03);
  EXPECT_NEAR(std::log2(std::abs(coarse) / std::abs(fine)), 2.0, 0.15);
}

TEST(RollingHistory, OfAWaveDoesNotDependOnTheWidthsOfSectors) {
  EXPECT_LT(std::abs(error_of_history(true, 60, 2)), 0.02);
}

TEST(RollingHistory, OfARoundTireIsNone) {
  for (const bool is_zoned : {false, true}) {
    const TireDescription tire = relaxing_tire(60, is_zoned);
    FeTire fe(tire);
    const Inflated rest = *fe.inflate(kInside);
    Turning turning(tire, fe.mesh(), rest);
    const Eigen::Matrix3Xd u = rest.u.replicate(1, fe.mesh().sectors);
    const Eigen::VectorXd h = turning.forces(u, rest.alpha.replicate(fe.mesh().sectors, 1));
    EXPECT_LT(h.cwiseAbs().maxCoeff(), 1e-6) << is_zoned;  // N
    // A tire that has grown by its spin is as round. Its stresses differ from those at rest by the
    // second order of the width, where widths change: 1e-3 N m of moment about the axle, at most.
    const Inflated spun = *SpinningTire(fe).inflate(rest, kTurning);
    const Eigen::VectorXd grown = turning.forces(spun.u.replicate(1, fe.mesh().sectors),
                                                 spun.alpha.replicate(fe.mesh().sectors, 1));
    const Eigen::Matrix3Xd f = turning.unknowns.expand(grown);
    double moment = 0.0;
    for (int k = 0; k < fe.mesh().nodes(); ++k)
      moment -= fe.mesh().X(2, k % fe.mesh().nodes_per_sector()) * f(0, k);
    EXPECT_LT(std::abs(moment), 1e-3) << is_zoned;
  }
}

TEST(RollingHistory, RelaxingStressesAreThoseOfTheStrainsAtThePoints) {
  const TireDescription tire = relaxing_tire(60);
  FeTire fe(tire);
  const Inflated rest = *fe.inflate(kInside);
  Turning turning(tire, fe.mesh(), rest);
  const Eigen::VectorXd x =
      turning.unknowns.compress(rest.u.replicate(1, 60) + turning_wave(fe.mesh(), 3e-3, 3, 0.3));
  const int per_sector = turning.ring.elements_per_sector();
  for (int e = 0; e < per_sector; e += 5) {
    const double* alpha = rest.alpha.data() + 8 * e;
    const Matrix38 u = turning.unknowns.gather(7, e, x);
    ElementBatch batch;
    batch.count = 1;
    batch.set(0, u, alpha, 8);
    PointStresses S;
    const ElementLaw& law = turning.elements.law(7, e);
    relaxing_stresses(law, batch, S);
    const PointStrains strains = point_strains(law, u, alpha);
    for (int q = 0; q < 8; ++q) {
      const Vector6 E = strains.E.col(q);
      const Vector6 expected = law.linear ? E : isochoric_stress(law.rubber, E);
      for (int r = 0; r < 6; ++r)
        EXPECT_NEAR(S.solid[q][r][0], expected[r], 1e-9 * (1e-3 + expected.norm()));
    }
    for (std::size_t k = 0; k < law.cords.size(); ++k)
      for (int q = 0; q < 4; ++q)
        EXPECT_NEAR(S.cords[k][q][0],
                    law.cords[k].layer.E_tension * strains.cords[k][q],
                    2e-2 * law.cords[k].layer.E_tension * std::abs(strains.cords[k][q]) + 1e3);
  }
}

/// Tire B with few columns and a loss factor, rolling freely.
struct LossyWheel {
  RollingState state;
  double viscous = 0.0;  // W
  double load = 0.0;     // N
};
LossyWheel lossy_free_wheel(double loss_factor, int sectors) {
  TireDescription tire = relaxing_tire(sectors);
  for (Rubber& rubber : tire.rubbers) rubber.prony = *constant_loss_factor(loss_factor, 0.1, 1e3);
  for (CordPly& ply : tire.plies) ply.prony.clear();
  FeTire fe(tire);
  RollingTire rolling(fe);
  const Inflated inflated = *fe.inflate(kInside);
  rolling.set_history(build_losses(tire), inflated);
  const auto pressed =
      fe.advance(fe.over(inflated, {}, FeTire::Poses::any), {FeTire::below(inflated, 0.02)});
  const RollingState start = rolling.start(pressed->back());
  RollingCase of;
  of.speed = 20.0;
  of.spin = of.speed / 0.312;
  of.load = 4000.0;
  of.drive = 0.0;
  const auto state = rolling.roll(start, of);
  if (!state) throw std::runtime_error(state.failure().reason);
  const LossMeter meter(fe, build_losses(tire), inflated);
  return {*state, meter.measure(state->u, state->alpha, state->of.spin).rubber, 4000.0};
}

/// Error of the balance of power (E.1), relative to the power that is lost.
double open_balance(const LossyWheel& wheel) {
  const RollingForces& forces = wheel.state.forces;
  const double lost = wheel.viscous + forces.friction_power;
  return -forces.force.x() * wheel.state.of.speed / lost - 1.0;
}

TEST(RollingHistory, AFreeWheelIsBrakedByWhatItLoses) {
  const LossyWheel wheel = lossy_free_wheel(0.15, 60);
  const RollingForces& forces = wheel.state.forces;
  EXPECT_NEAR(forces.force.z(), wheel.load, 1e-6 * wheel.load);
  EXPECT_NEAR(forces.drive, 0.0, 1e-6 * wheel.load * wheel.state.of.height);
  EXPECT_LT(forces.force.x(), -0.003 * wheel.load);
  EXPECT_GT(forces.force.x(), -0.02 * wheel.load);
  // The load acts ahead of the axle: without moment about the axle, x_z Fz = -R_l Fx.
  EXPECT_NEAR(-forces.moment.y(),
              -forces.force.x() * wheel.state.loaded_radius(),
              1e-6 * wheel.load * wheel.state.of.height);
  // Drag and power agree within some percent: about as much as those of an elastic tire, whose
  // friction errs by the distance of its points.
  const double coarse = open_balance(wheel), fine = open_balance(lossy_free_wheel(0.15, 120));
  EXPECT_LT(std::abs(coarse), 0.03);
  EXPECT_LT(std::abs(fine), 0.03);
  RecordProperty("coarse", std::to_string(coarse));
  RecordProperty("fine", std::to_string(fine));
}

TEST(RollingHistory, AWheelOfStrongLossesRollsToo) {
  const LossyWheel wheel = lossy_free_wheel(0.3, 60), weaker = lossy_free_wheel(0.15, 60);
  EXPECT_LT(wheel.state.forces.force.x(), weaker.state.forces.force.x());
}

}  // namespace
}  // namespace latsch::fe_tire
