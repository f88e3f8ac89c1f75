// SPDX-License-Identifier: Apache-2.0
// Slopes of what a tire answers (loads, frequencies, its patch) in the numbers of its description:
// moduli, densities, thicknesses, angles, spacings, pressure.
//
// At an equilibrium f(x; h, p) = 0 of the height h over frictionless ground, with the tangent K of
// elements and ground,
//   dx/dp = -K^-1 (df/dp + df/dh dh/dp)                                                       (S.1)
//   dFz/dp = dFz/dp|x - dFz/dx K^-1 df/dp + dFz/dh dh/dp,   dFz/dx = -df/dh^T                 (S.2)
// so the loads of all variables take one solution w = K^-1 df/dh a state. Of a mode with unit mass,
//   d(omega^2)/dp = phi^T (dK/dp - omega^2 dM/dp) phi + g dx/dp,   g = phi^T dK/dx phi        (S.3)
// where g dx/dp takes one solution z = K^-1 g a mode, of however many variables; and a pair of
// equal frequency moves together, as symmetry holds it. [Haug, Choi & Komkov, Design Sensitivity
// Analysis of Structural Systems, Academic Press 1986]
//
// So everything about a state is a derivative of the elements' energy along motions w, phi, z that
// are held (hex8_motions.h), on the ring or, where all sectors are the same, on one of them.
// Numbers move it by central differences of it: exact for moduli and pressure, in which it is
// linear. Others need small steps: the law of cords that are going taut bends within strains of
// 1e-4 (cord_law.h), and steps of 1e-4 of an angle left 1e-5 in modes of a tire that has such. Of
// the inflated tire (S.1) is solved for all numbers; masses and where it is are moved along it.
// Matrices are never differenced: rounding in them, which stiff belts make large, would be divided
// by the step.
//
// An error of a shape is one of its slopes, while that of a frequency is its square: shapes are
// solved on until slopes hold 1e-6, which plain trials do not pay for.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"

namespace latsch::fe_tire {

/// The tire as it is with a number moved.
struct VariedTire {
  Mesh mesh;
  Materials materials;
  double pressure = 0.0;  // Pa, that of the tests at its own pressure
};

/// One number of the description, moved by -step and step, in its own unit.
struct Variation {
  VariedTire below, above;
  double step = 0.0;
  bool moves_pressure = false;
};

/// Whether two meshes differ in coordinates alone.
bool same_topology(const Mesh& a, const Mesh& b);

class TireSlopes {
 public:
  /// The meshes of all variations have the tire's topology. The tire must outlive them. Slopes of
  /// states that it passes on its ways meanwhile cost less: what factor led there is near, and none
  /// of their own is needed (one set of slopes a tire at a time).
  TireSlopes(FeTire& tire, std::vector<Variation> variations);
  ~TireSlopes();

  int variables() const;

  /// Of the inflated tire, a value a variable.
  struct OfInflated {
    Eigen::MatrixXd x;                      // [sector unknowns x variables]
    Eigen::VectorXd radius, growth, width;  // m/unit
    Eigen::VectorXd pressure;               // Pa/unit
  };
  Result<OfInflated> of_inflated(const Inflated& inflated);
  /// Of its mass properties, kg/unit and kg m^2/unit, a value a variable.
  struct OfMass {
    Eigen::VectorXd mass, spin_inertia, diametral_inertia;
  };
  Result<OfMass> of_mass(const Inflated& inflated);
  /// Hz/unit [modes x variables] of modes of the inflated tire.
  Result<Eigen::MatrixXd> of_modes(const Inflated& inflated, const std::vector<Mode>& modes);

  /// Of a state on flat ground without friction; one with friction is refused, with a Failure.
  struct OfState {
    Eigen::VectorXd force;   // N/unit, at a height that is held
    double by_height = 0.0;  // N/m
  };
  Result<OfState> of_state(const TireState& state);
  /// m/unit: how the height of the wheel moves while the load is held.
  static Eigen::VectorXd height_under_load(const OfState& of) { return -of.force / of.by_height; }
  /// Of the patch of such a state, m/unit and m^2/unit, while the height moves by `height`
  /// (m/unit): the state is moved, (S.1), and the patch measured on both sides. Where another line
  /// of the tread becomes the longest or the widest, a slope is that of one side.
  struct OfPatch {
    Eigen::VectorXd length, width, area;
  };
  Result<OfPatch> of_patch(const TireState& state, const Eigen::VectorXd& height);
  /// Hz/unit [modes x variables] of modes about the state, while the height moves by `height`
  /// (m/unit).
  Result<Eigen::MatrixXd> of_modes(const TireState& state,
                                   const std::vector<Mode>& modes,
                                   const Eigen::VectorXd& height);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::fe_tire
