// SPDX-License-Identifier: Apache-2.0
#include "exchange/loading.h"

#include <algorithm>
#include <exception>
#include <string_view>

#include "base/error.h"
#include "base/text.h"
#include "base/utf8.h"
#include "exchange/own_arithmetic.h"
#include "exchange/unit/unit_reading.h"

namespace latsch::exchange {
namespace {

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string decoded(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      result += text[i];
      continue;
    }
    const int high = i + 2 < text.size() ? digit(text[i + 1]) : -1;
    const int low = high >= 0 ? digit(text[i + 2]) : -1;
    if (low < 0)
      throw InputError("the folder " + in_quotes(text) + " has % without two digits behind it");
    result += static_cast<char>(16 * high + low);
    i += 2;
  }
  return result;
}

}  // namespace

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// True for a path of Windows: "C:\\tire", "C:/tire", "\\\\server\\share".
bool is_windows_path(std::string_view text) {
  if (text.starts_with("\\\\")) return true;
  return text.size() > 2 && is_letter(text[0]) && text[1] == ':' &&
         (text[2] == '/' || text[2] == '\\');
}

bool begins_with_file(std::string_view uri) {
  constexpr std::string_view kFile = "file:";
  return uri.size() >= kFile.size() &&
         std::equal(kFile.begin(), kFile.end(), uri.begin(), [](char a, char b) {
           return a == (b >= 'A' && b <= 'Z' ? static_cast<char>(b - 'A' + 'a') : b);
         });
}

}  // namespace

std::string folder_of_uri(const std::string& uri) {
  if (uri.starts_with("/") || is_windows_path(uri)) return uri;
  const auto refuse = [&] {
    return InputError("the resources are at " + in_quotes(uri) +
                      ": expected a folder of this machine, \"file:///...\"");
  };
  if (!begins_with_file(uri)) throw refuse();
  std::string path = uri.substr(5);
  if (path.starts_with("//")) {
    const std::size_t slash = path.find('/', 2);
    const std::string host = path.substr(2, slash == path.npos ? path.npos : slash - 2);
    if (slash == path.npos || !(host.empty() || host == "localhost")) throw refuse();
    path = path.substr(slash);
  }
  path = decoded(path);
  // the slash before a drive is none of the path: "/C:/tire"
  if (path.starts_with("/") && is_windows_path(std::string_view(path).substr(1)))
    return path.substr(1);
  if (!path.starts_with("/") && !is_windows_path(path)) throw refuse();
  return path;
}

std::unique_ptr<Instance> load_instance(const std::string& folder,
                                        const std::string& token,
                                        const Instance::Log& log) {
  const OwnArithmetic own;
  try {
    UnitFromFolder found = read_unit(path_of_utf8(folder_of_uri(folder)), models_of_library());
    if (found.token != token)
      throw InputError("the unit in " + in_quotes(folder) + " is " + found.token + ", expected " +
                       in_quotes(token) + ": resources and description are not of one package");
    return std::make_unique<Instance>(std::move(found.unit), log);
  } catch (const std::exception& error) {
    if (log) log(CallStatus::error, kLogError, error.what());
  } catch (...) {
    if (log) log(CallStatus::error, kLogError, "an unknown failure");
  }
  return nullptr;
}

}  // namespace latsch::exchange
