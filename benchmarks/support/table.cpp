// SPDX-License-Identifier: Apache-2.0
#include "table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "numerics/kernels/kernel_set.h"

namespace latsch::benchmarks {
namespace {

/// Returns `text` padded with blanks to `width` characters. A UTF-8 character of several bytes
/// counts once.
std::string padded(std::string_view text, std::size_t width) {
  const auto characters =
      static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
      }));
  return std::string(text) + std::string(width - std::min(width, characters), ' ');
}

void print(std::string_view what,
           std::string_view value,
           std::string_view reach,
           std::string_view ok) {
  fmt::print("{} | {} | {} | {}\n", padded(what, 58), padded(value, 26), padded(reach, 14), ok);
  std::fflush(stdout);
}

}  // namespace

Table::Table(std::string_view name, const Options& options)
    : name_(name), is_smoke_(options.is_smoke()) {
  fmt::print("{}{} on {}, kernels {}\n",
             name,
             is_smoke_ ? ", smoke run" : "",
             processor_name(),
             latsch::name(kernel_set()));
  print("what", "value", "reach", "ok");
  print(std::string(58, '-'), std::string(26, '-'), std::string(14, '-'), "---");
}

void Table::row(std::string_view what, std::string_view value, std::string_view reach, bool ok) {
  ++rows_;
  short_ += ok ? 0 : 1;
  print(what, value, reach, ok ? "yes" : "NO");
}

void Table::full_row(std::string_view what,
                     std::string_view value,
                     std::string_view reach,
                     bool ok) {
  if (!is_smoke_) return row(what, value, reach, ok);
  ++rows_;
  print(what, value, reach, "not judged");
}

void Table::note(std::string_view what, std::string_view value) {
  ++notes_;
  print(what, value, "", "");
}

void Table::skip(std::string_view what, std::string_view reason) {
  ++skipped_;
  print(what, reason, "", "skipped");
}

int Table::exit_code() const {
  if (short_ > 0) {
    fmt::print("{}: {} of {} rows fall short\n", name_, short_, rows_);
    return 1;
  }
  if (skipped_ > 0) {
    fmt::print("{}: skipped in part, for what this machine lacks\n", name_);
    return is_smoke_ ? kSkipped : 1;
  }
  if (rows_ == 0) {
    fmt::print("{}: {}\n",
               name_,
               notes_ > 0 ? "nothing that has a reach was measured" : "nothing was measured");
    return 1;
  }
  fmt::print("{}: all {} rows {}\n", name_, rows_, is_smoke_ ? "computed" : "reached");
  return 0;
}

}  // namespace latsch::benchmarks
