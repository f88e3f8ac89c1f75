// SPDX-License-Identifier: Apache-2.0
// Test support: unpacks an FMI package of version 2.0 or 3.0 and loads it through its C functions
// alone, as another program does. Both versions have the same interface here, so each test runs
// with both.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/scratch_folder_testing.h"
#include "exchange/instance.h"
#include "exchange/package/fmu_package.h"

namespace latsch::exchange {

/// Unpacks a ZIP file into the folder.
void unpack(const std::string& bytes, const std::filesystem::path& folder);

/// The shared library of a package, loaded into this process.
class Binary {
 public:
  explicit Binary(const std::filesystem::path& file);
  ~Binary();
  Binary(const Binary&) = delete;
  Binary& operator=(const Binary&) = delete;

  /// Returns the function of this name; nullptr if the library exports none.
  void* find(const std::string& name) const;
  template <class F>
  F* function(const std::string& name) const {
    return reinterpret_cast<F*>(find(name));
  }

 private:
  void* handle_ = nullptr;
};

/// A package whose files have been unpacked.
struct Package {
  /// Makes and unpacks the package of a model's file in `studies`. `road` is the text of a road's
  /// .toml; empty: the package has no road. `library` is the binary; empty: the slim library of the
  /// version.
  Package(FmiVersion version,
          const std::string& model,
          const std::string& road,
          const std::filesystem::path& library = {});

  std::filesystem::path file(const std::string& name) const { return folder / name; }
  unsigned reference(const std::string& variable) const;

  ScratchFolder folder;
  FmiVersion version;
  std::vector<ExchangedVariable> variables;
  std::string token;
  std::unique_ptr<Binary> binary;
};

/// An instance of an FMU, created from a package. `log` contains its messages.
class Slave {
 public:
  virtual ~Slave() = default;

  virtual bool there() const = 0;
  /// the whole initialization of an instance in the state `instantiated`
  virtual CallStatus initialize(double start) = 0;
  virtual CallStatus enter(double start) = 0;  // enters the initialization mode
  virtual CallStatus leave() = 0;              // leaves the initialization mode
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

/// Creates an instance. If `token` or `resources` is empty, those of the package are used.
std::unique_ptr<Slave> instantiate(const Package& package,
                                   const std::string& token = "",
                                   const std::string& resources = "");

}  // namespace latsch::exchange
