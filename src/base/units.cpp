// SPDX-License-Identifier: Apache-2.0
#include "base/units.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <mutex>

#include "base/error.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "base/unit_words/c_locale.h"
#include "base/unit_words/unit_words.h"

namespace latsch {
namespace {

constexpr std::size_t kLongestUnit = 64;
constexpr int kLargestPower = 9;  // largest exponent of a base unit; exponents of one digit suffice
constexpr const char* kBase[] = {"m", "kg", "s", "A", "K", "mol", "cd", "rad"};

/// Units that people often type but the database lacks.
constexpr struct {
  const char* name;
  const char* meaning;
} kAdditions[] = {
    {"deg", "arc_degree"}, {"rev", "6.283185307179586 rad"}, {"Nm", "N m"}, {"kph", "km/h"}};

/// Noun and example for the quantities of a dimension. The first row of each dimension has its SI
/// unit.
struct KnownDimension {
  const char *unit, *noun, *example;
};
constexpr KnownDimension kKnown[] = {
    {"1", "a plain number", "0.5"},
    {"m", "a length", "25 mm"},
    {"m^2", "an area", "2 mm^2"},
    {"m^3", "a volume", "10 l"},
    {"kg", "a mass", "9.8 kg"},
    {"s", "a time", "0.1 s"},
    {"Hz", "a frequency", "80 Hz"},
    {"rad", "an angle", "22 deg"},
    {"rad/s", "an angular velocity", "600 rpm"},
    {"m/s", "a velocity", "40 km/h"},
    {"m/s^2", "an acceleration", "9.81 m/s^2"},
    {"N", "a force", "4 kN"},
    {"N m", "a moment", "20 N m"},
    {"Pa", "a pressure or modulus", "2.6 bar"},
    {"N/m", "a stiffness", "200 N/mm"},
    {"N s/m", "a damping", "1500 N s/m"},
    {"Pa s", "a viscosity", "3 Pa s"},
    {"kg/m^3", "a density", "1150 kg/m^3"},
    {"kg m^2", "a moment of inertia", "1 kg m^2"},
    {"N m/rad", "a torsional stiffness", "300 N m/deg"},
    {"N m s/rad", "a torsional damping", "2 N m s/rad"},
    {"N m^2", "a bending stiffness", "60 N m^2"},
    {"N/rad", "a force per angle", "1500 N/deg"},
    {"N s/rad", "a force per angular velocity", "2 N s/rad"},
    {"rad/m", "an angle per length", "0.1 deg/mm"},
    {"m/N", "a compliance", "0.26 mm/kN"},
    {"rad/N", "an angle per force", "0.02 deg/kN"},
    {"rad/(N m)", "a torsional compliance", "3.4 deg/(kN m)"},
    {"1/N", "a travel per moment", "0.2 mm/(kN m)"},
    {"Pa/m", "a stiffness per area", "0.1 N/mm^3"},
    {"1/m", "a curvature", "2 1/m"},
    {"K", "a temperature", "25 degC"},
    {"W", "a power", "5 kW"},
};

/// Returns the decimal number of which `value` is the nearest double, such as 0.0254: decimal
/// factors are then decimal to 64 bits.
long double as_decimal(double value) {
  const std::string digits = fmt::format("{}", value);
  long double decimal = value;
  std::from_chars(digits.data(), digits.data() + digits.size(), decimal);
  return decimal;
}

bool may_be_unit(std::string_view text) {
  return !text.empty() && text.size() <= kLongestUnit && text.find('\0') == text.npos;
}

/// The unit database, which is read once. UDUNITS-2 keeps state, so only one thread at a time uses
/// it.
class Database {
 public:
  struct Entry {
    Unit::Dimension dimension;
    long double factor, offset;
  };

  static Database& instance() {
    static Database database;
    return database;
  }

  /// Finds the unit that the trimmed `text` names. If the text has several meanings, the usual one
  /// is returned.
  std::optional<Entry> find(std::string_view text) {
    const std::lock_guard lock(mutex_);
    [[maybe_unused]] const CLocale decimal_points;
    if (const auto known = known_.find(text); known != known_.end()) return known->second;
    const UnitMeanings meanings = meanings_of(text);
    if (meanings.texts.empty()) return std::nullopt;
    const std::optional<Entry> entry = parse(meanings.texts.front());
    if (entry && known_.size() < kMostRemembered) known_.emplace(text, *entry);
    return entry;
  }

  UnitMeanings meanings(std::string_view text) {
    const std::lock_guard lock(mutex_);
    [[maybe_unused]] const CLocale decimal_points;
    return meanings_of(text);
  }

 private:
  static constexpr std::size_t kMostRemembered = 4096;
  struct FreeUnit {
    void operator()(ut_unit* unit) const { ut_free(unit); }
  };
  struct FreeConverter {
    void operator()(cv_converter* converter) const { cv_free(converter); }
  };
  using UnitPointer = std::unique_ptr<ut_unit, FreeUnit>;

  /// Path of the database in an archive of latsch, which has its own. UDUNITS2_XML_PATH prevails.
  static std::string database_beside_the_program() {
    const char* chosen = std::getenv("UDUNITS2_XML_PATH");
    if (chosen != nullptr) return chosen;
    std::error_code no_link;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", no_link);
    return (program.parent_path().parent_path() / "share/xml/udunits/udunits2.xml").string();
  }

  Database() {
    [[maybe_unused]] const CLocale decimal_points;
    ut_set_error_message_handler(ut_ignore);  // the default handler would write to standard error
    system_ = ut_read_xml(database_beside_the_program().c_str());
    if (!system_) system_ = ut_read_xml(nullptr);
    if (!system_)
      throw InputError(
          "the unit database of UDUNITS-2 cannot be read (UDUNITS2_XML_PATH or the package "
          "libudunits2-data)");
    for (const auto& [name, meaning] : kAdditions)
      ut_map_name_to_unit(name, UT_ASCII, UnitPointer(ut_parse(system_, meaning, UT_ASCII)).get());
    for (std::size_t i = 0; i < std::size(kBase); ++i)
      base_[i].reset(ut_parse(system_, kBase[i], UT_ASCII));
  }

  UnitMeanings meanings_of(std::string_view text) const {
    if (!may_be_unit(text)) return {};
    return unit_meanings(text, [this](std::string_view word, const std::string& meaning) {
      // Relative tolerance; UDUNITS rounds some factors to six digits.
      constexpr long double kSame = 1e-5L;
      const auto by_letter = parse(std::string(word)), meant = parse(meaning);
      if (!by_letter || !meant) return false;
      return by_letter->dimension != meant->dimension || by_letter->offset != meant->offset ||
             std::abs(by_letter->factor / meant->factor - 1.0L) > kSame;
    });
  }

  std::optional<Entry> parse(const std::string& text) const {
    const UnitPointer unit(ut_parse(system_, text.c_str(), UT_UTF8));
    if (!unit) return std::nullopt;
    Entry entry{};
    if (!find_dimension(unit.get(), entry.dimension)) return std::nullopt;
    for (const int power : entry.dimension)
      if (std::abs(power) > kLargestPower) return std::nullopt;
    const UnitPointer si = product(entry.dimension);
    if (!si) return std::nullopt;
    const std::unique_ptr<cv_converter, FreeConverter> to_si(
        ut_get_converter(unit.get(), si.get()));
    if (!to_si) return std::nullopt;
    const double offset = cv_convert_double(to_si.get(), 0.0);
    const double factor = cv_convert_double(to_si.get(), 1.0) - offset;
    if (!std::isfinite(offset) || !std::isfinite(factor) || factor == 0.0) return std::nullopt;
    entry.offset = as_decimal(offset);
    entry.factor = as_decimal(factor);
    return entry;
  }

  /// Returns false for logarithmic units (decibel) and for times since a date.
  bool find_dimension(const ut_unit* unit, Unit::Dimension& dimension) const {
    struct Visit {
      const Database* database;
      Unit::Dimension* dimension;
    } visit{this, &dimension};
    static constexpr ut_visitor kVisitor = {
        [](const ut_unit* basic, void* data) {
          const Visit& v = *static_cast<Visit*>(data);
          return v.database->add_power(basic, 1, *v.dimension);
        },
        [](const ut_unit*, int count, const ut_unit* const* basics, const int* powers, void* data) {
          const Visit& v = *static_cast<Visit*>(data);
          for (int i = 0; i < count; ++i)
            if (v.database->add_power(basics[i], powers[i], *v.dimension) != UT_SUCCESS)
              return UT_VISIT_ERROR;
          return UT_SUCCESS;
        },
        [](const ut_unit*, double, const ut_unit* underlying, double, void* data) {
          const Visit& v = *static_cast<Visit*>(data);
          return v.database->find_dimension(underlying, *v.dimension) ? UT_SUCCESS : UT_VISIT_ERROR;
        },
        [](const ut_unit*, const ut_unit*, double, void*) { return UT_VISIT_ERROR; },
        [](const ut_unit*, double, const ut_unit*, void*) { return UT_VISIT_ERROR; }};
    return ut_accept_visitor(unit, &kVisitor, &visit) == UT_SUCCESS;
  }

  ut_status add_power(const ut_unit* basic, int power, Unit::Dimension& dimension) const {
    for (std::size_t i = 0; i < base_.size(); ++i) {
      if (ut_compare(basic, base_[i].get()) != 0) continue;
      dimension[i] += power;
      return UT_SUCCESS;
    }
    return UT_VISIT_ERROR;
  }

  UnitPointer product(const Unit::Dimension& dimension) const {
    UnitPointer result(ut_get_dimensionless_unit_one(system_));
    for (std::size_t i = 0; i < dimension.size() && result; ++i) {
      const UnitPointer power(ut_raise(base_[i].get(), dimension[i]));
      result.reset(power ? ut_multiply(result.get(), power.get()) : nullptr);
    }
    return result;
  }

  std::mutex mutex_;
  ut_system* system_ = nullptr;  // never freed; it lives as long as the program
  std::array<UnitPointer, 8> base_;
  std::map<std::string, Entry, std::less<>> known_;
};

}  // namespace

std::optional<Unit> Unit::find(std::string_view text) {
  text = trimmed(text);
  const auto entry = Database::instance().find(text);
  if (!entry) return std::nullopt;
  Unit unit;
  unit.text_ = text;
  unit.dimension_ = entry->dimension;
  unit.factor_ = entry->factor;
  unit.offset_ = entry->offset;
  return unit;
}

Unit Unit::of(std::string_view text) {
  const std::optional<Unit> unit = find(text);
  assert(unit);
  if (!unit) throw InputError(unknown_unit(text));
  return *unit;
}

double Unit::to_si(long double number) const {
  const long double si = number * factor_;
  // Adding 0 to -0 would lose the sign.
  return static_cast<double>(offset_ == 0.0L ? si : si + offset_);
}

double Unit::from_si(double value) const {
  return static_cast<double>((value - offset_) / factor_);
}

std::string Unit::exact_number(double value) const {
  constexpr int kFewest = 6, kUsual = 15, kMost = 24;
  const long double number = (value - offset_) / factor_;
  std::string digits;
  const auto gives_back = [&](int precision) {
    digits = fmt::format("{:.{}g}", number, precision);
    long double read = 0.0L;
    std::from_chars(digits.data(), digits.data() + digits.size(), read);
    return to_si(read) == value;
  };
  // A value that a person typed is reproduced by few digits. Any other value needs all digits of a
  // double or more, so intermediate numbers of digits are not tried.
  int precision = gives_back(kUsual) ? kFewest : kUsual + 1;
  while (!gives_back(precision) && precision < kMost) ++precision;
  return digits;
}

void Unit::append_exact_number(double value, std::string& text) const {
  // In SI the shortest digits that reproduce the double are needed. The result is checked by
  // reading it again, because numbers are read with more bits and rounded once more.
  if (factor_ == 1.0L && offset_ == 0.0L) {
    char digits[32];
    const auto end = fmt::format_to(digits, "{}", value);
    const std::string_view written(digits, static_cast<std::size_t>(end - digits));
    const auto read = split_number(written);
    if (read && to_si(read->number) == value) {
      text += written;
      return;
    }
  }
  text += exact_number(value);
}

namespace {

/// Reads a number that consists only of digits and a point, as most numbers of a file do, faster
/// than strtold. Up to 19 digits and powers of ten up to 10^19 are exact in a mantissa of 64 bits,
/// so that their quotient is the number rounded once, as from_chars rounds it. Returns nothing for
/// any other text.
std::optional<long double> plain_number(std::string_view text) {
  static_assert(std::numeric_limits<long double>::digits >= 64);
  constexpr std::size_t kMostDigits = 19;
  constexpr long double kPowers[] = {1e0L,  1e1L,  1e2L,  1e3L,  1e4L,  1e5L,  1e6L,
                                     1e7L,  1e8L,  1e9L,  1e10L, 1e11L, 1e12L, 1e13L,
                                     1e14L, 1e15L, 1e16L, 1e17L, 1e18L, 1e19L};
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  std::uint64_t mantissa = 0;
  std::size_t digits = 0, point = text.size();
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '.' && point == text.size() && i > 0 && i + 1 < text.size()) {
      point = i;
      continue;
    }
    if (text[i] < '0' || text[i] > '9' || ++digits > kMostDigits) return std::nullopt;
    mantissa = 10 * mantissa + static_cast<std::uint64_t>(text[i] - '0');
  }
  if (digits == 0) return std::nullopt;
  const std::size_t decimals = point == text.size() ? 0 : text.size() - point - 1;
  const long double number = static_cast<long double>(mantissa) / kPowers[decimals];
  return negative ? -number : number;
}

}  // namespace

std::optional<NumberAndRest> split_number(std::string_view text) {
  text = trimmed(text);
  if (const auto number = plain_number(text)) return NumberAndRest{*number, text, {}};
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  NumberAndRest result;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result.number);
  if (error != std::errc{}) return std::nullopt;
  result.digits = text.substr(0, end - text.data());
  result.rest = trimmed(text.substr(end - text.data()));
  return result;
}

namespace {

std::optional<Quantity> quantity_in(const NumberAndRest& parts, const std::optional<Unit>& unit) {
  if (!unit) return std::nullopt;
  return Quantity{std::string(parts.digits), *unit, unit->to_si(parts.number)};
}

}  // namespace

std::optional<Quantity> parse_quantity(std::string_view text) {
  const auto parts = split_number(text);
  if (!parts) return std::nullopt;
  return quantity_in(*parts, Unit::find(parts->rest));
}

std::optional<Quantity> parse_quantity(std::string_view text, const Unit& expected) {
  const auto parts = split_number(text);
  if (!parts) return std::nullopt;
  return quantity_in(*parts, find_unit(parts->rest, expected));
}

std::optional<Unit> find_unit(std::string_view written, const Unit& expected) {
  const auto usual = Unit::find(written);
  if (!usual || usual->same_dimension(expected)) return usual;
  for (const std::string& spelling : Database::instance().meanings(trimmed(written)).spellings) {
    const auto unit = Unit::find(spelling);
    if (unit && unit->same_dimension(expected)) return unit;
  }
  return usual;
}

bool looks_like_unit(std::string_view written) {
  return Unit::find(written).has_value() ||
         !Database::instance().meanings(trimmed(written)).refusal.empty();
}

UnitReading reading_of_unit(std::string_view written) {
  const auto unit = written.empty() ? Unit::of("1") : Unit::find(written);
  if (!unit) return {std::nullopt, unknown_unit(written), ""};
  const UnitMeanings meanings = Database::instance().meanings(trimmed(written));
  if (meanings.dimension_decides)
    return {std::nullopt, "unit " + in_quotes(written) + ", " + meanings.refusal, ""};
  std::string assumed;
  if (!meanings.refusal.empty() && meanings.spellings.size() > 1)
    assumed = in_quotes(written) + " is taken as " + in_quotes(meanings.spellings.front()) + ", " +
              meanings.refusal;
  return {unit, "", assumed};
}

UnitReading reading_of_unit(std::string_view written, const Unit& expected) {
  const auto unit = written.empty() ? Unit::of("1") : find_unit(written, expected);
  if (!unit) return {std::nullopt, unknown_unit(written), ""};
  return {unit, "", ""};
}

std::string format_quantity(double si, std::string_view unit, int digits) {
  const std::string number = format_number(Unit::of(unit).from_si(si), digits);
  return unit == "1" ? number : number + " " + std::string(unit);
}

std::string si_unit(const Unit::Dimension& dimension) {
  for (const KnownDimension& known : kKnown)
    if (Unit::of(known.unit).dimension() == dimension) return known.unit;
  std::string text;
  for (std::size_t i = 0; i < dimension.size(); ++i) {
    if (dimension[i] == 0) continue;
    if (!text.empty()) text += ' ';
    text += kBase[i];
    if (dimension[i] != 1) text += fmt::format("^{}", dimension[i]);
  }
  return text;
}

DimensionWords words_for(const Unit& unit) {
  for (const KnownDimension& known : kKnown)
    if (Unit::of(known.unit).same_dimension(unit)) return {known.noun, known.example};
  const std::string si = si_unit(unit.dimension());
  return {"a quantity in " + si, "1 " + si};
}

std::string unknown_unit(std::string_view unit) {
  static const std::vector<std::string> kUsual = {
      "mm",     "cm",  "m",   "km",   "in",     "mm^2",   "m^2",  "kg",  "g",   "t",    "s",
      "ms",     "min", "h",   "Hz",   "kHz",    "deg",    "rad",  "rpm", "m/s", "km/h", "N",
      "daN",    "kN",  "lbf", "N m",  "Pa",     "kPa",    "MPa",  "GPa", "bar", "psi",  "N/mm",
      "N/mm^2", "N/m", "K",   "degC", "kg/m^3", "g/cm^3", "mbar", "%",   "1"};
  const std::string refusal = Database::instance().meanings(trimmed(unit)).refusal;
  if (!refusal.empty()) return "unit " + in_quotes(unit) + ", " + refusal;
  return "unknown unit " + in_quotes(unit) + did_you_mean(unit, kUsual);
}

}  // namespace latsch
