// SPDX-License-Identifier: Apache-2.0
// Rebar layers: a membrane at zeta = const that carries stress along its cords only, 2x2 Gauss
// points,
//   W = t int w(e) dA,   e = (l.l - 1) / 2,   l = a1 g_1 + a2 g_2                               (1)
//   g_1 = x_1 + x_12 eta,  g_2 = x_2 + x_12 xi          (tangents of the layer's bilinear surface)
// where a1, a2 are the cord's components in the undeformed surface, |a1 G_1 + a2 G_2| = 1. The
// angle counts from the xi line toward +eta in the tangent plane. The stretch is the full one. In
// bending in the plane of the layer the product 2 a1 a2 g_1 . g_2 varies along xi and eta as it
// should not, which makes belts of inclined cords too stiff. The solid-shell takes it out:
//   e -= c ((xi - <xi>) x_1 + (eta - <eta>) x_2) . (x_12 - s_1 x_1 - s_2 x_2),  c = a1 a2       (2)
// with X_12 = s_1 X_1 + s_2 X_2 in the undeformed plane: nothing in a constant strain, and
// nothing in the mean over the layer's area, so that patch tests hold.
// All of it is e = (sum W_mn y_m . y_n - 1) / 2 with y = (x_1, x_2, x_12).
// The rubber the cords displace is not subtracted (its modulus is 1e-3 of theirs). No bending, no
// slip.
#include "models/fe_tire/hex8_rebar.h"

#include <Eigen/Geometry>
#include <cmath>

#include "models/fe_tire/cord_law.h"

namespace latsch::fe_tire {
namespace {

constexpr double kXi4[4] = {-1, 1, 1, -1}, kEta4[4] = {-1, -1, 1, 1};

/// The bilinear surface zeta = const of an element.
struct Sheet {
  Lanes n[3];         // y_m = sum_a x_a n_m[a]
  Eigen::Matrix3d Y;  // columns X_1, X_2, X_12
};

Sheet sheet(const Matrix38& X, double zeta) {
  Sheet s;
  s.Y.setZero();
  for (int a = 0; a < 8; ++a) {
    const double h = 0.125 * (1.0 + kZeta[a] * zeta);
    s.n[0][a] = h * kXi[a];
    s.n[1][a] = h * kEta[a];
    s.n[2][a] = h * kXi[a] * kEta[a];
    for (int m = 0; m < 3; ++m) s.Y.col(m) += s.n[m][a] * X.col(a);
  }
  return s;
}

/// Components of the unit vector along the cord, and the area element.
struct Direction {
  double a1, a2, dA;
};

Direction direction(const Eigen::Matrix3d& Y, double xi, double eta, double angle) {
  const Eigen::Vector3d G1 = Y.col(0) + eta * Y.col(2), G2 = Y.col(1) + xi * Y.col(2);
  const double length = G1.norm(), along = G1.dot(G2) / length, dA = G1.cross(G2).norm();
  const double a2 = std::sin(angle) * length / dA;
  return {(std::cos(angle) - a2 * along) / length, a2, dA};
}

struct Point {
  Eigen::Matrix3d W;
  double dA;
};

/// W_mn at the four points, equations (1) and, where asked for, (2).
std::array<Point, 4> points(const Eigen::Matrix3d& Y, double angle, bool assumed) {
  std::array<Point, 4> points;
  double area = 0.0, xi_mean = 0.0, eta_mean = 0.0;
  for (int q = 0; q < 4; ++q) {
    const double xi = kGauss * kXi4[q], eta = kGauss * kEta4[q];
    const Direction d = direction(Y, xi, eta, angle);
    const Eigen::Vector3d v(d.a1, d.a2, d.a1 * eta + d.a2 * xi);
    points[q] = {v * v.transpose(), d.dA};
    area += d.dA;
    xi_mean += d.dA * xi;
    eta_mean += d.dA * eta;
  }
  if (!assumed) return points;
  const Direction center = direction(Y, 0.0, 0.0, angle);
  const double c = center.a1 * center.a2;
  const double m11 = Y.col(0).squaredNorm(), m22 = Y.col(1).squaredNorm(),
               m12 = Y.col(0).dot(Y.col(1));
  const double b1 = Y.col(0).dot(Y.col(2)), b2 = Y.col(1).dot(Y.col(2)),
               det = m11 * m22 - m12 * m12;
  const double s1 = (m22 * b1 - m12 * b2) / det, s2 = (m11 * b2 - m12 * b1) / det;
  for (int q = 0; q < 4; ++q) {
    const double p = c * (kGauss * kXi4[q] - xi_mean / area);
    const double r = c * (kGauss * kEta4[q] - eta_mean / area);
    Eigen::Matrix3d parasitic;
    parasitic << -2.0 * p * s1, -p * s2 - r * s1, p, -p * s2 - r * s1, -2.0 * r * s2, r, p, r, 0.0;
    points[q].W -= parasitic;
  }
  return points;
}

/// A layer's force (y_m's) and stiffness (y_m's, y_n's) summed over its points.
struct LayerSums {
  double f[3][3] = {};        // [m][i]
  double K[3][3][3][3] = {};  // [m][i][n][j]
};

LayerSums sum_points(const std::array<Point, 4>& points,
                     const CordLayer& layer,
                     const Eigen::Matrix3d& y) {
  LayerSums sums;
  const Eigen::Matrix3d metric = y.transpose() * y;
  for (const Point& point : points) {
    const CordStress cord = stress(layer, 0.5 * (point.W.cwiseProduct(metric).sum() - 1.0));
    const double dV = layer.thickness * point.dA;
    const Eigen::Matrix3d b = y * point.W;  // column m: de / dy_m
    for (int m = 0; m < 3; ++m) {
      for (int i = 0; i < 3; ++i) {
        sums.f[m][i] += dV * cord.S * b(i, m);
        for (int n = 0; n < 3; ++n) {
          for (int j = 0; j < 3; ++j) sums.K[m][i][n][j] += dV * cord.tangent * b(i, m) * b(j, n);
          sums.K[m][i][n][i] += dV * cord.S * point.W(m, n);
        }
      }
    }
  }
  return sums;
}

LATSCH_CLONES
void add_to_nodes(const LayerSums& layer, const Lanes* n, bool stiffness, NodalSums& sums) {
  for (int i = 0; i < 3; ++i) {
    for (int m = 0; m < 3; ++m) sums.f[i] += layer.f[m][i] * n[m];
    for (int j = i; stiffness && j < 3; ++j) {
      Lanes t[3] = {};
      for (int m = 0; m < 3; ++m) {
        for (int k = 0; k < 3; ++k) t[m] += layer.K[m][i][k][j] * n[k];
      }
      for (int a = 0; a < 8; ++a)
        sums.K[8 * i + a][j] += n[0][a] * t[0] + n[1][a] * t[1] + n[2][a] * t[2];
    }
  }
}

}  // namespace

void add_rebars(const HexShape& shape,
                const Materials& materials,
                const Element& element,
                const Matrix38& x,
                bool stiffness,
                NodalSums& sums) {
  for (const RebarPlacement& rebar : element.rebars) {
    const CordLayer& layer = materials.layers[rebar.layer];
    const Sheet surface = sheet(shape.X, rebar.zeta);
    Eigen::Matrix3d y = Eigen::Matrix3d::Zero();
    for (int a = 0; a < 8; ++a) {
      for (int m = 0; m < 3; ++m) y.col(m) += surface.n[m][a] * x.col(a);
    }
    const auto at = points(surface.Y, layer.angle, shape.kind == ElementKind::solid_shell);
    add_to_nodes(sum_points(at, layer, y), surface.n, stiffness, sums);
  }
}

Matrix8 rebar_mass(const Matrix38& X,
                   const Materials& materials,
                   const Element& element,
                   double point) {
  Matrix8 M = Matrix8::Zero();
  for (const RebarPlacement& rebar : element.rebars) {
    const CordLayer& layer = materials.layers[rebar.layer];
    const Sheet surface = sheet(X, rebar.zeta);
    for (int q = 0; q < 4; ++q) {
      const double dA = direction(surface.Y, kGauss * kXi4[q], kGauss * kEta4[q], 0.0).dA;
      const Vector8 N = shape_functions(point * kXi4[q], point * kEta4[q], rebar.zeta);
      M.noalias() += layer.density * layer.thickness * dA * N * N.transpose();
    }
  }
  return M;
}

}  // namespace latsch::fe_tire
