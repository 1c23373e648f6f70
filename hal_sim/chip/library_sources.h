// SPDX-License-Identifier: MIT
// The library behind every program was compiled with the product, and lies where the product lies now.
#pragma once
#include "dspic30/load/firmware_file.h"
#include "install/places.h"

namespace chip {

/// For dspic::load_firmware(): a file whose lines will name the library's sources where they are here.
inline dspic::FirmwareFile firmware_file() {
  dspic::FirmwareFile file;
  file.code.moved_from = places::kUsualShare;
  file.code.moved_to = places::product_share().string();
  return file;
}

}  // namespace chip
