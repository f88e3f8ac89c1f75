// SPDX-License-Identifier: Apache-2.0
// Checks the signs in the file of a car or a suspension (kind = "car", "suspension").
//
//   damper, curve of a unit, curve of a bushing   must rise: they resist the motion
//   damper at rest                                0, unless gas presses on its rod
//   curve of a unit                               a bump stop acts below 0: extension is positive
//   aero.map                                      downforce is positive
//   hardpoint.ubj, hardpoint.lbj                  the upper one is rearward: caster is positive
//
// The opposite sign may be intended, so each finding is a doubt and no error. Files of other kinds
// have no doubts here.
#pragma once

#include <vector>

#include "base/document.h"
#include "measurement/ledger.h"

namespace latsch::formats {

/// Returns the doubts in the order of the file, each with file and line. Rows that the reader of
/// the model will refuse are skipped.
std::vector<LedgerDoubt> doubts_of_car_file(const Node& root);

}  // namespace latsch::formats
