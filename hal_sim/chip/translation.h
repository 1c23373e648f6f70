// SPDX-License-Identifier: MIT
// The translator of hot code (dspic30/translate). Its library is one of the product's tools; what earlier
// runs translated lies in the user's cache.
#pragma once
#include <filesystem>

#include "dspic30/core/cpu.h"

namespace chip {

/// It may not be there.
std::filesystem::path translator_library();
/// For Processor::set_translator(); null with TWINPUCK_INTERPRET set. Without the library,
/// nothing is translated.
dspic::Translator* translation();

}  // namespace chip
