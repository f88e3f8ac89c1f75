// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/slopes/ring_motions.h"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <numeric>

namespace latsch::fe_tire {
namespace {

constexpr int kLanes = ElementBatch::kLanes;
constexpr int kAlphas = 8 * kLanes;

void set_lane(int lane, const Matrix38& u, double (&to)[24][kLanes]) {
  for (int k = 0; k < 24; ++k) to[k][lane] = u.data()[k];
}

}  // namespace

RingMotions::RingMotions(const RingUnknowns& unknowns,
                         const RingElements& elements,
                         const Eigen::VectorXd& x,
                         const Eigen::VectorXd& alpha,
                         double pressure,
                         const std::vector<Mode>& modes)
    : unknowns_(unknowns),
      elements_(elements),
      ring_(elements.ring()),
      x_(x),
      alpha_(alpha),
      pressure_(pressure),
      modes_(modes) {
  assert(std::ssize(modes) <= ElementMotion::kMost);
}

void RingMotions::set_batch(int first, int count, int element, ElementBatch& batch) const {
  const int per_sector = ring_.elements_per_sector(), alphas = ring_.alphas_per_element();
  batch.count = count;
  for (int lane = 0; lane < count; ++lane) {
    batch.set(lane,
              unknowns_.gather(first + lane, element, x_),
              alpha_.data() + ((first + lane) * per_sector + element) * alphas,
              alphas);
  }
}

void RingMotions::set_modes(int first,
                            int count,
                            int element,
                            std::vector<ElementMotion>& motions) const {
  const Mesh& mesh = ring_.mesh();
  const int n = mesh.nodes_per_sector();
  for (int lane = 0; lane < count; ++lane) {
    std::array<int, 8> columns;
    for (int a = 0; a < 8; ++a) {
      const int node = mesh.elements[element].node[a];
      columns[a] = ((first + lane + node / n) % mesh.sectors) * n + node % n;
    }
    for (std::size_t i = 0; i < modes_.size(); ++i) {
      Matrix38 phi;
      for (int a = 0; a < 8; ++a) phi.col(a) = modes_[i].shape.col(columns[a]);
      set_lane(lane, ring_.in_element_frame(first + lane, element, phi), motions[i].mode);
    }
  }
}

bool RingMotions::curvatures(Eigen::MatrixXd& g) {
  const int per_sector = ring_.elements_per_sector();
  const auto groups = elements_.groups(unknowns_.sectors());
  g.setZero(unknowns_.size(), std::ssize(modes_));
  alphas_.resize(groups.size() * per_sector * modes_.size() * 2 * kAlphas);
  double* alphas = alphas_.data();
  ElementBatch batch;
  std::vector<ElementMotion> motions(modes_.size());
  for (const auto& [first, count] : groups) {
    for (int e = 0; e < per_sector; ++e) {
      set_batch(first, count, e, batch);
      set_modes(first, count, e, motions);
      ElementSurroundings around = elements_.surroundings(first, e);
      if (ring_.mesh().elements[e].inner) around.pressure = pressure_;
      if (!add_curvatures(elements_.law(first, e), around, batch, motions)) return false;
      for (std::size_t i = 0; i < motions.size(); ++i) {
        alphas = std::copy_n(&motions[i].mode_alpha[0][0], kAlphas, alphas);
        alphas = std::copy_n(&motions[i].second_alpha[0][0], kAlphas, alphas);
        for (int lane = 0; lane < count; ++lane) {
          Vector24 f;
          for (int k = 0; k < 24; ++k) f[k] = motions[i].curvature[k][lane];
          unknowns_.add_forces(first + lane, e, f, g.col(static_cast<Eigen::Index>(i)));
        }
      }
    }
  }
  return true;
}

const double* RingMotions::recall_alphas(const double* alphas,
                                         std::vector<ElementMotion>& motions) const {
  if (modes_.empty()) return alphas;
  for (ElementMotion& motion : motions) {
    std::copy_n(alphas, kAlphas, &motion.mode_alpha[0][0]);
    std::copy_n(alphas + kAlphas, kAlphas, &motion.second_alpha[0][0]);
    alphas += 2 * kAlphas;
  }
  return alphas;
}

bool RingMotions::slopes(const Eigen::MatrixXd& along,
                         const std::vector<MovedNumber>& numbers,
                         Eigen::MatrixXd& sums) {
  assert(modes_.empty() || std::ssize(modes_) == along.cols());
  sums.setZero(along.cols(), std::ssize(numbers));
  const double* alphas = alphas_.data();
  std::vector<ElementMotion> motions(static_cast<std::size_t>(along.cols()));
  for (ElementMotion& motion : motions) motion.has_mode = !modes_.empty();
  std::vector<Eigen::VectorXd> zeta;
  for (Eigen::Index i = 0; i < along.cols(); ++i) zeta.emplace_back(along.col(i));
  FeltNumbers felt;
  for (const auto& [first, count] : elements_.groups(unknowns_.sectors())) {
    for (int e = 0; e < ring_.elements_per_sector(); ++e) {
      felt.find(first, e, numbers);
      alphas = recall_alphas(alphas, motions);
      const bool has_mass = !modes_.empty() && !felt.masses.empty();
      if (felt.elements.empty() && !has_mass) continue;
      if (!modes_.empty()) set_modes(first, count, e, motions);
      if (has_mass) add_masses(first, count, e, felt, numbers, motions, sums);
      if (felt.elements.empty()) continue;
      for (std::size_t i = 0; i < motions.size(); ++i) {
        for (int lane = 0; lane < count; ++lane)
          set_lane(lane, unknowns_.gather(first + lane, e, zeta[i]), motions[i].along);
      }
      if (!add_differences(first, count, e, felt, numbers, motions, sums)) return false;
    }
  }
  return true;
}

bool RingMotions::add_differences(int first,
                                  int count,
                                  int element,
                                  const FeltNumbers& felt,
                                  const std::vector<MovedNumber>& numbers,
                                  std::vector<ElementMotion>& motions,
                                  Eigen::MatrixXd& sums) const {
  ElementBatch batch;
  set_batch(first, count, element, batch);
  const auto add = [&](std::size_t i, std::size_t k, const double(&lanes)[kLanes]) {
    sums(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) +=
        std::accumulate(lanes, lanes + count, 0.0);
  };
  const unsigned open_edges = elements_.surroundings(first, element).open_edges;
  return sum_differences(
      elements_.law(first, element), open_edges, felt, numbers, batch, motions, add);
}

void RingMotions::add_masses(int first,
                             int count,
                             int element,
                             const FeltNumbers& felt,
                             const std::vector<MovedNumber>& numbers,
                             const std::vector<ElementMotion>& motions,
                             Eigen::MatrixXd& sums) const {
  const auto add = [&](std::size_t i, std::size_t k, const double(&lanes)[kLanes]) {
    const double omega = 2.0 * std::numbers::pi * modes_[i].frequency;
    sums(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) -=
        omega * omega * std::accumulate(lanes, lanes + count, 0.0);
  };
  sum_masses(first, element, felt, numbers, motions, add);
}

}  // namespace latsch::fe_tire
