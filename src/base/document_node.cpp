// SPDX-License-Identifier: Apache-2.0
#include "base/document_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/toml/toml_text.h"
#include "base/unit_reading.h"

namespace latsch {
namespace {

using Kind = DocumentValue::Kind;
using Declared = DeclaredKey::Kind;

/// Returns a description with an example: `an angle such as "22 deg"`.
std::string expectation(const Unit& unit) {
  const DimensionWords words = words_for(unit);
  if (unit.dimensionless()) return words.noun + " such as " + words.example;
  return words.noun + " such as " + in_quotes(words.example);
}

[[noreturn]] void reject_value(const DocumentTree& tree,
                               const DocumentValue& value,
                               const std::string& message) {
  throw InputError({tree.file(), value.line}, value.path + " " + message);
}

/// Says why a value is not a finite number of the expected dimension.
std::string fault_of(const DocumentValue& value, const Unit& expected) {
  const std::string found = "is " + written(value) + ", ";
  if (value.kind == Kind::number && value.unit.empty() && !expected.dimensionless()) {
    const DimensionWords words = words_for(expected);
    return found + "expected " + words.noun + " with its unit, such as " + in_quotes(words.example);
  }
  std::string wanted = found + "expected " + expectation(expected);
  if (value.kind == Kind::number && !value.unit.empty() && !Unit::find(value.unit))
    return wanted + " (" + unknown_unit(value.unit) + ")";
  if (value.kind == Kind::number && value.unit.empty()) return found + "expected a finite number";
  if (value.kind != Kind::text) return wanted;
  const auto parts = split_number(value.text);
  if (!parts || parts->rest.empty()) return wanted;
  const auto unit = Unit::find(parts->rest);
  if (!unit) return wanted + " (" + unknown_unit(parts->rest) + ")";
  return std::isfinite(unit->to_si(parts->number)) ? wanted : found + "expected a finite number";
}

/// Describes a range in the unit the value is written in: "more than 0 mm", "0 to 1", "at least 3
/// bar".
std::string describe(const Range& range, const Unit& unit) {
  const auto bound = [&](double si) {
    // Significant digits of a bound in a message. More digits would show the rounding error of a
    // bound such as 90 deg, which is stored in radians.
    constexpr int kDigits = 5;
    const std::string number = format_number(unit.from_si(si), kDigits);
    return unit.text() == "1" ? number : number + " " + unit.text();
  };
  const bool above = std::isfinite(range.lower), below = std::isfinite(range.upper);
  if (above && below)
    return (range.lower_excluded ? "more than " + bound(range.lower) + " and at most "
                                 : bound(range.lower) + " to ") +
           bound(range.upper);
  if (below) return "at most " + bound(range.upper);
  return (range.lower_excluded ? "more than " : "at least ") + bound(range.lower);
}

bool contains(const Range& range, double value) {
  return range.lower_excluded ? value > range.lower && value <= range.upper
                              : value >= range.lower && value <= range.upper;
}

double read_number(const DocumentTree& tree,
                   const DocumentChanges& changes,
                   int index,
                   const Unit& expected,
                   const Range& range) {
  const auto& number = tree.value(index).number;
  const auto reject = [&](const std::string& message) {
    reject_value(tree, tree.value(index), message);
  };
  if (!number) reject(fault_of(tree.value_now(index, changes), expected));
  Unit unit = number->unit;
  double si = tree.si(index, changes);
  if (!unit.same_dimension(expected)) {
    // A word with several meanings, such as "lb", is read with the meaning that fits the expected
    // dimension.
    const auto meant = find_unit(unit.text(), expected);
    const auto digits = split_number(tree.value_now(index, changes).text);
    if (!meant || !meant->same_dimension(expected) || !digits)
      reject(fault_of(tree.value_now(index, changes), expected));
    unit = *meant;
    si = unit.to_si(digits->number);
  }
  if (!contains(range, si))
    reject("is " + written(tree.value_now(index, changes)) + ", expected " + describe(range, unit));
  return si;
}

}  // namespace

std::string written(const DocumentValue& value) {
  switch (value.kind) {
    case Kind::table:
      return "a table";
    case Kind::list:
      return "a list";
    case Kind::text:
      return in_quotes(value.text);
    case Kind::flag:
      return value.flag ? "true" : "false";
    case Kind::date:
      return "a date or time";
    case Kind::number:
      return value.unit.empty() ? value.text : in_quotes(value.text + " " + value.unit);
  }
  return "";
}

int Node::Impl::ask(std::string_view key) const {
  (*asked)[index].emplace(key);
  const int found = tree->child(index, key);
  if (record) record->ask(value().path, key, found >= 0);
  return found;
}

std::shared_ptr<const Node::Impl> Node::Impl::at(int table) const {
  Impl other = *this;
  other.index = table;
  return std::make_shared<Impl>(std::move(other));
}

void Node::Impl::reject_missing(std::string_view key, const std::string& expected) const {
  // Greatest edit distance, in letters, at which a missing key counts as misspelled rather than
  // absent. A larger value would take "inside" for "outside".
  constexpr int kMisspelling = 2;
  constexpr std::size_t kShortest = 4;
  for (const int child : value().children) {
    const DocumentValue& other = tree->value(child);
    if (!(*asked)[index].contains(other.key) && key.size() >= kShortest &&
        edit_distance(key, other.key.substr(0, 2 * key.size())) <= kMisspelling)
      throw InputError(
          tree->place(child),
          "unknown key " + in_quotes(other.path) + ", did you mean " + in_quotes(key) + "?");
  }
  const std::string& path = value().path;
  throw InputError(
      tree->place(index),
      (path.empty() ? "" : path + ".") + std::string(key) + " is missing, " + expected);
}

bool Node::has(std::string_view key) const {
  impl_->declare(key, [] { return DeclaredKey{}; });
  return impl_->ask(key) >= 0;
}

double Node::quantity(std::string_view key, std::string_view unit, Range range) const {
  const Unit expected = Unit::of(unit);
  const int value = impl_->ask(key);
  impl_->declare(key, [&] {
    return DeclaredKey{.kind = Declared::quantity, .units = {std::string(unit)}, .range = range};
  });
  if (value < 0) impl_->reject_missing(key, "expected " + expectation(expected));
  const double si = read_number(*impl_->tree, *impl_->changes, value, expected, range);
  impl_->declare(
      key, [&] { return DeclaredKey{.kind = Declared::quantity, .value = canonical(si, unit)}; });
  return si;
}

double Node::quantity(std::string_view key,
                      std::string_view unit,
                      Range range,
                      double fallback) const {
  impl_->declare(key, [&] {
    return DeclaredKey{.kind = Declared::quantity,
                       .units = {std::string(unit)},
                       .range = range,
                       .fallback = canonical(fallback, unit)};
  });
  return has(key) ? quantity(key, unit, range) : fallback;
}

std::vector<double> Node::quantities(std::string_view key,
                                     std::string_view unit,
                                     Range range) const {
  const Unit expected = Unit::of(unit);
  const int list = impl_->ask(key);
  const auto wanted = [&] { return "expected a list of values, each " + expectation(expected); };
  impl_->declare(key, [&] {
    return DeclaredKey{.kind = Declared::quantities, .units = {std::string(unit)}, .range = range};
  });
  if (list < 0) impl_->reject_missing(key, wanted());
  if (impl_->kind(list) != Kind::list)
    reject(key, "is " + written(impl_->now(list)) + ", " + wanted());
  std::vector<double> values;
  for (const int child : impl_->tree->value(list).children)
    values.push_back(read_number(*impl_->tree, *impl_->changes, child, expected, range));
  impl_->declare(key, [&] {
    return DeclaredKey{.kind = Declared::quantities, .value = canonical(values, unit)};
  });
  return values;
}

std::vector<double> Node::one_or_more(std::string_view key,
                                      std::string_view unit,
                                      Range range) const {
  const int value = impl_->ask(key);
  const bool is_one = value >= 0 && impl_->kind(value) != Kind::list;
  const std::vector<double> values =
      is_one ? std::vector<double>{quantity(key, unit, range)} : quantities(key, unit, range);
  impl_->declare(key, [&] {
    return DeclaredKey{.kind = Declared::one_or_more, .value = canonical(values, unit)};
  });
  return values;
}

std::vector<std::vector<double>> Node::rows(std::string_view key,
                                            const std::vector<std::string>& units) const {
  std::vector<Unit> expected;
  expected.reserve(units.size());
  for (const std::string& unit : units) expected.push_back(Unit::of(unit));
  const int list = impl_->ask(key);
  const std::string wanted = fmt::format("expected a list of rows of {} values", units.size());
  impl_->declare(key, [&] { return DeclaredKey{.kind = Declared::rows, .units = units}; });
  if (list < 0) impl_->reject_missing(key, wanted);
  if (impl_->kind(list) != Kind::list)
    reject(key, "is " + written(impl_->now(list)) + ", " + wanted);
  std::vector<std::vector<double>> rows;
  for (const int child : impl_->tree->value(list).children) {
    const DocumentValue& row = impl_->tree->value(child);
    if (row.kind != Kind::list)
      reject_value(*impl_->tree, row, "is " + written(impl_->now(child)) + ", " + wanted);
    if (row.children.size() != units.size())
      reject_value(
          *impl_->tree,
          row,
          fmt::format(
              "has {} values, expected {} in every row", row.children.size(), units.size()));
    rows.emplace_back();
    for (std::size_t i = 0; i < units.size(); ++i)
      rows.back().push_back(
          read_number(*impl_->tree, *impl_->changes, row.children[i], expected[i], {}));
  }
  impl_->declare(
      key, [&] { return DeclaredKey{.kind = Declared::rows, .value = canonical(rows, units)}; });
  return rows;
}

long Node::integer(std::string_view key, long lower, long upper) const {
  const int index = impl_->ask(key);
  const std::string wanted = fmt::format("expected an integer from {} to {}", lower, upper);
  impl_->declare(key, [&] {
    return DeclaredKey{
        .kind = Declared::integer,
        .range = Range::between(static_cast<double>(lower), static_cast<double>(upper))};
  });
  if (index < 0) impl_->reject_missing(key, wanted);
  const DocumentValue value = impl_->now(index);
  if (value.kind == Kind::number && value.integer && value.unit.empty()) {
    const long found = std::stol(value.text);
    if (found >= lower && found <= upper) {
      impl_->declare(key, [&] {
        return DeclaredKey{.kind = Declared::integer, .value = std::to_string(found)};
      });
      return found;
    }
  }
  reject(key, "is " + written(value) + ", " + wanted);
}

long Node::integer(std::string_view key, long lower, long upper, long fallback) const {
  impl_->declare(key, [&] {
    return DeclaredKey{
        .kind = Declared::integer,
        .range = Range::between(static_cast<double>(lower), static_cast<double>(upper)),
        .fallback = std::to_string(fallback)};
  });
  return has(key) ? integer(key, lower, upper) : fallback;
}

bool Node::flag(std::string_view key, bool fallback) const {
  const int value = impl_->ask(key);
  impl_->declare(key, [&] {
    return DeclaredKey{.kind = Declared::flag, .fallback = fallback ? "true" : "false"};
  });
  if (value < 0) return fallback;
  if (impl_->kind(value) != Kind::flag)
    reject(key, "is " + written(impl_->now(value)) + ", expected true or false");
  const bool flag = impl_->tree->value(value).flag;
  impl_->declare(
      key, [&] { return DeclaredKey{.kind = Declared::flag, .value = flag ? "true" : "false"}; });
  return flag;
}

std::string Node::text(std::string_view key) const {
  const int index = impl_->ask(key);
  impl_->declare(key, [&] { return DeclaredKey{.kind = Declared::text}; });
  if (index < 0) impl_->reject_missing(key, "expected a text in quotes");
  DocumentValue value = impl_->now(index);
  if (value.kind != Kind::text) reject(key, "is " + written(value) + ", expected a text in quotes");
  impl_->declare(
      key, [&] { return DeclaredKey{.kind = Declared::text, .value = toml_text(value.text)}; });
  return std::move(value.text);
}

std::string Node::text(std::string_view key, std::string_view fallback) const {
  impl_->declare(
      key, [&] { return DeclaredKey{.kind = Declared::text, .fallback = toml_text(fallback)}; });
  return has(key) ? text(key) : std::string(fallback);
}

std::string Node::choice(std::string_view key, const std::vector<std::string>& allowed) const {
  const int index = impl_->ask(key);
  impl_->declare(key, [&] { return DeclaredKey{.kind = Declared::choice, .choices = allowed}; });
  if (index < 0) impl_->reject_missing(key, "expected " + list_of(allowed));
  const DocumentValue value = impl_->now(index);
  if (value.kind == Kind::text &&
      std::find(allowed.begin(), allowed.end(), value.text) != allowed.end()) {
    impl_->declare(
        key, [&] { return DeclaredKey{.kind = Declared::choice, .value = toml_text(value.text)}; });
    return value.text;
  }
  reject(key,
         "is " + written(value) + ", expected " + list_of(allowed) +
             (value.kind == Kind::text ? did_you_mean(value.text, allowed) : ""));
}

std::string Node::choice(std::string_view key,
                         const std::vector<std::string>& allowed,
                         std::string_view fallback) const {
  impl_->declare(key, [&] {
    return DeclaredKey{
        .kind = Declared::choice, .choices = allowed, .fallback = toml_text(fallback)};
  });
  return has(key) ? choice(key, allowed) : std::string(fallback);
}

std::vector<std::string> Node::texts(std::string_view key) const {
  const int list = impl_->ask(key);
  const std::string wanted = "expected a list of texts in quotes";
  impl_->declare(key, [&] { return DeclaredKey{.kind = Declared::texts}; });
  if (list < 0) impl_->reject_missing(key, wanted);
  if (impl_->kind(list) != Kind::list)
    reject(key, "is " + written(impl_->now(list)) + ", " + wanted);
  std::vector<std::string> texts;
  for (const int child : impl_->tree->value(list).children) {
    const DocumentValue value = impl_->now(child);
    if (value.kind != Kind::text)
      reject_value(*impl_->tree, value, "is " + written(value) + ", expected a text in quotes");
    texts.push_back(value.text);
  }
  impl_->declare(key,
                 [&] { return DeclaredKey{.kind = Declared::texts, .value = canonical(texts)}; });
  return texts;
}

Node Node::table(std::string_view key) const {
  if (auto table = find_table(key)) return *table;
  const std::string prefix = path().empty() ? "" : path() + ".";
  impl_->reject_missing(key, "expected a table [" + prefix + std::string(key) + "]");
}

std::optional<Node> Node::find_table(std::string_view key) const {
  const int value = impl_->ask(key);
  impl_->declare(key, [&] { return DeclaredKey{.kind = Declared::table}; });
  if (value < 0) return std::nullopt;
  if (impl_->kind(value) != Kind::table)
    reject(key, "is " + written(impl_->now(value)) + ", expected a table");
  return Node(impl_->at(value));
}

std::vector<Node> Node::named_tables(std::string_view key) const {
  const int index = impl_->ask(key);
  impl_->declare(key, [&] { return DeclaredKey{.kind = Declared::tables}; });
  std::vector<Node> nodes;
  if (index < 0) return nodes;
  if (impl_->kind(index) != Kind::table && impl_->kind(index) != Kind::list)
    reject(key, "is " + written(impl_->now(index)) + ", expected tables below it");
  for (const int child : impl_->tree->value(index).children) {
    const DocumentValue& value = impl_->tree->value(child);
    if (value.kind != Kind::table)
      reject_value(*impl_->tree, value, "is " + written(impl_->now(child)) + ", expected a table");
    (*impl_->asked)[index].emplace(value.key);
    nodes.push_back(Node(impl_->at(child)));
  }
  std::vector<std::string> names;
  for (const Node& node : nodes) names.push_back(node.name());
  impl_->declare(key,
                 [&] { return DeclaredKey{.kind = Declared::tables, .value = canonical(names)}; });
  return nodes;
}

std::vector<std::string> Node::keys() const {
  std::vector<std::string> keys;
  for (const int child : impl_->value().children) keys.push_back(impl_->tree->value(child).key);
  return keys;
}

const std::string& Node::name() const { return impl_->value().key; }

const std::string& Node::path() const { return impl_->value().path; }

Place Node::place() const { return impl_->tree->place(impl_->index); }

Place Node::place(std::string_view key) const {
  const int child = impl_->tree->child(impl_->index, key);
  return impl_->tree->place(child < 0 ? impl_->index : child);
}

void Node::reject(std::string_view key, const std::string& message) const {
  const std::string prefix = path().empty() ? "" : path() + ".";
  throw InputError(place(key), prefix + std::string(key) + " " + message);
}

void Node::close() const {
  const auto& known = (*impl_->asked)[impl_->index];
  for (const int child : impl_->value().children) {
    const DocumentValue& value = impl_->tree->value(child);
    if (!known.contains(value.key))
      throw InputError({impl_->tree->file(), value.line},
                       "unknown key " + in_quotes(value.path) +
                           did_you_mean(value.key, {known.begin(), known.end()}));
    const auto is_table = [&](int i) { return impl_->tree->value(i).kind == Kind::table; };
    // named_tables() reads both [[kind]] and [kind.name].
    const bool list_of_tables =
        value.kind == Kind::list && !value.children.empty() && is_table(value.children.front());
    if (is_table(child) || list_of_tables) Node(impl_->at(child)).close();
  }
}

}  // namespace latsch
