// SPDX-License-Identifier: Apache-2.0
// Numbers with a decimal point, whatever locale the program that contains Latsch has set. Functions
// of C read and write numbers by the locale: with a German one they read "0.0254" as 0.
#pragma once

#include <clocale>

namespace latsch {

#ifndef _WIN32
/// Sets the locale "C" for this thread while it lives.
class CLocale {
 public:
  CLocale() : before_(uselocale(instance())) {}
  ~CLocale() { uselocale(before_); }
  CLocale(const CLocale&) = delete;
  CLocale& operator=(const CLocale&) = delete;

 private:
  static locale_t instance() {
    // never freed; it lives as long as the program
    static const locale_t c = newlocale(LC_ALL_MASK, "C", nullptr);
    return c;
  }

  locale_t before_;
};
#else
class CLocale {};  // units on Windows neither read units nor write inputs of programs
#endif

}  // namespace latsch
