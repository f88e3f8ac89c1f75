// SPDX-License-Identifier: Apache-2.0
// Computes the solid-shell's strain operators from its coordinates without load, with the symbols
// of hex8_solid_shell_kernel.h.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "models/fe_tire/element/hex8_solid_shell.h"
#include "models/fe_tire/element/hex8_solid_shell_modes.h"

namespace latsch::fe_tire {

Eigen::Matrix<double, 7, 8> solid_shell::modal_matrix() {
  Eigen::Matrix<double, 7, 8> h;
  for (int a = 0; a < 8; ++a) {
    const double x = kXi[a], y = kEta[a], z = kZeta[a];
    h.col(a) << x, y, z, x * y, y * z, x * z, x * y * z;
  }
  return 0.125 * h;
}

namespace {

constexpr int kSquareCount = SolidShellShape::kSquares;
constexpr int kModes = 12 + SolidShellShape::kEnhanced;

using ModeOperator = Eigen::Matrix<double, 6, kModes>;
/// Coefficients e that belong to strains along xi.
constexpr int kAlongXi[] = {3, 5, 6, 8, 11};

using solid_shell::kPairs;
using voigt::kColumn, voigt::kRow;

/// Returns the matrix T of the strain transformation E' = A^T E A in Voigt order.
Matrix6 strain_transform(const Eigen::Matrix3d& A) {
  Matrix6 T;
  for (int p = 0; p < 6; ++p) {
    for (int q = 0; q < 6; ++q) {
      const int i = kRow[p], j = kColumn[p], k = kRow[q], l = kColumn[q];
      const double t = k == l ? A(k, i) * A(k, j) : 0.5 * (A(k, i) * A(l, j) + A(l, i) * A(k, j));
      T(p, q) = (p < 3 ? 1.0 : 2.0) * t;
    }
  }
  return T;
}

/// Returns the convected strains at a point for unit values of e_1 ... e_12 and alpha_1 ...
/// alpha_8.
ModeOperator convected_modes(double xi, double eta, double zeta, const Eigen::Vector3d& L2) {
  ModeOperator Q = ModeOperator::Zero();
  Q.block<1, 3>(0, 0) << eta, zeta, eta * zeta;
  Q.block<1, 3>(1, 3) << xi, zeta, xi * zeta;
  Q.block<1, 3>(2, 6) << xi, eta, xi * eta;
  Q(3, 9) = zeta;
  Q(5, 10) = eta;
  Q(4, 11) = xi;
  Q(0, 12) = L2[0] * xi;
  Q(1, 13) = L2[1] * eta;
  Q.block<1, 6>(2, 14) << zeta, xi * zeta, eta * zeta, xi, eta, xi * eta;
  Q.block<1, 6>(2, 14) *= L2[2];
  return Q;
}

/// Returns the strain in Voigt order with a unit value of n.E.n (if m = n), or with a unit shear
/// angle between m and n.
Vector6 unit_strain(const Eigen::Vector3d& m, const Eigen::Vector3d& n) {
  Vector6 v;
  for (int k = 0; k < 6; ++k) {
    v[k] = k < 3 ? m[k] * n[k] : m[kRow[k]] * n[kColumn[k]] + m[kColumn[k]] * n[kRow[k]];
  }
  return v;
}

/// Returns the operator that multiplies the (engineering) shear angle between the unit vectors m
/// and n by `scale`, in a strain.
Matrix6 scaled_shear(const Eigen::Vector3d& m, const Eigen::Vector3d& n, double scale) {
  // angle: gives 2 m.E.n of a strain; of_unit_angle: strain whose only component is the shear angle
  // 1.
  Vector6 angle, of_unit_angle;
  for (int k = 0; k < 6; ++k) {
    const int i = kRow[k], j = kColumn[k];
    of_unit_angle[k] = i == j ? m[i] * n[i] : m[i] * n[j] + m[j] * n[i];
    angle[k] = (i == j ? 2.0 : 1.0) * of_unit_angle[k];
  }
  return Matrix6::Identity() + (scale - 1.0) * of_unit_angle * angle.transpose();
}

/// Returns the mean over the parent cube of the squares that the convected normal strains contain,
/// in the order of kSquares: E_11 contains those of z_12 and z_13, E_22 those of z_12 and z_23.
Eigen::Matrix<double, 6, kSquareCount> mean_of_squares() {
  constexpr double t = 1.0 / 6.0;  // half of the mean of xi^2
  Eigen::Matrix<double, 6, kSquareCount> W = Eigen::Matrix<double, 6, kSquareCount>::Zero();
  W.row(0) << t, 0.0, t, t, t, 0.0, 0.0;
  W.row(1) << 0.0, t, t, 0.0, 0.0, t, t;
  return W;
}

/// Returns the element's unit vectors along xi, across it, and normal to both (as columns, in the
/// axes of its center), and computes the quantities measured along them.
Eigen::Matrix3d set_axes(SolidShellShape& s, const Eigen::Matrix3d& J0, const Eigen::Matrix3d& R) {
  const Eigen::Vector3d n3 = R.transpose() * J0.col(0).cross(J0.col(1)).normalized();
  const Eigen::Vector3d n1 = R.transpose() * J0.col(0).normalized();
  const Eigen::Vector3d n2 = n3.cross(n1);
  s.d22 = unit_strain(n2, n2);
  s.d33 = unit_strain(n3, n3);
  s.d23 = unit_strain(n2, n3);
  s.d13 = unit_strain(n1, n3);
  s.length = 2.0 * J0.col(1).norm();
  s.thickness = 2.0 * std::abs(n3.dot(R.transpose() * J0.col(2)));
  Eigen::Matrix3d axes;
  axes << n1, n2, n3;
  return axes;
}

}  // namespace

double bending_of_shear(double h, double t) {
  // Largest ratio G t h^2 / 12 D of shear to bending stiffness, with D = E' t^3 / 12 and, for
  // incompressible rubber, E' = E / (1 - nu^2) = 4 G. At a larger ratio the columns are too long
  // for the bend, and a soft wall would fold.
  constexpr double kMost = 1.0;
  return t > 0.0 ? 1.0 / (1.0 + std::min(0.25 * (h / t) * (h / t), kMost)) : 1.0;
}

SolidShellShape make_solid_shell_shape(const Matrix38& X, double wall, bool is_arc) {
  SolidShellShape s = {};
  const Eigen::Matrix<double, 7, 8> h = solid_shell::modal_matrix();
  const Eigen::Matrix3d R = cylindrical_triad(X.rowwise().mean());
  const Eigen::Matrix<double, 3, 7> G = R.transpose() * X * h.transpose();
  const Eigen::Vector3d L2 = G.leftCols<3>().colwise().squaredNorm();

  s.L2[0] = L2[0];
  s.L2[1] = L2[1];

  ModeOperator A[8], mean = ModeOperator::Zero();
  Matrix38 b = Matrix38::Zero();
  double dV[8];
  for (int q = 0; q < 8; ++q) {
    const double xi = kGauss * kXi[q], eta = kGauss * kEta[q], zeta = kGauss * kZeta[q];
    const Matrix38 parent = parent_gradients(xi, eta, zeta);
    const Eigen::Matrix3d J = parent_jacobian(X, xi, eta, zeta, is_arc);
    const Eigen::Matrix3d to_center = J.inverse() * R;
    dV[q] = J.determinant();
    s.volume += dV[q];
    b += dV[q] * to_center.transpose() * parent;
    A[q] = strain_transform(to_center) * convected_modes(xi, eta, zeta, L2);
    mean += dV[q] * A[q];
  }
  b /= s.volume;
  mean /= s.volume;

  Eigen::Matrix<double, 12, 6> H = Eigen::Matrix<double, 12, 6>::Zero();
  for (const auto& [e, m, n] : kPairs) {
    const Eigen::Vector3d g_m = G.col(m), g_n = G.col(n);
    H.row(e) += 2.0 * unit_strain(g_m, g_n).cwiseProduct(
                          (Vector6() << 1.0, 1.0, 1.0, 0.5, 0.5, 0.5).finished());
    s.e0[e] += g_m.dot(g_n);
  }
  // A strain that is constant in cylindrical axes does not vary along the arc.
  for (const int e : kAlongXi) {
    if (is_arc) H.row(e).setZero();
  }
  const Eigen::Matrix3d J0 = X * parent_gradients(0.0, 0.0, 0.0).transpose();
  const Eigen::Matrix3d axes = set_axes(s, J0, R);
  const Matrix6 shear =
      scaled_shear(axes.col(1), axes.col(2), std::sqrt(bending_of_shear(s.length, wall)));
  for (int q = 0; q < 8; ++q) {
    const Vector8 N =
        shape_functions(is_arc ? 0.0 : kGauss * kXi[q], kGauss * kEta[q], kGauss * kZeta[q]);
    const Matrix6 turn = strain_transform(R.transpose() * cylindrical_triad(X * N)) * shear;
    const ModeOperator fluctuation = A[q] - mean;
    Eigen::Matrix<double, 6, SolidShellShape::kColumns, Eigen::RowMajor> P;
    P.leftCols<6>() = turn * (Matrix6::Identity() - fluctuation.leftCols<12>() * H);
    P.middleCols<12>(6) = turn * fluctuation.leftCols<12>();
    P.rightCols<SolidShellShape::kEnhanced>() =
        turn * fluctuation.rightCols<SolidShellShape::kEnhanced>();
    Eigen::Map<decltype(P)>(&s.P[q][0][0]) = P;
  }

  const Eigen::Matrix<double, 4, 8> gamma = h.bottomRows<4>() - G.rightCols<4>().transpose() * b;
  const Eigen::Matrix<double, 6, kSquareCount> w =
      strain_transform(J0.inverse() * R) * mean_of_squares();
  // All products of modal vectors with each other are 1/8 or zero.
  using ModalVectors = Eigen::Matrix<double, SolidShellShape::kModes, 3, Eigen::RowMajor>;
  const ModalVectors modal_b = 8.0 * h * b.transpose();
  Eigen::Map<ModalVectors>(&s.b[0][0]) = modal_b;
  Eigen::Map<ModalVectors>(&s.gamma[0][0]) = 8.0 * h * gamma.topRows<3>().transpose();
  Eigen::Map<ModalVectors>(&s.along[0][0]) = modal_b * axes;
  for (int r = 0; r < 6; ++r) {
    for (int k = 0; k < kSquareCount; ++k) s.w[r][k] = w(r, k);
  }
  return s;
}

SolidShellOperators<float> rounded(const SolidShellOperators<double>& operators) {
  SolidShellOperators<float> result;
  const auto round = [](const auto& from, auto& to) {
    constexpr std::size_t kCount = sizeof from / sizeof(double);
    static_assert(kCount == sizeof to / sizeof(float));
    const double* first = reinterpret_cast<const double*>(&from);
    std::copy_n(first, kCount, reinterpret_cast<float*>(&to));
  };
  round(operators.b, result.b);
  round(operators.gamma, result.gamma);
  round(operators.along, result.along);
  round(operators.w, result.w);
  round(operators.P, result.P);
  return result;
}

Matrix6 layer_stiffness(const Matrix6& D, const SolidShellShape& shape, int layer_rows) {
  if (layer_rows < 1) return D;
  const double D22 = shape.d22.dot(D * shape.d22), D33 = shape.d33.dot(D * shape.d33);
  const double D2233 = shape.d22.dot(D * shape.d33), G23 = shape.d23.dot(D * shape.d23);
  // Stiffness along eta if the thickness can change freely.
  const double bending = D22 - D2233 * D2233 / D33;
  const double slenderness = shape.length / shape.thickness;
  const double parabola = 0.2;                                              // 6/5 - 1
  const double residual = 2.0 * G23 * slenderness * slenderness / bending;  // h^2 / (6 D)
  const double rows = static_cast<double>(layer_rows) * layer_rows;
  const double s13 = 1.0 / (1.0 + parabola / rows);
  const double s23 = 1.0 / (1.0 + (parabola + residual) / rows);
  const auto scale = [](const Vector6& d, double s) -> Matrix6 {
    Vector6 angle = d;  // the shear angle of a strain E is angle . E
    angle.head<3>() *= 2.0;
    return Matrix6::Identity() + (std::sqrt(s) - 1.0) * d * angle.transpose();
  };
  const Matrix6 reduce = scale(shape.d13, s13) * scale(shape.d23, s23);
  return reduce.transpose() * D * reduce;
}

}  // namespace latsch::fe_tire
