// SPDX-License-Identifier: Apache-2.0
// A statement that a search makes at its end, with the test that it passed and the numbers of that
// test. Optimizer::ending() is the sentence for a person; claims carry the same for programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace latsch {

/// A number of a test and the limit that it keeps.
struct ClaimNumber {
  std::string name;  // such as "predicted gain"
  double value = 0.0;
  std::string unit = {};  // such as "of S", a share of the sum of squares S; empty: a count
  std::optional<double> at_most = std::nullopt, at_least = std::nullopt;
};

struct EndingClaim {
  std::string statement;                    // such as "at a minimum" or "at a bound"
  std::vector<std::string> variables = {};  // names of those concerned; empty: the whole search
  std::string test = {};                    // the test that passed, in words
  std::vector<ClaimNumber> numbers = {};
};

/// Returns the claim of an ending in words without numbers: its statement stands before the first
/// colon or, if there is none, is the whole ending. Returns nothing for an empty text.
std::vector<EndingClaim> claims_in(const std::string& ending);

/// Returns a claim with its numbers as one line, such as "at a minimum: predicted gain 2e-09 of S
/// (at most 1e-06)". Returns an empty text for a claim without numbers.
std::string numbers_in_words(const EndingClaim& claim);

/// Returns the claims that have numbers, in words.
std::vector<std::string> tests_in_words(const std::vector<EndingClaim>& claims);

/// Returns names in quotation marks: "a", "b" and "c".
std::string listed(const std::vector<std::string>& names);

}  // namespace latsch
