// SPDX-License-Identifier: Apache-2.0
// The textbook recurrence is not used: the basis (tens of vectors) costs little compared with the
// factorization, so every new direction is made orthogonal to all others. This gives the
// decomposition
//     Op V = V T + Q B,    Op = (K - sigma M)^-1 M,    V, Q orthonormal in M,
// with a pool Q of directions that have not been multiplied by the operator yet. A step takes from
// the pool the directions in which the wanted Ritz vectors have the largest errors (singular
// vectors of B S), multiplies them, and puts the new part of the products into the pool. With one
// start vector this is Lanczos' method, with a good start block it needs few steps, and a thick
// restart is a rotation of V and B. The residual of the Ritz pair (theta, V s) is |B s|, so
// convergence is judged without vector operations.
#include "numerics/sparse/lanczos.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "numerics/dense/dense_products.h"
#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch::numerics {
namespace {

constexpr double kDependent = 1e-12;  // relative length below which a direction is only rounding
// Largest inner product of two directions that is accepted after normalizing; if it is larger,
// another pass of orthogonalization follows. The second constant is a multiple of the tolerance.
constexpr double kOrthogonal = 1e-10, kOrthogonalOfTolerance = 1e-5;
constexpr double kNearEigenvector = 0.02;  // largest residual of a start vector that is kept
// Vectors of the basis beyond twice the wanted pairs before a restart.
constexpr int kSpareDirections = 20;
constexpr int kKeptBeyondWanted = 6;  // Ritz vectors kept at a restart beyond the wanted ones
// Steps between two checks of convergence if the block is narrow; each check costs the solution of
// a projected eigenproblem.
constexpr int kStepsBetweenChecks = 3;

/// Returns a number in (-1, 1) that depends only on the index. [Steele, Lea & Flood, SplitMix64,
/// OOPSLA 2014]
double scattered(std::uint64_t index) {
  std::uint64_t z = index * 0x9e3779b97f4a7c15u + 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return static_cast<double>(static_cast<std::int64_t>(z)) * 0x1p-63;
}

template <class Scalar>
class Lanczos {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

 public:
  Lanczos(const EigenProblem<Scalar>& problem, const LanczosSettings& settings)
      : problem_(problem),
        settings_(settings),
        n_(problem.size),
        wanted_(std::min(settings.count, n_)),
        capacity_(std::min(n_, 2 * wanted_ + kSpareDirections + settings.block)) {}

  EigenPairs<Scalar> run(const Matrix& start);

 private:
  static Matrix product(const Eigen::Ref<const Matrix>& A, const Matrix& B) {
    Matrix C(A.rows(), B.cols());
    add_product<Scalar>(1.0, A, B, 0.0, C);
    return C;
  }
  void begin(const Matrix& start);
  Matrix scattered_block(int columns);
  Matrix new_directions(Matrix W);
  void add_to_pool(Matrix X);
  bool good(const Matrix& start);
  void step(int width);
  void rotate_pool(int width);
  void solve_small_problem();
  /// Tolerance of the k-th lowest pair.
  double tolerance_of(int k) const {
    return k < wanted_ - settings_.spare ? settings_.tolerance : settings_.spare_tolerance;
  }
  bool converged() const;
  void restart();
  EigenPairs<Scalar> result() const;

  auto basis() { return V_.leftCols(done_ + pool_); }
  auto mass_basis() { return MV_.leftCols(done_ + pool_); }

  const EigenProblem<Scalar>& problem_;
  const LanczosSettings& settings_;
  int n_, wanted_, capacity_;
  Matrix V_, MV_;  // columns 0..done_-1 are V, all others the pool Q; MV_ is M times both
  int done_ = 0, pool_ = 0;
  Matrix T_, B_;           // T is done_ x done_, B is pool_ x done_
  Eigen::VectorXd theta_;  // ascending
  Matrix S_;
  std::uint64_t random_index_ = 0;
  int solves_ = 0;
};

template <class Scalar>
typename Lanczos<Scalar>::Matrix Lanczos<Scalar>::scattered_block(int columns) {
  Matrix X(n_, columns);
  for (Scalar& x : X.reshaped()) x = Scalar(scattered(random_index_++));
  return X;
}

/// Appends to the pool the part of W that is orthogonal to the basis. Returns C in the
/// decomposition W = (part in the basis) + (new directions) C.
template <class Scalar>
typename Lanczos<Scalar>::Matrix Lanczos<Scalar>::new_directions(Matrix W) {
  Matrix C = Matrix::Identity(W.cols(), W.cols());
  const int before = done_ + pool_;
  Matrix MW(n_, W.cols());
  double smallest = 0.0;
  for (int pass = 0; pass < 4; ++pass) {
    const Matrix overlap = overlaps<Scalar>(MV_.leftCols(before), W);
    add_product<Scalar>(-1.0, V_.leftCols(before), overlap, 1.0, W);
    MW.resize(n_, W.cols());
    problem_.mass(W, MW);
    const Matrix gram = overlaps<Scalar>(W, MW);
    const SelfAdjointEigen<Scalar> eigen = self_adjoint_eigen(gram);
    const Eigen::VectorXd& square = eigen.values;
    if (pass == 0) smallest = kDependent * kDependent * std::max(square.maxCoeff(), 0.0);
    int first = 0;
    while (first < square.size() && !(square[first] > smallest)) ++first;
    const auto kept = square.size() - first;
    const Eigen::VectorXd norm = square.tail(kept).cwiseSqrt();
    const Matrix U = eigen.vectors.rightCols(kept);
    const Matrix scaled = U * norm.cwiseInverse().template cast<Scalar>().asDiagonal();
    C = (norm.template cast<Scalar>().asDiagonal() * U.adjoint() * C).eval();
    W = product(W, scaled);
    MW = product(MW, scaled);
    if (kept == 0) break;
    const double left =
        before ? overlaps<Scalar>(MV_.leftCols(before), W).cwiseAbs().maxCoeff() : 0.0;
    const double condition = norm.maxCoeff() / norm.minCoeff();
    if (left < std::max(kOrthogonal, kOrthogonalOfTolerance * settings_.tolerance) &&
        condition < 1e4) {
      break;
    }
    smallest = 0.25;  // W is normalized now: what vanishes in the second pass was rounding
  }
  const auto needed = before + W.cols();
  if (V_.cols() < needed) {
    V_.conservativeResize(n_, needed + 8);
    MV_.conservativeResize(n_, needed + 8);
  }
  V_.middleCols(before, W.cols()) = W;
  MV_.middleCols(before, W.cols()) = MW;
  return C;
}

/// Adds to the pool directions that are not products with the operator. The residuals so far have
/// no components along them.
template <class Scalar>
void Lanczos<Scalar>::add_to_pool(Matrix X) {
  const auto fresh = new_directions(std::move(X)).rows();
  B_.conservativeResize(pool_ + fresh, done_);
  B_.bottomRows(fresh).setZero();
  pool_ += static_cast<int>(fresh);
}

/// True if the start vectors are close to eigenvectors, judged by the first of them. Start vectors
/// from a problem that differs more have errors in as many directions as there are vectors.
/// Correcting all of these costs more than a Krylov sequence from random vectors.
template <class Scalar>
bool Lanczos<Scalar>::good(const Matrix& start) {
  if (start.cols() == 0) return false;
  add_to_pool(start.leftCols(std::min<Eigen::Index>(start.cols(), settings_.block)));
  if (pool_ == 0) return false;
  step(pool_);
  solve_small_problem();
  for (int k = 0; k < done_; ++k) {
    if (!(theta_[k] > 0.0) || !((B_ * S_.col(k)).norm() <= kNearEigenvector * theta_[k]))
      return false;
  }
  return true;
}

template <class Scalar>
void Lanczos<Scalar>::begin(const Matrix& start) {
  V_.resize(n_, capacity_ + settings_.block);
  MV_.resize(n_, V_.cols());
  if (good(start)) {
    // Adds the new part of `start` and then random directions, because all columns of `start` may
    // have one symmetry.
    add_to_pool(start);
    add_to_pool(scattered_block(settings_.block));
    step(pool_);
  } else {
    done_ = pool_ = 0;
    T_.resize(0, 0);
    B_.resize(0, 0);
  }
}

/// Rotates the pool by an orthogonal matrix so that its first columns are the directions in which
/// the wanted Ritz vectors have the largest errors.
template <class Scalar>
void Lanczos<Scalar>::rotate_pool(int width) {
  if (pool_ <= width || done_ == 0) return;
  solve_small_problem();
  const int columns = std::min(wanted_, done_);
  Matrix errors = B_ * S_.rightCols(columns);
  for (int k = 0; k < columns; ++k) {
    const double theta = std::abs(theta_[done_ - columns + k]);
    const double error = errors.col(k).norm();
    if (error <= tolerance_of(columns - 1 - k) * theta) {
      errors.col(k).setZero();
    } else {
      errors.col(k) /= theta;
    }
  }
  const Matrix U =
      self_adjoint_eigen(Matrix(errors * errors.adjoint())).vectors.rowwise().reverse();
  V_.middleCols(done_, pool_) = product(V_.middleCols(done_, pool_), U);
  MV_.middleCols(done_, pool_) = product(MV_.middleCols(done_, pool_), U);
  B_ = (U.adjoint() * B_).eval();
}

/// Multiplies the first `width` directions of the pool by the operator and moves them into V.
template <class Scalar>
void Lanczos<Scalar>::step(int width) {
  Matrix W = MV_.middleCols(done_, width);
  problem_.solve(W);
  solves_ += width;
  const int rest = pool_ - width;
  const Matrix mass_pool = overlaps<Scalar>(MV_.middleCols(done_, pool_), W);
  const Matrix D = 0.5 * (mass_pool.topRows(width) + mass_pool.topRows(width).adjoint());
  const Matrix C = new_directions(std::move(W));
  const auto fresh = C.rows();

  Matrix T(done_ + width, done_ + width);
  T.topLeftCorner(done_, done_) = T_;
  T.bottomRightCorner(width, width) = D;
  if (done_ > 0) {
    T.bottomLeftCorner(width, done_) = B_.topRows(width);
    T.topRightCorner(done_, width) = B_.topRows(width).adjoint();
  }
  Matrix B = Matrix::Zero(rest + fresh, done_ + width);
  if (done_ > 0) B.topLeftCorner(rest, done_) = B_.bottomRows(rest);
  B.topRightCorner(rest, width) = mass_pool.bottomRows(rest);
  B.bottomRightCorner(fresh, width) = C;
  T_ = std::move(T);
  B_ = std::move(B);
  done_ += width;
  pool_ = static_cast<int>(rest + fresh);
}

template <class Scalar>
void Lanczos<Scalar>::solve_small_problem() {
  SelfAdjointEigen<Scalar> eigen = self_adjoint_eigen(T_);
  theta_ = std::move(eigen.values);
  S_ = std::move(eigen.vectors);
}

template <class Scalar>
bool Lanczos<Scalar>::converged() const {
  if (done_ < wanted_) return false;
  for (int k = done_ - wanted_; k < done_; ++k) {
    if (!(theta_[k] > 0.0)) return false;  // also returns for NaN
    const double tolerance = tolerance_of(done_ - 1 - k);
    if (pool_ > 0 && !((B_ * S_.col(k)).norm() <= tolerance * theta_[k])) return false;
  }
  return true;
}

template <class Scalar>
void Lanczos<Scalar>::restart() {
  solve_small_problem();
  const int kept = std::min(done_, wanted_ + kKeptBeyondWanted + settings_.block);
  const Matrix S = S_.rightCols(kept);
  const Matrix pool = V_.middleCols(done_, pool_), mass_pool = MV_.middleCols(done_, pool_);
  V_.leftCols(kept) = product(V_.leftCols(done_), S);
  MV_.leftCols(kept) = product(MV_.leftCols(done_), S);
  V_.middleCols(kept, pool_) = pool;
  MV_.middleCols(kept, pool_) = mass_pool;
  T_ = theta_.tail(kept).template cast<Scalar>().asDiagonal();
  B_ = (B_ * S).eval();
  done_ = kept;
}

template <class Scalar>
EigenPairs<Scalar> Lanczos<Scalar>::result() const {
  EigenPairs<Scalar> pairs;
  const int count = std::min(wanted_, done_);
  pairs.values = theta_.tail(count).reverse().cwiseInverse().array() + problem_.shift;
  pairs.vectors = product(V_.leftCols(done_), S_.rightCols(count).rowwise().reverse());
  pairs.converged = converged();
  pairs.solves = solves_;
  return pairs;
}

template <class Scalar>
EigenPairs<Scalar> Lanczos<Scalar>::run(const Matrix& start) {
  begin(start);
  int since_check = 0;
  for (int steps = 0; steps < settings_.max_steps; ++steps) {
    // The pool is empty at the start. It becomes empty again if the basis spans an invariant
    // subspace, which may have too few vectors.
    if (pool_ == 0 && done_ < n_) add_to_pool(scattered_block(settings_.block));
    if (pool_ == 0) break;
    const int width = std::min(pool_, settings_.block);
    rotate_pool(width);
    step(width);
    ++since_check;
    if (done_ < wanted_ || (since_check < kStepsBetweenChecks && settings_.block == 1)) continue;
    since_check = 0;
    solve_small_problem();
    if (converged()) break;
    if (done_ + settings_.block > capacity_ && done_ < n_) restart();
  }
  // M is zero or contains values that are not numbers.
  if (done_ == 0) return {{}, Matrix(n_, 0), false, solves_};
  solve_small_problem();
  return result();
}

}  // namespace

template <class Scalar>
EigenPairs<Scalar> lanczos(const EigenProblem<Scalar>& problem,
                           const LanczosSettings& settings,
                           const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& start) {
  assert(start.cols() == 0 || start.rows() == problem.size);
  assert(settings.block > 0 && settings.count > 0);
  return Lanczos<Scalar>(problem, settings).run(start);
}

template EigenPairs<double> lanczos(const EigenProblem<double>&,
                                    const LanczosSettings&,
                                    const Eigen::MatrixXd&);
template EigenPairs<std::complex<double>> lanczos(const EigenProblem<std::complex<double>>&,
                                                  const LanczosSettings&,
                                                  const Eigen::MatrixXcd&);

}  // namespace latsch::numerics
