// SPDX-License-Identifier: Apache-2.0
#include "optimization/design/sobol.h"

#include <fmt/format.h>

#include <array>
#include <bit>

#include "base/error.h"
#include "base/random.h"

namespace latsch {
namespace {

constexpr int kBits = 32;
constexpr int kMostSobolPoints = 1'000'000;

/// One row of the table. s is the degree; a has the inner coefficients a_1 .. a_(s-1) as binary
/// digits; m holds m_1 .. m_s.
struct Generator {
  int s;
  std::uint32_t a;
  std::array<std::uint32_t, 7> m;
};

// Table new-joe-kuo-6.21201, dimensions 2 to 21. Dimension 1, van der Corput's sequence, has all
// m_k = 1.
constexpr std::array<Generator, 20> kJoeKuo{{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
}};
static_assert(kJoeKuo.size() + 1 == kMostSobolVariables);

/// Returns the direction numbers v_1 .. v_32 of a dimension as multiples of 2^-32.
std::array<std::uint32_t, kBits> direction_numbers(int dimension) {
  std::array<std::uint32_t, kBits> m{};
  m.fill(1);
  if (dimension > 0) {
    const Generator& g = kJoeKuo[dimension - 1];
    for (int k = 0; k < kBits; ++k) {
      if (k < g.s) {
        m[k] = g.m[k];
        continue;
      }
      m[k] = (m[k - g.s] << g.s) ^ m[k - g.s];
      for (int i = 1; i < g.s; ++i) {
        const std::uint32_t a_i = g.a >> (g.s - 1 - i) & 1u;
        m[k] ^= a_i * (m[k - i] << i);
      }
    }
  }
  std::array<std::uint32_t, kBits> v{};
  for (int k = 0; k < kBits; ++k) v[k] = m[k] << (kBits - 1 - k);
  return v;
}

}  // namespace

SamplingPlan sobol(const DesignSpace& space, int points, std::uint64_t seed) {
  if (points < 1 || points > kMostSobolPoints) {
    throw InputError(fmt::format("Sobol: {} points, expected 1 to {}", points, kMostSobolPoints));
  }
  if (space.size() > kMostSobolVariables) {
    throw InputError(
        fmt::format("Sobol: {} variables, expected at most {}; a Latin hypercube has "
                    "no such limit",
                    space.size(),
                    kMostSobolVariables));
  }
  std::vector<std::array<std::uint32_t, kBits>> v;
  std::vector<std::uint32_t> x;  // the coordinates as multiples of 2^-32
  for (int j = 0; j < space.size(); ++j) {
    v.push_back(direction_numbers(j));
    RandomStream random(seed, j);
    x.push_back(seed == 0 ? 0u : static_cast<std::uint32_t>(random.below(std::uint64_t{1} << 32)));
  }
  SamplingPlan plan;
  for (std::uint32_t n = 0; n < static_cast<std::uint32_t>(points); ++n) {
    std::vector<double> u;
    for (std::uint32_t digits : x) u.push_back(digits * 0x1p-32);
    plan.points.push_back(space.from_unit(u));
    const int changed = std::countr_one(n);  // the digit in which the Gray codes of n, n + 1 differ
    for (size_t j = 0; j < x.size(); ++j) x[j] ^= v[j][changed];
  }
  return plan;
}

}  // namespace latsch
