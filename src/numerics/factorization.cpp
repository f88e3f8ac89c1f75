// SPDX-License-Identifier: Apache-2.0
#include "numerics/factorization.h"

#include <dmumps_c.h>
#include <metis.h>
#include <smumps_c.h>

#include <cassert>
#include <cstring>
#include <type_traits>
#include <utility>
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

void call(DMUMPS_STRUC_C& mumps) { dmumps_c(&mumps); }
void call(SMUMPS_STRUC_C& mumps) { smumps_c(&mumps); }

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
  bool ready = false;
  virtual ~Impl() = default;
  virtual FactorStatus factorize(const SymmetricMatrix& A) = 0;
  virtual void solve(Eigen::Ref<Eigen::MatrixXd> X) = 0;
  virtual double flops() const = 0;
  virtual long long entries() const = 0;
};

namespace {

template <class Real>
class Mumps final : public Factorization::Impl {
 public:
  explicit Mumps(const SymmetricPattern& pattern);
  ~Mumps() override { run(kEnd); }
  FactorStatus factorize(const SymmetricMatrix& A) override;
  void solve(Eigen::Ref<Eigen::MatrixXd> X) override;
  double flops() const override { return mumps_.rinfog[0]; }
  long long entries() const override {
    const int entries = infog(20);  // negative: in millions
    return entries < 0 ? -1000000LL * entries : entries;
  }

 private:
  int run(Job job) {
    mumps_.job = job;
    call(mumps_);
    return infog(1);
  }
  MUMPS_INT& icntl(int k) { return mumps_.icntl[k - 1]; }
  int infog(int k) const { return mumps_.infog[k - 1]; }
  void choose_options();
  void list_entries(const SymmetricPattern& pattern);

  std::conditional_t<std::is_same_v<Real, float>, SMUMPS_STRUC_C, DMUMPS_STRUC_C> mumps_;
  std::vector<MUMPS_INT> row_, column_, pivot_position_;  // one-based
  std::vector<int> source_;  // where entry k stands in the matrix' values
  std::vector<Real> value_, right_hand_side_;
};

template <class Real>
Mumps<Real>::Mumps(const SymmetricPattern& pattern) {
  choose_blas_core();
  std::memset(&mumps_, 0, sizeof mumps_);
  mumps_.par = 1;
  mumps_.sym =
      2;  // symmetric indefinite: as fast as the definite kind, and it counts the negative pivots
  mumps_.comm_fortran = kUseCommWorld;
  run(kStart);
  choose_options();
  list_entries(pattern);
  const int b = pattern.block_size();
  const auto position = dissect(pattern);
  pivot_position_.resize(pattern.size());
  for (int i = 0; i < pattern.size(); ++i) {
    pivot_position_[i] = static_cast<MUMPS_INT>(position[i / b] * b + i % b + 1);
  }
  mumps_.n = pattern.size();
  mumps_.nnz = static_cast<MUMPS_INT8>(row_.size());
  mumps_.irn = row_.data();
  mumps_.jcn = column_.data();
  mumps_.a = value_.data();
  mumps_.perm_in = pivot_position_.data();
  [[maybe_unused]] const int error = run(kAnalyze);
  assert(error >= 0);
}

template <class Real>
void Mumps<Real>::choose_options() {
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

template <class Real>
void Mumps<Real>::list_entries(const SymmetricPattern& pattern) {
  const int b = pattern.block_size();
  for (int i = 0; i < pattern.block_rows(); ++i) {
    for (int k = pattern.row_start()[i]; k < pattern.row_start()[i + 1]; ++k) {
      const int j = pattern.column()[k];
      for (int c = 0; c < b; ++c) {
        for (int r = i == j ? c : 0; r < b; ++r) {
          row_.push_back(b * i + r + 1);
          column_.push_back(b * j + c + 1);
          source_.push_back(k * b * b + c * b + r);
        }
      }
    }
  }
  value_.resize(row_.size());
}

template <class Real>
FactorStatus Mumps<Real>::factorize(const SymmetricMatrix& A) {
  const auto values = A.values();
  for (size_t k = 0; k < value_.size(); ++k) value_[k] = static_cast<Real>(values[source_[k]]);
  icntl(14) = kMoreMemory;
  int error = run(kFactorize);
  while ((error == kMemoryTooSmall || error == kIntegerMemoryTooSmall) && icntl(14) < 1000) {
    icntl(14) *= 2;
    error = run(kFactorize);
  }
  ready = error >= 0;
  FactorStatus status;
  if (error == kNumericallySingular) {
    status.outcome = FactorStatus::Outcome::singular;
    status.reason = "the matrix is singular";
  } else if (error < 0) {
    status.reason =
        "MUMPS ended with error " + std::to_string(error) + " (" + std::to_string(infog(2)) + ")";
  } else {
    status.negative_pivots = infog(12);
    status.outcome = status.negative_pivots == 0 ? FactorStatus::Outcome::definite
                                                 : FactorStatus::Outcome::indefinite;
  }
  return status;
}

template <class Real>
void Mumps<Real>::solve(Eigen::Ref<Eigen::MatrixXd> X) {
  assert(ready && X.rows() == mumps_.n);
  mumps_.nrhs = static_cast<MUMPS_INT>(X.cols());
  if constexpr (std::is_same_v<Real, double>) {
    mumps_.lrhs = static_cast<MUMPS_INT>(X.outerStride());
    mumps_.rhs = X.data();
    run(kSolve);
  } else {
    // Scaled to the middle of the exponents: a residual of 1e-40 is none.
    right_hand_side_.resize(X.size());
    Eigen::Map<Eigen::MatrixXf> Y(right_hand_side_.data(), X.rows(), X.cols());
    const double largest = X.cwiseAbs().maxCoeff();
    if (largest == 0.0) return;
    Y = (X / largest).template cast<float>();
    mumps_.lrhs = mumps_.n;
    mumps_.rhs = right_hand_side_.data();
    run(kSolve);
    X = largest * Y.template cast<double>();
  }
}

std::unique_ptr<Factorization::Impl> make(const SymmetricPattern& pattern, Precision precision) {
  if (precision == Precision::single) return std::make_unique<Mumps<float>>(pattern);
  return std::make_unique<Mumps<double>>(pattern);
}

}  // namespace

Factorization::Factorization(const SymmetricPattern& pattern, Precision precision)
    : impl_(make(pattern, precision)) {}
Factorization::~Factorization() = default;
Factorization::Factorization(Factorization&&) noexcept = default;
Factorization& Factorization::operator=(Factorization&&) noexcept = default;

FactorStatus Factorization::factorize(const SymmetricMatrix& A) { return impl_->factorize(A); }
bool Factorization::ready() const { return impl_->ready; }
void Factorization::solve(Eigen::Ref<Eigen::VectorXd> x) const {
  impl_->solve(Eigen::Map<Eigen::MatrixXd>(x.data(), x.size(), 1));
}
void Factorization::solve_columns(Eigen::Ref<Eigen::MatrixXd> X) const {
  impl_->solve(std::move(X));
}
double Factorization::flops() const { return impl_->flops(); }
long long Factorization::entries() const { return impl_->entries(); }

}  // namespace latsch::numerics
