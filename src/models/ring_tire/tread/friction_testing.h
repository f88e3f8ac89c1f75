// SPDX-License-Identifier: Apache-2.0
// For tread_contact_test.cpp: a kernel with the sliding speed of eight equal blocks.
#include "models/ring_tire/tread/friction_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

double sliding_speed_of(const FrictionLaw& law, double T, double slope, double Fn, double p) {
  return sliding_speed(law.table(), all(T), all(slope), all(Fn), all(p), all(1.0)).at(7);
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
