// SPDX-License-Identifier: Apache-2.0
// Results of the oracle, the reference program on Simbody: those that are committed, and those that
// it prints now if it could be built.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace latsch::verification {

/// A table of texts with a header line.
struct Figures {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;

  double number(std::size_t row, std::size_t column) const;
  std::size_t column(const std::string& name) const;
};

/// Throws InputError if the file cannot be read.
Figures read_figures(const std::filesystem::path& file);

/// Runs `simbody_oracle ARGUMENTS` and returns its output; nothing if the program was not built
/// because Simbody is not installed. Throws InputError if it fails.
std::optional<Figures> figures_of_oracle(const std::string& arguments);

}  // namespace latsch::verification
