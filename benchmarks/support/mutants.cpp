// SPDX-License-Identifier: Apache-2.0
#include "mutants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>

#include "base/text.h"
#include "base/units.h"

namespace latsch::benchmarks {
namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  for (std::string& part : parts) part = std::string(trimmed(part));
  return parts;
}

std::string in_case(std::string text, int (*to)(int)) {
  for (char& c : text) c = static_cast<char>(to(static_cast<unsigned char>(c)));
  return text;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

std::string utf16(const std::string& text) {
  std::string wide = "\xFF\xFE";
  for (const char c : text) wide += {c, '\0'};
  return wide;
}

/// A unit, another unit of the same quantity, and the divisor that converts a number from the first
/// to the second.
struct Other {
  const char *unit, *other;
  double divisor;
};
constexpr Other kOthers[] = {{"N", "kN", 1e3},
                             {"mm", "m", 1e3},
                             {"m", "mm", 1e-3},
                             {"s", "ms", 1e-3},
                             {"kPa", "bar", 100.0},
                             {"Hz", "kHz", 1e3},
                             {"km/h", "m/s", 3.6},
                             {"cm^2", "mm^2", 1e-2}};

/// True for columns that are known to be positive, so that a reader can notice if the sign of the
/// whole column is reversed.
bool has_a_sign(const std::string& name) {
  const std::string plain = in_case(name, std::tolower);
  for (const char* one : {"fz", "force", "loaded_radius", "deflection", "frequency", "p", "load"})
    if (plain == one) return true;
  return false;
}

bool is_positive(const TableText& table, std::size_t column) {
  return std::all_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
    return std::atof(row[column].c_str()) > 0.0;
  });
}

std::optional<std::size_t> find(const TableText& table,
                                const std::function<bool(std::size_t)>& wanted) {
  for (std::size_t i = 0; i < table.names.size(); ++i)
    if (wanted(i)) return i;
  return std::nullopt;
}

class TableMutants {
 public:
  explicit TableMutants(const TableText& good) : good_(good) {}

  void add(const std::string& change,
           std::optional<std::size_t> column,
           Allowed allowed,
           const std::function<void(TableText&)>& apply) {
    TableText mutant = good_;
    apply(mutant);
    all.push_back({change, mutant.text(), column ? good_.names[*column] : "", allowed});
  }
  void add_text(const std::string& change, std::string text, Allowed allowed) {
    all.push_back({change, std::move(text), "", allowed});
  }
  /// Adds a changed copy of the table in which `to` is applied to the names of the columns.
  void add_named(const std::string& change, const std::function<std::string(std::string)>& to) {
    add(change, std::nullopt, Allowed::same_numbers, [&](TableText& t) {
      for (std::string& name : t.names) name = to(name);
    });
  }

  std::vector<Mutant> all;

 private:
  const TableText& good_;
};

void change_names(const TableText& good, TableMutants& mutants) {
  const std::size_t last = good.names.size() - 1;
  mutants.add(
      "renames a column", last, Allowed::told, [&](TableText& t) { t.names[last] = "NFX7"; });
  mutants.add("misspells a column", last, Allowed::the_rest, [&](TableText& t) {
    t.names[last] += t.names[last].back();
  });
  mutants.add_named("upper case", [](std::string name) { return in_case(name, std::toupper); });
  mutants.add_named("lower case", [](std::string name) { return in_case(name, std::tolower); });
  mutants.add_named("quotes around names", [](std::string name) { return "\"" + name + "\""; });
  mutants.add_named("blanks around names", [](std::string name) { return "  " + name + " "; });
  mutants.add("doubles a column", 0, Allowed::told, [](TableText& t) {
    t.names.push_back(t.names[0]);
    t.units.push_back(t.units[0]);
    for (auto& row : t.rows) row.push_back(row[0] + "1");
  });
  if (good.names.size() > 1)
    mutants.add("takes a column away", last, Allowed::the_rest, [&](TableText& t) {
      t.names.pop_back();
      t.units.pop_back();
      for (auto& row : t.rows) row.pop_back();
    });
}

void change_units(const TableText& good, TableMutants& mutants) {
  const auto with_unit = find(good, [&](std::size_t i) { return !good.units[i].empty(); });
  if (!with_unit) return;
  const std::size_t at = *with_unit;
  mutants.add("drops a unit", at, Allowed::the_rest, [&](TableText& t) { t.units[at].clear(); });
  mutants.add("a unit nobody knows", at, Allowed::told, [&](TableText& t) { t.units[at] = "foo"; });
  mutants.add("a unit of another dimension", at, Allowed::the_rest, [&](TableText& t) {
    t.units[at] = t.units[at] == "K" ? "kg" : "K";
  });
  mutants.add("units in round brackets", std::nullopt, Allowed::same_numbers, [](TableText& t) {
    for (std::size_t i = 0; i < t.names.size(); ++i) {
      if (t.units[i].empty()) continue;
      t.names[i] += " (" + t.units[i] + ")";
      t.units[i].clear();
    }
  });
  if (const auto other = find(good, [&](std::size_t i) {
        return i != at && !good.units[i].empty() &&
               !Unit::of(good.units[i]).same_dimension(Unit::of(good.units[at]));
      }))
    mutants.add("swaps two units", at, Allowed::the_rest, [&](TableText& t) {
      std::swap(t.units[at], t.units[*other]);
    });
  for (const Other& one : kOthers) {
    const auto column = find(good, [&](std::size_t i) { return good.units[i] == one.unit; });
    if (!column) continue;
    mutants.add(fmt::format("{} in place of {}", one.other, one.unit),
                column,
                Allowed::same_numbers,
                [&](TableText& t) {
                  t.units[*column] = one.other;
                  for (auto& row : t.rows)
                    row[*column] = fmt::format("{:.17g}", std::stod(row[*column]) / one.divisor);
                });
    break;
  }
}

void change_numbers(const TableText& good, TableMutants& mutants) {
  if (const auto signed_one = find(
          good, [&](std::size_t i) { return has_a_sign(good.names[i]) && is_positive(good, i); }))
    mutants.add("flips a sign", signed_one, Allowed::told, [&](TableText& t) {
      for (auto& row : t.rows)
        row[*signed_one] = fmt::format("{:.17g}", -std::stod(row[*signed_one]));
    });
  const auto middle = good.rows.size() / 2;
  mutants.add("a word among the numbers", 0, Allowed::told, [&](TableText& t) {
    t.rows[middle][0] = "broken";
  });
  // in a table of one column, an empty cell would be an empty line
  if (good.names.size() == 1) return;
  mutants.add("an empty cell", 0, Allowed::told, [&](TableText& t) { t.rows[middle][0].clear(); });
  mutants.add("a row with a cell too few", std::nullopt, Allowed::told, [&](TableText& t) {
    t.rows[middle].pop_back();
  });
}

void change_form(const TableText& good, TableMutants& mutants) {
  const std::string text = good.text();
  const auto same = [&](const char* change, std::string changed) {
    mutants.add_text(change, std::move(changed), Allowed::same_numbers);
  };
  same("a mark of UTF-8", "\xEF\xBB\xBF" + text);
  same("UTF-16", utf16(text));
  same("Windows line ends", good.text(",", "\r\n"));
  same("old line ends", good.text(",", "\r"));
  same("semicolons", good.text(";"));
  same("tabs", good.text("\t"));
  same("an empty line in front", "\n" + text);
  TableText german = good;
  for (auto& row : german.rows)
    for (std::string& cell : row) std::replace(cell.begin(), cell.end(), '.', ',');
  same("decimal commas and semicolons", german.text(";"));
  if (good.names.size() > 1) same("decimal commas and commas", german.text(","));
  if (good.names.size() > 1)  // a number that lacks its last digits is still a number
    mutants.add_text("half a file",
                     text.substr(0, text.size() - good.rows.back().back().size() - 2),
                     Allowed::told);
  mutants.add_text(
      "names alone", text.substr(0, text.find(good.rows.front().front())), Allowed::told);
  std::string degrees = text;
  if (text.find("[deg]") != std::string::npos)
    same("a degree sign of Windows-1252", replaced(text, "[deg]", "[\xB0]"));
}

}  // namespace

std::string TableText::text(const std::string& separator, const std::string& line_end) const {
  std::string all;
  for (const std::string& comment : comments) all += comment + line_end;
  for (std::size_t i = 0; i < names.size(); ++i)
    all += (i > 0 ? separator : "") + names[i] + (units[i].empty() ? "" : " [" + units[i] + "]");
  all += line_end;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) all += (i > 0 ? separator : "") + row[i];
    all += line_end;
  }
  return all;
}

std::optional<TableText> table_text(const std::string& text) {
  TableText table;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (trimmed(line).empty()) continue;
    if (line[0] == '#') {
      table.comments.push_back(line);
    } else if (table.names.empty()) {
      for (const std::string& head : split(line, ',')) {
        const auto bracket = head.find('[');
        table.names.emplace_back(trimmed(std::string_view(head).substr(0, bracket)));
        table.units.push_back(bracket == std::string::npos
                                  ? ""
                                  : head.substr(bracket + 1, head.find(']') - bracket - 1));
      }
    } else {
      table.rows.push_back(split(line, ','));
      if (table.rows.back().size() != table.names.size()) return std::nullopt;
    }
  }
  if (table.rows.size() < 2) return std::nullopt;
  return table;
}

std::vector<Mutant> mutants_of_table(const TableText& good) {
  TableMutants mutants(good);
  change_names(good, mutants);
  change_units(good, mutants);
  change_numbers(good, mutants);
  change_form(good, mutants);
  return std::move(mutants.all);
}

std::vector<Mutant> mutants_of_sections(const std::string& good) {
  std::vector<Mutant> all;
  const auto same = [&](const char* change, std::string text) {
    all.push_back({change, std::move(text), "", Allowed::same_numbers});
  };
  const auto told = [&](const char* change, const char* key, const std::string& by) {
    const auto at = good.find(key);
    if (at == std::string::npos) return;
    const auto end = good.find('\n', at);
    std::string text = good;
    text.replace(at, end - at, by);
    all.push_back({change, std::move(text), key, Allowed::told});
  };
  same("upper case", in_case(good, std::toupper));
  same("lower case", in_case(good, std::tolower));
  same("a mark of UTF-8", "\xEF\xBB\xBF" + good);
  same("UTF-16", utf16(good));
  same("Windows line ends", replaced(good, "\n", "\r\n"));
  same("old line ends", replaced(good, "\n", "\r"));
  same("no blanks around =", replaced(replaced(good, " =", "="), "= ", "="));
  same("tabs around =", replaced(good, "=", "\t=\t"));
  same("an empty line in front", "\n" + good);
  told("renames a key", "PDY1", "PDYY1 = 1");
  told("takes a key away", "PKY1", "");
  told("takes the nominal load away", "FNOMIN", "");
  told("flips a sign", "FNOMIN", "FNOMIN = -3000");
  told("a key twice", "PCY1", "PCY1 = 1.3\nPCY1 = 1.4");
  told("a word for a number", "PCY1", "PCY1 = broken");
  told("a decimal comma", "PCY1", "PCY1 = 1,3");
  told("a version nobody knows", "FITTYP", "FITTYP = 77");
  told("another formula", "FITTYP", "FITTYP = 'PAC89'");
  told("a unit nobody knows", "FORCE", "FORCE = 'foo'");
  told("a unit of another dimension", "FORCE", "FORCE = 'meter'");
  told("millimeters that are meters", "LENGTH", "LENGTH = 'mm'");
  told("kilometers that are meters", "LENGTH", "LENGTH = 'km'");
  told("a unit without its end", "ANGLE", "ANGLE = 'rad");
  told("half a file", "PCY1", "PC");
  if (!all.empty() && all.back().change == "half a file")
    all.back().text = good.substr(0, good.find("PCY1") + 2);
  told("a key nobody knows", "PCY1", "PCY1 = 1.3\nPXYZ9 = 1");
  return all;
}

}  // namespace latsch::benchmarks
