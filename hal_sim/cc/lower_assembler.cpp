// SPDX-License-Identifier: MIT
// Inline assembler by its text. Understood are the instructions without operands that matter to a robot, and
// those that change one variable or register in place, as drivers of the library have them:
//
//   nop  reset  clrwdt  pwrsav #0|#1  disi #n  repeat #n (before a nop)
//   clr|setm|inc|inc2|dec|dec2|com|neg[.b] _name[+1]     bset|bclr|btg[.b] _name[+1], #bit
//
// A name is a variable of the program or a register. Anything else is an error with its line; in the register
// way, when it stands in an interrupt handler, a warning, and the robot stops with that message if the
// handler ever runs: programs carry drivers of devices that they never switch on.
#include <regex>

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InlineAsm.h"
#include "llvm/IR/InstIterator.h"
#include "passes.h"

namespace cc {
namespace {

using namespace llvm;

constexpr long long kTrapUnsimulated = 8;  // TP_TRAP_UNSIMULATED of image_abi.h

/// The variable or register that an assembler name means: "_LATA", "_IFS0bits", "_e_stop_flag". Registers are
/// those of the header; a variable that the file does not know is somebody else's, of 16 bits.
GlobalVariable* named(Unit& unit, StringRef name) {
  Module& m = unit.module;
  // registers go by their names with and without the underscore of C
  const bool is_of_c = name.consume_front("_");
  Type* word = Type::getInt16Ty(m.getContext());
  const auto external = [&](const std::string& label) {
    if (auto* g = m.getNamedGlobal(label)) return g;
    auto* g = new GlobalVariable(m, word, false, GlobalValue::ExternalLinkage, nullptr, label);
    g->setAlignment(Align(2));
    return g;
  };
  StringRef plain = name;
  plain.consume_back("bits");
  for (const auto& [label, c_name] : unit.facts.register_names) {
    StringRef known = c_name;
    known.consume_back("bits");
    if (known == plain) return external("\1" + label);
  }
  if (!is_of_c || m.getFunction(name)) return nullptr;
  return external(name.str());
}

/// Loads, changes and stores one byte or word.
bool lower_in_place(Unit& unit, IRBuilder<>& b, const std::string& text) {
  static const std::regex kForm(
      R"((clr|setm|inc|inc2|dec|dec2|com|neg|bset|bclr|btg)(\.b|\.w)?\s+([a-z_]\w*)\s*(?:\+\s*(\d+))?\s*(?:,\s*#\s*(0x[0-9a-f]+|\d+))?)",
      std::regex::icase);
  std::smatch match;
  if (!std::regex_match(text, match, kForm)) return false;
  const std::string operation = StringRef(match[1].str()).lower();
  const bool of_bit = operation[0] == 'b';
  if (of_bit != match[5].matched) return false;
  unsigned offset = match[4].matched ? unsigned(std::stoul(match[4].str())) : 0;
  unsigned bit = of_bit ? unsigned(std::stoul(match[5].str(), nullptr, 0)) : 0;
  bool is_byte = StringRef(match[2].str()).lower() == ".b";
  if (bit >= (is_byte ? 8u : 16u)) return false;
  GlobalVariable* g = named(unit, match[3].str());
  if (!g) return false;
  Type* type = is_byte ? b.getInt8Ty() : b.getInt16Ty();
  Value* at = b.CreateBitCast(g, b.getInt8PtrTy());
  if (offset) at = b.CreateConstGEP1_32(b.getInt8Ty(), at, offset);
  at = b.CreateBitCast(at, type->getPointerTo());
  const auto constant = [&](std::uint64_t value) { return ConstantInt::get(type, value); };
  const auto store = [&](Value* value) { b.CreateAlignedStore(value, at, Align(1), /*volatile*/ true); };
  if (operation == "clr") return store(constant(0)), true;
  if (operation == "setm") return store(Constant::getAllOnesValue(type)), true;
  Value* old = b.CreateAlignedLoad(type, at, Align(1), /*volatile*/ true);
  Value* mask = constant(std::uint64_t{1} << bit);
  store(StringSwitch<std::function<Value*()>>(operation)
            .Case("inc", [&] { return b.CreateAdd(old, constant(1)); })
            .Case("inc2", [&] { return b.CreateAdd(old, constant(2)); })
            .Case("dec", [&] { return b.CreateSub(old, constant(1)); })
            .Case("dec2", [&] { return b.CreateSub(old, constant(2)); })
            .Case("com", [&] { return b.CreateNot(old); })
            .Case("neg", [&] { return b.CreateNeg(old); })
            .Case("bset", [&] { return b.CreateOr(old, mask); })
            .Case("bclr", [&] { return b.CreateAnd(old, b.CreateNot(mask)); })
            .Default([&] { return b.CreateXor(old, mask); })());
  return true;
}

/// One statement. False when it is not one of those that are understood.
bool lower_statement(Unit& unit, IRBuilder<>& b, StringRef text) {
  Module& m = unit.module;
  Type* i64 = b.getInt64Ty();
  Type* none = b.getVoidTy();
  std::string lower = text.lower();
  std::smatch match;
  static const std::regex kDisi(R"(disi\s+#\s*(0x[0-9a-f]+|[0-9]+))");
  static const std::regex kRepeat(R"(repeat\s+#\s*(0x[0-9a-f]+|[0-9]+))");
  static const std::regex kBreak(R"(\.pword\s+0xda4000)");  // of a debugger; nothing without one
  static const std::regex kPwrsav(R"(pwrsav\s+#\s*(0|1|0x0|0x1|sleep_mode|idle_mode))");
  if (lower == "nop" || std::regex_match(lower, kBreak)) {
    b.CreateCall(marker(m, kNop));
  } else if (lower == "reset") {
    b.CreateCall(host_function(m, "tp_reset", none, {}));
  } else if (lower == "clrwdt") {
    b.CreateCall(host_function(m, "tp_clear_watchdog", none, {}));
  } else if (std::regex_match(lower, match, kPwrsav)) {
    bool idle = match[1] == "1" || match[1] == "0x1" || match[1] == "idle_mode";
    b.CreateCall(host_function(m, "tp_power_save", none, {i64}), {b.getInt64(idle)});
  } else if (std::regex_match(lower, match, kDisi)) {
    b.CreateCall(host_function(m, "tp_disi", none, {i64}),
                 {b.getInt64(std::stoll(match[1].str(), nullptr, 0))});
  } else if (std::regex_match(lower, match, kRepeat)) {
    // itself a cycle, then the next instruction n times more than once
    b.CreateCall(host_function(m, "tp_delay", none, {i64, i64}),
                 {b.getInt64(std::stoll(match[1].str(), nullptr, 0) + 1), b.getInt64(1)});
  } else {
    return lower_in_place(unit, b, text.str());
  }
  return true;
}

/// Handlers are functions with the names of vectors.
bool is_handler(const Function& f) {
  StringRef name = f.getName();
  return name.startswith("_") &&
         (name.endswith("Interrupt") || name.endswith("Error") || name.endswith("Fail"));
}

void refuse(Unit& unit, IRBuilder<>& b, CallBase* call, StringRef line) {
  const std::string got = ("inline assembler: got \"" + line + "\"").str();
  const char* const expected =
      ", expected nop, reset, clrwdt, pwrsav #0, pwrsav #1, disi #n, repeat #n, or one of clr, setm, inc, "
      "dec, "
      "com, neg, bset, bclr, btg on a variable; ";
  const Function& f = *call->getFunction();
  if (!unit.options.register_way || !is_handler(f)) {
    unit.error(call->getDebugLoc(), got + expected + "write it in C, or run the program the chip way");
    return;
  }
  unit.warning(call->getDebugLoc(), got + expected + "the robot stops when " + f.getName() + " runs");
  const std::string told = got + " in " + f.getName().str() + ": not modelled; write the handler in C";
  b.CreateCall(
      host_function(unit.module, "tp_trap_message", b.getVoidTy(), {b.getInt64Ty(), b.getInt8PtrTy()}),
      {b.getInt64(kTrapUnsimulated), b.CreateGlobalStringPtr(told)});
}

}  // namespace

void lower_assembler(Unit& unit) {
  Module& m = unit.module;
  if (!StringRef(m.getModuleInlineAsm()).trim().empty()) {
    unit.error(DebugLoc(), Twine(m.getSourceFileName()) + ": assembler outside functions: got \"" +
                               StringRef(m.getModuleInlineAsm()).trim() + "\"; native firmware is C only");
  }
  std::vector<CallBase*> all;
  for (Function& f : m)
    for (Instruction& i : instructions(f))
      if (auto* call = dyn_cast<CallBase>(&i))
        if (call->isInlineAsm()) all.push_back(call);
  const Function* refused = nullptr;  // told once per function
  for (CallBase* call : all) {
    std::string text = cast<InlineAsm>(call->getCalledOperand())->getAsmString();
    IRBuilder<> b(call);
    SmallVector<StringRef, 4> lines;
    SplitString(text, lines, "\n");
    for (StringRef line : lines) {
      line = line.split(';').first.trim();  // what follows is a comment
      if (line.empty()) continue;
      if (refused == call->getFunction() || lower_statement(unit, b, line)) continue;
      refuse(unit, b, call, line);
      if (!unit.failed) refused = call->getFunction();
    }
    if (!call->getType()->isVoidTy()) call->replaceAllUsesWith(UndefValue::get(call->getType()));
    call->eraseFromParent();
  }
}

}  // namespace cc
