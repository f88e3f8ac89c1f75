// SPDX-License-Identifier: Apache-2.0
#include "simbody/oracle_figures.h"

#include <fmt/format.h>

#include <cstdio>
#include <sstream>

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"

namespace latsch::verification {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) found.push_back(cell);
  return found;
}

Figures parsed(const std::string& text, const std::string& source) {
  Figures figures;
  std::istringstream in(text);
  std::string line;
  if (std::getline(in, line)) figures.head = cells(line);
  for (int number = 2; std::getline(in, line); ++number) {
    figures.rows.push_back(cells(line));
    if (figures.rows.back().size() != figures.head.size())
      throw InputError({source, number}, "has another number of cells than its head");
  }
  if (figures.rows.empty()) throw InputError({source}, "has no figures");
  return figures;
}

}  // namespace

double Figures::number(std::size_t row, std::size_t column) const {
  const std::string& cell = rows.at(row).at(column);
  if (const auto value = parse_number(cell)) return *value;
  throw InputError(fmt::format("{} is no number", in_quotes(cell)));
}

std::size_t Figures::column(const std::string& name) const {
  for (std::size_t i = 0; i < head.size(); ++i)
    if (head[i] == name) return i;
  throw InputError(fmt::format("there is no column {}", in_quotes(name)));
}

Figures read_figures(const std::filesystem::path& file) {
  return parsed(read_text_file(file), file.string());
}

#ifdef LATSCH_SIMBODY_ORACLE
std::optional<Figures> figures_of_oracle(const std::string& arguments) {
  const std::string command = fmt::format("'{}' {} 2>/dev/null", LATSCH_SIMBODY_ORACLE, arguments);
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw InputError(command + " cannot be started");
  std::string text;
  char part[4096];
  for (std::size_t size; (size = std::fread(part, 1, sizeof part, pipe)) > 0;)
    text.append(part, size);
  if (::pclose(pipe) != 0) throw InputError(command + " failed");
  return parsed(text, command);
}
#else
std::optional<Figures> figures_of_oracle(const std::string&) { return {}; }
#endif

}  // namespace latsch::verification
