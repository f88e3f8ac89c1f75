// SPDX-License-Identifier: Apache-2.0
// The averages of `latsch process` as records for TYDEX files (formats/tables/tydex_writer.h).
#pragma once

#include <string>
#include <vector>

#include "correlation/rig_data/rig_processing.h"
#include "formats/tables/tydex_writer.h"

namespace latsch::correlation {

struct NamedTydex {
  std::string file;  // name of the file: "average_tire_40kph.tdx"
  formats::TydexRecord record;
};

/// Returns one record for each run and plateau: the mean passage of every channel and its standard
/// deviation. `frame` is "W", "H" or "C", the frame of the recorded forces, whose signs have to be
/// those of ISO 8855; a recording does not state it.
std::vector<NamedTydex> averages_in_tydex(const RigResults& results, const std::string& frame);

}  // namespace latsch::correlation
