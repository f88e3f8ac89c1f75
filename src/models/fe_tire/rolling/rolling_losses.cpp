// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_losses.h"

#include <numbers>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/element/cord_law.h"
#include "models/fe_tire/history/sector_spline.h"

namespace latsch::fe_tire {
namespace {

/// Returns the displacements of an element's nodes in the frame of its sector.
Matrix38 displacements(const Ring& ring, int sector, int element, const Eigen::Matrix3Xd& u) {
  const int n = ring.mesh().nodes_per_sector();
  Matrix38 at;
  for (int a = 0; a < 8; ++a) {
    const int node = ring.mesh().elements[element].node[a];
    at.col(a) = u.col((sector + node / n) % ring.sectors() * n + node % n);
  }
  return ring.in_element_frame(sector, element, at);
}

/// Returns the strains of every element of a round state, with the enhanced strains that belong to
/// each width of sectors.
std::vector<std::vector<PointStrains>> round_strains(const RingElements& elements,
                                                     const Inflated& round) {
  const Ring& ring = elements.ring();
  const int n = ring.mesh().nodes_per_sector(), alphas = ring.alphas_per_element();
  std::vector<std::vector<PointStrains>> strains(ring.widths());
  for (int s = 0; s < ring.sectors(); ++s) {
    auto& of_width = strains[ring.width(s)];
    if (!of_width.empty()) continue;
    for (int e = 0; e < ring.elements_per_sector(); ++e) {
      Matrix38 u;
      for (int a = 0; a < 8; ++a) u.col(a) = round.u.col(ring.mesh().elements[e].node[a] % n);
      u = ring.in_element_frame(s, e, u);
      ElementBatch batch;
      batch.count = 1;
      batch.set(0, u, round.alpha.data() + static_cast<Eigen::Index>(e) * alphas, alphas);
      elements.evaluate(s, e, 0.0, Stiffness::none, batch);
      Vector24 f;
      double alpha[8] = {};
      batch.take(0, f, nullptr, alpha, alphas);
      of_width.push_back(point_strains(elements.law(s, e), u, alpha));
    }
  }
  return strains;
}

}  // namespace

/// Strains and relaxed stresses of a streamline's points [components x sectors], counted from the
/// round state.
struct LossMeter::Line {
  Eigen::MatrixXd E, S;
  double volume = 0.0;  // m^3, of one radian

  Line(int components, int sectors) : E(components, sectors), S(components, sectors) {}
  /// Returns the power that these terms lose, W, at the places of the spline.
  double power(const Streamline& line,
               const Eigen::MatrixXd& spline,
               const PronyTerms& terms,
               double Omega) const {
    const Eigen::MatrixXd strains = E * spline, stresses = S * spline;
    double sum = 0.0;
    for (const PronyTerm& term : terms)
      sum += line.power(term, Omega, stresses, line.history(term, Omega, stresses), strains);
    return volume * sum;
  }
};

LossMeter::LossMeter(const FeTire& tire, LossMaterials losses, const Inflated& round)
    : elements_(tire.impl_->elements()),
      losses_(std::move(losses)),
      line_(sector_line(tire.mesh())),
      places_(spline_line(tire.mesh())),
      spline_(sector_spline(tire.mesh())),
      round_(round_strains(elements_, round)) {}
LossMeter::~LossMeter() = default;

std::vector<PointStrains> LossMeter::strains_of(int element,
                                                const Eigen::Matrix3Xd& u,
                                                const Eigen::VectorXd& alpha) const {
  const Ring& ring = elements_.ring();
  std::vector<PointStrains> strains;
  for (int s = 0; s < ring.sectors(); ++s) {
    const Eigen::Index first =
        (static_cast<Eigen::Index>(s) * ring.elements_per_sector() + element) *
        ring.alphas_per_element();
    strains.push_back(point_strains(
        elements_.law(s, element), displacements(ring, s, element, u), alpha.data() + first));
  }
  return strains;
}

void LossMeter::add_solid(int element,
                          const std::vector<PointStrains>& strains,
                          double Omega,
                          RollingLosses& sum) const {
  const Ring& ring = elements_.ring();
  const int at = ring.mesh().elements[element].solid;
  const RelaxingSolid& solid = losses_.solids[at];
  const auto* rubber = std::get_if<Hyperelastic>(&elements_.materials().solids[at].law);
  for (const auto& [p, q] : kOnLine) {
    Line line(6, ring.sectors());
    for (int s = 0; s < ring.sectors(); ++s) {
      const PointStrains& still = round(s, element);
      const Vector6 E = 0.5 * (strains[s].E.col(p) + strains[s].E.col(q));
      const Vector6 E_round = 0.5 * (still.E.col(p) + still.E.col(q));
      line.E.col(s) = E - E_round;
      if (rubber)
        line.S.col(s) = isochoric_stress(*rubber, E) - isochoric_stress(*rubber, E_round);
      else
        line.S.col(s) = isochoric_stress(solid.shear, E - E_round);
      const auto& dV = ring.shape(s, element).dV;
      line.volume += (dV[p] + dV[q]) / (2.0 * std::numbers::pi);
    }
    sum.parts[solid.owner] += line.power(places_, spline_, solid.terms, Omega);
    for (const RelaxingCords& cords : solid.smeared) {
      line.S = cords.D * line.E;
      sum.parts[cords.owner] += line.power(places_, spline_, cords.terms, Omega);
    }
  }
}

void LossMeter::add_cords(int element,
                          const std::vector<PointStrains>& strains,
                          double Omega,
                          RollingLosses& sum) const {
  const Ring& ring = elements_.ring();
  const Element& of = ring.mesh().elements[element];
  for (std::size_t k = 0; k < of.rebars.size(); ++k) {
    const RelaxingLayer& layer = losses_.layers[of.rebars[k].layer];
    const CordLayer& law = elements_.materials().layers[of.rebars[k].layer];
    for (std::size_t pair = 0; pair < kOnLine.size() / 2; ++pair) {
      const auto [p, q] = kOnLine[pair];
      Line line(1, ring.sectors());
      for (int s = 0; s < ring.sectors(); ++s) {
        const Eigen::Vector4d &at = strains[s].cords[k], &still = round(s, element).cords[k];
        const double e = 0.5 * (at[p] + at[q]), e_round = 0.5 * (still[p] + still[q]);
        line.E(0, s) = e - e_round;
        line.S(0, s) = stress(law, e).S - stress(law, e_round).S;
        const CordSheet& sheet = elements_.law(s, element).cords[k];
        line.volume += (sheet.points[p].dV + sheet.points[q].dV) / (2.0 * std::numbers::pi);
      }
      sum.parts[layer.owner] += line.power(places_, spline_, layer.terms, Omega);
    }
  }
}

RollingLosses LossMeter::measure(const Eigen::Matrix3Xd& u,
                                 const Eigen::VectorXd& alpha,
                                 double Omega) const {
  RollingLosses sum;
  sum.parts.assign(losses_.owners.size(), 0.0);
  if (losses_.is_elastic() || Omega == 0.0) return sum;
  for (int e = 0; e < elements_.ring().elements_per_sector(); ++e) {
    const std::vector<PointStrains> strains = strains_of(e, u, alpha);
    add_solid(e, strains, Omega, sum);
    add_cords(e, strains, Omega, sum);
  }
  for (std::size_t k = 0; k < sum.parts.size(); ++k)
    (losses_.owners[k].is_cord ? sum.cords : sum.rubber) += sum.parts[k];
  return sum;
}

}  // namespace latsch::fe_tire
