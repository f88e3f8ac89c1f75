// SPDX-License-Identifier: Apache-2.0
#include "optimization/direct_search/penalty.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

namespace latsch {
namespace {

struct PenaltyWords {
  Penalty penalty;
  std::string_view name;
};

constexpr std::array kPenalties{PenaltyWords{Penalty::l2_squared, "l2_squared"},
                                PenaltyWords{Penalty::l1, "l1"},
                                PenaltyWords{Penalty::l2, "l2"},
                                PenaltyWords{Penalty::linf, "linf"},
                                PenaltyWords{Penalty::l1_smoothed, "l1_smoothed"},
                                PenaltyWords{Penalty::l2_smoothed, "l2_smoothed"},
                                PenaltyWords{Penalty::linf_smoothed, "linf_smoothed"}};

std::vector<double> violations(const Score& score) {
  std::vector<double> v;
  for (const double c : score.constraints) v.push_back(std::max(c, 0.0));
  for (const double h : score.equations) v.push_back(std::abs(h));
  return v;
}

/// Returns alpha ln(sum e^(x/alpha)), computed relative to the largest term so that no term
/// overflows.
double soft_max(const std::vector<double>& x, double alpha) {
  const double largest = *std::max_element(x.begin(), x.end());
  double sum = 0.0;
  for (const double value : x) sum += std::exp((value - largest) / alpha);
  return largest + alpha * std::log(sum);
}

double soft_sum(const Score& score, double alpha) {
  double sum = 0.0;
  for (const double c : score.constraints) sum += soft_max({0.0, c}, alpha);
  for (const double h : score.equations) sum += soft_max({h, -h}, alpha);
  return sum;
}

double soft_largest(const Score& score, double alpha) {
  std::vector<double> terms{0.0};
  terms.insert(terms.end(), score.constraints.begin(), score.constraints.end());
  for (const double h : score.equations) terms.insert(terms.end(), {h, -h});
  return soft_max(terms, alpha);
}

}  // namespace

std::string_view name(Penalty penalty) {
  const auto is_it = [&](const PenaltyWords& words) { return words.penalty == penalty; };
  return std::find_if(kPenalties.begin(), kPenalties.end(), is_it)->name;
}

const std::vector<std::string>& penalty_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const PenaltyWords& words : kPenalties) all.emplace_back(words.name);
    return all;
  }();
  return names;
}

Penalty penalty_of(std::string_view name) {
  const auto is_it = [&](const PenaltyWords& words) { return words.name == name; };
  const auto found = std::find_if(kPenalties.begin(), kPenalties.end(), is_it);
  assert(found != kPenalties.end());
  return found->penalty;
}

bool is_smoothed(Penalty penalty) {
  return penalty == Penalty::l1_smoothed || penalty == Penalty::l2_smoothed ||
         penalty == Penalty::linf_smoothed;
}

double penalty(Penalty kind, const Score& score, double alpha) {
  const std::vector<double> v = violations(score);
  if (v.empty()) return 0.0;
  const double squares = std::inner_product(v.begin(), v.end(), v.begin(), 0.0);
  switch (kind) {
    case Penalty::l2_squared:
      return squares;
    case Penalty::l1:
      return std::accumulate(v.begin(), v.end(), 0.0);
    case Penalty::l2:
      return std::sqrt(squares);
    case Penalty::linf:
      return *std::max_element(v.begin(), v.end());
    case Penalty::l1_smoothed:
      return soft_sum(score, alpha);
    case Penalty::l2_smoothed:
      return std::sqrt(squares + alpha * alpha);
    case Penalty::linf_smoothed:
      return soft_largest(score, alpha);
  }
  return 0.0;
}

}  // namespace latsch
