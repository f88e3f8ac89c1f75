// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/reduced_tire.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "models/fe_tire/motion/response_shapes.h"
#include "models/fe_tire/passage/rolling_transient_impl.h"

namespace latsch::fe_tire {
namespace {

/// Displacement, m, by which the sums of the inertia are differentiated; they are quadratic in it.
constexpr double kMoved = 1e-3;
/// Polynomials across the tread, of degrees from 0 on, for which static displacements are shapes.
constexpr int kAcross = 4;

/// Inertia of the whole tire about a steady state, projected on shapes.
class ProjectedInertia {
 public:
  ProjectedInertia(const RingUnknowns& unknowns,
                   const MovingInertia& inertia,
                   const Eigen::MatrixXd& shapes,
                   const Eigen::Matrix3Xd& u,
                   double spin)
      : unknowns_(unknowns),
        inertia_(inertia),
        shapes_(shapes),
        u_(u),
        still_(0.0 * u),
        spin_(spin),
        steady_(inertia.forces({u_, still_, still_, spin_, 0.0})) {}

  Eigen::Vector<double, 6> steady() const { return sums(steady_); }

  /// Sets everything that belongs to the motion of the shapes.
  void find_motions(ReducedTire& of) const {
    const Eigen::Index n = shapes_.cols();
    for (auto* sums_of : {&of.by_q, &of.by_rate, &of.by_acceleration}) sums_of->resize(6, n);
    of.G.resize(n, n);
    of.D.resize(n, n);
    const auto flow_0 = inertia_.forces({still_, still_, still_, 0.0, 1.0});
    const Eigen::VectorXd flow = unknowns_.compress(flow_0.at_nodes);
    const Eigen::VectorXd base = unknowns_.compress(steady_.at_nodes);
    const Eigen::Vector3d axle = Eigen::Vector3d::UnitY();
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::Matrix3Xd shape = unknowns_.expand(shapes_.col(k));
      const double by = kMoved / std::max(shape.cwiseAbs().maxCoeff(), 1e-300);
      const auto more = inertia_.forces({u_ + by * shape, still_, still_, spin_, 0.0});
      const auto less = inertia_.forces({u_ - by * shape, still_, still_, spin_, 0.0});
      of.by_q.col(k) = (sums(more) - sums(less)) / (2.0 * by);
      const auto moving = inertia_.forces({u_, shape, still_, spin_, 0.0});
      of.by_rate.col(k) = sums(moving) - steady();
      of.G.col(k) =
          shapes_.transpose() * (unknowns_.compress(moving.at_nodes) - base).eval() / spin_;
      const auto pushed = inertia_.forces({u_, still_, shape, spin_, 0.0});
      of.by_acceleration.col(k) = sums(pushed) - steady();
      Eigen::Matrix3Xd turned(3, shape.cols());
      for (Eigen::Index a = 0; a < shape.cols(); ++a) turned.col(a) = -axle.cross(shape.col(a));
      const auto carried = inertia_.forces({shape, still_, turned, 0.0, 1.0});
      of.D.col(k) = shapes_.transpose() * (unknowns_.compress(carried.at_nodes) - flow).eval();
    }
  }

  ReducedTire::Inertia of_spin() const {
    ReducedTire::Inertia by;
    const double squared = spin_ * spin_;
    by.sums = sums(steady_) / squared;
    by.on_shapes = on_shapes(steady_.at_nodes) / squared;
    return by;
  }
  ReducedTire::Inertia of_spin_rate() const {
    return difference(inertia_.forces({u_, still_, still_, spin_, 1.0}));
  }
  /// Returns the inertia of three fields of acceleration, m/s^2 [3 x nodes, sector frames].
  template <class Field>
  ReducedTire::Inertia of_fields(const Field& field) const {
    ReducedTire::Inertia by;
    by.sums.resize(6, 3);
    by.on_shapes.resize(shapes_.cols(), 3);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Matrix3Xd a = field(k);
      const ReducedTire::Inertia one = difference(inertia_.forces({u_, still_, a, spin_, 0.0}));
      by.sums.col(k) = one.sums;
      by.on_shapes.col(k) = one.on_shapes;
    }
    return by;
  }

 private:
  static Eigen::Vector<double, 6> sums(const MovingInertia::Forces& of) {
    Eigen::Vector<double, 6> both;
    both << of.force, of.moment;
    return both;
  }
  Eigen::VectorXd on_shapes(const Eigen::Matrix3Xd& at_nodes) const {
    return shapes_.transpose() * unknowns_.compress(at_nodes);
  }
  ReducedTire::Inertia difference(const MovingInertia::Forces& other) const {
    ReducedTire::Inertia by;
    by.sums = sums(other) - sums(steady_);
    by.on_shapes = on_shapes(other.at_nodes - steady_.at_nodes);
    return by;
  }

  const RingUnknowns& unknowns_;
  const MovingInertia& inertia_;
  const Eigen::MatrixXd& shapes_;
  const Eigen::Matrix3Xd u_, still_;
  double spin_;
  MovingInertia::Forces steady_;
};

/// Returns loads on the unknowns, one in each direction of every plane of the tread and each
/// polynomial across it: what the ground's forces are made of, but for their finest parts.
Eigen::MatrixXd loads_on_tread(const TreadSurface& tread, Eigen::Index unknowns) {
  std::vector<int> planes;
  double half_width = 0.0;
  for (const TreadSurface::Place& place : tread.places()) {
    if (place.node < 0) continue;
    planes.push_back(place.plane);
    half_width = std::max(half_width, std::abs(place.X.y()));
  }
  std::ranges::sort(planes);
  planes.erase(std::ranges::unique(planes).begin(), planes.end());
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(unknowns, 3 * kAcross * std::ssize(planes));
  for (const TreadSurface::Place& place : tread.places()) {
    if (place.node < 0) continue;
    const auto plane = std::ranges::lower_bound(planes, place.plane) - planes.begin();
    for (int d = 0; d < kAcross; ++d)
      for (int k = 0; k < 3; ++k)
        loads(3 * tread.block_rows()[place.node] + k, 3 * (kAcross * plane + d) + k) =
            std::legendre(d, place.X.y() / half_width);
  }
  return loads;
}

/// Returns a field of three components a node [3 x nodes, sector frames] from a function of the
/// node's place, m, and the sector's frame.
template <class At>
Eigen::Matrix3Xd field_of(const Mesh& mesh, const Eigen::Matrix3Xd& u, const At& at) {
  const int n = mesh.nodes_per_sector();
  Eigen::Matrix3Xd field(3, u.cols());
  for (int s = 0; s < mesh.sectors; ++s) {
    const Eigen::Matrix3d back = mesh.frame(s).transpose();
    for (int k = 0; k < n; ++k)
      field.col(s * n + k) = at(Eigen::Vector3d(mesh.X.col(k) + u.col(s * n + k)), back);
  }
  return field;
}

}  // namespace

/// Returns X' A X.
static Eigen::MatrixXd projected(const numerics::SymmetricMatrix& A, const Eigen::MatrixXd& X) {
  Eigen::MatrixXd AX(X.rows(), X.cols());
  A.multiply(X, AX);
  return X.transpose() * AX;
}

/// Computes the tangent of the elements at the steady state of a passage with the laws stiffened by
/// m of each Prony series.
Status RollingTransient::Impl::find_stiffness(const std::vector<double>& m) {
  AssembledState state{now.motion.x, now.alpha};
  if (history) history->stiffen(m, unknowns, state);
  Eigen::VectorXd f;
  int worst = 0;
  if (assembly.assemble(
          history ? history->elements() : elements, state, now.pressure, f, &K, &worst))
    return {};
  return Failure{"an element is inverted, " + unknowns.ring().place(worst)};
}

Result<ReducedTire> RollingTransient::reduced(const ReductionSettings& settings) {
  Impl& full = *impl_;
  const TransientState& now = full.now;
  const double spin = now.spin;
  const BossakStep rule(full.settings.step, full.settings.rho);
  full.forget();
  // The tangent with the stress of the steady state and the moduli of one step.
  std::vector<double> stiffer;
  if (full.history)
    for (const PronyTerms& terms : full.history->series()) {
      stiffer.push_back(0.0);
      for (const PronyTerm& term : terms) stiffer.back() += fresh_share(term, rule.h);
    }
  if (const Status done = full.find_stiffness(stiffer); !done) return done.failure();
  full.K.add(-spin * spin, full.W);
  numerics::Factorization factor(*full.assembly.pattern(), numerics::Precision::single);
  if (!factor.factorize(full.K).definite() || !full.linear.factorize(full.K))
    return Failure{"the tire is unstable off the ground about its steady state"};
  auto shapes = modes_up_to(settings.beyond * settings.highest, factor, full.M);
  if (!shapes) return shapes.failure();
  Eigen::MatrixXd pressed = loads_on_tread(full.tread, full.unknowns.size());
  factor.solve_columns(pressed);
  append_orthogonal(pressed, full.M, *shapes);

  ReducedTire of;
  of.tread = &full.tread;
  of.lines = &full.lines;
  of.reach = full.reach();
  of.of = now.wheel.of;
  of.of.spin = spin;
  of.u = full.tread.displacements(now.motion.x);
  of.K = projected(full.K, *shapes);
  of.at_tread.resize(3 * full.tread.nodes(), shapes->cols());
  for (Eigen::Index k = 0; k < shapes->cols(); ++k)
    of.at_tread.col(k) = full.tread.displacements(shapes->col(k)).reshaped();
  const Eigen::LDLT<Eigen::MatrixXd> S(full.linear.at_tread());
  of.rest = S.solve(Eigen::MatrixXd::Identity(of.at_tread.rows(), of.at_tread.rows()));
  of.rest -= of.at_tread * of.K.ldlt().solve(of.at_tread.transpose());
  of.rest = (0.5 * (of.rest + of.rest.transpose())).eval();
  full.forget();
  for (std::size_t k = 0; k < stiffer.size(); ++k) {
    std::vector<double> alone(stiffer.size(), 0.0);
    if (const Status done = full.find_stiffness(alone); !done) return done.failure();
    const numerics::SymmetricMatrix relaxed = full.K;
    alone[k] = stiffer[k];
    if (const Status done = full.find_stiffness(alone); !done) return done.failure();
    full.K.add(-1.0, relaxed);
    of.parts.push_back({projected(full.K, *shapes) / stiffer[k], full.history->series()[k]});
  }
  for (std::size_t k = 0; k < stiffer.size(); ++k) of.K -= stiffer[k] * of.parts[k].K;

  // The history of the steady state is that of RollingTransient::start() again.
  Impl::Iterate at{now.motion, now.alpha, {}, {}, {}, spin, 0.0};
  if (full.history) full.history->begin_step(rule.h, spin);
  if (const Status done = full.evaluate(at, rule, now.wheel, false); !done) return done.failure();
  of.c = full.tread.displacements(at.g).reshaped();

  const Mesh& mesh = full.unknowns.ring().mesh();
  const Eigen::Matrix3Xd u = full.unknowns.expand(now.motion.x);
  const ProjectedInertia inertia(full.unknowns, full.inertia, *shapes, u, spin);
  inertia.find_motions(of);
  of.steady = inertia.steady();
  of.spin = inertia.of_spin();
  of.spin_rate = inertia.of_spin_rate();
  of.acceleration = inertia.of_fields([&](int k) {
    return field_of(mesh, u, [&](const Eigen::Vector3d&, const Eigen::Matrix3d& back) {
      return Eigen::Vector3d(back.col(k));
    });
  });
  of.turning = inertia.of_fields([&](int k) {
    return field_of(mesh, u, [&](const Eigen::Vector3d& x, const Eigen::Matrix3d& back) {
      const Eigen::Vector3d axle = back * Eigen::Vector3d::UnitY();
      return Eigen::Vector3d(2.0 * back.col(k).cross(spin * axle.cross(x)));
    });
  });
  of.turning_rate = inertia.of_fields([&](int k) {
    return field_of(mesh, u, [&](const Eigen::Vector3d& x, const Eigen::Matrix3d& back) {
      return Eigen::Vector3d(back.col(k).cross(x));
    });
  });
  return of;
}

}  // namespace latsch::fe_tire
