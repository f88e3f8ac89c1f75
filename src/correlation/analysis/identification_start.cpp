// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/identification_start.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>

#include "base/unit_words/c_locale.h"
#include "correlation/analysis/identification_rounds.h"

namespace latsch::correlation {
namespace {

std::string mark_of(Depth depth) {
  return depth == Depth::profiles ? "identification" : "intervals";
}

std::optional<DesignPoint> marked_point(const Study& study, const Journal& journal, Depth depth) {
  std::optional<DesignPoint> point;
  for (const JournalMark& mark : journal.marks())
    if (mark.kind == mark_of(depth)) point = point_of_text(study, mark.text);
  return point;
}

/// An optimizer that records whether it has observed a given point.
class Watched : public Optimizer {
 public:
  Watched(Optimizer& optimizer, const DesignPoint& point, bool& seen)
      : optimizer_(optimizer), point_(point), seen_(seen) {}
  std::vector<DesignPoint> propose(int count) const override { return optimizer_.propose(count); }
  void observe(const DesignPoint& point, const Result<Score>& outcome) override {
    seen_ = seen_ || point == point_;
    optimizer_.observe(point, outcome);
  }
  bool converged() const override { return optimizer_.converged(); }

 private:
  Optimizer& optimizer_;
  const DesignPoint& point_;
  bool& seen_;
};

/// Returns true if an identification from `start` has evaluated `point`, as far as the journal
/// shows.
bool comes_by(const Study& study,
              const Journal& journal,
              const DesignPoint& start,
              const DesignPoint& point,
              Depth depth) {
  bool seen = false;
  const Drive read = reading(study, journal);
  const Drive drive = [&](Optimizer& optimizer, RefitTrials* refits, const AsksWorkDone& standing) {
    Watched watched(optimizer, point, seen);
    return read(watched, refits, standing) && !seen;
  };
  Identifiability result{
      start, Identification(study.space, start, options_for(study, depth)), std::nullopt};
  (void)analyze({study, journal, nullptr, drive}, result);
  return seen;
}

}  // namespace

std::string text_of_point(const DesignPoint& point) {
  std::string text;
  for (const double value : point.values) text += fmt::format("{:a} ", value);
  return text;
}

std::optional<DesignPoint> point_of_text(const Study& study, const std::string& text) {
  [[maybe_unused]] const CLocale decimal_points;
  std::istringstream words(text);
  DesignPoint point;
  for (std::string word; words >> word;) point.values.push_back(std::strtod(word.c_str(), nullptr));
  if (std::ssize(point.values) != study.space.size() || !study.space.contains(point))
    return std::nullopt;
  return point;
}

bool has_begun(const Journal& journal, Depth depth) {
  for (const JournalMark& mark : journal.marks())
    if (mark.kind == mark_of(depth)) return true;
  return false;
}

DesignPoint identification_start(const Study& study,
                                 const Journal& journal,
                                 const DesignPoint& best,
                                 Depth depth) {
  const auto marked = marked_point(study, journal, depth);
  if (!marked || *marked == best) return best;
  return comes_by(study, journal, *marked, best, depth) ? *marked : best;
}

DesignPoint begin_identification(const Study& study,
                                 Journal& journal,
                                 const DesignPoint& best,
                                 Depth depth) {
  if (depth == Depth::at_the_point) return best;
  const DesignPoint start = identification_start(study, journal, best, depth);
  if (marked_point(study, journal, depth) != start)
    journal.mark(mark_of(depth), text_of_point(start));
  return start;
}

}  // namespace latsch::correlation
