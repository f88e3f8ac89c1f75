// SPDX-License-Identifier: Apache-2.0
// Text for an HTML page: names made harmless, numbers made readable.
#pragma once

#include <string>
#include <string_view>

namespace latsch::report {

/// Any text as HTML text or attribute value: & < > " ' become entities, control characters vanish.
std::string escape(std::string_view text);

/// A number's text with a true minus sign; "-0.0" is zero.
std::string true_minus(std::string number);
/// "12.30": a fixed number of decimals, a true minus sign; "–" for what is not finite.
std::string fixed(double value, int decimals);
/// At most `digits` significant digits, no exponent between 1e-4 and 1e6: "22.31", "0.00102".
std::string significant(double value, int digits);
/// "1.23 %" of a ratio; signed: "+1.23 %".
std::string percent(double ratio, int decimals = 2);
/// Of a target, which may be a mean of squares: where two decimals show nothing of it, two digits.
std::string target_percent(double target);
std::string signed_percent(double ratio, int decimals = 2);
/// "0.8 s", "2 min 05 s", "3 h 12 min".
std::string duration(double seconds);
/// A unit as typeset: "N/mm^2" becomes "N/mm²". Not escaped.
std::string typeset_unit(std::string_view unit);
/// " N/mm²", nothing for "1".
std::string unit_suffix(std::string_view unit);
/// SI to the number a person reads in `unit`; unchanged where the unit is not known.
double in_unit(double si, std::string_view unit);

}  // namespace latsch::report
