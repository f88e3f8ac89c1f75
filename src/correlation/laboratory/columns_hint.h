// SPDX-License-Identifier: Apache-2.0
// Builds the table `columns` that a message proposes. A person can copy it unchanged: it contains
// everything the study already states, its key is the channel the study uses, and its unit is the
// one in which people write that channel.
#pragma once

#include <map>
#include <string>

#include "correlation/laboratory/lab_record.h"

namespace latsch::correlation {

/// Returns a key of TOML: as it is if it has only letters, digits, "_" and "-", otherwise in
/// quotes.
std::string toml_key(const std::string& key);

/// `columns = {alpha = "SA [deg]", time = "t_s [s]"}`: the stated columns with this one added, or
/// in place of the former column of `channel`.
std::string columns_hint(std::map<std::string, StatedColumn> stated,
                         const std::string& channel,
                         StatedColumn column);

/// Returns the key of `columns` for a channel that is needed and the column found for it: the name
/// in the vocabulary, with the frame or wheel that the column's name states, if any.
std::string key_for(const std::string& channel, const std::string& column);

/// Returns the column with the unit to propose: none if the file or the study states one, otherwise
/// the unit in which people write the SI unit `unit`.
StatedColumn with_natural_unit(StatedColumn column, const std::string& unit);

}  // namespace latsch::correlation
