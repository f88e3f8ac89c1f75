// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/harmonic_contact.h"

#include <complex>
#include <vector>

namespace latsch::fe_tire {

using Complex = std::complex<double>;

/// Goes along all lines in the order of flow. `motion` gives the motions dx of a point, one column
/// for each that is followed, and `take` receives the changes of force that they cause there.
void HarmonicContact::follow(double omega, const Motion& motion, const Take& take) const {
  const Eigen::Matrix3Xd x = body_.positions(Eigen::VectorXd::Zero(body_.size()));
  for (int s = 0; s < std::ssize(body_.sections_); ++s) {
    const RollingLines::Line& line = body_.lines_.lines[s];
    Eigen::Matrix3Xcd before;  // motion of the point before
    Eigen::Matrix2Xcd t;       // change of its traction
    for (int k = line.first; k < line.last; ++k) {
      const Eigen::Matrix3Xcd here = motion(s, k);
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

Eigen::MatrixXcd HarmonicContact::tangent(double omega) const {
  const auto m = std::ssize(body_.rows_);
  Eigen::MatrixXcd sum = Eigen::MatrixXcd::Zero(m, m);
  Eigen::MatrixXcd on_line;
  const auto motion = [&](int s, int k) {
    const auto& section = body_.sections_[s];
    if (k == body_.lines_.lines[s].first)
      on_line.setZero(std::ssize(section.columns), std::ssize(section.columns));
    Eigen::Matrix3Xcd by = Eigen::Matrix3Xcd::Zero(3, std::ssize(section.columns));
    const auto w = section.w.row(k - body_.lines_.lines[s].first);
    for (Eigen::Index n = 0; n < w.size(); ++n)
      by.middleCols<3>(3 * n).diagonal().setConstant(w[n]);
    return by;
  };
  const auto take = [&](int s, int k, const Eigen::Matrix3Xcd& force) {
    const auto& section = body_.sections_[s];
    const auto w = section.w.row(k - body_.lines_.lines[s].first);
    for (Eigen::Index n = 0; n < w.size(); ++n)
      for (Eigen::Index c = 0; c < force.cols(); ++c)
        for (int d = 0; d < 3; ++d)
          sum(section.columns[3 * n + d], section.columns[c]) += w[n] * force(d, c);
  };
  follow(omega, motion, take);
  return sum;
}

Eigen::MatrixXcd HarmonicContact::forces_by(double omega,
                                            const std::vector<Eigen::Matrix3Xcd>& moved) const {
  Eigen::MatrixXcd sum = Eigen::MatrixXcd::Zero(std::ssize(body_.rows_), std::ssize(moved));
  const auto motion = [&](int, int k) {
    Eigen::Matrix3Xcd by(3, std::ssize(moved));
    for (Eigen::Index c = 0; c < by.cols(); ++c) by.col(c) = moved[c].col(k);
    return by;
  };
  const auto take = [&](int s, int k, const Eigen::Matrix3Xcd& force) {
    const auto& section = body_.sections_[s];
    const auto w = section.w.row(k - body_.lines_.lines[s].first);
    for (Eigen::Index n = 0; n < w.size(); ++n)
      for (int d = 0; d < 3; ++d) sum.row(section.columns[3 * n + d]) += w[n] * force.row(d);
  };
  follow(omega, motion, take);
  return sum;
}

Eigen::Matrix3Xcd HarmonicContact::point_forces(double omega,
                                                const Eigen::VectorXcd& q,
                                                const Eigen::Matrix3Xcd& moved) const {
  Eigen::Matrix3Xcd forces = Eigen::Matrix3Xcd::Zero(3, std::ssize(body_.points_));
  const auto motion = [&](int s, int k) {
    const auto& section = body_.sections_[s];
    const auto w = section.w.row(k - body_.lines_.lines[s].first);
    Eigen::Matrix3Xcd by = moved.col(k);
    for (Eigen::Index n = 0; n < w.size(); ++n)
      for (int d = 0; d < 3; ++d) by(d, 0) += w[n] * q[section.columns[3 * n + d]];
    return by;
  };
  const auto take = [&](int, int k, const Eigen::Matrix3Xcd& force) { forces.col(k) = force; };
  follow(omega, motion, take);
  return forces;
}

}  // namespace latsch::fe_tire
