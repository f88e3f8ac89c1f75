// SPDX-License-Identifier: Apache-2.0
#include "command.h"

#include <fmt/format.h>
#include <string.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "base/scratch_folder_testing.h"

namespace latsch::benchmarks {
namespace {

constexpr std::size_t kMostWords = 4000;  // bytes; the last lines of a long progress output

std::string all_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string end_of_text(const std::string& text) {
  return text.size() <= kMostWords ? text : "... " + text.substr(text.size() - kMostWords);
}

std::string how_it_ended(int status) {
  if (status == -1) return "could not be started";
  if (WIFSIGNALED(status)) return fmt::format("was ended by \"{}\"", ::strsignal(WTERMSIG(status)));
  return fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

}  // namespace

Printed run_command(const std::string& command) {
  const ScratchFolder folder;
  const auto output = folder / "output", errors = folder / "errors";
  const int status = std::system(
      fmt::format("( {}\n) > '{}' 2> '{}'", command, output.string(), errors.string()).c_str());
  Printed printed{all_of(output), all_of(errors)};
  if (status == 0) return printed;
  std::string words = fmt::format("{} {}", command, how_it_ended(status));
  for (const std::string& text : {printed.errors, printed.output})
    if (!text.empty()) words += "; it printed:\n" + end_of_text(text);
  throw std::runtime_error(words);
}

}  // namespace latsch::benchmarks
