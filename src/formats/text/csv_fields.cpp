// SPDX-License-Identifier: Apache-2.0
#include "formats/text/csv_fields.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/text.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kMostFields = 10000;  // in a row
// bytes of a large file that stay in memory while it is read
constexpr std::size_t kKept = 32u << 20;

/// Returns the separator that a line "sep=;" of a spreadsheet's file states; 0 for any other line.
char separator_said_by(std::string_view line) {
  line = line.substr(0, line.find('\n'));
  while (!line.empty() && (line.back() == '\r' || line.back() == '"')) line.remove_suffix(1);
  if (line.starts_with('"')) line.remove_prefix(1);
  constexpr std::string_view kSays = "sep=";
  if (line.size() != kSays.size() + 1 || !line.starts_with(kSays)) return 0;
  const char says = line.back();
  return says == ';' || says == ',' || says == '\t' ? says : '\0';
}

}  // namespace

CsvFields::CsvFields(std::shared_ptr<const MappedFile> source, std::string file)
    : file_(std::move(file)), source_(std::move(source)), text_(source_->text()) {
  if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  if (!skip_to_row()) return;
  separator_ = find_separator();
  const char says = separator_said_by(text_.substr(at_));
  if (says == 0) return;
  separator_ = says;
  skip_line();
}

void CsvFields::skip_line() {
  at_ = std::min(text_.find('\n', at_), text_.size());
  if (at_ < text_.size()) {
    ++at_;
    ++line_;
  }
}

bool CsvFields::skip_to_row() {
  while (at_ < text_.size()) {
    const auto end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = trimmed(text_.substr(at_, end - at_));
    if (!line.empty() && line.front() != '#') return true;
    skip_line();
  }
  return false;
}

char CsvFields::find_separator() const {
  bool quoted = false, tab = false;
  for (std::size_t i = at_; i < text_.size() && (quoted || text_[i] != '\n'); ++i) {
    if (text_[i] == '"') quoted = !quoted;
    if (quoted) continue;
    if (text_[i] == ';') return ';';
    if (text_[i] == ',') return ',';
    tab = tab || text_[i] == '\t';
  }
  return tab ? '\t' : ',';
}

std::string_view CsvFields::quoted_field() {
  const int opened = line_;
  const std::size_t begin = ++at_;
  bool doubled = false;
  for (; at_ < text_.size(); ++at_) {
    if (text_[at_] == '\n') ++line_;
    if (text_[at_] != '"') continue;
    if (text_.substr(at_ + 1, 1) != "\"") break;
    doubled = true;
    ++at_;
  }
  if (at_ >= text_.size()) throw InputError({file_, opened}, "a quote is opened and never closed");
  std::string_view field = text_.substr(begin, at_ - begin);
  ++at_;
  while (at_ < text_.size() && text_[at_] != separator_ && text_[at_] != '\n') {
    if (text_[at_] != ' ' && text_[at_] != '\t' && text_[at_] != '\r')
      throw InputError(
          {file_, line_},
          "text follows a closing quote, expected " + in_quotes(std::string(1, separator_)));
    ++at_;
  }
  if (!doubled) return field;
  std::string& text = unquoted_.emplace_back();
  for (std::size_t i = 0; i < field.size(); ++i) {
    text += field[i];
    if (field[i] == '"') ++i;
  }
  return text;
}

std::string_view CsvFields::plain_field() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && text_[at_] != separator_ && text_[at_] != '\n') ++at_;
  return trimmed(text_.substr(begin, at_ - begin));
}

void CsvFields::go_to(const Mark& mark) {
  at_ = mark.at;
  line_ = mark.line;
  let_go_ = std::min(let_go_, at_);
}

bool CsvFields::next(Row& row) {
  row.cells.clear();
  unquoted_.clear();
  if (at_ > let_go_ + kKept) {
    source_->let_go(at_);
    let_go_ = at_;
  }
  if (!skip_to_row()) return false;
  row.line = line_;
  for (;;) {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    row.cells.push_back(at_ < text_.size() && text_[at_] == '"' ? quoted_field() : plain_field());
    if (row.cells.size() > kMostFields)
      throw InputError({file_, row.line}, fmt::format("has more than {} fields", kMostFields));
    if (at_ >= text_.size() || text_[at_] == '\n') break;
    ++at_;  // skips the separator
  }
  skip_line();
  return true;
}

}  // namespace latsch::formats
