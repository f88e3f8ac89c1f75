// SPDX-License-Identifier: Apache-2.0
// Figures and tables of an HTML page, as page_style.h dresses them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace latsch::report {

struct LinePlot;

/// A picture (HTML) under its heading, `quiet` behind that in gray; all texts are escaped here.
std::string figure(std::string_view heading,
                   std::string_view quiet,
                   std::string_view picture,
                   std::string_view caption);
std::string figure(std::string_view heading, const LinePlot& plot, std::string_view caption);

/// The first column is text, the others are numbers; all of it is escaped here.
std::string number_table(const std::vector<std::string>& heads,
                         const std::vector<std::vector<std::string>>& rows);

}  // namespace latsch::report
