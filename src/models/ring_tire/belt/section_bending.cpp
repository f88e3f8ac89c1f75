// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/section_bending.h"

#include <cmath>
#include <utility>

namespace latsch::ring_tire {
namespace {

/// Solutions of cos β cosh β = 1.
constexpr double kBeta[SectionBending::kModes] = {
    4.730040744862704, 7.853204624095838, 10.995607838001671};

/// Returns the inverse of the cyclic tridiagonal matrix of (25) at distance d from its diagonal.
/// With k = λ L0, s = κ T0/L0 and ρ < 1 the root of s ρ² - (k + 2 s) ρ + s = 0, it is (ρ^d +
/// ρ^(N-d))/(s (1/ρ - ρ) (1 - ρ^N)).
double inverse_at(double k, double s, int N, int d) {
  if (s == 0.0) return d == 0 ? 1.0 / k : 0.0;
  const double half = 1.0 + 0.5 * k / s;
  const double rho = 1.0 / (half + std::sqrt(half * half - 1.0));
  return (std::pow(rho, d) + std::pow(rho, N - d)) /
         (s * (1.0 / rho - rho) * (1.0 - std::pow(rho, N)));
}

}  // namespace

SectionBending::SectionBending(
    const Belt& belt, double width, double chord, double tension, int nodes)
    : on_(belt.bending_across > 0.0), nodes_(nodes), width_(width) {
  reset();
  if (!on_) return;
  green_.resize(kModes, nodes);
  const double coupling = belt.section_coupling * tension / chord;  // κ T0/L0
  for (int i = 0; i < kModes; ++i) {
    const double own = belt.bending_across * std::pow(kBeta[i], 4) / std::pow(width, 3) * chord;
    for (int d = 0; d < nodes; ++d) green_(i, d) = inverse_at(own, coupling, nodes, d);
  }
}

double SectionBending::shape(int mode, double y) const {
  const double beta = kBeta[mode], at = beta * y / width_, end = 0.5 * beta;
  return mode % 2 == 0 ? std::cos(at) / std::cos(end) + std::cosh(at) / std::cosh(end)
                       : std::sin(at) / std::sin(end) + std::sinh(at) / std::sinh(end);  // (23)
}

SectionBending::Field SectionBending::bent_by(const Field& f) const {
  Field gamma = Field::Zero(kModes, nodes_);
  for (int mode = 0; mode < kModes; ++mode) {
    for (int l = 0; l < nodes_; ++l) {
      if (f(mode, l) == 0.0) continue;
      for (int k = 0; k < nodes_; ++k)
        gamma(mode, k) += green(mode, k >= l ? k - l : l - k) * f(mode, l);
    }
  }
  return gamma;
}

void SectionBending::reset() {
  field_ = kept_ = Field::Zero(kModes, nodes_);
  contact_.clear();
  own_.resize(0, 0);
}

/// Computes γ of all nodes from those in contact.
void SectionBending::spread() {
  if (contact_.empty()) return;
  const Eigen::VectorXd f = own_ * values();
  Field at = Field::Zero(kModes, nodes_);
  for (std::size_t c = 0; c < contact_.size(); ++c)
    at.col(contact_[c]) = f.segment<kModes>(kModes * static_cast<Eigen::Index>(c));
  field_ = bent_by(at);
}

void SectionBending::flow(double segments) {
  const double whole = std::floor(segments), part = segments - whole;
  const int shift = static_cast<int>(whole) % nodes_;
  const Field before = field_;
  for (int k = 0; k < nodes_; ++k) {
    const auto at = [&](int back) { return before.col((k - shift - back + 2 * nodes_) % nodes_); };
    field_.col(k) = (1.0 - part) * at(0) + part * at(1);
  }
  contact_.clear();
}

void SectionBending::touch(std::vector<int> nodes) {
  if (nodes.empty()) {
    field_.setZero();
    contact_.clear();
    own_.resize(0, 0);
    return;
  }
  if (nodes == contact_) return;
  spread();
  contact_ = std::move(nodes);
  const Eigen::Index count = unknowns();
  flexibility_ = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index a = 0; a < count; ++a)
    for (Eigen::Index b = 0; b <= a; ++b) {
      if (a % kModes != b % kModes) continue;
      const int distance = std::abs(contact_[static_cast<std::size_t>(a / kModes)] -
                                    contact_[static_cast<std::size_t>(b / kModes)]);
      flexibility_(a, b) = flexibility_(b, a) = green(static_cast<int>(a % kModes), distance);
    }
  own_ = flexibility_.llt().solve(Eigen::MatrixXd::Identity(count, count));
}

void SectionBending::set_forces(const Eigen::VectorXd& f) { residual_ = f - own_ * values(); }

bool SectionBending::border(const CyclicBandFactor& factor,
                            const Eigen::MatrixXd& B,
                            const Eigen::MatrixXd& A,
                            double scale) {
  scale_ = scale;
  B_ = scale * B;
  KB_.resize(B.rows(), B.cols());
  for (Eigen::Index i = 0; i < B.cols(); ++i) {
    Eigen::Matrix4Xd column = Eigen::Map<const Eigen::Matrix4Xd>(B_.col(i).data(), 4, nodes_);
    factor.solve(column);
    KB_.col(i) = column.reshaped();
  }
  if (B.cols() == 0) return true;
  // B is nonzero only for nodes that blocks on the road depend on.
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < B_.rows(); ++i)
    if ((B_.row(i).array() != 0.0).any()) rows.push_back(i);
  const Eigen::MatrixXd of_contact = B_(rows, Eigen::all);
  schur_.compute(scale * (own_ + A) - of_contact.transpose() * KB_(rows, Eigen::all));
  return schur_.info() == Eigen::Success;
}

void SectionBending::solve(const CyclicBandFactor& factor, Eigen::Matrix4Xd& x) {
  factor.solve(x);
  direction_ = Eigen::VectorXd::Zero(unknowns());
  if (direction_.size() == 0) return;
  direction_ = schur_.solve(scale_ * residual_ - B_.transpose() * x.reshaped());
  x.reshaped() -= KB_ * direction_;
}

void SectionBending::solve_columns(const CyclicBandFactor& factor, Eigen::Ref<SideBySide> x) const {
  factor.solve_columns(x);
  if (unknowns() == 0) return;
  auto belt = x.topRows(4 * nodes_);
  auto own = x.bottomRows(unknowns());
  own = schur_.solve(own - B_.transpose() * belt).eval();
  belt.noalias() -= KB_ * own;
}

void SectionBending::solve_free(const CyclicBandFactor& factor, Eigen::Matrix4Xd& x) const {
  factor.solve(x);
  if (B_.cols() == 0) return;
  const Eigen::VectorXd along = B_.transpose() * x.reshaped();
  x.reshaped() += KB_ * schur_.solve(along);
}

Eigen::VectorXd SectionBending::values() const {
  Eigen::VectorXd values(unknowns());
  for (std::size_t c = 0; c < contact_.size(); ++c)
    values.segment<kModes>(kModes * static_cast<Eigen::Index>(c)) = field_.col(contact_[c]);
  return values;
}

void SectionBending::set_values(const Eigen::VectorXd& values) {
  for (std::size_t c = 0; c < contact_.size(); ++c)
    field_.col(contact_[c]) = values.segment<kModes>(kModes * static_cast<Eigen::Index>(c));
}

double SectionBending::energy() const {
  return contact_.empty() ? 0.0 : 0.5 * values().dot(own_ * values());
}

void SectionBending::accept() {
  spread();
  kept_ = field_;
}

}  // namespace latsch::ring_tire
