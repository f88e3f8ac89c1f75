// SPDX-License-Identifier: Apache-2.0
// Iterates over the blocks on the road.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/ring_tire/tread/rubber_law.h"
#include "models/ring_tire/tread/tread_contact.h"

namespace latsch::ring_tire {

/// Mean of δ² over a cell where δ > 0, with its depth running from δ - g to δ + g; the second
/// derivatives of half of it by δ and g; and the mean of ξ (δ + g ξ)_+. For rubber that bottoms out
/// at `bottom` (0: linear), twice its energy replaces δ².
struct CellSquares {
  double mean, first_moment, by_depth, by_both, by_half;

  CellSquares(double depth, double g, double bottom) {
    const double a = std::max(std::abs(g), 1e-12);
    const double share = std::clamp(0.5 * (depth + a) / a, 0.0, 1.0);
    const double square = share * share, cube = 4.0 / 3.0 * square * share;
    mean = a * a * cube + std::max(depth - a, 0.0) * (depth + a);
    first_moment = g * square * (1.0 - 2.0 / 3.0 * share);
    by_depth = share;
    by_both = std::copysign(share - square, g);
    by_half = share - 2.0 * square + cube;
    if (!(bottom > 0.0)) return;
    const BeyondLinear fore(depth + kGauss * g, bottom), aft(depth - kGauss * g, bottom);
    mean += fore.energy + aft.energy;
    first_moment += 0.5 * kGauss * (fore.force - aft.force);
    by_depth += 0.5 * (fore.slope + aft.slope);
    by_both += 0.5 * kGauss * (fore.slope - aft.slope);
    by_half += 0.5 * kGauss * kGauss * (fore.slope + aft.slope);
  }
};

/// State and force of one block of a patch.
struct RingTreadContact::BlockState {
  Eigen::Vector3d normal, F, root, unloaded, tip;
  Eigen::Vector3d G;  // dT by height: motion of the unloaded tip with its height
  double Fn, gripped;
  double share;    // share of its cell on the road
  double stiffer;  // dF_n/dδ over that of linear rubber
  double depth;    // m, of the unloaded tip below the road
  double half;     // m, additional depth of its cell's end
  std::size_t patch;
  int station, line;
};

/// Calls `see` with the state of every block whose road is known, in the order of the patches. q is
/// that of the last add_force.
template <class See>
void RingTreadContact::see_blocks(const NodeValues& q, const See& see) const {
  std::vector<double> columns(static_cast<std::size_t>(9 * stride_));
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const Patch& patch = patches_[i];
    station_columns(stations_of(i, q, q), columns.data());
    for (int line = 0; line < lines_; ++line)
      for (int j = patch.begin; j < std::min(patch.end, blocks_); ++j) {
        const int block = line * stride_ + j;
        const auto at = [&](int c) { return column(i, c)[block]; };
        BlockState state{
            .normal = {at(kNormal), at(kNormal + 1), at(kNormal + 2)},
            .F = {at(kF), at(kF + 1), at(kF + 2)},
            .root = tip(columns.data(), patch.segment, line, j),
            .unloaded = tip(columns.data(), patch.segment, line, j),
            .tip = {at(kTip), at(kTip + 1), at(kTip + 2)},
            .G = {columns[static_cast<std::size_t>(kG * stride_ + j)],
                  columns[static_cast<std::size_t>((kG + 1) * stride_ + j)],
                  columns[static_cast<std::size_t>((kG + 2) * stride_ + j)]},
            .Fn = at(kFn),
            .gripped = at(kGripped),
            .share = at(kShare),
            .stiffer = bottom_ > 0.0 && at(kShare) > 0.0 ? at(kSlope) / at(kShare) : 1.0,
            .depth = 0.0,
            .half = 0.0,
            .patch = i,
            .station = j,
            .line = line};
        if (patch.level) {
          state.normal = Eigen::Vector3d::UnitZ();
          state.F.z() = 0.0;
          state.tip.z() = patch.ground.height;
        } else if (at(kLevel) <= -kNoRoad) {
          continue;
        }
        state.depth =
            (patch.level ? patch.ground.height : at(kLevel)) - state.normal.dot(state.root);
        state.half = -state.normal.dot(half_cell(i, j, q));
        state.root += state.normal * state.normal.dot(state.tip - state.root);
        see(state);
      }
  }
}

/// Calls `see` for the blocks that touch.
template <class See>
void RingTreadContact::see_touching(const NodeValues& q, const See& see) const {
  see_blocks(q, [&](const BlockState& block) {
    if (block.Fn > 0.0) see(block);
  });
}

}  // namespace latsch::ring_tire
