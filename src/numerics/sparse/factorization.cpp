// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/factorization.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "numerics/sparse/multifrontal.h"

namespace latsch::numerics {
namespace {

// Iterative refinement by a factor in single precision. It is as exact as a factor in double and
// faster, if the matrix is not too ill-conditioned for float. [Buttari, Dongarra, Kurzak, Luszczek
// & Tomov, Using mixed precision for sparse matrix computations to enhance the performance while
// achieving 64-bit accuracy, ACM Trans. Math. Softw. 34 (2008) 17]
class Refined final : public Factorization::Impl {
 public:
  Refined(const SymmetricPattern& pattern, const std::shared_ptr<const Elimination>& order)
      : pattern_(pattern), single_(multifrontal<float>(pattern, order)) {
    elimination = order;
  }

  FactorStatus factorize(const SymmetricMatrix& A, bool but_interface) override {
    assert(!but_interface);
    FactorStatus status = single_->factorize(A, but_interface);
    full_.reset();
    A_ = &A;
    if (status.outcome == FactorStatus::Outcome::not_positive) {
      full_ = multifrontal<double>(pattern_, elimination);
      status = full_->factorize(A, but_interface);
    }
    ready = status.definite();
    return status;
  }

  void solve(Eigen::Ref<Eigen::MatrixXd> X, double enough) override {
    assert(ready);
    if (full_) return full_->solve(X, enough);
    const Eigen::MatrixXd B = X;
    const Eigen::RowVectorXd wanted = std::max(enough, kRounding) * B.colwise().norm();
    single_->solve(X, 0.0);
    Eigen::MatrixXd left(B.rows(), B.cols());
    Eigen::RowVectorXd before =
        Eigen::RowVectorXd::Constant(B.cols(), std::numeric_limits<double>::infinity());
    for (int i = 0; i < kMostRefinements; ++i) {
      A_->multiply(X, left);
      left = B - left;
      const Eigen::RowVectorXd norm = left.colwise().norm();
      if ((norm.array() <= wanted.array()).all() || (norm.array() >= before.array()).all()) return;
      single_->solve(left, 0.0);
      X += left;
      // The residual falls by nearly the same factor in every step, so the last residual is
      // predicted instead of computed.
      const Eigen::RowVectorXd next = norm.cwiseAbs2().cwiseQuotient(before);
      if (i > 0 && (kSurely * next.array() <= wanted.array()).all()) return;
      before = norm;
    }
  }

  void solve_roughly(Eigen::Ref<Eigen::MatrixXd> X) override {
    full_ ? full_->solve(X, 0.0) : single_->solve(X, 0.0);
  }
  Eigen::MatrixXd condensed() const override { return single_->condensed(); }
  void reduce(Eigen::Ref<Eigen::VectorXd> x) override { single_->reduce(x); }
  void expand(Eigen::Ref<Eigen::VectorXd> x) override { single_->expand(x); }
  void release() override {
    ready = false;
    single_->release();
    full_.reset();
    A_ = nullptr;
  }

 private:
  static constexpr double kRounding = 1e-15;
  static constexpr int kMostRefinements = 6;
  static constexpr double kSurely = 10.0;  // safety factor on the expected residual
  const SymmetricPattern& pattern_;
  std::unique_ptr<Impl> single_, full_;
  const SymmetricMatrix* A_ = nullptr;
};

std::unique_ptr<Factorization::Impl> make(const SymmetricPattern& pattern,
                                          Precision precision,
                                          const std::shared_ptr<const Elimination>& order) {
  if (precision == Precision::single) {
    return multifrontal<float>(pattern, order);
  }
  if (precision == Precision::refined) return std::make_unique<Refined>(pattern, order);
  return multifrontal<double>(pattern, order);
}

}  // namespace

Factorization::Factorization(const SymmetricPattern& pattern, Precision precision)
    : Factorization(pattern, precision, std::make_shared<const Elimination>(eliminate(pattern))) {}
Factorization::Factorization(const SymmetricPattern& pattern,
                             Precision precision,
                             const std::shared_ptr<const Elimination>& elimination)
    : impl_(make(pattern, precision, elimination)) {}
Factorization::~Factorization() = default;
Factorization::Factorization(Factorization&&) noexcept = default;
Factorization& Factorization::operator=(Factorization&&) noexcept = default;

FactorStatus Factorization::factorize(const SymmetricMatrix& A) {
  return impl_->factorize(A, false);
}
void Factorization::release() { impl_->release(); }
FactorStatus Factorization::condense(const SymmetricMatrix& A) { return impl_->factorize(A, true); }
Eigen::MatrixXd Factorization::condensed() const { return impl_->condensed(); }
void Factorization::reduce(Eigen::Ref<Eigen::VectorXd> x) const { impl_->reduce(x); }
void Factorization::expand(Eigen::Ref<Eigen::VectorXd> x) const { impl_->expand(x); }
void Factorization::solve(Eigen::Ref<Eigen::VectorXd> x) const {
  impl_->solve(Eigen::Map<Eigen::MatrixXd>(x.data(), x.size(), 1), 0.0);
}
void Factorization::solve_columns(Eigen::Ref<Eigen::MatrixXd> X, double enough) const {
  impl_->solve(X, enough);
}
void Factorization::solve_roughly(Eigen::Ref<Eigen::MatrixXd> X) const { impl_->solve_roughly(X); }
const std::shared_ptr<const Elimination>& Factorization::elimination() const {
  return impl_->elimination;
}

}  // namespace latsch::numerics
