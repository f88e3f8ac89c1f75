// SPDX-License-Identifier: Apache-2.0
// The rigid ring as a kind of tire.
#include "experiment/kinds/tir_numbers.h"
#include "experiment/kinds/tire_kind.h"
#include "models/rigid_ring/rigid_ring_tire.h"

namespace latsch::experiment {
namespace {

std::unique_ptr<Tire> build_rigid_ring(const Document& numbers) {
  auto tire = rigid_ring::RigidRingTire::make(parameters_of(numbers));
  if (!tire) throw InputError({numbers.file(), 0}, "makes no rigid ring: " + tire.failure().reason);
  return std::move(*tire);
}

}  // namespace

extern const TireKind kRigidRingKind;
const TireKind kRigidRingKind = {"rigid_ring",
                                 "rigid ring",
                                 "a .tir file with belt and stiffnesses (MF 6.1, 6.2)",
                                 read_tir_numbers,
                                 build_rigid_ring,
                                 tir_text_of};

}  // namespace latsch::experiment
