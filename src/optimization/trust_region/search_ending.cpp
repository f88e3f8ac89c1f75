// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/search_ending.h"

#include <fmt/format.h>

#include <cmath>

namespace latsch {
namespace {

using Numbers = std::vector<ClaimNumber>;

std::string words_of(Ending ending, const EndingEvidence& evidence) {
  switch (ending) {
    case Ending::none:
      return "";
    case Ending::verified:
      return "at a minimum: slopes recomputed around the best point predict no improvement";
    case Ending::noise:
      return "in the noise: slopes recomputed around the best point predict no gain above noise "
             "and ripple of the simulations, or above their curvature if they are exact";
    case Ending::wide:
      return "without having seen a minimum: less than a thousandth of the range of a variable "
             "changes the residuals by more than their size, so their slopes are not known; narrow "
             "its bounds or give it a logarithmic scale";
    case Ending::edge:
      return "at the edge of failed trials: steps that would gain fail";
    case Ending::rough:
      return "on rough or strongly curved ground: steps do not bring the gain that slopes around "
             "the best point predict";
    case Ending::blind:
      return "without having seen a minimum: beside the best point trials fail, or the residuals "
             "change by many times their size however short the step; if the range of a variable "
             "is "
             "that wide, narrow its bounds or give it a logarithmic scale";
    case Ending::known:
      return "at a minimum: the slopes that the model returns predict no improvement";
    case Ending::explained:
      return evidence.left_of_data <= evidence.most_left_of_data
                 ? "with nothing left: the residuals are less than a ten-millionth of the data"
                 : "with nothing left: less than a ten-thousandth of the first residuals";
    case Ending::hopeless:
      return "without a result: every trial failed";
  }
  return "";
}

const char* are(const std::vector<std::string>& names) { return names.size() > 1 ? "are" : "is"; }

std::string open_words(const std::vector<std::string>& names) {
  return fmt::format("{} {} not determined: within 5 % of the value, the residuals hardly change",
                     listed(names),
                     are(names));
}

std::string bound_words(const EndingEvidence::Bounds& bounds) {
  std::string words;
  const auto add = [&](const std::vector<std::string>& names, const char* which) {
    if (names.empty()) return;
    words += fmt::format(
        "{}{} {} at the {} bound", words.empty() ? "" : ", ", listed(names), are(names), which);
  };
  add(bounds.lower, "lower");
  add(bounds.upper, "upper");
  return words + ", beyond which the fit would improve";
}

std::string flat_words(const EndingEvidence::Flat& flat) {
  return fmt::format(
      "{} {} without effect here: moves by up to {:.0f} % of the range change no "
      "residual",
      listed(flat.names),
      are(flat.names),
      100.0 * flat.farthest);
}

std::string other_words(const EndingEvidence::OtherMinimum& other) {
  return fmt::format("another minimum, with {:.3g} times the sum of squares, lies beyond a ridge",
                     other.value);
}

/// Adds a number that was found.
void add(Numbers& to, ClaimNumber number) {
  if (!std::isnan(number.value)) to.push_back(std::move(number));
}

std::optional<double> limit(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

/// Returns the numbers of the verification's tests that belong to the ending.
Numbers numbers_of(Ending ending, const EndingEvidence& e) {
  Numbers numbers;
  const bool is_minimum = ending == Ending::verified;
  const bool is_judged = is_minimum || ending == Ending::noise || ending == Ending::wide ||
                         ending == Ending::rough || ending == Ending::edge;
  if (is_judged) {
    add(numbers,
        {.name = "predicted gain",
         .value = e.promise,
         .unit = "of the sum of squares",
         .at_most = is_minimum ? limit(e.least_promise) : std::nullopt});
    add(numbers, {.name = "noise", .value = e.deviation, .unit = "of the sum of squares"});
    add(numbers,
        {.name = "error of a trial between the axes",
         .value = e.model_error,
         .unit = "of the change of its residuals",
         .at_most = is_minimum ? limit(e.most_model_error) : std::nullopt});
    add(numbers,
        {.name = "largest broken promise",
         .value = e.contradiction,
         .unit = "of the sum of squares",
         .at_most = is_minimum ? limit(e.most_contradiction) : std::nullopt});
    add(numbers, {.name = "shortest move", .value = e.shortest, .unit = "of a range"});
    add(numbers, {.name = "longest move", .value = e.longest, .unit = "of a range"});
  }
  if (ending == Ending::edge)
    add(numbers, {.name = "failed steps in a row", .value = 1.0 * e.failed_steps});
  if (ending != Ending::explained) return numbers;
  add(numbers,
      {.name = "left",
       .value = e.left,
       .unit = "of the first sum of squares",
       .at_most = limit(e.most_left)});
  add(numbers,
      {.name = "residuals",
       .value = e.left_of_data,
       .unit = "of the data",
       .at_most = limit(e.most_left_of_data)});
  return numbers;
}

}  // namespace

std::string in_words(Ending ending, const EndingEvidence& evidence) {
  std::string words = words_of(ending, evidence);
  const auto add = [&](const std::string& more) { words += "; " + more; };
  if (!evidence.open.empty()) words += ", but " + open_words(evidence.open);
  if (evidence.bounds) add(bound_words(*evidence.bounds));
  if (evidence.flat) add(flat_words(*evidence.flat));
  if (evidence.other) add(other_words(*evidence.other));
  if (!std::isnan(evidence.noise_alone))
    add("the remaining error is no larger than the stated noise explains");
  return words;
}

std::vector<EndingClaim> claims_of(Ending ending, const EndingEvidence& evidence) {
  std::vector<EndingClaim> claims = claims_in(words_of(ending, evidence));
  if (claims.empty()) return claims;
  claims.front().numbers = numbers_of(ending, evidence);
  if (!evidence.open.empty())
    claims.push_back({.statement = "not determined",
                      .variables = evidence.open,
                      .test = "within 5 % of the value, the slopes change the residuals by no more "
                              "than what is left of them"});
  if (evidence.bounds) {
    const EndingEvidence::Bounds& b = *evidence.bounds;
    EndingClaim claim{
        .statement = "at a bound",
        .variables = b.lower,
        .test =
            "the slope of the sum of squares S points out by more than its "
            "error, and S is larger in a trial inside",
        .numbers = {
            {.name = "slope", .value = b.slope, .unit = "times its error", .at_least = 1.0},
            {.name = "move inside", .value = b.moved, .unit = "(the step tolerance)"},
            {.name = "rise", .value = b.rise, .unit = "of the sum of squares", .at_least = 0.0}}};
    claim.variables.insert(claim.variables.end(), b.upper.begin(), b.upper.end());
    claims.push_back(std::move(claim));
  }
  if (evidence.flat) {
    claims.push_back(
        {.statement = "flat",
         .variables = evidence.flat->names,
         .test = "moves to both sides, as far as bounds allow, change no residual",
         .numbers = {
             {.name = "longest move", .value = evidence.flat->farthest, .unit = "of a range"},
             {.name = "change",
              .value = evidence.flat->change,
              .unit = "of the residuals",
              .at_most = 1e-6}}});
  }
  if (evidence.other) {
    const EndingEvidence::OtherMinimum& o = *evidence.other;
    claims.push_back(
        {.statement = "several minima",
         .test = "a point on the straight way between two ends is above both",
         .numbers = {{.name = "sum of squares of the other end",
                      .value = o.value,
                      .unit = "of the sum of squares"},
                     {.name = "ridge",
                      .value = o.ridge,
                      .unit = "of the sum of squares",
                      .at_least = o.least},
                     {.name = "distance", .value = o.distance, .unit = "of a range"}}});
  }
  if (!std::isnan(evidence.noise_alone))
    claims.push_back({.statement = "no more than noise is left",
                      .test = "S is no larger than the stated noise explains",
                      .numbers = {{.name = "sum of squares",
                                   .value = evidence.noise_alone,
                                   .unit = "of what noise alone explains",
                                   .at_most = 1.0}}});
  return claims;
}

}  // namespace latsch
