// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_history.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "models/fe_tire/history/point_strains.h"
#include "models/fe_tire/history/sector_spline.h"

namespace latsch::fe_tire {
namespace {

/// Waves around whose storage modulus stiffens the laws. A free wheel of tire B with a loss factor
/// of 0.15 takes 24, 29 and 36 iterations with 2, 8 and 30: the tire as a whole, which sees the
/// relaxed moduli, decides.
constexpr double kWavesOfTire = 2.0;
/// Relative change of the spin at which the laws are stiffened anew. Storage moduli change by a
/// tenth of it.
constexpr double kOtherSpin = 0.2;

/// Copies the means of the pairs of one lane, in the order of the streamlines: those of the solid,
/// of the enhanced strains' stiffness, of each cord layer.
void take_means(const PointStresses& S, int lane, Eigen::Ref<Eigen::VectorXd> means) {
  Eigen::Index at = 0;
  for (const auto& [p, q] : kOnLine)
    for (int r = 0; r < 6; ++r) means[at++] = 0.5 * (S.solid[p][r][lane] + S.solid[q][r][lane]);
  for (const auto& gradient : S.gradients) means[at++] = gradient[lane];
  for (int k = 0; at < means.size(); ++k)
    for (int pair = 0; pair < 2; ++pair)
      means[at++] =
          0.5 * (S.cords[k][kOnLine[pair].first][lane] + S.cords[k][kOnLine[pair].second][lane]);
}

}  // namespace

bool RollingHistory::Relaxing::is_elastic() const {
  return rubber < 0 && parts.empty() && std::ranges::all_of(cords, [](int k) { return k < 0; });
}

RollingHistory::RollingHistory(const RingElements& elements,
                               LossMaterials losses,
                               const Inflated& round)
    : elements_(elements),
      losses_(std::move(losses)),
      line_(spline_line(elements.ring().mesh())),
      spline_(sector_spline(elements.ring().mesh())) {
  for (const Element& element : elements.ring().mesh().elements)
    relaxing_.push_back(relaxing(element));
  set_round(round);
}

/// Returns the index of a Prony series, -1 if it has no terms.
int RollingHistory::series(const PronyTerms& terms) {
  if (terms.empty()) return -1;
  const auto known = std::ranges::find(series_, terms);
  if (known == series_.end()) series_.push_back(terms);
  return static_cast<int>(std::ranges::find(series_, terms) - series_.begin());
}

RollingHistory::Relaxing RollingHistory::relaxing(const Element& element) {
  Relaxing of;
  const RelaxingSolid& solid = losses_.solids[element.solid];
  if (std::holds_alternative<Hyperelastic>(elements_.materials().solids[element.solid].law)) {
    of.rubber = series(solid.terms);
  } else {
    if (const int k = series(solid.terms); k >= 0) {
      Matrix6 D;
      for (int c = 0; c < 6; ++c) D.col(c) = isochoric_stress(solid.shear, Vector6::Unit(c));
      of.parts.push_back({k, D});
    }
    for (const RelaxingCords& cords : solid.smeared)
      if (const int k = series(cords.terms); k >= 0) of.parts.push_back({k, cords.D});
  }
  for (const RebarPlacement& rebar : element.rebars)
    of.cords.push_back(series(losses_.layers[rebar.layer].terms));
  return of;
}

/// Number of followed stresses in a section element.
int RollingHistory::rows(const Relaxing& of) const {
  return 6 * kPairs + 3 + kCordPairs * static_cast<int>(of.cords.size());
}

void RollingHistory::set_round(const Inflated& round) {
  const Ring& ring = elements_.ring();
  const int n = ring.mesh().nodes_per_sector(), alphas = ring.alphas_per_element();
  round_.resize(ring.widths());
  PointStresses S;
  for (int s = 0; s < ring.sectors(); ++s) {
    auto& of_width = round_[ring.width(s)];
    if (!of_width.empty()) continue;
    for (int e = 0; e < ring.elements_per_sector(); ++e) {
      Matrix38 u;
      for (int a = 0; a < 8; ++a) u.col(a) = round.u.col(ring.mesh().elements[e].node[a] % n);
      ElementBatch batch;
      batch.count = 1;
      batch.set(0,
                ring.in_element_frame(s, e, u),
                round.alpha.data() + static_cast<Eigen::Index>(e) * alphas,
                alphas);
      elements_.evaluate(s, e, 0.0, Stiffness::none, batch);  // alpha of this width
      relaxing_stresses(elements_.law(s, e), batch, S);
      of_width.emplace_back(rows(relaxing_[e]));
      take_means(S, 0, of_width.back());
    }
  }
}

void RollingHistory::set_spin(double Omega) {
  if (spin_ == Omega) return;
  const int m = elements_.ring().sectors();
  carry_.assign(series_.size(), Eigen::MatrixXd::Zero(m, m));
  for (std::size_t k = 0; k < series_.size(); ++k)
    for (const PronyTerm& term : series_[k]) {
      const Eigen::MatrixXd h = line_.history(term, Omega, spline_);
      for (int s = 0; s < m; ++s) carry_[k].col(s) += h.col(kPlacesPerSector * s);
    }
  spin_ = Omega;
  if (stiffened_at_ && std::abs(Omega - *stiffened_at_) <= kOtherSpin * std::abs(*stiffened_at_))
    return;
  stiffened_at_ = Omega;
  std::vector<double> stiffer;
  for (const PronyTerms& terms : series_)
    stiffer.push_back(relative_modulus(terms, kWavesOfTire * std::abs(Omega)).real() - 1.0);
  stiffen_by(std::move(stiffer));
}

void RollingHistory::stiffen_by(std::vector<double> stiffer) {
  stiffer_ = std::move(stiffer);
  const Element* const first = elements_.ring().mesh().elements.data();
  stiffened_.emplace(elements_, [&](const Element& element, ElementLaw& law) {
    stiffen(relaxing_[&element - first], law);
  });
  stiffened_->add_dead_stresses();
}

void RollingHistory::stiffen(const Relaxing& of, ElementLaw& law) const {
  if (of.rubber >= 0) {
    const double share = 1.0 + stiffer_[of.rubber];
    law.rubber.C10 *= share;
    law.rubber.C01 *= share;
    law.relaxation *= share;
  }
  for (const LinearPart& part : of.parts)
    Eigen::Map<Matrix6>(&law.D[0][0]) += stiffer_[part.series] * part.D;
  for (std::size_t k = 0; k < of.cords.size(); ++k) {
    if (of.cords[k] < 0) continue;
    const double share = 1.0 + stiffer_[of.cords[k]];
    law.cords[k].layer.E_tension *= share;
    law.cords[k].layer.E_compression *= share;
    law.cords[k].layer.pretension *= share;
  }
}

/// Sets the dead stresses to -m S.
void RollingHistory::set_still(const Relaxing& of,
                               const PointStresses& S,
                               int lanes,
                               PointStresses& dead) const {
  Matrix6 D = Matrix6::Zero();
  for (const LinearPart& part : of.parts) D += stiffer_[part.series] * part.D;
  const double m = of.rubber >= 0 ? stiffer_[of.rubber] : 0.0;
  for (int lane = 0; lane < lanes; ++lane) {
    for (int q = 0; q < 8; ++q) {
      Vector6 at;
      for (int r = 0; r < 6; ++r) at[r] = S.solid[q][r][lane];
      at = of.rubber >= 0 ? Vector6(m * at) : Vector6(D * at);
      for (int r = 0; r < 6; ++r) dead.solid[q][r][lane] = -at[r];
    }
    for (int j = 0; j < 3; ++j) dead.gradients[j][lane] = -m * S.gradients[j][lane];
    for (std::size_t k = 0; k < of.cords.size(); ++k) {
      const double share = of.cords[k] >= 0 ? stiffer_[of.cords[k]] : 0.0;
      for (int q = 0; q < 4; ++q) dead.cords[k][q][lane] = -share * S.cords[k][q][lane];
    }
  }
}

Eigen::MatrixXd RollingHistory::history(int element, const Eigen::MatrixXd& S) {
  constexpr int kSolid = 6 * kPairs;
  const Relaxing& of = relaxing_[element];
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(S.rows(), S.cols());
  if (of.rubber >= 0)
    H.topRows<kSolid + 3>().noalias() = S.topRows<kSolid + 3>() * carry_[of.rubber];
  for (const LinearPart& part : of.parts) {
    const Eigen::MatrixXd carried = S.topRows<kSolid>() * carry_[part.series];
    for (int pair = 0; pair < kPairs; ++pair)
      H.middleRows<6>(6 * pair).noalias() += part.D * carried.middleRows<6>(6 * pair);
  }
  for (std::size_t k = 0; k < of.cords.size(); ++k) {
    if (of.cords[k] < 0) continue;
    const Eigen::Index first = kSolid + 3 + kCordPairs * static_cast<Eigen::Index>(k);
    H.middleRows<kCordPairs>(first).noalias() =
        S.middleRows<kCordPairs>(first) * carry_[of.cords[k]];
  }
  return H;
}

/// Adds the history of the sectors of a group to their dead stresses.
void RollingHistory::add_history(const Relaxing& of,
                                 const Eigen::MatrixXd& H,
                                 RingElements::Sectors at,
                                 PointStresses& dead) const {
  for (int lane = 0; lane < at.count; ++lane) {
    const auto h = H.col(at.first + lane);
    Eigen::Index row = 0;
    for (const auto& [p, q] : kOnLine) {
      for (int r = 0; r < 6; ++r, ++row) {
        dead.solid[p][r][lane] += h[row];
        dead.solid[q][r][lane] += h[row];
      }
    }
    for (auto& gradient : dead.gradients) gradient[lane] += h[row++];
    for (std::size_t k = 0; k < of.cords.size(); ++k) {
      for (int pair = 0; pair < kCordPairs; ++pair, ++row) {
        dead.cords[k][kOnLine[pair].first][lane] += h[row];
        dead.cords[k][kOnLine[pair].second][lane] += h[row];
      }
    }
  }
}

void RollingHistory::update(const RingUnknowns& unknowns,
                            const AssembledState& state,
                            double Omega) {
  set_spin(Omega);
  follow(unknowns, state);
}

void RollingHistory::follow(const RingUnknowns& unknowns, const AssembledState& state) {
  const Ring& ring = elements_.ring();
  const int per_sector = ring.elements_per_sector(), alphas = ring.alphas_per_element();
  const auto groups = elements_.groups(ring.sectors());
  ElementBatch batch;
  PointStresses at;
  for (int e = 0; e < per_sector; ++e) {
    const Relaxing& of = relaxing_[e];
    if (of.is_elastic()) continue;
    Eigen::MatrixXd S(rows(of), ring.sectors());
    for (const auto& [first, count] : groups) {
      batch.count = count;
      for (int lane = 0; lane < count; ++lane)
        batch.set(lane,
                  unknowns.gather(first + lane, e, state.x),
                  state.alpha.data() + ((first + lane) * per_sector + e) * alphas,
                  alphas);
      relaxing_stresses(elements_.law(first, e), batch, at);
      set_still(of, at, count, stiffened_->dead(first, e));
      for (int lane = 0; lane < count; ++lane) {
        take_means(at, lane, S.col(first + lane));
        S.col(first + lane) -= round_[ring.width(first)][e];
      }
    }
    const Eigen::MatrixXd H = history(e, S);
    for (const RingElements::Sectors& group : groups)
      add_history(of, H, group, stiffened_->dead(group.first, e));
  }
}

}  // namespace latsch::fe_tire
