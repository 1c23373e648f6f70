// SPDX-License-Identifier: MIT
// Settings of the PC's C++ library, of which firmware uses the headers alone: templates are made where they
// are used, and there are neither threads nor wide characters.
#pragma once
#include_next <bits/c++config.h>
#undef _GLIBCXX_EXTERN_TEMPLATE
#define _GLIBCXX_EXTERN_TEMPLATE 0
#undef _GLIBCXX_HAS_GTHREADS
#undef _GLIBCXX_USE_WCHAR_T
#undef _GLIBCXX_USE_C99_WCHAR
#undef _GLIBCXX11_USE_C99_WCHAR
#undef _GLIBCXX98_USE_C99_WCHAR
#undef _GLIBCXX_USE_DECIMAL_FLOAT
#undef _GLIBCXX_USE_FLOAT128
#undef _GLIBCXX_USE_DEV_RANDOM
