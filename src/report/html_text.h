// SPDX-License-Identifier: Apache-2.0
// Formats text for an HTML page: escapes names, formats numbers.
#pragma once

#include <string>
#include <string_view>

namespace latsch::report {

/// Escapes any text as HTML text or attribute value: & < > " ' become entities, control characters
/// are removed.
std::string escape(std::string_view text);

/// Returns a number's text with a true minus sign; "-0.0" becomes zero.
std::string true_minus(std::string number);
/// Returns "12.30": a fixed number of decimals, a true minus sign; "–" for a value that is not
/// finite.
std::string fixed(double value, int decimals);
/// Returns at most `digits` significant digits, no exponent between 1e-4 and 1e6: "22.31",
/// "0.00102".
std::string significant(double value, int digits);
/// Returns "1.23 %" for a ratio; signed: "+1.23 %".
std::string percent(double ratio, int decimals = 2);
/// Returns a target in percent. It may be a mean of squares, so if two decimals show only zeros,
/// two significant digits are shown.
std::string target_percent(double target);
std::string signed_percent(double ratio, int decimals = 2);
/// Returns for example "0.8 s", "2 min 05 s", "3 h 12 min".
std::string duration(double seconds);
/// Returns a typeset unit: "N/mm^2" becomes "N/mm²". The text is not escaped.
std::string typeset_unit(std::string_view unit);
/// Returns " N/mm²", or nothing for "1".
std::string unit_suffix(std::string_view unit);
/// Converts SI to the number a person reads in `unit`; unchanged if the unit is not known.
double in_unit(double si, std::string_view unit);

}  // namespace latsch::report
