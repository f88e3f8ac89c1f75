// SPDX-License-Identifier: Apache-2.0
// Figures and tables of an HTML page, styled by page_style.h.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace latsch::report {

struct LinePlot;

/// Returns a picture (HTML) under its heading, followed by `quiet` in gray. All texts are escaped
/// here.
std::string figure(std::string_view heading,
                   std::string_view quiet,
                   std::string_view picture,
                   std::string_view caption);
std::string figure(std::string_view heading, const LinePlot& plot, std::string_view caption);

/// The first column is text, the others are numbers. All texts are escaped here.
std::string number_table(const std::vector<std::string>& heads,
                         const std::vector<std::vector<std::string>>& rows);

}  // namespace latsch::report
