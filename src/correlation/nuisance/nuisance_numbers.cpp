// SPDX-License-Identifier: Apache-2.0
#include "correlation/nuisance/nuisance_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/document_record.h"
#include "base/text.h"
#include "base/units.h"
#include "correlation/laboratory/stated_difference.h"
#include "correlation/observable/curve.h"

namespace latsch::correlation {
namespace {

constexpr std::size_t kFewestShifted = 8;  // samples that determine a shift beside other numbers
constexpr double kLargestGain = 0.5;       // largest deviation of a gain's prior
constexpr double kLongest = 0.1;           // share of the record that a shift may be
const std::vector<NuisanceKind> kNuisanceKinds{
    NuisanceKind::offset, NuisanceKind::gain, NuisanceKind::delay, NuisanceKind::x_offset};

/// Returns the text of a number; empty for a plain number.
std::string text_of(const Node& table, const std::string& key) {
  try {
    return table.text(key);
  } catch (const InputError&) {
    return "";
  }
}

bool is_free_text(const Node& table, const std::string& key) {
  DocumentRecord::expects(table, key, R"("free")");
  return text_of(table, key) == "free";
}

/// Returns the table [nuisance.NAME] that the number of a recording names; nullptr: it names none.
const Node* shared_table(const Node& table,
                         const std::string& key,
                         const std::vector<Node>& shared) {
  const std::string name = text_of(table, key);
  const auto named = std::find_if(
      shared.begin(), shared.end(), [&](const Node& one) { return one.name() == name; });
  if (named == shared.end()) {
    const bool is_name = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front()));
    if (is_name && name != "free")
      table.reject(key,
                   fmt::format("is {}, which is neither a deviation, \"free\", nor a table "
                               "[nuisance.{}] of a number that several recordings share",
                               in_quotes(name),
                               name));
    return nullptr;
  }
  if (!named->has(key))
    table.reject(key,
                 fmt::format("is shared as [nuisance.{0}] says, but [nuisance.{0}] has no {1}; "
                             "expected {1} = \"free\" or a deviation there",
                             name,
                             key));
  return &*named;
}

/// Throws if the experiment compares something that the number does not change in a known way.
void expect_plain_values(const Node& table,
                         const std::string& key,
                         const Observable& observable,
                         const ObjectiveSettings& objective) {
  const auto* curve = dynamic_cast<const Curve*>(&observable);
  if (!curve && observable.kind() != "load_deflection")
    table.reject(key,
                 "belongs to a recording, but the experiment compares " + observable.kind() +
                     "; expected it in an experiment of kind \"curve\" or \"load_deflection\"");
  if (objective.compared == Compared::root_force)
    table.reject(key,
                 "is given beside compare = \"root_force\": it acts on the force, not on its root; "
                 "expected compare = \"force\"");
  if (!curve) return;
  const ComparedCurve what = curve->measured().comparison.what;
  if (curve->measured().comparison.of_spectrum())
    table.reject(key,
                 "is given beside a compare of spectra, which know no delay and no offset; "
                 "expected compare = \"values\" or \"about_mean\"");
  if (what == ComparedCurve::path)
    table.reject(key,
                 "is given beside compare = \"path\", whose distances it does not shift alone; "
                 "expected compare = \"values\"");
  if (what == ComparedCurve::about_mean && key == "offset")
    table.reject(key,
                 "is given beside compare = \"about_mean\", which already removes it; expected one "
                 "of the two");
}

/// Returns the length of the measured abscissa, after checks that a shift along it has a meaning.
double expect_abscissa(const Node& table, const std::string& key, const Observable& observable) {
  const auto* curve = dynamic_cast<const Curve*>(&observable);
  if (!curve || curve->measured().x.empty())
    table.reject(key,
                 key == "delay" ? "is asked for, but x is missing: a delay needs a curve over time"
                                : "is asked for, but x is missing: it shifts a curve along its x");
  const CurveMeasurement& measured = curve->measured();
  if (key == "delay" && measured.x_unit != "s")
    table.reject(key,
                 "is asked for, but x is in \"" + measured.x_unit +
                     "\": a delay needs a curve over time; along another x it is an x_offset");
  if (key == "x_offset" && measured.x_unit == "s")
    table.reject(key, "is asked for over time, where it is a delay; expected delay");
  const auto& x = measured.x_measured;
  if (x.size() < kFewestShifted)
    table.reject(key,
                 fmt::format("is asked for, but the measured curve has {} samples, expected {} at "
                             "least",
                             x.size(),
                             kFewestShifted));
  if (key == "delay" && std::adjacent_find(x.begin(), x.end(), std::greater_equal<>()) != x.end())
    table.reject(key, "is asked for, but the measured time does not rise everywhere");
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  return *most - *least;
}

std::string unit_of(NuisanceKind kind, const Observable& observable) {
  if (kind == NuisanceKind::offset) return observable.unit();
  if (kind == NuisanceKind::gain) return "1";
  if (kind == NuisanceKind::delay) return "s";
  const auto* curve = dynamic_cast<const Curve*>(&observable);
  return curve ? curve->measured().x_unit : "1";
}

std::string shown_unit_of(NuisanceKind kind, const Observable& observable) {
  if (kind == NuisanceKind::offset) return observable.shown_unit();
  if (kind == NuisanceKind::gain) return "%";
  if (kind == NuisanceKind::delay) return "ms";
  const auto* curve = dynamic_cast<const Curve*>(&observable);
  return curve ? curve->measured().x_shown : "1";
}

/// Reads the prior of a number. `table` is that of the recording or, for a number that several
/// recordings share, [nuisance.NAME].
NuisanceNumber read_number(const Node& table,
                           NuisanceKind kind,
                           const Observable& observable,
                           const ObjectiveSettings& objective,
                           bool has_noise) {
  const std::string key = name_of(kind);
  NuisanceNumber number{kind};
  const bool is_free = is_free_text(table, key);
  expect_plain_values(table, key, observable, objective);
  double length = INFINITY;
  if (kind == NuisanceKind::delay || kind == NuisanceKind::x_offset)
    length = expect_abscissa(table, key, observable);
  const auto compared = Unit::find(observable.unit());
  if (kind == NuisanceKind::gain && compared && compared->same_dimension(Unit::of("K")))
    table.reject(key,
                 "is asked for, but a temperature has no zero that a gain could keep; expected an "
                 "offset");
  number.shown = shown_unit_of(kind, observable);
  if (is_free) return number;
  if (kind == NuisanceKind::gain)
    DocumentRecord::expects(table, key, R"(a share such as "3 %", above 0, at most 50 %)");
  number.prior = kind == NuisanceKind::gain
                     ? table.quantity(key, unit_of(kind, observable), Range::positive())
                     : read_difference(table, key, unit_of(kind, observable));
  if (kind == NuisanceKind::gain && number.prior > kLargestGain)
    table.reject(
        key,
        fmt::format("is the deviation of a gain of {:g} %; expected a share of up to {:g} %, such "
                    "as \"1 %\", or \"free\"",
                    100.0 * number.prior,
                    100.0 * kLargestGain));
  if (number.prior > kLongest * length)
    table.reject(key,
                 fmt::format("is {:g} {}, longer than a tenth of the record, which is {:g} {}; "
                             "expected a smaller deviation, or a longer record",
                             number.prior,
                             unit_of(kind, observable),
                             length,
                             unit_of(kind, observable)));
  if (!has_noise)
    table.reject(key,
                 "has a prior, which is weighed against the measured values; expected noise in the "
                 "experiment, such as noise = \"2 %\", or \"free\"");
  return number;
}

}  // namespace

std::string name_of(NuisanceKind kind) {
  switch (kind) {
    case NuisanceKind::offset:
      return "offset";
    case NuisanceKind::gain:
      return "gain";
    case NuisanceKind::delay:
      return "delay";
    case NuisanceKind::x_offset:
      break;
  }
  return "x_offset";
}

std::string NuisanceNumber::name() const {
  return name_of(kind) + (is_shared() ? " of [nuisance." + shared + "]" : "");
}

bool Nuisance::shares() const {
  return held.empty() && std::any_of(numbers.begin(), numbers.end(), [](const auto& one) {
           return one.is_shared();
         });
}

int Nuisance::shift() const {
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (numbers[k].kind == NuisanceKind::delay || numbers[k].kind == NuisanceKind::x_offset)
      return static_cast<int>(k);
  return -1;
}

std::string Nuisance::in_words() const {
  std::string text;
  for (const NuisanceNumber& one : numbers) {
    text += (text.empty() ? "" : ", ") + one.name();
    text += one.is_free() ? " free" : " 0 +- " + shown_text(one, one.prior, one.prior);
  }
  return text;
}

Nuisance read_nuisance(const Node& experiment,
                       const std::vector<Node>& shared,
                       const Observable& observable,
                       const ObjectiveSettings& objective,
                       bool is_fitted,
                       bool has_noise) {
  const auto table = experiment.find_table("nuisance");
  if (!table) return {};
  Nuisance nuisance;
  for (const NuisanceKind kind : kNuisanceKinds) {
    if (!table->has(name_of(kind))) continue;
    const Node* together = shared_table(*table, name_of(kind), shared);
    nuisance.numbers.push_back(
        read_number(together ? *together : *table, kind, observable, objective, has_noise));
    if (together) nuisance.numbers.back().shared = together->name();
  }
  const auto names = table->keys();
  if (nuisance.empty() && names.empty())
    experiment.reject("nuisance",
                      "is empty, expected offset, gain, delay or x_offset, each a deviation or "
                      "\"free\"");
  const auto* curve = dynamic_cast<const Curve*>(&observable);
  const bool solves_itself = curve && curve->measured().fits_delay;
  if (!is_fitted && !solves_itself)
    experiment.reject("nuisance",
                      "is given in an experiment that is only predicted, whose values must not "
                      "choose these numbers; expected use = \"fit\", or no nuisance");
  return solves_itself ? Nuisance{} : nuisance;
}

void expect_named(const std::vector<Node>& shared, const std::vector<const Nuisance*>& recordings) {
  for (const Node& table : shared) {
    bool is_empty = true;
    for (const NuisanceKind kind : kNuisanceKinds) {
      const std::string key = name_of(kind);
      if (!table.has(key)) continue;
      is_empty = false;
      const NuisanceNumber number{.kind = kind, .shared = table.name()};
      const bool is_named =
          std::any_of(recordings.begin(), recordings.end(), [&](const Nuisance* one) {
            return std::any_of(one->numbers.begin(), one->numbers.end(), [&](const auto& its) {
              return its.is_one_with(number);
            });
          });
      if (!is_named)
        table.reject(key,
                     fmt::format("is named by no recording; expected nuisance = {{{} = \"{}\"}} in "
                                 "the experiments that share it",
                                 key,
                                 table.name()));
    }
    if (is_empty)
      table.reject("gain",
                   "is missing, expected offset, gain, delay or x_offset, each a deviation or "
                   "\"free\"");
  }
}

std::string shown_text(const NuisanceNumber& number, double value, double deviation) {
  const auto unit = Unit::find(number.shown);
  const double times = unit ? unit->from_si(1.0) - unit->from_si(0.0) : 1.0;
  return format_known(times * value, times * deviation) +
         (number.shown == "1" ? "" : " " + number.shown);
}

}  // namespace latsch::correlation
