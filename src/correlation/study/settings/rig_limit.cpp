// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/settings/rig_limit.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "base/unit_reading.h"
#include "base/unit_words/c_locale.h"

namespace latsch::correlation {

struct RigLimit::Term {
  std::function<double(const std::vector<double>&)> value;
  Unit::Dimension dimension = {};
  bool is_zero = false;  // true: a plain 0, which has every dimension
};

namespace {

using Term = RigLimit::Term;

// Relative excess up to which an equality of two rounded numbers still counts as fulfilled: a
// setting at the end of its range may lie on a limit.
constexpr double kRoundedLimit = 1e-9;

/// Thrown inside of the reader and turned into a Failure.
struct WrongLimit {
  std::string reason;
};

std::string named_dimension(const Unit::Dimension& dimension) {
  const std::string unit = si_unit(dimension);
  return unit == "1" ? "a plain number" : unit;
}

bool is_name_start(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool is_in_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
}

class LimitReader {
 public:
  LimitReader(const std::string& text,
              const LimitedNumbers& numbers,
              const std::vector<std::string>& names)
      : text_(text), numbers_(numbers), names_(names) {}

  /// Reads both sides; `relation` becomes "<", "<=", ">" or ">=".
  std::pair<Term, Term> sides(std::string& relation) {
    Term left = sum();
    skip();
    if (!is_next('<') && !is_next('>'))
      throw WrongLimit{at_ >= text_.size()
                           ? "has no <= or >=, expected a limit such as \"load <= 8 kN\""
                           : "has " + in_quotes(text_.substr(at_)) +
                                 " where an operator, <= or >= is expected"};
    relation = text_[at_++];
    if (is_next('=')) relation += text_[at_++];
    Term right = sum();
    skip();
    if (at_ < text_.size())
      throw WrongLimit{"has " + in_quotes(text_.substr(at_)) + " after its right side" +
                       (is_next('<') || is_next('>') ? "; write a second limit instead" : "")};
    if (!left.is_zero && !right.is_zero && left.dimension != right.dimension)
      throw WrongLimit{"compares " + named_dimension(left.dimension) + " with " +
                       named_dimension(right.dimension)};
    return {std::move(left), std::move(right)};
  }

 private:
  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool is_next(char c) const { return at_ < text_.size() && text_[at_] == c; }
  bool take(char c) {
    skip();
    if (!is_next(c)) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c))
      throw WrongLimit{std::string("lacks a ") + c +
                       (at_ < text_.size() ? " before " + in_quotes(text_.substr(at_)) : "")};
  }

  Term sum() {
    Term all = product();
    for (;;) {
      const bool adds = take('+');
      if (!adds && !take('-')) return all;
      const Term next = product();
      if (!all.is_zero && !next.is_zero && all.dimension != next.dimension)
        throw WrongLimit{"adds " + named_dimension(all.dimension) + " and " +
                         named_dimension(next.dimension)};
      const auto a = all.value, b = next.value;
      all = {[a, b, adds](const auto& s) { return adds ? a(s) + b(s) : a(s) - b(s); },
             all.is_zero ? next.dimension : all.dimension,
             all.is_zero && next.is_zero};
    }
  }

  Term product() {
    Term all = power();
    for (;;) {
      const bool multiplies = take('*');
      if (!multiplies && !take('/')) return all;
      const Term next = power();
      const auto a = all.value, b = next.value;
      Unit::Dimension dimension = all.dimension;
      for (std::size_t k = 0; k < dimension.size(); ++k)
        dimension[k] += multiplies ? next.dimension[k] : -next.dimension[k];
      all = {[a, b, multiplies](const auto& s) { return multiplies ? a(s) * b(s) : a(s) / b(s); },
             dimension,
             all.is_zero};
    }
  }

  Term power() {
    Term base = single();
    if (!take('^')) return base;
    skip();
    const bool is_negative = take('-');
    skip();
    std::size_t digits = at_;
    while (digits < text_.size() && std::isdigit(static_cast<unsigned char>(text_[digits])))
      ++digits;
    if (digits == at_ || digits - at_ > 1)
      throw WrongLimit{"has an exponent that is not a whole number from -9 to 9"};
    const int exponent = (text_[at_] - '0') * (is_negative ? -1 : 1);
    at_ = digits;
    const auto a = base.value;
    Unit::Dimension dimension = base.dimension;
    for (int& one : dimension) one *= exponent;
    return {[a, exponent](const auto& s) { return std::pow(a(s), exponent); }, dimension};
  }

  Term single() {
    skip();
    if (at_ >= text_.size()) throw WrongLimit{"ends where a number or a name is expected"};
    if (take('(')) {
      Term inner = sum();
      expect(')');
      return inner;
    }
    if (take('-')) {
      const Term inner = power();
      const auto a = inner.value;
      return {[a](const auto& s) { return -a(s); }, inner.dimension, inner.is_zero};
    }
    if (std::isdigit(static_cast<unsigned char>(text_[at_])) || is_next('.')) return quantity();
    if (is_name_start(text_[at_])) return name();
    throw WrongLimit{"has " + in_quotes(text_.substr(at_)) +
                     " where a number or a name is expected"};
  }

  std::string word() {
    const std::size_t from = at_;
    while (at_ < text_.size() && is_in_name(text_[at_])) ++at_;
    return text_.substr(from, at_ - from);
  }

  Term name() {
    const std::string word = this->word();
    skip();
    if (is_next('(')) return function(word);
    const auto number = numbers_(word);
    if (!number)
      throw WrongLimit{"has " + in_quotes(word) + ", which is not a number of the test" +
                       did_you_mean(word, names_) + "; there are " + list_of(names_)};
    if (number->setting < 0) {
      const double value = number->value;
      return {[value](const auto&) { return value; }, number->dimension};
    }
    const auto k = static_cast<std::size_t>(number->setting);
    return {[k](const auto& s) { return s[k]; }, number->dimension};
  }

  Term function(const std::string& name) {
    expect('(');
    const Term x = sum();
    const auto a = x.value;
    if (name == "min" || name == "max") {
      expect(',');
      const Term y = sum();
      expect(')');
      if (!x.is_zero && !y.is_zero && x.dimension != y.dimension)
        throw WrongLimit{"has " + name + " of " + named_dimension(x.dimension) + " and " +
                         named_dimension(y.dimension)};
      const auto b = y.value;
      const bool is_min = name == "min";
      return {[a, b, is_min](const auto& s) {
                return is_min ? std::min(a(s), b(s)) : std::max(a(s), b(s));
              },
              x.is_zero ? y.dimension : x.dimension};
    }
    expect(')');
    if (name == "abs") return {[a](const auto& s) { return std::abs(a(s)); }, x.dimension};
    if (name == "sqrt") {
      Unit::Dimension half = x.dimension;
      for (int& one : half) {
        if (one % 2 != 0) throw WrongLimit{"has sqrt of " + named_dimension(x.dimension)};
        one /= 2;
      }
      return {[a](const auto& s) { return std::sqrt(a(s)); }, half};
    }
    if (name != "sin" && name != "cos" && name != "tan")
      throw WrongLimit{"has " + in_quotes(name) +
                       ", expected abs, sqrt, sin, cos, tan, min or max before a parenthesis"};
    if (x.dimension != Unit::of("rad").dimension())
      throw WrongLimit{"has " + name + " of " + named_dimension(x.dimension) +
                       ", expected an angle"};
    const char kind = name[0];
    return {
        [a, kind](const auto& s) {
          const double angle = a(s);
          return kind == 's' ? std::sin(angle) : kind == 'c' ? std::cos(angle) : std::tan(angle);
        },
        {}};
  }

  /// Reads a number and the longest text after it that is a unit.
  Term quantity() {
    [[maybe_unused]] const CLocale decimal_points;
    std::size_t used = 0;
    double number = 0.0;
    try {
      number = std::stod(text_.substr(at_), &used);
    } catch (const std::exception&) {
      throw WrongLimit{"has " + in_quotes(text_.substr(at_)) + ", which is not a number"};
    }
    const bool is_zero = number == 0.0;
    at_ += used;
    skip();
    std::size_t end = at_;
    while (end < text_.size() && is_in_unit(end)) ++end;
    for (std::size_t to = end; to > at_; --to) {
      const std::string written(trimmed(text_.substr(at_, to - at_)));
      // a shorter text ends between words, never inside one
      if (to < text_.size() && is_in_name(text_[to]) && is_in_name(text_[to - 1])) continue;
      if (written.empty() || written.back() == '/' || written.back() == '^') continue;
      if (has_a_name(written)) continue;
      const auto unit = Unit::find(written);
      if (!unit) continue;
      at_ = to;
      const double si = unit->to_si(number);
      return {[si](const auto&) { return si; }, unit->dimension(), false};
    }
    if (end > at_ && is_name_start(text_[at_])) {
      std::size_t stop = at_;
      while (stop < end && is_in_name(text_[stop])) ++stop;
      throw WrongLimit{"has an " + unknown_unit(text_.substr(at_, stop - at_))};
    }
    return {[number](const auto&) { return number; }, {}, is_zero};
  }

  /// True if a word of the text is the name of a number of the test, which is then divided by.
  bool has_a_name(const std::string& text) const {
    for (std::size_t from = 0; from < text.size();) {
      std::size_t to = from;
      while (to < text.size() && is_in_name(text[to])) ++to;
      if (to > from &&
          std::find(names_.begin(), names_.end(), text.substr(from, to - from)) != names_.end())
        return true;
      from = std::max(to, from + 1);
    }
    return false;
  }

  /// True for a character that may belong to a unit: it is no operator between quantities.
  bool is_in_unit(std::size_t at) const {
    const char c = text_[at];
    if (c == '-') return at > at_ && text_[at - 1] == '^';
    if (c == '/' && at == at_) return false;
    return is_in_name(c) || c == ' ' || c == '/' || c == '^' || c == '%' ||
           static_cast<unsigned char>(c) >= 0x80;
  }

  const std::string& text_;
  const LimitedNumbers& numbers_;
  const std::vector<std::string>& names_;
  std::size_t at_ = 0;
};

}  // namespace

Result<RigLimit> RigLimit::read(const std::string& text,
                                const LimitedNumbers& numbers,
                                const std::vector<std::string>& names) {
  try {
    std::string relation;
    auto [left, right] = LimitReader(text, numbers, names).sides(relation);
    RigLimit limit;
    limit.text_ = text;
    limit.is_strict_ = relation.size() == 1;
    auto a = std::make_shared<const Term>(std::move(left));
    auto b = std::make_shared<const Term>(std::move(right));
    const bool is_upper = relation[0] == '<';
    limit.lower_ = is_upper ? a : b;
    limit.upper_ = is_upper ? b : a;
    return limit;
  } catch (const WrongLimit& wrong) {
    return Failure{wrong.reason};
  }
}

bool RigLimit::holds(const std::vector<double>& settings) const {
  const double a = lower_->value(settings), b = upper_->value(settings);
  if (is_strict_) return a < b;
  return a <= b + kRoundedLimit * std::max(std::abs(a), std::abs(b));
}

}  // namespace latsch::correlation
