// SPDX-License-Identifier: Apache-2.0
// The licenses of the code inside the libraries of apps/exchange, as the package of a unit carries
// them. The library with all models contains parts of the same programs; the shared libraries that
// it needs are not in the package.
#pragma once

namespace latsch::exchange {

/// Text of documentation/licenses/licenses.txt.
inline constexpr const char* kLicensesOfLibraries =
    R"(The libraries in `binaries` are made of Latsch and of parts of the following programs.

Latsch           Apache License 2.0, https://www.apache.org/licenses/LICENSE-2.0
Eigen            Mozilla Public License 2.0, https://www.mozilla.org/MPL/2.0/
                 unchanged; source: https://gitlab.com/libeigen/eigen
libstdc++,       GNU General Public License 3 with the GCC Runtime Library Exception 3.1, which
libgcc           allows to pass on programs that contain them under terms of one's choice:
                 https://www.gnu.org/licenses/gcc-exception-3.1.html
fmt              Copyright 2012 - present, Victor Zverovich; MIT License with the exception that
                 its object code may be passed on without this notice
toml++           Copyright 2020-2022 Mark Gillard; its decoder of UTF-8 Copyright 2008-2009
                 Bjoern Hoehrmann; MIT License:

Permission is hereby granted, free of charge, to any person obtaining a copy of this software and
associated documentation files (the "Software"), to deal in the Software without restriction,
including without limitation the rights to use, copy, modify, merge, publish, distribute,
sublicense, and/or sell copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in all copies or substantial
portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT
NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND
NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES
OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN
CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
)";

}  // namespace latsch::exchange
