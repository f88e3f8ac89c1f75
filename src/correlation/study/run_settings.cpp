// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/run_settings.h"

#include <fmt/format.h>

#include <array>

#include "base/document_record.h"
#include "base/text.h"
#include "base/units.h"

namespace latsch::correlation {
namespace {

constexpr long kMostWorkers = 1024;
constexpr long kMostRetries = 100;
// after this many halvings of an interval two numbers are adjacent in double precision
constexpr long kMostHalvingsOfStep = 52;
constexpr double kMostStraggler = 1e6;  // multiple of the median
// largest number of points for each worker that are proposed in advance; all of them are computed
// at every step
constexpr long kMostLookAhead = 1000;
constexpr double kLeastMemory = 16e6;  // bytes; with less a worker does not start

double read_memory(const Node& table) {
  DocumentRecord::expects(table, "memory", R"(an amount of at least 16 MB such as "4 GB")");
  if (!table.has("memory")) return 0.0;
  const std::string text = table.text("memory");
  const auto bytes = parse_memory(text);
  if (!bytes || *bytes < kLeastMemory) {
    table.reject(
        "memory",
        "is " + in_quotes(text) + R"(, expected an amount of at least 16 MB such as "4 GB")");
  }
  return *bytes;
}

/// Throws for a setting that belongs to another policy.
void expect_policy(const Node& table,
                   const char* key,
                   const char* policy,
                   const std::string& what) {
  if (what == policy || !table.has(key)) return;
  table.reject(key, fmt::format("is given without on_failure = \"{}\"", policy));
}

FailurePolicy read_policy(const Node& table) {
  using Then = FailurePolicy::Then;
  FailurePolicy policy;
  const std::string what = table.choice(
      "on_failure", {"proceed", "abort", "retry", "recover", "continuation"}, "proceed");
  expect_policy(table, "retries", "retry", what);
  expect_policy(table, "penalty", "recover", what);
  expect_policy(table, "halvings", "continuation", what);
  if (what == "abort") policy.then = Then::abort;
  if (what == "retry") {
    policy.retries = static_cast<int>(table.integer("retries", 1, kMostRetries, 1));
  }
  if (what == "recover") {
    policy.then = Then::recover;
    policy.penalty = table.quantity("penalty", "1", Range::positive(), policy.penalty);
  }
  if (what == "continuation") {
    policy.then = Then::continuation;
    policy.halvings =
        static_cast<int>(table.integer("halvings", 1, kMostHalvingsOfStep, policy.halvings));
  }
  return policy;
}

/// Returns 0 if no trial counts as a straggler.
double read_straggler_factor(const Node& table, double usual) {
  if (table.flag("stragglers", true)) {
    return table.quantity("straggler_factor", "1", {1.0, kMostStraggler}, usual);
  }
  if (table.has("straggler_factor")) {
    table.reject("straggler_factor", "is given beside stragglers = false");
  }
  return 0.0;
}

}  // namespace

std::string in_words(const FailurePolicy& policy) {
  switch (policy.then) {
    case FailurePolicy::Then::abort:
      return "the run ends";
    case FailurePolicy::Then::recover:
      return fmt::format("it counts as a target of {:g} %", 100.0 * policy.penalty);
    case FailurePolicy::Then::continuation:
      return fmt::format("its point is approached from the nearest success in {} halvings",
                         policy.halvings);
    case FailurePolicy::Then::proceed:
      break;
  }
  return policy.retries == 0
             ? "its point is worse than any that succeeds"
             : fmt::format("it is tried again, at most {} times, before it counts", policy.retries);
}

std::optional<double> parse_memory(std::string_view text) {
  struct Size {
    std::string_view name;
    double bytes;
  };
  static constexpr std::array kSizes{
      Size{"B", 1.0}, Size{"kB", 1e3}, Size{"MB", 1e6}, Size{"GB", 1e9}, Size{"TB", 1e12}};
  const auto split = split_number(text);
  if (!split || !(split->number > 0.0L)) return std::nullopt;
  for (const Size& size : kSizes) {
    if (split->rest == size.name) return static_cast<double>(split->number) * size.bytes;
  }
  return std::nullopt;
}

RunSettings read_run_settings(const Node* table, const std::filesystem::path& study) {
  RunSettings run;
  const auto folder = study.parent_path();
  run.journal = folder / (study.stem().string() + ".latsch");
  if (!table) return run;
  for (const char* key : {"method", "max_steps", "seed"})
    if (table->has(key)) table->reject(key, "belongs in [optimizer], which states how to search");
  run.workers = static_cast<int>(table->integer("workers", 1, kMostWorkers, 1));
  run.timeout = table->quantity("timeout", "s", Range::positive(), run.timeout);
  run.memory = read_memory(*table);
  run.on_failure = read_policy(*table);
  run.straggler_factor = read_straggler_factor(*table, run.straggler_factor);
  run.look_ahead =
      static_cast<int>(table->integer("look_ahead", 1, kMostLookAhead, run.look_ahead));
  run.intervals = table->flag("intervals", run.intervals);
  const std::string journal = table->text("journal", run.journal.filename().string());
  if (journal.empty())
    table->reject("journal", "is empty, expected the name of a file such as \"study.latsch\"");
  run.journal = folder / journal;
  if (std::filesystem::is_directory(run.journal))
    table->reject("journal", "is a folder, expected the name of a file in it");
  if (std::filesystem::exists(run.journal) && !std::filesystem::is_regular_file(run.journal))
    table->reject("journal", "is a device or a pipe, expected the name of a file");
  const bool names_folder = std::filesystem::path(journal).has_parent_path();
  if (names_folder && !std::filesystem::is_directory(run.journal.parent_path()))
    table->reject("journal",
                  "lies in the folder " + run.journal.parent_path().string() +
                      ", which does not exist: make it first");
  return run;
}

}  // namespace latsch::correlation
