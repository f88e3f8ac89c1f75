// SPDX-License-Identifier: Apache-2.0
// For tests: problems with constraints whose solutions are published, by their numbers in
// [Hock & Schittkowski, Test Examples for Nonlinear Programming Codes, Springer 1981].
//
// Some variables of the collection have no bounds, but a design space needs bounds. These variables
// get bounds far from the solution, named "wide" here. A start outside the bounds is moved onto
// them.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/score.h"

namespace latsch {

struct ConstrainedProblem {
  using Function = std::function<double(const std::vector<double>&)>;

  std::string name;
  DesignSpace space;  // variables with bounds and linear constraints
  Function f;
  std::vector<double> x;                 // the solution
  double least;                          // f there
  std::vector<Function> at_most_0 = {};  // nonlinear: c(x) <= 0
  std::vector<Function> equal_0 = {};
};

inline Score score_of(const ConstrainedProblem& problem, const std::vector<double>& x) {
  Score score{problem.f(x)};
  for (const auto& c : problem.at_most_0) score.constraints.push_back(c(x));
  for (const auto& h : problem.equal_0) score.equations.push_back(h(x));
  return score;
}

struct Box {
  double lower, upper;
};

inline DesignSpace space_of(const std::vector<double>& start,
                            const std::vector<Box>& bounds,
                            const std::vector<LinearConstraint>& rows = {}) {
  std::vector<DesignVariable> variables;
  for (size_t i = 0; i < start.size(); ++i) {
    const Box box = bounds[bounds.size() == 1 ? 0 : i];
    variables.push_back({.name = fmt::format("x{}", i + 1),
                         .lower = box.lower,
                         .upper = box.upper,
                         .initial = start[i]});
  }
  return DesignSpace(variables, rows);
}

inline LinearConstraint between(std::vector<double> a, double lower, double upper) {
  LinearConstraint row;
  row.name = "row";
  row.coefficients = std::move(a);
  row.lower = lower;
  row.upper = upper;
  return row;
}

inline LinearConstraint at_most(std::vector<double> a, double upper) {
  return between(std::move(a), -INFINITY, upper);
}

inline LinearConstraint at_least(std::vector<double> a, double lower) {
  return between(std::move(a), lower, INFINITY);
}

inline LinearConstraint equal(std::vector<double> a, double value) {
  return between(std::move(a), value, value);
}

/// Problems with only bounds and linear constraints.
inline std::vector<ConstrainedProblem> linearly_constrained_problems() {
  const double root3 = std::sqrt(3.0);
  const Box wide{-10.0, 10.0};
  return {
      {"HS21",
       space_of({2, -1}, {{2, 50}, {-50, 50}}, {at_least({10, -1}, 10)}),
       [](const auto& x) { return 0.01 * x[0] * x[0] + x[1] * x[1] - 100; },
       {2, 0},
       -99.96},
      {"HS24",
       space_of({1, 0.5},
                {{0, 10}},
                {at_least({1 / root3, -1}, 0), at_least({1, root3}, 0), at_most({1, root3}, 6)}),
       [root3](const auto& x) {
         return ((x[0] - 3) * (x[0] - 3) - 9) * x[1] * x[1] * x[1] / (27 * root3);
       },
       {3, root3},
       -1},
      {"HS28",
       space_of({-4, 1, 1}, {wide}, {equal({1, 2, 3}, 1)}),
       [](const auto& x) { return std::pow(x[0] + x[1], 2) + std::pow(x[1] + x[2], 2); },
       {0.5, -0.5, 0.5},
       0},
      {"HS35",
       space_of({0.5, 0.5, 0.5}, {{0, 10}}, {at_most({1, 1, 2}, 3)}),
       [](const auto& x) {
         return 9 - 8 * x[0] - 6 * x[1] - 4 * x[2] + 2 * x[0] * x[0] + 2 * x[1] * x[1] +
                x[2] * x[2] + 2 * x[0] * x[1] + 2 * x[0] * x[2];
       },
       {4.0 / 3, 7.0 / 9, 4.0 / 9},
       1.0 / 9},
      {"HS36",
       space_of({10, 10, 10}, {{0, 20}, {0, 11}, {0, 42}}, {at_most({1, 2, 2}, 72)}),
       [](const auto& x) { return -x[0] * x[1] * x[2]; },
       {20, 11, 15},
       -3300},
      {"HS37",
       space_of({10, 10, 10}, {{0, 42}}, {at_most({1, 2, 2}, 72), at_least({1, 2, 2}, 0)}),
       [](const auto& x) { return -x[0] * x[1] * x[2]; },
       {24, 12, 12},
       -3456},
      {"HS48",
       space_of(
           {3, 5, -3, 2, -2}, {wide}, {equal({1, 1, 1, 1, 1}, 5), equal({0, 0, 1, -2, -2}, -3)}),
       [](const auto& x) {
         return std::pow(x[0] - 1, 2) + std::pow(x[1] - x[2], 2) + std::pow(x[3] - x[4], 2);
       },
       {1, 1, 1, 1, 1},
       0},
      {"HS76",
       space_of({0.5, 0.5, 0.5, 0.5},
                {{0, 10}},
                {at_most({1, 2, 1, 1}, 5), at_most({3, 1, 2, -1}, 4), at_least({0, 1, 4, 0}, 1.5)}),
       [](const auto& x) {
         return x[0] * x[0] + 0.5 * x[1] * x[1] + x[2] * x[2] + 0.5 * x[3] * x[3] - x[0] * x[2] +
                x[2] * x[3] - x[0] - 3 * x[1] + x[2] - x[3];
       },
       {0.2727273, 2.090909, 0, 0.5454545},
       -4.681818181},
  };
}

/// A sum of squares with bounds and linear constraints.
struct LeastSquaresProblem {
  using Residuals = std::function<std::vector<double>(const std::vector<double>&)>;

  std::string name;
  DesignSpace space;
  Residuals residuals;
  std::vector<double> x;  // the solution
  double least;           // the sum of squares at the solution
};

inline Score sum_of_squares(std::vector<double> residuals) {
  double sum = 0.0;
  for (const double r : residuals) sum += r * r;
  return {sum, std::move(residuals)};
}

/// If f is a quadratic, it is written here as a sum of squares, up to a constant: 100 for HS21, 7.5
/// for HS76. The bound x2 >= 1.5 of HS2 is written as a linear constraint. HS2 has two minima; the
/// search starts on the side of the lower one, because descent from the book's start (-2, 1) leads
/// to the minimum of 4.94.
inline std::vector<LeastSquaresProblem> constrained_least_squares_problems() {
  using Vector = std::vector<double>;
  const double half = std::sqrt(0.5);
  const Box wide{-10.0, 10.0};
  // The target of HS51 and HS53 with a = 1, and of HS52 with a = 4.
  const auto chain = [](double a) {
    return [a](const Vector& x) {
      return Vector{a * x[0] - x[1], x[1] + x[2] - 2, x[3] - 1, x[4] - 1};
    };
  };
  const auto chain_rows = [](double sum) {
    return std::vector<LinearConstraint>{
        equal({1, 3, 0, 0, 0}, sum), equal({0, 0, 1, 1, -2}, 0), equal({0, 1, 0, 0, -1}, 0)};
  };
  return {
      {"HS2",
       space_of({2, 3}, {wide}, {at_least({0, 1}, 1.5)}),
       [](const Vector& x) {
         return Vector{10 * (x[1] - x[0] * x[0]), 1 - x[0]};
       },
       {1.224370749, 1.5},
       0.0504261879},
      {"HS21",
       space_of({2, -1}, {{2, 50}, {-50, 50}}, {at_least({10, -1}, 10)}),
       [](const Vector& x) {
         return Vector{0.1 * x[0], x[1]};
       },
       {2, 0},
       0.04},
      {"HS28",
       space_of({-4, 1, 1}, {wide}, {equal({1, 2, 3}, 1)}),
       [](const Vector& x) {
         return Vector{x[0] + x[1], x[1] + x[2]};
       },
       {0.5, -0.5, 0.5},
       0},
      {"HS35",
       space_of({0.5, 0.5, 0.5}, {{0, 10}}, {at_most({1, 1, 2}, 3)}),
       [](const Vector& x) {
         return Vector{x[0] + x[2] - 2, x[0] + x[1] - 2, x[1] - 1};
       },
       {4.0 / 3, 7.0 / 9, 4.0 / 9},
       1.0 / 9},
      {"HS48",
       space_of(
           {3, 5, -3, 2, -2}, {wide}, {equal({1, 1, 1, 1, 1}, 5), equal({0, 0, 1, -2, -2}, -3)}),
       [](const Vector& x) {
         return Vector{x[0] - 1, x[1] - x[2], x[3] - x[4]};
       },
       {1, 1, 1, 1, 1},
       0},
      {"HS51",
       space_of({2.5, 0.5, 2, -1, 0.5}, {wide}, chain_rows(4)),
       chain(1),
       {1, 1, 1, 1, 1},
       0},
      {"HS52",
       space_of({0, 0, 0, 0, 0}, {wide}, chain_rows(0)),
       chain(4),
       {-33.0 / 349, 11.0 / 349, 180.0 / 349, -158.0 / 349, 11.0 / 349},
       1859.0 / 349},
      {"HS53",
       space_of({0, 0, 0, 0, 0}, {wide}, chain_rows(0)),
       chain(1),
       {-33.0 / 43, 11.0 / 43, 27.0 / 43, -5.0 / 43, 11.0 / 43},
       176.0 / 43},
      {"HS76",
       space_of({0.5, 0.5, 0.5, 0.5},
                {{0, 10}},
                {at_most({1, 2, 1, 1}, 5), at_most({3, 1, 2, -1}, 4), at_least({0, 1, 4, 0}, 1.5)}),
       [half](const Vector& x) {
         return Vector{
             x[0] - x[2] / 2 - 0.5, half * (x[1] - 3), half * (x[2] + x[3] - 1), (x[2] + 3) / 2};
       },
       {0.2727273, 2.090909, 0, 0.5454545},
       7.5 - 4.681818181},
  };
}

/// Problems with nonlinear constraints.
inline std::vector<ConstrainedProblem> nonlinearly_constrained_problems() {
  const auto square = [](double a) { return a * a; };
  const Box wide{-10.0, 10.0};
  return {
      {"HS43",
       space_of({0, 0, 0, 0}, {wide}),
       [](const auto& x) {
         return x[0] * x[0] + x[1] * x[1] + 2 * x[2] * x[2] + x[3] * x[3] - 5 * x[0] - 5 * x[1] -
                21 * x[2] + 7 * x[3];
       },
       {0, 1, 2, -1},
       -44,
       {[](const auto& x) {
          return -8 + x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3] + x[0] - x[1] + x[2] -
                 x[3];
        },
        [](const auto& x) {
          return -10 + x[0] * x[0] + 2 * x[1] * x[1] + x[2] * x[2] + 2 * x[3] * x[3] - x[0] - x[3];
        },
        [](const auto& x) {
          return -5 + 2 * x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + 2 * x[0] - x[1] - x[3];
        }}},
      {"HS65",
       space_of({-4.5, 4.5, 0}, {{-4.5, 4.5}, {-4.5, 4.5}, {-5, 5}}),
       [square](const auto& x) {
         return square(x[0] - x[1]) + square(x[0] + x[1] - 10) / 9 + square(x[2] - 5);
       },
       {3.650461821, 3.65046168, 4.6204170507},
       0.9535288567,
       {[](const auto& x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 48; }}},
      {"HS71",
       space_of({1, 5, 5, 1}, {{1, 5}}),
       [](const auto& x) { return x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]; },
       {1, 4.7429994, 3.8211503, 1.3794082},
       17.0140173,
       {[](const auto& x) { return 25 - x[0] * x[1] * x[2] * x[3]; }},
       {[](const auto& x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3] - 40; }}},
      {"HS100",
       space_of({1, 2, 0, 4, 0, 1, 1}, {wide}),
       [square](const auto& x) {
         return square(x[0] - 10) + 5 * square(x[1] - 12) + std::pow(x[2], 4) +
                3 * square(x[3] - 11) + 10 * std::pow(x[4], 6) + 7 * x[5] * x[5] +
                std::pow(x[6], 4) - 4 * x[5] * x[6] - 10 * x[5] - 8 * x[6];
       },
       {2.330499, 1.951372, -0.4775414, 4.365726, -0.6244870, 1.038131, 1.594227},
       680.6300573,
       {[](const auto& x) {
          return -127 + 2 * x[0] * x[0] + 3 * std::pow(x[1], 4) + x[2] + 4 * x[3] * x[3] + 5 * x[4];
        },
        [](const auto& x) { return -282 + 7 * x[0] + 3 * x[1] + 10 * x[2] * x[2] + x[3] - x[4]; },
        [](const auto& x) { return -196 + 23 * x[0] + x[1] * x[1] + 6 * x[5] * x[5] - 8 * x[6]; },
        [](const auto& x) {
          return 4 * x[0] * x[0] + x[1] * x[1] - 3 * x[0] * x[1] + 2 * x[2] * x[2] + 5 * x[5] -
                 11 * x[6];
        }}},
  };
}

}  // namespace latsch
