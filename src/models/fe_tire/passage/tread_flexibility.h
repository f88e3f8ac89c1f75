// SPDX-License-Identifier: Apache-2.0
// The tread of a tire that is linear within a step of time, as a body that rolls
// (rolling_contact.h), by its flexibility F in place of the stiffness of tread_body.h:
//
//   R(f) = f - c(u + F (f - g)),   dR/df = 1 - C F,   C = dc/du                              (V.12)
// f: forces that the nodes of the tread carry, the unknowns of the search; g: those that they carry
// at the displacements u; c: the forces of the ground. F may be unsymmetric. C has rows and columns
// of the nodes below points that touch alone, so each solution is of their size: nothing is
// eliminated, and the factorization is a tenth of that with all nodes below which the ground is
// near. A load is carried by the height, the unknown behind f: the rise of the wheel center, m,
// moves all nodes along the ground's z.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "models/fe_tire/rolling/tread_body.h"

namespace latsch::fe_tire {

class FlexibleTread : public RollingBody {
 public:
  /// `body`: points at the displacements u. `F`: [3 nodes x 3 nodes], m/N, in single precision,
  /// which is enough for changes within a step. `g`: N, three numbers a node of the tread. Body and
  /// F must outlive the object. `load`, N, that the height has to carry; none: the height is held.
  FlexibleTread(TreadBody& body,
                const Eigen::MatrixXf& F,
                const Eigen::VectorXd& g,
                std::optional<double> load);

  /// Returns g on the rows of the body, at which a search begins, with no rise unless the load asks
  /// for one, because nothing touches.
  Eigen::VectorXd start() const;
  /// Returns the rise of the wheel center, m.
  double rise(const Eigen::VectorXd& f) const { return load_ ? f[size()] : 0.0; }
  /// Returns the change F (f - g) of the displacements of all nodes of the tread, m.
  Eigen::VectorXd moved(const Eigen::VectorXd& f) const;
  /// Returns this change with the rise on the rows of the body, in the axes of the ground.
  Eigen::VectorXd moved_rows(const Eigen::VectorXd& f) const;

  RollingInput input(const Eigen::VectorXd& f) const override;
  Eigen::VectorXd residual(const Eigen::VectorXd& f,
                           const RollingInput& input,
                           const GripTractions& tractions) const override;
  bool solve(const Eigen::VectorXd& f,
             const RollingInput& input,
             const GripTractions& tractions,
             const Eigen::VectorXd& R,
             Eigen::VectorXd& df) override;
  double force_scale() const override { return body_.force_scale(); }

 private:
  Eigen::Index size() const { return std::ssize(body_.rows()); }
  double along_z(const std::vector<int>& rows, const Eigen::VectorXd& forces) const;
  Eigen::VectorXd by_forces(const std::vector<int>& rows, const Eigen::VectorXd& forces) const;

  TreadBody& body_;
  const Eigen::MatrixXf& F_;
  const Eigen::VectorXd& g_;
  std::optional<double> load_;
  Eigen::VectorXd up_;      // the ground's z at each node, in the axes of its unknowns
  Eigen::VectorXd beyond_;  // m, part of the change by forces beyond the body's rows
};

}  // namespace latsch::fe_tire
