// SPDX-License-Identifier: Apache-2.0
#include "numerics/factorization.h"

#include <dmumps_c.h>
#include <metis.h>

#include <cassert>
#include <cstring>
#include <vector>

#include "numerics/blas_core.h"

namespace latsch::numerics {
namespace {

constexpr int kUseCommWorld = -987654;  // what the sequential MUMPS wants as communicator
constexpr int kRightHandSideBlock = 32;
constexpr int kMoreMemory =
    30;  // percent over MUMPS' estimate, so that delayed pivots do not end a factorization
constexpr int kNumericallySingular = -10;
constexpr int kMemoryTooSmall = -9;
constexpr int kIntegerMemoryTooSmall = -8;

enum Job { kStart = -1, kEnd = -2, kAnalyze = 1, kFactorize = 2, kSolve = 3 };

/// Nested dissection of the graph of block rows: position of every block row in the elimination.
std::vector<idx_t> dissect(const SymmetricPattern& pattern) {
  const int n = pattern.block_rows();
  const auto start = pattern.row_start();
  const auto column = pattern.column();
  std::vector<idx_t> degree(n + 1, 0);
  for (int i = 0; i < n; ++i) {
    for (int k = start[i]; k < start[i + 1] - 1; ++k) {
      ++degree[i + 1];
      ++degree[column[k] + 1];
    }
  }
  std::vector<idx_t> first(degree);
  for (int i = 0; i < n; ++i) first[i + 1] += first[i];
  std::vector<idx_t> neighbor(first[n]), next(first.begin(), first.end() - 1);
  for (int i = 0; i < n; ++i) {
    for (int k = start[i]; k < start[i + 1] - 1; ++k) {
      neighbor[next[i]++] = column[k];
      neighbor[next[column[k]]++] = i;
    }
  }
  std::vector<idx_t> order(n), position(n);
  if (neighbor.empty()) {
    for (int i = 0; i < n; ++i) position[i] = i;
    return position;
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  idx_t vertices = n;
  METIS_NodeND(
      &vertices, first.data(), neighbor.data(), nullptr, options, order.data(), position.data());
  return position;
}

}  // namespace

struct Factorization::Impl {
  DMUMPS_STRUC_C mumps;
  std::vector<MUMPS_INT> row, column, pivot_position;  // one-based
  std::vector<int> source;                             // where entry k stands in the matrix' values
  std::vector<double> value;
  bool ready = false;

  explicit Impl(const SymmetricPattern& pattern);
  ~Impl() { run(kEnd); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  int run(Job job) {
    mumps.job = job;
    dmumps_c(&mumps);
    return mumps.infog[0];
  }
  MUMPS_INT& icntl(int k) { return mumps.icntl[k - 1]; }
  int infog(int k) const { return mumps.infog[k - 1]; }

  void list_entries(const SymmetricPattern& pattern);
  void choose_options();
};

Factorization::Impl::Impl(const SymmetricPattern& pattern) {
  choose_blas_core();
  std::memset(&mumps, 0, sizeof mumps);
  mumps.par = 1;
  mumps.sym = 2;
  mumps.comm_fortran = kUseCommWorld;
  run(kStart);
  choose_options();
  list_entries(pattern);
  const int b = pattern.block_size();
  const auto position = dissect(pattern);
  pivot_position.resize(pattern.size());
  for (int i = 0; i < pattern.size(); ++i) {
    pivot_position[i] = static_cast<MUMPS_INT>(position[i / b] * b + i % b + 1);
  }
  mumps.n = pattern.size();
  mumps.nnz = static_cast<MUMPS_INT8>(row.size());
  mumps.irn = row.data();
  mumps.jcn = column.data();
  mumps.a = value.data();
  mumps.perm_in = pivot_position.data();
  [[maybe_unused]] const int error = run(kAnalyze);
  assert(error >= 0);
}

void Factorization::Impl::choose_options() {
  for (int k : {1, 2, 3}) icntl(k) = -1;  // prints nothing
  icntl(4) = 0;
  icntl(6) = 0;   // no permutation for large diagonals: the pattern is symmetric
  icntl(7) = 1;   // the ordering is ours
  icntl(8) = 0;   // no scaling
  icntl(10) = 0;  // no iterative refinement
  icntl(12) = 1;  // no compressed ordering
  icntl(13) = 1;  // no parallel root
  icntl(14) = kMoreMemory;
  icntl(27) = kRightHandSideBlock;
}

void Factorization::Impl::list_entries(const SymmetricPattern& pattern) {
  const int b = pattern.block_size();
  for (int i = 0; i < pattern.block_rows(); ++i) {
    for (int k = pattern.row_start()[i]; k < pattern.row_start()[i + 1]; ++k) {
      const int j = pattern.column()[k];
      for (int c = 0; c < b; ++c) {
        for (int r = i == j ? c : 0; r < b; ++r) {
          row.push_back(b * i + r + 1);
          column.push_back(b * j + c + 1);
          source.push_back(k * b * b + c * b + r);
        }
      }
    }
  }
  value.resize(row.size());
}

Factorization::Factorization(const SymmetricPattern& pattern)
    : impl_(std::make_unique<Impl>(pattern)) {}
Factorization::~Factorization() = default;
Factorization::Factorization(Factorization&&) noexcept = default;
Factorization& Factorization::operator=(Factorization&&) noexcept = default;

FactorStatus Factorization::factorize(const SymmetricMatrix& A) {
  Impl& m = *impl_;
  const auto values = A.values();
  for (size_t k = 0; k < m.value.size(); ++k) m.value[k] = values[m.source[k]];
  m.icntl(14) = kMoreMemory;
  int error = m.run(kFactorize);
  while ((error == kMemoryTooSmall || error == kIntegerMemoryTooSmall) && m.icntl(14) < 1000) {
    m.icntl(14) *= 2;
    error = m.run(kFactorize);
  }
  m.ready = error >= 0;
  FactorStatus status;
  if (error == kNumericallySingular) {
    status.outcome = FactorStatus::Outcome::singular;
    status.reason = "the matrix is singular";
  } else if (error < 0) {
    status.reason =
        "MUMPS ended with error " + std::to_string(error) + " (" + std::to_string(m.infog(2)) + ")";
  } else {
    status.negative_pivots = m.infog(12);
    status.outcome = status.negative_pivots == 0 ? FactorStatus::Outcome::definite
                                                 : FactorStatus::Outcome::indefinite;
  }
  return status;
}

bool Factorization::ready() const { return impl_->ready; }

void Factorization::solve(Eigen::Ref<Eigen::VectorXd> x) const {
  assert(ready() && x.size() == impl_->mumps.n);
  impl_->mumps.nrhs = 1;
  impl_->mumps.lrhs = impl_->mumps.n;
  impl_->mumps.rhs = x.data();
  impl_->run(kSolve);
}

void Factorization::solve_columns(Eigen::Ref<Eigen::MatrixXd> X) const {
  assert(ready() && X.rows() == impl_->mumps.n);
  impl_->mumps.nrhs = static_cast<MUMPS_INT>(X.cols());
  impl_->mumps.lrhs = static_cast<MUMPS_INT>(X.outerStride());
  impl_->mumps.rhs = X.data();
  impl_->run(kSolve);
}

double Factorization::flops() const { return impl_->mumps.rinfog[0]; }
long long Factorization::entries() const {
  const int entries = impl_->infog(20);  // negative: in millions
  return entries < 0 ? -1000000LL * entries : entries;
}

}  // namespace latsch::numerics
