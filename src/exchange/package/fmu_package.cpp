// SPDX-License-Identifier: Apache-2.0
#include "exchange/package/fmu_package.h"

#include <zip.h>

#include <memory>
#include <stdexcept>

#include "base/file.h"
#include "exchange/package/licenses.h"

namespace latsch::exchange {
namespace {

constexpr std::size_t kLargestLibrary = 1u << 30;  // bytes

constexpr const char* kNeedsOfAllModels =
    "The library in `binaries` runs on Linux, x86-64, with glibc 2.36 or later, and needs these\n"
    "shared libraries (Debian 12: libstdc++6 libfmt9 libtomlplusplus3 libudunits2-0 libmetis5\n"
    "libopenblas0-serial libmatio11 zlib1g); `ldd` on it says which of them a machine lacks.\n";
constexpr const char* kNeedsOfSlim =
    "None beyond the C library of the system: glibc 2.36 or later on Linux, x86-64;\n"
    "KERNEL32.dll and msvcrt.dll of every Windows, x86-64.\n";

/// Throws with the error of libzip, which in practice means out of memory.
[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(std::string("the package cannot be made: ") + what);
}

/// A ZIP file in memory.
class Zip {
 public:
  Zip() {
    zip_error_t error;
    zip_error_init(&error);
    source_ = zip_source_buffer_create(nullptr, 0, 0, &error);
    if (!source_) fail(zip_error_strerror(&error));
    zip_ = zip_open_from_source(source_, ZIP_TRUNCATE, &error);
    if (!zip_) fail(zip_error_strerror(&error));
    zip_source_keep(source_);  // closing the archive drops one reference
    zip_error_fini(&error);
  }
  ~Zip() {
    if (zip_) zip_discard(zip_);
    zip_source_free(source_);
  }
  Zip(const Zip&) = delete;
  Zip& operator=(const Zip&) = delete;

  /// Adds a file; `bytes` must stay valid until bytes() is called.
  void add(const std::string& name, const std::string& bytes) {
    zip_source_t* content = zip_source_buffer(zip_, bytes.data(), bytes.size(), 0);
    if (!content) fail(zip_strerror(zip_));
    const zip_int64_t index = zip_file_add(zip_, name.c_str(), content, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      zip_source_free(content);
      fail(zip_strerror(zip_));
    }
    const auto place = static_cast<zip_uint64_t>(index);
    zip_set_file_compression(zip_, place, ZIP_CM_DEFLATE, kLevel);
    zip_file_set_dostime(zip_, place, 0, kEpoch, 0);
  }

  std::string bytes() {
    if (zip_close(zip_) != 0) fail(zip_strerror(zip_));
    zip_ = nullptr;
    zip_stat_t size;
    if (zip_source_stat(source_, &size) != 0 || zip_source_open(source_) != 0)
      fail("its bytes cannot be read");
    std::string result(size.size, '\0');
    if (zip_source_read(source_, result.data(), result.size()) !=
        static_cast<zip_int64_t>(result.size()))
      fail("its bytes cannot be read");
    zip_source_close(source_);
    return result;
  }

 private:
  // takes a third of the time of level 9; the result is a few percent larger
  static constexpr zip_uint32_t kLevel = 3;
  // January 1, 1980, the first date that a ZIP file can state.
  static constexpr zip_uint16_t kEpoch = (1 << 5) | 1;

  zip_source_t* source_ = nullptr;
  zip_t* zip_ = nullptr;
};

}  // namespace

std::string fmu_package(FmiVersion version,
                        const UnitTitle& title,
                        const std::vector<ExchangedVariable>& variables,
                        const std::vector<UnitLibrary>& libraries,
                        const UnitFiles& resources) {
  const std::string description = model_description(version, title, variables);
  const bool two = version == FmiVersion::fmi2;
  std::vector<std::string> binaries;  // the archive reads them when it is closed
  bool all_slim = true;
  for (const UnitLibrary& library : libraries) {
    binaries.push_back(read_text_file(library.file, kLargestLibrary));
    all_slim = all_slim && library.is_slim;
  }
  const std::string needs = all_slim ? kNeedsOfSlim : kNeedsOfAllModels;
  const std::string licenses = kLicensesOfSlimLibraries;
  Zip zip;
  zip.add("modelDescription.xml", description);
  for (std::size_t i = 0; i < libraries.size(); ++i) {
    const bool windows = libraries[i].file.extension() == ".dll";
    const char* folder =
        windows ? (two ? "win64" : "x86_64-windows") : (two ? "linux64" : "x86_64-linux");
    zip.add(std::string("binaries/") + folder + "/" + identifier_of(title.name) +
                (windows ? ".dll" : ".so"),
            binaries[i]);
  }
  for (const auto& [name, bytes] : resources) zip.add("resources/" + name, bytes);
  zip.add("documentation/externalDependencies.txt", needs);
  if (all_slim) zip.add("documentation/licenses/licenses.txt", licenses);
  return zip.bytes();
}

}  // namespace latsch::exchange
