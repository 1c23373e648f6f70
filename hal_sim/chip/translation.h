// SPDX-License-Identifier: MIT
// The translator of hot code (dspic30/translate). Its library lies beside the program that runs, or a folder
// above; beside the library lies `translations/`, what earlier runs translated.
#pragma once
#include <filesystem>

#include "dspic30/core/cpu.h"

namespace chip {

/// Empty: it is not there.
std::filesystem::path translator_library();
/// For Processor::set_translator(); null with TWINPUCK_INTERPRET set. Without the library, nothing is
/// translated.
dspic::Translator* translation();

}  // namespace chip
