// SPDX-License-Identifier: Apache-2.0
// The table `columns` that a message proposes. A person copies it as it stands, so it holds all
// that the study states already, the key is the channel that the study takes, and the unit is the
// one in which people write that channel.
#pragma once

#include <map>
#include <string>

#include "correlation/laboratory/lab_record.h"

namespace latsch::correlation {

/// `columns = {alpha = "SA [deg]", time = "t_s [s]"}`: the columns that are stated, with this one
/// added or in the place of the one that `channel` was.
std::string columns_hint(std::map<std::string, StatedColumn> stated,
                         const std::string& channel,
                         StatedColumn column);

/// The key of `columns` for a channel that somebody takes and a column that is found for it: the
/// name of the vocabulary, with the frame or wheel of the column where its name says one.
std::string key_for(const std::string& channel, const std::string& column);

/// The column with the unit to propose: none where the file or the study states one, else that in
/// which people write the SI unit `unit`.
StatedColumn with_natural_unit(StatedColumn column, const std::string& unit);

}  // namespace latsch::correlation
