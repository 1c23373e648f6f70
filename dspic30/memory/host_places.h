// SPDX-License-Identifier: MIT
// Program addresses beyond the flash at which the simulator stands in for code, as in semihosting. A program
// reaches them through the linker's handles (a GOTO each), so its own code is as it is on the chip.
//
//   kHostStart + 2 i    function i of whoever plays the library (core/host_calls.h)
//   kHostHandlerReturn  where what a handler known by heart has called returns to
#pragma once

namespace dspic {

inline constexpr unsigned kHostStart = 0x400000;
inline constexpr unsigned kMostHostFunctions = 256;
inline constexpr unsigned kHostHandlerReturn = kHostStart + 2 * kMostHostFunctions;
inline constexpr unsigned kHostEnd = kHostHandlerReturn + 2;

/// Of a program that uses malloc(), and of the agendas' nodes, whoever plays them.
inline constexpr unsigned kHeapBytes = 512;

inline constexpr bool is_host_place(unsigned address) { return address >= kHostStart && address < kHostEnd; }

/// An absolute symbol of an image that is linked with functions of the host: the RAM address at which plain
/// RAM begins. From RAM's start to there the library's registers lie, and the host serves them.
inline constexpr const char* kServedEndSymbol = "_tp_served_end";
/// Of every image that is linked here for drivers that the host can fill: 1 where it does, else 0.
inline constexpr const char* kHalSymbol = "_tp_hal";
/// Another one: a sum over the table of the host's functions that the image was linked for.
inline constexpr const char* kHostTableSymbol = "_tp_host_table";
/// Another one: the level that the library was compiled at: 0 to 2 of -O0 to -O2, 3 of -Os.
inline constexpr const char* kLibraryLevelSymbol = "_tp_library_level";
/// Another one, of an image whose RAM is to be looked after: where its stack begins.
inline constexpr const char* kCheckedSymbol = "_tp_checked";
inline constexpr const char* kCheckedHeapSymbol = "_tp_checked_heap";  ///< where its heap begins
inline constexpr const char* kCheckedHeapEndSymbol = "_tp_checked_heap_end";
/// A function that such an image calls, only to be heard: a local variable comes into being (its address, its
/// bytes, its name), with kLocalGap bytes on both sides that are nobody's. What else it calls so begins with
/// kCheckedPrefix: one of clang's checks has failed.
inline constexpr const char* kLocalFunction = "tp_checked_local";
inline constexpr const char* kCheckedPrefix = "tp_checked_";
inline constexpr unsigned kLocalGap = 4;

/// Stands where the compiler has concluded that no course can come: an illegal opcode.
inline constexpr unsigned kUndefinedWord = 0x0A0000;

}  // namespace dspic
