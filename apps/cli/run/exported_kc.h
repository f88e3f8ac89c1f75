// SPDX-License-Identifier: Apache-2.0
// Writes the kinematics and compliance of a suspension as tables for programs that drive a car by
// them (docs/kc_tables.md): kinematics.csv, roll.csv, springs.csv, compliance.csv, kc.json with the
// meaning of every column, and kc_tables.txt for Modelica.
#pragma once

#include <string>

#include "experiment/language.h"

namespace latsch::cli {

struct KcExport {
  std::string file, folder;
  std::string travel, rack;  // ends of the range, such as "60 mm"; empty: those of KcRange
};

/// Throws InputError for a model that is no suspension, and for a range that the linkage does not
/// reach, with the link that ends the motion.
void write_kc(const KcExport& options, const experiment::Language& language);

}  // namespace latsch::cli
