// SPDX-License-Identifier: Apache-2.0
// Tests sparse solutions and eigenvalues against an independent program: SciPy's splu (SuperLU) and
// eigsh (ARPACK).
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "numerics/sparse/factorization.h"
#include "numerics/sparse/lanczos.h"
#include "numerics/sparse/lattice_testing.h"

namespace latsch::numerics {
namespace {

constexpr const char* kPython = "/usr/bin/python3";
constexpr const char* kScript = R"py(
import sys, numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu, eigsh
def read(name):
    i, j, v = np.loadtxt(name, unpack=True)
    i, j = i.astype(int), j.astype(int)
    low = coo_matrix((v, (i, j)))
    off = i != j
    return (low + coo_matrix((v[off], (j[off], i[off])), shape=low.shape)).tocsc()
K, M = read("K"), read("M")
b = np.sin(np.arange(K.shape[0]))
np.savetxt("x", splu(K).solve(b), fmt="%.17g")
values = np.sort(eigsh(K, 20, M, sigma=0.0, return_eigenvectors=False))
np.savetxt("lambda", values, fmt="%.17g")
)py";

void write(const SymmetricMatrix& A, const std::filesystem::path& file) {
  std::ofstream out(file);
  const SymmetricPattern& p = A.pattern();
  for (int i = 0; i < p.block_rows(); ++i) {
    for (int k = p.row_start()[i]; k < p.row_start()[i + 1]; ++k) {
      for (int r = 3 * i; r < 3 * i + 3; ++r) {
        for (int c = 3 * p.column()[k]; c < std::min(r + 1, 3 * p.column()[k] + 3); ++c) {
          out << fmt::format("{} {} {:.17g}\n", r, c, A.coefficient(r, c));
        }
      }
    }
  }
}

Eigen::VectorXd read(const std::filesystem::path& file, int count) {
  std::ifstream in(file);
  Eigen::VectorXd values(count);
  for (double& v : values) in >> v;
  EXPECT_TRUE(in) << file;
  return values;
}

class SciPy : public testing::Test {
 protected:
  void SetUp() override {
    const std::string ask = fmt::format("{} -c 'import scipy.sparse.linalg' 2>/dev/null", kPython);
    if (std::system(ask.c_str()) != 0)
      GTEST_SKIP() << "SciPy is not installed (Debian: python3-scipy)";
    folder_ = std::filesystem::temp_directory_path() / fmt::format("latsch_scipy_{}", getpid());
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  bool run() {
    std::ofstream(folder_ / "oracle.py") << kScript;
    return std::system(fmt::format("cd '{}' && {} oracle.py", folder_.string(), kPython).c_str()) ==
           0;
  }

  std::filesystem::path folder_;
};

TEST_F(SciPy, AgreesInSolutionsAndEigenvaluesOfARing) {
  const Lattice lattice({20, 6, 2}, 3, /*ring=*/true, /*held_ends=*/true);
  const SymmetricPattern pattern(lattice.size(), lattice.elements());
  SymmetricMatrix K(pattern), M(pattern);
  lattice.assemble_equal(K, 5);  // equal elements give double eigenvalues
  lattice.assemble_equal(M, 6);
  write(K, folder_ / "K");
  write(M, folder_ / "M");
  ASSERT_TRUE(run());

  Factorization factor(pattern);
  ASSERT_TRUE(factor.factorize(K).definite());
  Eigen::VectorXd x(K.size());
  for (int i = 0; i < x.size(); ++i) x[i] = std::sin(i);
  factor.solve(x);
  const Eigen::VectorXd x_scipy = read(folder_ / "x", K.size());
  EXPECT_LT((x - x_scipy).norm(), 1e-10 * x.norm());

  EigenProblem<double> problem;
  problem.size = K.size();
  problem.solve = [&](Eigen::Ref<Eigen::MatrixXd> X) { factor.solve_columns(X); };
  problem.mass = [&](const Eigen::Ref<const Eigen::MatrixXd>& X, Eigen::Ref<Eigen::MatrixXd> Y) {
    M.multiply(X, Y);
  };
  const auto pairs = lanczos(problem, {.count = 20});
  ASSERT_TRUE(pairs.converged);
  const Eigen::VectorXd lambda = read(folder_ / "lambda", 20);
  for (int k = 0; k < 20; ++k) EXPECT_NEAR(pairs.values[k], lambda[k], 1e-9 * lambda[k]) << k;
}

}  // namespace
}  // namespace latsch::numerics
