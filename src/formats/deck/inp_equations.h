// SPDX-License-Identifier: Apache-2.0
// *EQUATION of an .inp deck: nodes that lie on the straight line between two others, or at a mean
// of more than two.
//
//   *EQUATION
//   3                                   terms
//   901,1,1., 17,1,-0.5, 23,1,-0.5      sum of coefficient x displacement = 0
//
// If many rows of elements meet few rows, a corner of the many is held on the edge of the few. The
// ends of cords are held at a mean of the corners of their element, with four to nine terms.
// formats/mesh/ccx_deck.h writes such equations. A node has three of them, one for each direction,
// with the same nodes and with weights that add up to one and give the node's own position. All
// other equations are refused.
#pragma once

#include <array>
#include <map>

#include "formats/deck/inp_cards.h"
#include "formats/deck/inp_deck.h"

namespace latsch::formats {

class InpEquations {
 public:
  /// Reads all equations of a card; throws InputError with the line of one that does not hold a
  /// node on a line or at a mean.
  void add(const InpCard& card);

  /// Returns the ties; throws InputError for a node that is tied in some directions only, to a line
  /// on which it does not lie, or to a node that is not defined or is tied itself.
  std::map<int, InpTie> ties(const std::map<int, Eigen::Vector3d>& nodes) const;
  /// Returns the nodes at means of others; throws InputError as ties() does.
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
