// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/standing_modes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include "models/ring_tire/ring/ring_modes.h"
#include "numerics/sparse/lanczos.h"

namespace latsch::ring_tire {
namespace {

using Eigen::MatrixXd;

Eigen::Map<const NodeValues> nodes_of(const double* values, int nodes) {
  return {values, 4, nodes};
}

numerics::EigenPairs<double> lowest(const CyclicBandFactor& factor,
                                    const SectionBending& section,
                                    const CyclicBand& mass,
                                    int nodes,
                                    int count) {
  numerics::EigenProblem<double> problem;
  problem.size = 4 * nodes;
  problem.solve = [&](Eigen::Ref<MatrixXd> X) {
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      NodeValues x = nodes_of(X.col(i).data(), nodes);
      section.solve_free(factor, x);
      X.col(i) = x.reshaped();
    }
  };
  problem.mass = [&](const Eigen::Ref<const MatrixXd>& X, Eigen::Ref<MatrixXd> Y) {
    for (Eigen::Index i = 0; i < X.cols(); ++i)
      Y.col(i) = mass.multiply(nodes_of(X.col(i).data(), nodes)).reshaped();
  };
  return numerics::lanczos(problem, {.count = count, .tolerance = 1e-10});
}

/// Returns the shape at the belt's knots, with components along the local axes e_r, e_t, a of each
/// knot.
NodeValues along_node_axes(const NodeValues& shape, const RingTire& tire) {
  NodeValues along = at_knots(shape);
  const RimFrame& rim = tire.rim();
  const NodeAngles angles(static_cast<int>(shape.cols()));
  for (int k = 0; k < angles.nodes(); ++k) {
    const Eigen::Vector3d u = along.col(k).head<3>();
    along.col(k).head<3>() << angles.radial(rim, k).dot(u), angles.tangential(rim, k).dot(u),
        rim.a.dot(u);
  }
  return along;
}

/// Returns the kinetic energy of the waves with circumferential number n, of the two components in
/// the plane of the rim or of the two out of it.
double energy_in(const NodeValues& shape, const Eigen::Vector4d& mass, int n, bool lateral) {
  const int N = static_cast<int>(shape.cols());
  double sum = 0.0;
  for (int row = lateral ? 2 : 0, last = row + 1; row <= last; ++row) {
    std::complex<double> wave = 0.0;
    for (int k = 0; k < N; ++k)
      wave += shape(row, k) * std::polar(1.0, 2.0 * std::numbers::pi * n * k / N);
    sum += mass[row] * std::norm(wave);
  }
  return (n == 0 || 2 * n == N ? 1.0 : 2.0) * sum / N;
}

void name_by_waves(StandingMode& mode, const Eigen::Vector4d& mass) {
  for (int n = 0; n <= mode.shape.cols() / 2; ++n)
    for (const bool lateral : {false, true}) {
      const double energy = energy_in(mode.shape, mass, n, lateral);
      if (energy <= mode.share) continue;
      mode.share = energy;
      mode.n = n;
      mode.lateral = lateral;
    }
}

/// Returns the phase ('s', 'a' or ' ') of a shape from its overlap with its mirror image in the
/// plane x = 0, in which u_t changes its sign. Node 0 must be the lowest.
char phase_of(const NodeValues& shape, const Eigen::Vector4d& mass) {
  // Smallest overlap at which a shape counts as symmetric or antisymmetric.
  constexpr double kClear = 0.5;
  const int N = static_cast<int>(shape.cols());
  const Eigen::Vector4d mirrored(mass[0], -mass[1], mass[2], mass[3]);
  double overlap = 0.0;
  for (int k = 0; k < N; ++k)
    overlap += (mirrored.array() * shape.col(k).array() * shape.col((N - k) % N).array()).sum();
  return overlap > kClear ? 's' : overlap < -kClear ? 'a' : ' ';
}

bool node_is_lowest(const RimFrame& rim) {
  constexpr double kTurned = 1e-9;
  return std::abs(rim.X.z()) < kTurned && rim.Z.z() > 0.0;
}

}  // namespace

Result<std::vector<StandingMode>> standing_modes(const RingTire& tire, int count) {
  const int N = tire.parameters().nodes;
  assert(count > 0 && count <= N);
  const RingTire::Linearized small = tire.linearized();
  CyclicBandFactor factor(N);
  if (!factor.factorize(small.stiffness))
    return Failure{"the standing ring is not stable: its stiffness is not positive definite"};
  SectionBending section = tire.section();
  if (section.on() && !section.border(factor, small.section_border, small.section_stiffness, 1.0))
    return Failure{
        "the standing ring is not stable with bent sections: its stiffness is not positive "
        "definite"};
  const Eigen::Vector4d mass = tire.knot_mass();
  const auto pairs = lowest(factor, section, small.mass, N, count);
  if (!pairs.converged) return Failure{"the modes of the standing ring were not found"};
  const bool upright = node_is_lowest(tire.rim());
  std::vector<StandingMode> modes;
  for (int i = 0; i < count; ++i) {
    const NodeValues shape = nodes_of(pairs.vectors.col(i).data(), N);
    const auto by = [&](const CyclicBand& A) {
      return (shape.array() * A.multiply(shape).array()).sum();
    };
    StandingMode mode;
    mode.shape = along_node_axes(shape, tire);
    const auto [frequency, damping] =
        damped_mode(pairs.values[i], by(small.damping), by(small.maxwell), small.time_constant);
    mode.frequency = frequency;
    mode.damping = damping;
    name_by_waves(mode, mass);
    if (upright) mode.phase = phase_of(mode.shape, mass);
    mode.order +=
        static_cast<int>(std::count_if(modes.begin(), modes.end(), [&](const StandingMode& lower) {
          return lower.n == mode.n && lower.lateral == mode.lateral && lower.phase == mode.phase;
        }));
    modes.push_back(std::move(mode));
  }
  return modes;
}

}  // namespace latsch::ring_tire
