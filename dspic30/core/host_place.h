// SPDX-License-Identifier: MIT
// Where the host stands in for code: instructions of their own at addresses beyond the flash.
#pragma once
#include <array>
#include <cstdint>

#include "dspic30/core/decoded.h"
#include "dspic30/memory/host_places.h"

namespace dspic {

inline constexpr unsigned kHostPlaces = (kHostEnd - kHostStart) / 2;
/// Where the host stands in for code, one a place (host_places.h), for all robots.
extern const std::array<Decoded, kHostPlaces> host_places;
/// `address`: is_host_place().
inline const Decoded* host_place(unsigned address) { return &host_places[(address - kHostStart) / 2]; }
/// The address of such a place; 0: it is none.
inline unsigned address_of_host_place(const Decoded* d) {
  const auto bytes =
      reinterpret_cast<std::uintptr_t>(d) - reinterpret_cast<std::uintptr_t>(host_places.data());
  return bytes < sizeof host_places ? kHostStart + 2 * static_cast<unsigned>(bytes / sizeof(Decoded)) : 0;
}

}  // namespace dspic
