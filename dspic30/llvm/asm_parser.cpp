// SPDX-License-Identifier: MIT
// Assembler text, inline and in .s files. LLVM reads labels, directives and macros; an instruction's text
// goes to the chip's own assembler (dspic30/asm), which knows every form from the instruction table, and
// comes back as words. Operands with symbols are left to the linker, by the kind of field they stand in.
#include <functional>
#include <map>

#include "dspic30/asm/device_names.h"
#include "dspic30/asm/expression.h"
#include "dspic30/asm/instruction_text.h"
#include "dspic30/llvm/asm_directives.h"
#include "dspic30/llvm/fixups.h"
#include "dspic30/llvm/tables.h"
#include "dspic30/llvm/target.h"
#include "llvm/ADT/StringSwitch.h"
#include "llvm/MC/MCContext.h"
#include "llvm/MC/MCExpr.h"
#include "llvm/MC/MCInst.h"
#include "llvm/MC/MCInstBuilder.h"
#include "llvm/MC/MCParser/MCAsmParser.h"
#include "llvm/MC/MCParser/MCParsedAsmOperand.h"
#include "llvm/MC/MCParser/MCTargetAsmParser.h"
#include "llvm/MC/MCStreamer.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/SourceMgr.h"

namespace llvm {

namespace {

namespace assembly = dspic::assembly;

/// How the linker fills an operand of this kind with a symbol's address; 0 when it cannot.
unsigned fixup_of(dspic::Operand kind, const dspic::Row& row) {
  using dspic::Operand;
  switch (kind) {
    case Operand::File:
      return row.has(&dspic::Fields::B) || row.has(Operand::FileBit) ? DSPICFix::NearByte : DSPICFix::Near;
    case Operand::FileWord:
      return StringRef(row.mnemonic) == "MOV" ? DSPICFix::FileOfMove : DSPICFix::File;
    case Operand::Branch:
      return DSPICFix::Branch;
    case Operand::DoEnd:
      return DSPICFix::DoEnd;
    case Operand::Target:
      return DSPICFix::CallLow;
    case Operand::Literal: {
      constexpr std::uint32_t kLiteral16 = 0x0FFFF0;  // MOV #lit16,Wn
      for (const dspic::Field& field : row.fields)
        if (field.mask == kLiteral16) return DSPICFix::Literal16;
      return 0;
    }
    default:
      return 0;
  }
}

/// XC16's functions of an address, each a way of its own to fill #lit16.
unsigned fixup_named(StringRef function) {
  return StringSwitch<unsigned>(function.lower())
      .Case("tbloffset", DSPICFix::TableOffset)
      .Case("tblpage", DSPICFix::TablePage)
      .Case("psvoffset", DSPICFix::PsvOffset)
      .Case("psvpage", DSPICFix::PsvPage)
      .Case("handle", DSPICFix::Literal16)
      .Default(0);
}

bool holds_value(const assembly::Written& operand, dspic::Operand kind) {
  using assembly::Written;
  if (kind == dspic::Operand::Accumulator || kind == dspic::Operand::WriteBack)
    return false;  // "A" is a name
  return operand.kind == Written::Immediate || operand.kind == Written::Plain ||
         operand.kind == Written::IndirectLiteral;
}

/// See check_dspic_files().
std::function<std::string(const std::string&)>& file_check() {
  static std::function<std::string(const std::string&)> check;
  return check;
}

/// An operand that waits for the linker.
struct Symbolic {
  const MCExpr* expression;
  unsigned fixup;
};

class Parser : public MCTargetAsmParser {
 public:
  Parser(const MCSubtargetInfo& subtarget, MCAsmParser& parser, const MCInstrInfo& instructions,
         const MCTargetOptions& options)
      : MCTargetAsmParser(options, subtarget, instructions),
        directives_(parser, [this](const std::string& text, std::int64_t& value) {
          std::string error;
          return value_of(text, value, error);
        }) {
    MCAsmParserExtension::Initialize(parser);
  }
  bool ParseRegister(unsigned&, SMLoc&, SMLoc&) override { return true; }
  OperandMatchResultTy tryParseRegister(unsigned&, SMLoc&, SMLoc&) override { return MatchOperand_NoMatch; }
  void convertToMapAndConstraints(unsigned, const OperandVector&) override {}

  bool ParseInstruction(ParseInstructionInfo&, StringRef name, SMLoc at, OperandVector&) override {
    if (is_too_deep(at)) return true;
    mnemonic_ = name.str();
    const char* begin = at.getPointer() + name.size();
    while (getLexer().isNot(AsmToken::EndOfStatement)) Lex();
    operands_ =
        assembly::trimmed(without_asm_comments(StringRef(begin, getLexer().getLoc().getPointer() - begin)));
    Lex();
    return false;
  }

  bool MatchAndEmitInstruction(SMLoc at, unsigned&, OperandVector&, MCStreamer& out, uint64_t&,
                               bool) override {
    bool failed = false;
    const auto complain = [&](const std::string& message) { failed |= Error(at, message); };
    if (StringRef(mnemonic_).lower() == "config") return directives_.configure(operands_, at);
    const assembly::Choice choice = assembly::choose(mnemonic_, operands_, complain);
    if (failed || !choice.row) return true;
    SmallVector<Symbolic, 2> symbolic;
    std::map<std::string, std::int64_t> values;
    for (size_t i = 0; i < choice.operands.size(); ++i) {
      const std::string& text = choice.operands[i].text;
      std::string error;
      if (text.empty() || !holds_value(choice.operands[i], choice.row->kinds[i]) ||
          value_of(text, values[text], error))
        continue;
      Symbolic s{nullptr, fixup_of(choice.row->kinds[i], *choice.row)};
      if (!s.fixup || !address_of(text, s)) return Error(at, error);
      symbolic.push_back(s);
      // the field stays zero: a branch to the next instruction is one of zero words
      values[text] = s.fixup == DSPICFix::Branch ? 2 : s.fixup == DSPICFix::DoEnd ? 4 : 0;
    }
    const auto words = encode(
        choice, 0, [&](const std::string& text) { return values[text]; }, complain);
    if (failed) return true;
    // the lowest bit says which byte of a word it is: from the number of the bit, unless the text says .b
    if (choice.row->has(dspic::Operand::FileBit) && !StringRef(mnemonic_).endswith_insensitive(".b"))
      for (Symbolic& s : symbolic) s.fixup = DSPICFix::Near;
    emit(out, words, symbolic);
    return false;
  }

  // beside LLVM's. True: it is none of these
  bool ParseDirective(AsmToken directive) override {
    if (is_too_deep(directive.getLoc())) {
      getParser().eatToEndOfStatement();
      return false;
    }
    if (directive.getString().lower() == ".include" && has_too_many_includes(directive.getLoc())) {
      getParser().eatToEndOfStatement();
      Error(directive.getLoc(), "includes are nested too deeply, or too many");
      return false;  // mistakes are reported
    }
    if (names_no_file(directive.getString())) {
      getParser().eatToEndOfStatement();
      return false;  // the mistake is reported
    }
    // the vendor's own file, whose names are known
    if (directive.getString().lower() != ".include" || getLexer().isNot(AsmToken::String) ||
        !assembly::is_device_file(getTok().getStringContents().str()))
      return directives_.parse(directive.getString());
    Lex();
    return getParser().parseToken(AsmToken::EndOfStatement);
  }

 private:
  /// Who reads brackets of a statement within one another needs stack for each.
  bool is_too_deep(SMLoc at) {
    constexpr unsigned kDeepest = 250;
    unsigned depth = 0, deepest = 0, signs = 0;
    bool is_text = false;
    for (const char* c = at.getPointer(); *c && *c != '\n' && (is_text || *c != ';'); ++c) {
      if (*c == '"') is_text = !is_text;
      if (is_text) continue;
      if (c[0] == '/' && (c[1] == '/' || c[1] == '*')) break;
      depth = *c == '(' ? depth + 1 : *c == ')' && depth > 0 ? depth - 1 : depth;
      signs = StringRef("+-~!").contains(*c) ? signs + 1 : *c == ' ' ? signs : 0;
      deepest = std::max(deepest, depth + signs);
    }
    return deepest > kDeepest && Error(at, "expression: got brackets or signs more than " + Twine(kDeepest) +
                                               " within one another, expected at most that");
  }
  /// Of .include and .incbin: a pipe without a writer would never be open, a device never end; and not every file
  /// may be read.
  bool names_no_file(StringRef directive) {
    const std::string what = directive.lower();
    if ((what != ".include" && what != ".incbin") || getLexer().isNot(AsmToken::String)) return false;
    // the name as LLVM reads it, with what backslashes mean; then the token stands there again
    const AsmToken token = getTok();
    std::string name;
    if (getParser().parseEscapedString(name)) return true;
    getLexer().UnLex(token);
    // LLVM's order
    std::vector<std::string> places = {name};
    for (const std::string& folder : getTargetOptions().IASSearchPaths) places.push_back(folder + "/" + name);
    const auto first = find_if(places, [](const std::string& place) { return sys::fs::exists(place); });
    if (first == places.end()) return false;
    std::string wrong = file_check() ? file_check()(*first) : "";
    if (wrong.empty() && !sys::fs::is_regular_file(*first))
      wrong = what + ": " + *first + ": got a pipe, a device or a folder, expected a file";
    if (!wrong.empty()) Error(token.getLoc(), wrong);
    return !wrong.empty();
  }
  /// A file that includes itself would never end.
  bool has_too_many_includes(SMLoc at) {
    constexpr unsigned kDeepest = 30, kMost = 1000;
    SourceMgr& sources = getParser().getSourceManager();
    unsigned depth = 0;
    while (at.isValid() && depth <= kDeepest) {
      const unsigned buffer = sources.FindBufferContainingLoc(at);
      at = buffer ? sources.getParentIncludeLoc(buffer) : SMLoc();
      ++depth;
    }
    return depth > kDeepest || sources.getNumBuffers() > kMost;
  }
  bool value_of(const std::string& text, std::int64_t& value, std::string& error) {
    const auto symbols = [this](const std::string& name, std::int64_t& v) {
      MCSymbol* symbol = getContext().lookupSymbol(name);
      if (symbol && symbol->isVariable()) return symbol->getVariableValue()->evaluateAsAbsolute(v);
      return (!symbol || symbol->isUndefined()) && assembly::device_constant(name, v);
    };
    return assembly::evaluate(text, symbols, nullptr, value, error);
  }
  /// "name", "name + 2", "tbloffset(name)".
  bool address_of(StringRef text, Symbolic& s) {
    text = text.trim();
    size_t end = 0;
    while (end < text.size() && assembly::continues_name(text[end])) ++end;
    const StringRef name = text.take_front(end), rest = text.drop_front(end).trim();
    if (rest.startswith("(") && rest.endswith(")")) {
      const unsigned named = name.empty() ? s.fixup : fixup_named(name);
      if (!named || (s.fixup != DSPICFix::Literal16 && !name.empty())) return false;
      s.fixup = named;
      return address_of(rest.drop_front().drop_back(), s);
    }
    if (name.empty()) return false;
    s.expression = MCSymbolRefExpr::create(symbol(name), getContext());
    std::int64_t offset = 0;
    std::string error;
    if (rest.empty()) return true;
    if (!value_of("0" + rest.str(), offset, error)) return false;
    s.expression =
        MCBinaryExpr::createAdd(s.expression, MCConstantExpr::create(offset, getContext()), getContext());
    return true;
  }
  /// "1b" and "1f" are the nearest label 1 before and after.
  MCSymbol* symbol(StringRef name) {
    unsigned number;
    const char direction = name.back();
    if ((direction == 'b' || direction == 'f') && !name.drop_back().getAsInteger(10, number))
      return getContext().getDirectionalLocalSymbol(number, direction == 'b');
    return getContext().getOrCreateSymbol(name);
  }
  /// Words as they are, with what the linker adds (RAW in control.td).
  void emit(MCStreamer& out, const std::vector<std::uint32_t>& words, ArrayRef<Symbolic> symbolic) {
    for (size_t i = 0; i < words.size(); ++i) {
      MCInst raw = MCInstBuilder(DSPIC::RAW).addImm(words[i]);
      for (const Symbolic& s : symbolic) {
        const bool is_in_second = s.fixup == DSPICFix::DoEnd;
        if (s.fixup != DSPICFix::CallLow && is_in_second != (i == 1)) continue;
        raw.addOperand(MCOperand::createImm(
            s.fixup == DSPICFix::CallLow && i == 1 ? unsigned(DSPICFix::CallHigh) : s.fixup));
        raw.addOperand(MCOperand::createExpr(s.expression));
      }
      out.emitInstruction(raw, getSTI());
    }
  }

  DSPICDirectives directives_;
  std::string mnemonic_, operands_;
};

}  // namespace

void check_dspic_files(std::function<std::string(const std::string&)> check) {
  file_check() = std::move(check);
}

bool is_dspic_device_file(const std::string& name) { return assembly::is_device_file(name); }

void register_dspic_parser(Target& target) { RegisterMCAsmParser<Parser> parser(target); }

}  // namespace llvm
