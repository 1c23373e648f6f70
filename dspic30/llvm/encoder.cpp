// SPDX-License-Identifier: MIT
// Instructions as words: 24 bits and a zero octet. An operand that does not fit is an error, never cut off.
#include "dspic30/llvm/fixups.h"
#include "dspic30/llvm/mc.h"
#include "llvm/MC/MCCodeEmitter.h"
#include "llvm/MC/MCContext.h"
#include "llvm/MC/MCExpr.h"
#include "llvm/MC/MCInst.h"
#include "llvm/MC/MCInstrInfo.h"
#include "llvm/MC/MCRegisterInfo.h"
#include "llvm/MC/MCSubtargetInfo.h"
#include "llvm/Support/EndianStream.h"

namespace llvm {

namespace {

using Fixups = SmallVectorImpl<MCFixup>;

class DSPICMCCodeEmitter : public MCCodeEmitter {
 public:
  DSPICMCCodeEmitter(const MCInstrInfo&, MCContext& context) : context_(context) {}
  /// Made by llvm-tblgen; asks the functions below for the operands.
  uint64_t getBinaryCodeForInstr(const MCInst& mi, Fixups& fixups, const MCSubtargetInfo& subtarget) const;

  void encodeInstruction(const MCInst& mi, raw_ostream& out, Fixups& fixups,
                         const MCSubtargetInfo& subtarget) const override {
    write_word(out, getBinaryCodeForInstr(mi, fixups, subtarget));
    if (mi.getOpcode() == DSPIC::RAW)  // kinds and expressions follow the word
      for (unsigned i = 1; i + 1 < mi.getNumOperands(); i += 2)
        fixups.push_back(
            MCFixup::create(0, mi.getOperand(i + 1).getExpr(), MCFixupKind(mi.getOperand(i).getImm())));
  }

 private:
  static void write_word(raw_ostream& out, uint64_t word) {
    support::endian::write<uint32_t>(out, uint32_t(word & 0xFFFFFF), support::little);
  }
  uint64_t bad(const MCInst& mi, int64_t v, const char* expected) const {
    context_.reportError(mi.getLoc(), Twine("operand ") + Twine(v) + ": expected " + expected);
    return 0;
  }
  uint64_t checked(const MCInst& mi, int64_t v, bool fits, const char* expected, uint64_t encoded) const {
    return fits ? encoded : bad(mi, v, expected);
  }
  unsigned number_of(const MCOperand& reg) const {
    return context_.getRegisterInfo()->getEncodingValue(reg.getReg());
  }
  /// A symbol's address comes from the linker.
  uint64_t leave_to_linker(const MCExpr* e, DSPICFix::Kind kind, Fixups& fixups, int64_t add = 0) const {
    if (add) e = MCBinaryExpr::createAdd(e, MCConstantExpr::create(add, context_), context_);
    fixups.push_back(MCFixup::create(0, e, MCFixupKind(kind)));
    return 0;
  }

  uint64_t getMachineOpValue(const MCInst&, const MCOperand& op, Fixups&, const MCSubtargetInfo&) const {
    return op.isReg() ? number_of(op) : op.getImm();
  }
  uint64_t encode_word(const MCInst& mi, unsigned n, Fixups& fixups, const MCSubtargetInfo&) const {
    const MCOperand& op = mi.getOperand(n);
    if (!op.isImm()) return leave_to_linker(op.getExpr(), DSPICFix::Literal16, fixups);
    const int64_t v = op.getImm();
    return checked(mi, v, v >= -0x8000 && v <= 0xFFFF, "16 bits", v & 0xFFFF);
  }
  uint64_t encode_word_address(const MCInst& mi, unsigned n, Fixups& fixups, const MCSubtargetInfo&) const {
    const MCOperand& op = mi.getOperand(n);
    if (!op.isImm()) return leave_to_linker(op.getExpr(), DSPICFix::FileOfMove, fixups);
    const uint64_t address = op.getImm() & 0xFFFF;
    return checked(mi, address, !(address & 1), "an even address", address >> 1);
  }
  uint64_t encode_file(const MCInst& mi, unsigned n, Fixups& fixups, const MCSubtargetInfo&) const {
    const MCOperand& op = mi.getOperand(n);
    if (!op.isImm()) return leave_to_linker(op.getExpr(), DSPICFix::File, fixups);
    const uint64_t address = op.getImm() & 0xFFFF;
    return checked(mi, address, !(address & 1), "an even address", address);
  }
  uint64_t encode_near(const MCInst& mi, unsigned n, Fixups& fixups, const MCSubtargetInfo&) const {
    const MCOperand& op = mi.getOperand(n);
    if (!op.isImm()) return leave_to_linker(op.getExpr(), DSPICFix::Near, fixups);
    const int64_t v = op.getImm();
    return checked(mi, v, isUInt<13>(v) && !(v & 1), "an even address below 0x2000", v);
  }
  uint64_t encode_near_byte(const MCInst& mi, unsigned n, Fixups& fixups, const MCSubtargetInfo&) const {
    const MCOperand& op = mi.getOperand(n);
    if (!op.isImm()) return leave_to_linker(op.getExpr(), DSPICFix::NearByte, fixups);
    const int64_t v = op.getImm();
    return checked(mi, v, isUInt<13>(v), "an address below 0x2000", v);
  }
  /// Bits 8 to 15 are bits 0 to 7 of the next byte.
  uint64_t encode_near_bit(const MCInst& mi, unsigned n, Fixups& fixups, const MCSubtargetInfo&) const {
    const MCOperand& op = mi.getOperand(n);
    const unsigned bit = mi.getOperand(n + 1).getImm();
    if (bit > 15) return bad(mi, bit, "a bit 0 to 15");
    const uint64_t field = uint64_t(bit & 7) << 13;
    if (!op.isImm()) return leave_to_linker(op.getExpr(), DSPICFix::NearByte, fixups, bit >> 3) | field;
    const int64_t v = op.getImm() + (bit >> 3);
    return checked(mi, v, isUInt<13>(v), "an address below 0x2000", v | field);
  }
  /// [W+offset]: the offset's ten bits above the register's four.
  uint64_t encode_word_offset(const MCInst& mi, unsigned n, Fixups&, const MCSubtargetInfo&) const {
    const int64_t v = mi.getOperand(n + 1).getImm();
    return checked(mi, v, isInt<11>(v) && !(v & 1), "an even offset of -1024 to 1022",
                   (v / 2 & 0x3FF) << 4 | number_of(mi.getOperand(n)));
  }
  uint64_t encode_byte_offset(const MCInst& mi, unsigned n, Fixups&, const MCSubtargetInfo&) const {
    const int64_t v = mi.getOperand(n + 1).getImm();
    return checked(mi, v, isInt<10>(v), "an offset of -512 to 511",
                   (v & 0x3FF) << 4 | number_of(mi.getOperand(n)));
  }
  uint64_t encode_branch(const MCInst& mi, unsigned n, Fixups& fixups, const MCSubtargetInfo&) const {
    return leave_to_linker(mi.getOperand(n).getExpr(), DSPICFix::Branch, fixups);
  }

  MCContext& context_;
};

#include "DSPICGenMCCodeEmitter.inc"

}  // namespace

MCCodeEmitter* create_dspic_encoder(const MCInstrInfo& instructions, MCContext& context) {
  return new DSPICMCCodeEmitter(instructions, context);
}

}  // namespace llvm
