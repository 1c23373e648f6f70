// SPDX-License-Identifier: MIT
// Codes for terminals that show colours; see webots/utils/ansi_codes.h.
#ifndef WB_UTILS_ANSICODES_HPP
#define WB_UTILS_ANSICODES_HPP

#include <webots/utils/ansi_codes.h>

#endif
