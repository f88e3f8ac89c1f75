// SPDX-License-Identifier: Apache-2.0
#include "formats/deck/inp_noted_numbers.h"

#include <cctype>
#include <utility>

namespace latsch::formats {

int note_number(InpDeck& deck,
                const std::string& path,
                InpQuantity quantity,
                const InpCard& card,
                const InpLine& line,
                std::size_t field) {
  InpNumber number{path, quantity, card.number(line, field), {{line.number, field, 1.0}}};
  deck.numbers.push_back(std::move(number));
  return static_cast<int>(deck.numbers.size()) - 1;
}

std::string part_of_path(std::string name) {
  std::erase(name, '"');
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != ' ') c = '_';
  return name;
}

}  // namespace latsch::formats
