// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/tire_slopes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/analysis/inflation.h"
#include "models/fe_tire/analysis/modes.h"
#include "models/fe_tire/ring/sector.h"

namespace latsch::fe_tire {
namespace {

bool same_rebars(const Element& a, const Element& b) {
  return std::ranges::equal(a.rebars, b.rebars, [](const auto& one, const auto& other) {
    return one.layer == other.layer && one.zeta == other.zeta;
  });
}

bool same_law(const Solid& a, const Solid& b) {
  if (a.law.index() != b.law.index()) return false;
  if (const auto* rubber = std::get_if<Hyperelastic>(&a.law)) {
    const auto& other = std::get<Hyperelastic>(b.law);
    return rubber->C10 == other.C10 && rubber->C01 == other.C01 && rubber->K == other.K;
  }
  return std::get<StVenantKirchhoff>(a.law).D == std::get<StVenantKirchhoff>(b.law).D;
}

bool same_cords(const CordLayer& a, const CordLayer& b) {
  return a.E_tension == b.E_tension && a.E_compression == b.E_compression &&
         a.thickness == b.thickness && a.angle == b.angle && a.pretension == b.pretension;
}

}  // namespace

bool same_topology(const Mesh& a, const Mesh& b) {
  return a.sectors == b.sectors && a.X.cols() == b.X.cols() && a.clamped == b.clamped &&
         std::ranges::equal(a.elements, b.elements, [](const Element& x, const Element& y) {
           return x.node == y.node && x.solid == y.solid && x.inner == y.inner &&
                  x.tread == y.tread && x.rebars.size() == y.rebars.size();
         });
}

/// A varied tire with its elements; what the base tire has already is shared.
struct Varied {
  const VariedTire& tire;
  bool same_shape;
  std::optional<Ring> own_ring, own_even;  // where its shape is another one
  std::optional<RingElements> elements, even_elements;
  std::vector<bool> differs;  // an element of the section in its stress

  Varied(const Varied&) = delete;  // elements refer to their ring
  Varied(const VariedTire& varied, const FeTire::Impl& base) : tire(varied) {
    const Mesh& mesh = base.ring.mesh();
    same_shape = varied.mesh.X == mesh.X && varied.mesh.theta == mesh.theta &&
                 std::ranges::equal(varied.mesh.elements, mesh.elements, same_rebars);
    if (!same_shape) {
      own_ring.emplace(varied.mesh, base.settings.element);
      if (base.even) own_even.emplace(varied.mesh.evenly_divided(), base.settings.element);
    }
    elements.emplace(same_shape ? base.ring : *own_ring, varied.materials);
    if (base.even) even_elements.emplace(same_shape ? *base.even : *own_even, varied.materials);
    const Materials& materials = base.elements().materials();
    for (const Element& element : mesh.elements) {
      bool same = same_shape &&
                  same_law(varied.materials.solids[element.solid], materials.solids[element.solid]);
      for (const RebarPlacement& rebar : element.rebars) {
        same =
            same && same_cords(varied.materials.layers[rebar.layer], materials.layers[rebar.layer]);
      }
      differs.push_back(!same);
    }
  }

  const RingElements& even() const { return even_elements ? *even_elements : *elements; }
  const Ring& ring() const { return elements->ring(); }
  bool same_mass(const FeTire::Impl& base) const {
    const Materials& materials = base.elements().materials();
    const auto same_density = [](const auto& a, const auto& b) { return a.density == b.density; };
    return same_shape &&
           std::ranges::equal(tire.materials.solids, materials.solids, same_density) &&
           std::ranges::equal(
               tire.materials.layers, materials.layers, [](const CordLayer& a, const CordLayer& b) {
                 return a.density == b.density && a.thickness == b.thickness;
               });
  }
};

struct TireSlopes::Impl {
  FeTire::Impl& base;
  std::vector<Variation> variations;
  struct Three {
    Varied near, below, above;
    Three(const Variation& v, const FeTire::Impl& base)
        : near(v.near, base), below(v.below, base), above(v.above, base) {}
  };
  std::vector<std::unique_ptr<Three>> varied;
  std::optional<std::pair<Eigen::Matrix3Xd, OfInflated>> inflated;  // of the state u
  std::optional<numerics::Factorization> own_factor;

  Impl(FeTire::Impl& tire, std::vector<Variation> numbers)
      : base(tire), variations(std::move(numbers)) {
    for (const Variation& v : variations) varied.push_back(std::make_unique<Three>(v, base));
  }
  int count() const { return static_cast<int>(variations.size()); }

  /// Pa of a varied tire where the tire itself is under `pressure`.
  double pressure_of(int k, const VariedTire& tire, double pressure) const {
    return variations[k].moves_pressure ? tire.pressure : pressure;
  }

  Result<OfInflated> solve_inflated(const Inflated& at);
  /// Of the tangent about a state: that of its modes where they were asked for, or one of its own.
  Result<const numerics::Factorization*> factor(Systems& all, const TireState& state);
  Result<OfState> solve_state(const TireState& state, Eigen::MatrixXd* by_variable);
  bool residual_changes(Systems& all,
                        const TireState& state,
                        Eigen::MatrixXd& r,
                        Eigen::VectorXd& force);
};

TireSlopes::TireSlopes(FeTire& tire, std::vector<Variation> variations)
    : impl_(std::make_unique<Impl>(*tire.impl_, std::move(variations))) {}
TireSlopes::~TireSlopes() = default;

int TireSlopes::variables() const { return impl_->count(); }

Result<TireSlopes::OfInflated> TireSlopes::of_inflated(const Inflated& inflated) {
  Impl& all = *impl_;
  if (!all.inflated || all.inflated->first != inflated.u) {
    auto found = all.solve_inflated(inflated);
    if (!found) return found.failure();
    all.inflated.emplace(inflated.u, *std::move(found));
  }
  return all.inflated->second;
}

/// (S.1) on one sector.
Result<TireSlopes::OfInflated> TireSlopes::Impl::solve_inflated(const Inflated& at) {
  const RingElements& elements = base.even_elements();
  const Ring& ring = elements.ring();
  const Eigen::VectorXd x = ring.compress(at.u);
  SectorBlocks K(ring);
  Eigen::VectorXd f, alpha = at.alpha;
  int worst = 0;
  if (!assemble_sector(elements, x, at.pressure, alpha, f, &K, &worst))
    return no_tangent(ring, worst);
  numerics::BandedCholesky cholesky;
  if (!cholesky.factorize(K.harmonic(0))) return Failure{"slopes: the inflated tire is not stable"};
  OfInflated slopes;
  slopes.x.resize(x.size(), count());
  slopes.radius.resize(count());
  slopes.growth.resize(count());
  for (int k = 0; k < count(); ++k) {
    const Varied& near = varied[k]->near;
    Eigen::VectorXd moved, enhanced = at.alpha;
    if (!assemble_sector(near.even(),
                         x,
                         pressure_of(k, near.tire, at.pressure),
                         enhanced,
                         moved,
                         nullptr,
                         &worst)) {
      return no_tangent(ring, worst);
    }
    Eigen::MatrixXcd d = ((f - moved) / variations[k].near_step).cast<std::complex<double>>();
    cholesky.solve(d);
    slopes.x.col(k) = d.real();
    Inflated next = at;
    next.u = ring.expand(x + variations[k].near_step * slopes.x.col(k));
    measure_growth(near.even().ring().mesh(), next);
    slopes.radius[k] = (next.radius - at.radius) / variations[k].near_step;
    slopes.growth[k] = (next.growth - at.growth) / variations[k].near_step;
  }
  return slopes;
}

namespace {

/// The complex shape of a harmonic mode over a sector, from its shape on the ring: plane s has the
/// real part of phi exp(i n theta_s).
Eigen::VectorXcd sector_shape(const Ring& even, const Mesh& mesh, const Mode& mode) {
  const int n = mesh.nodes_per_sector();
  const Eigen::VectorXd first = even.compress(mode.shape.leftCols(n));
  const double angle = mode.n * mesh.angle(1), c = std::cos(angle), s = std::sin(angle);
  const Eigen::VectorXd second = even.compress(mode.shape.middleCols(n, n));
  if (std::abs(s) < 1e-9) return first.cast<std::complex<double>>();
  const Eigen::VectorXd imaginary = (c * first - second) / s;
  Eigen::VectorXcd phi(first.size());
  phi.real() = first;
  phi.imag() = imaginary;
  return phi;
}

double quadratic(const numerics::BandedHermitian& A, const Eigen::VectorXcd& phi) {
  Eigen::MatrixXcd product(phi.size(), 1);
  A.multiply(phi, product);
  return phi.dot(product.col(0)).real();
}

double to_hertz_slope(double omega_squared_slope, double frequency) {
  return omega_squared_slope / (8.0 * std::numbers::pi * std::numbers::pi * frequency);
}

}  // namespace

Result<Eigen::MatrixXd> TireSlopes::of_modes(const Inflated& at, const std::vector<Mode>& modes) {
  Impl& all = *impl_;
  const auto inflated = of_inflated(at);
  if (!inflated) return inflated.failure();
  const Ring& ring = all.base.even_elements().ring();
  const Eigen::VectorXd x = ring.compress(at.u);
  const SectorBlocks M = sector_mass(all.base.even_elements());
  std::vector<Eigen::VectorXcd> shapes;
  for (const Mode& mode : modes) {
    Eigen::VectorXcd phi = sector_shape(ring, all.base.ring.mesh(), mode);
    shapes.push_back(phi / std::sqrt(quadratic(M.harmonic(mode.n), phi)));
  }
  Eigen::MatrixXd slopes(modes.size(), all.count());
  for (int k = 0; k < all.count(); ++k) {
    const double step = all.variations[k].step;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(modes.size()));
    for (const double side : {-1.0, 1.0}) {
      const Varied& tire = side < 0.0 ? all.varied[k]->below : all.varied[k]->above;
      SectorBlocks K(ring);
      Eigen::VectorXd f, alpha = at.alpha;
      int worst = 0;
      const double p = all.pressure_of(k, tire.tire, at.pressure);
      const Eigen::VectorXd moved = x + side * step * inflated->x.col(k);
      if (!assemble_sector(tire.even(), moved, p, alpha, f, &K, &worst))
        return no_tangent(ring, worst);
      const bool same_mass = tire.same_mass(all.base);
      const SectorBlocks mass = same_mass ? M : sector_mass(tire.even());
      for (std::size_t i = 0; i < modes.size(); ++i) {
        const double omega = 2.0 * std::numbers::pi * modes[i].frequency;
        double now = quadratic(K.harmonic(modes[i].n), shapes[i]);
        if (!same_mass) now -= omega * omega * quadratic(mass.harmonic(modes[i].n), shapes[i]);
        change[static_cast<Eigen::Index>(i)] += side * now;
      }
    }
    for (std::size_t i = 0; i < modes.size(); ++i) {
      slopes(static_cast<Eigen::Index>(i), k) =
          to_hertz_slope(change[static_cast<Eigen::Index>(i)] / (2.0 * step), modes[i].frequency);
    }
  }
  return slopes;
}

namespace {

/// The ground under a state, seen by the tread of a varied tire; what differs from the base's.
struct VariedTread {
  std::optional<RingUnknowns> unknowns;
  std::optional<TreadSurface> own;
  const TreadSurface* tread;

  VariedTread(const Varied& varied,
              const Systems& all,
              const SolverSettings& settings,
              const std::optional<std::vector<int>>& mirror,
              bool halved)
      : tread(&all.tread) {
    if (varied.same_shape) return;
    unknowns.emplace(varied.ring(),
                     halved ? RingSymmetry::even : RingSymmetry::none,
                     halved ? *mirror : std::vector<int>());
    own.emplace(*unknowns, settings.tread_shape(), all.half_angle);
    tread = &*own;
  }
};

double vertical(const std::vector<TreadContact::Touch>& touches, double multiplicity) {
  double force = 0.0;
  for (const TreadContact::Touch& touch : touches) force += touch.force.z();
  return force * multiplicity;
}

}  // namespace

/// df/dp of every variable at a height that is held, and dFz/dp likewise.
bool TireSlopes::Impl::residual_changes(Systems& all,
                                        const TireState& state,
                                        Eigen::MatrixXd& r,
                                        Eigen::VectorXd& force) {
  const RingUnknowns& unknowns = all.unknowns;
  const Eigen::VectorXd x = unknowns.compress(state.u);
  const int per_sector = base.ring.elements_per_sector(), alphas = base.ring.alphas_per_element();
  r.setZero(unknowns.size(), count());
  force.setZero(count());
  ElementBatch batch;
  for (const auto& [first, lanes] : base.elements().groups(unknowns.sectors())) {
    for (int e = 0; e < per_sector; ++e) {
      std::array<Vector24, ElementBatch::kLanes> own;
      const auto forces = [&](const RingElements& elements,
                              double pressure,
                              std::array<Vector24, ElementBatch::kLanes>& f) {
        batch.count = lanes;
        for (int lane = 0; lane < lanes; ++lane) {
          batch.set(lane,
                    unknowns.gather(first + lane, e, x),
                    state.alpha.data() + ((first + lane) * per_sector + e) * alphas,
                    alphas);
        }
        const unsigned valid = elements.evaluate(first, e, pressure, false, batch);
        for (int lane = 0; lane < lanes; ++lane) {
          if (!(valid >> lane & 1)) return false;
          std::array<double, 8> enhanced{};
          batch.take(lane, f[lane], nullptr, enhanced.data(), alphas);
        }
        return true;
      };
      bool is_known = false;
      for (int k = 0; k < count(); ++k) {
        const Varied& near = varied[k]->near;
        const bool is_inner = base.ring.mesh().elements[e].inner;
        if (!near.differs[e] && !(variations[k].moves_pressure && is_inner)) continue;
        if (!is_known && !forces(base.elements(), state.inflated->pressure, own)) return false;
        is_known = true;
        std::array<Vector24, ElementBatch::kLanes> moved;
        const double pressure = pressure_of(k, near.tire, state.inflated->pressure);
        if (!forces(*near.elements, pressure, moved)) return false;
        for (int lane = 0; lane < lanes; ++lane) {
          const Vector24 change = (moved[lane] - own[lane]) / variations[k].near_step;
          unknowns.add_forces(first + lane, e, change, r.col(k));
        }
      }
    }
  }
  TreadContact contact(all.tread, state.ground);
  contact.start(state.pose, x, state.anchors);
  const auto u = all.tread.displacements(x);
  const auto touches = contact.touches(u);
  Eigen::VectorXd c = Eigen::VectorXd::Zero(x.size());
  add_forces(all.tread, touches, c);
  for (int k = 0; k < count(); ++k) {
    const Varied& near = varied[k]->near;
    if (near.same_shape) continue;
    const VariedTread other(near, all, base.settings, base.mirror(), state.is_halved);
    TreadContact moved(*other.tread, state.ground);
    moved.start(state.pose, x, state.anchors);
    const auto now = moved.touches(u);
    Eigen::VectorXd c_now = Eigen::VectorXd::Zero(x.size());
    add_forces(*other.tread, now, c_now);
    r.col(k) += (c_now - c) / variations[k].near_step;
    const double multiplicity = all.tread.multiplicity();
    force[k] =
        (vertical(now, multiplicity) - vertical(touches, multiplicity)) / variations[k].near_step;
  }
  return true;
}

Result<const numerics::Factorization*> TireSlopes::Impl::factor(Systems& all,
                                                                const TireState& state) {
  if (all.factored && all.factored->pose == state.pose && all.factored->u == state.u)
    return &all.factor;
  if (!own_factor)
    own_factor.emplace(*all.solver.assembly().pattern(),
                       numerics::Precision::full,
                       all.solver.factor().elimination());
  if (auto failure = base.factorize(all, all.solver.assembly(), all.tread, state, *own_factor))
    return *failure;
  return &*own_factor;
}

/// (S.2), and where asked for -K^-1 df/dp and, last, -K^-1 df/dh.
Result<TireSlopes::OfState> TireSlopes::Impl::solve_state(const TireState& state,
                                                          Eigen::MatrixXd* by_variable) {
  Systems& all = base.systems(state.is_halved, state.window);
  const auto factor_of_state = factor(all, state);
  if (!factor_of_state) return factor_of_state.failure();
  const numerics::Factorization& factor = **factor_of_state;
  Eigen::MatrixXd r;
  OfState slopes;
  if (!residual_changes(all, state, r, slopes.force))
    return Failure{"slopes: an element fails beside the state"};
  TreadContact contact(all.tread, state.ground);
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  contact.start(state.pose, x, state.anchors);
  // A wheel that is higher: every point in contact is as much farther from the ground.
  std::vector<TreadContact::Touch> by_height = contact.stuck(x);
  double stiffness = 0.0;
  for (TreadContact::Touch& touch : by_height) {
    touch.force = -touch.stiffness.col(2);
    stiffness += touch.stiffness(2, 2);
  }
  Eigen::VectorXd f_h = Eigen::VectorXd::Zero(x.size());
  add_forces(all.tread, by_height, f_h);
  Eigen::VectorXd w = f_h;
  factor.solve(w);
  const double multiplicity = all.tread.multiplicity();
  slopes.force += multiplicity * (r.transpose() * w);
  slopes.by_height = multiplicity * (w.dot(f_h) - stiffness);
  if (by_variable) {
    by_variable->resize(x.size(), count() + 1);
    by_variable->leftCols(count()) = -r;
    factor.solve_columns(by_variable->leftCols(count()));
    by_variable->col(count()) = -w;
  }
  return slopes;
}

Result<TireSlopes::OfState> TireSlopes::of_state(const TireState& state) {
  return impl_->solve_state(state, nullptr);
}

namespace {

/// Sums of phi^T (K - omega^2 M) phi of every mode over what is assembled of a varied tire.
class ModeSums {
 public:
  ModeSums(const RingUnknowns& unknowns, const std::vector<Mode>& modes)
      : unknowns_(unknowns), ring_(unknowns.ring()), modes_(modes) {}

  /// In the state x, alpha. False where an element fails.
  bool add(const RingElements& elements,
           bool with_mass,
           double pressure,
           const Eigen::VectorXd& x,
           const Eigen::VectorXd& alpha,
           double factor,
           Eigen::VectorXd& sums) const {
    const int per_sector = ring_.elements_per_sector(), alphas = ring_.alphas_per_element();
    ElementBatch batch;
    Vector24 f;
    Matrix24 K;
    std::array<double, 8> enhanced{};
    Eigen::MatrixXd shapes(24, modes_.size()), product(24, modes_.size());
    for (const auto& [first, lanes] : elements.groups(unknowns_.sectors())) {
      for (int e = 0; e < per_sector; ++e) {
        batch.count = lanes;
        for (int lane = 0; lane < lanes; ++lane) {
          batch.set(lane,
                    unknowns_.gather(first + lane, e, x),
                    alpha.data() + ((first + lane) * per_sector + e) * alphas,
                    alphas);
        }
        const unsigned valid = elements.evaluate(first, e, pressure, true, batch);
        Matrix24 M = Matrix24::Zero();
        for (int lane = 0; lane < lanes; ++lane) {
          if (!(valid >> lane & 1)) return false;
          batch.take(lane, f, &K, enhanced.data(), alphas);
          gather(first + lane, e, shapes);
          product.noalias() = K * shapes;
          sums += factor * product.cwiseProduct(shapes).colwise().sum().transpose();
          if (!with_mass) continue;
          M = element_mass(elements.ring(), elements.materials(), first + lane, e);
          Vector24 none = Vector24::Zero();
          elements.ring().turn_to_node_frames(first + lane, e, none, &M);
          product.noalias() = M * shapes;
          for (std::size_t i = 0; i < modes_.size(); ++i) {
            const double omega = 2.0 * std::numbers::pi * modes_[i].frequency;
            const auto at = static_cast<Eigen::Index>(i);
            sums[at] -= factor * omega * omega * product.col(at).dot(shapes.col(at));
          }
        }
      }
    }
    return true;
  }

 private:
  /// Shapes of the modes at an element's nodes, in the frames of the nodes [24 x modes].
  void gather(int sector, int e, Eigen::MatrixXd& shapes) const {
    const Mesh& mesh = ring_.mesh();
    const int n = mesh.nodes_per_sector();
    for (int a = 0; a < 8; ++a) {
      const int node = mesh.elements[e].node[a];
      const int column = ((sector + node / n) % mesh.sectors) * n + node % n;
      for (std::size_t i = 0; i < modes_.size(); ++i) {
        shapes.block<3, 1>(3 * a, static_cast<Eigen::Index>(i)) = modes_[i].shape.col(column);
      }
    }
  }

  const RingUnknowns& unknowns_;
  const Ring& ring_;
  const std::vector<Mode>& modes_;
};

}  // namespace

Result<Eigen::MatrixXd> TireSlopes::of_modes(const TireState& state,
                                             const std::vector<Mode>& modes,
                                             const Eigen::VectorXd& height) {
  Impl& impl = *impl_;
  Systems& all = impl.base.systems(state.is_halved, state.window);
  Eigen::MatrixXd by_variable;
  const auto at = impl.solve_state(state, &by_variable);
  if (!at) return at.failure();
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  const double multiplicity = all.tread.multiplicity();
  const ModeSums sums(all.unknowns, modes);
  Eigen::MatrixXd slopes(modes.size(), impl.count());
  for (int k = 0; k < impl.count(); ++k) {
    const double step = impl.variations[k].step;
    const Eigen::VectorXd along = by_variable.col(k) + height[k] * by_variable.rightCols<1>();
    Eigen::VectorXd change = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(modes.size()));
    for (const double side : {-1.0, 1.0}) {
      const Varied& tire = side < 0.0 ? impl.varied[k]->below : impl.varied[k]->above;
      const double pressure = impl.pressure_of(k, tire.tire, state.inflated->pressure);
      if (!sums.add(*tire.elements,
                    !tire.same_mass(impl.base),
                    pressure,
                    x + side * step * along,
                    state.alpha,
                    side * multiplicity,
                    change)) {
        return Failure{"slopes: an element fails beside the state"};
      }
      if (tire.same_shape) continue;
      const VariedTread other(tire, all, impl.base.settings, impl.base.mirror(), state.is_halved);
      TreadContact contact(*other.tread, state.ground);
      contact.start(state.pose, x, state.anchors);
      for (const TreadContact::Touch& touch : contact.stuck(x)) {
        for (std::size_t i = 0; i < modes.size(); ++i) {
          const Eigen::Vector3d motion = other.tread->motion(touch.point, modes[i].shape);
          change[static_cast<Eigen::Index>(i)] +=
              side * multiplicity * motion.dot(touch.stiffness * motion);
        }
      }
    }
    for (std::size_t i = 0; i < modes.size(); ++i) {
      slopes(static_cast<Eigen::Index>(i), k) =
          to_hertz_slope(change[static_cast<Eigen::Index>(i)] / (2.0 * step), modes[i].frequency);
    }
  }
  return slopes;
}

}  // namespace latsch::fe_tire
