// SPDX-License-Identifier: Apache-2.0
// What was read from a file, for a person to look at: facts, tables, curves.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "measurement/axes.h"

namespace latsch::cli {

struct ShownTable {
  std::string title;
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows;
};

struct ShownCurve {
  std::string x_title, y_title;
  std::vector<double> x, y;  // gaps are NaN
};

struct ShownFile {
  std::string kind;  // "TYDEX 1.3"
  std::vector<std::string> facts;
  std::vector<ShownTable> tables;
  std::vector<ShownCurve> curves;
};

/// By the ending of the name: .tdx, .tydex, .csv, .mat, .tir, .crg, .rdf, .toml, .inp. Channels
/// come out in iso, from the signs `axes` says the file has. Throws InputError.
ShownFile shown_file(const std::filesystem::path& file, AxisConvention axes);

}  // namespace latsch::cli
