// SPDX-License-Identifier: Apache-2.0
// What the equations take: a state, what is asked of it, and what of a tire they would else compute
// for every state.
#pragma once

#include "models/magic_formula/parameters.h"
#include "numerics/kernels/dual_number.h"

namespace latsch::magic_formula {

/// What a steady-state tire is asked. SI, ISO-W.
template <class R>
struct StateOf {
  R Fz;     // N
  R kappa;  // -1: locked
  R alpha;  // rad
  R gamma;  // rad
  R phit;   // turn slip, 1/m
  R Vx;     // m/s
  R p;      // Pa
};

/// Which outputs beside Fx, Fy and what they are made of.
struct Asked {
  bool Mx = true, My = true, Mz = true;
  bool deflection = true, patch = true, relaxation = true;
};

/// What depends on the parameters alone. K: double, or DualNumber where slopes in coefficients are
/// asked.
template <class K>
struct TireConstantsOf {
  TireConstantsOf(const CoefficientsOf<K>& coefficients, Version version);

  CoefficientsOf<K> p;
  bool mf52;
  K Fz0_prime;  // (4.E1)
  K Q_FZ1;      // (4)
  K Q_A1, Q_A2;
  // What every state would divide by.
  K per_FNOMIN, per_Fz0_prime, per_NOMPRES, per_LONGVL, per_VXLOW, per_FZMIN, per_LMUY;
  K R0_per_V0;
};
using TireConstants = TireConstantsOf<double>;

extern template struct TireConstantsOf<double>;
extern template struct TireConstantsOf<DualNumber>;

}  // namespace latsch::magic_formula
