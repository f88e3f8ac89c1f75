// SPDX-License-Identifier: Apache-2.0
#include "formats/road/open_crg_references.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "base/file.h"
#include "base/text.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLargestCrg = 256u << 20;  // bytes
constexpr std::size_t kMostFiles = 64;

/// A section of a file with its statements, and the file that contains it.
struct Block {
  OpenCrgHeader::Values values;
  std::string file;
};

/// The statements of a file and of the files to which it refers.
struct Gathered {
  std::optional<Block> options, modifiers;
  std::optional<OpenCrgHeader> data;
  std::string bytes;
  std::vector<std::string> warnings, kept;
};

class Resolving {
 public:
  /// Reads a file and those to which it refers. `named_in` is the file and line that refer to this
  /// file; empty for the first one.
  Gathered gather(const std::filesystem::path& file, const Place& named_in = {}) {
    files_.push_back(file);
    named_in_.push_back(named_in);
    std::string bytes = read_text_file(file, kLargestCrg);
    OpenCrgHeader header = read_open_crg_header(bytes, file.string());
    Gathered result;
    if (header.references.empty()) {
      result.warnings = header.warnings;
      result.kept = header.kept;
      if (header.data_begin != std::string_view::npos) {
        result.bytes = std::move(bytes);
        result.data = header;
      }
    } else {
      check_referring(header);
      stack_.push_back(std::filesystem::weakly_canonical(file));
      for (const auto& [path, place] : references_of(header, file.parent_path()))
        merge(gather_referred(path, place), result);
      stack_.pop_back();
      if (!header.road.empty())
        header.warnings.push_back(header.file +
                                  ": its $ROAD_CRG has no effect; that of the file with the data "
                                  "counts");
      result.warnings.insert(
          result.warnings.begin(), header.warnings.begin(), header.warnings.end());
      result.kept.insert(result.kept.end(), header.kept.begin(), header.kept.end());
    }
    if (header.has_options) result.options = Block{header.options, header.file};
    if (header.has_modifiers) result.modifiers = Block{header.modifiers, header.file};
    return result;
  }

  const std::vector<std::filesystem::path>& files() const { return files_; }
  const std::vector<Place>& named_in() const { return named_in_; }

 private:
  struct Reference {
    std::filesystem::path path;
    Place place;
  };

  static void check_referring(const OpenCrgHeader& header) {
    if (header.data_begin != std::string_view::npos)
      throw InputError({header.file, header.references.front().line},
                       "refers to another file and has data of its own, expected one of both");
  }

  Gathered gather_referred(const std::filesystem::path& path, const Place& place) {
    if (std::find(stack_.begin(), stack_.end(), std::filesystem::weakly_canonical(path)) !=
        stack_.end())
      throw InputError(place,
                       "refers to " + in_quotes(path.string()) + ", which refers back to it");
    if (files_.size() == kMostFiles)
      throw InputError(place, fmt::format("refers to more than {} files", kMostFiles));
    if (!std::filesystem::exists(path))
      throw InputError(place,
                       "refers to " + in_quotes(path.string()) +
                           ", which does not exist; a path ends with a line that ends in .crg, "
                           "and counts from the folder of the file that names it");
    return gather(path, place);
  }

  static std::vector<Reference> references_of(const OpenCrgHeader& header,
                                              const std::filesystem::path& folder) {
    std::vector<Reference> all;
    std::string path;
    for (const OpenCrgHeader::Reference& line : header.references) {
      const Place place{header.file, line.line};
      path += with_environment(line.text, place);
      std::error_code none;
      const bool ends =
          lower(path).ends_with(".crg") || std::filesystem::is_regular_file(folder / path, none);
      if (!ends && &line != &header.references.back()) continue;
      all.push_back({folder / path, place});
      path.clear();
    }
    return all;
  }

  /// Replaces $NAME, up to the next /, by the value of that environment variable.
  static std::string with_environment(std::string text, const Place& place) {
    for (std::size_t at = text.find('$'); at != text.npos; at = text.find('$')) {
      const std::size_t end = std::min(text.find('/', at), text.size());
      const std::string name = text.substr(at + 1, end - at - 1);
      const char* value = std::getenv(name.c_str());
      if (value == nullptr || std::string_view(value).find('$') != std::string_view::npos)
        throw InputError(place,
                         fmt::format("refers to {}, but the environment variable {} is {}",
                                     in_quotes(text),
                                     in_quotes(name),
                                     value == nullptr ? "not set" : "no plain path"));
      text.replace(at, end - at, value);
    }
    return text;
  }

  /// Adds the statements of `next` to `all`; of statements that are in both, those of `next` count.
  static void merge(Gathered next, Gathered& all) {
    const auto replace = [&](auto& now, auto& then, const char* what) {
      if (!then) return;
      if (now)
        all.warnings.push_back(
            fmt::format("the {} of {} count, those of {} do not: it is named later",
                        what,
                        then->file,
                        now->file));
      now = std::move(then);
    };
    replace(all.options, next.options, "options");
    replace(all.modifiers, next.modifiers, "modifiers");
    if (next.data) {
      replace(all.data, next.data, "data");
      all.bytes = std::move(next.bytes);
    }
    all.warnings.insert(all.warnings.end(), next.warnings.begin(), next.warnings.end());
    all.kept.insert(all.kept.end(), next.kept.begin(), next.kept.end());
  }

  std::vector<std::filesystem::path> files_;
  std::vector<Place> named_in_;
  std::vector<std::filesystem::path> stack_;
};

}  // namespace

void check_open_crg_size(std::string_view bytes, const std::string& file) {
  if (bytes.size() > kLargestCrg) throw InputError({file, 0}, "is larger than 256 MB");
}

ResolvedCrg resolve_open_crg(const std::filesystem::path& file) {
  Resolving resolving;
  Gathered all = resolving.gather(file);
  if (!all.data) {
    const bool refers = resolving.files().size() > 1;
    throw InputError({file.string(), 0},
                     refers ? "refers to files of which none has data, expected one with a line "
                              "$$$$ and records behind it"
                            : "has no data, expected a line $$$$ and records behind it");
  }
  ResolvedCrg result{
      std::move(all.bytes), std::move(*all.data), resolving.files(), resolving.named_in()};
  result.header.options = all.options ? all.options->values : OpenCrgHeader::Values{};
  result.header.modifiers = all.modifiers ? all.modifiers->values : OpenCrgHeader::Values{};
  result.header.warnings = std::move(all.warnings);
  result.header.kept = std::move(all.kept);
  return result;
}

}  // namespace latsch::formats
