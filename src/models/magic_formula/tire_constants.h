// SPDX-License-Identifier: Apache-2.0
// Inputs of the equations: a state, the requested outputs, and constants of a tire that would
// otherwise be computed for every state.
#pragma once

#include "models/magic_formula/parameters.h"
#include "numerics/kernels/dual_number.h"

namespace latsch::magic_formula {

/// State of a tire in steady motion, in SI units and the axes ISO-W.
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

/// Outputs that are requested in addition to Fx, Fy and the quantities from which they are
/// computed.
struct AskedOutputs {
  bool Mx = true, My = true, Mz = true;
  bool deflection = true, patch = true, relaxation = true;
};

/// Constants that depend on the coefficients alone. K is double, or DualNumber for derivatives with
/// respect to coefficients.
template <class K>
struct TireConstantsOf {
  TireConstantsOf(const CoefficientsOf<K>& coefficients, Version version);

  CoefficientsOf<K> p;
  bool mf52;
  K Fz0_prime;  // (4.E1)
  K Q_FZ1;      // (4)
  K Q_A1, Q_A2;
  // Reciprocals of divisors used in every state.
  K per_FNOMIN, per_Fz0_prime, per_NOMPRES, per_LONGVL, per_VXLOW, per_FZMIN, per_LMUY;
  K R0_per_V0;
};
using TireConstants = TireConstantsOf<double>;

extern template struct TireConstantsOf<double>;
extern template struct TireConstantsOf<DualNumber>;

}  // namespace latsch::magic_formula
