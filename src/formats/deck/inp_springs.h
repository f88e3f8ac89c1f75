// SPDX-License-Identifier: Apache-2.0
// Springs and point masses of an .inp deck, by which formats/mesh/ccx_cords.h writes cords.
//
//   *ELEMENT,TYPE=SPRINGA,ELSET=CORDS0        number, two nodes
//   *SPRING,ELSET=CORDS0,NONLINEAR            an empty line, then force, elongation
//   *ELEMENT,TYPE=MASS,ELSET=MASS0            number, node
//   *MASS,ELSET=MASS0                         mass
//
// Constant springs and springs between degrees of freedom are refused.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/deck/inp_cards.h"
#include "formats/deck/inp_deck.h"

namespace latsch::formats {

class InpSprings {
 public:
  static bool is_one(const std::string& element_type) {
    return element_type == "SPRINGA" || element_type == "MASS";
  }
  /// Reads a card *ELEMENT of type SPRINGA or MASS.
  void add_elements(const InpCard& card);
  void add_law(const InpCard& card);
  void add_mass(const InpCard& card);

  /// Writes springs and masses into the deck. Throws InputError for a spring or a mass without its
  /// card, or at a node that is not defined.
  void put(InpDeck& deck) const;

 private:
  struct Spring {
    std::string elset;
    InpSpring spring;
  };
  struct Mass {
    std::string elset;
    int node = 0;
    Place place;
  };
  std::vector<Spring> springs_;
  std::vector<Mass> masses_;
  std::map<std::string, std::vector<InpSpring::Point>> laws_;
  std::map<std::string, double> mass_of_;
};

}  // namespace latsch::formats
