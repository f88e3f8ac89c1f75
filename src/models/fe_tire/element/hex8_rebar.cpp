// SPDX-License-Identifier: Apache-2.0
// Rebar layers: a membrane at zeta = const that carries stress only along its cords, with 2x2 Gauss
// points,
//   W = t int w(e) dA,   e = (l.l - 1) / 2,   l = a1 g_1 + a2 g_2                               (1)
//   g_1 = x_1 + x_12 eta,  g_2 = x_2 + x_12 xi          (tangents of the layer's bilinear surface)
// where a1, a2 are the cord's components in the undeformed surface, |a1 G_1 + a2 G_2| = 1. The
// angle of the cord is measured in the tangent plane, from the circumferential direction at the
// point (of the true circle, not of the chord: cords of 90 degrees are radial and have no torsion)
// toward +eta. The strain e is that of the full stretch of the cord. In bending in the plane of the
// layer the product 2 a1 a2 g_1 . g_2 varies along xi and eta although it should not, which makes
// belts of inclined cords too stiff. The solid-shell removes this variation:
//   e -= c ((xi - <xi>) x_1 + (eta - <eta>) x_2) . (x_12 - s_1 x_1 - s_2 x_2),  c = a1 a2       (2)
// with X_12 = s_1 X_1 + s_2 X_2 in the undeformed plane. The correction vanishes in a constant
// strain and in the mean over the layer's area, so that patch tests hold. The square of the
// hourglass vector is removed together with the shear,
//   e -= (a1 eta + a2 xi)^2 z . z / 2,  z = x_12 - s_1 x_1 - s_2 x_2                           (3)
// Edges that lean alternately to both sides count as unsheared. The square alone would let such
// edges shorten cords in compression (as in a carcass below belts, which become narrower as they
// grow), and only E_11 of long elements would resist. They would buckle alternately at a force of
// the order of E t (b/L)^2, with t the thickness of the rubber that moves along. In a warped
// surface z . z does not vanish without load; there e is scaled so that the strain without load is
// zero. All terms together are e = (sum W_mn y_m . y_n - 1) / 2 with y = (x_1, x_2, x_12). Crossed
// plies of angle +-a require E_22 = -cot(a)^2 E_11 (six times, at 24 degrees). If E_11 varies along
// eta, the displacements cannot follow; the solid's enhanced strains can, so they are added to the
// cords' strain,
//   e += a1^2 L_1^2 (xi - <xi>) alpha_0 + a2^2 L_2^2 (eta - <eta>) alpha_1                      (4)
// and take part in the equilibrium of alpha. The stiffness of the rubber that the cords replace is
// not subtracted (its modulus is 1e-3 of theirs). Bending and slip of cords are neglected.
#include "models/fe_tire/element/hex8_rebar.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "models/fe_tire/element/element_law.h"

namespace latsch::fe_tire {
namespace {

// Smallest length of the circumferential direction's projection on the layer. If the layer is at
// right angles to this direction, angles are counted from the xi line instead.
constexpr double kLeastProjection = 1e-3;

/// Bilinear surface of the cord layer in the element without load.
struct Surface {
  Eigen::Vector3d X0;
  Eigen::Matrix3d Y;  // columns X_1, X_2, X_12
  bool is_arc;        // true: surface in the prism of an arc (hex8_shape.cpp)

  Eigen::Vector3d position(double xi, double eta) const {
    return X0 + Y * Eigen::Vector3d(xi, eta, xi * eta);
  }
};

/// Components of the unit vector along the cord, and the area element at a point.
struct Direction {
  double a1, a2, dA;
};

Direction direction(const Surface& surface, double xi, double eta, double angle) {
  const auto& Y = surface.Y;
  const Eigen::Vector3d G1 = Y.col(0) + eta * Y.col(2), G2 = Y.col(1) + xi * Y.col(2);
  const Eigen::Vector3d normal = G1.cross(G2);
  const double dA = normal.norm();
  const Eigen::Vector3d n = normal / dA;
  Eigen::Vector3d t = cylindrical_triad(surface.position(xi, eta)).col(1);
  t -= n.dot(t) * n;
  if (t.norm() < kLeastProjection) t = G1;
  t.normalize();
  if (t.dot(G1) < 0.0) t = -t;
  const Eigen::Vector3d d = std::cos(angle) * t + std::sin(angle) * n.cross(t);
  return {d.cross(G2).dot(n) / dA, G1.cross(d).dot(n) / dA, dA};
}

Surface surface_at(const HexShape& shape, double zeta) {
  const Matrix38& X = shape.X;
  Surface surface{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), shape.arc.is_arc};
  for (int a = 0; a < 8; ++a) {
    const double h = 0.125 * (1.0 + kZeta[a] * zeta);
    surface.X0 += h * X.col(a);
    surface.Y.col(0) += h * kXi[a] * X.col(a);
    surface.Y.col(1) += h * kEta[a] * X.col(a);
    surface.Y.col(2) += h * kXi[a] * kEta[a] * X.col(a);
  }
  return surface;
}

/// Evaluates equation (1): W and dA (stored in dV) at the four points. Returns the mean of (xi,
/// eta) over the area. Along an arc, tangents are those at xi = 0; only the strain across the arc,
/// g_2 . g_2, varies along it, by twice the product y_2 . y_12.
Eigen::Vector2d set_points(const Surface& surface, double angle, CordSheet::Point* points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double area = 0.0;
  for (int q = 0; q < 4; ++q) {
    const double xi = kGauss * kXi[q], eta = kGauss * kEta[q];
    const double at = surface.is_arc ? 0.0 : xi;
    const Direction d = direction(surface, at, eta, angle);
    const double v[3] = {d.a1, d.a2, d.a1 * eta + d.a2 * at};
    for (int m = 0; m < 3; ++m) {
      for (int n = 0; n < 3; ++n) points[q].W[m][n] = v[m] * v[n];
    }
    if (surface.is_arc) points[q].W[1][2] = points[q].W[2][1] += d.a2 * d.a2 * xi;
    points[q].p[0] = points[q].p[1] = 0.0;
    points[q].dV = d.dA;
    area += d.dA;
    mean += d.dA * Eigen::Vector2d(xi, eta);
  }
  return mean / area;
}

/// Adds the corrections (2) to (4) to the strain of the cords.
void assume(const Surface& surface,
            double angle,
            const Eigen::Vector2d& mean,
            const SolidShellShape& shape,
            CordSheet::Point* points) {
  const Direction center = direction(surface, 0.0, 0.0, angle);
  const Eigen::Matrix3d& Y = surface.Y;
  const Eigen::Matrix2d metric = Y.leftCols<2>().transpose() * Y.leftCols<2>();
  const Eigen::Vector2d s = metric.inverse() * Y.leftCols<2>().transpose() * Y.col(2);
  for (int q = 0; q < 4; ++q) {
    const double xi = kGauss * kXi[q] - mean[0], eta = kGauss * kEta[q] - mean[1];
    const double p = surface.is_arc ? 0.0 : center.a1 * center.a2 * xi;
    const double r = center.a1 * center.a2 * eta;
    auto& W = points[q].W;
    const double square = W[2][2], z[3] = {-s[0], -s[1], 1.0};
    for (int m = 0; m < 3; ++m) {
      for (int n = 0; n < 3; ++n) W[m][n] -= square * z[m] * z[n];
    }
    W[0][0] += 2.0 * p * s[0];
    W[1][1] += 2.0 * r * s[1];
    W[0][1] += p * s[1] + r * s[0];
    W[1][0] += p * s[1] + r * s[0];
    W[0][2] -= p;
    W[2][0] -= p;
    W[1][2] -= r;
    W[2][1] -= r;
    double undeformed = 0.0;
    for (int m = 0; m < 3; ++m) {
      for (int n = 0; n < 3; ++n) undeformed += W[m][n] * Y.col(m).dot(Y.col(n));
    }
    for (auto& row : W) {
      for (double& value : row) value /= undeformed;
    }
    points[q].p[0] = center.a1 * center.a1 * shape.L2[0] * xi;
    points[q].p[1] = center.a2 * center.a2 * shape.L2[1] * eta;
  }
}

}  // namespace

std::vector<CordSheet> cord_sheets(const HexShape& shape,
                                   const Materials& materials,
                                   const Element& element) {
  std::vector<CordSheet> sheets;
  for (const RebarPlacement& rebar : element.rebars) {
    CordSheet& sheet = sheets.emplace_back();
    sheet.zeta = rebar.zeta;
    sheet.layer = materials.layers[rebar.layer];
    const Surface surface = surface_at(shape, rebar.zeta);
    const Eigen::Vector2d mean = set_points(surface, sheet.layer.angle, sheet.points);
    if (shape.kind == ElementKind::solid_shell) {
      assume(surface, sheet.layer.angle, mean, shape.solid_shell, sheet.points);
    }
    for (CordSheet::Point& point : sheet.points) point.dV *= sheet.layer.thickness;
  }
  return sheets;
}

std::vector<CordMass> cord_masses(const HexShape& shape,
                                  const Materials& materials,
                                  const Element& element) {
  std::vector<CordMass> points;
  for (const RebarPlacement& rebar : element.rebars) {
    const CordLayer& layer = materials.layers[rebar.layer];
    const Surface surface = surface_at(shape, rebar.zeta);
    for (int q = 0; q < 4; ++q) {
      const double xi = surface.is_arc ? 0.0 : kGauss * kXi[q];
      const double dA = direction(surface, xi, kGauss * kEta[q], 0.0).dA;
      points.push_back({q, rebar.zeta, layer.density * layer.thickness * dA});
    }
  }
  return points;
}

Matrix8 rebar_mass(const HexShape& shape,
                   const Materials& materials,
                   const Element& element,
                   double point) {
  Matrix8 M = Matrix8::Zero();
  for (const CordMass& cords : cord_masses(shape, materials, element)) {
    const Vector8 N =
        shape_functions(point * kXi[cords.point], point * kEta[cords.point], cords.zeta);
    M.noalias() += cords.mass * N * N.transpose();
  }
  return M;
}

}  // namespace latsch::fe_tire
