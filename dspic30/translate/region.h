// SPDX-License-Identifier: MIT
// A stretch of the program as one function of LLVM's.
//
//   words that follow one another --their instructions' functions, inlined one by one--> one function
//
// Within it, W registers, flags and the clock are the function's own; they are put back into the Cpu where
// something else may look: at its end, and around calls to what is not inlined (registers of peripherals, the
// PSV window, traps). Time is checked where it begins, at each jump back, and after such a call: unless the
// whole stretch fits before Cpu::deadline, it ends, and the interpreter goes on instruction by instruction.
// So an instruction boundary at which the interpreter would stop is never passed.
#pragma once
#include <llvm/IR/Module.h>

#include <map>
#include <memory>
#include <string>

#include "dspic30/translate/stretch.h"

namespace dspic::translate {

/// The instructions' functions, as bitcode.
struct Semantics {
  explicit Semantics(std::unique_ptr<llvm::Module> bitcode);
  /// Function of a word; null: none that can be inlined.
  llvm::Function* of(std::uint32_t word);

  std::unique_ptr<llvm::Module> module;
  std::map<std::uint32_t, llvm::Function*> found;
};

/// Its function, in a module of its own; null: something in it cannot be translated.
std::unique_ptr<llvm::Module> translate(Semantics& semantics, const Cpu& cpu, const std::vector<Item>& items,
                                        const std::string& name);

}  // namespace dspic::translate
