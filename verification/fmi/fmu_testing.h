// SPDX-License-Identifier: Apache-2.0
// For tests: a package of FMI 2.0 or 3.0, unpacked and loaded by its C functions alone, as another
// program loads it. Both versions have one interface, so one test drives both.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/scratch_folder_testing.h"
#include "exchange/fmu_package.h"
#include "exchange/instance.h"

namespace latsch::exchange {

/// Writes the contents of a ZIP file below the folder.
void unpack(const std::string& bytes, const std::filesystem::path& folder);

/// A loaded binary: its functions by their names.
class Binary {
 public:
  explicit Binary(const std::filesystem::path& file);
  ~Binary();
  Binary(const Binary&) = delete;
  Binary& operator=(const Binary&) = delete;

  /// Returns nullptr if the binary exports no such name.
  void* find(const std::string& name) const;
  template <class F>
  F* function(const std::string& name) const {
    return reinterpret_cast<F*>(find(name));
  }

 private:
  void* handle_ = nullptr;
};

/// An unpacked package.
struct Package {
  /// Makes a package of a file in `studies`. `road` is the text of a .toml; empty: no road given.
  Package(FmiVersion version, const std::string& model, const std::string& road);

  std::filesystem::path file(const std::string& name) const { return folder / name; }
  unsigned reference(const std::string& variable) const;

  ScratchFolder folder;
  FmiVersion version;
  std::vector<ExchangedVariable> variables;
  std::string token;
  std::unique_ptr<Binary> binary;
};

/// An instance made from a package. `log` contains its messages.
class Slave {
 public:
  virtual ~Slave() = default;

  virtual bool there() const = 0;
  virtual CallStatus initialize(double start) = 0;  // the whole initialization, from `instantiated`
  virtual CallStatus enter(double start) = 0;       // its first half
  virtual CallStatus leave() = 0;                   // its second half
  virtual CallStatus set(unsigned reference, double value) = 0;
  virtual CallStatus get(unsigned reference, double& value) = 0;
  virtual CallStatus step(double time, double step) = 0;
  virtual CallStatus copy(void** state) = 0;
  virtual CallStatus restore(void* state) = 0;
  virtual CallStatus free(void** state) = 0;
  virtual CallStatus terminate() = 0;
  virtual CallStatus reset() = 0;
  virtual CallStatus ask_for_integer() = 0;

  std::vector<std::pair<CallStatus, std::string>> log;
};

/// Empty `token` and `resources` stand for those of the package.
std::unique_ptr<Slave> instantiate(const Package& package,
                                   const std::string& token = "",
                                   const std::string& resources = "");

}  // namespace latsch::exchange
