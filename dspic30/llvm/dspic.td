// SPDX-License-Identifier: MIT
// The dsPIC30F for LLVM: tables that llvm-tblgen turns into C++ at build time.
//
//   registers.td   W0..W15 and what calls keep       formats.td     where operands lie in a word
//   operands.td    literals, addresses, graph nodes  *.td below     instructions, each with the pattern it serves
//
// Encodings are those of the instruction table; a test decodes every one of them with the chip's own decoder.
// Patterns read: (set W:$d, (add W:$b, W:$s)) means "where the graph holds an add, take this instruction".
include "llvm/Target/Target.td"
include "registers.td"
include "operands.td"
include "formats.td"
include "arithmetic.td"
include "bits.td"
include "multiply.td"
include "compare.td"
include "moves.td"
include "control.td"

def DSPICInstrInfo : InstrInfo;
def DSPICAsmWriter : AsmWriter { string AsmWriterClassName = "InstPrinter"; bit isMCAsmWriter = 1; }
def : ProcessorModel<"30f6014a", NoSchedModel, []>;
def DSPIC : Target { let InstructionSet = DSPICInstrInfo; let AssemblyWriters = [DSPICAsmWriter]; }
