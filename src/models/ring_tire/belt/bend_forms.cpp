// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/bend_forms.h"

#include <cmath>

namespace latsch::ring_tire {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Eigen::Vector2d;

/// Returns factor * s; the caller adds derivatives by other variables in the factor.
Strain times(const Strain& s, double factor) {
  return {factor * s.value, factor * s.slope, factor * s.second};
}

/// Returns the product of s with a form.
Strain times_form(const Strain& s, double factor, double value, BendForm form) {
  Strain product = times(s, factor * value);
  product.slope[form] += factor * s.value;
  product.second.row(form) += factor * s.slope.transpose();
  product.second.col(form) += factor * s.slope;
  return product;
}

/// Returns s = d . n of (3), n = a × t, with derivatives as in (27).
Strain bend_of(const BendVector& z) {
  const Vector2d c = z.segment<2>(kSlopeX), d = z.segment<2>(kBendX);
  const double length = c.norm();
  const Vector2d t = c / length, n(t.y(), -t.x());
  const double along = d.dot(t) / length;
  Strain s{d.dot(n), BendVector::Zero(), BendMatrix::Zero()};
  s.slope.segment<2>(kBendX) = n;
  s.slope.segment<2>(kSlopeX) = -along * n;
  const Matrix2d of_bend = -t * n.transpose() / length;
  s.second.block<2, 2>(kBendX, kSlopeX) = of_bend;
  s.second.block<2, 2>(kSlopeX, kBendX) = of_bend.transpose();
  s.second.block<2, 2>(kSlopeX, kSlopeX) =
      (along * (t * n.transpose() + n * t.transpose()) - (s.value / length) * n * n.transpose()) /
      length;
  return s;
}

Strain length_of(const BendVector& z) {
  constexpr int kSlopes[3] = {kSlopeX, kSlopeY, kSlopeZ};
  const Eigen::Vector3d g(z[kSlopeX], z[kSlopeY], z[kSlopeZ]), e = g.normalized();
  Strain s{g.norm(), BendVector::Zero(), BendMatrix::Zero()};
  for (int i = 0; i < 3; ++i) {
    s.slope[kSlopes[i]] = e[i];
    for (int j = 0; j < 3; ++j)
      s.second(kSlopes[i], kSlopes[j]) = ((i == j ? 1.0 : 0.0) - e[i] * e[j]) / s.value;
  }
  return s;
}

}  // namespace

BendPlace BendPlace::at_knot(const BeltLaw& law) {
  return {.rule = kAtKnot,
          .share = kKnotShare,
          .tilt = 1.0,
          .tilt_twist = -1.0 / (law.R * law.s0),
          .s0 = law.s0,
          .between = false};
}

BendPlace BendPlace::middle(const BeltLaw& law) {
  return {.rule = kBetween,
          .share = 1.0 - kKnotShare,
          .tilt = law.tilt_between,
          .tilt_twist = law.tilt_twist / (law.L0 * law.L0),
          .s0 = law.s0_between,
          .between = true};
}

BendVector bend_forms(const BendRule& rule, const RimRows& rows, int k) {
  const double *x = rows.row(RimRows::kX), *y = rows.row(RimRows::kY), *z = rows.row(RimRows::kZ),
               *psi = rows.row(RimRows::kTorsion);
  const auto sum = [k](const double* row, const double(&w)[4]) {
    return w[0] * row[k - 1] + w[1] * row[k] + w[2] * row[k + 1] + w[3] * row[k + 2];
  };
  BendVector forms;
  forms << sum(x, rule.slope), sum(z, rule.slope), sum(x, rule.second), sum(z, rule.second),
      sum(y, rule.slope), sum(y, rule.second), sum(psi, rule.slope), sum(psi, rule.place);
  return forms;
}

Strains::Strains(const BendPlace& place, const BendVector& z)
    : bend(bend_of(z)),
      lateral(times_form(bend, -place.tilt, z[kTorsion], kTorsion)),
      twist(times_form(bend, place.tilt_twist, z[kSlopeY], kSlopeY)),
      length(length_of(z)) {
  lateral.value += z[kBendY];
  lateral.slope[kBendY] += 1.0;
  twist.value += z[kTwist];
  twist.slope[kTwist] += 1.0;
}

Matrix4d on_nodes(const BendRule& rule, const BendMatrix& M, int i, int j) {
  constexpr BendForm kFirst[4] = {kSlopeX, kSlopeY, kSlopeZ, kTwist},
                     kSecond[4] = {kBendX, kBendY, kBendZ, kTorsion};
  const auto second = [&](int node, int entry) {
    return entry < 3 ? rule.second[node] : rule.place[node];
  };
  Matrix4d block;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      block(r, c) =
          rule.slope[i] *
              (rule.slope[j] * M(kFirst[r], kFirst[c]) + second(j, c) * M(kFirst[r], kSecond[c])) +
          second(i, r) *
              (rule.slope[j] * M(kSecond[r], kFirst[c]) + second(j, c) * M(kSecond[r], kSecond[c]));
  return block;
}

}  // namespace latsch::ring_tire
