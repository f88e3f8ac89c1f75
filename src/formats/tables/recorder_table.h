// SPDX-License-Identifier: Apache-2.0
// A table of one group of a recorder's file, or of all groups at one step of time.
//
// If no group is named, the only one with known channels is taken, else the first one of those, and
// the table says so. Joined groups cover the time that all of them have; values between two samples
// are linear, and are gaps if one of the two is a gap. A group without time, or with one sample, is
// left out.
#pragma once

#include <map>
#include <string>

#include "formats/recorders/recorded_file.h"
#include "formats/tables/lab_table.h"

namespace latsch::formats {

/// `part` is the name of a group, or empty; `step`, in s, joins the groups if it is above 0. Throws
/// InputError for a group that does not exist, for both a group and a step, for a time that falls
/// back or has gaps, and for groups that have no common time, if they are to be joined.
LabTable recorder_table(RecordedFile file,
                        const std::map<std::string, std::string>& units,
                        const ExpectedUnit& expected,
                        const std::string& part,
                        double step);

}  // namespace latsch::formats
