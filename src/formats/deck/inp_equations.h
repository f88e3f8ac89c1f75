// SPDX-License-Identifier: Apache-2.0
// *EQUATION of an .inp deck: nodes that lie on the straight line between two others.
//
//   *EQUATION
//   3                                   terms
//   901,1,1., 17,1,-0.5, 23,1,-0.5      sum of coefficient x displacement = 0
//
// Where many rows of elements meet few, a corner of the many is held on the edge of the few; that
// is how formats/mesh/ccx_deck.h writes it. Three equations say so of a node, one for each
// direction, with the same two nodes and weights that add up to one and place the node where it
// lies. All other equations are refused.
#pragma once

#include <array>
#include <map>

#include "formats/deck/inp_cards.h"
#include "formats/deck/inp_deck.h"

namespace latsch::formats {

class InpEquations {
 public:
  /// All equations of a card; InputError with the line for one that ties no node to a line.
  void add(const InpCard& card);

  /// The ties they make; InputError for a node tied in some directions only, to a line it does not
  /// lie on, to a node that is not defined or is tied itself.
  std::map<int, InpTie> ties(const std::map<int, Eigen::Vector3d>& nodes) const;

 private:
  struct Term {
    int node, direction;
    double factor;
  };
  void add_equation(const std::vector<Term>& terms, const Place& place);

  struct Known {
    InpTie tie;
    std::array<bool, 3> directions{};
  };
  std::map<int, Known> known_;
};

}  // namespace latsch::formats
