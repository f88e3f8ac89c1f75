// SPDX-License-Identifier: Apache-2.0
// What the equations take: a state, and what of a tire they would else compute for every state.
#pragma once

#include "models/magic_formula/parameters.h"

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

/// What depends on the parameters alone.
struct TireConstants {
  explicit TireConstants(const Parameters& parameters);

  Parameters p;
  bool mf52;
  double Fz0_prime;  // (4.E1)
  double Q_FZ1;      // (4)
  double Q_A1, Q_A2;
  // What every state would divide by.
  double per_FNOMIN, per_Fz0_prime, per_NOMPRES, per_LONGVL, per_VXLOW, per_FZMIN, per_LMUY;
  double R0_per_V0;
};

}  // namespace latsch::magic_formula
