// SPDX-License-Identifier: MIT
#include "hal_sim/chip/translation.h"

#include <cstdlib>

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
  static const fs::path library = translator_library();
  static dspic::translate::Translations translations(library, library.parent_path() / "translations");
  return std::getenv("TWINPUCK_INTERPRET") ? nullptr : &translations;
}

}  // namespace chip
