// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_dialect.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/text.h"
#include "formats/text/letter_case.h"

namespace latsch::formats {
namespace {

using magic_formula::Version;

constexpr const char* kFitTypesRead = "5, 6, 21, 51 or 52 (MF 5.2), 60 or 61 (MF 6.1), 62 (MF 6.2)";
constexpr const char* kFormatsRead =
    "PAC2002, MF_05, MF-TYRE (MF 5.2), MF52, MF61, MF62 or a FITTYP";

struct KnownFitType {
  int number;
  Version version;
  // note for the user; nullptr: the format has exactly the equations of this version of the Magic
  // Formula
  const char* note;
};
constexpr std::array<KnownFitType, 8> kFitTypes = {{
    {5, Version::mf52, "MF-Tyre 5.0 and 5.1"},
    {6, Version::mf52, nullptr},
    {21, Version::mf52, nullptr},
    {51, Version::mf52, "MF-Tyre 5.1"},
    {52, Version::mf52, nullptr},
    {60, Version::mf61, "MF-Tyre 6.0"},
    {61, Version::mf61, nullptr},
    {62, Version::mf62, nullptr},
}};

/// Names of formats that determine the equations, reduced to letters and digits.
constexpr std::array<std::pair<const char*, Version>, 12> kFormats = {{
    {"PAC2002", Version::mf52},
    {"MF05", Version::mf52},
    {"MFTYRE", Version::mf52},
    {"MFTIRE", Version::mf52},
    {"MFTYRE52", Version::mf52},
    {"MFTIRE52", Version::mf52},
    {"MF52", Version::mf52},
    {"PACEJKA2002", Version::mf52},
    {"MF61", Version::mf61},
    {"MFTYRE61", Version::mf61},
    {"MF62", Version::mf62},
    {"MFTYRE62", Version::mf62},
}};

/// Formats of other tire models, given by the first letters and digits of their names.
constexpr std::array<std::pair<const char*, const char*>, 16> kOtherModels = {{
    {"PAC89", "the Magic Formula of 1989, with coefficients A0, B0, C0 ..."},
    {"PAC94", "the Magic Formula of 1994, with coefficients A0, B0, C0 ..."},
    {"PAC96", "the Magic Formula of 1996, with other equations than MF 5.2"},
    {"PACTIME", "PAC-TIME, whose side force and aligning moment have other equations than MF 5.2"},
    {"PACMC", "the Magic Formula of motorcycles (PAC_MC)"},
    {"MFMC", "the Magic Formula of motorcycles (MF-MCTyre)"},
    {"FTIRE", "FTire, a flexible ring with a file of its own (latsch new --ring-data starts one)"},
    {"RTIRE", "RTire, a member of the FTire family"},
    {"HTIRE", "HTire, a member of the FTire family"},
    {"CDTIRE", "CDTire, a flexible ring with a file of its own"},
    {"RMODK", "RMOD-K, a flexible ring with a file of its own"},
    {"521", "the 5.2.1 tire of Adams, which interpolates tables or equations of its own"},
    {"UA", "the University of Arizona tire"},
    {"FIALA", "the Fiala tire"},
    {"TMEASY", "TMeasy, which describes curves by their peak and sliding values"},
    {"DUGOFF", "the Dugoff tire"},
}};

std::string letters_and_digits(std::string_view text) {
  std::string kept;
  for (const char c : capitals(text))
    if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) kept += c;
  return kept;
}

class DialectReading {
 public:
  explicit DialectReading(const TeimOrbitSection& model)
      : model_(model),
        format_(model.text("PROPERTY_FILE_FORMAT", "")),
        letters_(letters_and_digits(format_)) {}

  TirDialect run() {
    refuse_other_models();
    const std::optional<Version> by_format = version_of_format();
    const TeimOrbitEntry* fit = model_.find("FITTYP");
    if (fit == nullptr) {
      if (!by_format) reject_unnamed();
      result_.version = *by_format;
      note(model_.find("PROPERTY_FILE_FORMAT")->line,
           fmt::format("no FITTYP; {} is evaluated with the equations of {}",
                       format_,
                       name_of(result_.version)));
    } else {
      take_fit_type(*fit);
      if (!by_format && !format_.empty() && letters_ != "USER" && !is_swift())
        note(model_.find("PROPERTY_FILE_FORMAT")->line,
             fmt::format("PROPERTY_FILE_FORMAT {} is not known here; the FITTYP counts",
                         in_quotes(format_)));
      if (by_format && *by_format != result_.version)
        throw InputError(
            model_.place(fit->line),
            fmt::format("FITTYP is {}, but PROPERTY_FILE_FORMAT is {}: that are {} and "
                        "{}; keep one of them",
                        fit->value,
                        in_quotes(format_),
                        name_of(result_.version),
                        name_of(*by_format)));
    }
    result_.pac2002 = letters_ == "PAC2002" || letters_ == "PACEJKA2002";
    return std::move(result_);
  }

 private:
  void note(int line, const std::string& text) {
    result_.notes.push_back(model_.place(line).text() + ": " + text);
  }

  static const char* name_of(Version version) {
    return version == Version::mf52 ? "MF 5.2" : version == Version::mf61 ? "MF 6.1" : "MF 6.2";
  }

  bool is_swift() const { return letters_.starts_with("SWIFT") || letters_.starts_with("MFSWIFT"); }

  std::optional<Version> version_of_format() const {
    for (const auto& [name, version] : kFormats)
      if (letters_ == name) return version;
    return std::nullopt;
  }

  void refuse_other_models() {
    const TeimOrbitEntry* type = model_.find("TYPE");
    if (type != nullptr && letters_and_digits(type->value).starts_with("MOTORCYCLE"))
      throw InputError(model_.place(type->line),
                       "TYPE is " + in_quotes(type->value) +
                           ": the Magic Formula of motorcycles (MF-MCTyre) has other equations and "
                           "is not read here");
    if (letters_.empty()) return;
    const int line = model_.find("PROPERTY_FILE_FORMAT")->line;
    for (const auto& [name, what] : kOtherModels) {
      if (!letters_.starts_with(name)) continue;
      throw InputError(
          model_.place(line),
          fmt::format("PROPERTY_FILE_FORMAT is {}: {}. It is not read here, and a FITTYP does not "
                      "make a Magic Formula 5.2 or 6 of it; expected {}",
                      in_quotes(format_),
                      what,
                      kFormatsRead));
    }
    if (is_swift()) {
      if (!model_.has("FITTYP"))
        throw InputError(
            model_.place(line),
            fmt::format("PROPERTY_FILE_FORMAT is {}: SWIFT, a rigid ring on a Magic Formula of "
                        "which the file does not say the version; expected a FITTYP: {}",
                        in_quotes(format_),
                        kFitTypesRead));
      note(line, format_ + ": of SWIFT the Magic Formula is read, and what MF 6 has of its ring");
    }
  }

  [[noreturn]] void reject_unnamed() const {
    if (format_.empty())
      throw InputError(
          model_.place(),
          fmt::format("[MODEL] has neither FITTYP nor PROPERTY_FILE_FORMAT, expected FITTYP {}",
                      kFitTypesRead));
    std::vector<std::string> known;
    for (const auto& [name, version] : kFormats) known.emplace_back(name);
    throw InputError(model_.place(model_.find("PROPERTY_FILE_FORMAT")->line),
                     fmt::format("PROPERTY_FILE_FORMAT is {} and there is no FITTYP: which formula "
                                 "is it? Expected {}{}",
                                 in_quotes(format_),
                                 kFormatsRead,
                                 did_you_mean(letters_, known)));
  }

  /// Reads a number, or a name such as 'MF61'.
  void take_fit_type(const TeimOrbitEntry& fit) {
    const std::optional<double> number = parse_number(fit.value);
    if (!number) {
      const std::string letters = letters_and_digits(fit.value);
      for (const auto& [name, version] : kFormats) {
        if (letters != name) continue;
        result_.version = version;
        note(fit.line, fmt::format("FITTYP {} is taken as {}", fit.value, name_of(version)));
        return;
      }
    }
    for (const KnownFitType& known : kFitTypes) {
      if (!number || *number != known.number) continue;
      result_.version = known.version;
      if (known.note != nullptr)
        note(fit.line,
             fmt::format("FITTYP {} ({}) is evaluated with the equations of {}",
                         known.number,
                         known.note,
                         name_of(known.version)));
      return;
    }
    throw InputError(
        model_.place(fit.line),
        fmt::format(
            "FITTYP is {}, expected {}", number ? fit.value : in_quotes(fit.value), kFitTypesRead));
  }

  const TeimOrbitSection& model_;
  const std::string format_, letters_;
  TirDialect result_;
};

/// Keys of PAC2002, each with the name of its parameter in this program.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kSpellings = {{
    {"LKG", "LKYC"},
    {"LKYG", "LKYC"},
    {"IP", "INFLPRES"},
    {"IP_NOM", "NOMPRES"},
    {"QPX1", "PPMX1"},
    {"QPZ1", "PPZ1"},
    {"QPZ2", "PPZ2"},
    {"QPFZ1", "PFZ1"},
    {"QV1", "Q_V1"},
    {"QV2", "Q_V2"},
    {"QFCX1", "Q_FCX"},
    {"QFCY1", "Q_FCY"},
}};

}  // namespace

TirDialect dialect_of(const TeimOrbitSection& model) { return DialectReading(model).run(); }

std::string_view parameter_of_key(std::string_view key) {
  for (const auto& [spelling, parameter] : kSpellings)
    if (spelling == key) return parameter;
  return key;
}

std::string_view pac2002_spelling(std::string_view parameter) {
  for (const auto& [spelling, name] : kSpellings)
    if (name == parameter) return spelling;
  return parameter;
}

std::vector<std::string> other_spellings() {
  std::vector<std::string> keys;
  for (const auto& [spelling, parameter] : kSpellings) keys.emplace_back(spelling);
  return keys;
}

}  // namespace latsch::formats
