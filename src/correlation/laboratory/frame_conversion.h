// SPDX-License-Identifier: Apache-2.0
// Forces and moments of a record, iso, turned from one frame (measurement/axes.h) into another, by
// channels of the record itself:
//
//   from H to W   F_W = F_H               M_W = M_H - r x F_H
//   from C to H   F_H = A F_C             M_H = A M_C
//   from C to W   F_W = A F_C             M_W = A M_C - r x F_W
//
//   r = R_l (0, sin gamma, -cos gamma), from the wheel center to the contact point; A the turn
//   about x by gamma; and back by the inverse of each
//
// gamma is the camber, R_l the loaded radius along the wheel plane: a height of the wheel center
// above the road has to be divided by cos gamma before. The formulas follow from where the frames
// stand [TYDEX 1.3, axis systems; ISO 8855]; forces of wheel and rim between tire and load cell
// (weight, inertia) are not theirs and stay in what they give.
//
// A component is turned where all that its row of the formulas takes was recorded: Fy and Fz from
// H to W by themselves, Mx by Fy, Fz, gamma and R_l. The others are left out, with what they lack.
#pragma once

#include <string>
#include <vector>

#include "correlation/laboratory/lab_record.h"
#include "measurement/axes.h"

namespace latsch::correlation {

/// `stated`: the frame of forces whose names do not say it, "" where nobody has. Channels that say
/// their frame change their names with it. Returns why nothing can be turned; empty where it was.
std::string turn_into_frame(LabRecord& record,
                            const std::string& stated,
                            AxisFrame to,
                            std::vector<std::string>& words);

}  // namespace latsch::correlation
