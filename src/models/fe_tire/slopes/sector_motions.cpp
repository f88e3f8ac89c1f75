// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/slopes/sector_motions.h"

#include <algorithm>
#include <cassert>
#include <numbers>

namespace latsch::fe_tire {
namespace {

void set_lane(std::size_t lane, const Matrix38& u, double (&to)[24][ElementBatch::kLanes]) {
  for (int k = 0; k < 24; ++k) to[k][lane] = u.data()[k];
}

}  // namespace

SectorMotions::SectorMotions(const RingElements& elements,
                             const Inflated& at,
                             std::span<const HarmonicShape> modes)
    : elements_(elements),
      ring_(elements.ring()),
      at_(at),
      modes_(modes),
      x_(ring_.compress(at.u)) {
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const bool is_real = modes[i].phi.imag().isZero(0.0);
    parts_.push_back({i, false, is_real ? 1.0 : 0.5});
    if (!is_real) parts_.push_back({i, true, 0.5});
  }
  motions_.resize((parts_.size() + kLanes - 1) / kLanes, ElementMotion{});
  assert(modes.size() <= kMost);
}

std::size_t SectorMotions::lanes_of(std::size_t motion) const {
  return std::min(kLanes, parts_.size() - motion * kLanes);
}

void SectorMotions::set_batch(int element, ElementBatch& batch) const {
  const int alphas = ring_.alphas_per_element();
  const Matrix38 u = ring_.gather_axisymmetric(element, x_);
  batch.count = kLanes;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    batch.set(static_cast<int>(lane), u, at_.alpha.data() + element * alphas, alphas);
}

void SectorMotions::set_modes(int element) {
  const int unknowns = ring_.sector_unknowns();
  const auto& local = ring_.local_dofs(element);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const HarmonicShape& mode = modes_[parts_[p].mode];
    const std::complex<double> next = std::polar(1.0, mode.n * ring_.mesh().angle(1));
    Matrix38 u;
    for (int k = 0; k < 24; ++k) {
      std::complex<double> phi = local[k] < 0 ? 0.0 : mode.phi[local[k] % unknowns];
      if (local[k] >= unknowns) phi *= next;
      u.data()[k] = parts_[p].is_imaginary ? phi.imag() : phi.real();
    }
    set_lane(p % kLanes, ring_.in_element_frame(0, element, u), motions_[p / kLanes].mode);
  }
}

void SectorMotions::set_along(int element, const Eigen::MatrixXd& along) {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Eigen::VectorXd zeta = along.col(static_cast<Eigen::Index>(parts_[p].mode));
    set_lane(p % kLanes,
             parts_[p].share * ring_.gather_axisymmetric(element, zeta),
             motions_[p / kLanes].along);
  }
}

void SectorMotions::keep_alphas() {
  for (const ElementMotion& motion : motions_) {
    Alphas& to = alphas_.emplace_back();
    std::copy_n(&motion.mode_alpha[0][0], 8 * kLanes, &to.mode[0][0]);
    std::copy_n(&motion.second_alpha[0][0], 8 * kLanes, &to.second[0][0]);
  }
}

void SectorMotions::recall_alphas(int element) {
  for (std::size_t m = 0; m < motions_.size(); ++m) {
    const Alphas& from = alphas_[static_cast<std::size_t>(element) * motions_.size() + m];
    std::copy_n(&from.mode[0][0], 8 * kLanes, &motions_[m].mode_alpha[0][0]);
    std::copy_n(&from.second[0][0], 8 * kLanes, &motions_[m].second_alpha[0][0]);
  }
}

bool SectorMotions::curvatures(Eigen::MatrixXd& g) {
  g.setZero(ring_.sector_unknowns(), std::ssize(modes_));
  alphas_.clear();
  ElementBatch batch;
  for (int e = 0; e < ring_.elements_per_sector(); ++e) {
    set_batch(e, batch);
    set_modes(e);
    ElementSurroundings around = elements_.surroundings(0, e);
    if (ring_.mesh().elements[e].inner) around.pressure = at_.pressure;
    if (!add_curvatures(elements_.law(0, e), around, batch, motions_)) return false;
    keep_alphas();
    const auto& local = ring_.local_dofs(e);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const auto& curvature = motions_[p / kLanes].curvature;
      for (int k = 0; k < 24; ++k) {
        if (local[k] < 0) continue;
        g(local[k] % ring_.sector_unknowns(), static_cast<Eigen::Index>(parts_[p].mode)) +=
            curvature[k][p % kLanes];
      }
    }
  }
  return true;
}

bool SectorMotions::slopes(const Eigen::MatrixXd& along,
                           const std::vector<MovedNumber>& numbers,
                           Eigen::MatrixXd& sums) {
  assert(along.cols() == std::ssize(modes_) && !alphas_.empty());
  sums.setZero(std::ssize(modes_), std::ssize(numbers));
  const auto add = [&](std::size_t m, std::size_t k, const double(&lanes)[kLanes]) {
    for (std::size_t lane = 0; lane < lanes_of(m); ++lane) {
      const auto mode = static_cast<Eigen::Index>(parts_[m * kLanes + lane].mode);
      sums(mode, static_cast<Eigen::Index>(k)) += lanes[lane];
    }
  };
  const auto add_mass = [&](std::size_t m, std::size_t k, const double(&lanes)[kLanes]) {
    for (std::size_t lane = 0; lane < lanes_of(m); ++lane) {
      const std::size_t mode = parts_[m * kLanes + lane].mode;
      const double omega = 2.0 * std::numbers::pi * modes_[mode].frequency;
      sums(static_cast<Eigen::Index>(mode), static_cast<Eigen::Index>(k)) -=
          omega * omega * lanes[lane];
    }
  };
  ElementBatch batch;
  FeltNumbers felt;
  for (int e = 0; e < ring_.elements_per_sector(); ++e) {
    felt.find(0, e, numbers);
    if (felt.elements.empty() && felt.masses.empty()) continue;
    set_batch(e, batch);
    set_modes(e);
    set_along(e, along);
    recall_alphas(e);
    sum_masses(0, e, felt, numbers, motions_, add_mass);
    if (felt.elements.empty()) continue;
    const unsigned open_edges = elements_.surroundings(0, e).open_edges;
    if (!sum_differences(elements_.law(0, e), open_edges, felt, numbers, batch, motions_, add))
      return false;
  }
  return true;
}

}  // namespace latsch::fe_tire
