// SPDX-License-Identifier: MIT
#pragma once
#include "hal_sim/board/memory_end.h"

namespace firmware_test {

using board::Cycle;

class MemoryEnd : public board::MemoryEnd {};

}  // namespace firmware_test
