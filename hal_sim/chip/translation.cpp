// SPDX-License-Identifier: MIT
#include "hal_sim/chip/translation.h"

#include <cstdlib>

#include "dspic30/translate/translations.h"
#include "install/cache_bound.h"
#include "install/places.h"

namespace chip {

namespace fs = std::filesystem;

fs::path translator_library() { return places::tools_folder() / "twinpuck-translate.so"; }

dspic::Translator* translation() {
  static const fs::path library = translator_library();
  static dspic::translate::Translations translations(library, places::cache_folder("translations"),
                                                     places::keep_caches_within_bound);
  return std::getenv("TWINPUCK_INTERPRET") ? nullptr : &translations;
}

}  // namespace chip
