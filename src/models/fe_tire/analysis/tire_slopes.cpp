// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/tire_slopes.h"

#include <cmath>
#include <numbers>

#include "models/fe_tire/analysis/inflation.h"
#include "models/fe_tire/analysis/modes.h"
#include "models/fe_tire/analysis/tire_slopes_impl.h"
#include "models/fe_tire/ring/sector.h"

namespace latsch::fe_tire {

TireSlopes::TireSlopes(FeTire& tire, std::vector<Variation> variations)
    : impl_(std::make_unique<Impl>(*tire.impl_, std::move(variations))) {}
TireSlopes::~TireSlopes() = default;

double to_hertz_slope(double omega_squared_slope, double frequency) {
  return omega_squared_slope / (8.0 * std::numbers::pi * std::numbers::pi * frequency);
}

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
  OfInflated slopes{
      Eigen::MatrixXd(x.size(), count()), Eigen::VectorXd(count()), Eigen::VectorXd(count())};
  for (int k = 0; k < count(); ++k) {
    const double way = 2.0 * variations[k].step;
    const auto forces = [&](const Varied& tire, Eigen::VectorXd& moved) {
      Eigen::VectorXd enhanced = at.alpha;
      const double p = pressure_of(k, tire.tire, at.pressure);
      return assemble_sector(tire.even(), x, p, enhanced, moved, nullptr, &worst);
    };
    Eigen::VectorXd f_below, f_above;
    if (!forces(varied[k]->below, f_below) || !forces(varied[k]->above, f_above))
      return no_tangent(ring, worst);
    Eigen::MatrixXcd d = ((f_below - f_above) / way).cast<std::complex<double>>();
    cholesky.solve(d);
    slopes.x.col(k) = d.real();
    const auto [below, above] = moved_inflated(at, slopes.x.col(k), k);
    slopes.radius[k] = (above.radius - below.radius) / way;
    slopes.growth[k] = (above.growth - below.growth) / way;
  }
  return slopes;
}

/// The varied tires inflated, to the first order.
std::pair<Inflated, Inflated> TireSlopes::Impl::moved_inflated(const Inflated& at,
                                                               const Eigen::VectorXd& x_slope,
                                                               int k) const {
  const Ring& ring = base.even_elements().ring();
  const auto moved = [&](const Varied& tire, double by) {
    Inflated next = at;
    next.u += by * ring.expand(x_slope);
    measure_growth(tire.even().ring().mesh(), next);
    return next;
  };
  const double step = variations[k].step;
  return {moved(varied[k]->below, -step), moved(varied[k]->above, step)};
}

Result<TireSlopes::OfMass> TireSlopes::of_mass(const Inflated& inflated) {
  const Impl& all = *impl_;
  const auto of_x = of_inflated(inflated);
  if (!of_x) return of_x.failure();
  OfMass slopes{
      Eigen::VectorXd(all.count()), Eigen::VectorXd(all.count()), Eigen::VectorXd(all.count())};
  for (int k = 0; k < all.count(); ++k) {
    const auto [below, above] = all.moved_inflated(inflated, of_x->x.col(k), k);
    const MassProperties a = mass_properties(all.varied[k]->below.even(), below.u),
                         b = mass_properties(all.varied[k]->above.even(), above.u);
    const double way = 2.0 * all.variations[k].step;
    slopes.mass[k] = (b.mass - a.mass) / way;
    slopes.spin_inertia[k] = (b.spin_inertia - a.spin_inertia) / way;
    slopes.diametral_inertia[k] = (b.diametral_inertia - a.diametral_inertia) / way;
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

/// The mode of the same circumferential number that is nearest; itself where none is near.
const Mode& nearest(const std::vector<Mode>& modes, const Mode& mode) {
  const Mode* found = &mode;
  double least = 1e-5 * mode.frequency;
  for (const Mode& other : modes) {
    const double distance = std::abs(other.frequency - mode.frequency);
    if (other.n != mode.n || !(distance < least)) continue;
    least = distance;
    found = &other;
  }
  return *found;
}

/// Shapes over a sector to kSharp, each of unit mass there.
Result<std::vector<Eigen::VectorXcd>> sharp_shapes(const Varied::Base& base,
                                                   const Inflated& at,
                                                   const std::vector<Mode>& modes,
                                                   const SectorBlocks& M) {
  const Ring& ring = base.even_elements().ring();
  const Mesh& mesh = base.ring.mesh();
  std::vector<Mode> sharp;
  if (ring.sectors() > 1 && base.settings.mode_tolerance > kSharp) {
    auto found =
        harmonic_modes(base.even_elements(), mesh, at, static_cast<int>(modes.size()), kSharp);
    if (!found) return found.failure();
    sharp = std::move(*found);
  }
  std::vector<Eigen::VectorXcd> shapes;
  for (const Mode& mode : modes) {
    const Eigen::VectorXcd phi = sector_shape(ring, mesh, nearest(sharp, mode));
    shapes.emplace_back(phi / std::sqrt(quadratic(M.harmonic(mode.n), phi)));
  }
  return shapes;
}

}  // namespace

Result<Eigen::MatrixXd> TireSlopes::of_modes(const Inflated& at, const std::vector<Mode>& modes) {
  Impl& all = *impl_;
  const auto inflated = of_inflated(at);
  if (!inflated) return inflated.failure();
  const Ring& ring = all.base.even_elements().ring();
  const Eigen::VectorXd x = ring.compress(at.u);
  const SectorBlocks M = sector_mass(all.base.even_elements());
  const auto shapes = sharp_shapes(all.base, at, modes, M);
  if (!shapes) return shapes.failure();
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(std::ssize(modes), all.count());
  for (int k = 0; k < all.count(); ++k) {
    const double step = all.variations[k].step;
    for (const double side : {-1.0, 1.0}) {
      const Varied& tire = side < 0.0 ? all.varied[k]->below : all.varied[k]->above;
      SectorBlocks K(ring);
      Eigen::VectorXd f, alpha = at.alpha;
      int worst = 0;
      const double p = all.pressure_of(k, tire.tire, at.pressure);
      const Eigen::VectorXd moved = x + side * step * inflated->x.col(k);
      // Forces first: what they leave of alpha, the difference of two tangents would enlarge.
      if (!assemble_sector(tire.even(), moved, p, alpha, f, nullptr, &worst) ||
          !assemble_sector(tire.even(), moved, p, alpha, f, &K, &worst))
        return no_tangent(ring, worst);
      const SectorBlocks mass = tire.same_mass ? M : sector_mass(tire.even());
      for (std::size_t i = 0; i < modes.size(); ++i) {
        const double omega = 2.0 * std::numbers::pi * modes[i].frequency;
        const Eigen::VectorXcd& phi = (*shapes)[i];
        double now = quadratic(K.harmonic(modes[i].n), phi);
        if (!tire.same_mass) now -= omega * omega * quadratic(mass.harmonic(modes[i].n), phi);
        slopes(static_cast<Eigen::Index>(i), k) +=
            to_hertz_slope(side * now / (2.0 * step), modes[i].frequency);
      }
    }
  }
  return slopes;
}

}  // namespace latsch::fe_tire
