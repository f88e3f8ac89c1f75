// SPDX-License-Identifier: Apache-2.0
// The tire as a linear structure on nonlinear ground: the problem that each iteration of Newton's
// method solves.
//
// The residual is split into g of elements and pressure and c of the ground, which acts only on the
// nodes of the tread's surface (tread_surface.h). With the tangent K of g factorized at this or an
// earlier state, the equation
//
//            g - K d + c(u(x - d)) = 0                                                        (L.1)
//
// is solved exactly, including points that come down, lift off, stick or slide. All other nodes are
// eliminated once per factorization:  S w = g' + c(u - w),  S dense (condensed_tire.h). Newton's
// method on this equation costs a small dense factorization an iteration and no pass over the
// elements, so an equilibrium needs only as many such passes as the elements' nonlinearity
// requires. If forces depend on heights over flat ground alone, the nodes' two other directions are
// eliminated too and (L.1) is piecewise linear: it is solved after finitely many iterations.
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
  /// `whole`: an order of elimination of the pattern. `tread` must outlive this object.
  LinearTire(const numerics::SymmetricPattern& pattern,
             const numerics::Elimination& whole,
             const TreadSurface& tread);

  /// Factorizes K, which must not contain the ground. `contact` is that of the following steps,
  /// null if there is none. Returns false if K (with the nodes that the ground feels held) is not
  /// positive definite.
  bool factorize(const numerics::SymmetricMatrix& K, const TreadContact* contact);
  /// Frees the factor's memory.
  void release() { factor_.release(); }
  /// True if the factor can be used with this contact.
  bool serves(const TreadContact* contact) const;

  /// Computes d of (L.1) on this ground at the state x with the residual f = g + c. Returns false
  /// if tire and ground together are not positive definite.
  bool step(const TreadContact* contact,
            const Eigen::VectorXd& x,
            const Eigen::VectorXd& f,
            Eigen::VectorXd& d);

  /// Follows the ground from an equilibrium x with the elements' forces g to its present pose,
  /// through `poses`, each by (L.1). The contact then starts from the last of them, with the
  /// anchors of the path. Returns false if tire and ground together are not positive definite. The
  /// factor is an approximation of K in single precision; its error is corrected along the path.
  bool follow(const numerics::SymmetricMatrix& K,
              TreadContact& contact,
              const Eigen::VectorXd& x,
              const Eigen::VectorXd& g,
              const std::vector<GroundPose>& poses);

  /// Residual of (L.1) at the last step's d with another K, and the linear equations of its
  /// correction, (K + dc/dx) e = r, with the contact of the last step.
  Eigen::VectorXd residual(const numerics::SymmetricMatrix& K, const Eigen::VectorXd& d) const;
  void multiply(const numerics::SymmetricMatrix& K,
                const Eigen::VectorXd& v,
                Eigen::VectorXd& Kv) const;
  /// Applies v <- (K + dc/dx)^-1 v with the K of the factor.
  void precondition(Eigen::VectorXd& v) const;

  /// True if the ground's tangent at the last step is symmetric.
  bool is_symmetric() const { return kept_ == 1 || tangent_.is_symmetric(); }

  /// Factorization, which also holds the order of elimination.
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
  int n_;         // number of nodes of the tread's surface
  int kept_ = 3;  // directions of each node that are not eliminated: 1 (up) or 3
  /// Axes of every node: two directions across the vertical, then the vertical.
  std::vector<Eigen::Matrix3d> Q_;
  /// Factor of the nodes' unknowns across the vertical, two a node, and below it their coupling
  /// with the heights.
  Eigen::MatrixXd A_;
  CondensedTire by_nodes_;        // all directions of the nodes that the ground may reach
  std::vector<char> is_reached_;  // for every point of the tread
  std::vector<int> first_row_;    // for every node within reach, -1: beyond reach
  GroundTangent tangent_;         // dc/dw of the last step, all directions
  Eigen::MatrixXd S_;             // condensed stiffness of the heights
  Eigen::MatrixXd C_, L_;         // dc/dw of the last step by heights, factor of S + C
  // Points in contact in the last step, and their stiffness. Unset: L_ is a factor of another S.
  std::optional<std::vector<std::pair<int, double>>> springs_;
  Eigen::Matrix3Xd u_;     // displacements of the nodes at the last step
  Eigen::VectorXd ahead_;  // first guess of w for the step after a path was followed
  Eigen::VectorXd w_, g_;  // the nodes' displacement in the last step, reversed; and g of that step
  Eigen::VectorXd c_;      // the forces of the ground at the end of the last step
};

}  // namespace latsch::fe_tire
