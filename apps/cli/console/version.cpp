// SPDX-License-Identifier: Apache-2.0
#include "cli/console/version.h"

#include <Eigen/src/Core/util/Macros.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <metis.h>
#include <sqlite3.h>
#include <zlib.h>

#include <boost/version.hpp>
#include <vector>

#include "evaluation/executors/mpi/message_passing.h"
#include "numerics/kernels/kernel_set.h"
#include "web/web_assets.h"

extern "C" char* openblas_get_config();

namespace latsch::cli {
namespace {

#ifdef __clang__
constexpr const char* kCompiler = "Clang";
#else
constexpr const char* kCompiler = "GCC";
#endif

std::string kernels() {
  std::vector<std::string> names;
  for (const KernelSet set : kernel_sets()) names.push_back(std::string(name(set)));
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::string version_number() { return LATSCH_VERSION; }

std::string version_text() {
  return fmt::format(
      "latsch {} ({}, kernels {})\n"
      "compiler   {} {}, C++{}\n"
      "kernels    {} on this processor; LATSCH_KERNELS forces one\n"
      "libraries  Eigen {}.{}.{}, METIS {}.{}.{}, SQLite {}, Boost {}.{}.{}, fmt {}.{}.{}, zlib "
      "{}\n"
      "           {}\n"
      "MPI        {}\n"
      "page       {}",
      LATSCH_VERSION,
      processor_name(),
      name(kernel_set()),
      kCompiler,
      __VERSION__,
      __cplusplus / 100 % 100,
      kernels(),
      EIGEN_WORLD_VERSION,
      EIGEN_MAJOR_VERSION,
      EIGEN_MINOR_VERSION,
      METIS_VER_MAJOR,
      METIS_VER_MINOR,
      METIS_VER_SUBMINOR,
      sqlite3_libversion(),
      BOOST_VERSION / 100000,
      BOOST_VERSION / 100 % 1000,
      BOOST_VERSION % 100,
      FMT_VERSION / 10000,
      FMT_VERSION / 100 % 100,
      FMT_VERSION % 100,
      zlibVersion(),
      openblas_get_config(),
      has_message_passing() ? "yes" : "no: latsch_mpi.so is not installed",
      !studio::web_assets().empty() ? "latsch serve shows it"
                                    : "none: latsch serve answers only programs");
}

}  // namespace latsch::cli
