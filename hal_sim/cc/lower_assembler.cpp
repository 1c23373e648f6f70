// SPDX-License-Identifier: MIT
// Inline assembler by its text. Understood are the instructions without operands that matter to a robot, and
// those that change one variable or register in place, as drivers of the library have them:
//
//   nop  reset  clrwdt  pwrsav #0|#1  disi #n  repeat #n (before a nop)
//   clr|setm|inc|inc2|dec|dec2|com|neg[.b] _name[+1]     bset|bclr|btg[.b] _name[+1], #bit
//   mov[.b] #number|#REGISTER|Wn|_name|[Wn], Wn|_name|[Wn]     bset|bclr|btg[.b] [Wn], #bit     push|pop Wn
//
// which is what the sequences that unlock OSCCON and NVMCON are made of. W0 to W14 are variables of the
// function; [Wn] reaches registers only. A name is a variable of the program or a register. Anything else is
// an error with its line.

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InlineAsm.h"
#include "llvm/IR/InstIterator.h"
#include "passes.h"
#include "sim_core/base/pattern.h"

namespace cc {
namespace {

using namespace llvm;

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

/// Address of a register of the header by its name in assembler, or -1; OSCCON's halves have names of their
/// own.
int register_number(Unit& unit, StringRef name) {
  name.consume_front("_");
  const bool is_high = name == "OSCCONH";
  if (is_high || name == "OSCCONL") name = name.drop_back();
  for (const auto& [label, c_name] : unit.facts.register_names) {
    StringRef known = c_name, number = label;
    known.consume_back("bits");
    unsigned address;
    if (known == name && number.consume_front("tp_sfr_") && !number.getAsInteger(16, address))
      return int(address) + is_high;
  }
  return -1;
}

/// W0 to W14 as variables of one function, and what push has saved, which pop takes back in the order of the
/// text.
struct Registers {
  Function* function = nullptr;
  AllocaInst* variables[15] = {};
  std::vector<Value*> pushed;

  AllocaInst* operator[](unsigned number) {
    if (!variables[number]) {
      IRBuilder<> entry(&function->getEntryBlock(), function->getEntryBlock().begin());
      variables[number] = entry.CreateAlloca(entry.getInt16Ty());
    }
    return variables[number];
  }
};

/// One side of a mov: a working register, what it points to, a register or a variable by name, a number.
struct Operand {
  enum Kind { Working, Pointed, Named, Number, None } kind = None;
  unsigned number = 0;
  std::string name;
};

Operand operand_of(Unit& unit, StringRef text) {
  static const sim::Pattern kWorking(R"(w(1[0-4]|[0-9]))", std::regex::icase);
  static const sim::Pattern kName(R"([A-Za-z_]\w*)");
  text = text.trim();
  Operand operand;
  std::smatch match;
  const bool is_pointed = text.startswith("[") && text.endswith("]");
  const std::string bare = (is_pointed ? text.drop_front().drop_back().trim() : text).str();
  if (std::regex_match(bare, match, kWorking)) {
    operand.kind = is_pointed ? Operand::Pointed : Operand::Working;
    operand.number = unsigned(std::stoul(match[1].str()));
  } else if (text.consume_front("#")) {
    const int address = register_number(unit, text.trim());
    if (address >= 0) operand.number = unsigned(address);
    if (address >= 0 || !text.trim().getAsInteger(0, operand.number)) operand.kind = Operand::Number;
  } else if (text.equals_insensitive("wreg")) {
    operand.kind = Operand::Working;
  } else if (std::regex_match(bare, kName) && !is_pointed) {
    operand.kind = Operand::Named;
    operand.name = bare;
  }
  return operand;
}

/// mov, push and pop, and bits of what a working register points to.
bool lower_move(Unit& unit, IRBuilder<>& b, StringRef text, Registers& w_registers) {
  std::vector<Value*>& pushed = w_registers.pushed;
  Type *i64 = b.getInt64Ty(), *i16 = b.getInt16Ty();
  const std::size_t end = text.find_first_of(" \t");
  if (end == StringRef::npos) return false;
  const std::string operation = text.take_front(end).lower();
  const StringRef rest = text.drop_front(end).trim();
  if (operation == "push" || operation == "pop") {
    const Operand w = operand_of(unit, rest);
    if (w.kind != Operand::Working || (operation == "pop" && pushed.empty())) return false;
    if (operation == "push") {
      pushed.push_back(b.CreateLoad(i16, w_registers[w.number]));
    } else {
      b.CreateStore(pushed.back(), w_registers[w.number]);
      pushed.pop_back();
    }
    return true;
  }
  const auto [first, second] = rest.split(',');
  const auto word_at = [&](const Operand& w) {
    return b.CreateZExt(b.CreateLoad(i16, w_registers[w.number]), i64);
  };
  auto read = host_function(unit.module, "tp_sfr_read", i64, {i64, i64});
  auto write = host_function(unit.module, "tp_sfr_write", b.getVoidTy(), {i64, i64, i64});
  if (const StringRef plain = StringRef(operation).split('.').first;
      plain == "bset" || plain == "bclr" || plain == "btg") {
    const Operand at = operand_of(unit, first), bit = operand_of(unit, second);
    Value* bits = b.getInt64(StringRef(operation).endswith(".b") ? 8 : 16);
    if (at.kind != Operand::Pointed || bit.kind != Operand::Number || bit.number > 15) return false;
    Value* old = b.CreateCall(read, {word_at(at), bits});
    Value* mask = b.getInt64(std::uint64_t{1} << bit.number);
    Value* changed = plain == "bset"   ? b.CreateOr(old, mask)
                     : plain == "bclr" ? b.CreateAnd(old, b.CreateNot(mask))
                                       : b.CreateXor(old, mask);
    b.CreateCall(write, {word_at(at), changed, bits});
    return true;
  }
  const bool is_byte = operation == "mov.b";
  if (!is_byte && operation != "mov" && operation != "mov.w") return false;
  const Operand from = operand_of(unit, first), to = operand_of(unit, second);
  if (from.kind == Operand::None || to.kind == Operand::None || to.kind == Operand::Number) return false;
  GlobalVariable *source = nullptr, *target = nullptr;
  if (from.kind == Operand::Named && !(source = named(unit, from.name))) return false;
  if (to.kind == Operand::Named && !(target = named(unit, to.name))) return false;
  Type* type = is_byte ? b.getInt8Ty() : i16;
  const auto access = [&](GlobalVariable* g) { return b.CreateBitCast(g, type->getPointerTo()); };
  Value* bits = b.getInt64(is_byte ? 8 : 16);
  Value* value = nullptr;
  if (from.kind == Operand::Number)
    value = ConstantInt::get(type, from.number);
  else if (from.kind == Operand::Working)
    value = b.CreateTrunc(b.CreateLoad(i16, w_registers[from.number]), type);
  else if (from.kind == Operand::Named)
    value = b.CreateAlignedLoad(type, access(source), Align(1), /*volatile*/ true);
  else
    value = b.CreateTrunc(b.CreateCall(read, {word_at(from), bits}), type);
  if (to.kind == Operand::Named) {
    b.CreateAlignedStore(value, access(target), Align(1), /*volatile*/ true);
  } else if (to.kind == Operand::Pointed) {
    b.CreateCall(write, {word_at(to), b.CreateZExt(value, i64), bits});
  } else {
    auto* w = w_registers[to.number];
    Value* whole = b.CreateZExt(value, i16);
    // a byte leaves the upper half as it is
    if (is_byte) whole = b.CreateOr(b.CreateAnd(b.CreateLoad(i16, w), b.getInt16(0xFF00)), whole);
    b.CreateStore(whole, w);
  }
  return true;
}

/// Loads, changes and stores one byte or word.
bool lower_in_place(Unit& unit, IRBuilder<>& b, const std::string& text) {
  static const sim::Pattern kForm(
      R"((clr|setm|inc|inc2|dec|dec2|com|neg|bset|bclr|btg)(\.b|\.w)?\s+([a-z_]\w*)\s*(?:\+\s*(\d+))?\s*(?:,\s*#\s*(0x[0-9a-f]+|\d+|[a-z]+))?)",
      std::regex::icase);
  std::smatch match;
  if (!std::regex_match(text, match, kForm)) return false;
  const std::string operation = StringRef(match[1].str()).lower();
  const bool of_bit = operation[0] == 'b';
  if (of_bit != match[5].matched) return false;
  unsigned offset = match[4].matched ? unsigned(std::stoul(match[4].str())) : 0;
  unsigned bit = 0;
  if (of_bit && StringRef(match[5].str()).getAsInteger(0, bit)) {
    // names of the bits that such sequences end with
    bit = StringSwitch<unsigned>(StringRef(match[5].str()).upper())
              .Case("WR", 15)
              .Case("WREN", 14)
              .Case("OSWEN", 0)
              .Case("LPOSCEN", 1)
              .Default(16);
  }
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
bool lower_statement(Unit& unit, IRBuilder<>& b, StringRef text, Registers& w_registers) {
  Module& m = unit.module;
  Type* i64 = b.getInt64Ty();
  Type* none = b.getVoidTy();
  std::string lower = text.lower();
  std::smatch match;
  static const sim::Pattern kDisi(R"(disi\s+#\s*(0x[0-9a-f]+|[0-9]+))");
  static const sim::Pattern kRepeat(R"(repeat\s+#\s*(0x[0-9a-f]+|[0-9]+))");
  static const sim::Pattern kBreak(R"(\.pword\s+0xda4000)");  // of a debugger; nothing without one
  static const sim::Pattern kPwrsav(R"(pwrsav\s+#\s*(0|1|0x0|0x1|sleep_mode|idle_mode))");
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
    return lower_in_place(unit, b, text.str()) || lower_move(unit, b, text, w_registers);
  }
  return true;
}

void refuse(Unit& unit, CallBase* call, StringRef line) {
  const std::string got = ("inline assembler: got \"" + line + "\"").str();
  const char* const expected =
      ", expected nop, reset, clrwdt, pwrsav #0, pwrsav #1, disi #n, repeat #n, one of clr, setm, inc, dec, "
      "com, "
      "neg, bset, bclr, btg on a variable, mov, push or pop; ";
  unit.error(call->getDebugLoc(), got + expected + "write it in C, or run the program with --hal sim");
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
  Registers w_registers;
  for (CallBase* call : all) {
    if (w_registers.function != call->getFunction()) {
      w_registers = Registers();
      w_registers.function = call->getFunction();
    }
    std::string text = cast<InlineAsm>(call->getCalledOperand())->getAsmString();
    IRBuilder<> b(call);
    SmallVector<StringRef, 4> lines;
    SplitString(text, lines, "\n");
    for (StringRef line : lines) {
      line = line.split(';').first.trim();  // what follows is a comment
      if (line.empty()) continue;
      if (refused == call->getFunction() || lower_statement(unit, b, line, w_registers)) continue;
      refuse(unit, call, line);
      if (!unit.failed) refused = call->getFunction();
    }
    if (!call->getType()->isVoidTy()) call->replaceAllUsesWith(UndefValue::get(call->getType()));
    call->eraseFromParent();
  }
}

}  // namespace cc
