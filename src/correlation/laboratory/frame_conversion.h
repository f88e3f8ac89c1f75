// SPDX-License-Identifier: Apache-2.0
// Turns the forces and moments of a record (in iso signs) from one frame (measurement/axes.h) into
// another, by channels of the record itself:
//
//   from H to W   F_W = F_H               M_W = M_H - r x F_H
//   from C to H   F_H = A F_C             M_H = A M_C
//   from C to W   F_W = A F_C             M_W = A M_C - r x F_W
//
//   r = R_l (0, sin gamma, -cos gamma)     from the wheel center to the contact point
//   A                                      the turn about x by gamma
//
// The opposite directions use the inverses.
//
// gamma is the camber and R_l the loaded radius along the wheel plane; divide a height of the wheel
// center above the road by cos gamma first. The formulas follow from the positions of the frames
// [TYDEX 1.3, axis systems; ISO 8855]. Forces of wheel and rim between tire and load cell (weight,
// inertia) are not separated and remain in the result.
//
// A component is turned if everything in its row of the formulas was recorded: Fy and Fz from H to
// W need only each other, Mx needs Fy, Fz, gamma and R_l. The other components are left out, with
// the name of what they lack.
#pragma once

#include <string>
#include <vector>

#include "correlation/laboratory/lab_record.h"
#include "measurement/axes.h"

namespace latsch::correlation {

/// Turns the record into frame `to`. `stated` is the frame of forces whose names do not contain it,
/// "" if unknown. Channels with the frame in their name are renamed. Returns the reason if nothing
/// can be turned; otherwise an empty text. Appends to `words` what was done.
std::string turn_into_frame(LabRecord& record,
                            const std::string& stated,
                            AxisFrame to,
                            std::vector<std::string>& words);

}  // namespace latsch::correlation
