// SPDX-License-Identifier: Apache-2.0
// *EQUATION of an .inp deck: ties of nodes to the straight line between two others, or to a mean of
// more than two.
//
//   *EQUATION
//   3                                   terms
//   901,1,1., 17,1,-0.5, 23,1,-0.5      sum of coefficient x displacement = 0
//
// A corner of many rows of elements is tied to the edge of the few rows that they adjoin.
// The ends of cords are tied to a mean of the corners of their element, with four to nine terms.
// formats/mesh/ccx_deck.h writes such equations. A tied node has three equations, one for each
// direction, with the same other nodes and with weights that add up to one and give the position of
// the tied node. All other equations are refused.
#pragma once

#include <array>
#include <map>

#include "formats/deck/inp_cards.h"
#include "formats/deck/inp_deck.h"

namespace latsch::formats {

class InpEquations {
 public:
  /// Reads all equations of a card. Throws InputError, with the line, for an equation that ties a
  /// node neither to a line nor to a mean.
  void add(const InpCard& card);

  /// Returns the ties to lines by the number of the tied node. Throws InputError if a node is tied
  /// in some directions only, does not lie on its line, or is tied to a node that is not defined or
  /// is tied itself.
  std::map<int, InpTie> ties(const std::map<int, Eigen::Vector3d>& nodes) const;
  /// Returns the ties to means by the number of the tied node. Throws InputError for the same
  /// reasons as ties().
  std::map<int, InpMean> means(const std::map<int, Eigen::Vector3d>& nodes) const;

 private:
  struct Term {
    int node, direction;
    double factor;
  };
  void add_tie(const std::vector<Term>& terms, const Place& place);
  void add_mean(const std::vector<Term>& terms, const Place& place);

  struct Known {
    InpTie tie;
    std::array<bool, 3> directions{};
  };
  struct KnownMean {
    InpMean mean;
    std::array<bool, 3> directions{};
  };
  std::map<int, Known> known_;
  std::map<int, KnownMean> means_;
};

}  // namespace latsch::formats
