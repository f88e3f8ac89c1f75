// SPDX-License-Identifier: Apache-2.0
// For tests of readers: texts spoiled as files are in practice, reproducibly for a given stream.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/random.h"

namespace latsch {

/// Makes one to four changes: a byte replaced, a bit flipped, a stretch deleted or doubled, the end
/// cut off, one of the `pieces` inserted.
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
