// SPDX-License-Identifier: Apache-2.0
#include "correlation/study_report/study_report.h"

#include <algorithm>
#include <numeric>

#include "correlation/analysis/identifiability.h"
#include "correlation/analysis/pareto_front.h"
#include "correlation/search/study_reuse_testing.h"
#include "report/html_text.h"
#include "report/identifiability_plots.h"

namespace latsch::correlation {
namespace {

class StudyReportOfAFit : public FittedStudy {};

// Forces that are wrong by 500 N are equal about their means. If they were drawn as they are, they
// would seem far apart although their errors are zero.
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

/// Returns the texts of the cells of a table row that begins with a name.
std::vector<std::string> row_of(const std::string& html, const std::string& name) {
  const std::size_t begin = html.find("<tr><td>" + name);
  EXPECT_NE(begin, std::string::npos) << name;
  const std::string row = html.substr(begin, html.find("</tr>", begin) - begin);
  std::vector<std::string> cells;
  for (std::size_t at = row.find("<td"); at != std::string::npos; at = row.find("<td", at + 1)) {
    const std::size_t from = row.find('>', at) + 1;
    cells.push_back(row.substr(from, row.find("</td>", from) - from));
  }
  return cells;
}

// Only digits that the data support are shown, because further ones differ on another processor.
// Noise of 15 % leaves three digits. Regression test: the page had four digits in one table and
// three in another.
TEST_F(StudyReportOfAFit, AValueHasTheSameDigitsWhereverItStands) {
  Channels measured;
  std::vector<double> Fy = (*evaluator(read(""))({{1.3, -22.0}}))["steady/Fy"];
  for (std::size_t i = 0; i < Fy.size(); ++i) Fy[i] *= i % 2 == 0 ? 1.15 : 0.85;
  measured.add({"Fy", "N", Fy});
  write("measured.csv", formats::csv_text(measured));
  const std::string again =
      "[experiment.again]\nkind = \"curve\"\ny = \"steady/Fy\"\nmeasurement = \"measured.csv\"\n";
  const Study study = read(again);
  const DesignPoint found = fit_all(study).back().run.best()->point;
  {
    Journal journal = Journal::open(study.run.journal, identity(study));
    InlineExecutor executor(evaluator(study));
    const auto made = identify(study, found, Depth::profiles, executor, journal, {});
    ASSERT_TRUE(made && *made);
  }
  const Journal journal = Journal::read(study.run.journal);
  const auto page = study_report(study, journal, {});
  ASSERT_TRUE(page && page->identifiability);
  const std::string html = report::html(*page);
  const ParetoFront front = pareto_front(study, journal, "light", "again");
  for (int i = 0; i < study.space.size(); ++i) {
    const std::string& known = page->identifiability->values[static_cast<std::size_t>(i)];
    EXPECT_LE(known.size(), std::string("-21.4").size()) << known;
    EXPECT_EQ(row_of(html, study.space[i].name)[2], report::true_minus(known));
    EXPECT_EQ(front.best_values[static_cast<std::size_t>(i)], known);
    EXPECT_NE(pareto_page(study, front).find("<td>" + known + "</td>"), std::string::npos) << known;
  }
  // The trials of a profile, in which one variable is held constant, are drawn, except those with a
  // high target.
  for (const report::ProfileCurve& profile : page->identifiability->profiles) {
    const std::string drawn = profile_plot(profile);
    for (std::size_t k = 0; k < profile.x.size(); ++k) {
      EXPECT_LE(profile.shown[k].size(), std::string("-21.4").size()) << profile.shown[k];
      if (profile.rise[k] > 8.0) continue;
      const std::string title = "<title>" + report::true_minus(profile.shown[k]) + ": ";
      EXPECT_NE(drawn.find(title), std::string::npos) << title;
    }
  }
}

}  // namespace
}  // namespace latsch::correlation
