// SPDX-License-Identifier: Apache-2.0
// Compares the solver of quadratic programs, and generating-set search and SQP on such programs,
// with an independent program: SciPy's SLSQP.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include "base/random.h"
#include "optimization/direct_search/gss.h"
#include "optimization/problem/hock_schittkowski_testing.h"
#include "optimization/problem/quadratic_program.h"
#include "optimization/sqp/sqp.h"

namespace latsch {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr const char* kPython = "/usr/bin/python3";
constexpr const char* kScript = R"py(
import sys
try:
    import numpy as np
    from scipy.optimize import minimize
except ImportError:
    sys.exit(77)
G, A = np.loadtxt("G", ndmin=2), np.loadtxt("A", ndmin=2)
g, b = np.loadtxt("g"), np.loadtxt("b")
n = len(g)
found = minimize(lambda x: 0.5 * x @ G @ x + g @ x, np.full(n, 0.5), jac=lambda x: G @ x + g,
                 bounds=[(0, 1)] * n, method="SLSQP", options={"ftol": 1e-15, "maxiter": 500},
                 constraints={"type": "ineq", "fun": lambda x: b - A @ x, "jac": lambda x: -A})
np.savetxt("x", found.x, fmt="%.17g")
)py";

void write(const MatrixXd& M, const std::filesystem::path& file) {
  std::ofstream out(file);
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    for (Eigen::Index j = 0; j < M.cols(); ++j) out << fmt::format("{:.17g} ", M(i, j));
    out << '\n';
  }
}

/// Returns a random convex program in the unit cube whose middle is feasible.
QuadraticProgram random_program(int n, std::uint64_t seed) {
  RandomStream random(11, seed);
  const auto draw = [&](int rows, int cols) {
    MatrixXd M(rows, cols);
    for (double& value : M.reshaped()) value = 2.0 * random.uniform() - 1.0;
    return M;
  };
  QuadraticProgram qp;
  const MatrixXd R = draw(n, n);
  qp.G = R.transpose() * R + 0.2 * MatrixXd::Identity(n, n);
  qp.g = 3.0 * draw(n, 1);
  qp.A = draw(n, n);
  qp.b = qp.A * VectorXd::Constant(n, 0.5) + 0.2 * draw(n, 1).cwiseAbs();
  return qp;
}

class SciPyOptimize : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              fmt::format("latsch_scipy_optimize_{}_{}", ::getpid(), GetParam());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Returns SciPy's solution; nullopt if SciPy is not installed.
  std::optional<VectorXd> scipy(const QuadraticProgram& qp) const {
    write(qp.G, folder_ / "G");
    write(qp.g, folder_ / "g");
    write(qp.A, folder_ / "A");
    write(qp.b, folder_ / "b");
    std::ofstream(folder_ / "solve.py") << kScript;
    const std::string command = fmt::format("cd '{}' && {} solve.py", folder_.string(), kPython);
    const int status = std::system(command.c_str());
    if (WEXITSTATUS(status) == 77 || WEXITSTATUS(status) == 127) return std::nullopt;
    std::ifstream in(folder_ / "x");
    VectorXd x(qp.g.size());
    for (double& value : x) in >> value;
    EXPECT_TRUE(in);
    return x;
  }

  std::filesystem::path folder_;
};

ConstrainedProblem as_problem(const QuadraticProgram& qp) {
  std::vector<LinearConstraint> rows;
  for (Eigen::Index i = 0; i < qp.A.rows(); ++i) {
    const VectorXd a = qp.A.row(i);
    rows.push_back(at_most({a.begin(), a.end()}, qp.b[i]));
  }
  const auto n = static_cast<size_t>(qp.g.size());
  return {"random",
          space_of(std::vector<double>(n, 0.5), {{0, 1}}, rows),
          [qp](const std::vector<double>& at) {
            const VectorXd x = Eigen::Map<const VectorXd>(at.data(), qp.g.size());
            return 0.5 * x.dot(qp.G * x) + qp.g.dot(x);
          },
          {},
          0.0};
}

template <class Method>
VectorXd found_by(Method&& method, const ConstrainedProblem& problem) {
  DesignPoint best;
  double least = INFINITY;
  while (!method.converged()) {
    const DesignPoint point = method.propose(1).front();
    const double f = problem.f(point.values);
    if (f < least) least = f, best = point;
    method.observe(point, Score{f});
  }
  return Eigen::Map<const VectorXd>(best.values.data(), std::ssize(best.values));
}

TEST_P(SciPyOptimize, FindsTheSameSolution) {
  const QuadraticProgram qp = random_program(GetParam(), 1);
  const auto answer = scipy(qp);
  if (!answer) GTEST_SKIP() << "SciPy is not installed (Debian: python3-scipy)";
  const VectorXd& expected = *answer;
  const auto n = expected.size();
  QuadraticProgram in_cube = qp;
  in_cube.E = MatrixXd(0, n);
  in_cube.f = VectorXd(0);
  in_cube.A.resize(3 * n, n);
  in_cube.A << qp.A, MatrixXd::Identity(n, n), -MatrixXd::Identity(n, n);
  in_cube.b.resize(3 * n);
  in_cube.b << qp.b, VectorXd::Ones(n), VectorXd::Zero(n);
  // SLSQP ends if the target changes by less than 1e-15, so x is accurate to about the square root
  // of that.
  EXPECT_LT((solve(in_cube).x - expected).norm(), 1e-6);
  const ConstrainedProblem problem = as_problem(qp);
  EXPECT_LT((found_by(Sqp(problem.space, {.step_tolerance = 1e-5, .difference = 1e-7}), problem) -
             expected)
                .norm(),
            1e-4);
  EXPECT_LT((found_by(Gss(problem.space, {.step_tolerance = 1e-4}), problem) - expected).norm(),
            1e-2);
}

INSTANTIATE_TEST_SUITE_P(Variables, SciPyOptimize, testing::Values(3, 8));

}  // namespace
}  // namespace latsch
