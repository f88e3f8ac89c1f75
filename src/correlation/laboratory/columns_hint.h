// SPDX-License-Identifier: Apache-2.0
// Builds the table `columns` that a message proposes. A user can copy it unchanged: it contains
// everything that the study already states, the proposed key is the channel that the study needs,
// and the unit is the one in which people write that channel.
#pragma once

#include <map>
#include <string>

#include "correlation/laboratory/lab_record.h"

namespace latsch::correlation {

/// Returns a key of TOML: as it is if it has only letters, digits, "_" and "-", otherwise in
/// quotes.
std::string toml_key(const std::string& key);

/// Returns `columns = {alpha = "SA [deg]", time = "t_s [s]"}`: the stated columns, with this column
/// added or replacing the former column of `channel`.
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
