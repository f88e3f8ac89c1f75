// SPDX-License-Identifier: Apache-2.0
#include "formats/text/teim_orbit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/file.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "base/utf8.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLongestOrbitLine = 64u << 10;

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == ',' || c == ';'; }

/// Fortran programs write 1.5D3 instead of 1.5E3.
std::optional<double> number_in(std::string_view text) {
  std::string c_form(text);
  std::replace(c_form.begin(), c_form.end(), 'D', 'E');
  std::replace(c_form.begin(), c_form.end(), 'd', 'e');
  const std::optional<double> number = parse_number(c_form);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::string no_number(const std::string& what, const std::string& found) {
  std::string hint;
  if (const auto comma = found.find(','); comma != std::string::npos) {
    hint = "; decimals are written with a point";
    std::string without = found;
    without.erase(std::remove(without.begin(), without.end(), ','), without.end());
    const auto digits = found.find_first_not_of("0123456789", comma + 1);
    const auto behind = (digits == std::string::npos ? found.size() : digits) - comma - 1;
    if (behind == 3 && number_in(without))
      hint += ", and thousands without a mark: " + without + " if the comma separates thousands";
  }
  return fmt::format("{} is {}, expected a finite number{}", what, in_quotes(found), hint);
}

}  // namespace

/// Parses the text line by line.
class TeimOrbitReader {
 public:
  explicit TeimOrbitReader(TeimOrbit& into) : into_(into) {}

  void read() {
    const std::string_view text = into_.source_;
    refuse_utf16(text, into_.file());
    std::size_t begin = text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
    while (begin < text.size()) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      ++line_;
      if (end - begin > kLongestOrbitLine) reject("a line longer than 64 kB");
      read_line(text.substr(begin, end - begin), begin);
      begin = end + 1;
    }
  }

 private:
  [[noreturn]] void reject(const std::string& message) const {
    throw InputError(Place{into_.file(), line_}, message);
  }

  /// Returns the position at which a comment begins, or the end of the line. A comment mark inside
  /// quotes is text.
  std::size_t comment_of(std::string_view line) const {
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '\0') reject("a zero byte: this is not a text file");
      if (line[i] == '\'') quoted = !quoted;
      if (!quoted && (line[i] == '$' || line[i] == '!')) return i;
    }
    if (quoted) reject("a quote is not closed: " + in_quotes(trimmed(line)));
    return line.size();
  }

  void read_line(std::string_view line, std::size_t offset) {
    const std::size_t mark = comment_of(line);
    const std::string_view content = trimmed(line.substr(0, mark));
    if (content.empty()) return;
    const std::string_view comment =
        mark < line.size() ? trimmed(line.substr(mark + 1)) : std::string_view{};
    switch (content.front()) {
      case '[':
        return open_section(inside(content, ']'));
      case '(':
        return open_block(inside(content, ')'));
      case '{':
        return open_table(inside(content, '}'));
      default:
        break;
    }
    const std::size_t equals = content.find('=');
    const std::size_t quote = content.find('\'');
    if (equals != std::string_view::npos && (quote == std::string_view::npos || equals < quote))
      return read_entry(content, equals, offset + (content.data() - line.data()), comment);
    read_row(content);
  }

  std::string inside(std::string_view content, char close) const {
    const std::size_t end = content.find(close);
    if (end == std::string_view::npos)
      reject(fmt::format("{} has no \"{}\"", in_quotes(content), close));
    if (end + 1 != content.size())
      reject(fmt::format("{} behind \"{}\", expected the end of the line",
                         in_quotes(trimmed(content.substr(end + 1))),
                         close));
    return capitals(trimmed(content.substr(1, end - 1)));
  }

  TeimOrbitSection& section() {
    if (into_.sections_.empty())
      reject("this precedes the first [SECTION]: is it a file of another kind?");
    return into_.sections_.back();
  }

  void open_section(const std::string& name) {
    if (name.empty()) reject("[] has no name");
    into_.sections_.emplace_back(name, into_.file_, line_);
    block_.clear();
    table_open_ = false;
  }

  void open_block(const std::string& name) {
    section().blocks_.push_back(name);
    block_ = name;
    table_open_ = false;
  }

  void open_table(const std::string& heads) {
    section().tables_.push_back({block_, split(heads), {}, line_});
    table_open_ = true;
  }

  void read_row(std::string_view content) {
    TeimOrbitSection& here = section();
    if (!table_open_) {
      // A single word is not a row of a table: the equals sign of a key is probably missing.
      const std::vector<std::string> fields = split(content);
      const bool row = content.front() == '\'' || (!fields.empty() && number_in(fields[0]));
      if (!row && block_.empty())
        reject(in_quotes(content) + " is no KEY = value, [SECTION], {heads} or row of a table");
      here.tables_.push_back({block_, {}, {}, line_});
      table_open_ = true;
    }
    here.tables_.back().rows.push_back({split(content), line_});
  }

  /// Splits the text into fields separated by blanks, commas or semicolons; a quoted text is one
  /// field.
  std::vector<std::string> split(std::string_view text) const {
    std::vector<std::string> fields;
    std::size_t i = 0;
    while (i < text.size()) {
      if (blank(text[i])) {
        ++i;
      } else if (text[i] == '\'') {
        const std::size_t end = std::min(text.find('\'', i + 1), text.size());
        fields.emplace_back(text.substr(i + 1, end - i - 1));
        i = std::min(end + 1, text.size());
      } else {
        const std::size_t begin = i;
        while (i < text.size() && !blank(text[i]) && text[i] != '\'') ++i;
        fields.emplace_back(text.substr(begin, i - begin));
      }
    }
    return fields;
  }

  void read_entry(std::string_view content,
                  std::size_t equals,
                  std::size_t offset,
                  std::string_view comment) {
    TeimOrbitEntry entry;
    entry.key = capitals(trimmed(content.substr(0, equals)));
    if (entry.key.empty()) reject("\"=\" without a key before it");
    std::string_view value = trimmed(content.substr(equals + 1));
    entry.line = line_;
    entry.begin = value.empty() ? offset + content.size()
                                : offset + static_cast<std::size_t>(value.data() - content.data());
    entry.end = entry.begin + value.size();
    entry.comment = comment;
    if (!value.empty() && value.front() == '\'') {
      entry.quoted = true;
      const std::size_t end = value.find('\'', 1);
      if (end + 1 != value.size())
        reject(fmt::format("{} behind the text of {}, expected the end of the line or a comment",
                           in_quotes(trimmed(value.substr(end + 1))),
                           entry.key));
      value = value.substr(1, end - 1);
    }
    // Some programs write texts in double quotes, which are removed.
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
      value = value.substr(1, value.size() - 2);
    entry.value = std::string(trimmed(value));
    section().entries_.push_back(std::move(entry));
    table_open_ = false;
  }

  TeimOrbit& into_;
  int line_ = 0;
  std::string block_;
  bool table_open_ = false;
};

TeimOrbitSection::TeimOrbitSection(std::string name,
                                   std::shared_ptr<const std::string> file,
                                   int line)
    : name_(std::move(name)), file_(std::move(file)), line_(line) {}

const TeimOrbitEntry* TeimOrbitSection::find(std::string_view key) const {
  const std::string wanted = capitals(key);
  const TeimOrbitEntry* found = nullptr;
  read_->insert(line_);
  for (const TeimOrbitEntry& entry : entries_) {
    if (entry.key != wanted) continue;
    read_->insert(entry.line);
    if (found != nullptr && found->value != entry.value)
      throw InputError(place(entry.line),
                       fmt::format("{} is {}, but line {} says {}; keep one of them",
                                   wanted,
                                   in_quotes(entry.value),
                                   found->line,
                                   in_quotes(found->value)));
    if (found == nullptr) found = &entry;
  }
  return found;
}

double TeimOrbitSection::number(const TeimOrbitEntry& entry) const {
  const std::optional<double> number =
      entry.quoted ? std::optional<double>{} : number_in(entry.value);
  if (!number) throw InputError(place(entry.line), no_number(entry.key, entry.value));
  return *number;
}

double TeimOrbitSection::number(std::string_view key) const {
  const TeimOrbitEntry* entry = find(key);
  if (entry == nullptr)
    throw InputError(place(), fmt::format("[{}] has no {}", name_, capitals(key)));
  return number(*entry);
}

double TeimOrbitSection::number(std::string_view key, double fallback) const {
  const TeimOrbitEntry* entry = find(key);
  return entry == nullptr ? fallback : number(*entry);
}

long TeimOrbitSection::integer(std::string_view key, long fallback) const {
  const TeimOrbitEntry* entry = find(key);
  if (entry == nullptr) return fallback;
  const double value = number(*entry);
  if (value != std::floor(value) || std::abs(value) > 1e9)
    throw InputError(
        place(entry->line),
        fmt::format("{} is {}, expected an integer", entry->key, in_quotes(entry->value)));
  return static_cast<long>(value);
}

std::string TeimOrbitSection::text(std::string_view key) const {
  const TeimOrbitEntry* entry = find(key);
  if (entry == nullptr)
    throw InputError(place(), fmt::format("[{}] has no {}", name_, capitals(key)));
  return entry->value;
}

std::string TeimOrbitSection::text(std::string_view key, std::string_view fallback) const {
  const TeimOrbitEntry* entry = find(key);
  return entry == nullptr ? std::string(fallback) : entry->value;
}

const TeimOrbitTable* TeimOrbitSection::find_table(std::string_view block) const {
  const std::string wanted = capitals(block);
  for (const TeimOrbitTable& table : tables_)
    if (table.block == wanted) {
      read_->insert(table.line);
      return &table;
    }
  return nullptr;
}

const std::vector<TeimOrbitTable>& TeimOrbitSection::tables() const {
  for (const TeimOrbitTable& table : tables_) read_->insert(table.line);
  return tables_;
}

std::vector<double> TeimOrbitSection::numbers(const TeimOrbitRow& row, std::size_t width) const {
  if (row.fields.size() < width)
    throw InputError(
        place(row.line),
        fmt::format("a row of {} fields, expected {} numbers", row.fields.size(), width));
  std::vector<double> numbers;
  numbers.reserve(row.fields.size());
  for (std::size_t i = 0; i < row.fields.size(); ++i) {
    const std::optional<double> number = number_in(row.fields[i]);
    if (!number)
      throw InputError(place(row.line), no_number(fmt::format("field {}", i + 1), row.fields[i]));
    numbers.push_back(*number);
  }
  return numbers;
}

TeimOrbit TeimOrbit::parse(std::string text, std::string file_name) {
  TeimOrbit result;
  result.file_ = std::make_shared<const std::string>(std::move(file_name));
  result.source_ = std::move(text);
  TeimOrbitReader(result).read();
  return result;
}

TeimOrbit TeimOrbit::read(const std::filesystem::path& file) {
  return parse(read_text_file(file, 512u << 20), file.string());
}

const TeimOrbitSection* TeimOrbit::find(std::string_view section) const {
  const std::string wanted = capitals(section);
  for (const TeimOrbitSection& candidate : sections_)
    if (candidate.name() == wanted) return &candidate;
  return nullptr;
}

const TeimOrbitSection& TeimOrbit::section(std::string_view name) const {
  const TeimOrbitSection* found = find(name);
  if (found == nullptr)
    throw InputError(Place{*file_, 0}, fmt::format("there is no section [{}]", capitals(name)));
  return *found;
}

namespace {

/// A key of [UNITS] with its dimension, and its names in messages.
struct UnitKey {
  std::string_view key, si, in_words, plural, names, example;
};
constexpr std::array<UnitKey, 6> kUnitKeys = {{
    {"LENGTH",
     "m",
     "meter",
     "lengths",
     "'meter', 'mm', 'cm', 'km', 'inch', 'foot' or 'mile'",
     "mm"},
    {"FORCE",
     "N",
     "newton",
     "forces",
     "'newton', 'knewton', 'pound_force', 'kilogram_force', 'ounce_force' or 'dyne'",
     "newton"},
    {"ANGLE", "rad", "radian", "angles", "'radians' or 'degrees'", "degrees"},
    {"MASS",
     "kg",
     "kg",
     "masses",
     "'kg', 'gram', 'megagram', 'pound_mass', 'ounce_mass' or 'slug'",
     "kg"},
    {"TIME", "s", "second", "times", "'second', 'millisecond', 'minute' or 'hour'", "second"},
    {"PRESSURE",
     "Pa",
     "pascal",
     "pressures",
     "'pascal', 'kpascal', 'mpascal', 'bar' or 'psi'",
     "pascal"},
}};
constexpr std::size_t kPressureKey = 5;

std::optional<double> stated_unit(const TeimOrbitSection& section, const UnitKey& known) {
  const TeimOrbitEntry* entry = section.find(known.key);
  if (entry == nullptr) return std::nullopt;
  const Unit expected = Unit::of(known.si);
  const UnitReading reading = reading_of_unit(entry->value, expected);
  if (reading.unit && reading.unit->same_dimension(expected) && reading.unit->to_si(0.0L) == 0.0)
    return reading.unit->to_si(1.0L);
  throw InputError(
      section.place(entry->line),
      fmt::format("{} = {} {}, expected {} such as {}",
                  known.key,
                  in_quotes(entry->value),
                  reading.unit ? "is a unit of something else" : "is refused: " + reading.fault,
                  words_for(expected).noun,
                  known.names));
}

}  // namespace

double TeimOrbitUnits::of(std::size_t key) const {
  if (stated_[key]) return *stated_[key];
  if (missing_ == Missing::is_si) return 1.0;
  const UnitKey& known = kUnitKeys[key];
  std::vector<std::string> others = missing();
  std::erase(others, std::string(known.key));
  throw InputError(
      place_,
      fmt::format(
          "{}, so that the unit of the {} in this file is not known: add the line {} = '{}' "
          "{}, with the unit in which the file is written ({}){}",
          has_section_ ? fmt::format("[UNITS] has no {}", known.key)
                       : std::string("there is no section [UNITS]"),
          known.plural,
          known.key,
          known.example,
          has_section_ ? "below it" : "below a line [UNITS]",
          known.names,
          others.empty() ? ""
                         : fmt::format("; {} {} missing, too",
                                       fmt::join(others, ", "),
                                       others.size() == 1 ? "is" : "are")));
}

double TeimOrbitUnits::pressure() const {
  return stated_[kPressureKey] ? *stated_[kPressureKey] : force() / (length() * length());
}

std::vector<std::string> TeimOrbitUnits::missing() const {
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < kPressureKey; ++i)
    if (!stated_[i]) keys.emplace_back(kUnitKeys[i].key);
  return keys;
}

std::string TeimOrbitUnits::si_in_words(std::string_view key) {
  for (const UnitKey& known : kUnitKeys)
    if (known.key == key) return std::string(known.in_words);
  return {};
}

TeimOrbitUnits TeimOrbit::units(TeimOrbitUnits::Missing missing) const {
  TeimOrbitUnits units;
  units.missing_ = missing;
  const TeimOrbitSection* section = find("UNITS");
  units.has_section_ = section != nullptr;
  units.place_ = section ? section->place() : Place{*file_, 0};
  if (section != nullptr)
    for (std::size_t i = 0; i < kUnitKeys.size(); ++i)
      units.stated_[i] = stated_unit(*section, kUnitKeys[i]);
  return units;
}

std::vector<TeimOrbitPart> TeimOrbit::unread() const {
  std::vector<TeimOrbitPart> unread;
  std::set<std::string> seen;
  for (const TeimOrbitSection& section : sections_) {
    const bool again = !seen.insert(section.name_).second;
    if (section.name_ == "MDI_HEADER") continue;
    const bool holds = !section.entries_.empty() || !section.tables_.empty();
    if (holds && section.read_->empty()) {
      unread.push_back(
          {fmt::format("{}[{}]", again ? "a second " : "", section.name_), section.line_});
      continue;
    }
    for (const TeimOrbitEntry& entry : section.entries_)
      if (!section.read_->contains(entry.line))
        unread.push_back({fmt::format("[{}] {}", section.name_, entry.key), entry.line});
    for (const TeimOrbitTable& table : section.tables_)
      if (!section.read_->contains(table.line))
        unread.push_back(
            {fmt::format("[{}] {{{}}}", section.name_, fmt::join(table.heads, " ")), table.line});
  }
  return unread;
}

std::string TeimOrbit::with_values(
    const std::map<const TeimOrbitEntry*, std::string>& values) const {
  std::vector<std::pair<const TeimOrbitEntry*, const std::string*>> in_order;
  for (const auto& [entry, value] : values) in_order.emplace_back(entry, &value);
  std::sort(in_order.begin(), in_order.end(), [](const auto& a, const auto& b) {
    return a.first->begin < b.first->begin;
  });
  std::string text;
  std::size_t done = 0;
  for (const auto& [entry, value] : in_order) {
    text.append(source_, done, entry->begin - done);
    text += *value;
    done = entry->end;
  }
  return text.append(source_, done);
}

}  // namespace latsch::formats
