// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/mpi/message_passing.h"

#include <dlfcn.h>

#include <filesystem>

namespace latsch {
namespace {

/// Path of the library, ../lib/latsch/latsch_mpi.so relative to the program.
std::filesystem::path library_of_mpi() {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  return program.parent_path().parent_path() / "lib" / "latsch" / "latsch_mpi.so";
}

}  // namespace

bool has_message_passing() { return std::filesystem::exists(library_of_mpi()); }

Result<std::unique_ptr<MessagePassing>> start_message_passing() {
  const std::filesystem::path file = library_of_mpi();
  if (!std::filesystem::exists(file)) {
    return Failure{file.string() +
                   " is not there, which calls MPI: the Debian package latsch-mpi has it, and a "
                   "build makes it if Open MPI "
                   "is installed (tools/install_packages.sh mpi)"};
  }
  // The components that Open MPI loads look for its functions among those of the whole program.
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (library == nullptr) return Failure{std::string("it cannot be loaded: ") + ::dlerror()};
  using Start = MessagePassing* (*)();
  const auto start = reinterpret_cast<Start>(::dlsym(library, "latsch_start_message_passing"));
  if (start == nullptr) return Failure{file.string() + " is none of this version of latsch"};
  std::unique_ptr<MessagePassing> ranks(start());
  if (!ranks) return Failure{"this MPI supports no threads"};
  return ranks;
}

}  // namespace latsch
