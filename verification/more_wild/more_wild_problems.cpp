// SPDX-License-Identifier: Apache-2.0
#include "more_wild/more_wild_problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "more_wild/dual.h"
#include "more_wild/more_wild_residuals.h"

namespace latsch::more_wild {
namespace {

struct Function {
  const char* name;
  Vector (*residuals)(const Vector&, int m);
  std::vector<Dual> (*duals)(const std::vector<Dual>&, int m);
  Vector start;
};

void add(std::vector<Problem>& all,
         const Function& function,
         int m,
         double least,
         const std::vector<double>& factors) {
  for (const double factor : factors) {
    Vector start = function.start;
    for (double& x : start) x *= factor;
    all.push_back(
        {fmt::format("{} ({}, {}){}", function.name, start.size(), m, factor == 1 ? "" : " x 10"),
         start,
         m,
         least,
         [residuals = function.residuals, m](const Vector& x) { return residuals(x, m); }});
    all.back().jacobian = [duals = function.duals, m](const Vector& x) {
      return jacobian_of([&](const std::vector<Dual>& at) { return duals(at, m); }, x);
    };
  }
}

Vector equal(int n, double value) { return Vector(n, value); }

Vector chebyshev_start(int n) {
  Vector start(n);
  for (int i = 0; i < n; ++i) start[i] = (i + 1.0) / (n + 1.0);
  return start;
}

/// Least values f_L: those of MGH for the functions in that paper; that of Bdqrtic is from SciPy's
/// Levenberg-Marquardt with a tolerance of 1e-15.
std::vector<Problem> make_problems() {
  const std::vector<double> near{1}, both{1, 10};
  std::vector<Problem> all;
  // The least sum of squares of the full-rank linear function is m - n.
  add(all, {"linear, full rank", linear_full_rank, linear_full_rank, equal(9, 1)}, 45, 36.0, both);
  // The least sums of squares are m (m - 1) / (2 (2 m + 1)) for rank 1 and (m^2 + 3 m - 6) / (2 (2
  // m - 3)) for rank 1 with zero columns and rows.
  add(all,
      {"linear, rank 1", linear_rank_one, linear_rank_one, equal(7, 1)},
      35,
      595.0 / 71.0,
      both);
  add(all,
      {"linear, rank 1, zeros", linear_rank_one_zeros, linear_rank_one_zeros, equal(7, 1)},
      35,
      1324.0 / 134.0,
      both);
  add(all, {"Rosenbrock", rosenbrock, rosenbrock, {-1.2, 1}}, 2, 0.0, both);
  add(all, {"helical valley", helical_valley, helical_valley, {-1, 0, 0}}, 3, 0.0, both);
  add(all, {"Powell singular", powell_singular, powell_singular, {3, -1, 0, 1}}, 4, 0.0, both);
  add(all,
      {"Freudenstein-Roth", freudenstein_roth, freudenstein_roth, {0.5, -2}},
      2,
      48.98425,
      both);
  add(all, {"Bard", bard, bard, {1, 1, 1}}, 15, 8.214877e-3, both);
  add(all,
      {"Kowalik-Osborne", kowalik_osborne, kowalik_osborne, {0.25, 0.39, 0.415, 0.39}},
      11,
      3.075056e-4,
      near);
  add(all, {"Meyer", meyer, meyer, {0.02, 4000, 250}}, 16, 87.94586, near);
  add(all, {"Watson", watson, watson, equal(6, 0.5)}, 31, 2.287670e-3, both);
  add(all, {"Watson", watson, watson, equal(9, 0.5)}, 31, 1.399760e-6, both);
  add(all, {"Watson", watson, watson, equal(12, 0.5)}, 31, 4.722381e-10, both);
  add(all, {"Box 3-D", box_3d, box_3d, {0, 10, 20}}, 10, 0.0, near);
  add(all,
      {"Jennrich-Sampson", jennrich_sampson, jennrich_sampson, {0.3, 0.4}},
      10,
      124.3622,
      near);
  add(all, {"Brown-Dennis", brown_dennis, brown_dennis, {25, 5, -5, -1}}, 20, 85822.20, both);
  for (const auto& [n, least] : {std::pair{6, 0.0}, {7, 0.0}, {8, 3.516874e-3}}) {
    add(all, {"Chebyquad", chebyquad, chebyquad, chebyshev_start(n)}, n, least, near);
  }
  for (const auto& [n, least] : {std::pair{9, 0.0}, {10, 4.772714e-3}, {11, 2.799762e-3}}) {
    add(all, {"Chebyquad", chebyquad, chebyquad, chebyshev_start(n)}, n, least, near);
  }
  add(all,
      {"Brown almost-linear", brown_almost_linear, brown_almost_linear, equal(10, 0.5)},
      10,
      0.0,
      near);
  add(all, {"Osborne 1", osborne_1, osborne_1, {0.5, 1.5, 1, 0.01, 0.02}}, 33, 5.464895e-5, near);
  add(all,
      {"Osborne 2", osborne_2, osborne_2, {1.3, 0.65, 0.65, 0.7, 0.6, 3, 5, 7, 2, 4.5, 5.5}},
      65,
      4.013774e-2,
      both);
  for (const auto& [n, m, least] :
       {std::tuple{8, 8, 10.23897}, {10, 12, 18.28116}, {11, 14, 22.26059}, {12, 16, 26.27277}}) {
    add(all, {"Bdqrtic", bdqrtic, bdqrtic, equal(n, 1)}, m, least, near);
  }
  for (const int n : {5, 6, 8}) add(all, {"Cube", cube, cube, equal(n, 0.5)}, n, 0.0, near);
  for (const auto& [n, factors] : {std::pair{5, both}, {8, near}, {10, near}, {12, both}}) {
    add(all, {"Mancino", mancino, mancino, mancino_start(n)}, n, 0.0, factors);
  }
  add(all,
      {"heart dipole", heart_8, heart_8, {-0.3, -0.39, 0.3, -0.344, -1.2, 2.69, 1.59, -1.5}},
      8,
      0.0,
      both);
  return all;
}

}  // namespace

double Problem::value(const Vector& x) const {
  double sum = 0.0;
  for (const double r : residuals(x)) sum += r * r;
  return sum;
}

double Problem::solved_below(double tau) const { return least + tau * (value(start) - least); }

const std::vector<Problem>& problems() {
  static const std::vector<Problem> all = make_problems();
  return all;
}

double start_step(const Problem& problem) {
  double largest = 1.0;
  for (const double x : problem.start) largest = std::max(largest, std::abs(x));
  return largest;
}

Vector start_steps(const Problem& problem) {
  return problem.steps.empty() ? equal(problem.n(), start_step(problem)) : problem.steps;
}

DesignSpace space(const Problem& problem) {
  const Vector steps = start_steps(problem);
  std::vector<DesignVariable> variables;
  for (int i = 0; i < problem.n(); ++i) {
    const double x = problem.start[i], half = 0.5 * kBoxWidth * steps[i];
    variables.push_back({.name = fmt::format("x{}", variables.size() + 1),
                         .lower = x - half,
                         .upper = x + half,
                         .initial = x});
  }
  return DesignSpace(variables);
}

}  // namespace latsch::more_wild
