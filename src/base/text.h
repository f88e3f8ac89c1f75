// SPDX-License-Identifier: Apache-2.0
// Words for messages: the nearest name, numbers and what the user wrote, fit to print.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace latsch {

/// Insertions, deletions, substitutions and swaps of neighbors between two words.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate most like `name`, ignoring case; nothing where none is alike.
std::optional<std::string> nearest(std::string_view name,
                                   const std::vector<std::string>& candidates);

/// `, did you mean "pressure"?`, or nothing where no candidate is alike.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// In quotes, unprintable characters escaped, long text shortened: safe on any terminal.
std::string in_quotes(std::string_view text);

/// `"a", "b" or "c"`
std::string list_of(const std::vector<std::string>& words);

/// The fewest digits that give the same bits back: 0.1, 2.6, 1e-12.
std::string format_number(double value);
/// At most `digits` significant digits.
std::string format_number(double value, int digits);

/// The value to the second digit of its uncertainty [JCGM 100:2008, 7.2.6], with one digit of its
/// own at least and nine at most: "73", "-0.0123", "1990", in any unit that both have. Further
/// digits say nothing and are others on other processors. As exact as can be where the uncertainty
/// is 0; one digit where it is not finite.
std::string format_known(double value, double uncertainty);

/// The whole text as a number in C notation, blanks around it allowed; nothing where it is not one.
std::optional<double> parse_number(std::string_view text);

/// Without blanks, tabs and line ends at both ends.
std::string_view trimmed(std::string_view text);

}  // namespace latsch
