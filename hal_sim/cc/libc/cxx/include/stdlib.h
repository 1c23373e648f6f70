/* SPDX-License-Identifier: MIT
 * In C++ abs() knows every type, with or without std. */
#pragma once
#include <cstdlib>
using std::abs;
