// SPDX-License-Identifier: Apache-2.0
// Reads functions of universal files: data set 58 as text and as binary (58b), with the header 151,
// the units 164 and the points 15 and 2411 [University of Cincinnati, Structural Dynamics Research
// Laboratory, "Universal File Formats", data sets 15, 58, 151, 164, 2411].
//
// Functions of type 1 (time response), 2 (auto spectrum), 3 (cross spectrum), 4 (frequency
// response), 6 (coherence) and 12 (spectrum) are read: real and complex, in single and double
// precision, with even and uneven abscissa. Functions with one abscissa are a group. A complex
// function becomes two channels, "... real" and "... imag".
//
// A channel is called by its degree of freedom, "12+Z", or by its first line of text if it has
// none; a function of two degrees of freedom has a word before them, "frf 12+Z/1+Z". The unit is
// the label of the axis if that is a unit, else it follows from the kind of quantity and from data
// set 164, whose factors divide. In 58b the number of lines before the numbers is a field, and the
// number of bytes is believed only if the end of the data set follows them, because programs write
// it wrong.
#pragma once

#include <string>
#include <string_view>

#include "formats/recorders/recorded_file.h"

namespace latsch::formats {

/// Throws InputError that names the line of a broken record. `file` is the name in messages.
RecordedFile parse_uff(std::string_view bytes, std::string file);

}  // namespace latsch::formats
