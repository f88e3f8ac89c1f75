// SPDX-License-Identifier: Apache-2.0
// Parts of the slim libraries (latsch_fmi2, latsch_fmi3, latsch_sti) that the program takes from
// shared libraries of the machine. A slim library needs libc, libm and libpthread alone, so that it
// runs on a machine where nothing of Latsch is installed. It consists of the program's own objects
// and
//
//   si_units.cpp       units of SI in the place of base/units.cpp, which needs UDUNITS
//   inner_fmt.cpp      fmt and toml++, compiled into the library from their headers
//   inner_toml.cpp
//   slim_models.cpp    the models that need neither METIS nor BLAS
//   plain_files.cpp    on Windows alone: files in the place of base/file.cpp and mapped_file.cpp,
//                      which are written for POSIX
#pragma once
