// SPDX-License-Identifier: Apache-2.0
#include "evaluation/outside_program/named_files.h"

#include <cctype>
#include <map>

#include "base/error.h"
#include "base/file.h"

namespace latsch {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLongestScript = std::uintmax_t{4} << 20;  // bytes

/// Adds the longest runs of letters, digits, underscores and `more` in a text.
void add_words(const std::string& text, const std::string& more, std::set<std::string>& words) {
  std::string word;
  for (const char c : text + ' ') {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || more.find(c) != more.npos) {
      word += c;
    } else if (!word.empty()) {
      words.insert(std::move(word));
      word.clear();
    }
  }
}

/// Returns the words of a script with and without the characters that file names have, or nothing
/// if the file is long or no text.
std::set<std::string> words_of(const fs::path& script) {
  std::set<std::string> words;
  try {
    const std::string text = read_text_file(script, kLongestScript);
    if (text.find('\0') != text.npos) return words;
    add_words(text, "", words);
    add_words(text, ".-+", words);
  } catch (const InputError&) {
    return words;
  }
  return words;
}

bool is_result_of_latsch(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.find(".latsch") != name.npos || file.extension() == ".html";
}

}  // namespace

std::vector<fs::path> files_named_beside(const fs::path& script,
                                         const std::set<std::string>& without) {
  std::map<std::string, fs::path> beside, found;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(script.parent_path(), none)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file(none) && !is_result_of_latsch(entry.path()) &&
        name != script.filename() && !without.contains(name))
      beside.emplace(name, entry.path());
  }
  std::vector<fs::path> unread = {script};
  while (!unread.empty() && !beside.empty()) {
    const fs::path file = unread.back();
    unread.pop_back();
    const std::set<std::string> words = words_of(file);
    std::erase_if(beside, [&](const auto& one) {
      const fs::path& other = one.second;
      const bool is_named = words.contains(one.first) || (other.extension() == file.extension() &&
                                                          words.contains(other.stem().string()));
      if (is_named) {
        found.insert(one);
        unread.push_back(other);
      }
      return is_named;
    });
  }
  std::vector<fs::path> files;
  for (const auto& [name, file] : found) files.push_back(file);
  return files;
}

}  // namespace latsch
