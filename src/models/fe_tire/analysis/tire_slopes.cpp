// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/tire_slopes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/analysis/inflation.h"
#include "models/fe_tire/analysis/modes.h"
#include "models/fe_tire/analysis/ring_motions.h"
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
  std::vector<MovedNumber::Parts> parts;  // of the section's elements that differ

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
    const bool masses = !same_mass(base);
    for (const Element& element : mesh.elements) {
      MovedNumber::Parts& here = parts.emplace_back();
      const Solid &solid = varied.materials.solids[element.solid],
                  &other = materials.solids[element.solid];
      here.solid = !same_shape || !same_law(solid, other);
      here.cords = here.gas = !same_shape;
      here.mass = masses && (!same_shape || solid.density != other.density);
      for (const RebarPlacement& rebar : element.rebars) {
        const CordLayer &cords = varied.materials.layers[rebar.layer],
                        &others = materials.layers[rebar.layer];
        here.cords = here.cords || !same_cords(cords, others);
        here.mass =
            here.mass || cords.density * cords.thickness != others.density * others.thickness;
      }
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
  struct Two {
    Varied below, above;
    Two(const Variation& v, const FeTire::Impl& base) : below(v.below, base), above(v.above, base) {
      if (!v.moves_pressure) return;
      for (std::size_t e = 0; e < below.parts.size(); ++e) {
        below.parts[e].gas = base.ring.mesh().elements[e].inner;
      }
    }
  };
  std::vector<std::unique_ptr<Two>> varied;
  std::optional<std::pair<Eigen::Matrix3Xd, OfInflated>> inflated;  // of the state u
  std::optional<numerics::Factorization> own_factor;

  Impl(FeTire::Impl& tire, std::vector<Variation> numbers)
      : base(tire), variations(std::move(numbers)) {
    for (const Variation& v : variations) varied.push_back(std::make_unique<Two>(v, base));
  }
  int count() const { return static_cast<int>(variations.size()); }

  /// Pa of a varied tire where the tire itself is under `pressure`.
  double pressure_of(int k, const VariedTire& tire, double pressure) const {
    return variations[k].moves_pressure ? tire.pressure : pressure;
  }

  Result<OfInflated> solve_inflated(const Inflated& at);
  /// Of the tangent about a state: that of its modes where they were asked for, or one of its own.
  Result<const numerics::Factorization*> factor(Systems& all, const TireState& state);
  Result<Eigen::MatrixXd> of_some_modes(const TireState& state,
                                        const std::vector<Mode>& modes,
                                        const Eigen::VectorXd& height);
  std::vector<MovedNumber> moved_numbers(double pressure) const;
  /// Of the height: df/dh and -dFz/dh|x, of what is assembled.
  std::pair<Eigen::VectorXd, double> by_height(Systems& all, const TireState& state) const;
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
    const Varied &below = varied[k]->below, &above = varied[k]->above;
    const double way = 2.0 * variations[k].step;
    const auto forces = [&](const Varied& tire, Eigen::VectorXd& moved) {
      Eigen::VectorXd enhanced = at.alpha;
      const double p = pressure_of(k, tire.tire, at.pressure);
      return assemble_sector(tire.even(), x, p, enhanced, moved, nullptr, &worst);
    };
    Eigen::VectorXd f_below, f_above;
    if (!forces(below, f_below) || !forces(above, f_above)) return no_tangent(ring, worst);
    Eigen::MatrixXcd d = ((f_below - f_above) / way).cast<std::complex<double>>();
    cholesky.solve(d);
    slopes.x.col(k) = d.real();
    const auto moved = [&](const Varied& tire, double side) {
      Inflated next = at;
      next.u = ring.expand(x + side * variations[k].step * slopes.x.col(k));
      measure_growth(tire.even().ring().mesh(), next);
      return next;
    };
    const Inflated under = moved(below, -1.0), over = moved(above, 1.0);
    slopes.radius[k] = (over.radius - under.radius) / way;
    slopes.growth[k] = (over.growth - under.growth) / way;
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

Failure beside() { return Failure{"slopes: an element fails beside the state"}; }

/// Forces of the tread of a varied tire in the points that touch in the state itself: which do is
/// held, or a point that just touches would come off within a step. Flat ground below the wheel.
std::vector<TreadContact::Touch> forces_where(const std::vector<TreadContact::Touch>& touching,
                                              const TreadSurface& tread,
                                              const TireState& state,
                                              const Eigen::VectorXd& x) {
  const Eigen::Matrix3Xd positions = tread.positions(tread.displacements(x));
  std::vector<TreadContact::Touch> touches = touching;
  for (TreadContact::Touch& touch : touches) {
    const TreadSurface::Point& point = tread.points()[touch.point];
    const double stiffness = state.ground.stiffness * point.dA;
    const double distance = tread.at(point, positions).z() + state.pose.height;
    touch.stiffness = stiffness * Eigen::Vector3d::UnitZ() * Eigen::RowVector3d::UnitZ();
    touch.force = -stiffness * distance * Eigen::Vector3d::UnitZ();
  }
  return touches;
}

double vertical(const std::vector<TreadContact::Touch>& touches, double multiplicity) {
  double force = 0.0;
  for (const TreadContact::Touch& touch : touches) force += touch.force.z();
  return force * multiplicity;
}

}  // namespace

std::vector<MovedNumber> TireSlopes::Impl::moved_numbers(double pressure) const {
  std::vector<MovedNumber> numbers;
  for (int k = 0; k < count(); ++k) {
    const Varied &below = varied[k]->below, &above = varied[k]->above;
    numbers.push_back({&*below.elements,
                       &*above.elements,
                       pressure_of(k, below.tire, pressure),
                       pressure_of(k, above.tire, pressure),
                       2.0 * variations[k].step,
                       &below.parts});
  }
  return numbers;
}

std::pair<Eigen::VectorXd, double> TireSlopes::Impl::by_height(Systems& all,
                                                               const TireState& state) const {
  TreadContact contact(all.tread, state.ground);
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  contact.start(state.pose, x, state.anchors);
  // A wheel that is higher: every point in contact is as much farther from the ground.
  std::vector<TreadContact::Touch> touches = contact.stuck(x);
  double stiffness = 0.0;
  for (TreadContact::Touch& touch : touches) {
    touch.force = -touch.stiffness.col(2);
    stiffness += touch.stiffness(2, 2);
  }
  Eigen::VectorXd f_h = Eigen::VectorXd::Zero(x.size());
  add_forces(all.tread, touches, f_h);
  return {std::move(f_h), stiffness};
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

/// (S.2): Fz is -df/dh along w.
Result<TireSlopes::OfState> TireSlopes::of_state(const TireState& state) {
  Impl& impl = *impl_;
  Systems& all = impl.base.systems(state.is_halved, state.window);
  const auto factor = impl.factor(all, state);
  if (!factor) return factor.failure();
  const auto [f_h, stiffness] = impl.by_height(all, state);
  Eigen::MatrixXd w = f_h;
  (*factor)->solve(w.col(0));
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  const double pressure = state.inflated->pressure, multiplicity = all.tread.multiplicity();
  const std::vector<Mode> no_modes;
  RingMotions motions(all.unknowns, impl.base.elements(), x, state.alpha, pressure, no_modes);
  Eigen::MatrixXd sums;
  if (!motions.slopes(w, impl.moved_numbers(pressure), sums)) return beside();
  TreadContact contact(all.tread, state.ground);
  contact.start(state.pose, x, state.anchors);
  const auto touching = contact.stuck(x);
  OfState slopes;
  slopes.force = multiplicity * sums.row(0).transpose();
  slopes.by_height = multiplicity * (w.col(0).dot(f_h) - stiffness);
  for (int k = 0; k < impl.count(); ++k) {
    for (const double side : {-1.0, 1.0}) {
      const Varied& tire = side < 0.0 ? impl.varied[k]->below : impl.varied[k]->above;
      if (tire.same_shape) continue;
      const VariedTread other(tire, all, impl.base.settings, impl.base.mirror(), state.is_halved);
      const auto touches = forces_where(touching, *other.tread, state, x);
      Eigen::VectorXd c = Eigen::VectorXd::Zero(x.size());
      add_forces(*other.tread, touches, c);
      slopes.force[k] += side / (2.0 * impl.variations[k].step) *
                         (multiplicity * w.col(0).dot(c) + vertical(touches, multiplicity));
    }
  }
  return slopes;
}

/// (S.3): g dx/dp of all numbers is -z (df/dp + df/dh dh/dp).
Result<Eigen::MatrixXd> TireSlopes::of_modes(const TireState& state,
                                             const std::vector<Mode>& modes,
                                             const Eigen::VectorXd& height) {
  Eigen::MatrixXd slopes(std::ssize(modes), impl_->count());
  for (std::size_t first = 0; first < modes.size(); first += ElementMotion::kMost) {
    const auto last = std::min<std::size_t>(modes.size(), first + ElementMotion::kMost);
    const std::vector<Mode> some(modes.begin() + static_cast<std::ptrdiff_t>(first),
                                 modes.begin() + static_cast<std::ptrdiff_t>(last));
    const auto found = impl_->of_some_modes(state, some, height);
    if (!found) return found;
    slopes.middleRows(static_cast<Eigen::Index>(first), found->rows()) = *found;
  }
  return slopes;
}

Result<Eigen::MatrixXd> TireSlopes::Impl::of_some_modes(const TireState& state,
                                                        const std::vector<Mode>& modes,
                                                        const Eigen::VectorXd& height) {
  Systems& all = base.systems(state.is_halved, state.window);
  const auto factor_of_state = factor(all, state);
  if (!factor_of_state) return factor_of_state.failure();
  const Eigen::VectorXd x = all.unknowns.compress(state.u);
  const double pressure = state.inflated->pressure, multiplicity = all.tread.multiplicity();
  RingMotions motions(all.unknowns, base.elements(), x, state.alpha, pressure, modes);
  Eigen::MatrixXd z, changes;
  if (!motions.curvatures(z)) return beside();
  (*factor_of_state)->solve_columns(z);
  z = -z;
  if (!motions.slopes(z, moved_numbers(pressure), changes)) return beside();
  const Eigen::VectorXd f_h = by_height(all, state).first;
  changes += (z.transpose() * f_h) * height.transpose();
  TreadContact contact(all.tread, state.ground);
  contact.start(state.pose, x, state.anchors);
  const auto touching = contact.stuck(x);
  for (int k = 0; k < count(); ++k) {
    for (const double side : {-1.0, 1.0}) {
      const Varied& tire = side < 0.0 ? varied[k]->below : varied[k]->above;
      if (tire.same_shape) continue;
      const VariedTread other(tire, all, base.settings, base.mirror(), state.is_halved);
      const auto touches = forces_where(touching, *other.tread, state, x);
      Eigen::VectorXd c = Eigen::VectorXd::Zero(x.size());
      add_forces(*other.tread, touches, c);
      Eigen::VectorXd sums = z.transpose() * c;
      for (const TreadContact::Touch& touch : touches) {
        for (std::size_t i = 0; i < modes.size(); ++i) {
          const Eigen::Vector3d motion = other.tread->motion(touch.point, modes[i].shape);
          sums[static_cast<Eigen::Index>(i)] += motion.dot(touch.stiffness * motion);
        }
      }
      changes.col(k) += side / (2.0 * variations[k].step) * sums;
    }
  }
  for (std::size_t i = 0; i < modes.size(); ++i) {
    auto row = changes.row(static_cast<Eigen::Index>(i));
    row *= to_hertz_slope(multiplicity, modes[i].frequency);
  }
  return changes;
}

}  // namespace latsch::fe_tire
