// SPDX-License-Identifier: Apache-2.0
// Reads the cards of materials of an .inp deck: *MATERIAL and, for the last one, its laws
// *HYPERELASTIC and *ELASTIC, *VISCOELASTIC, *DENSITY and *NO COMPRESSION. Every constant is a
// number of the deck (inp_noted_numbers.h). Each card throws InputError with its place if it is
// malformed or means a law that is not supported.
#pragma once

#include <vector>

#include "formats/deck/inp_cards.h"
#include "formats/deck/inp_deck.h"

namespace latsch::formats {

class InpMaterialCards {
 public:
  /// Materials and their numbers are added to the deck, which must outlive this object.
  explicit InpMaterialCards(InpDeck& deck) : deck_(deck) {}

  void material(const InpCard& card);
  void hyperelastic(const InpCard& card);
  void elastic(const InpCard& card);
  void viscoelastic(const InpCard& card);
  void density(const InpCard& card);
  void no_compression(const InpCard& card);

 private:
  struct Constant {
    const char* name;
    InpQuantity quantity;
  };

  InpMaterial& current_material(const InpCard& card);
  void law(const InpCard& card, InpMaterial::Law law, const std::vector<Constant>& constants);

  InpDeck& deck_;
  InpMaterial* last_ = nullptr;
};

}  // namespace latsch::formats
