// SPDX-License-Identifier: Apache-2.0
// Writes channels as a TYDEX 1.3 file (tydex_file.h has the columns of the format).
//
// The names of TYDEX state the axes of forces and moments, and its axes W, H and C have the signs
// of ISO 8855 (measurement/axes.h). So a channel gets such a name only if its frame is known:
//
//   time RUNTIME   alpha SLIPANGL   Vx, speed LONGVEL            Fx in W FX    in H FXH   in C FXC
//   p INFLPRES     gamma INCLANGL   omega, wheel_speed WHROTSPD  Fy in W FYW   in H FYH   in C FYC
//   kappa LONGSLIP                  loaded_radius DSTGRWHC       and so on to MZC
//
// DSTGRWHC is the height of the wheel center, loaded_radius its distance from the contact point in
// the wheel plane: the radius is written as its product with cos gamma if gamma is a channel too,
// else as RL, a name of ours. A name that TYDEX defines is kept. Every other channel gets a name of
// at most eight letters that TYDEX does not define, and the comment of its line has the whole name.
//
// Units are SI, slip angle and inclination in deg. Factors are 1 and offsets 0, because not every
// program that reads the format applies them. A column of the format has ten characters, nine of
// them for the number. Numbers with more digits are rounded to these nine, or are written with all
// digits between blanks, which is wider than the format allows. A value that is not known is
// NOTAVAIL.
#pragma once

#include <string>
#include <vector>

#include "measurement/channels.h"

namespace latsch::formats {

enum class TydexDigits { columns_of_ten, all };

/// A measurement to write. A text must not begin with two stars; line ends in it become blanks.
struct TydexRecord {
  struct Constant {
    std::string name, comment, unit, value;  // name of at most eight capitals
  };
  std::string measurement, supplier, date;  // MEASID, SUPPLIER, DATE; empty: NOTAVAIL
  std::vector<std::string> comments;        // one line each
  std::vector<Constant> constants;
  Channels channels;                // SI, signs of ISO 8855
  std::vector<std::string> frames;  // "W", "H", "C" or "" for each channel; empty: none known
  std::vector<std::string> units;   // one for each channel, as written; empty: as stated above
};

struct WrittenTydex {
  struct Name {
    std::string channel, tydex;
    bool is_defined = false;  // false: the name is not one of TYDEX
  };
  std::string text;                   // the file
  std::vector<Name> names;            // one for each channel, in their order
  std::vector<std::string> axes;      // frames of the forces that have a name of TYDEX
  std::vector<std::string> left_out;  // channels whose unit does not fit in its columns
  double rounding = 0.0;              // largest, over the largest value of its channel
  std::string rounded;                // TYDEX name of that channel
};

/// Returns the text of the file. A channel with a single value beside longer channels becomes a
/// constant; shorter channels end in NOTAVAIL. Throws InputError for infinite values and if there
/// is nothing to write.
WrittenTydex tydex_text(const TydexRecord& record, TydexDigits digits);

/// Returns a finite number in at most nine characters, as close to it as these allow.
std::string nine_characters(double number);

/// Returns what a reader of the file has to know, one sentence each: axes, names that TYDEX does
/// not define, rounding, channels left out. `more_digits` says how to write every digit.
std::vector<std::string> remarks_on(const WrittenTydex& written, const std::string& more_digits);

}  // namespace latsch::formats
