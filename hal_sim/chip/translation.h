// SPDX-License-Identifier: MIT
// The translator of hot code (dspic30/translate), which lies beside the program that runs, or a folder above,
// and is loaded when code is hot.
#pragma once
#include "dspic30/core/cpu.h"

namespace chip {

/// For Processor::set_translator(). Without the file, or with TWINPUCK_INTERPRET set, nothing is translated.
dspic::Translator& translation();

}  // namespace chip
