// SPDX-License-Identifier: Apache-2.0
#include "correlation/study_report.h"

#include <algorithm>
#include <numeric>

#include "correlation/study_reuse_testing.h"

namespace latsch::correlation {
namespace {

class StudyReportOfAFit : public FittedStudy {};

// Forces 500 N off are the same about their means: drawn as they are, they would seem far apart
// over errors of nothing.
TEST_F(StudyReportOfAFit, CurvesAreDrawnAsTheyAreCompared) {
  const Study study = read("compare = \"about_mean\"\n");
  Channels shifted = *evaluator(study)({{1.3, -22.0}});
  std::vector<double> Fy = shifted["steady/Fy"];
  for (double& force : Fy) force += 500.0;
  Channels measured;
  measured.add({"Fy", "N", Fy});
  write("measured.csv", formats::csv_text(measured));
  const Study fitted = read("compare = \"about_mean\"\n");
  fit_all(fitted);
  const auto page = study_report(fitted, Journal::read(fitted.run.journal), {});
  ASSERT_TRUE(page);
  ASSERT_EQ(page->curves.size(), 1u);
  const report::MeasuredCurve& curve = page->curves[0];
  EXPECT_EQ(curve.y_name, "steady/Fy about its mean");
  ASSERT_EQ(curve.y_measured.size(), curve.y_simulated.size());
  EXPECT_NEAR(std::accumulate(curve.y_measured.begin(), curve.y_measured.end(), 0.0), 0.0, 1e-6);
  for (std::size_t i = 0; i < curve.y_measured.size(); ++i) {
    EXPECT_NEAR(curve.y_simulated[i], curve.y_measured[i], 5.0);
  }
}

}  // namespace
}  // namespace latsch::correlation
