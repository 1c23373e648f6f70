// SPDX-License-Identifier: MIT
// One C file in, one LLVM module out, with the chip's types (16-bit int and pointers, 32-bit long,
// single-precision double) and with what old e-puck code expects of its compiler.
#pragma once
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "compiler/cache/readable_files.h"
#include "llvm/IR/LLVMContext.h"
#include "llvm/IR/Module.h"

namespace cc {

/// The command line of twinpuck-cc.
struct Options {
  std::string input, output;
  std::vector<std::string> passed_on;  // -I, -D, -U, -W..., -include
  std::vector<std::string> fallback;   // folders searched by trailing path components, in order
  std::string project;                 // the controller's own folder, absolute; empty: none
  ReadableFiles readable;
  std::string standard;  // of C, "gnu99"; empty: gnu89 as XC16, gnu99 where that fails
  std::string
      depfile;  // a rule with every file read; beside it .missing, names that were not there, a line each
  std::string facts;        // where what this file does with addresses is written (shared_variables.h)
  bool has_shared = false;  // `shared` says which loads are done where they stand
  std::vector<std::string> shared;  // nodes of shared_variables.h
  int level = 1;                    // 0, 1, 2
  bool for_size = false;
  bool sanitize = false, strict = false, lint = false, emit_ir = false;
  bool webots = false;     // written for Webots' interfaces, in C of today
  bool weak = false;       // a file of a copy of the library: of two definitions the first wins
  bool emit_text = false;  // assembler text
  bool library = false;    // part of the API or libc: definitions are weak, the program's own win
};

/// What the syntax tree says and the module no longer does.
struct Facts {
  std::map<std::string, unsigned> configuration;  // "fosc", "fwdt": words given by #pragma config
  std::vector<std::string> assembler_places;      // "main.c:12:9" of a number in !srcloc, from 1
  std::vector<std::pair<unsigned, std::string>>
      assembler_texts;  // of asm() outside functions: its first line in the module's text, its place
};

/// What XC16 v1.22 for this chip predefines.
inline constexpr const char* kVendorMacros[] = {"__dsPIC30F__=1",
                                                "__dsPIC30F6014A__=1",
                                                "dsPIC30F6014A=1",
                                                "dsPIC30=1",
                                                "__dsPIC30=1",
                                                "__dsPIC30__=1",
                                                "__C30__=1",
                                                "__C30=1",
                                                "C30=1",
                                                "__XC16__=1",
                                                "__XC16=1",
                                                "XC16=1",
                                                "__XC__=1",
                                                "__XC16_VERSION__=1022",
                                                "__C30_VERSION__=1022",
                                                "__C30ELF=1",
                                                "__C30ELF__=1",
                                                "__HAS_DSP__=1",
                                                "__TWINPUCK__=1"};

/// Null after errors (already printed).
std::unique_ptr<llvm::Module> compile_to_module(const Options& options, llvm::LLVMContext& context,
                                                Facts& facts);

}  // namespace cc
