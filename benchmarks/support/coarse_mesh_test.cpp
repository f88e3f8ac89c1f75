// SPDX-License-Identifier: Apache-2.0
#include "coarse_mesh.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/document.h"
#include "base/file.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::benchmarks {
namespace {

TEST(CoarseMesh, IsThatOfEveryShippedTireAndNothingElseChanges) {
  const auto folder = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/tires";
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const std::string text = read_text_file(file.path());
    const auto as_shipped = fe_tire::read_tire(Document::parse(text, "shipped").root());
    auto coarse = fe_tire::read_tire(
        Document::parse(with_coarse_mesh(text, {.meridional = 14, .sectors = 20}), "coarse")
            .root());
    EXPECT_EQ(coarse.section.meridional, 14) << file;
    EXPECT_EQ(coarse.section.sectors, 20) << file;
    EXPECT_EQ(coarse.section.rows(), as_shipped.section.rows()) << file;
    EXPECT_EQ(coarse.section.contour.size(), as_shipped.section.contour.size()) << file;
    EXPECT_EQ(coarse.plies.size(), as_shipped.plies.size()) << file;
    EXPECT_EQ(coarse.pressure, as_shipped.pressure) << file;
  }
}

TEST(CoarseMesh, IsRefusedWhereTheFileKeepsAnother) {
  const std::string tire = read_text_file(std::filesystem::path(LATSCH_SOURCE_DIR) /
                                          "studies/tires" / "passenger_225_50R16.toml");
  std::string without = tire;
  without.replace(without.find("[mesh]"), 6, "[mesk]");
  EXPECT_ANY_THROW(with_coarse_mesh(without));
}

}  // namespace
}  // namespace latsch::benchmarks
