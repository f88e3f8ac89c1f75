// SPDX-License-Identifier: Apache-2.0
// Loads a library of the Standard Tyre Interface as a solver does, on Linux or Windows, rolls its
// tire, and prints the bits of force and moment, so that runs on different systems can be compared
// (windows_test.py).
//
//   sti_caller LIBRARY TIRE_FILE ROAD STEPS STEP HEIGHT SPEED SPIN_RATE
//
// ROAD is the file of a road or "-" for a plane that this program answers for, with a slope of 2 %.
// SI. The exit code is 4 for a library that cannot be loaded and 2 for a call that does not end
// well, whose reason goes to the standard error.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "exchange/sti.h"

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace {

using latsch::exchange::sti::Dtyre;
using Message = const char*(const int*);

void* address_of(const char* file, const char* name) {
#ifdef _WIN32
  const HMODULE library = LoadLibraryA(file);
  return library ? reinterpret_cast<void*>(GetProcAddress(library, name)) : nullptr;
#else
  void* library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  return library ? dlsym(library, name) : nullptr;
#endif
}

void sloping_plane(const double*,
                   const double dis[2],
                   const int*,
                   const int*,
                   const int*,
                   const int*,
                   const int*,
                   const double[],
                   const int*,
                   const char*,
                   const int*,
                   int* nroad,
                   double* z,
                   double dz[2],
                   double ddz[3],
                   int* dflag,
                   double prsurf[],
                   int* ierr,
                   std::ptrdiff_t) {
  *nroad = 2;
  *z = 0.02 * dis[0];
  dz[0] = 0.02;
  dz[1] = ddz[0] = ddz[1] = ddz[2] = 0.0;
  *dflag = 1;
  prsurf[0] = 1.0;
  *ierr = 0;
}

/// Returns the arguments in UTF-8, as the library wants the names of files.
std::vector<std::string> words_of(int argc, char** argv) {
#ifdef _WIN32
  (void)argv;
  std::vector<std::string> words;
  wchar_t** wide = CommandLineToArgvW(GetCommandLineW(), &argc);
  for (int i = 0; i < argc; ++i) {
    char text[4096] = {};
    WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, text, sizeof text - 1, nullptr, nullptr);
    words.emplace_back(text);
  }
  return words;
#else
  return {argv, argv + argc};
#endif
}

void print_bits(const double values[3]) {
  for (int i = 0; i < 3; ++i) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, values + i, sizeof bits);
    std::printf(
        "%08x%08x ", static_cast<unsigned>(bits >> 32), static_cast<unsigned>(bits & 0xffffffffu));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words = words_of(argc, argv);
  if (words.size() != 9) return 3;
  const auto dtyre = reinterpret_cast<Dtyre*>(address_of(words[1].c_str(), "dtyre_"));
  const auto same = reinterpret_cast<Dtyre*>(address_of(words[1].c_str(), "dtyre"));
  const auto message =
      reinterpret_cast<Message*>(address_of(words[1].c_str(), "latsch_sti_message"));
  if (!dtyre || !same || !message) {
    std::fprintf(stderr, "%s cannot be loaded\n", words[1].c_str());
    return 4;
  }
  const std::string &file = words[2], &road = words[3];
  const int steps = std::atoi(words[4].c_str());
  const double step = std::atof(words[5].c_str()), height = std::atof(words[6].c_str()),
               speed = std::atof(words[7].c_str()), spin_rate = std::atof(words[8].c_str());
  const bool answers = road == "-";
  const int ndev = 1, iswtch = 0, idtyre = 7, idroad = 1, nropar = 0;
  const int nchtds = static_cast<int>(file.size());
  const int nchrds = answers ? 0 : static_cast<int>(road.size());
  const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, none[3] = {0, 0, 0};
  int ndeqvr = 0, ntypar = 0, nvars = 0, nwork = 0, niwork = 0, ierr = 0;
  std::vector<double> typarr, varinf, work(1);
  std::vector<int> iwork(1);
  char tyrmod[256];
  const auto call = [&](Dtyre* function, int job, double time) {
    const double dis[3] = {speed * time, 0.0, height}, vel[3] = {speed, 0.0, 0.0},
                 omega[3] = {0.0, spin_rate, 0.0}, angle = spin_rate * time;
    double force[3] = {}, torque[3] = {};
    function(&ndev,
             &iswtch,
             &job,
             &idtyre,
             &time,
             dis,
             identity,
             &angle,
             vel,
             omega,
             &spin_rate,
             &ndeqvr,
             none,
             &ntypar,
             typarr.data(),
             &nchtds,
             file.c_str(),
             answers ? sloping_plane : nullptr,
             &idroad,
             &nropar,
             none,
             &nchrds,
             road.c_str(),
             force,
             torque,
             work.data(),
             work.data(),
             tyrmod,
             &nvars,
             varinf.data(),
             &nwork,
             work.data(),
             &niwork,
             iwork.data(),
             &ierr);
    if (ierr > 1) {
      std::fprintf(stderr, "%s\n", message(&idtyre));
      std::exit(2);
    }
    if (job != 0) return;
    print_bits(force);
    print_bits(torque);
    std::printf("\n");
  };
  call(dtyre, 1, 0.0);
  typarr.resize(static_cast<std::size_t>(ntypar));
  varinf.resize(static_cast<std::size_t>(nvars));
  call(dtyre, 2, 0.0);
  for (int i = 0; i <= steps; ++i) call(i % 2 ? same : dtyre, 0, step * i);
  call(dtyre, 99, step * steps);
  return 0;
}
