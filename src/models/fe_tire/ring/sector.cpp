// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/ring/sector.h"

#include <algorithm>
#include <complex>
#include <numbers>

namespace latsch::fe_tire {

int sector_band(const Ring& ring) {
  int band = 0;
  for (int e = 0; e < ring.elements_per_sector(); ++e) {
    int lowest = ring.sector_unknowns(), highest = -1;
    for (int dof : ring.local_dofs(e)) {
      if (dof < 0) continue;
      lowest = std::min(lowest, dof % ring.sector_unknowns());
      highest = std::max(highest, dof % ring.sector_unknowns());
    }
    band = std::max(band, highest - lowest);
  }
  return band;
}

SectorBlocks::SectorBlocks(const Ring& ring)
    : sectors_(ring.sectors()),
      band_(sector_band(ring)),
      A_(Eigen::MatrixXd::Zero(2 * band_ + 1, ring.sector_unknowns())),
      B_(A_) {}

void SectorBlocks::set_zero() {
  A_.setZero();
  B_.setZero();
}

void SectorBlocks::add(const std::array<int, 24>& local_dofs, const Matrix24& K) {
  const int m = size();
  for (int q = 0; q < 24; ++q) {
    if (local_dofs[q] < 0) continue;
    const bool column_next = local_dofs[q] >= m;
    const int j = local_dofs[q] - (column_next ? m : 0);
    for (int p = 0; p < 24; ++p) {
      if (local_dofs[p] < 0) continue;
      const bool row_next = local_dofs[p] >= m;
      const int i = local_dofs[p] - (row_next ? m : 0);
      if (row_next == column_next) {
        A_(i - j + band_, j) += K(p, q);
      } else if (column_next) {
        B_(i - j + band_, j) += K(p, q);
      }
    }
  }
}

numerics::BandedHermitian SectorBlocks::harmonic(int n) const {
  const double phi = 2.0 * std::numbers::pi * n / sectors_;
  const std::complex<double> e = std::polar(1.0, phi);
  numerics::BandedHermitian K(size(), band_);
  for (int j = 0; j < size(); ++j) {
    const int last = std::min(size() - 1, j + band_);
    for (int i = j; i <= last; ++i) {
      K(i, j) =
          A_(i - j + band_, j) + B_(i - j + band_, j) * e + B_(j - i + band_, i) * std::conj(e);
    }
  }
  return K;
}

numerics::BandedHermitian SectorBlocks::harmonic_of_skew(int n) const {
  const double phi = 2.0 * std::numbers::pi * n / sectors_;
  const std::complex<double> i_unit(0.0, 1.0), e = std::polar(1.0, phi);
  numerics::BandedHermitian K(size(), band_);
  for (int j = 0; j < size(); ++j) {
    const int last = std::min(size() - 1, j + band_);
    for (int i = j; i <= last; ++i) {
      K(i, j) = i_unit * (A_(i - j + band_, j) + B_(i - j + band_, j) * e -
                          B_(j - i + band_, i) * std::conj(e));
    }
  }
  return K;
}

bool assemble_sector(const RingElements& elements,
                     const Eigen::VectorXd& x,
                     double pressure,
                     Eigen::VectorXd& alpha,
                     Eigen::VectorXd& f,
                     SectorBlocks* tangent,
                     int* worst) {
  const Ring& ring = elements.ring();
  const int alphas = ring.alphas_per_element();
  f.setZero(ring.sector_unknowns());
  if (tangent) tangent->set_zero();
  ElementBatch batch;
  batch.count = 1;
  const Stiffness stiffness = tangent ? Stiffness::exact : Stiffness::none;
  Vector24 fe;
  Matrix24 Ke;
  for (int e = 0; e < ring.elements_per_sector(); ++e) {
    double* alpha_e = alpha.data() + e * alphas;
    batch.set(0, ring.gather_axisymmetric(e, x), alpha_e, alphas);
    if (elements.evaluate(0, e, pressure, stiffness, batch) == 0) {
      if (worst) *worst = e;
      return false;
    }
    batch.take(0, fe, tangent ? &Ke : nullptr, alpha_e, alphas);
    const std::array<int, 24>& dofs = ring.local_dofs(e);
    for (int k = 0; k < 24; ++k) {
      if (dofs[k] >= 0) f[dofs[k] % ring.sector_unknowns()] += fe[k];
    }
    if (tangent) tangent->add(dofs, Ke);
  }
  return true;
}

Matrix24 element_mass(const Ring& ring, const Materials& materials, int sector, int element) {
  const Matrix8 m = mass(ring.shape(sector, element), materials, ring.mesh().elements[element]);
  Matrix24 M = Matrix24::Zero();
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < 8; ++b) M.block<3, 3>(3 * a, 3 * b).diagonal().setConstant(m(a, b));
  }
  return M;
}

SectorBlocks sector_mass(const RingElements& elements) {
  const Ring& ring = elements.ring();
  SectorBlocks M(ring);
  for (int e = 0; e < ring.elements_per_sector(); ++e) {
    Matrix24 Me = element_mass(ring, elements.materials(), 0, e);
    Vector24 no_force = Vector24::Zero();
    ring.turn_to_node_frames(0, e, no_force, &Me);
    M.add(ring.local_dofs(e), Me);
  }
  return M;
}

}  // namespace latsch::fe_tire
