// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/ring_assembly.h"

#include "models/fe_tire/sector.h"

namespace latsch::fe_tire {
namespace {

std::vector<std::vector<int>> connectivity(const Ring& ring) {
  std::vector<std::vector<int>> dofs;
  dofs.reserve(ring.mesh().element_count());
  for (int s = 0; s < ring.sectors(); ++s) {
    for (int e = 0; e < ring.elements_per_sector(); ++e) {
      const std::array<int, 24> d = ring.dofs(s, e);
      dofs.emplace_back(d.begin(), d.end());
    }
  }
  return dofs;
}

}  // namespace

RingAssembly::RingAssembly(const Ring& ring)
    : ring_(ring), pattern_(ring.unknowns(), connectivity(ring)) {}

bool RingAssembly::assemble(const Materials& materials,
                            RingState& state,
                            double pressure,
                            const GroundContact* contact,
                            bool stuck,
                            Eigen::VectorXd& f,
                            numerics::SymmetricMatrix* K,
                            int* worst) const {
  f.setZero(ring_.unknowns());
  if (K) K->set_zero();
  Vector24 fe;
  Matrix24 Ke;
  Matrix24* Ke_wanted = K ? &Ke : nullptr;
  for (int s = 0, global = 0; s < ring_.sectors(); ++s) {
    for (int e = 0; e < ring_.elements_per_sector(); ++e, ++global) {
      const Matrix38 u = ring_.gather(s, e, state.x);
      double* alpha = state.alpha.data() + global * ring_.alphas_per_element();
      if (!pressurized_element(ring_, materials, e, u, pressure, alpha, fe, Ke_wanted)) {
        if (worst) *worst = global;
        return false;
      }
      if (contact) contact->add(s, e, u, stuck, fe, Ke_wanted);
      ring_.turn_to_node_frames(e, fe, Ke_wanted);
      const std::array<int, 24> dofs = ring_.dofs(s, e);
      for (int k = 0; k < 24; ++k) {
        if (dofs[k] >= 0) f[dofs[k]] += fe[k];
      }
      if (K) K->add_element(global, Ke.data());
    }
  }
  return true;
}

numerics::SymmetricMatrix RingAssembly::mass(const Materials& materials) const {
  numerics::SymmetricMatrix M(pattern_);
  std::vector<Matrix24> of_sector;
  for (int e = 0; e < ring_.elements_per_sector(); ++e) {
    of_sector.push_back(mass_in_node_frames(ring_, materials, e));
  }
  for (int s = 0, global = 0; s < ring_.sectors(); ++s) {
    for (int e = 0; e < ring_.elements_per_sector(); ++e, ++global) {
      M.add_element(global, of_sector[e].data());
    }
  }
  return M;
}

}  // namespace latsch::fe_tire
