// SPDX-License-Identifier: Apache-2.0
// Figures and tables of an HTML page; page_style.h contains their style.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace latsch::report {

struct LinePlot;

/// Returns an HTML picture under its heading, followed by the text `quiet` in gray. This function
/// escapes all texts.
std::string figure(std::string_view heading,
                   std::string_view quiet,
                   std::string_view picture,
                   std::string_view caption);
std::string figure(std::string_view heading, const LinePlot& plot, std::string_view caption);

/// Returns a table whose first column is text and whose other columns are numbers. This function
/// escapes all texts.
std::string number_table(const std::vector<std::string>& heads,
                         const std::vector<std::vector<std::string>>& rows);

}  // namespace latsch::report
