// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/ring_assembly.h"

#include "models/fe_tire/ring/sector.h"

namespace latsch::fe_tire {
namespace {

constexpr double kHeldStiffness =
    1e6;  // N/m on unknowns that symmetry holds at zero: no force acts on them

/// Diagonal value of unknown `dof`.
double& diagonal(numerics::SymmetricMatrix& A, int dof) {
  const int block = A.pattern().block_size();
  const int start = A.pattern().find(dof / block, dof / block);
  return A.values()[start + (dof % block) * (block + 1)];
}

}  // namespace

RingAssembly::RingAssembly(const RingUnknowns& unknowns, const TreadSurface* tread)
    : unknowns_(unknowns), ring_(unknowns.ring()) {
  std::vector<std::vector<int>> lists = unknowns.connectivity();
  if (tread) {
    for (std::vector<int>& point : tread->connectivity()) lists.push_back(std::move(point));
  }
  pattern_ = std::make_shared<numerics::SymmetricPattern>(unknowns.size(), lists);
}

RingAssembly::RingAssembly(const RingUnknowns& unknowns,
                           std::shared_ptr<const numerics::SymmetricPattern> pattern)
    : unknowns_(unknowns), ring_(unknowns.ring()), pattern_(std::move(pattern)) {}

RingState RingAssembly::zero_state() const {
  return {Eigen::VectorXd::Zero(unknowns_.size()),
          Eigen::VectorXd::Zero(ring_.alphas_per_element() * ring_.elements_per_sector() *
                                unknowns_.sectors())};
}

bool RingAssembly::assemble(const RingElements& elements,
                            RingState& state,
                            double pressure,
                            Eigen::VectorXd& f,
                            numerics::SymmetricMatrix* K,
                            int* worst) const {
  f.setZero(unknowns_.size());
  return sum_elements(elements, state, pressure, unknowns_, f, K, worst);
}

bool RingAssembly::assemble_tangent(const RingElements& elements,
                                    RingState& state,
                                    double pressure,
                                    const RingUnknowns& vibration,
                                    numerics::SymmetricMatrix& K,
                                    int* worst) const {
  Eigen::VectorXd unused = Eigen::VectorXd::Zero(unknowns_.size());
  return sum_elements(elements, state, pressure, vibration, unused, &K, worst);
}

bool RingAssembly::sum_elements(const RingElements& elements,
                                RingState& state,
                                double pressure,
                                const RingUnknowns& rows,
                                Eigen::VectorXd& f,
                                numerics::SymmetricMatrix* K,
                                int* worst) const {
  if (K) K->set_zero();
  const int per_sector = ring_.elements_per_sector(), alphas = ring_.alphas_per_element();
  ElementBatch batch;
  Vector24 fe;
  Matrix24 Ke;
  Matrix24* Ke_wanted = K ? &Ke : nullptr;
  for (const auto& [first, count] : elements.groups(unknowns_.sectors())) {
    batch.count = count;
    for (int e = 0; e < per_sector; ++e) {
      for (int lane = 0; lane < count; ++lane) {
        batch.set(lane,
                  unknowns_.gather(first + lane, e, state.x),
                  state.alpha.data() + ((first + lane) * per_sector + e) * alphas,
                  alphas);
      }
      const unsigned valid = elements.evaluate(first, e, pressure, K != nullptr, batch);
      for (int lane = 0; lane < count; ++lane) {
        const int s = first + lane, global = s * per_sector + e;
        if (!(valid >> lane & 1)) {
          if (worst) *worst = global;
          return false;
        }
        batch.take(lane, fe, Ke_wanted, state.alpha.data() + global * alphas, alphas);
        rows.scatter(s, e, fe, Ke_wanted, f);
        if (K) K->add_element(global, Ke.data());
      }
    }
  }
  if (K) {
    for (int dof : rows.held()) diagonal(*K, dof) += kHeldStiffness;
  }
  return true;
}

numerics::SymmetricMatrix RingAssembly::mass(const RingElements& elements) const {
  numerics::SymmetricMatrix M(*pattern_);
  Vector24 no_force = Vector24::Zero();
  Eigen::VectorXd unused = Eigen::VectorXd::Zero(unknowns_.size());
  std::vector<std::vector<Matrix24>> of_width(ring_.widths());
  for (int s = 0, global = 0; s < unknowns_.sectors(); ++s) {
    std::vector<Matrix24>& masses = of_width[ring_.width(s)];
    for (int e = 0; e < ring_.elements_per_sector(); ++e, ++global) {
      if (static_cast<int>(masses.size()) == e) {
        masses.push_back(element_mass(ring_, elements.materials(), s, e));
        ring_.turn_to_node_frames(s, e, no_force, &masses.back());
      }
      Matrix24 Me = masses[e];
      unknowns_.scatter(s, e, no_force, &Me, unused);
      M.add_element(global, Me.data());
    }
  }
  return M;
}

}  // namespace latsch::fe_tire
