// SPDX-License-Identifier: Apache-2.0
#include "optimization/surrogate/polynomial_chaos.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/random.h"

namespace latsch {
namespace {

constexpr int kMostDegree = 14;
constexpr int kMostTogether = 3;               // variables in one term
constexpr int kMostCandidates = 1000;          // a larger set is left out
constexpr int kMostTerms = 100;                // taken terms
constexpr double kTermsOfPoints = 0.5;         // taken terms, as a share of the points
constexpr double kNorms[] = {0.5, 0.75, 1.0};  // q
constexpr int kParts = 5;
constexpr int kPatience = 3;  // degrees in a row that do not improve the error, then none follows
/// Smallest share of a column's squared length that must be orthogonal to the terms already taken.
/// A larger value excludes more columns that are nearly dependent on these terms.
constexpr double kNew = 1e-8;
constexpr double kNothingLeft = 1e-13;  // share of the length of the values
constexpr std::uint64_t kSeedOfParts = 1;

using Degrees = std::vector<int>;

/// Returns P_0 .. P_kMostDegree at u, by the recurrence of the Legendre polynomials over -1 .. 1.
std::vector<double> legendre(double u) {
  const double t = 2.0 * u - 1.0;
  std::vector<double> p{1.0, t};
  for (int k = 1; k < kMostDegree; ++k)
    p.push_back(((2 * k + 1) * t * p[k] - k * p[k - 1]) / (k + 1));
  for (int k = 0; k <= kMostDegree; ++k) p[k] *= std::sqrt(2 * k + 1.0);
  return p;
}

void add_candidates(
    int i, double left, int together, int p, double q, Degrees& a, std::vector<Degrees>& all) {
  if (std::ssize(all) > kMostCandidates) return;
  if (i == std::ssize(a)) {
    all.push_back(a);
    return;
  }
  const int most = together < kMostTogether ? p : 0;
  for (a[i] = 0; a[i] <= most; ++a[i]) {
    const double rest = left - std::pow(a[i], q);
    if (rest < -1e-9) break;
    add_candidates(i + 1, rest, together + (a[i] > 0), p, q, a, all);
  }
  a[i] = 0;
}

/// Returns the candidates in the order of their total degrees, the constant first; none if there
/// are too many.
std::vector<Degrees> candidates(int n, int p, double q) {
  std::vector<Degrees> all;
  Degrees a(n, 0);
  add_candidates(0, std::pow(p, q), 0, p, q, a, all);
  if (std::ssize(all) > kMostCandidates) return {};
  std::stable_sort(all.begin(), all.end(), [](const Degrees& one, const Degrees& other) {
    return std::accumulate(one.begin(), one.end(), 0) <
           std::accumulate(other.begin(), other.end(), 0);
  });
  return all;
}

/// Terms taken one after the other from the columns of a matrix, with an orthonormal basis of them.
class TermsTaken {
 public:
  TermsTaken(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values, int most)
      : columns_(columns),
        residual_(values),
        length_(values.norm()),
        Q_(columns.rows(), most),
        full_(columns.colwise().squaredNorm()),
        left_(full_) {
    take(0);
  }

  /// Takes the next term. Returns false if none is left that reduces the residual.
  bool take_next() {
    if (taken_.size() == static_cast<std::size_t>(Q_.cols())) return false;
    const Eigen::ArrayXd gain = (columns_.transpose() * residual_).array().square();
    Eigen::Index best = -1;
    double most = 0.0;
    for (Eigen::Index j = 0; j < gain.size(); ++j) {
      if (left_[j] <= kNew * full_[j]) continue;
      if (gain[j] / left_[j] > most) {
        most = gain[j] / left_[j];
        best = j;
      }
    }
    if (best < 0 || std::sqrt(most) <= kNothingLeft * length_) return false;
    take(best);
    return true;
  }

  const std::vector<Eigen::Index>& taken() const { return taken_; }
  /// Column of the last term, as a combination of the orthonormal basis: its new part last.
  const Eigen::VectorXd& combination() const { return combination_; }
  /// Product of the values with the last column of the basis.
  double product() const { return product_; }

 private:
  void take(Eigen::Index j) {
    const auto k = static_cast<Eigen::Index>(taken_.size());
    const auto Q = Q_.leftCols(k);
    Eigen::VectorXd q = columns_.col(j);
    combination_ = Eigen::VectorXd::Zero(k + 1);
    for (int twice = 0; twice < 2; ++twice) {
      const Eigen::VectorXd along = Q.transpose() * q;
      q -= Q * along;
      combination_.head(k) += along;
    }
    combination_[k] = q.norm();
    q /= combination_[k];
    Q_.col(k) = q;
    product_ = q.dot(residual_);
    residual_ -= product_ * q;
    left_ = (left_.array() - (columns_.transpose() * q).array().square()).max(0.0);
    left_[j] = 0.0;
    taken_.push_back(j);
  }

  const Eigen::MatrixXd& columns_;
  Eigen::VectorXd residual_;
  double length_;
  Eigen::MatrixXd Q_;
  Eigen::VectorXd full_, left_;  // squared lengths of the columns: whole, and beside the basis
  std::vector<Eigen::Index> taken_;
  Eigen::VectorXd combination_;
  double product_ = 0.0;
};

int most_terms(Eigen::Index points, Eigen::Index candidates) {
  const auto share = static_cast<Eigen::Index>(kTermsOfPoints * static_cast<double>(points));
  return static_cast<int>(std::clamp<Eigen::Index>(
      std::min(share, candidates), 1, static_cast<Eigen::Index>(kMostTerms)));
}

/// Adds to errors[k - 1] the sum of squares at the points left out, for k = 1, 2, ... terms.
void add_errors(const Eigen::MatrixXd& seen,
                const Eigen::VectorXd& seen_values,
                const Eigen::MatrixXd& unseen,
                const Eigen::VectorXd& unseen_values,
                Eigen::VectorXd& errors) {
  const int most = std::min(static_cast<int>(errors.size()), static_cast<int>(seen.rows()) - 1);
  TermsTaken terms(seen, seen_values, std::max(most, 1));
  Eigen::MatrixXd basis(unseen.rows(), std::max(most, 1));  // the orthonormal basis continued there
  Eigen::VectorXd residual = unseen_values;
  Eigen::Index k = 0;
  double sum = 0.0;
  do {
    const Eigen::VectorXd& along = terms.combination();
    basis.col(k) =
        (unseen.col(terms.taken().back()) - basis.leftCols(k) * along.head(k)) / along[k];
    residual -= terms.product() * basis.col(k);
    sum = residual.squaredNorm();
    errors[k++] += sum;
  } while (terms.take_next());
  for (; k < errors.size(); ++k) errors[k] += sum;
}

/// Parts of the points: for each part, the rows that it contains.
std::vector<std::vector<Eigen::Index>> parts_of(Eigen::Index points) {
  std::vector<Eigen::Index> order(points);
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  RandomStream random(kSeedOfParts, 0);
  for (Eigen::Index k = points - 1; k > 0; --k)
    std::swap(order[k], order[random.below(static_cast<std::uint64_t>(k) + 1)]);
  std::vector<std::vector<Eigen::Index>> parts(
      static_cast<std::size_t>(std::min<Eigen::Index>(kParts, points)));
  for (Eigen::Index k = 0; k < points; ++k) parts[k % parts.size()].push_back(order[k]);
  for (auto& part : parts) std::sort(part.begin(), part.end());
  return parts;
}

std::vector<Eigen::Index> others(const std::vector<Eigen::Index>& part, Eigen::Index points) {
  std::vector<Eigen::Index> all(points), rest;
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  std::set_difference(all.begin(), all.end(), part.begin(), part.end(), std::back_inserter(rest));
  return rest;
}

}  // namespace

PolynomialChaos::PolynomialChaos(const Eigen::MatrixXd& points, const Eigen::VectorXd& values) {
  const Eigen::Index N = points.rows();
  const int n = static_cast<int>(points.cols());
  std::vector<std::vector<std::vector<double>>> legendre_of(n);  // variable, point, degree
  for (int i = 0; i < n; ++i)
    for (Eigen::Index row = 0; row < N; ++row) legendre_of[i].push_back(legendre(points(row, i)));
  const auto parts = parts_of(N);

  double least = std::numeric_limits<double>::infinity();
  std::vector<Degrees> chosen;
  Eigen::MatrixXd columns_chosen;
  int terms_chosen = 1, without_gain = 0;
  for (int p = 1; p <= kMostDegree && without_gain < kPatience; ++p) {
    ++without_gain;
    for (const double q : kNorms) {
      const auto all = candidates(n, p, q);
      if (all.empty()) continue;
      Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(N, std::ssize(all));
      for (Eigen::Index j = 0; j < columns.cols(); ++j)
        for (int i = 0; i < n; ++i)
          for (Eigen::Index row = 0; all[j][i] > 0 && row < N; ++row)
            columns(row, j) *= legendre_of[i][row][all[j][i]];
      Eigen::VectorXd errors = Eigen::VectorXd::Zero(most_terms(N, columns.cols()));
      for (const auto& part : parts) {
        const auto rest = others(part, N);
        add_errors(columns(rest, Eigen::all),
                   values(rest),
                   columns(part, Eigen::all),
                   values(part),
                   errors);
      }
      Eigen::Index best = 0;
      if (!(errors.minCoeff(&best) < least)) continue;
      least = errors[best];
      terms_chosen = static_cast<int>(best) + 1;
      chosen = all;
      columns_chosen = std::move(columns);
      without_gain = 0;
    }
  }

  TermsTaken terms(columns_chosen, values, terms_chosen);
  while (terms.take_next()) {
  }
  const Eigen::MatrixXd taken = columns_chosen(Eigen::all, terms.taken());
  const Eigen::VectorXd coefficients = taken.householderQr().solve(values);
  for (std::size_t k = 0; k < terms.taken().size(); ++k)
    terms_.push_back({chosen[terms.taken()[k]], coefficients[static_cast<Eigen::Index>(k)]});
}

double PolynomialChaos::value(const Eigen::VectorXd& point) const {
  std::vector<std::vector<double>> p;
  for (const double u : point) p.push_back(legendre(u));
  double sum = 0.0;
  for (const Term& term : terms_) {
    double product = term.coefficient;
    for (std::size_t i = 0; i < p.size(); ++i) product *= p[i][term.degrees[i]];
    sum += product;
  }
  return sum;
}

double PolynomialChaos::variance() const {
  double sum = 0.0;
  for (const Term& term : terms_)
    if (std::any_of(term.degrees.begin(), term.degrees.end(), [](int d) { return d > 0; }))
      sum += term.coefficient * term.coefficient;
  return sum;
}

double PolynomialChaos::variance_of(int i, bool alone) const {
  double sum = 0.0;
  for (const Term& term : terms_) {
    const auto others =
        std::count_if(term.degrees.begin(), term.degrees.end(), [](int d) { return d > 0; }) - 1;
    if (term.degrees[i] > 0 && (!alone || others == 0)) sum += term.coefficient * term.coefficient;
  }
  return sum;
}

}  // namespace latsch
