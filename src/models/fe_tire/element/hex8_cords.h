// SPDX-License-Identifier: Apache-2.0
// Forces and stiffness of the cord layers inside elements, by equations (1) to (4) of
// hex8_rebar.cpp and the law of cord_law.h. The vectors y of a layer are linear combinations of the
// element's modal vectors x:
//   y_1 = x_1 + zeta x_13,  y_2 = x_2 + zeta x_23,  y_12 = x_12 + zeta x_123
//
// This file is included once per kernel set, by hex8_kernels.h only.
#if defined(LATSCH_FE_TIRE_HEX8_CORDS) == defined(LATSCH_KERNEL_TOGGLE)
#ifdef LATSCH_FE_TIRE_HEX8_CORDS
#undef LATSCH_FE_TIRE_HEX8_CORDS
#else
#define LATSCH_FE_TIRE_HEX8_CORDS
#endif

#include "models/fe_tire/element/hex8_sums.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

/// The two modal vectors of which each vector y of a layer consists.
inline constexpr int kInPlane[3] = {solid_shell::k1, solid_shell::k2, solid_shell::k12};
inline constexpr int kThrough[3] = {solid_shell::k13, solid_shell::k23, solid_shell::k123};

template <class V>
struct CordsOf {
  struct Point {
    V e, S, tangent;  // strain by the displacements; stress and tangent in Pa at the total strain
  };
  struct Sheet {
    V y[3][3];  // [m][i], m
    Point points[4];
  };
  const std::vector<CordSheet>& laws;
  Sheet sheets[ElementLaw::kCordLayers];  // one entry per cord layer

  explicit CordsOf(const std::vector<CordSheet>& given) : laws(given) {}
  int count() const { return static_cast<int>(laws.size()); }
};

using Cords = CordsOf<V>;

/// Computes the vectors y and the strains e of all cord layers from the modal vectors x[m][i].
LATSCH_INLINE void follow(const V (*x)[3], Cords& cords) {
  for (int k = 0; k < cords.count(); ++k) {
    const CordSheet& law = cords.laws[k];
    Cords::Sheet& sheet = cords.sheets[k];
    for (int m = 0; m < 3; ++m) {
      for (int i = 0; i < 3; ++i) sheet.y[m][i] = law.zeta * x[kThrough[m]][i] + x[kInPlane[m]][i];
    }
    const auto& y = sheet.y;
    const V yy[6] = {dot(y[0], y[0]),
                     dot(y[1], y[1]),
                     dot(y[2], y[2]),
                     dot(y[0], y[1]),
                     dot(y[1], y[2]),
                     dot(y[0], y[2])};
    for (int q = 0; q < 4; ++q) {
      const auto& W = law.points[q].W;
      const V mixed = W[0][1] * yy[3] + (W[1][2] * yy[4] + W[0][2] * yy[5]);
      const V square = 2.0 * mixed + (W[0][0] * yy[0] + (W[1][1] * yy[1] + W[2][2] * yy[2]));
      sheet.points[q].e = 0.5 * (square - 1.0);
    }
  }
}

/// Evaluates the cord law: stress S and tangent dS/de at the strain e.
LATSCH_INLINE void stretch(const CordLayer& layer, const V& e, V& S, V& tangent) {
  constexpr double w = kCordTransition;
  const double half = 0.5 * (layer.E_tension - layer.E_compression);
  const V root = sqrt(e * e + w * w);
  S = half * (e + (root - w)) + (layer.E_compression * e + layer.pretension);
  tangent = half * (1.0 + e / root) + layer.E_compression;
}

/// Computes the stresses of all cords for the enhanced strain parameters alpha_0 and alpha_1.
LATSCH_INLINE void stretch(Cords& cords, const V& alpha_0, const V& alpha_1) {
  for (int k = 0; k < cords.count(); ++k) {
    const CordSheet& law = cords.laws[k];
    for (int q = 0; q < 4; ++q) {
      Cords::Point& point = cords.sheets[k].points[q];
      const double* p = law.points[q].p;
      const V e = p[0] * alpha_0 + (p[1] * alpha_1 + point.e);
      stretch(law.layer, e, point.S, point.tangent);
    }
  }
}

/// Computes the derivative de / dy_m of the strain at a point.
template <class V>
LATSCH_INLINE void strain_operator(const CordSheet::Point& law, const V (*y)[3], V (*b)[3]) {
  for (int m = 0; m < 3; ++m) {
    for (int i = 0; i < 3; ++i) {
      b[m][i] = law.W[m][0] * y[0][i] + (law.W[m][1] * y[1][i] + law.W[m][2] * y[2][i]);
    }
  }
}

void add_forces(const Cords& cords, ModalSums& sums) {
  for (int k = 0; k < cords.count(); ++k) {
    const CordSheet& law = cords.laws[k];
    const Cords::Sheet& sheet = cords.sheets[k];
    V f[3][3];
    for (V& v : std::span(&f[0][0], 9)) v = 0.0;
    for (int q = 0; q < 4; ++q) {
      V b[3][3];
      strain_operator<V>(law.points[q], sheet.y, b);
      const V S = law.points[q].dV * sheet.points[q].S;
      for (int m = 0; m < 3; ++m) {
        for (int i = 0; i < 3; ++i) f[m][i] += S * b[m][i];
      }
    }
    for (int m = 0; m < 3; ++m) {
      for (int i = 0; i < 3; ++i) {
        sums.f[i][kInPlane[m]] += f[m][i];
        sums.f[i][kThrough[m]] += law.zeta * f[m][i];
      }
    }
  }
}

/// Adds the stiffness of a layer between y_m and y_n, in the directions (i, j), to the stiffness
/// between modal vectors.
template <class V>
LATSCH_INLINE void add_pair(const V& k, double zeta, int m, int n, bool whole, V (*K)[kModes]) {
  const V k_zeta = zeta * k;
  const auto add = [&](int row, int column, const V& value) {
    if (whole || column >= row) {
      K[row][column] += value;
    }
  };
  add(kInPlane[m], kInPlane[n], k);
  add(kInPlane[m], kThrough[n], k_zeta);
  add(kThrough[m], kInPlane[n], k_zeta);
  add(kThrough[m], kThrough[n], zeta * k_zeta);
}

/// Adds the stiffness of the cords. If `coupling` [alpha][direction][modal vector] is not null, the
/// stiffness between alpha_0, alpha_1 and the displacements is added to it.
template <class V>
void add_stiffness(const CordsOf<V>& cords, ModalSumsOf<V>& sums, V (*coupling)[3][kModes]) {
  for (int k = 0; k < cords.count(); ++k) {
    const CordSheet& law = cords.laws[k];
    const typename CordsOf<V>::Sheet& sheet = cords.sheets[k];
    V b[4][3][3], kb[4][3][3], stress[3][3];
    for (V& v : std::span(&stress[0][0], 9)) v = 0.0;
    for (int q = 0; q < 4; ++q) {
      const CordSheet::Point& point = law.points[q];
      strain_operator<V>(point, sheet.y, b[q]);
      const V tangent = point.dV * sheet.points[q].tangent, S = point.dV * sheet.points[q].S;
      for (int m = 0; m < 3; ++m) {
        for (int i = 0; i < 3; ++i) kb[q][m][i] = tangent * b[q][m][i];
        for (int n = 0; n < 3; ++n) stress[m][n] += S * point.W[m][n];
      }
    }
    for (int block = 0; block < 6; ++block) {
      const int i = voigt::kRow[block], j = voigt::kColumn[block];
      for (int m = 0; m < 3; ++m) {
        for (int n = 0; n < 3; ++n) {
          V sum = i == j ? stress[m][n] : V(0.0);
          for (int q = 0; q < 4; ++q) sum += b[q][m][i] * kb[q][n][j];
          add_pair(sum, law.zeta, m, n, i != j, sums.K[block]);
        }
      }
    }
    if (coupling == nullptr) continue;
    for (int l = 0; l < 2; ++l) {
      for (int m = 0; m < 3; ++m) {
        for (int i = 0; i < 3; ++i) {
          V sum = 0.0;
          for (int q = 0; q < 4; ++q) sum += law.points[q].p[l] * kb[q][m][i];
          coupling[l][i][kInPlane[m]] += sum;
          coupling[l][i][kThrough[m]] += law.zeta * sum;
        }
      }
    }
  }
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS
#endif
