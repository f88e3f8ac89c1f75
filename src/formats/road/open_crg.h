// SPDX-License-Identifier: Apache-2.0
// OpenCRG files: a road surface measured along a line [ASAM OpenCRG 1.2.0; the fields were checked
// against the open reader of the standard].
//
//   $CT                         a comment; every section ends with a line that begins with $
//   $ROAD_CRG                   reference_line_start_u = 0.0  ! and so on, any case, * is a comment
//   $ROAD_CRG_OPTS              how the surface goes on beyond its data
//   $ROAD_CRG_MODS              how it is scaled, mended and moved
//   $ROAD_CRG_MPRO              where on a map it lies: kept, not used
//   $ROAD_CRG_FILE              the rest stands in other files (open_crg_references.h)
//   $KD_DEFINITION
//   #:LRFI                      L lines of 80 columns or K compact; D double or R single;
//                               F digits or B binary, big-endian
//   D:reference line phi,rad
//   D:long section 1,m
//   $
//   $$$$                        the records follow
//
// The heading phi of row i is that of the way from row i-1 to row i. Headings and slopes are
// summed up along the line; where the header also names the end, forward and backward sums are
// blended linearly, so that both ends are met.
//
// Four choices where readers differ. Modifiers are applied as the file states them; without a
// statement the only one is grid_nan_mode = 2: gaps are filled from the side in their row. Without
// long_section_v_right, numbered sections lie symmetric to the line, as OpenCRG's own examples say
// of themselves. Points x, y of the line, where the file has them, are taken as they are. Of an
// option or a modifier that comes twice, as LOG_EVAL does in a sample of the standard, the last one
// counts, with a warning; a statement of $ROAD_CRG that comes twice is refused.
//
// All statements of the standard's tables are taken. Those that do not concern the surface (WGS 84
// positions, map projections, offsets to a map, what a program checks, searches, warns and logs)
// are kept to be shown; modifiers that make each other idle and ends of the line that its channels
// contradict are told (open_crg_checks.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "models/road/crg_road.h"

namespace latsch::formats {

struct OpenCrg {
  std::string file;
  std::string comment;                  // $CT
  std::string format;                   // "LRFI"
  std::vector<std::string> statements;  // options and modifiers of the surface, as written
  std::vector<std::string> kept;        // "name = value": what does not concern the surface
  std::vector<std::string> warnings;  // for the user: what was read otherwise than it may be meant
  int gaps = 0;                       // heights that were missing in the file
  road::CrgGrid grid;

  /// Throw InputError naming file, line (of digits) or record (of binary data), what was found and
  /// expected; over 256 MB; for a file that ends before its header says.
  static OpenCrg read(const std::filesystem::path& file);
  /// `$ROAD_CRG_FILE` is refused here.
  static OpenCrg parse(std::string bytes, std::string file_name);
};

}  // namespace latsch::formats
