// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/damped_tire.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/analysis/modes.h"
#include "models/fe_tire/element/cord_law.h"
#include "models/fe_tire/history/dynamic_moduli.h"
#include "models/fe_tire/history/point_strains.h"

namespace latsch::fe_tire {
namespace {

/// Largest displacement, m, of the small motions whose strains are compared. Strains are quadratic
/// in displacements, so their central differences have no error of truncation but that of the
/// enhanced strains.
constexpr double kSmall = 1e-5;
constexpr double kOther = 1e-6;    // relative distance at which a shape is not of a symmetry
constexpr double kFollowed = 1.5;  // damped modes that are computed for each that is asked for
constexpr int kPoints = 8, kCordPoints = 4, kEnhanced = 8;

/// A shape in the numbering of the unknowns (even, odd or all) to which it belongs.
struct NumberedShape {
  const RingUnknowns* unknowns;
  Eigen::VectorXd x;
  double step;  // factor by which the shape is added to the state
};

/// Strains of an element, and the enhanced parameters that its rubber stiffens by themselves.
struct MovedElement {
  PointStrains strains;
  Eigen::Vector3d gradients;  // alpha_5 .. alpha_7 of hex8_solid_shell_kernel.h
};

/// Sums up the stiffness of relaxing parts over the assembled sectors of a ring.
class PartSum {
 public:
  PartSum(const RingElements& elements, const LossMaterials& losses, Eigen::Index shapes)
      : elements_(elements), losses_(losses) {
    parts_.resize(losses.owners.size());
    for (RelaxingStiffness& part : parts_) part.K.setZero(shapes, shapes);
  }

  /// Add what relaxes of an element's solid and of its cords. `plus`, `minus`: the element with
  /// every shape added to and taken from the state.
  void add_solid(int sector,
                 int element,
                 const std::vector<MovedElement>& plus,
                 const std::vector<MovedElement>& minus,
                 const std::vector<NumberedShape>& shapes);
  void add_cords(int sector,
                 int element,
                 const std::vector<MovedElement>& plus,
                 const std::vector<MovedElement>& minus,
                 const std::vector<NumberedShape>& shapes);

  /// Returns the parts that relax. `multiplicity`: size of the ring over that of the sum.
  std::vector<RelaxingStiffness> take(double multiplicity,
                                      const std::vector<NumberedShape>& shapes) &&;

 private:
  /// Adds the integral of dE_i : dS_j at one point to the part of an owner.
  void add_point(int owner,
                 const PronyTerms& terms,
                 double dV,
                 const Eigen::MatrixXd& dE,
                 const Eigen::MatrixXd& dS) {
    if (terms.empty()) return;
    parts_[owner].terms = terms;
    parts_[owner].K.noalias() += dV * (dE.transpose() * dS);
  }

  const RingElements& elements_;
  const LossMaterials& losses_;
  std::vector<RelaxingStiffness> parts_;  // one for each owner
};

void PartSum::add_solid(int sector,
                        int element,
                        const std::vector<MovedElement>& plus,
                        const std::vector<MovedElement>& minus,
                        const std::vector<NumberedShape>& shapes) {
  const Ring& ring = elements_.ring();
  const int at = ring.mesh().elements[element].solid;
  const RelaxingSolid& solid = losses_.solids[at];
  const auto* rubber = std::get_if<Hyperelastic>(&elements_.materials().solids[at].law);
  const HexShape& shape = ring.shape(sector, element);
  const auto count = static_cast<Eigen::Index>(shapes.size());
  Eigen::MatrixXd dE(6, count), dS(6, count), gradients(3, count);
  for (int p = 0; p < kPoints; ++p) {
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vector6 a = plus[i].strains.E.col(p), b = minus[i].strains.E.col(p);
      const double per = 1.0 / (2.0 * shapes[i].step);
      dE.col(i) = per * (a - b);
      dS.col(i) = rubber
                      ? Vector6(per * (isochoric_stress(*rubber, a) - isochoric_stress(*rubber, b)))
                      : isochoric_stress(solid.shear, dE.col(i));
      gradients.col(i) = per * (plus[i].gradients - minus[i].gradients);
    }
    add_point(solid.owner, solid.terms, shape.dV[p], dE, dS);
    for (const RelaxingCords& cords : solid.smeared)
      add_point(cords.owner, cords.terms, shape.dV[p], dE, cords.D * dE);
  }
  if (!rubber || ring.alphas_per_element() < kEnhanced) return;
  const Eigen::Vector3d stiffened =
      elements_.law(sector, element).relaxation * Eigen::Vector3d(1.0 / 3.0, 1.0 / 3.0, 1.0 / 9.0);
  add_point(solid.owner,
            solid.terms,
            shape.solid_shell.volume,
            gradients,
            stiffened.asDiagonal() * gradients);
}

void PartSum::add_cords(int sector,
                        int element,
                        const std::vector<MovedElement>& plus,
                        const std::vector<MovedElement>& minus,
                        const std::vector<NumberedShape>& shapes) {
  const Element& of = elements_.ring().mesh().elements[element];
  const auto count = static_cast<Eigen::Index>(shapes.size());
  Eigen::MatrixXd de(1, count), ds(1, count);
  for (std::size_t k = 0; k < of.rebars.size(); ++k) {
    const RelaxingLayer& layer = losses_.layers[of.rebars[k].layer];
    const CordLayer& law = elements_.materials().layers[of.rebars[k].layer];
    const CordSheet& sheet = elements_.law(sector, element).cords[k];
    for (int p = 0; p < kCordPoints; ++p) {
      for (Eigen::Index i = 0; i < count; ++i) {
        const double a = plus[i].strains.cords[k][p], b = minus[i].strains.cords[k][p];
        const double per = 1.0 / (2.0 * shapes[i].step);
        de(0, i) = per * (a - b);
        ds(0, i) = per * (stress(law, a).S - stress(law, b).S);
      }
      add_point(layer.owner, layer.terms, sheet.points[p].dV, de, ds);
    }
  }
}

std::vector<RelaxingStiffness> PartSum::take(double multiplicity,
                                             const std::vector<NumberedShape>& shapes) && {
  std::erase_if(parts_, [](const RelaxingStiffness& part) { return part.terms.empty(); });
  for (RelaxingStiffness& part : parts_) {
    part.K = 0.5 * multiplicity * (part.K + part.K.transpose()).eval();
    // Even and odd motions do not work on each other.
    for (std::size_t i = 0; i < shapes.size(); ++i)
      for (std::size_t j = 0; j < shapes.size(); ++j)
        if (shapes[i].unknowns != shapes[j].unknowns)
          part.K(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = 0.0;
  }
  return std::move(parts_);
}

/// Evaluates elements with small motions added to a state.
class MotionStrains {
 public:
  MotionStrains(const RingElements& elements,
                const RingUnknowns& state_unknowns,
                const Eigen::VectorXd& x,
                const std::vector<NumberedShape>& shapes)
      : elements_(elements), unknowns_(state_unknowns), x_(x), shapes_(shapes) {
    for (const NumberedShape& shape : shapes)
      forces.push_back(Eigen::VectorXd::Zero(shape.unknowns->size()));
  }

  /// Computes the strains of an element for all shapes. `near`: enhanced strains of the state or of
  /// a state nearby. Returns false if the element has no equilibrium of its enhanced strains.
  bool find(int sector, int element, const double* near);

  std::vector<MovedElement> plus, minus;  // for each shape; the element is that of the last find()
  /// Sums of the elements' forces along each shape, N per unit shape, in the shape's numbering.
  std::vector<Eigen::VectorXd> forces;

 private:
  const RingElements& elements_;
  const RingUnknowns& unknowns_;
  const Eigen::VectorXd& x_;
  const std::vector<NumberedShape>& shapes_;
};

bool MotionStrains::find(int sector, int element, const double* near) {
  constexpr int kPairs = ElementBatch::kLanes / 2;
  const int alphas = elements_.ring().alphas_per_element();
  plus.resize(shapes_.size()), minus.resize(shapes_.size());
  const Matrix38 at = unknowns_.gather(sector, element, x_);
  std::array<Matrix38, 2 * kPairs> moved;  // with a shape added, and with it taken away
  for (std::size_t first = 0; first < shapes_.size(); first += kPairs) {
    const int pairs = static_cast<int>(std::min<std::size_t>(kPairs, shapes_.size() - first));
    ElementBatch batch;
    batch.count = 2 * pairs;
    for (int k = 0; k < pairs; ++k) {
      const NumberedShape& shape = shapes_[first + k];
      const Matrix38 by = shape.step * shape.unknowns->gather(sector, element, shape.x);
      moved[2 * k] = at + by;
      moved[2 * k + 1] = at - by;
    }
    for (int k = 0; k < 2 * pairs; ++k) batch.set(k, moved[k], near, alphas);
    const unsigned done = elements_.evaluate(sector, element, 0.0, Stiffness::none, batch);
    if (done != (1u << (2 * pairs)) - 1u) return false;
    for (int k = 0; k < 2 * pairs; ++k) {
      const std::size_t i = first + k / 2;
      Vector24 f;
      double alpha[8] = {};
      batch.take(k, f, nullptr, alpha, alphas);
      const double per = (k % 2 == 0 ? 0.5 : -0.5) / shapes_[i].step;
      shapes_[i].unknowns->add_forces(sector, element, per * f, forces[i]);
      (k % 2 == 0 ? plus : minus)[i] = {
          point_strains(elements_.law(sector, element), moved[k], alpha),
          Eigen::Vector3d(alpha[5], alpha[6], alpha[7])};
    }
  }
  return true;
}

/// Returns the products of all shapes with the forces along all shapes, made symmetric.
Eigen::MatrixXd stiffness_of(const std::vector<NumberedShape>& shapes,
                             const std::vector<Eigen::VectorXd>& forces,
                             double multiplicity) {
  const auto count = static_cast<Eigen::Index>(shapes.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      if (shapes[i].unknowns == shapes[j].unknowns) K(i, j) = shapes[i].x.dot(forces[j]);
  return 0.5 * multiplicity * (K + K.transpose());
}

/// Projects the elements of the sectors that `unknowns` assembles on the shapes.
/// `near(sector, element)` points to enhanced strains near those of the state.
template <class Near>
Result<DampedTire::Projected> project_on(const RingElements& elements,
                                         const LossMaterials& losses,
                                         const RingUnknowns& unknowns,
                                         const Eigen::VectorXd& x,
                                         const std::vector<NumberedShape>& shapes,
                                         const Near& near) {
  const Ring& ring = elements.ring();
  PartSum sum(elements, losses, static_cast<Eigen::Index>(shapes.size()));
  MotionStrains motions(elements, unknowns, x, shapes);
  for (int s = 0; s < unknowns.sectors(); ++s) {
    for (int e = 0; e < ring.elements_per_sector(); ++e) {
      if (!motions.find(s, e, near(s, e)))
        return no_tangent(ring, s * ring.elements_per_sector() + e);
      sum.add_solid(s, e, motions.plus, motions.minus, shapes);
      sum.add_cords(s, e, motions.plus, motions.minus, shapes);
    }
  }
  const double multiplicity = unknowns.multiplicity();
  return DampedTire::Projected{stiffness_of(shapes, motions.forces, multiplicity),
                               std::move(sum).take(multiplicity, shapes)};
}

double step_for(const Eigen::Matrix3Xd& shape) {
  return kSmall / std::max(1e-300, shape.cwiseAbs().maxCoeff());
}

/// Returns the shape in the numbering of even or of odd motions, whichever represents it.
NumberedShape numbered(const Eigen::Matrix3Xd& shape,
                       const RingUnknowns& even,
                       const RingUnknowns* odd) {
  const auto in = [&](const RingUnknowns& unknowns) {
    return NumberedShape{&unknowns, unknowns.compress(shape), step_for(shape)};
  };
  NumberedShape as_even = in(even);
  if (!odd || (even.expand(as_even.x) - shape).norm() <= kOther * shape.norm()) return as_even;
  return in(*odd);
}

Eigen::VectorXd squares_of_frequencies(const std::vector<Mode>& modes) {
  Eigen::VectorXd squares(std::ssize(modes));
  for (std::size_t i = 0; i < modes.size(); ++i)
    squares[static_cast<Eigen::Index>(i)] =
        std::pow(2.0 * std::numbers::pi * modes[i].frequency, 2);
  return squares;
}

/// Returns the `count` lowest damped modes in the coordinates of `basis`. Modes that stiffen little
/// may come before others, so more than `count` are followed.
Result<std::vector<DecayingMode>> damped(const std::vector<Mode>& basis,
                                         const Eigen::MatrixXd& K,
                                         const std::vector<RelaxingStiffness>& parts,
                                         int count) {
  const int followed =
      std::min<int>(static_cast<int>(std::ceil(kFollowed * count)), std::ssize(basis));
  std::vector<DecayingMode> modes;
  for (int j = 0; j < followed; ++j) {
    const auto found = free_vibration(K, parts, j);
    if (!found) return Failure{"modes: " + found.failure().reason};
    DecayingMode damped{basis[j], found->damping()};
    damped.mode.frequency = found->frequency();
    const double sign = found->q[j].real() < 0.0 ? -1.0 : 1.0;
    damped.mode.shape.setZero();
    for (std::size_t i = 0; i < basis.size(); ++i)
      damped.mode.shape += sign * found->q[static_cast<Eigen::Index>(i)].real() * basis[i].shape;
    modes.push_back(std::move(damped));
  }
  std::ranges::stable_sort(modes, {}, [](const DecayingMode& m) { return m.mode.frequency; });
  modes.resize(std::min<std::size_t>(modes.size(), count));
  return modes;
}

}  // namespace

Result<DampedTire::Projected> DampedTire::project(const Materials& materials,
                                                  const Inflated& inflated,
                                                  const std::vector<Mode>& shapes) const {
  const RingElements elements(tire_.impl_->ring, materials);
  const Ring& ring = elements.ring();
  const RingUnknowns whole(ring, RingSymmetry::none, {});
  std::vector<NumberedShape> in_numbers;
  in_numbers.reserve(shapes.size());
  for (const Mode& mode : shapes) in_numbers.push_back(numbered(mode.shape, whole, nullptr));
  return project_on(elements,
                    losses_,
                    whole,
                    whole.compress(inflated.u.replicate(1, ring.sectors())),
                    in_numbers,
                    [&](int, int e) {
                      return inflated.alpha.data() +
                             static_cast<Eigen::Index>(e) * ring.alphas_per_element();
                    });
}

Result<DampedTire::Projected> DampedTire::project(const Materials& materials,
                                                  const TireState& state,
                                                  const std::vector<Mode>& shapes) const {
  const RingElements elements(tire_.impl_->ring, materials);
  const Ring& ring = elements.ring();
  const Systems& all = tire_.impl_->systems(state.is_halved, state.window);
  const RingUnknowns* odd = all.odd_unknowns ? &*all.odd_unknowns : nullptr;
  std::vector<NumberedShape> in_numbers;
  in_numbers.reserve(shapes.size());
  for (const Mode& mode : shapes) in_numbers.push_back(numbered(mode.shape, all.unknowns, odd));
  return project_on(elements,
                    losses_,
                    all.unknowns,
                    all.unknowns.compress(state.u),
                    in_numbers,
                    [&](int s, int e) {
                      return state.alpha.data() +
                             (static_cast<Eigen::Index>(s) * ring.elements_per_sector() + e) *
                                 ring.alphas_per_element();
                    });
}

template <class State>
Result<std::vector<DecayingMode>> DampedTire::modes_about(const State& state, int count) {
  const auto first = tire_.modes(state, count);
  if (!first) return first.failure();
  const double amid =
      2.0 * std::numbers::pi * std::sqrt(first->front().frequency * first->back().frequency);
  const Materials relaxed = tire_.materials(), stiff = stiffened(relaxed, losses_, amid);
  tire_.set(stiff);
  const auto basis = tire_.modes(state, static_cast<int>(std::ceil(kBasis * count)));
  tire_.set(relaxed);
  if (!basis) return basis.failure();
  const auto as_stiff = project(stiff, state, *basis), as_relaxed = project(relaxed, state, *basis);
  if (!as_stiff) return as_stiff.failure();
  if (!as_relaxed) return as_relaxed.failure();
  // Pressure and ground do not relax: they are in the squares of the stiff tire's frequencies.
  Eigen::MatrixXd K = squares_of_frequencies(*basis).asDiagonal();
  K += as_relaxed->elements - as_stiff->elements;
  return damped(*basis, K, as_relaxed->parts, count);
}

Result<std::vector<DecayingMode>> DampedTire::modes(const Inflated& inflated, int count) {
  return modes_about(inflated, count);
}

Result<std::vector<DecayingMode>> DampedTire::modes(const TireState& state, int count) {
  return modes_about(state, count);
}

}  // namespace latsch::fe_tire
