// SPDX-License-Identifier: Apache-2.0
// Texts for messages: the nearest name to a misspelled one, numbers, and text of the user made
// printable.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace latsch {

/// Number of insertions, deletions, substitutions and swaps of neighbors that separate two words.
int edit_distance(std::string_view a, std::string_view b);

/// Returns the candidate most similar to `name`, ignoring case; nothing if none is similar.
std::optional<std::string> nearest(std::string_view name,
                                   const std::vector<std::string>& candidates);

/// Returns `, did you mean "pressure"?`, or "" if no candidate is similar.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// Returns the text in quotes with unprintable characters escaped and long texts shortened: safe on
/// any terminal.
std::string in_quotes(std::string_view text);

/// Returns the words as a list: `"a", "b" or "c"`.
std::string list_of(const std::vector<std::string>& words);

/// Returns the number with the word, which gets an "s" unless the number is 1: "1 step", "3 steps".
std::string counted(std::size_t count, const std::string& word);

/// Returns the fewest digits that give the same bits when read: 0.1, 2.6, 1e-12.
std::string format_number(double value);
/// Returns the value with at most `digits` significant digits.
std::string format_number(double value, int digits);

/// Returns the value to the second digit of its uncertainty [JCGM 100:2008, 7.2.6], with at least
/// one digit of its own and at most nine: "73", "-0.0123", "1990". Both arguments have the same
/// unit. Further digits mean nothing and differ between processors. The value is exact if the
/// uncertainty is 0, and has one digit if it is not finite.
std::string format_known(double value, double uncertainty);

/// Reads the whole text as a number in C notation, blanks around it allowed; nothing if it is none.
std::optional<double> parse_number(std::string_view text);

/// Returns the text without blanks, tabs and line ends at both ends.
std::string_view trimmed(std::string_view text);

}  // namespace latsch
