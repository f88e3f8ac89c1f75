// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/element/hex8_batch.h"

#include <algorithm>
#include <span>

#include "models/fe_tire/element/cord_law.h"
#include "models/fe_tire/element/hex8_motions.h"
#include "models/fe_tire/element/hex8_solid_shell_modes.h"
#include "models/fe_tire/element/pressure.h"

#define LATSCH_KERNELS_IN "models/fe_tire/element/hex8_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::fe_tire {
namespace {

template <std::size_t rows>
void copy_lane(const double (&from)[rows][ElementBatch::kLanes],
               int lane,
               double (&to)[rows][ElementBatch::kLanes]) {
  for (std::size_t k = 0; k < rows; ++k) to[k][lane] = from[k][lane];
}

/// Copies the first element to lanes without an element, so that the computation in these lanes
/// cannot fail.
void fill_lanes(ElementBatch& batch) {
  for (int lane = batch.count; lane < ElementBatch::kLanes; ++lane) {
    for (auto& u : batch.u) u[lane] = u[0];
    for (auto& alpha : batch.alpha) alpha[lane] = alpha[0];
  }
}

unsigned evaluate_corners(const ElementLaw& law,
                          const ElementSurroundings& surroundings,
                          ElementBatch& batch) {
  const auto kernel = LATSCH_KERNEL(evaluate_batch);
  fill_lanes(batch);
  const unsigned all = (1u << batch.count) - 1;
  double start[8][ElementBatch::kLanes];
  std::copy_n(&batch.alpha[0][0], 8 * ElementBatch::kLanes, &start[0][0]);
  const unsigned valid = kernel(law, surroundings, batch) & all;
  if (valid == all) return valid;
  // The stored alpha may be a bad starting point for the new displacement, so elements that failed
  // are evaluated again from alpha = 0.
  ElementBatch again = batch;
  std::fill_n(&again.alpha[0][0], 8 * ElementBatch::kLanes, 0.0);
  const unsigned now = kernel(law, surroundings, again) & all & ~valid;
  for (int lane = 0; lane < batch.count; ++lane) {
    if (valid >> lane & 1) continue;
    if (now >> lane & 1) {
      copy_lane(again.alpha, lane, batch.alpha);
      copy_lane(again.f, lane, batch.f);
      if (batch.stiffness != Stiffness::none) copy_lane(again.K, lane, batch.K);
    } else {
      copy_lane(start, lane, batch.alpha);
    }
  }
  return valid | now;
}

/// Computes the positions of tied corners from those of nodes.
void place_corners(const EdgeTie& tie, double (&u)[24][ElementBatch::kLanes]) {
  for (const auto& [lower, upper] : tie.pairs()) {
    for (int i = 0; i < 3; ++i) {
      for (int lane = 0; lane < ElementBatch::kLanes; ++lane) {
        double &a = u[3 * lower + i][lane], &b = u[3 * upper + i][lane];
        const double from = a, way = b - a;
        a = from + tie.lower * way;
        b = from + tie.upper * way;
      }
    }
  }
}

/// Computes the displacements in the prism of an arc from those of the corners, by (R.1) of
/// hex8_shape.cpp.
void place_in_prism(const ArcMap& map, double (&u)[24][ElementBatch::kLanes]) {
  for (const auto& ends : kArcEnds) {
    for (int lane = 0; lane < ElementBatch::kLanes; ++lane) {
      double x[2], z[2];
      for (int k = 0; k < 2; ++k) {
        x[k] = u[3 * ends[k]][lane];
        z[k] = u[3 * ends[k] + 2][lane];
      }
      for (int k = 0; k < 2; ++k) {
        const int l = 1 - k;
        const auto &own = map.own[k], &other = map.other[k];
        u[3 * ends[k]][lane] =
            (own[0] * x[k] - own[1] * z[k]) + (other[0] * x[l] - other[1] * z[l]);
        u[3 * ends[k] + 2][lane] =
            (own[1] * x[k] + own[0] * z[k]) + (other[1] * x[l] + other[0] * z[l]);
      }
    }
  }
}

/// Computes what the kernels take, displacements of corners in the prism, from those of the nodes.
void place_corners(const ElementLaw& law, double (&u)[24][ElementBatch::kLanes]) {
  if (law.tie.eta != 0) place_corners(law.tie, u);
  if (law.shape->arc.is_arc) place_in_prism(law.shape->arc, u);
}

/// Returns true if the kernels take the displacements of an element's nodes as they are.
bool takes_nodes(const ElementLaw& law) { return law.tie.eta == 0 && !law.shape->arc.is_arc; }

/// Converts forces on tied corners to forces on nodes. `at(k)` returns the lanes of component k.
template <class At>
void gather_corners(const EdgeTie& tie, At at) {
  for (const auto& [lower, upper] : tie.pairs()) {
    for (int i = 0; i < 3; ++i) {
      double *a = at(3 * lower + i), *b = at(3 * upper + i);
      for (int lane = 0; lane < ElementBatch::kLanes; ++lane) {
        const double f = a[lane], g = b[lane];
        a[lane] = (1.0 - tie.lower) * f + (1.0 - tie.upper) * g;
        b[lane] = tie.lower * f + tie.upper * g;
      }
    }
  }
}

/// Converts the stiffness matrix K of the corners to that of the nodes, T^T K T.
void gather_corners(const EdgeTie& tie,
                    double (&packed)[ElementBatch::kEntries][ElementBatch::kLanes]) {
  constexpr int kLanes = ElementBatch::kLanes;
  static thread_local double K[24][24][kLanes];
  const auto place = [](int row, int column) {
    return row >= column ? ElementBatch::entry(row, column) : ElementBatch::entry(column, row);
  };
  for (int row = 0; row < 24; ++row) {
    for (int column = 0; column < 24; ++column) {
      std::copy_n(packed[place(row, column)], kLanes, K[row][column]);
    }
  }
  for (int row = 0; row < 24; ++row) gather_corners(tie, [&](int k) { return K[row][k]; });
  for (int column = 0; column < 24; ++column)
    gather_corners(tie, [&](int k) { return K[k][column]; });
  for (int row = 0; row < 24; ++row) {
    for (int column = 0; column <= row; ++column) {
      std::copy_n(K[row][column], kLanes, packed[place(row, column)]);
    }
  }
}

}  // namespace

unsigned evaluate(const ElementLaw& law,
                  const ElementSurroundings& surroundings,
                  Stiffness stiffness,
                  ElementBatch& batch) {
  const bool is_comparison = law.shape->kind == ElementKind::full_integration;
  batch.stiffness = stiffness == Stiffness::rough && is_comparison ? Stiffness::exact : stiffness;
  if (takes_nodes(law)) return evaluate_corners(law, surroundings, batch);
  fill_lanes(batch);
  double nodes[24][ElementBatch::kLanes];
  std::copy_n(&batch.u[0][0], 24 * ElementBatch::kLanes, &nodes[0][0]);
  place_corners(law, batch.u);
  const unsigned valid = evaluate_corners(law, surroundings, batch);
  std::copy_n(&nodes[0][0], 24 * ElementBatch::kLanes, &batch.u[0][0]);
  if (law.tie.eta == 0) return valid;
  gather_corners(law.tie, [&](int k) { return batch.f[k]; });
  if (batch.stiffness != Stiffness::none) gather_corners(law.tie, batch.K);
  return valid;
}

void relaxing_stresses(const ElementLaw& law, ElementBatch& batch, PointStresses& stresses) {
  fill_lanes(batch);
  const auto kernel = LATSCH_KERNEL(find_relaxing_stresses);
  if (takes_nodes(law)) return kernel(law, batch, stresses);
  double nodes[24][ElementBatch::kLanes];
  std::copy_n(&batch.u[0][0], 24 * ElementBatch::kLanes, &nodes[0][0]);
  place_corners(law, batch.u);
  kernel(law, batch, stresses);
  std::copy_n(&nodes[0][0], 24 * ElementBatch::kLanes, &batch.u[0][0]);
}

namespace {

/// Calls `kernel` with the positions and motions of the corners in place of those of the nodes.
template <class Kernel>
auto at_corners(const ElementLaw& law,
                ElementBatch& batch,
                std::span<ElementMotion> motions,
                const Kernel& kernel) {
  fill_lanes(batch);
  if (takes_nodes(law)) return kernel();
  double nodes[24][ElementBatch::kLanes];
  std::copy_n(&batch.u[0][0], 24 * ElementBatch::kLanes, &nodes[0][0]);
  static thread_local std::vector<ElementMotion> of_nodes;
  of_nodes.assign(motions.begin(), motions.end());
  place_corners(law, batch.u);
  for (ElementMotion& motion : motions) {
    place_corners(law, motion.mode);
    place_corners(law, motion.along);
  }
  const auto result = kernel();
  std::copy_n(&nodes[0][0], 24 * ElementBatch::kLanes, &batch.u[0][0]);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    std::copy_n(&of_nodes[i].mode[0][0], 24 * ElementBatch::kLanes, &motions[i].mode[0][0]);
    std::copy_n(&of_nodes[i].along[0][0], 24 * ElementBatch::kLanes, &motions[i].along[0][0]);
  }
  return result;
}

}  // namespace

bool add_curvatures(const ElementLaw& law,
                    const ElementSurroundings& surroundings,
                    ElementBatch& batch,
                    std::span<ElementMotion> motions) {
  const bool done = at_corners(law, batch, motions, [&] {
    return LATSCH_KERNEL(curve_batch)(law, surroundings, batch, motions);
  });
  if (law.tie.eta == 0) return done;
  for (ElementMotion& motion : motions)
    gather_corners(law.tie, [&](int k) { return motion.curvature[k]; });
  return done;
}

bool follow_along(const ElementLaw& law, ElementBatch& batch, std::span<ElementMotion> motions) {
  return at_corners(
      law, batch, motions, [&] { return LATSCH_KERNEL(follow_batch)(law, batch, motions); });
}

void sum_motions(std::span<const VariedElement> varied,
                 unsigned open_edges,
                 ElementBatch& batch,
                 std::span<ElementMotion> motions,
                 double (*sums)[ElementBatch::kLanes]) {
  const auto same_tie = [](const VariedElement& a, const VariedElement& b) {
    return a.law->tie == b.law->tie && a.law->shape->arc == b.law->shape->arc;
  };
  while (!varied.empty()) {  // elements may differ in the tie itself
    std::size_t count = 1;
    while (count < varied.size() && same_tie(varied[count], varied.front())) ++count;
    at_corners(*varied.front().law, batch, motions, [&] {
      LATSCH_KERNEL(sum_motions_batch)(varied.first(count), open_edges, batch, motions, sums);
      return true;
    });
    sums += count * motions.size();
    varied = varied.subspan(count);
  }
}

void ElementBatch::set(int lane,
                       const Matrix38& displacements,
                       const double* enhanced,
                       int alphas) {
  for (int k = 0; k < 24; ++k) u[k][lane] = displacements.data()[k];
  for (int j = 0; j < 8; ++j) alpha[j][lane] = j < alphas ? enhanced[j] : 0.0;
}

void ElementBatch::take(
    int lane, Vector24& force, Matrix24* tangent, double* enhanced, int alphas) const {
  for (int j = 0; j < alphas; ++j) enhanced[j] = alpha[j][lane];
  for (int k = 0; k < 24; ++k) force[k] = f[k][lane];
  if (tangent == nullptr) return;
  for (int row = 0; row < 24; ++row) {
    for (int column = 0; column <= row; ++column) {
      (*tangent)(row, column) = (*tangent)(column, row) = K[entry(row, column)][lane];
    }
  }
}

void add_pressure(const Matrix34& x, double p, Vector12& f, Matrix12* K) {
  double force[12], stiffness[ElementBatch::entry(12, 0)];
  LATSCH_KERNEL(pressure_at)(x.data(), p, force, stiffness);
  f += Vector12::Map(force);
  if (K == nullptr) return;
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column <= row; ++column) {
      const double k = stiffness[ElementBatch::entry(row, column)];
      (*K)(row, column) += k;
      if (row != column) (*K)(column, row) += k;
    }
  }
}

CordStress stress(const CordLayer& layer, double e) {
  CordStress cord;
  LATSCH_KERNEL(cord_at)(layer, e, &cord.S, &cord.tangent);
  return cord;
}

double rubber_stress(const Hyperelastic& law, const double* E, double* S, double (*D)[6]) {
  return LATSCH_KERNEL(rubber_at)(law, E, S, D);
}

}  // namespace latsch::fe_tire
