// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/kind_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "formats/text/letter_case.h"

namespace latsch::experiment {
namespace {

/// Returns the extension of the kind's files, taken from its description.
std::string ending_of(const SpecimenKind& kind) {
  for (const char* ending : {".tir", ".inp"})
    if (kind.file().find(ending) != std::string::npos) return ending;
  return ".toml";
}

std::string lower_ending(const std::filesystem::path& file) {
  return formats::lower(file.extension().string());
}

}  // namespace

std::optional<std::string> reason_against_ending(const SpecimenKind& kind,
                                                 const std::filesystem::path& file,
                                                 const std::vector<const SpecimenKind*>& kinds) {
  const std::string ending = lower_ending(file);
  const bool says_kind = ending == ".tir" || ending == ".inp" || ending == ".toml";
  if (!says_kind || ending == ending_of(kind)) return std::nullopt;
  std::vector<std::string> fitting;
  for (const SpecimenKind* other : kinds)
    if (ending_of(*other) == ending) fitting.push_back(other->name());
  return fmt::format("is a {} file, which is no {} ({}); expected {}{}",
                     ending,
                     kind.in_words(),
                     kind.file(),
                     fitting.empty() ? "another file" : "a file of that kind, or kind = ",
                     fmt::join(fitting, " or "));
}

const SpecimenKind& kind_for_file(const std::string& name,
                                  const std::filesystem::path& file,
                                  const std::vector<const SpecimenKind*>& kinds) {
  for (const SpecimenKind* kind : kinds) {
    if (kind->name() != name) continue;
    if (const auto reason = reason_against_ending(*kind, file, kinds))
      throw InputError({file.string(), 0}, *reason);
    return *kind;
  }
  throw InputError({file.string(), 0}, "is to be read as " + name + ", which is no kind of model");
}

void expect_own_ending(const SpecimenKind& kind, const std::filesystem::path& file) {
  const std::string ending = lower_ending(file), own = ending_of(kind);
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return;
  if (ending == own || (own == ".toml" && ending.empty())) return;
  throw InputError({file.string(), 0},
                   fmt::format("would contain a {}, {}, which is not read from a file with this "
                               "ending; expected a name that ends in {}",
                               kind.in_words(),
                               kind.file(),
                               own));
}

}  // namespace latsch::experiment
