// SPDX-License-Identifier: Apache-2.0
#include "exchange/package/fmu_package.h"

#include <algorithm>

#include "base/file.h"
#include "exchange/package/licenses.h"
#include "exchange/package/zip_archive.h"

namespace latsch::exchange {
namespace {

constexpr std::size_t kLargestLibrary = 1u << 30;  // bytes

constexpr const char* kNeedsOfAllModels =
    "The library in `binaries` runs on Linux, x86-64, with glibc 2.36 or later, and needs these\n"
    "shared libraries (Debian 12: libstdc++6 libfmt9 libtomlplusplus3 libudunits2-0 libmetis5\n"
    "libopenblas0-serial zlib1g); `ldd` on it says which of them a machine lacks.\n";
constexpr const char* kNeedsOfSlim =
    "None beyond the C library of the system: glibc 2.36 or later on Linux, x86-64;\n"
    "KERNEL32.dll and msvcrt.dll of every Windows, x86-64.\n";

}  // namespace

std::string fmu_package(FmiVersion version,
                        const UnitTitle& title,
                        const std::vector<ExchangedVariable>& variables,
                        const std::vector<UnitLibrary>& libraries,
                        const UnitFiles& resources) {
  const std::string description = model_description(version, title, variables);
  const bool two = version == FmiVersion::fmi2;
  const bool all_slim =
      std::ranges::all_of(libraries, [](const UnitLibrary& library) { return library.is_slim; });
  ZipArchive zip;
  zip.add("modelDescription.xml", description);
  for (const UnitLibrary& library : libraries) {
    const bool windows = library.file.extension() == ".dll";
    const char* folder =
        windows ? (two ? "win64" : "x86_64-windows") : (two ? "linux64" : "x86_64-linux");
    zip.add(std::string("binaries/") + folder + "/" + identifier_of(title.name) +
                (windows ? ".dll" : ".so"),
            read_text_file(library.file, kLargestLibrary));
  }
  for (const auto& [name, bytes] : resources) zip.add("resources/" + name, bytes);
  zip.add("documentation/externalDependencies.txt", all_slim ? kNeedsOfSlim : kNeedsOfAllModels);
  zip.add("documentation/licenses/licenses.txt", kLicensesOfLibraries);
  return zip.bytes();
}

}  // namespace latsch::exchange
