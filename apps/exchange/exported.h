// SPDX-License-Identifier: Apache-2.0
// The attribute of functions that a library exports. On Linux exported.map lists them as well,
// because the C++ library inside a slim library must not be exported.
#pragma once

#ifdef _WIN32
#define LATSCH_EXPORTED [[gnu::dllexport]]
#else
#define LATSCH_EXPORTED [[gnu::visibility("default")]]
#endif
