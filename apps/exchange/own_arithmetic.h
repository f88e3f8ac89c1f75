// SPDX-License-Identifier: Apache-2.0
// Settings of the processor's arithmetic during a call. A program that loads a unit may have
// another rounding, numbers flushed to zero or traps; a unit computes with the settings of the C
// standard and then restores those of the program.
#pragma once

#include <cfenv>

namespace latsch::exchange {

class OwnArithmetic {
 public:
  OwnArithmetic() {
    std::fegetenv(&host_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~OwnArithmetic() { std::fesetenv(&host_); }
  OwnArithmetic(const OwnArithmetic&) = delete;
  OwnArithmetic& operator=(const OwnArithmetic&) = delete;

 private:
  std::fenv_t host_;
};

}  // namespace latsch::exchange
