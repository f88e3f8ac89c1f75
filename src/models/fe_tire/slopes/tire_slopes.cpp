// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/slopes/tire_slopes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "models/fe_tire/analysis/inflation.h"
#include "models/fe_tire/analysis/modes.h"
#include "models/fe_tire/ring/sector.h"
#include "models/fe_tire/slopes/tire_slopes_impl.h"

namespace latsch::fe_tire {

TireSlopes::TireSlopes(FeTire& tire, std::vector<Variation> variations)
    : impl_(std::make_unique<Impl>(*tire.impl_, std::move(variations))) {}
TireSlopes::~TireSlopes() = default;

double to_hertz_slope(double omega_squared_slope, double frequency) {
  return omega_squared_slope / (8.0 * std::numbers::pi * std::numbers::pi * frequency);
}

Failure beside_state() { return Failure{"slopes: an element fails beside the state"}; }

int TireSlopes::variables() const { return impl_->count(); }

Result<TireSlopes::OfInflated> TireSlopes::of_inflated(const Inflated& inflated) {
  Impl& all = *impl_;
  if (!all.inflated || all.inflated->u != inflated.u) {
    auto found = all.solve_inflated(inflated);
    if (!found) return found.failure();
    all.inflated = *std::move(found);
  }
  return all.inflated->slopes;
}

/// Computes the derivatives (S.1) of the inflated state on one sector.
Result<TireSlopes::Impl::AtInflated> TireSlopes::Impl::solve_inflated(const Inflated& at) {
  const RingElements& elements = base.even_elements();
  const Ring& ring = elements.ring();
  const Eigen::VectorXd x = ring.compress(at.u);
  SectorBlocks K(ring);
  Eigen::VectorXd f, alpha = at.alpha;
  int worst = 0;
  if (!assemble_sector(elements, x, at.pressure, alpha, f, &K, &worst))
    return no_tangent(ring, worst);
  AtInflated found{at.u,
                   {},
                   {Eigen::MatrixXd(x.size(), count()),
                    Eigen::VectorXd(count()),
                    Eigen::VectorXd(count()),
                    Eigen::VectorXd(count()),
                    Eigen::VectorXd(count())}};
  OfInflated& slopes = found.slopes;
  if (!found.K.factorize(K.harmonic(0))) return Failure{"slopes: the inflated tire is not stable"};
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
    found.K.solve(d);
    slopes.x.col(k) = d.real();
    const auto [below, above] = moved_inflated(at, slopes.x.col(k), k);
    slopes.radius[k] = (above.radius - below.radius) / way;
    slopes.growth[k] = (above.growth - below.growth) / way;
    slopes.width[k] = (above.width - below.width) / way;
    slopes.pressure[k] = (pressure_of(k, varied[k]->above.tire, at.pressure) -
                          pressure_of(k, varied[k]->below.tire, at.pressure)) /
                         way;
  }
  return found;
}

/// Returns the inflated states of the tires with decreased and increased parameter, to first order.
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

/// Returns the complex shape of a harmonic mode over a sector, from its shape on the ring: section
/// plane s has the real part of phi exp(i n theta_s).
Eigen::VectorXcd sector_shape(const Ring& even, const Mesh& mesh, const Mode& mode) {
  const int n = mesh.nodes_per_sector();
  const Eigen::VectorXd first = even.compress(mode.shape.leftCols(n));
  const double angle = mode.n * mesh.angle(1), c = std::cos(angle), s = std::sin(angle);
  if (std::abs(s) < 1e-9) return first.cast<std::complex<double>>();
  const Eigen::VectorXd second = even.compress(mode.shape.middleCols(n, n));
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

/// Returns the mode of the same circumferential number with the nearest frequency, or `mode` itself
/// if none is near.
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

/// Returns true if a and b are the two modes of a pair.
bool are_pair(const Mode& a, const Mode& b) {
  return a.n > 0 && a.n == b.n && a.frequency == b.frequency;
}

/// Returns shapes over a sector with the accuracy kSharp, one for each pair of modes. `of_mode` is
/// the index of each mode's shape.
Result<std::vector<HarmonicShape>> sharp_shapes(const Varied::Base& base,
                                                const Inflated& at,
                                                const std::vector<Mode>& modes,
                                                std::vector<Eigen::Index>& of_mode) {
  const Ring& ring = base.even_elements().ring();
  const Mesh& mesh = base.ring.mesh();
  std::vector<Mode> sharp;
  if (ring.sectors() > 1 && base.settings.mode_tolerance > kSharp) {
    auto found =
        harmonic_modes(base.even_elements(), mesh, at, static_cast<int>(modes.size()), kSharp);
    if (!found) return found.failure();
    sharp = std::move(*found);
  }
  const SectorBlocks M = sector_mass(base.even_elements());
  std::vector<HarmonicShape> shapes;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (i == 0 || !are_pair(modes[i - 1], modes[i])) {
      const Eigen::VectorXcd phi = sector_shape(ring, mesh, nearest(sharp, modes[i]));
      const double mass = quadratic(M.harmonic(modes[i].n), phi);
      shapes.push_back({modes[i].n, modes[i].frequency, phi / std::sqrt(mass)});
    }
    of_mode.push_back(std::ssize(shapes) - 1);
  }
  return shapes;
}

}  // namespace

/// Computes the derivatives (S.3) of modes on one sector.
Result<Eigen::MatrixXd> TireSlopes::of_modes(const Inflated& at, const std::vector<Mode>& modes) {
  Impl& all = *impl_;
  if (const auto of_x = of_inflated(at); !of_x) return of_x.failure();
  std::vector<Eigen::Index> of_mode;
  const auto shapes = sharp_shapes(all.base, at, modes, of_mode);
  if (!shapes) return shapes.failure();
  Eigen::MatrixXd changes(std::ssize(*shapes), all.count());
  for (std::size_t first = 0; first < shapes->size(); first += SectorMotions::kMost) {
    const std::span some =
        std::span(*shapes).subspan(first, std::min(shapes->size() - first, SectorMotions::kMost));
    const auto found = all.of_harmonic_modes(at, some);
    if (!found) return found;
    changes.middleRows(static_cast<Eigen::Index>(first), found->rows()) = *found;
  }
  Eigen::MatrixXd slopes(std::ssize(modes), all.count());
  for (Eigen::Index i = 0; i < slopes.rows(); ++i)
    slopes.row(i) = to_hertz_slope(1.0, modes[i].frequency) * changes.row(of_mode[i]);
  return slopes;
}

Result<Eigen::MatrixXd> TireSlopes::Impl::of_harmonic_modes(const Inflated& at,
                                                            std::span<const HarmonicShape> modes) {
  SectorMotions motions(base.even_elements(), at, modes);
  Eigen::MatrixXd g, changes;
  if (!motions.curvatures(g)) return beside_state();
  Eigen::MatrixXcd z = (-g).cast<std::complex<double>>();
  inflated->K.solve(z);
  if (!motions.slopes(z.real(), moved_numbers(OfRing::even, at.pressure), changes))
    return beside_state();
  return changes;
}

}  // namespace latsch::fe_tire
