// SPDX-License-Identifier: Apache-2.0
// Derivatives ("slopes") of a tire's results (loads, frequencies, contact patch) with respect to
// the parameters of its description: moduli, densities, thicknesses, angles, spacings, pressure.
//
// At an equilibrium f(x; h, p) = 0 at the height h over frictionless ground, with the tangent K of
// elements and ground,
//   dx/dp = -K^-1 (df/dp + df/dh dh/dp)                                                       (S.1)
//   dFz/dp = dFz/dp|x - dFz/dx K^-1 df/dp + dFz/dh dh/dp,   dFz/dx = -df/dh^T                 (S.2)
// so the derivatives of the loads need one solution w = K^-1 df/dh per state for all parameters.
// For a mode with unit mass,
//   d(omega^2)/dp = phi^T (dK/dp - omega^2 dM/dp) phi + g dx/dp,   g = phi^T dK/dx phi        (S.3)
// where g dx/dp needs one solution z = K^-1 g per mode for any number of parameters. The two modes
// of a pair keep equal frequencies because of symmetry. [Haug, Choi & Komkov, Design Sensitivity
// Analysis of Structural Systems, Academic Press 1986]
//
// Every slope is thus the derivative, with respect to a parameter, of the elements' energy along
// constant motions w, phi, z (hex8_motions.h), on the ring or, if all sectors are the same, on one
// sector. It is computed as a central difference, which is exact for moduli and pressure, because
// the energy is linear in them. Other parameters need small steps: the law of cords that become
// taut changes its slope within strains of 1e-4 (cord_law.h), and steps of 1e-4 of an angle left
// errors of 1e-5 in modes of a tire with such cords. For the inflated tire (S.1) is solved for all
// parameters; masses and the position of the tire change along its solution. Differences of
// matrices are not used, because their rounding errors, which stiff belts make large, would be
// divided by the step.
//
// An error of a mode shape enters the slope of its frequency linearly, but the frequency itself
// only quadratically. For slopes the shapes are therefore computed more accurately, until slopes
// are accurate to 1e-6; trials without slopes do not need this work.
//
// Forces of a rolling tire follow from (S.1) itself, because its tangent is not symmetric: one
// solution for each parameter serves all of them (steady_slopes.cpp).
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/rolling_friction.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::fe_tire {

/// The tire with one parameter changed.
struct VariedTire {
  Mesh mesh;
  Materials materials;
  double pressure = 0.0;                         // Pa, pressure in tests at the tire's own pressure
  std::optional<RollingFriction> friction = {};  // with the ground, of the tire's file
};

/// One parameter of the description, changed by -step and by +step; the step is in the parameter's
/// unit.
struct Variation {
  VariedTire below, above;
  double step = 0.0;
  bool moves_pressure = false;
};

/// Returns true if two meshes differ only in the coordinates of their nodes.
bool same_topology(const Mesh& a, const Mesh& b);

class TireSlopes {
 public:
  /// The meshes of all variations must have the same topology as the tire's. The tire must outlive
  /// this object. As long as this object exists, the tire reports the states on its paths; slopes
  /// of these states cost less, because the solver's factorization is near. Only one TireSlopes may
  /// exist per tire at a time.
  TireSlopes(FeTire& tire, std::vector<Variation> variations);
  ~TireSlopes();

  int variables() const;

  /// Derivatives of the inflated tire, one value per parameter.
  struct OfInflated {
    Eigen::MatrixXd x;                      // displacements, m/unit [sector unknowns x parameters]
    Eigen::VectorXd radius, growth, width;  // m/unit
    Eigen::VectorXd pressure;               // Pa per unit of the parameter
  };
  Result<OfInflated> of_inflated(const Inflated& inflated);
  /// Derivatives of the tire's mass properties, kg/unit and kg m^2/unit, one value per parameter.
  struct OfMass {
    Eigen::VectorXd mass, spin_inertia, diametral_inertia;
  };
  Result<OfMass> of_mass(const Inflated& inflated);
  /// Returns the derivatives of modes of the inflated tire, Hz/unit [modes x parameters].
  Result<Eigen::MatrixXd> of_modes(const Inflated& inflated, const std::vector<Mode>& modes);

  /// Derivatives of a state on flat ground without friction. A state with friction gives a Failure.
  struct OfState {
    Eigen::VectorXd force;   // vertical force, N/unit, at constant height of the wheel
    double by_height = 0.0;  // N/m, derivative of the vertical force by the height
  };
  Result<OfState> of_state(const TireState& state);
  /// Returns the derivative of the wheel's height at constant load, m/unit.
  static Eigen::VectorXd height_under_load(const OfState& of) { return -of.force / of.by_height; }
  /// Derivatives of the contact patch of such a state, m/unit and m^2/unit, if the derivative of
  /// the wheel's height is `height` (m/unit). The state is moved by (S.1) in both directions and
  /// the patch measured. If on one side another line of the tread becomes the longest or the
  /// widest, the derivative is one-sided.
  struct OfPatch {
    Eigen::VectorXd length, width, area;
  };
  Result<OfPatch> of_patch(const TireState& state, const Eigen::VectorXd& height);
  /// Returns the derivatives of modes about the state, Hz/unit [modes x parameters], if the
  /// derivative of the wheel's height is `height` (m/unit).
  Result<Eigen::MatrixXd> of_modes(const TireState& state,
                                   const std::vector<Mode>& modes,
                                   const Eigen::VectorXd& height);
  /// True if a parameter changes the tire's shape, so that slopes of a rolling tire are not known.
  bool move_shape() const;
  /// Laws of friction of the tire's file with a parameter decreased and increased.
  using Frictions = std::pair<RollingFriction, RollingFriction>;
  /// Returns those of a parameter; none if it changes no friction.
  std::optional<Frictions> friction(int parameter) const;
  /// The effects of a parameter that depend on the test.
  struct RollsWith {
    std::optional<Frictions> friction = {};  // none: the friction with the ground stays
    double spin = 0.0;  // relative change of the spin per unit, if the spin is stated
  };
  /// Returns the derivatives of a steady state that `rolling`, a roller of this tire, found, by
  /// every parameter: (R.3) of rolling_tangent.h. No parameter may change the shape. If
  /// `is_at_own_pressure` is false, the tire's own pressure has no effect.
  Result<std::vector<RollingRates>> of_rolling(RollingTire& rolling,
                                               const RollingState& state,
                                               const std::vector<RollsWith>& with,
                                               bool is_at_own_pressure);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::fe_tire
