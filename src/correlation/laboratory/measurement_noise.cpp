// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/measurement_noise.h"

#include <fmt/format.h>

#include <cmath>

#include "base/document_record.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "correlation/laboratory/stated_difference.h"
#include "correlation/laboratory/stated_share.h"

namespace latsch::correlation {
namespace {

// share of the value: a noise larger than the value itself is no measurement
constexpr double kLargestShare = 1.0;
constexpr double kHuberScale = 1.345, kCauchyScale = 2.385;

std::string wanted_noise(const std::string& unit) {
  std::string example = "\"2 %\"";
  if (unit != "1")
    example = "a deviation in " + unit + ", in percent, or both as in \"20 " + unit + " + 2 %\"";
  return "expected " + example;
}

void add_part(const Node& table,
              const std::string& part,
              const std::string& unit,
              const std::string& key,
              MeasurementNoise& noise) {
  const auto reject = [&](const std::string& why) {
    table.reject(key, "is " + in_quotes(table.text(key)) + why + ", " + wanted_noise(unit));
  };
  const auto compared = Unit::find(unit);
  const auto quantity = compared ? parse_quantity(part, *compared) : parse_quantity(part);
  if (!quantity) reject(", of which " + in_quotes(part) + " is not a number with a unit");
  if (!std::isfinite(quantity->si) || !(quantity->si > 0.0)) {
    reject(", of which " + in_quotes(part) + " is not above 0");
  }
  expect_difference(table, key, part, unit);
  const bool is_relative = quantity->unit.dimensionless();
  if (!is_relative && !(compared && quantity->unit.same_dimension(*compared))) {
    reject(", but what is compared is in " + unit);
  }
  if (is_relative && quantity->si > kLargestShare) {
    expect_stated_share(table, key, part, quantity->si, unit);
    reject(", of which " + in_quotes(part) + " is more than the measured value itself");
  }
  double& given = is_relative ? noise.relative : noise.absolute;
  if (given > 0.0) reject(", which says the same twice");
  given = quantity->si;
}

bool is_a_text(const Node& table, const std::string& key) {
  try {
    table.text(key);
    return true;
  } catch (const InputError&) {
    return false;  // the text is a number and no keyword
  }
}

}  // namespace

bool is_estimated(const Node& experiment) {
  DocumentRecord::expects(experiment, "noise", R"("estimated" or "own_stage")");
  return experiment.has("noise") && is_a_text(experiment, "noise") &&
         (experiment.text("noise") == "estimated" || is_of_own_stage(experiment));
}

bool is_of_own_stage(const Node& experiment) {
  return experiment.has("noise") && is_a_text(experiment, "noise") &&
         experiment.text("noise") == "own_stage";
}

std::optional<MeasurementNoise> read_noise(const Node& table,
                                           const std::string& unit,
                                           const std::string& key) {
  DocumentRecord::expects(
      table, key, R"(a deviation in the unit of what is compared, a share such as "2 %", or both)");
  if (!table.has(key)) return std::nullopt;
  MeasurementNoise noise;
  if (!is_a_text(table, key)) {
    noise.relative = read_share(table, key, Range::positive(), unit);
    return noise;
  }
  const std::string text = table.text(key);
  size_t from = 0;
  while (true) {
    // A sum is recognized by the spaces around its sign; the sign of an exponent, "1e+2 N", has
    // none.
    const size_t plus = text.find(" + ", from);
    add_part(
        table, text.substr(from, plus == std::string::npos ? plus : plus - from), unit, key, noise);
    if (plus == std::string::npos) return noise;
    from = plus + 3;
  }
}

RobustLoss read_loss(const Node& table, bool noise_is_stated) {
  RobustLoss robust;
  const std::string loss = table.choice("loss", {"squares", "huber", "cauchy"}, "squares");
  if (loss == "squares") {
    if (table.has("loss_scale")) {
      table.reject("loss_scale",
                   "is given, but no loss = \"huber\" or \"cauchy\" that has a scale");
    }
    return robust;
  }
  robust.loss = loss == "huber" ? Loss::huber : Loss::cauchy;
  if (!noise_is_stated && !table.has("loss_scale")) {
    table.reject("loss",
                 "is \"" + loss +
                     "\", but it is not known beyond which error values count less: expected "
                     "noise beside it, "
                     "or loss_scale = \"5 %\", an error beyond which they do");
  }
  robust.scale = robust.loss == Loss::huber ? kHuberScale : kCauchyScale;
  if (!table.has("loss_scale")) return robust;
  if (noise_is_stated && is_percentage(table, "loss_scale"))
    table.reject(
        "loss_scale",
        fmt::format("is {}, but beside a stated noise it counts in its deviations; expected "
                    "a plain number such as {:g}",
                    in_quotes(table.text("loss_scale")),
                    robust.scale));
  robust.scale = noise_is_stated ? table.quantity("loss_scale", "1", Range::positive())
                                 : read_share(table, "loss_scale", Range::positive());
  return robust;
}

}  // namespace latsch::correlation
