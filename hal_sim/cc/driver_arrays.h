// SPDX-License-Identifier: MIT
// Variables of the ADC driver, brought up to date before a controller looks at them.
#pragma once
#include "passes.h"

namespace cc {

/// Inserts the calls where they are missing; a stage of pipeline.cpp: before anything is optimised, so that
/// no value is carried over an interrupt, and again when pointers in local variables have become visible.
void refresh_driver_arrays(Unit& unit);

/// Functions that it calls begin with this: they cost nothing and may stand in a polling loop.
inline constexpr const char* kRefresher = "tp_image_see_";

}  // namespace cc
