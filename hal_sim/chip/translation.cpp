// SPDX-License-Identifier: MIT
#include "hal_sim/chip/translation.h"

#include <cstdlib>
#include <filesystem>

#include "dspic30/translate/translations.h"

namespace chip {

namespace fs = std::filesystem;

fs::path translator_library() {
  std::error_code none;
  const fs::path here = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const fs::path& folder : {here, here.parent_path()})
    if (const fs::path library = folder / "twinpuck-translate.so"; fs::exists(library, none)) return library;
  return {};
}

dspic::Translator* translation() {
  const auto make = [] {
    const fs::path library = translator_library();
    return new dspic::translate::Translations(library, library.parent_path() / "translations");
  };
  if (std::getenv("TWINPUCK_INTERPRET")) return nullptr;
  static dspic::Translator* const translator = make();
  return translator;
}

}  // namespace chip
