// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/mat_file.h"

#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/mapped_file.h"
#include "base/text.h"
#include "base/units.h"
#include "formats/tables/mat_v5.h"
#include "formats/text/file_marks.h"

namespace latsch::formats {
namespace {

constexpr std::size_t kLargestMatFile = 512u << 20;  // bytes
constexpr int kDeepestStruct = 16;
constexpr std::size_t kMostVectors = 10000;

constexpr std::size_t kHeaderOfMatlab = 512;  // bytes before HDF5 begins

/// Returns the size in bytes that the file states in the first block of its HDF5 part; nothing if
/// it has no such block. [HDF5 File Format Specification, II.A, superblock]
std::optional<std::uint64_t> stated_size(std::string_view bytes) {
  constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);
  constexpr std::size_t kEndInOld = 40, kEndInNew = 28;  // versions 0 and 1; 2 and 3
  if (bytes.size() < kHeaderOfMatlab + kEndInOld + 8) return std::nullopt;
  const std::string_view block = bytes.substr(kHeaderOfMatlab);
  if (!block.starts_with(kSignature)) return std::nullopt;
  const bool is_old = block[8] < 2;
  if (block[is_old ? 13 : 9] != 8) return std::nullopt;  // bytes of an address
  std::uint64_t size = 0;
  for (int i = 7; i >= 0; --i)
    size = size << 8 | static_cast<unsigned char>(block[(is_old ? kEndInOld : kEndInNew) + i]);
  return size;
}

/// Throws InputError if the file has fewer bytes than it states.
void expect_whole(std::string_view bytes, const std::string& file) {
  const auto size = stated_size(bytes);
  if (!size)
    throw InputError({file, 0},
                     "begins as a MAT file of version 7.3, but has no HDF5 part: is it cut off?");
  if (bytes.size() < *size)
    throw InputError(
        {file, 0},
        fmt::format("is cut off: it has {} of the {} bytes that it states", bytes.size(), *size));
}

/// Converts the variables that the library matio returns for a file of version 7.3.
class Hdf5Reading {
 public:
  explicit Hdf5Reading(MatFile& file) : file_(file) {}

  void run() {
    const std::unique_ptr<mat_t, int (*)(mat_t*)> mat(Mat_Open(file_.file.c_str(), MAT_ACC_RDONLY),
                                                      Mat_Close);
    if (!mat) throw InputError({file_.file, 0}, "cannot be read as a MAT file of version 7.3");
    while (matvar_t* next = Mat_VarReadNext(mat.get())) {
      const std::unique_ptr<matvar_t, void (*)(matvar_t*)> variable(next, Mat_VarFree);
      take(*variable, variable->name ? variable->name : "", 0);
    }
  }

 private:
  template <class Number>
  static void copy(const matvar_t& from, std::size_t count, std::vector<double>& to) {
    const Number* numbers = static_cast<const Number*>(from.data);
    to.assign(numbers, numbers + count);
  }

  void take(matvar_t& from, const std::string& path, int depth) {
    MatVariable variable;
    variable.name = path;
    std::size_t count = 1;
    for (int i = 0; i < from.rank; ++i) {
      variable.size.push_back(from.dims[i]);
      count *= from.dims[i];
    }
    if (from.class_type == MAT_C_STRUCT && depth < kDeepestStruct)
      return take_struct(from, path, count, depth);
    if (from.class_type == MAT_C_CELL && depth < kDeepestStruct)
      return take_cells(from, path, count, depth);
    const bool known = !from.isComplex && from.data && from.nbytes == count * from.data_size;
    if (!known || !copy_numbers(from, count, variable)) {
      file_.left_out.push_back(path);
      return;
    }
    file_.variables.push_back(std::move(variable));
  }

  static bool copy_numbers(const matvar_t& from, std::size_t count, MatVariable& to) {
    switch (from.data_type) {
      case MAT_T_DOUBLE:
        copy<double>(from, count, to.values);
        break;
      case MAT_T_SINGLE:
        copy<float>(from, count, to.values);
        break;
      case MAT_T_INT32:
        copy<std::int32_t>(from, count, to.values);
        break;
      case MAT_T_UINT32:
        copy<std::uint32_t>(from, count, to.values);
        break;
      case MAT_T_INT16:
        copy<std::int16_t>(from, count, to.values);
        break;
      case MAT_T_UINT16:
        copy<std::uint16_t>(from, count, to.values);
        break;
      case MAT_T_INT8:
        copy<std::int8_t>(from, count, to.values);
        break;
      case MAT_T_UINT8:
      case MAT_T_UTF8:
        copy<std::uint8_t>(from, count, to.values);
        break;
      default:
        return false;
    }
    if (from.class_type != MAT_C_CHAR) return true;
    to.is_text = true;
    for (const double code : to.values) {
      to.text += code >= 0x20 && code < 0x7f ? static_cast<char>(code) : '?';
    }
    to.values.clear();
    return true;
  }

  void take_struct(matvar_t& from, const std::string& path, std::size_t count, int depth) {
    const unsigned fields = Mat_VarGetNumberOfFields(&from);
    char* const* names = Mat_VarGetStructFieldnames(&from);
    for (std::size_t k = 0; k < count; ++k) {
      const std::string stem = count == 1 ? path : path + "(" + std::to_string(k + 1) + ")";
      for (unsigned i = 0; i < fields; ++i) {
        matvar_t* member = Mat_VarGetStructFieldByIndex(&from, i, k);
        if (member) take(*member, stem + "." + names[i], depth + 1);
      }
    }
  }

  void take_cells(matvar_t& from, const std::string& path, std::size_t count, int depth) {
    for (std::size_t k = 0; k < count; ++k) {
      matvar_t* member = Mat_VarGetCell(&from, static_cast<int>(k));
      if (member) take(*member, path + "{" + std::to_string(k + 1) + "}", depth + 1);
    }
  }

  MatFile& file_;
};

/// Returns the name of the struct that holds a channel and its unit: "Fz" for "Fz.data"; "" for any
/// other name.
std::string holder_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == name.npos) return "";
  const std::string_view field = std::string_view(name).substr(dot + 1);
  for (const char* data : {"data", "Data", "value", "Value", "values", "Values"})
    if (field == data) return name.substr(0, dot);
  return "";
}

}  // namespace

bool MatVariable::is_vector() const {
  if (is_text || values.size() < 2) return false;
  return std::count_if(size.begin(), size.end(), [](std::size_t n) { return n != 1; }) == 1;
}

MatFile MatFile::read(const std::filesystem::path& file) {
  const std::string bytes = read_settled_file(file, kLargestMatFile);
  expect_content_of_ending(file, bytes);
  if (bytes.starts_with("MATLAB 7.3")) {
    expect_whole(bytes, file.string());
    MatFile result;
    result.file = file.string();
    Hdf5Reading(result).run();
    if (result.variables.empty() && result.left_out.empty())
      throw InputError({result.file, 0}, "has no variable that can be read");
    return result;
  }
  return parse(bytes, file.string());
}

MatFile MatFile::parse(const std::string& bytes, std::string file_name) {
  MatFile result;
  result.file = std::move(file_name);
  read_mat_v5(bytes, result);
  return result;
}

namespace {

/// Reads units from a list of texts that belongs to a list of names: channel.units{2} is the unit
/// of channel.name{2}.
void take_listed_units(const std::vector<MatVariable>& variables,
                       std::map<std::string, std::string>& units) {
  std::map<std::string, std::string> texts;
  for (const MatVariable& variable : variables)
    if (variable.is_text) texts[variable.name] = variable.text;
  for (const auto& [path, name] : texts) {
    const std::size_t brace = path.rfind('{'), dot = path.rfind('.', brace);
    if (brace == path.npos || dot == path.npos) continue;
    const std::string_view list = std::string_view(path).substr(dot + 1, brace - dot - 1);
    if (list != "name" && list != "names") continue;
    for (const char* other : {"unit", "units"}) {
      const auto unit = texts.find(path.substr(0, dot + 1) + other + path.substr(brace));
      if (unit != texts.end()) units.insert({name, unit->second});
    }
  }
}

}  // namespace

std::map<std::string, std::string> MatFile::written_units() const {
  std::map<std::string, std::string> written;
  for (const MatVariable& variable : variables) {
    const std::size_t dot = variable.name.rfind('.');
    if (!variable.is_text || dot == variable.name.npos) continue;
    const std::string_view field = std::string_view(variable.name).substr(dot + 1);
    for (const char* unit : {"unit", "Unit", "units", "Units"}) {
      if (field == unit) written.insert({variable.name.substr(0, dot), variable.text});
    }
  }
  take_listed_units(variables, written);
  return written;
}

std::string MatFile::channel_of(const MatVariable& variable,
                                const std::map<std::string, std::string>& units) {
  std::string holder = holder_of(variable.name);
  return units.contains(holder) ? holder : variable.name;
}

MatFile::Named MatFile::named_channels(const std::map<std::string, std::string>& units,
                                       const ExpectedUnit& expected) const {
  const std::map<std::string, std::string> written = written_units();
  std::set<std::string> names;
  Named result;
  for (const MatVariable& variable : variables) {
    if (!variable.is_vector()) continue;
    const std::string stated = channel_of(variable, units);
    TableColumn column{.name = stated == variable.name ? channel_of(variable, written) : stated,
                       .title = variable.name};
    column.place = static_cast<int>(names.size() + 1);
    column.unit_place = UnitPlace::text_beside;
    if (!names.insert(column.name).second)
      throw InputError({file, 0}, in_quotes(column.name) + " comes twice");
    if (names.size() > kMostVectors)
      throw InputError({file, 0}, fmt::format("has more than {} vectors", kMostVectors));
    if (const auto unit = written.find(column.name); unit != written.end())
      column.unit = trimmed(unit->second);
    if (const auto unit = units.find(column.name); unit != units.end())
      take_stated_unit(column, unit->second, {file, 0});
    const std::string wanted =
        expected && !column.unit.empty() ? expected(column.name) : std::string();
    const std::string fault = fault_of_unit(column, wanted);
    const bool is_known =
        units.contains(column.name) || (expected && !expected(column.name).empty());
    if (!fault.empty() && !is_known) {
      result.left_out[column.name] = fault.substr(fault.find(" has ") + 1);
      result.left_columns.push_back(std::move(column));
      continue;
    }
    const Unit unit = unit_of_column(column, wanted, {file, 0});
    Channel channel{column.name, si_unit(unit.dimension()), {}};
    channel.values.reserve(variable.values.size());
    for (const double value : variable.values) channel.values.push_back(unit.to_si(value));
    result.channels.add(std::move(channel));
    result.columns.push_back(std::move(column));
  }
  std::vector<std::string> missing;
  for (const auto& [name, unit] : units)
    if (!names.contains(name)) missing.push_back(name);
  const std::vector<std::string> there(names.begin(), names.end());
  if (missing.size() == 1)
    throw InputError({file, 0},
                     "has no vector " + in_quotes(missing[0]) + did_you_mean(missing[0], there) +
                         " (vectors: " + list_of(there) + ")");
  if (!missing.empty()) throw InputError({file, 0}, missing_columns(missing, there));
  if (result.channels.empty() && !result.left_out.empty())
    throw InputError({file, 0},
                     "column " + in_quotes(result.left_out.begin()->first) + " " +
                         result.left_out.begin()->second + ", and no other vector is left");
  if (result.channels.empty()) throw InputError({file, 0}, "has no vector of numbers");
  return result;
}

}  // namespace latsch::formats
