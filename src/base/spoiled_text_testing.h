// SPDX-License-Identifier: Apache-2.0
// For tests of readers: texts spoiled as files are in practice, reproducibly for a given stream.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/random.h"

namespace latsch {

/// Returns the text with one to four random changes: a byte is replaced, a bit is flipped, a
/// passage is deleted or doubled, the end is cut off, or one of the `pieces` is inserted.
inline std::string spoiled(std::string text,
                           const std::vector<std::string>& pieces,
                           RandomStream& random) {
  for (std::uint64_t changes = 1 + random.below(4); changes > 0; --changes) {
    const std::size_t at = random.below(text.size() + 1);
    const std::size_t length = std::min<std::size_t>(random.below(40), text.size() - at);
    switch (random.below(6)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << random.below(8)));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(random.below(text.size() + 1), text.substr(at, length));
        break;
      case 4:
        text.resize(at);
        break;
      default:
        text.insert(at, pieces[random.below(pieces.size())]);
    }
  }
  return text;
}

}  // namespace latsch
