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
// method on this equation costs one small dense factorization per iteration and no evaluation of
// the elements, so the number of such evaluations depends only on the nonlinearity of the elements.
// If the ground's forces depend only on the nodes' heights above flat ground, the nodes' horizontal
// unknowns are eliminated, too. Then (L.1) is piecewise linear and is solved in finitely many
// iterations.
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
  /// `whole`: an elimination order of the pattern. `tread` must outlive this object.
  LinearTire(const numerics::SymmetricPattern& pattern,
             const numerics::Elimination& whole,
             const TreadSurface& tread);

  /// Factorizes K, which must not contain the ground's stiffness. `contact` is that of the
  /// following steps; null if there is none. Returns false if K is not positive definite while the
  /// nodes on which the ground may act are held.
  bool factorize(const numerics::SymmetricMatrix& K, const TreadContact* contact);
  /// Frees the memory of the factorization.
  void release() { factor_.release(); }
  /// Returns true if the factorization can be used with this contact.
  bool serves(const TreadContact* contact) const;

  /// Computes d of (L.1) on this ground at the state x with the residual f = g + c. Returns false
  /// if tire and ground together are not positive definite.
  bool step(const TreadContact* contact,
            const Eigen::VectorXd& x,
            const Eigen::VectorXd& f,
            Eigen::VectorXd& d);

  /// Moves the ground from an equilibrium x, with the elements' forces g, through `poses` to its
  /// present pose, solving (L.1) at each pose. The contact then starts from the last pose, with the
  /// friction anchors of the path. Returns false if tire and ground together are not positive
  /// definite. The factorization approximates K in single precision; its error is corrected along
  /// the path.
  bool follow(const numerics::SymmetricMatrix& K,
              TreadContact& contact,
              const Eigen::VectorXd& x,
              const Eigen::VectorXd& g,
              const std::vector<GroundPose>& poses);

  /// The residual r of (L.1) at the last step's d with another K is computed here. The following
  /// functions serve to solve the linear equation of its correction, (K + dc/dx) e = r, with the
  /// contact of the last step.
  Eigen::VectorXd residual(const numerics::SymmetricMatrix& K, const Eigen::VectorXd& d) const;
  void multiply(const numerics::SymmetricMatrix& K,
                const Eigen::VectorXd& v,
                Eigen::VectorXd& Kv) const;
  /// Computes v <- (K + dc/dx)^-1 v with the factorized K.
  void precondition(Eigen::VectorXd& v) const;

  /// Returns true if the ground's tangent at the last step is symmetric.
  bool is_symmetric() const { return kept_ == 1 || tangent_.is_symmetric(); }

  /// The factorization, which also holds the elimination order.
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
  int n_;         // number of nodes on the tread's surface
  int kept_ = 3;  // number of directions per node that are not eliminated: 1 (vertical) or 3
  /// Axes of every node as columns: two horizontal directions, then the vertical.
  std::vector<Eigen::Matrix3d> Q_;
  /// Factor of the nodes' horizontal unknowns, two per node; below it their coupling with the
  /// heights.
  Eigen::MatrixXd A_;
  // Condensed stiffness in all directions of the nodes that the ground may reach.
  CondensedTire by_nodes_;
  std::vector<char> is_reached_;  // for every point of the tread: true if the ground may reach it
  // Row of the first direction of every node that the ground may reach, in by_nodes_; -1 for other
  // nodes.
  std::vector<int> first_row_;
  GroundTangent tangent_;  // derivative dc/dw at the last step, in all directions
  Eigen::MatrixXd S_;      // condensed stiffness for the heights
  // Derivative dc/dw at the last step for the heights, and the factor of S + C.
  Eigen::MatrixXd C_, L_;
  // Touching points of the last step and their stiffness. If not set, L_ is a factor of another S.
  std::optional<std::vector<std::pair<int, double>>> springs_;
  Eigen::Matrix3Xd u_;     // displacements of the nodes at the last step
  Eigen::VectorXd ahead_;  // first guess of w for the step after a path
  // Displacement of the nodes in the last step, with reversed sign; g of that step.
  Eigen::VectorXd w_, g_;
  Eigen::VectorXd c_;  // forces of the ground at the end of the last step
};

}  // namespace latsch::fe_tire
