// SPDX-License-Identifier: Apache-2.0
#include "base/unit_words/unit_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "base/unit_words/unit_list.h"

namespace latsch {
namespace {

using unit_list::Ambiguous;
using IsForeign = std::function<bool(std::string_view, const std::string&)>;

// Largest number of ambiguous words in one text, which limits the combinations.
constexpr std::size_t kMostAmbiguous = 4;

std::string_view without_outer_blanks(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

/// Full-width forms U+FF01 to U+FF5E, three bytes each, stand for "!" to "~".
std::optional<char> of_full_width(std::string_view at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(at[i]); };
  if (at.size() < 3 || byte(0) != 0xef || byte(1) < 0xbc || byte(1) > 0xbd) return std::nullopt;
  const int offset = (byte(1) - 0xbc) * 64 + byte(2) - 0x81;
  if (offset < 0 || offset > '~' - '!') return std::nullopt;
  return static_cast<char>('!' + offset);
}

/// Returns the text with every character replaced by the letters or signs it stands for.
std::string plain_characters(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    std::size_t taken = 1;
    if (const auto letter = of_full_width(text)) {
      plain += *letter;
      taken = 3;
    } else if (static_cast<unsigned char>(text.front()) < 0x80) {
      plain +=
          text.front() == '\t' || text.front() == '\r' || text.front() == '\n' ? ' ' : text.front();
    } else {
      const auto row = std::find_if(std::begin(unit_list::kCharacters),
                                    std::end(unit_list::kCharacters),
                                    [&](const auto& r) { return text.starts_with(r.written); });
      if (row == std::end(unit_list::kCharacters)) {
        plain += text.front();
      } else {
        plain += row->meaning;
        taken = row->written.size();
      }
    }
    text.remove_prefix(taken);
  }
  return plain;
}

std::string_view without_brackets(std::string_view text) {
  text = without_outer_blanks(text);
  for (const char* pair : {"[]", "()", "{}", "<>"}) {
    if (text.size() < 2 || text.front() != pair[0] || text.back() != pair[1]) continue;
    const std::string_view inside = text.substr(1, text.size() - 2);
    if (inside.find(pair[0]) == inside.npos) return without_outer_blanks(inside);
  }
  return text;
}

bool is_digit_of_unit(char c) { return c >= '0' && c <= '9'; }

bool belongs_to_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '%' || c == '\'' ||
         c == '"' || (static_cast<unsigned char>(c) & 0x80);
}

/// Meaning of a word: one text, or several among which the dimension decides.
struct WordMeaning {
  std::string text;
  const Ambiguous* ambiguous = nullptr;
};

/// Returns the meaning of a word from the lists; nothing if they do not contain the word.
std::optional<std::string> listed_meaning(std::string_view word) {
  for (const auto& row : unit_list::kWords)
    if (row.written == word) return std::string(row.meaning);
  for (const auto& row : unit_list::kExact)
    if (row.written == word) return std::string(row.meaning);
  return std::nullopt;
}

const std::map<std::string, std::string_view, std::less<>>& words_in_lower_case() {
  static const auto words = [] {
    std::map<std::string, std::string_view, std::less<>> all;
    for (const auto& row : unit_list::kWords) all[in_lower_case(row.written)] = row.meaning;
    return all;
  }();
  return words;
}

class Reading {
 public:
  Reading(std::string_view text, const IsForeign& is_foreign)
      : text_(text), is_foreign_(is_foreign) {}

  /// Returns false if the text is no product of known words.
  bool run() {
    bool factor_expected = true;
    int open = 0;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == ' ') {
        ++at_;
      } else if (factor_expected && c == '(') {
        pieces_.push_back({take_product() + "("});
        ++at_, ++open;
      } else if (factor_expected) {
        if (!take_factor()) return false;
        factor_expected = false;
      } else if (c == ')') {
        if (--open < 0) return false;
        ++at_;
        pieces_.push_back({")" + take_exponent()});
        if (is_wrong_) return false;
      } else {
        if (!take_operator()) return false;
        factor_expected = true;
      }
    }
    return !factor_expected && open == 0 && !is_wrong_;
  }

  std::string refusal;

  UnitMeanings meanings() const {
    std::vector<const Ambiguous*> open;
    for (const Piece& piece : pieces_)
      if (piece.ambiguous && std::find(open.begin(), open.end(), piece.ambiguous) == open.end())
        open.push_back(piece.ambiguous);
    UnitMeanings result;
    if (open.size() > kMostAmbiguous) return result;
    for (std::size_t choice = 0; choice < (std::size_t{1} << open.size()); ++choice) {
      std::string text, spelling;
      for (const Piece& piece : pieces_) {
        const auto place = std::find(open.begin(), open.end(), piece.ambiguous) - open.begin();
        const std::string word = piece.ambiguous
                                     ? std::string(piece.ambiguous->meanings[choice >> place & 1])
                                     : piece.word;
        text += piece.before + in_place(piece.ambiguous ? *listed_meaning(word) : piece.text);
        spelling += piece.before + word;
      }
      result.texts.push_back(std::move(text));
      result.spellings.push_back(std::move(spelling));
    }
    if (open.size() == 1 && words_ == 1 && is_alone()) {
      result.dimension_decides = open[0]->only_by_dimension;
      result.refusal = open[0]->way_out;
    }
    return result;
  }

 private:
  struct Piece {
    std::string before;     // operators, brackets and exponents before the word
    std::string word = {};  // the word in the file
    std::string text = {};  // meaning
    const Ambiguous* ambiguous = nullptr;
  };

  bool is_alone() const {
    return std::none_of(
        pieces_.begin(), pieces_.end(), [](const Piece& piece) { return !piece.before.empty(); });
  }

  /// A meaning of several words is put in brackets if it has neighbors; a temperature then counts
  /// as a temperature difference.
  std::string in_place(const std::string& meaning) const {
    if (is_alone() || meaning.empty()) return meaning;
    if (meaning == "degC") return "K";
    if (meaning == "degF") return "degR";
    return meaning.find_first_of(" /^.0123456789") == meaning.npos ? meaning : "(" + meaning + ")";
  }

  std::string take_product() { return std::exchange(operator_, std::string()); }

  bool take_operator() {
    const auto next = [&](std::string_view sign) { return text_.substr(at_).starts_with(sign); };
    const bool is_per = next("per ") && at_ > 0 && text_[at_ - 1] == ' ';
    if (next("/") || is_per) {
      operator_ = "/";
      at_ += is_per ? 4 : 1;
      return true;
    }
    operator_ = " ";
    if (next("*") || next(".") || next("-")) {
      ++at_;
      return true;
    }
    return at_ > 0 && (text_[at_ - 1] == ' ' || text_[at_ - 1] == ')');
  }

  /// Reads "1" at the front, or a word and its exponent.
  bool take_factor() {
    if (pieces_.empty() && text_[at_] == '1') {
      const std::size_t behind = text_.find_first_not_of(' ', at_ + 1);
      if (behind == text_.npos || text_[behind] != '/') return false;
      ++at_;
      pieces_.push_back({"1"});
      return true;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && belongs_to_word(text_[at_])) ++at_;
    if (at_ == begin) return false;
    const std::string_view word = text_.substr(begin, at_ - begin);
    const auto meaning = meaning_of(word);
    if (!meaning) return false;
    ++words_;
    pieces_.push_back({take_product(), std::string(word), meaning->text, meaning->ambiguous});
    const std::string exponent = take_exponent();
    if (!exponent.empty()) pieces_.push_back({exponent});
    return !is_wrong_;
  }

  /// Reads an exponent of one digit: "^2", "**2", "2", "-2", "^(-2)".
  std::string take_exponent() {
    std::size_t at = at_;
    const bool power = text_.substr(at).starts_with("^") || text_.substr(at).starts_with("**");
    if (power) at += text_[at] == '^' ? 1 : 2;
    const bool bracket = power && at < text_.size() && text_[at] == '(';
    if (bracket) ++at;
    std::string sign;
    if (at < text_.size() && (text_[at] == '-' || text_[at] == '+')) {
      if (text_[at] == '-') sign = "-";
      ++at;
    }
    if (at >= text_.size() || !is_digit_of_unit(text_[at])) {
      is_wrong_ = is_wrong_ || power;
      return "";
    }
    const char digit = text_[at++];
    // The exponents 0 and 1 are refused unless they are marked as powers: "C1" and "N0" are names
    // of channels.
    if (digit == '0' || (digit == '1' && sign.empty() && !power)) is_wrong_ = true;
    const std::string exponent = "^" + sign + digit;
    if (bracket && (at >= text_.size() || text_[at++] != ')')) is_wrong_ = true;
    if (at < text_.size() && (is_digit_of_unit(text_[at]) || belongs_to_word(text_[at])))
      is_wrong_ = true;
    at_ = at;
    return exponent;
  }

  std::optional<WordMeaning> meaning_of(std::string_view word) {
    for (const auto& row : unit_list::kRefused) {
      if (row.written != word) continue;
      refusal = row.meaning;
      return std::nullopt;
    }
    const std::string lower = in_lower_case(word);
    for (const Ambiguous& row : unit_list::kAmbiguousWords)
      if (row.written == word || (row.any_case && row.written == lower))
        return WordMeaning{"", &row};
    if (auto listed = listed_meaning(word)) return WordMeaning{std::move(*listed)};
    const auto found = words_in_lower_case().find(lower);
    if (found == words_in_lower_case().end()) return std::nullopt;
    std::string meaning(found->second);
    if (is_foreign_(word, meaning)) {
      refusal = word == lower
                    ? fmt::format("which is not known; with capitals, \"{}\", it is {}",
                                  unit_in_use(lower),
                                  meaning)
                    : fmt::format("which is not \"{}\", because case matters here: write \"{}\"",
                                  lower,
                                  unit_in_use(lower));
      return std::nullopt;
    }
    return WordMeaning{std::move(meaning)};
  }

  static std::string_view unit_in_use(const std::string& lower) {
    for (const auto& row : unit_list::kWords)
      if (in_lower_case(row.written) == lower) return row.written;
    return lower;
  }

  std::string_view text_;
  const IsForeign& is_foreign_;
  std::size_t at_ = 0;
  int words_ = 0;
  bool is_wrong_ = false;
  std::string operator_;
  std::vector<Piece> pieces_;
};

/// Looks up texts whose meaning is not the product of the meanings of their words.
void read_together(UnitMeanings& result) {
  for (const auto& row : unit_list::kTogether)
    for (std::string& text : result.texts)
      if (text == row.written) text = row.meaning;
  for (const Ambiguous& row : unit_list::kAmbiguousTexts) {
    if (result.texts.front() != row.written) continue;
    result.spellings.assign(std::begin(row.meanings), std::end(row.meanings));
    result.texts.front() = listed_meaning(row.meanings[0]).value_or(std::string(row.meanings[0]));
  }
}

}  // namespace

UnitMeanings unit_meanings(std::string_view written, const IsForeign& is_foreign) {
  const std::string plain = plain_characters(written);
  for (const std::string_view text : {without_outer_blanks(plain), without_brackets(plain)}) {
    const std::string lower = in_lower_case(text);
    for (const auto& row : unit_list::kWhole)
      if (row.written == lower) return {{std::string(row.meaning)}, {}, false, ""};
  }
  Reading reading(without_brackets(plain), is_foreign);
  if (!reading.run()) return {{}, {}, false, reading.refusal};
  UnitMeanings result = reading.meanings();
  if (!result.texts.empty()) read_together(result);
  return result;
}

}  // namespace latsch
