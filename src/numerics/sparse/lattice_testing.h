// SPDX-License-Identifier: Apache-2.0
// Structure for tests: a block of hexahedral elements with eight nodes, optionally closed to a ring
// along its first direction.
#pragma once

#include <Eigen/Core>
#include <array>
#include <random>
#include <vector>

#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::numerics {

inline Eigen::MatrixXd dense(const SymmetricMatrix& A) {
  Eigen::MatrixXd D(A.size(), A.size());
  for (int i = 0; i < A.size(); ++i) {
    for (int j = 0; j < A.size(); ++j) D(i, j) = A.coefficient(i, j);
  }
  return D;
}

class Lattice {
 public:
  /// `elements` holds the number along each direction; `per_node` is the number of unknowns of a
  /// node; `held_ends` clamps the two faces of direction 1.
  Lattice(std::array<int, 3> elements, int per_node, bool ring = false, bool held_ends = false)
      : elements_(elements), per_node_(per_node), ring_(ring) {
    const auto [a, b, c] = elements;
    const int around = ring ? a : a + 1;
    unknown_.assign(around * (b + 1) * (c + 1), -1);
    for (int i = 0; i < around; ++i) {
      for (int j = 0; j <= b; ++j) {
        for (int k = 0; k <= c; ++k) {
          if (held_ends && (j == 0 || j == b)) continue;
          unknown_[node(i, j, k)] = size_;
          size_ += per_node;
        }
      }
    }
  }

  int size() const { return size_; }

  std::vector<std::vector<int>> elements() const {
    const auto [a, b, c] = elements_;
    std::vector<std::vector<int>> all;
    for (int i = 0; i < a; ++i) {
      for (int j = 0; j < b; ++j) {
        for (int k = 0; k < c; ++k) {
          std::vector<int> unknowns;
          for (int corner = 0; corner < 8; ++corner) {
            const int first =
                unknown_[node(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2))];
            for (int d = 0; d < per_node_; ++d) unknowns.push_back(first < 0 ? -1 : first + d);
          }
          all.push_back(unknowns);
        }
      }
    }
    return all;
  }

  /// Assembles random positive definite element matrices.
  void assemble_random(SymmetricMatrix& A, unsigned seed) const {
    std::mt19937 random(seed);
    for (int e = 0; e < element_count(); ++e) A.add_element(e, random_element(random).data());
  }

  /// Assembles the same random positive definite matrix for every element. A ring then has double
  /// eigenvalues.
  void assemble_equal(SymmetricMatrix& A, unsigned seed) const {
    std::mt19937 random(seed);
    const Eigen::MatrixXd K = random_element(random);
    for (int e = 0; e < element_count(); ++e) A.add_element(e, K.data());
  }

 private:
  int element_count() const { return elements_[0] * elements_[1] * elements_[2]; }

  Eigen::MatrixXd random_element(std::mt19937& random) const {
    const int n = 8 * per_node_;
    Eigen::MatrixXd B(n, n);
    for (double& b : B.reshaped()) b = std::uniform_real_distribution(-1.0, 1.0)(random);
    return B * B.transpose() + Eigen::MatrixXd::Identity(n, n);
  }

  int node(int i, int j, int k) const {
    const int wrapped = ring_ ? i % elements_[0] : i;
    return (wrapped * (elements_[1] + 1) + j) * (elements_[2] + 1) + k;
  }

  std::array<int, 3> elements_;
  int per_node_;
  bool ring_;
  int size_ = 0;
  std::vector<int> unknown_;
};

}  // namespace latsch::numerics
