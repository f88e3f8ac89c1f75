// SPDX-License-Identifier: Apache-2.0
// Slopes of a tire's results (loads, frequencies, its patch) with respect to the numbers of its
// description: moduli, densities, thicknesses, angles, spacings, pressure.
//
// At an equilibrium f(x; h, p) = 0 at the height h over frictionless ground, with the tangent K of
// elements and ground,
//   dx/dp = -K^-1 (df/dp + df/dh dh/dp)                                                       (S.1)
//   dFz/dp = dFz/dp|x - dFz/dx K^-1 df/dp + dFz/dh dh/dp,   dFz/dx = -df/dh^T                 (S.2)
// so the loads need one solution w = K^-1 df/dh per state for all variables. For a mode with unit
// mass,
//   d(omega^2)/dp = phi^T (dK/dp - omega^2 dM/dp) phi + g dx/dp,   g = phi^T dK/dx phi        (S.3)
// where g dx/dp needs one solution z = K^-1 g per mode for any number of variables. A pair of equal
// frequency moves together because of symmetry. [Haug, Choi & Komkov, Design Sensitivity Analysis
// of Structural Systems, Academic Press 1986]
//
// Every slope is thus a derivative of the elements' energy along held motions w, phi, z
// (hex8_motions.h), on the ring or, if all sectors are the same, on one sector. Its derivative by a
// number is a central difference, exact for moduli and pressure, in which it is linear. Other
// numbers need small steps: the law of cords that become taut bends within strains of 1e-4
// (cord_law.h), and steps of 1e-4 of an angle left errors of 1e-5 in modes of a tire with such
// cords. For the inflated tire (S.1) is solved for all numbers; masses and the position of the tire
// are moved along its solution. Matrices are never differenced: their rounding errors, which stiff
// belts make large, would be divided by the step.
//
// An error of a shape enters its slope linearly, but the frequency only as its square. So shapes
// are solved further until slopes are accurate to 1e-6; plain trials do not pay for that.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"

namespace latsch::fe_tire {

/// The tire with a number moved.
struct VariedTire {
  Mesh mesh;
  Materials materials;
  double pressure = 0.0;  // Pa, that of tests at the tire's own pressure
};

/// One number of the description, moved by -step and step, in its own unit.
struct Variation {
  VariedTire below, above;
  double step = 0.0;
  bool moves_pressure = false;
};

/// True if two meshes differ only in coordinates.
bool same_topology(const Mesh& a, const Mesh& b);

class TireSlopes {
 public:
  /// The meshes of all variations must have the tire's topology. The tire must outlive this object.
  /// Slopes of states that the tire passes on its paths meanwhile are cheaper, because the solver's
  /// factorization is near (one TireSlopes a tire at a time).
  TireSlopes(FeTire& tire, std::vector<Variation> variations);
  ~TireSlopes();

  int variables() const;

  /// Slopes of the inflated tire, one value a variable.
  struct OfInflated {
    Eigen::MatrixXd x;                      // [sector unknowns x variables]
    Eigen::VectorXd radius, growth, width;  // m/unit
    Eigen::VectorXd pressure;               // Pa/unit
  };
  Result<OfInflated> of_inflated(const Inflated& inflated);
  /// Slopes of its mass properties, kg/unit and kg m^2/unit, one value a variable.
  struct OfMass {
    Eigen::VectorXd mass, spin_inertia, diametral_inertia;
  };
  Result<OfMass> of_mass(const Inflated& inflated);
  /// Slopes of modes of the inflated tire, Hz/unit [modes x variables].
  Result<Eigen::MatrixXd> of_modes(const Inflated& inflated, const std::vector<Mode>& modes);

  /// Slopes of a state on flat ground without friction. A state with friction gives a Failure.
  struct OfState {
    Eigen::VectorXd force;   // N/unit, at constant height
    double by_height = 0.0;  // N/m, with respect to the height
  };
  Result<OfState> of_state(const TireState& state);
  /// Returns the slope of the wheel's height at constant load, m/unit.
  static Eigen::VectorXd height_under_load(const OfState& of) { return -of.force / of.by_height; }
  /// Slopes of the patch of such a state, m/unit and m^2/unit, while the height moves by `height`
  /// (m/unit). The state is moved by (S.1) and the patch measured on both sides. Where another line
  /// of the tread becomes the longest or the widest, a slope is one-sided.
  struct OfPatch {
    Eigen::VectorXd length, width, area;
  };
  Result<OfPatch> of_patch(const TireState& state, const Eigen::VectorXd& height);
  /// Slopes of modes about the state, Hz/unit [modes x variables], while the height moves by
  /// `height` (m/unit).
  Result<Eigen::MatrixXd> of_modes(const TireState& state,
                                   const std::vector<Mode>& modes,
                                   const Eigen::VectorXd& height);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::fe_tire
