// SPDX-License-Identifier: Apache-2.0
// Writes the tests of a campaign: a table, STUDY.design.csv, and one file for each different test,
// STUDY.design/test_01.toml and so on, which `latsch test MODEL FILE` runs.
//
//   test,rank,file,Fz [N],alpha [deg]
//   1,3,test_01.toml,1200,-4
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "correlation/campaign/campaign.h"

namespace latsch::correlation {

/// Returns STUDY.design.csv beside the study.
std::filesystem::path campaign_table_file(const Study& study);
/// Returns STUDY.design beside the study.
std::filesystem::path campaign_folder(const Study& study);
/// Returns the name of the file of a test, counted from 0; that of the first equal one for a
/// replicate.
std::string campaign_test_file(const Campaign& campaign, std::size_t test);

/// Writes the table. Throws InputError.
void write_campaign_table(const Study& study,
                          const Campaign& campaign,
                          const std::filesystem::path& file);

/// Writes the files of the tests into a folder, which is made, and removes those that an earlier
/// design of this program left there. Throws InputError.
void write_campaign_tests(const Study& study,
                          const Campaign& campaign,
                          const std::filesystem::path& folder);

}  // namespace latsch::correlation
