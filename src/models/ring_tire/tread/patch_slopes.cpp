// SPDX-License-Identifier: Apache-2.0
// Derivatives of the blocks' forces by differences, patch by patch: the forces of a patch depend on
// sixteen numbers only, or six more if sections bend, and are piecewise nearly quadratic in each.
// Central differences are used with steps as short as rounding allows (1e-13 m at a kilometer from
// the origin), because kinks within a step are averaged.
#include <algorithm>

#include "models/ring_tire/tread/touching_blocks.h"

namespace latsch::ring_tire {
namespace {

constexpr double kShift = 2e-8;  // m
constexpr double kTurn = 2e-7;   // rad, of a section: about kShift at its edge

}  // namespace

/// The blocks of a patch, with memory separate from that of the step.
struct RingTreadContact::ProbedPatch {
  /// Forces on the nodes and the sections, and the moment on the rim.
  using Forces = Eigen::Vector<double, PatchSlopes::kAll + 3>;

  RingTreadContact& tread;
  std::size_t patch;
  BlockStep step;
  Eigen::Matrix4d place, rate;  // position and rate of the four nodes
  std::vector<double> columns = {}, kept = {};

  /// Returns the forces at the present positions and rates.
  Forces forces(bool bends) {
    Forces to = Forces::Zero();
    for (int m = 0; m < 4; ++m) {
      step.at.nodes[m] = place.col(m).data();
      step.at.rates[m] = rate.col(m).data();
      step.force[m] = to.data() + 4 * m;
    }
    step.moment = to.data() + PatchSlopes::kAll;
    tread.add_patch_force(patch, step);
    if (bends) to.segment<2 * SectionBending::kModes>(PatchSlopes::kNodes) = on_sections();
    return to;
  }

  /// Returns section_forces() for this patch.
  Eigen::Vector<double, 2 * SectionBending::kModes> on_sections() {
    using Modes = Eigen::Vector<double, SectionBending::kModes>;
    columns.resize(static_cast<std::size_t>(9 * tread.stride_));
    station_columns(step.at, columns.data());
    const bool level = tread.patches_[patch].level;
    const BlockGround ground = tread.ground(patch);
    Modes here = Modes::Zero(), next = Modes::Zero();
    for (int line = 0; line < tread.lines_; ++line)
      for (int j = step.at.begin; j < std::min(step.at.end, tread.blocks_); ++j) {
        const int block = line * tread.stride_ + j;
        const double Fn = step.results.Fn[block];
        if (!(Fn > 0.0)) continue;
        double along = 0.0;  // F . G
        for (int i = 0; i < 3; ++i) {
          const double N = level ? (i == 2 ? 1.0 : 0.0) : ground.N[i][block];
          const double F = level && i == 2 ? 0.0 : step.results.F[i][block];
          along += (Fn * N + F) * columns[static_cast<std::size_t>((kG + i) * tread.stride_ + j)];
        }
        const Modes& shape = tread.line_shapes_[static_cast<std::size_t>(line)];
        const double share = tread.share_[static_cast<std::size_t>(j)];
        here += (1.0 - share) * along * shape;
        next += share * along * shape;
      }
    Eigen::Vector<double, 2 * SectionBending::kModes> both;
    both << here, next;
    return both;
  }

  /// Increases γ of a mode at one of the two nodes.
  void bend(int end, int mode, double by) {
    double* rise = &tread.section_rise_[2 * static_cast<std::size_t>(tread.patches_[patch].segment *
                                                                     tread.lines_)];
    for (const Eigen::Vector3d& shape : tread.line_shapes_) {
      rise[end] += by * shape[mode];
      rise += 2;
    }
  }
};

std::vector<PatchSlopes> RingTreadContact::patch_slopes(const SectionBending& section,
                                                        const NodeValues& q,
                                                        const NodeValues& v) {
  std::vector<PatchSlopes> slopes;
  slopes.reserve(patches_.size());
  std::vector<double> aside(kColumns * none_.size());
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const double* const Fn = column(i, kFn);
    bool touches = false;
    for (int line = 0; line < lines_; ++line)
      touches = touches || std::any_of(Fn + line * stride_ + patches_[i].begin,
                                       Fn + line * stride_ + patches_[i].end,
                                       [](double F) { return F > 0.0; });
    if (!touches) continue;
    ProbedPatch probe{*this, i, step_of(i, q, v), {}, {}};
    const auto apart = [&](int c) {
      return aside.data() + static_cast<std::size_t>(c) * none_.size();
    };
    probe.step.results = {.F = {apart(kF), apart(kF + 1), apart(kF + 2)},
                          .Fn = apart(kFn),
                          .gripped = apart(kGripped),
                          .share = apart(kShare),
                          .slope = bottom_ > 0.0 ? apart(kSlope) : nullptr,
                          .tip = {apart(kTip), apart(kTip + 1), apart(kTip + 2)}};
    PatchSlopes& of = slopes.emplace_back();
    for (int m = 0; m < 4; ++m) {
      of.nodes[m] = node(patches_[i].segment, m);
      probe.place.col(m) = q.col(of.nodes[m]);
      probe.rate.col(m) = v.col(of.nodes[m]);
    }
    const bool bends = section.on();
    const auto find = [&](int entry, double by, const auto& move) {
      move(by);
      const auto more = probe.forces(bends);
      move(-2.0 * by);
      const auto less = probe.forces(bends);
      move(by);
      const ProbedPatch::Forces slope = (more - less) / (2.0 * by);
      of.forces.col(entry) = slope.head<PatchSlopes::kAll>();
      of.moment_on_rim.col(entry) = slope.tail<3>();
    };
    for (int entry = 0; entry < PatchSlopes::kNodes; ++entry) {
      const Eigen::Matrix4d place = probe.place, rate = probe.rate;
      find(entry, entry % 4 == 3 ? kTurn : kShift, [&](double by) {
        probe.place.data()[entry] += by;
        probe.rate.data()[entry] += rule_.velocity * by;
      });
      probe.place = place;
      probe.rate = rate;
    }
    if (!bends) continue;
    for (int entry = 0; entry < 2 * SectionBending::kModes; ++entry)
      find(PatchSlopes::kNodes + entry, kShift, [&](double by) {
        probe.bend(entry / SectionBending::kModes, entry % SectionBending::kModes, by);
      });
  }
  return slopes;
}

}  // namespace latsch::ring_tire
