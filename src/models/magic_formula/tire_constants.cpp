// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/tire_constants.h"

#include <cmath>

namespace latsch::magic_formula {
namespace {

double square_root(double x) { return std::sqrt(x); }
DualNumber square_root(const DualNumber& x) { return sqrt(x); }
double decadic_logarithm(double x) { return std::log10(x); }
DualNumber decadic_logarithm(const DualNumber& x) { return log10(x); }
template <class K>
K at_least(const K& x, double lower) {
  return x < lower ? K(lower) : x;
}

}  // namespace

template <class K>
TireConstantsOf<K>::TireConstantsOf(const CoefficientsOf<K>& coefficients, Version version)
    : p(coefficients), mf52(version == Version::mf52), Fz0_prime(p.LFZO * p.FNOMIN) {
  const K stiffness = p.VERTICAL_STIFFNESS * p.UNLOADED_RADIUS / p.FNOMIN;
  Q_FZ1 = square_root(at_least(stiffness * stiffness - 4.0 * p.Q_FZ2, 0.0));  // (4)
  per_FNOMIN = 1.0 / p.FNOMIN;
  per_Fz0_prime = 1.0 / Fz0_prime;
  per_NOMPRES = 1.0 / p.NOMPRES;
  per_LONGVL = 1.0 / p.LONGVL;
  per_VXLOW = 1.0 / p.VXLOW;
  per_FZMIN = 1.0 / p.FZMIN;
  // Smallest friction factor, so that a road without friction causes no division by zero.
  constexpr double kLeastFriction = 1e-9;
  per_LMUY = 1.0 / (p.LMUY == 0.0 ? K(kLeastFriction) : p.LMUY);
  R0_per_V0 = p.UNLOADED_RADIUS / p.LONGVL;
  Q_A1 = p.Q_A1;
  Q_A2 = p.Q_A2;
  if (Q_A1 == 0.0 && Q_A2 == 0.0) {
    // Default of MF-Tyre for a file without Q_A1 and Q_A2: a regression over many tires as a
    // function of their vertical stiffness.
    const K y = decadic_logarithm(stiffness);
    Q_A1 = ((-0.0388 * y + 0.2509) * y - 0.6283) * y + 0.6279;
    Q_A2 = 1.693 * Q_A1 * Q_A1;
  }
}

template struct TireConstantsOf<double>;
template struct TireConstantsOf<DualNumber>;

}  // namespace latsch::magic_formula
