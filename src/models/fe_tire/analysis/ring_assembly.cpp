// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/ring_assembly.h"

#include "models/fe_tire/ring/sector.h"

namespace latsch::fe_tire {
namespace {

constexpr double kHeldStiffness =
    1e6;  // Diagonal value, N/m, of unknowns that symmetry holds at zero. No force acts on them.

/// Returns the diagonal entry of unknown `dof`.
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

AssembledState RingAssembly::zero_state() const {
  return {Eigen::VectorXd::Zero(unknowns_.size()),
          Eigen::VectorXd::Zero(ring_.alphas_per_element() * ring_.elements_per_sector() *
                                unknowns_.sectors())};
}

bool RingAssembly::assemble(const RingElements& elements,
                            AssembledState& state,
                            double pressure,
                            Eigen::VectorXd& f,
                            numerics::SymmetricMatrix* K,
                            int* worst) const {
  if (K == nullptr) return sum_elements(elements, state, pressure, &f, Stiffness::none, {}, worst);
  return sum_elements(elements, state, pressure, &f, Stiffness::exact, {{&unknowns_, K}}, worst);
}

bool RingAssembly::assemble_roughly(const RingElements& elements,
                                    AssembledState& state,
                                    double pressure,
                                    Eigen::VectorXd& f,
                                    numerics::SymmetricMatrix& K,
                                    int* worst) const {
  return sum_elements(elements, state, pressure, &f, Stiffness::rough, {{&unknowns_, &K}}, worst);
}

bool RingAssembly::assemble_tangent(const RingElements& elements,
                                    AssembledState& state,
                                    double pressure,
                                    const RingUnknowns& vibration,
                                    numerics::SymmetricMatrix& K,
                                    int* worst) const {
  return sum_elements(
      elements, state, pressure, nullptr, Stiffness::exact, {{&vibration, &K}}, worst);
}

bool RingAssembly::assemble_tangents(const RingElements& elements,
                                     AssembledState& state,
                                     double pressure,
                                     const std::vector<Vibration>& vibrations,
                                     int* worst) const {
  return sum_elements(elements, state, pressure, nullptr, Stiffness::exact, vibrations, worst);
}

bool RingAssembly::sum_elements(const RingElements& elements,
                                AssembledState& state,
                                double pressure,
                                Eigen::VectorXd* f,
                                Stiffness stiffness,
                                const std::vector<Vibration>& tangents,
                                int* worst) const {
  if (f) f->setZero(unknowns_.size());
  for (const Vibration& tangent : tangents) tangent.K->set_zero();
  const int per_sector = ring_.elements_per_sector(), alphas = ring_.alphas_per_element();
  const bool is_wanted = stiffness != Stiffness::none;
  ElementBatch batch;
  Vector24 fe;
  Matrix24 Ke, copy;
  for (const auto& [first, count] : elements.groups(unknowns_.sectors())) {
    batch.count = count;
    for (int e = 0; e < per_sector; ++e) {
      for (int lane = 0; lane < count; ++lane) {
        batch.set(lane,
                  unknowns_.gather(first + lane, e, state.x),
                  state.alpha.data() + ((first + lane) * per_sector + e) * alphas,
                  alphas);
      }
      const unsigned valid = elements.evaluate(first, e, pressure, stiffness, batch);
      for (int lane = 0; lane < count; ++lane) {
        const int s = first + lane, global = s * per_sector + e;
        if (!(valid >> lane & 1)) {
          if (worst) *worst = global;
          return false;
        }
        batch.take(
            lane, fe, is_wanted ? &Ke : nullptr, state.alpha.data() + global * alphas, alphas);
        if (f) unknowns_.add_forces(s, e, fe, *f);
        for (std::size_t k = 0; k < tangents.size(); ++k) {
          const bool is_last = k + 1 == tangents.size();
          Matrix24& own = is_last ? Ke : (copy = Ke);
          tangents[k].unknowns->bring_in_order(s, e, own);
          tangents[k].K->add_element(global, own.data());
        }
      }
    }
  }
  for (const Vibration& tangent : tangents) {
    for (int dof : tangent.unknowns->held()) diagonal(*tangent.K, dof) += kHeldStiffness;
  }
  return true;
}

numerics::SymmetricMatrix RingAssembly::mass(const RingElements& elements) const {
  numerics::SymmetricMatrix M(*pattern_);
  Vector24 no_force = Vector24::Zero();
  std::vector<std::vector<Matrix24>> of_width(ring_.widths());
  for (int s = 0, global = 0; s < unknowns_.sectors(); ++s) {
    std::vector<Matrix24>& masses = of_width[ring_.width(s)];
    for (int e = 0; e < ring_.elements_per_sector(); ++e, ++global) {
      if (static_cast<int>(masses.size()) == e) {
        masses.push_back(element_mass(ring_, elements.materials(), s, e));
        ring_.turn_to_node_frames(s, e, no_force, &masses.back());
      }
      Matrix24 Me = masses[e];
      unknowns_.bring_in_order(s, e, Me);
      M.add_element(global, Me.data());
    }
  }
  return M;
}

}  // namespace latsch::fe_tire
