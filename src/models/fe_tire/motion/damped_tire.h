// SPDX-License-Identifier: Apache-2.0
// Damped modes of a tire whose rubber and cords relax: at rest with its rim clamped, off the ground
// also of a tire that spins or whose rim moves (damped_waves.cpp).
//
// The tire vibrates in the coordinates of kBasis times as many modes as are asked for. They are
// modes of the tire with the moduli that its rubbers and cords have at a frequency amid those
// wanted, about the state of the relaxed tire. The stiffness of a part that relaxes is
//   K_r(i, j) = integral of dE_i : C dE_j dV
// over its points, with the strains dE of shape i, enhanced strains included, and the slope C of
// the stress that relaxes. Each vibration has the moduli of its own frequency (free_vibrations.h),
// so frequencies are higher than those of the relaxed tire.
#pragma once

#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/history/free_vibrations.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/motion/spinning_tire.h"

namespace latsch::fe_tire {

/// A damped mode. `mode` has the frequency |s|/(2 pi), the names of the mode that it grows out of,
/// and the shape at the instant of its largest displacements.
struct DecayingMode {
  Mode mode;
  double damping = 0.0;  // share of critical damping, -Re s/|s|
};

/// A damped mode of a tire that spins or whose rim moves. `mode` is named as if it were not damped;
/// its frequencies are |s|/(2 pi), with s as seen from axes that do not spin and from the tire, and
/// its shape is that at the instant 0 of u = Re(shape exp(s t)).
struct DecayingWave {
  SpinningMode mode;
  double damping = 0.0;  // share of critical damping, -Re s/|s|, in axes that do not spin
};

class DampedTire {
 public:
  /// Modes in the basis for each damped mode that is asked for.
  static constexpr double kBasis = 2.5;

  /// Keeps references to the tire and the losses.
  DampedTire(FeTire& tire, const LossMaterials& losses) : tire_(tire), losses_(losses) {}

  /// Returns the `count` lowest damped modes of the inflated, unloaded tire. A Failure says why
  /// there are none, or which mode is overdamped.
  Result<std::vector<DecayingMode>> modes(const Inflated& inflated, int count);
  /// Returns the `count` lowest damped modes about a state on the ground. Points in contact stay in
  /// contact, and with friction they stick.
  Result<std::vector<DecayingMode>> modes(const TireState& state, int count);

  /// Returns the `count` lowest damped modes of the inflated tire as it spins (SpinningTire). In
  /// axes that spin along no material passes the mesh, so the history of a wave is that of its
  /// frequency on the tire, sigma = omega - n Omega:
  ///   [K(n) - Omega^2 W(n) + sum_r K_r(n) sum_i beta_ri i sigma tau_ri/(1 + i sigma tau_ri)
  ///    + omega Omega (iG)(n) - omega^2 M(n)] phi = 0                                         (H.6)
  /// in waves of each number n of the tire with the moduli of a frequency amid those wanted.
  Result<std::vector<DecayingWave>> modes(const Inflated& spinning, const Rim& rim, int count);

  /// Stiffness in the coordinates of shapes of unit mass, 1/s^2.
  struct Projected {
    Eigen::MatrixXd elements;  // all elements; pressure and ground are left out
    std::vector<RelaxingStiffness> parts;
  };
  /// Return the stiffness of the tire with the given materials in the coordinates of shapes [3 x
  /// nodes, sector frames]. A Failure names an element that has no tangent.
  Result<Projected> project(const Materials& materials,
                            const Inflated& inflated,
                            const std::vector<Mode>& shapes) const;
  Result<Projected> project(const Materials& materials,
                            const TireState& state,
                            const std::vector<Mode>& shapes) const;

 private:
  template <class State>
  Result<std::vector<DecayingMode>> modes_about(const State& state, int count);

  FeTire& tire_;
  const LossMaterials& losses_;
};

}  // namespace latsch::fe_tire
