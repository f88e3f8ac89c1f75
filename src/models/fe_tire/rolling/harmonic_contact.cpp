// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/harmonic_contact.h"

#include <cmath>
#include <complex>
#include <vector>

namespace latsch::fe_tire {

using Complex = std::complex<double>;

namespace {

/// Returns (1 - e^(-ix))/(ix), the mean of e^(-iy) for y from 0 to x.
Complex mean_phase(double x) {
  constexpr double kSmall = 1e-4;  // below it the series is exact to rounding
  if (std::abs(x) < kSmall) return {1.0 - x * x / 6.0, -0.5 * x};
  return (1.0 - std::polar(1.0, -x)) / Complex(0.0, x);
}

}  // namespace

/// Goes along all lines in the order of flow. `motion` gives the motions dx of a point, one column
/// for each that is followed, and `take` receives the changes of force that they cause there.
void HarmonicContact::follow(double omega, const Motion& motion, const Take& take) const {
  const Eigen::Matrix3Xd x = body_.positions(Eigen::VectorXd::Zero(body_.size()));
  for (int s = 0; s < std::ssize(body_.sections_); ++s) {
    const RollingLines::Line& line = body_.lines_.lines[s];
    Eigen::Matrix3Xcd before;  // motion of the point before
    Eigen::Matrix2Xcd t;       // change of its traction
    for (int k = line.first; k < line.last; ++k) {
      const Motions now_moves = motion(s, k);
      Eigen::Matrix3Xcd here = now_moves.dx;
      if (now_moves.besides.cols() > 0) here += now_moves.besides;
      if (!(input_.p[k] > 0.0)) {
        t.setZero(2, here.cols());
        before = here;
        continue;
      }
      const GripLink& link = tractions_.links[k];
      Eigen::Matrix2Xcd now = -body_.penalty_ * link.by_p * here.row(2);
      if (k > line.first) {
        const Complex e = std::polar(1.0, -omega * body_.lines_.time[k]);
        now += link.by_before * (e * t);
        now += link.by_step * (here - e * before).topRows<2>();
        const double time = body_.lines_.time[k], turn = body_.motion_.turn;
        // A wheel that turns passes over ground whose velocity depends on the place.
        Eigen::Matrix2Xcd faster(2, here.cols());
        faster << turn * now_moves.dx.row(1), -turn * now_moves.dx.row(0);
        if (now_moves.velocity.cols() > 0) faster += now_moves.velocity;
        now += link.by_step * (time * mean_phase(omega * time) * faster);
        if (!(input_.p[k - 1] > 0.0)) {
          const double z = x(2, k), above = x(2, k - 1), drop = z - above;
          now += link.by_share * ((z * e * before.row(2) - above * here.row(2)) / (drop * drop));
        }
      }
      Eigen::Matrix3Xcd force(3, here.cols());
      force.topRows<2>() = body_.areas_[k] * now;
      force.row(2) = -body_.areas_[k] * body_.penalty_ * here.row(2);
      take(s, k, force);
      t = std::move(now);
      before = here;
    }
  }
}

/// Returns the weights of a section's nodes in the position of a point.
Eigen::RowVectorXd HarmonicContact::weights(int section, int point) const {
  return body_.sections_[section].w.row(point - body_.lines_.lines[section].first);
}

Eigen::MatrixXcd HarmonicContact::tangent(double omega) const {
  const auto m = std::ssize(body_.rows_);
  Eigen::MatrixXcd sum = Eigen::MatrixXcd::Zero(m, m);
  const auto motion = [&](int s, int k) -> Motions {
    Eigen::Matrix3Xcd by = Eigen::Matrix3Xcd::Zero(3, std::ssize(body_.sections_[s].columns));
    const Eigen::RowVectorXd w = weights(s, k);
    for (Eigen::Index n = 0; n < w.size(); ++n)
      by.middleCols<3>(3 * n).diagonal().setConstant(w[n]);
    return {by};
  };
  const auto take = [&](int s, int k, const Eigen::Matrix3Xcd& force) {
    const auto& section = body_.sections_[s];
    const Eigen::RowVectorXd w = weights(s, k);
    for (Eigen::Index n = 0; n < w.size(); ++n)
      for (Eigen::Index c = 0; c < force.cols(); ++c)
        for (int d = 0; d < 3; ++d)
          sum(section.columns[3 * n + d], section.columns[c]) += w[n] * force(d, c);
  };
  follow(omega, motion, take);
  return sum;
}

Eigen::MatrixXcd HarmonicContact::forces_by(double omega,
                                            const std::vector<PointMotion>& motions) const {
  const auto count = std::ssize(motions);
  Eigen::MatrixXcd sum = Eigen::MatrixXcd::Zero(std::ssize(body_.rows_), count);
  const auto motion = [&](int, int k) -> Motions {
    Motions by{Eigen::Matrix3Xcd::Zero(3, count),
               Eigen::Matrix3Xcd(3, count),
               Eigen::Matrix2Xcd(2, count)};
    for (Eigen::Index c = 0; c < count; ++c) {
      by.besides.col(c) = motions[c].moved.col(k);
      by.velocity.col(c) = motions[c].velocity.col(k);
    }
    return by;
  };
  const auto take = [&](int s, int k, const Eigen::Matrix3Xcd& force) {
    const auto& section = body_.sections_[s];
    const Eigen::RowVectorXd w = weights(s, k);
    for (Eigen::Index n = 0; n < w.size(); ++n)
      for (int d = 0; d < 3; ++d) sum.row(section.columns[3 * n + d]) += w[n] * force.row(d);
  };
  follow(omega, motion, take);
  return sum;
}

Eigen::Matrix3Xcd HarmonicContact::point_forces(double omega,
                                                const Eigen::VectorXcd& q,
                                                const PointMotion& besides) const {
  const Eigen::Matrix3Xcd dx = displacements(q);
  Eigen::Matrix3Xcd forces = Eigen::Matrix3Xcd::Zero(3, std::ssize(body_.points_));
  const auto motion = [&](int, int k) -> Motions {
    return {dx.col(k), besides.moved.col(k), besides.velocity.col(k)};
  };
  const auto take = [&](int, int k, const Eigen::Matrix3Xcd& force) { forces.col(k) = force; };
  follow(omega, motion, take);
  return forces;
}

Eigen::Matrix3Xcd HarmonicContact::displacements(const Eigen::VectorXcd& q) const {
  Eigen::Matrix3Xcd dx = Eigen::Matrix3Xcd::Zero(3, std::ssize(body_.points_));
  for (int s = 0; s < std::ssize(body_.sections_); ++s) {
    const auto& columns = body_.sections_[s].columns;
    for (int k = body_.lines_.lines[s].first; k < body_.lines_.lines[s].last; ++k) {
      const Eigen::RowVectorXd w = weights(s, k);
      for (Eigen::Index n = 0; n < w.size(); ++n)
        for (int d = 0; d < 3; ++d) dx(d, k) += w[n] * q[columns[3 * n + d]];
    }
  }
  return dx;
}

Eigen::VectorXcd HarmonicContact::at_rows(const Eigen::Matrix3Xcd& forces) const {
  Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(std::ssize(body_.rows_));
  for (int s = 0; s < std::ssize(body_.sections_); ++s) {
    const auto& columns = body_.sections_[s].columns;
    for (int k = body_.lines_.lines[s].first; k < body_.lines_.lines[s].last; ++k) {
      const Eigen::RowVectorXd w = weights(s, k);
      for (Eigen::Index n = 0; n < w.size(); ++n)
        for (int d = 0; d < 3; ++d) sum[columns[3 * n + d]] += w[n] * forces(d, k);
    }
  }
  return sum;
}

Eigen::MatrixXd HarmonicContact::springs(const Eigen::Vector3d& stiffness) const {
  const auto m = std::ssize(body_.rows_);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(m, m);
  for (int s = 0; s < std::ssize(body_.sections_); ++s) {
    const auto& columns = body_.sections_[s].columns;
    for (int k = body_.lines_.lines[s].first; k < body_.lines_.lines[s].last; ++k) {
      if (!(input_.p[k] > 0.0)) continue;
      const Eigen::RowVectorXd w = body_.sections_[s].w.row(k - body_.lines_.lines[s].first);
      for (Eigen::Index a = 0; a < w.size(); ++a)
        for (Eigen::Index b = 0; b < w.size(); ++b)
          for (int d = 0; d < 3; ++d)
            sum(columns[3 * a + d], columns[3 * b + d]) +=
                stiffness[d] * body_.areas_[k] * w[a] * w[b];
    }
  }
  return sum;
}

}  // namespace latsch::fe_tire
