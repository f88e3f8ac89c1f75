// SPDX-License-Identifier: Apache-2.0
// Damped modes of a tire that does not spin, with its rim clamped: its rubber and its cords relax.
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

namespace latsch::fe_tire {

/// A damped mode. `mode` has the frequency |s|/(2 pi), the names of the mode that it grows out of,
/// and the shape at the instant of its largest displacements.
struct DecayingMode {
  Mode mode;
  double damping = 0.0;  // share of critical damping, -Re s/|s|
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
  Materials stiffened(double omega) const;

  FeTire& tire_;
  const LossMaterials& losses_;
};

}  // namespace latsch::fe_tire
