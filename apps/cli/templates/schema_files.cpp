// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/schema_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/document.h"
#include "base/file.h"
#include "base/text.h"

namespace latsch::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSchemaLine = "#:schema ";
constexpr std::string_view kPrefix = "latsch-", kEnding = ".json";
constexpr std::size_t kLargestSchema = std::size_t{4} << 20;  // bytes

/// Returns the folder of the schemas; nothing if the program was copied without them. That of an
/// installation is ../share/latsch/schemas relative to the program.
std::optional<fs::path> schema_folder() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  for (const fs::path& folder :
       {program.parent_path().parent_path() / "share" / "latsch" / "schemas",
        fs::path(LATSCH_SCHEMAS)})
    if (!program.empty() && fs::is_directory(folder, none)) return folder;
  return std::nullopt;
}

std::vector<std::string> kinds_in(const fs::path& folder) {
  std::vector<std::string> kinds;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kPrefix) && name.ends_with(kEnding))
      kinds.push_back(name.substr(kPrefix.size(), name.size() - kPrefix.size() - kEnding.size()));
  }
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

fs::path file_of(const fs::path& folder, const std::string& kind) {
  return folder / fmt::format("{}{}{}", kPrefix, kind, kEnding);
}

/// Returns a path as a URL: all bytes but letters, digits and a few marks are written as %20.
std::string url_of(const fs::path& file) {
  std::string url = "file://";
  for (const char c : file.string()) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') ||
                          std::string_view("/-_.~").find(c) != std::string_view::npos;
    url += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

/// Returns the kind of a file by its content; an empty text if it is none that has a schema.
std::string kind_of(const Node& root, const experiment::Language& language) {
  if (root.has("kind")) {
    const std::string kind = root.text("kind");
    if (language.find_kind(kind)) return kind;
    // A road and a test may both be called "kerb"; a road has a shape.
    return language.find_test(kind) && !root.has("shape") ? "test" : "road";
  }
  if (root.has("section")) return "fe_tire";
  if (root.has("plateaus")) return "rig";
  return root.has("experiment") || root.has("variable") ? "study" : "";
}

}  // namespace

std::string schema_of(const std::string& kind) {
  const auto folder = schema_folder();
  if (!folder)
    throw InputError(
        "there are no schemas beside this program: it was copied without its folder "
        "share/latsch/schemas, which has to be at ../share of the program's folder");
  const std::vector<std::string> kinds = kinds_in(*folder);
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    throw InputError("no kind of file is called " + in_quotes(kind) + did_you_mean(kind, kinds) +
                     "\nthere are schemas of " + list_of(kinds));
  return read_text_file(file_of(*folder, kind), kLargestSchema);
}

std::string with_schema(const std::string& text, const experiment::Language& language) {
  const auto folder = schema_folder();
  if (!folder) return text;
  const Document document = Document::parse(text, "written");
  const fs::path file = file_of(*folder, kind_of(document.root(), language));
  std::error_code none;
  if (!fs::exists(file, none)) return text;
  const fs::path whole = fs::canonical(file);
  const bool is_installed = whole.string().starts_with("/usr/share/");
  return std::string(kSchemaLine) +
         (is_installed ? url_of(whole) : "./" + whole.filename().string()) + "\n" + text;
}

std::vector<fs::path> place_schemas(const fs::path& folder) {
  std::vector<fs::path> written;
  const auto schemas = schema_folder();
  if (!schemas) return written;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string text = read_text_file(entry.path());
    const std::string before = std::string(kSchemaLine) + "./";
    if (!text.starts_with(before)) continue;
    const std::string name = text.substr(before.size(), text.find('\n') - before.size());
    const fs::path source = *schemas / name, copy = folder / name;
    if (fs::path(name).filename() != name || !fs::exists(source) || fs::exists(copy)) continue;
    write_text_file(copy, read_text_file(source, kLargestSchema));
    written.push_back(copy);
  }
  std::sort(written.begin(), written.end());
  return written;
}

}  // namespace latsch::cli
