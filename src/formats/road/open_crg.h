// SPDX-License-Identifier: Apache-2.0
// OpenCRG files: a road surface measured along a line [ASAM OpenCRG 1.2.0; the fields were checked
// against the open reader of the standard].
//
//   $CT                         a comment; every section ends with a line that begins with $
//   $ROAD_CRG                   reference_line_start_u = 0.0  ! and so on, any case, * is a comment
//   $ROAD_CRG_OPTS              how the surface continues beyond its data
//   $ROAD_CRG_MODS              how it is scaled, repaired and moved
//   $ROAD_CRG_MPRO              its position on a map: kept, not used
//   $ROAD_CRG_FILE              the rest is in other files (open_crg_references.h)
//   $KD_DEFINITION
//   #:LRFI                      L lines of 80 columns or K compact; D double or R single;
//                               F digits or B binary, big-endian
//   D:reference line phi,rad
//   D:long section 1,m
//   $
//   $$$$                        the records follow
//
// The heading phi of row i is that of the step from row i-1 to row i. Headings and slopes are
// summed along the line; if the header also states the end, forward and backward sums are blended
// linearly, so that both ends are met.
//
// Readers differ in four points. Modifiers are applied as the file states them; without a statement
// the only one is grid_nan_mode = 2: gaps are filled from the side in their row. Without
// long_section_v_right, numbered sections are symmetric to the line, as OpenCRG's own examples
// describe themselves. Points x, y of the line, if the file has them, are used unchanged. If an
// option or a modifier occurs twice, as LOG_EVAL does in a sample of the standard, the last one
// counts, with a warning; a statement of $ROAD_CRG that occurs twice is refused.
//
// All statements of the standard's tables are accepted. Those that do not concern the surface (WGS
// 84 positions, map projections, offsets to a map, what a program checks, searches, warns and logs)
// are kept for display; modifiers that disable each other, and ends of the line that contradict its
// channels, are reported (open_crg_checks.h).
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
  std::vector<std::string> statements;  // options and modifiers of the surface, as in the file
  /// "name = value": statements that do not concern the shape of the surface.
  std::vector<std::string> kept;
  /// Messages for the user about statements that may have been intended otherwise.
  std::vector<std::string> warnings;
  int gaps = 0;  // number of heights missing in the file
  road::CrgGrid grid;

  /// Both functions throw InputError if the file is not valid, is larger than 256 MB, or has fewer
  /// rows than its header states. The message names the file, the line (text) or record (binary
  /// data), what was found and what was expected.
  static OpenCrg read(const std::filesystem::path& file);
  /// Parses a file from its bytes. Refuses a section $ROAD_CRG_FILE, which refers to other files.
  static OpenCrg parse(const std::string& bytes, const std::string& file_name);
};

}  // namespace latsch::formats
