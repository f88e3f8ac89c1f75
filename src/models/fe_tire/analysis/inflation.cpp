// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/inflation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "models/fe_tire/ring/sector.h"

namespace latsch::fe_tire {
namespace {

constexpr double kTolerance =
    // Relative tolerance of the residual. A small one is cheap on one sector, and all later states
    // start from this one.
    1e-10;
// Relative tolerance at intermediate pressures, which only serve as start of the next step.
constexpr double kOnTheWay = 1e-3;
constexpr double kRoundOff =
    // Relative residual that is still accepted if it no longer falls: stiff walls cause rounding
    // errors of this size. A larger one is a failure.
    1e-7;
constexpr int kRingSteps = 4;
constexpr int kMaxHalvings = 8;
constexpr int kMaxBacktracks = 8;

struct SectorState {
  Eigen::VectorXd x, alpha;
  bool held = true;  // stable: the tangent of the last iteration was positive definite
};

/// Describes where a node, or the middle of an element, is in the unloaded tire, such as "at y = 92
/// mm, r = 231 mm, in column 3 of 16 of the mesh". The columns of elements are counted from the +y
/// bead.
std::string place_in_words(const Mesh& mesh, const Eigen::Vector3d& X) {
  constexpr double kMillimeters = 1e3;
  const double r = std::hypot(X.x(), X.z());
  int columns = 0, nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const Element& element : mesh.elements) {
    if (!element.inner) continue;  // counts one element per column
    ++columns;
    const Eigen::Vector3d middle = mesh.coordinates(element).rowwise().mean();
    const double away = std::hypot(middle.y() - X.y(), std::hypot(middle.x(), middle.z()) - r);
    if (away >= least) continue;
    least = away;
    nearest = columns;
  }
  return fmt::format("at y = {:.0f} mm, r = {:.0f} mm, in column {} of {} of the mesh",
                     kMillimeters * X.y(),
                     kMillimeters * r,
                     nearest,
                     columns);
}

std::string inverted_in_words(const Ring& ring, int element) {
  const Mesh& mesh = ring.mesh();
  const Eigen::Vector3d middle =
      mesh.coordinates(mesh.elements[static_cast<std::size_t>(element)]).rowwise().mean();
  return fmt::format("an element is inverted {}", place_in_words(mesh, middle));
}

/// Describes the position of the largest component of the residual f.
std::string residual_in_words(const Ring& ring, const Eigen::VectorXd& f) {
  Eigen::Index node = 0;
  ring.expand(f).colwise().norm().maxCoeff(&node);
  return fmt::format("the residual, {:.3g} N a sector, is largest {}",
                     f.norm(),
                     place_in_words(ring.mesh(), ring.mesh().X.col(node)));
}

/// Loads of a sector: a pressure, Pa, and a multiple of a linear load (null: no linear load).
struct SectorLoads {
  double pressure = 0.0;
  const LinearLoad* linear = nullptr;
  double factor = 0.0;
};

/// Computes the residual of a sector under these loads, like assemble_sector(). The tangent does
/// not include the linear load.
bool residual_of(const RingElements& elements,
                 const SectorLoads& loads,
                 SectorState& state,
                 Eigen::VectorXd& f,
                 SectorBlocks* tangent,
                 int* worst) {
  if (!assemble_sector(elements, state.x, loads.pressure, state.alpha, f, tangent, worst))
    return false;
  if (!loads.linear) return true;
  const Eigen::MatrixXcd x = state.x.cast<std::complex<double>>();
  Eigen::MatrixXcd W_x(x.rows(), 1);
  loads.linear->W.multiply(x, W_x);
  f -= loads.factor * (loads.linear->w_0 + W_x.col(0).real());
  return true;
}

/// Returns the direction d = K^-1 f, with K the tangent of circumferential number 0. If K is not
/// positive definite, as with taut cords after a poor predictor, it is shifted along its diagonal
/// until it is.
Eigen::VectorXd newton_direction(const SectorBlocks& tangent,
                                 const SectorLoads& loads,
                                 const Eigen::VectorXd& f,
                                 bool& shifted) {
  numerics::BandedHermitian K = tangent.harmonic(0);
  if (loads.linear) K.lower() -= loads.factor * loads.linear->W.lower();
  double shift = 0.0, largest = 0.0;
  for (int i = 0; i < K.size(); ++i) largest = std::max(largest, K(i, i).real());
  numerics::BandedCholesky cholesky;
  while (!cholesky.factorize(K)) {
    const double next = shift == 0.0 ? 1e-5 * largest : 4.0 * shift;
    for (int i = 0; i < K.size(); ++i) K(i, i) += next - shift;
    shift = next;
  }
  shifted = shift > 0.0;
  Eigen::MatrixXcd d = f.cast<std::complex<double>>();
  cholesky.solve(d);
  return d.real();
}

/// Returns the force, N, that rounding of a node's position at the tire's radius causes in the
/// stiffest direction. Smaller residuals mean nothing.
double force_of_rounding(const SectorBlocks& tangent, const Mesh& mesh) {
  const numerics::BandedHermitian K = tangent.harmonic(0);
  double largest = 0.0;
  for (int i = 0; i < K.size(); ++i) largest = std::max(largest, K(i, i).real());
  return std::numeric_limits<double>::epsilon() * mesh.outer_radius() * largest;
}

/// Solves one load step. Afterwards `state` is the equilibrium. A Failure leaves it unchanged.
Status newton(const RingElements& elements,
              const SectorLoads& loads,
              double tolerance,
              double reference,
              int max_iterations,
              SectorState& state) {
  SectorState now = state;
  SectorBlocks tangent(elements.ring());
  Eigen::VectorXd f;
  int worst = 0;
  if (!residual_of(elements, loads, now, f, &tangent, &worst))
    return Failure{inverted_in_words(elements.ring(), worst)};
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const bool stalled = f.norm() <= kRoundOff * reference && f.norm() > 0.5 * last;
    if (f.norm() <= tolerance * reference || stalled) {
      state = now;
      return {};
    }
    last = f.norm();
    bool shifted = false;
    const Eigen::VectorXd d = newton_direction(tangent, loads, f, shifted);
    const double slope = std::abs(d.dot(f)), norm = f.norm();
    double s = 1.0;
    SectorState trial;
    for (int back = 0;; ++back, s *= 0.5) {
      trial = {now.x - s * d, now.alpha, !shifted};
      const bool valid = residual_of(elements, loads, trial, f, &tangent, &worst);
      if (valid && (f.norm() < norm || std::abs(d.dot(f)) < 0.9 * slope)) break;
      if (back == kMaxBacktracks) {
        if (norm <=
            std::max(kRoundOff * reference, force_of_rounding(tangent, elements.ring().mesh()))) {
          state = now;
          return {};
        }
        return Failure{valid
                           ? "the residual does not fall: " + residual_in_words(elements.ring(), f)
                           : inverted_in_words(elements.ring(), worst)};
      }
    }
    now = std::move(trial);
  }
  return Failure{
      fmt::format("after {} iterations {}", max_iterations, residual_in_words(elements.ring(), f))};
}

}  // namespace

void measure_growth(const Mesh& mesh, Inflated& inflated) {
  // Tolerance for distances from the middle plane, as a share of the outer radius: nodes of the
  // tread's two halves count as equally far from it.
  constexpr double kSameDistance = 1e-6;
  const double same = kSameDistance * mesh.outer_radius();
  double nearest = std::numeric_limits<double>::infinity(), outer = 0.0;
  double left = 0.0, right = 0.0;
  inflated.radius = 0.0;
  for (const Element& element : mesh.elements) {
    for (int a = 4; a < 8; ++a) {
      const int node = element.node[a] % mesh.nodes_per_sector();
      const Eigen::Vector3d X = mesh.X.col(node), x = X + inflated.u.col(node);
      left = std::max(left, x.y());
      right = std::min(right, x.y());
      if (!element.tread) continue;
      const double R = std::hypot(X.x(), X.z()), r = std::hypot(x.x(), x.z());
      const double distance = std::abs(X.y());
      if (distance < nearest - same || (distance < nearest + same && R > outer)) {
        nearest = distance;
        outer = R;
        inflated.growth = r - R;
      }
      inflated.radius = std::max(inflated.radius, r);
    }
  }
  inflated.width = left - right;
}

Result<Inflated> inflate_sector(const RingElements& elements,
                                double pressure,
                                const SolverSettings& settings,
                                const Eigen::Matrix3Xd* near) {
  const Ring& ring = elements.ring();
  SectorState state{Eigen::VectorXd::Zero(ring.sector_unknowns()),
                    Eigen::VectorXd::Zero(ring.alphas_per_element() * ring.elements_per_sector())};
  Eigen::VectorXd f, alpha = state.alpha;
  int worst = 0;
  if (!assemble_sector(elements, state.x, pressure, alpha, f, nullptr, &worst)) {
    return Failure{fmt::format("inflation: {} before any load", inverted_in_words(ring, worst))};
  }
  const double reference = f.norm();

  // The whole pressure is tried at once. Cords become taut during Newton's method just as during
  // pressure steps, but half as many iterations are needed. If the result is on another branch of
  // equilibria, its tangent is not positive definite.
  double reached = 0.0, step = pressure;
  if (near) {
    SectorState from{ring.compress(*near), state.alpha};
    const Status solved =
        newton(elements, {pressure}, kTolerance, reference, settings.max_iterations, from);
    if (solved.ok() && from.held) {
      state = std::move(from);
      reached = pressure;
    }
  }
  int halvings = 0;
  while (reached != pressure) {
    const double next =
        std::abs(pressure - reached) < 1.001 * std::abs(step) ? pressure : reached + step;
    const double tolerance = next == pressure ? kTolerance : kOnTheWay;
    SectorState found = state;
    const bool is_jump = reached == 0.0 && next == pressure;
    const Status solved =
        newton(elements, {next}, tolerance, reference, settings.max_iterations, found);
    if (solved.ok() && (found.held || !is_jump)) {
      state = std::move(found);
      reached = next;
    } else if (++halvings > kMaxHalvings) {
      return Failure{
          fmt::format("inflation stopped at {:.4g} of {:.4g} bar: {}; a soft wall in few columns "
                      "folds there: try shorter columns, [mesh] split_columns = 2 or a larger "
                      "meridional; a wall that buckles or cords that carry nothing do this on "
                      "every mesh: check pressure, thicknesses and moduli",
                      reached / 1e5,
                      pressure / 1e5,
                      solved.failure().reason)};
    } else {
      step *= 0.5;
    }
  }
  Inflated inflated;
  inflated.pressure = pressure;
  inflated.u = ring.expand(state.x);
  inflated.alpha = state.alpha;
  measure_growth(ring.mesh(), inflated);
  return inflated;
}

Result<Inflated> load_sector(const RingElements& elements,
                             const Inflated& from,
                             const LinearLoad& load,
                             double factor,
                             const SolverSettings& settings) {
  const Ring& ring = elements.ring();
  SectorState state{ring.compress(from.u), from.alpha};
  SectorState at_rest{Eigen::VectorXd::Zero(state.x.size()),
                      Eigen::VectorXd::Zero(state.alpha.size())};
  Eigen::VectorXd f;
  int worst = 0;
  if (!assemble_sector(elements, at_rest.x, from.pressure, at_rest.alpha, f, nullptr, &worst))
    return Failure{inverted_in_words(ring, worst)};
  const double reference = std::max(f.norm(), factor * load.w_0.norm());
  double reached = 0.0, step = 1.0;
  for (int halvings = 0; reached < 1.0;) {
    const double next = std::min(1.0, reached + step);
    SectorState found = state;
    const Status solved = newton(elements,
                                 {from.pressure, &load, next * factor},
                                 next == 1.0 ? kTolerance : kOnTheWay,
                                 reference,
                                 settings.max_iterations,
                                 found);
    if (solved.ok() && found.held) {
      state = std::move(found);
      reached = next;
    } else if (++halvings > kMaxHalvings) {
      return Failure{
          fmt::format("{:.4g} of the load were reached: {}",
                      reached,
                      solved.ok() ? "the state beyond is not stable" : solved.failure().reason)};
    } else {
      step *= 0.5;
    }
  }
  Inflated loaded;
  loaded.pressure = from.pressure;
  loaded.u = ring.expand(state.x);
  loaded.alpha = state.alpha;
  measure_growth(ring.mesh(), loaded);
  return loaded;
}

Result<Inflated> inflate_ring(EquilibriumSolver& solver,
                              const RingElements& elements,
                              double pressure,
                              double reference) {
  const RingUnknowns& unknowns = solver.assembly().unknowns();
  AssembledState state = solver.assembly().zero_state();
  solver.set_reference(reference);
  solver.forget_factor();
  for (int k = 1; k <= kRingSteps; ++k) {
    const double p = pressure * k / kRingSteps;
    const std::string step = fmt::format("inflation to {:.4g} bar", p / 1e5);
    if (const Status done = solver.solve(elements, state, p, nullptr, step); !done)
      return done.failure();
  }
  Inflated inflated;
  inflated.pressure = pressure;
  inflated.u = unknowns.expand(state.x);
  inflated.alpha = state.alpha;
  measure_growth(unknowns.ring().mesh(), inflated);
  return inflated;
}

}  // namespace latsch::fe_tire
