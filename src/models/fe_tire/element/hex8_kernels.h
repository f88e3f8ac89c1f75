// SPDX-License-Identifier: Apache-2.0
// Evaluates one register of elements completely: laws, pressure, and the rotation into the next
// sector's frame.
#include "models/fe_tire/element/hex8_full_integration_kernel.h"
#include "models/fe_tire/element/pressure_kernel.h"

namespace latsch::fe_tire::LATSCH_KERNELS {

LATSCH_INLINE void turn_pair(const ElementSurroundings& around, V& x, V& z) {
  const V c = around.cosine, s = around.sine;
  const V turned_x = c * x - s * z;
  z = s * x + c * z;
  x = turned_x;
}

/// Rotates the forces on the nodes `around.turned` by Q^T.
LATSCH_INLINE void turn_forces(const ElementSurroundings& around, NodalSums& sums) {
  for (int a = 0; a < 8; ++a) {
    if (around.turned >> a & 1) turn_pair(around, sums.f[3 * a], sums.f[3 * a + 2]);
  }
}

/// Rotates the stiffness entries of the nodes `around.turned`.
void turn_stiffness(const ElementSurroundings& around, NodalSums& sums) {
  const auto at = [&](int row, int column) -> V& {
    return sums
        .K[row >= column ? ElementBatch::entry(row, column) : ElementBatch::entry(column, row)];
  };
  const auto turn = [&](V& x, V& z) { turn_pair(around, x, z); };
  for (int a = 0; a < 8; ++a) {
    if (!(around.turned >> a & 1)) continue;
    const int x = 3 * a, z = 3 * a + 2;
    for (int column = 0; column < 24; ++column) {
      if (column != x && column != z) turn(at(x, column), at(z, column));
    }
    V xx = at(x, x), xz = at(z, x), zx = xz, zz = at(z, z);
    turn(xx, zx);
    turn(xz, zz);
    turn(xx, xz);
    turn(zx, zz);
    at(x, x) = xx;
    at(z, x) = xz;
    at(z, z) = zz;
  }
}

/// Complex factors that give the forces on both ends of an arc, in the frames of the nodes, from
/// those in the prism: f[k] = sum_j of_end[k][j] f~[j], for x + i z. They contain the transposed
/// map (R.1) of hex8_shape.cpp and the rotation of the nodes in the next sector.
struct ArcForces {
  double of_end[2][2][2];  // [end][end in the prism][real, imaginary]
};

LATSCH_INLINE ArcForces arc_forces(const ArcMap& map, const ElementSurroundings& around) {
  ArcForces forces;
  for (int k = 0; k < 2; ++k) {
    const bool turned = around.turned >> kArcEnds[0][k] & 1;
    const double c = turned ? around.cosine : 1.0, s = turned ? around.sine : 0.0;
    for (int j = 0; j < 2; ++j) {
      const double re = j == k ? map.own[k][0] : map.other[j][0];
      const double im = j == k ? -map.own[k][1] : -map.other[j][1];
      forces.of_end[k][j][0] = c * re - s * im;
      forces.of_end[k][j][1] = c * im + s * re;
    }
  }
  return forces;
}

/// Replaces the components v[0] + i v[1] at the first end and v[2] + i v[3] at the second end.
LATSCH_INLINE void leave_prism(const ArcForces& forces, V* const (&v)[4]) {
  V result[4];
  for (int k = 0; k < 2; ++k) {
    const auto& from = forces.of_end[k];
    result[2 * k] =
        from[0][0] * *v[0] - from[0][1] * *v[1] + (from[1][0] * *v[2] - from[1][1] * *v[3]);
    result[2 * k + 1] =
        from[0][1] * *v[0] + from[0][0] * *v[1] + (from[1][1] * *v[2] + from[1][0] * *v[3]);
  }
  for (int n = 0; n < 4; ++n) *v[n] = result[n];
}

/// Converts the forces in the prism of an arc to those on the nodes in their frames.
LATSCH_INLINE void leave_prism(const ArcForces& forces, NodalSums& sums) {
  for (const auto& [a, b] : kArcEnds) {
    leave_prism(forces, {&sums.f[3 * a], &sums.f[3 * a + 2], &sums.f[3 * b], &sums.f[3 * b + 2]});
  }
}

/// Converts the stiffness in the prism of an arc to that between the nodes in their frames.
void stiffness_leaves_prism(const ArcForces& forces, NodalSums& sums) {
  const auto at = [&](int row, int column) -> V& {
    return sums
        .K[row >= column ? ElementBatch::entry(row, column) : ElementBatch::entry(column, row)];
  };
  for (const auto& [a, b] : kArcEnds) {
    const int rows[4] = {3 * a, 3 * a + 2, 3 * b, 3 * b + 2};
    for (int column = 0; column < 24; ++column) {
      if (std::find(rows, rows + 4, column) != rows + 4) continue;
      leave_prism(
          forces,
          {&at(rows[0], column), &at(rows[1], column), &at(rows[2], column), &at(rows[3], column)});
    }
    V block[4][4];
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) block[i][j] = at(rows[i], rows[j]);
    }
    for (int j = 0; j < 4; ++j)
      leave_prism(forces, {&block[0][j], &block[1][j], &block[2][j], &block[3][j]});
    for (auto& row : block) leave_prism(forces, {&row[0], &row[1], &row[2], &row[3]});
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j <= i; ++j) at(rows[i], rows[j]) = block[i][j];
    }
  }
}

/// Expresses the forces on an element in the frames of its nodes.
LATSCH_INLINE void forces_to_frames(const ArcMap& map,
                                    const ElementSurroundings& around,
                                    NodalSums& sums) {
  if (map.is_arc) {
    leave_prism(arc_forces(map, around), sums);
  } else if (around.turned != 0) {
    turn_forces(around, sums);
  }
}

/// Expresses the stiffness of an element in the frames of its nodes.
LATSCH_INLINE void stiffness_to_frames(const ArcMap& map,
                                       const ElementSurroundings& around,
                                       NodalSums& sums) {
  if (map.is_arc) {
    stiffness_leaves_prism(arc_forces(map, around), sums);
  } else if (around.turned != 0) {
    turn_stiffness(around, sums);
  }
}

/// State of a solid-shell element, from which its stiffness is computed.
template <class V>
struct ElementState {
  SolidShellState<V> shell;
  CordsOf<V> cords;

  explicit ElementState(const ElementLaw& law) : cords(law.cords) {}
};

/// Rounds the lanes of a register to single precision and stores them in lanes `first` ... of the
/// batch's state.
LATSCH_INLINE void round(const ElementState<V>& from, int first, ElementState<F>& to) {
  round(from.shell, first, to.shell);
  for (int k = 0; k < from.cords.count(); ++k) {
    round(from.cords.sheets[k], first, to.cords.sheets[k]);
  }
}

/// Computes the stiffness between nodes, pressure included, from the stiffness between modal
/// vectors.
void finish_stiffness(const ElementLaw& law,
                      const ElementSurroundings& around,
                      const ModalSums& modal,
                      int first,
                      ElementBatch& batch) {
  NodalSums sums;
  stiffness_to_nodes(modal, sums);
  if (around.pressure != 0.0) {
    const double* X = law.shape->X.data();
    V x[24];
    for (int k = 0; k < 24; ++k) x[k] = load(batch.u[k] + first) + X[k];
    for (V& f : sums.f) f = 0.0;
    add_pressure(X, x, {around.open_edges, law.shape->arc.is_arc}, around.pressure, true, sums);
  }
  stiffness_to_frames(law.shape->arc, around, sums);
  for (int n = 0; n < ElementBatch::kEntries; ++n) sums.K[n].save(batch.K[n] + first);
}

/// Adds the stiffness of the solid and of the cords.
template <class V>
LATSCH_INLINE void sum_stiffness(const Operators<V>& operators,
                                 const ElementState<V>& state,
                                 ModalSumsOf<V>& modal) {
  modal.set_zero(true);
  const SolidShellState<V>& shell = state.shell;
  add_stiffness<V>(operators, shell.k, shell.inner, shell.t, state.cords, modal);
}

/// Computes the stiffness with sums over modal vectors in single precision. The nodes' entries
/// follow from these sums in double precision, so a translation of the element causes exactly no
/// force. This is necessary because a tire is many thousand times softer than its elements.
void find_rough_stiffness(const ElementLaw& law,
                          const ElementSurroundings& around,
                          const ElementState<F>& state,
                          ElementBatch& batch) {
  ModalSumsOf<F> rough;
  sum_stiffness<F>(law.shape->rough, state, rough);
  const float* const entries = reinterpret_cast<const float*>(rough.K);
  for (int first = 0; first < batch.count; first += V::kWidth) {
    ModalSums modal;
    V* const to = &modal.K[0][0][0];
    for (int k = 0; k < 6 * kModes * kModes; ++k) to[k] = widened(entries + k * F::kWidth + first);
    finish_stiffness(law, around, modal, first, batch);
  }
}

/// Computes the forces and, if exact stiffness is requested, the stiffness. If `rough` is not null,
/// it receives the state from which rough stiffness can be computed.
unsigned evaluate_solid_shell(const ElementLaw& law,
                              const ElementSurroundings& around,
                              int first,
                              ElementBatch& batch,
                              ElementState<F>* rough) {
  const HexShape& shape = *law.shape;
  ElementState<V> state(law);
  V x[24], alpha[kEnhanced];
  for (int k = 0; k < 24; ++k) x[k] = load(batch.u[k] + first) + shape.X.data()[k];
  for (int j = 0; j < kEnhanced; ++j) alpha[j] = load(batch.alpha[j] + first);
  modal_vectors(x, state.shell.k.x);
  follow(state.shell.k.x, state.cords);
  ModalSums modal;
  modal.set_zero(false);
  NodalSums sums;
  const Mask valid =
      add_solid_shell_forces(law, state.shell, state.cords, alpha, modal, {batch.dead, first});
  to_nodes(modal, sums);
  if (around.pressure != 0.0) {
    add_pressure(
        shape.X.data(), x, {around.open_edges, shape.arc.is_arc}, around.pressure, false, sums);
  }
  forces_to_frames(shape.arc, around, sums);
  for (int j = 0; j < kEnhanced; ++j) alpha[j].save(batch.alpha[j] + first);
  for (int n = 0; n < 24; ++n) sums.f[n].save(batch.f[n] + first);
  if (batch.stiffness == Stiffness::exact) {
    sum_stiffness<V>(shape.solid_shell, state, modal);
    finish_stiffness(law, around, modal, first, batch);
  }
  if (rough != nullptr) {
    const int next = first + V::kWidth, end = next < batch.count ? next : ElementBatch::kLanes;
    for (int lane = first; lane < end; lane += V::kWidth) round(state, lane, *rough);
  }
  return lanes_of(valid) << first;
}

unsigned evaluate_comparison(const ElementLaw& law,
                             const ElementSurroundings& around,
                             int first,
                             ElementBatch& batch) {
  const HexShape& shape = *law.shape;
  const bool stiffness = batch.stiffness != Stiffness::none;
  V x[24], modes[kModes][3];
  for (int k = 0; k < 24; ++k) x[k] = load(batch.u[k] + first) + shape.X.data()[k];
  modal_vectors(x, modes);
  Cords cords(law.cords);
  follow(modes, cords);
  stretch(cords, 0.0, 0.0);
  const DeadStresses dead{batch.dead, first};
  if (dead) add_dead(dead, cords);
  ModalSums modal;
  modal.set_zero(stiffness);
  add_forces(cords, modal);
  if (stiffness) add_stiffness<V>(cords, modal, nullptr);
  NodalSums sums;
  to_nodes(modal, sums);
  if (stiffness) stiffness_to_nodes(modal, sums);
  const Mask valid = add_full_integration(law, stiffness, x, sums, dead);
  if (around.pressure != 0.0) {
    add_pressure(shape.X.data(), x, {around.open_edges, false}, around.pressure, stiffness, sums);
  }
  forces_to_frames(shape.arc, around, sums);
  if (stiffness) stiffness_to_frames(shape.arc, around, sums);
  for (int n = 0; n < 24; ++n) sums.f[n].save(batch.f[n] + first);
  for (int n = 0; stiffness && n < ElementBatch::kEntries; ++n) sums.K[n].save(batch.K[n] + first);
  return lanes_of(valid) << first;
}

unsigned evaluate_batch(const ElementLaw& law,
                        const ElementSurroundings& around,
                        ElementBatch& batch) {
  unsigned valid = 0;
  if (law.shape->kind == ElementKind::full_integration) {
    for (int first = 0; first < batch.count; first += V::kWidth) {
      valid |= evaluate_comparison(law, around, first, batch);
    }
    return valid;
  }
  ElementState<F> rough(law);
  const bool is_rough = batch.stiffness == Stiffness::rough;
  for (int first = 0; first < batch.count; first += V::kWidth) {
    valid |= evaluate_solid_shell(law, around, first, batch, is_rough ? &rough : nullptr);
  }
  if (is_rough) find_rough_stiffness(law, around, rough, batch);
  return valid;
}

/// Computes the cord stress S and its derivative dS/de at the strain e.
void cord_at(const CordLayer& layer, double e, double* S, double* tangent) {
  V stress, slope;
  stretch(layer, e, stress, slope);
  double lanes[V::kWidth];
  stress.save(lanes);
  *S = lanes[0];
  slope.save(lanes);
  *tangent = lanes[0];
}

/// Computes the force and the stiffness of the pressure on one face.
void pressure_at(const double* x, double p, double* f, double* K) {
  NodalSums sums;
  for (V& v : sums.f) v = 0.0;
  for (V& v : sums.K) v = 0.0;
  V at[12];
  for (int k = 0; k < 12; ++k) at[k] = x[k];
  add_pressure(x, at, {}, p, true, sums);
  double lanes[V::kWidth];
  for (int k = 0; k < 12; ++k) {
    sums.f[k].save(lanes);
    f[k] = lanes[0];
  }
  for (int k = 0; k < ElementBatch::entry(12, 0); ++k) {
    sums.K[k].save(lanes);
    K[k] = lanes[0];
  }
}

double rubber_at(const Hyperelastic& law, const double* E, double* S, double (*D)[6]) {
  V strain[6], stress[6], tangent[6][6];
  for (int k = 0; k < 6; ++k) strain[k] = E[k];
  const V det = rubber_law::stress(law, strain, stress, tangent);
  double lanes[V::kWidth];
  for (int k = 0; k < 6; ++k) {
    stress[k].save(lanes);
    S[k] = lanes[0];
    for (int l = 0; l < 6; ++l) {
      tangent[k][l].save(lanes);
      D[k][l] = lanes[0];
    }
  }
  det.save(lanes);
  return lanes[0];
}

}  // namespace latsch::fe_tire::LATSCH_KERNELS

#include "models/fe_tire/element/hex8_curvatures_kernel.h"
#include "models/fe_tire/element/hex8_motion_sums_kernel.h"
#include "models/fe_tire/element/relaxing_stresses_kernel.h"
