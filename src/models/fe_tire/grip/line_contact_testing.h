// SPDX-License-Identifier: Apache-2.0
// An incompressible elastic half-plane that rolls on rigid ground in plane strain, with Hertz'
// pressure: the body for which Carter's solution is exact.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/fe_tire/grip/rolling_contact.h"
#include "numerics/dense/lu.h"

namespace latsch::fe_tire {

/// Rolling line contact of E 6 MPa, nu 1/2, R 0.3 m, mu 0.5, P 2 kN/m, in `count` places.
class LineContact : public RollingBody {
 public:
  static constexpr double kE = 6e6, kR = 0.3, kMu = 0.5, kP = 2e3;
  static constexpr double kEStar = kE / 0.75;
  static double half_width() { return std::sqrt(4.0 * kP * kR / (std::numbers::pi * kEStar)); }
  static double peak() { return 2.0 * kP / (std::numbers::pi * half_width()); }

  explicit LineContact(int count, double speed = 10.0) : count_(count), speed_(speed) {
    const int n = count + 1;  // the place before the leading edge, and those in contact
    const double a = half_width(), h = 2.0 * a / count;
    x_.resize(n);
    p_.setZero(n);
    for (int k = 0; k < n; ++k) {
      x_[k] = a + 0.5 * h - k * h;
      // The pressure of a place is its mean, so that the load is exact.
      if (k > 0) p_[k] = (load_behind(x_[k] + 0.5 * h) - load_behind(x_[k] - 0.5 * h)) / h;
    }
    // Displacements along by tractions along: -2/(pi E*) int q ln|x - s| ds; across, antiplane:
    // -1/(pi G) of the same integral. A constant does not matter, as only differences count; it
    // makes the matrix definite.
    const double G = kE / 3.0, far = 20.0 * a;
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    const auto integral = [&](double s) {
      return s == 0.0 ? 0.0 : s * (std::log(std::abs(s) / far) - 1.0);
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double d = x_[i] - x_[j];
        const double of = integral(d + 0.5 * h) - integral(d - 0.5 * h);
        C(2 * i, 2 * j) = -2.0 / (std::numbers::pi * kEStar) * of;
        C(2 * i + 1, 2 * j + 1) = -1.0 / (std::numbers::pi * G) * of;
      }
    }
    h_ = h;
    S_ = Eigen::MatrixXd::Identity(2 * n, 2 * n) * h;  // forces of tractions on the places
    numerics::Lu lu;
    lu.factorize(C);
    lu.solve(S_);
  }

  RollingLines lines() const {
    return {{{0, count_ + 1}}, Eigen::VectorXd::Constant(count_ + 1, h_ / speed_)};
  }
  /// Creep along and across; `spin` turns the creep from -spin at the leading edge to +spin.
  void set_creep(double along, double across, double spin = 0.0) {
    creep_ = {along, across};
    spin_ = spin;
  }
  Eigen::VectorXd rest() const { return Eigen::VectorXd::Zero(2 * (count_ + 1)); }
  const Eigen::VectorXd& places() const { return x_; }
  const Eigen::VectorXd& pressures() const { return p_; }
  Eigen::VectorXd& pressures() { return p_; }
  double width() const { return h_; }
  /// Force a unit of width, N/m.
  Eigen::Vector2d force(const GripTractions& tractions) const {
    return h_ * tractions.t.rowwise().sum();
  }

  RollingInput input(const Eigen::VectorXd& q) const override {
    const int n = count_ + 1;
    RollingInput input{Eigen::Matrix2Xd::Zero(2, n),
                       p_,
                       Eigen::VectorXd::Constant(n, 0.5),
                       Eigen::Matrix2Xd::Zero(2, n)};
    for (int k = 0; k < n; ++k) {
      input.x.col(k) << x_[k] + q[2 * k], q[2 * k + 1];
      // Driven or braked: the ground passes by more slowly or faster than the material.
      input.V_g.col(k) << -speed_ * (1.0 + creep_.x()),
          -speed_ * (creep_.y() - spin_ * x_[k] / half_width());
    }
    return input;
  }
  Eigen::VectorXd residual(const Eigen::VectorXd& q,
                           const RollingInput&,
                           const GripTractions& tractions) const override {
    return S_ * q - h_ * tractions.t.reshaped();
  }
  bool solve(const Eigen::VectorXd&,
             const RollingInput&,
             const GripTractions& tractions,
             const Eigen::VectorXd& R,
             Eigen::VectorXd& dq) override {
    Eigen::MatrixXd J = S_, right = R;
    Eigen::MatrixXd by = Eigen::MatrixXd::Zero(2, S_.cols());  // derivative of place k's traction
    for (int k = 1; k <= count_; ++k) {
      const GripLink& link = tractions.links[k];
      by = (link.by_before * by).eval();
      by.middleCols<2>(2 * k) += link.by_step;
      by.middleCols<2>(2 * k - 2) -= link.by_step;
      J.middleRows<2>(2 * k) -= h_ * by;
    }
    numerics::Lu lu;
    lu.factorize(J);
    lu.solve(right);
    dq = right;
    return dq.allFinite();
  }
  double force_scale() const override { return kMu * kP; }

 private:
  /// Load from the trailing edge to x.
  static double load_behind(double x) {
    const double s = std::clamp(x / half_width(), -1.0, 1.0);
    return kP * (0.5 + (s * std::sqrt(1.0 - s * s) + std::asin(s)) / std::numbers::pi);
  }
  int count_;
  double speed_, h_ = 0.0, spin_ = 0.0;
  Eigen::Vector2d creep_ = Eigen::Vector2d::Zero();
  Eigen::VectorXd x_, p_;
  Eigen::MatrixXd S_;
};

}  // namespace latsch::fe_tire
