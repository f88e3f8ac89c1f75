// SPDX-License-Identifier: Apache-2.0
// The tire as a linear structure on ground that is not: what Newton's method asks at every
// iteration.
//
// With the residual split into g of elements and pressure and c of the ground, which acts on the
// nodes of the tread's surface alone (tread_surface.h), and the tangent K of g factorized at this
// or an earlier state,
//
//   solve    g - K d + c(u(x - d)) = 0                                                        (L.1)
//
// exactly, points that come down, lift off, stick or slide included. Everything but these nodes is
// eliminated once a factor:  S w = g' + c(u - w),  S dense (condensed_tire.h). Newton's method on
// it costs a small dense factor an iteration and no pass over the elements: an equilibrium needs
// as many of those as the elements need. Where forces depend on heights over flat ground alone,
// the nodes' two other directions are eliminated too and (L.1) is piecewise linear: it ends after
// finitely many iterations.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "models/fe_tire/analysis/condensed_tire.h"
#include "models/fe_tire/contact/contact.h"
#include "numerics/sparse/factorization.h"

namespace latsch::fe_tire {

class LinearTire {
 public:
  /// `whole`: an order of elimination of the pattern. `tread` must outlive it.
  LinearTire(const numerics::SymmetricPattern& pattern,
             const numerics::Elimination& whole,
             const TreadSurface& tread);

  /// Takes K, which has nothing of the ground; `contact`: that of the steps that follow, null where
  /// there is none. False where K (with the nodes that the ground feels held) is not positive
  /// definite.
  bool factorize(const numerics::SymmetricMatrix& K, const TreadContact* contact);
  /// Gives the factor's memory back.
  void release() { factor_.release(); }
  /// Whether the factor serves this contact.
  bool serves(const TreadContact* contact) const;

  /// d of (L.1) on this ground at the state x with the residual f = g + c. False where tire and
  /// ground together are not positive definite.
  bool step(const TreadContact* contact,
            const Eigen::VectorXd& x,
            const Eigen::VectorXd& f,
            Eigen::VectorXd& d);

  /// Follows the ground from an equilibrium x with the elements' forces g to where it is, through
  /// `poses`, each by (L.1): the contact then starts from the last of them, with the anchors of the
  /// way there. False where tire and ground together are not positive definite.
  /// The factor, in single precision, is of K; what it is off by is made up for on the way.
  bool follow(const numerics::SymmetricMatrix& K,
              TreadContact& contact,
              const Eigen::VectorXd& x,
              const Eigen::VectorXd& g,
              const std::vector<GroundPose>& poses);

  /// What is left of (L.1) at the last step's d with another K, and the linear equations of its
  /// correction, (K + dc/dx) e = r: contact is that of the last step.
  Eigen::VectorXd residual(const numerics::SymmetricMatrix& K, const Eigen::VectorXd& d) const;
  void multiply(const numerics::SymmetricMatrix& K,
                const Eigen::VectorXd& v,
                Eigen::VectorXd& Kv) const;
  /// v <- (K + dc/dx)^-1 v of the factor's K
  void precondition(Eigen::VectorXd& v) const;

  /// Whether the ground's tangent at the last step is symmetric.
  bool is_symmetric() const { return kept_ == 1 || tangent_.is_symmetric(); }

  /// Order of elimination.
  const numerics::Factorization& factor() const { return factor_; }

 private:
  bool condense_to_heights();
  Eigen::VectorXd reduce(Eigen::VectorXd& v) const;
  void expand(const Eigen::VectorXd& w, Eigen::VectorXd& v) const;
  Eigen::Matrix3Xd moved_back(const Eigen::VectorXd& w) const;
  Eigen::VectorXd forces_by_nodes(const TreadContact& contact, const Eigen::VectorXd& w) const;
  Eigen::VectorXd forces_within_reach(const TreadContact& contact,
                                      const Eigen::VectorXd& w,
                                      GroundTangent* tangent) const;
  Eigen::VectorXd beyond_reach_too(const Eigen::VectorXd& w) const;
  bool touch_by_heights(const TreadContact& contact, const Eigen::VectorXd& g);
  bool reach(const std::vector<int>& points);
  bool reaches(const std::vector<int>& points) const;
  bool reach_likely(const TreadContact& contact, const Eigen::VectorXd& w);
  bool touch_by_nodes(const TreadContact& contact, const Eigen::VectorXd& g, Eigen::VectorXd& w);
  bool touch_within_reach(const TreadContact& contact,
                          const Eigen::VectorXd& g,
                          Eigen::VectorXd& w);
  bool factorize_contact(const Eigen::MatrixXd& stiffness);
  void solve_contact(Eigen::VectorXd& v) const;
  void add_at_nodes(double factor, const Eigen::VectorXd& w, Eigen::VectorXd& v) const;
  Eigen::VectorXd at_nodes(const Eigen::VectorXd& v) const;

  const TreadSurface& tread_;
  numerics::Factorization factor_;
  bool on_ground_ = false;
  int n_;         // nodes of the tread's surface
  int kept_ = 3;  // directions of each of them that are not eliminated: 1, up, or 3
  std::vector<Eigen::Matrix3d> Q_;  // of every node: two directions across the vertical, then it
  Eigen::MatrixXd A_;  // of its unknowns, two across the vertical a node, then the heights: factor
                       // of the former, and what couples them with the latter
  CondensedTire by_nodes_;        // of all directions: what the ground may reach
  std::vector<char> is_reached_;  // every point of the tread
  std::vector<int> first_row_;    // of every node within reach, -1: it is beyond
  GroundTangent tangent_;         // dc/dw of the last step, all directions
  Eigen::MatrixXd S_;             // of heights
  Eigen::MatrixXd C_, L_;         // dc/dw of the last step by heights, factor of S + C
  // Points in contact there, and their stiffness; none: L_ is of another S.
  std::optional<std::vector<std::pair<int, double>>> springs_;
  Eigen::Matrix3Xd u_;     // where nodes were at the last step
  Eigen::VectorXd ahead_;  // where to look for w first, of the step after a way that was followed
  Eigen::VectorXd w_, g_;  // how far it moved them back, g
  Eigen::VectorXd c_;      // of the ground at its end
};

}  // namespace latsch::fe_tire
