// SPDX-License-Identifier: Apache-2.0
// Functions that format text for an HTML page: they escape names and format numbers.
#pragma once

#include <string>
#include <string_view>

namespace latsch::report {

/// Returns the text as HTML text or attribute value: & < > " ' become entities, control characters
/// are removed.
std::string escape(std::string_view text);

/// Returns the text of a number with the character − instead of the hyphen; "-0.0" becomes zero.
std::string true_minus(std::string number);
/// Returns a number with a fixed number of decimals, such as "12.30"; "–" for a value that is not
/// finite.
std::string fixed(double value, int decimals);
/// Returns a number with at most `digits` significant digits, without exponent between 1e-4 and
/// 1e6: "22.31", "0.00102".
std::string significant(double value, int digits);
/// Returns a ratio in percent, "1.23 %"; signed_percent() always has a sign: "+1.23 %".
std::string percent(double ratio, int decimals = 2);
/// Returns a target or an error in percent. Such a ratio may be small, because a target can be a
/// mean of squares, so two significant digits are shown below 0.1 %.
std::string small_percent(double ratio);
std::string signed_percent(double ratio, int decimals = 2);
/// Returns a duration as text: "0.8 s", "2 min 05 s", "3 h 12 min".
std::string duration(double seconds);
/// Returns a unit with typographic characters: "N/mm^2" becomes "N/mm²". The text is not escaped.
std::string typeset_unit(std::string_view unit);
/// Returns numbers and units with typographic characters: "-0.3 .. +0.1 N/mm^2" becomes "−0.3 …
/// +0.1 N/mm²", "+- 2" becomes "± 2". The text is not escaped.
std::string typeset_words(std::string_view words);
/// Returns the unit with a blank before it, " N/mm²"; nothing for "1".
std::string unit_suffix(std::string_view unit);
/// Converts a number from SI to `unit`; returns it unchanged if the unit is not known.
double in_unit(double si, std::string_view unit);

}  // namespace latsch::report
