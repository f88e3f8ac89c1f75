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
/// Returns a target or an error in percent. Both may be small, a target as a mean of squares, so
/// below 0.1 % two significant digits are shown.
std::string small_percent(double ratio);
std::string signed_percent(double ratio, int decimals = 2);
/// Returns for example "0.8 s", "2 min 05 s", "3 h 12 min".
std::string duration(double seconds);
/// Returns a typeset unit: "N/mm^2" becomes "N/mm²". The text is not escaped.
std::string typeset_unit(std::string_view unit);
/// Returns numbers with units as a page shows them: "-0.3 .. +0.1 N/mm^2" becomes
/// "−0.3 … +0.1 N/mm²", "+- 2" becomes "± 2". The text is not escaped.
std::string typeset_words(std::string_view words);
/// Returns " N/mm²", or nothing for "1".
std::string unit_suffix(std::string_view unit);
/// Converts SI to the number a person reads in `unit`; unchanged if the unit is not known.
double in_unit(double si, std::string_view unit);

}  // namespace latsch::report
