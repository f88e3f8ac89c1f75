// SPDX-License-Identifier: Apache-2.0
// Forces of the history that the rubber and the cords of a rolling tire carry along streamlines.
//
// At a state (u, alpha, Omega) the relaxed stresses S of all points give the history H by (H.2) of
// streamlines.h, and H acts beside S in every element:
//   f(u) = sum of B^T (S + H) dV,   sum of P^T (S + H) dV = 0 for alpha.                      (H.5)
// A streamline has one point a sector: S is the mean of the two Gauss points that the section's
// point has in a sector, and H acts on both. Between them assumed strains vary as in one element;
// their steps at the borders of sectors would be losses of waves as short as a sector, of first
// order in its width. Stresses count from those of a round state on the same mesh (the inflated
// tire): where sectors of different width meet, a round tire's stresses step by the second order
// of the width. A tire that stays round therefore has no history.
//   Between the sectors' points S follows the spline of sector_spline.h.
//   What relaxes is the isochoric stress of rubber, the stiffness of three enhanced strains that is
// the rubber's (hex8_solid_shell_kernel.h), the parts of a solid with smeared cords, and the
// stress of cord layers (loss_materials.h).
//
// Newton's method needs a tangent that knows the history. (H.2) is linear in S, so the history of
// all points of a streamline is one matrix times their stresses; it couples all sectors. Here every
// law is stiffened by the storage modulus m of a wave of low number, and the rest is dead:
//   S + H = (1 + m) S(E) + [H - m S(E_0)],   E_0: strains of the last update().
// The tangent is then symmetric and has the pattern of K. Iterated with updates, Newton's method
// converges linearly, by about the share by which the storage moduli of the waves in the tire
// differ from 1 + m, and any m leads to the same state.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/history/streamlines.h"
#include "models/fe_tire/ring/ring_elements.h"

namespace latsch::fe_tire {

class RollingHistory {
 public:
  /// Keeps a reference to the elements of the whole ring. `round`: the inflated tire, from which
  /// stresses count.
  RollingHistory(const RingElements& elements, LossMaterials losses, const Inflated& round);
  virtual ~RollingHistory() = default;

  /// Computes the history of a state whose material passes with Omega, rad/s.
  void update(const RingUnknowns& unknowns, const AssembledState& state, double Omega);
  /// Returns the elements with stiffened laws and with the rest of the history as dead stresses, of
  /// the last update().
  const RingElements& elements() const { return *stiffened_; }

 protected:
  static constexpr int kPairs = 4, kCordPairs = 2;  // streamlines of an element and of a layer
  /// The relaxing stress D E of a linear solid at the strain E.
  struct LinearPart {
    int series;
    Matrix6 D;
  };
  /// Relaxing stresses of a section element; -1: none.
  struct Relaxing {
    int rubber = -1;
    std::vector<LinearPart> parts;
    std::vector<int> cords;  // series of each layer
    bool is_elastic() const;
  };

  /// Returns the histories of the followed stresses S [rows x sectors] of a section element; those
  /// of a linear solid are strains.
  virtual Eigen::MatrixXd history(int element, const Eigen::MatrixXd& S);
  /// Takes the stresses of a state, and adds their histories to the dead stresses.
  void follow(const RingUnknowns& unknowns, const AssembledState& state);
  /// Sets m of each series.
  void stiffen_by(std::vector<double> stiffer);

  const RingElements& elements_;
  std::vector<PronyTerms> series_;  // those that differ
  std::vector<Relaxing> relaxing_;  // one for each section element
  std::vector<double> stiffer_;     // m of each series

 private:
  int series(const PronyTerms& terms);
  Relaxing relaxing(const Element& element);
  int rows(const Relaxing& of) const;
  void set_round(const Inflated& round);
  void set_spin(double Omega);
  void stiffen(const Relaxing& of, ElementLaw& law) const;
  void set_still(const Relaxing& of, const PointStresses& S, int lanes, PointStresses& dead) const;
  void add_history(const Relaxing& of,
                   const Eigen::MatrixXd& H,
                   RingElements::Sectors at,
                   PointStresses& dead) const;

  LossMaterials losses_;
  Streamline line_;         // places of spline_
  Eigen::MatrixXd spline_;  // stresses at these places by those of sectors [sectors x places]
  std::vector<std::vector<Eigen::VectorXd>> round_;  // stresses [width][section element]
  // These belong to the current spin.
  std::optional<double> spin_, stiffened_at_;
  std::vector<Eigen::MatrixXd> carry_;  // H = S carry, [sectors x sectors] for each series
  std::optional<RingElements> stiffened_;
};

}  // namespace latsch::fe_tire
