// SPDX-License-Identifier: MIT
// The front door of the dsPIC30F target: what twinpuck-cc needs of it.
//
// A module goes through the passes of compiler/front, then addPassesToEmitFile() of the machine made here:
// selection (lowering.cpp, selection.cpp), registers, frames (frames.cpp), words (encoder.cpp) or text
// (printer.cpp). Where an instruction lies is counted in octets, four a word; the linker halves them to
// the chip's addresses.
#pragma once
#include <functional>
#include <string>

#include "llvm/MC/TargetRegistry.h"
#include "llvm/Support/Alignment.h"

namespace llvm {

class Module;

/// Registers the target; again does nothing.
Target& dspic_target();

/// What LLVM must know of the chip's memory: 16-bit pointers, everything aligned to words, none to more.
inline constexpr const char* kDspicDataLayout = "e-p:16:16-i16:16-i32:16-i64:16-f32:16-f64:16-a:8-n16-S16";
inline constexpr const char* kDspicTriple = "dspic30f-microchip-none-elf";
inline constexpr const char* kDspicCpu = "30f6014a";

/// Stack alignment of an argument that is a struct of 4 or 8 bytes and yet no number: a mark,
/// nothing is aligned so.
inline constexpr Align kDspicOddStruct = Align::Constant<4>();
/// The same of a struct of chars, which may lie at an odd address.
inline constexpr Align kDspicOddBytes = Align::Constant<8>();

/// Operands of assembler text in C: XC16's letters of classes of registers (a W0, b W1, c W2, d W1 to W14,
/// e W2 to W14, t W7, u W4 to W6, v W13, x W8 and W9, y W10 and W11, z W4 to W7), and of ranges of numbers.
inline constexpr const char* kDspicRegisterLetters = "abcdetuvxyz";
inline constexpr const char* kDspicNumberLetters = "IJKLMNOPWYZ";

/// The vendor's own files, p30f6014A.inc and the like, whose names assembler text has in any case.
bool is_dspic_device_file(const std::string& name);

/// Asked before a file is read that assembler text names; by its path. Answers what is wrong with it, "" for
/// nothing. Of the process, which compiles one file.
void check_dspic_files(std::function<std::string(const std::string& file)> check);

/// Sections with attributes in their names, "mine, data, ymemory", become those of memory_spaces.h. What is
/// wrong with one, else "".
std::string name_dspic_sections(Module& module);

// parts that register themselves with the target
void register_dspic_mc(Target& target);
void register_dspic_printer(Target& target);
void register_dspic_parser(Target& target);

}  // namespace llvm
