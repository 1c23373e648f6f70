// SPDX-License-Identifier: MIT
// From machine instructions to what the assembler layer takes: symbols become expressions, a division becomes
// REPEAT and DIV, inline assembler gets its operands.
#include "llvm/CodeGen/AsmPrinter.h"

#include "dspic30/llvm/tables.h"
#include "dspic30/llvm/target.h"
#include "llvm/CodeGen/MachineInstr.h"
#include "llvm/IR/Constants.h"
#include "llvm/MC/MCContext.h"
#include "llvm/MC/MCExpr.h"
#include "llvm/MC/MCInst.h"
#include "llvm/MC/MCInstBuilder.h"
#include "llvm/MC/MCRegisterInfo.h"
#include "llvm/MC/MCStreamer.h"
#include "llvm/Target/TargetMachine.h"

namespace llvm {

namespace {

class DSPICAsmPrinter : public AsmPrinter {
 public:
  DSPICAsmPrinter(TargetMachine& machine, std::unique_ptr<MCStreamer> out)
      : AsmPrinter(machine, std::move(out)) {}
  StringRef getPassName() const override { return "dsPIC assembly printer"; }

  void emitInstruction(const MachineInstr* mi) override {
    unsigned opcode = mi->getOpcode();
    if (opcode == DSPIC::DIVS || opcode == DSPIC::DIVU) {
      constexpr int kRoundsButOne = 17;
      EmitToStreamer(*OutStreamer, MCInstBuilder(DSPIC::REPEATi).addImm(kRoundsButOne));
      opcode = opcode == DSPIC::DIVS ? DSPIC::DIVSW : DSPIC::DIVUW;
    }
    if (opcode == DSPIC::COPY_WORDS || opcode == DSPIC::COPY_BYTES) {
      EmitToStreamer(*OutStreamer, MCInstBuilder(DSPIC::REPEATi).addImm(mi->getOperand(4).getImm() - 1));
      EmitToStreamer(*OutStreamer,
                     MCInstBuilder(opcode == DSPIC::COPY_WORDS ? DSPIC::MOVpipi : DSPIC::MOVBpipi)
                         .addReg(mi->getOperand(3).getReg())
                         .addReg(mi->getOperand(2).getReg()));
      return;
    }
    MCInst inst;
    inst.setOpcode(opcode);
    for (const auto& operand : mi->operands()) {
      MCOperand lowered;
      if (lower(operand, lowered)) inst.addOperand(lowered);
    }
    EmitToStreamer(*OutStreamer, inst);
  }

  /// The distance of two labels counts program addresses, two a word; the assembler layer
  /// counts octets, four.
  const MCExpr* lowerConstant(const Constant* c) override {
    auto* e = dyn_cast<ConstantExpr>(c);
    const MCExpr* value = AsmPrinter::lowerConstant(c);
    const bool is_distance =
        e && e->getOpcode() == Instruction::Sub && is_label(e->getOperand(0)) && is_label(e->getOperand(1));
    return is_distance ? MCBinaryExpr::createDiv(value, MCConstantExpr::create(2, OutContext), OutContext)
                       : value;
  }

  bool PrintAsmOperand(const MachineInstr* mi, unsigned n, const char* modifier, raw_ostream& out) override {
    const MachineOperand& op = mi->getOperand(n);
    if (modifier && *modifier) {
      // %d0: the pair's second register
      if (*modifier != 'd' || !op.isReg()) return AsmPrinter::PrintAsmOperand(mi, n, modifier, out);
      return out << 'w' << number_of(op) + 1, false;
    }
    if (op.isReg()) return out << 'w' << number_of(op), false;
    // "disi #%0" and "disi %0" are both written
    const bool has_sign = static_cast<raw_svector_ostream&>(out).str().endswith("#");
    if (op.isImm()) return out << (has_sign ? "" : "#") << op.getImm(), false;
    MCOperand address;
    if (!(op.isGlobal() || op.isBlockAddress() || op.isSymbol()) || !lower(op, address)) return true;
    return address.getExpr()->print(out, MAI), false;
  }
  bool PrintAsmMemoryOperand(const MachineInstr* mi, unsigned n, const char*, raw_ostream& out) override {
    out << "[w" << number_of(mi->getOperand(n));
    const int64_t offset = mi->getOperand(n + 1).getImm();
    if (offset) out << (offset < 0 ? "-" : "+") << std::abs(offset);
    return out << ']', false;
  }

 private:
  static bool is_label(const Constant* c) {
    auto* e = dyn_cast<ConstantExpr>(c);
    return e && e->getOpcode() == Instruction::PtrToInt && isa<BlockAddress>(e->getOperand(0));
  }
  unsigned number_of(const MachineOperand& op) const {
    return TM.getMCRegisterInfo()->getEncodingValue(op.getReg());
  }
  MCOperand reference(const MCSymbol* symbol, int64_t offset) {
    const MCExpr* e = MCSymbolRefExpr::create(symbol, OutContext);
    if (offset) e = MCBinaryExpr::createAdd(e, MCConstantExpr::create(offset, OutContext), OutContext);
    return MCOperand::createExpr(e);
  }
  /// False: the operand says something to passes only.
  bool lower(const MachineOperand& op, MCOperand& out) {
    switch (op.getType()) {
      case MachineOperand::MO_Register:
        out = MCOperand::createReg(op.getReg());
        return !op.isImplicit();
      case MachineOperand::MO_Immediate:
        out = MCOperand::createImm(op.getImm());
        return true;
      case MachineOperand::MO_MachineBasicBlock:
        out = reference(op.getMBB()->getSymbol(), 0);
        return true;
      case MachineOperand::MO_GlobalAddress:
        out = reference(getSymbol(op.getGlobal()), op.getOffset());
        return true;
      case MachineOperand::MO_BlockAddress:
        out = reference(GetBlockAddressSymbol(op.getBlockAddress()), op.getOffset());
        return true;
      case MachineOperand::MO_ExternalSymbol:
        out = reference(GetExternalSymbolSymbol(op.getSymbolName()), op.getOffset());
        return true;
      case MachineOperand::MO_RegisterMask:
        return false;
      default:
        report_fatal_error("dsPIC: an operand of a kind that has no text");
    }
  }
};

}  // namespace

void register_dspic_printer(Target& target) { RegisterAsmPrinter<DSPICAsmPrinter> printer(target); }

}  // namespace llvm
