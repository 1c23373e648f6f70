// SPDX-License-Identifier: MIT
#include "hal_sim/chip/translation.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>

namespace chip {

namespace {

dspic::Translator* load() {
  if (std::getenv("TWINPUCK_INTERPRET")) return nullptr;
  std::error_code none;
  const auto here = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
  for (const auto& folder : {here, here.parent_path()})
    if (void* const library = dlopen((folder / "twinpuck-translate.so").c_str(), RTLD_NOW | RTLD_LOCAL))
      if (void* const entry = dlsym(library, "dspic_translator"))
        return reinterpret_cast<dspic::Translator* (*)()>(entry)();
  return nullptr;
}

struct WhenHot final : dspic::Translator {
  dspic::Translation translate(const dspic::Cpu& cpu, const dspic::Decoded* head) override {
    static dspic::Translator* const translator = load();
    return translator ? translator->translate(cpu, head) : dspic::Translation{};
  }
};

}  // namespace

dspic::Translator& translation() {
  static WhenHot translator;
  return translator;
}

}  // namespace chip
