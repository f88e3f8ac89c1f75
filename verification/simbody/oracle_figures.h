// SPDX-License-Identifier: Apache-2.0
// Figures of the oracle: those committed, and those it prints now where it could be built.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace latsch::verification {

/// A table of text with a head.
struct Figures {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;

  double number(std::size_t row, std::size_t column) const;
  std::size_t column(const std::string& name) const;
};

/// Throws InputError.
Figures read_figures(const std::filesystem::path& file);

/// What `simbody_oracle ARGUMENTS` prints; nothing where the program was not built because Simbody
/// is not there. Throws InputError where it fails.
std::optional<Figures> figures_of_oracle(const std::string& arguments);

}  // namespace latsch::verification
