// SPDX-License-Identifier: MIT
// Registers. Sixteen words, of which W14 (frame) and W15 (stack) are never allocated; SR stands for the flags.
// Pairs exist for multiplication alone, whose result takes an even register and the next.
def sub_lo : SubRegIndex<16, 0> { let Namespace = "DSPIC"; }
def sub_hi : SubRegIndex<16, 16> { let Namespace = "DSPIC"; }

class WReg<bits<4> n> : Register<"w"#n> {
  let Namespace = "DSPIC";
  let HWEncoding{3-0} = n;
  let DwarfNumbers = [!cast<int>(n)];
}
foreach n = 0-15 in def W#n : WReg<n>;
def SR : Register<"sr"> { let Namespace = "DSPIC"; }

foreach n = [0, 2, 4, 6, 8, 10, 12] in
  def D#n : RegisterWithSubRegs<"w"#n, [!cast<Register>("W"#n), !cast<Register>("W"#!add(n, 1))]> {
    let Namespace = "DSPIC";
    let HWEncoding{3-0} = n;
    let SubRegIndices = [sub_lo, sub_hi];
    let CoveredBySubRegs = 1;
  }

def W : RegisterClass<"DSPIC", [i16], 16, (add (sequence "W%u", 0, 15))>;
def WGE2 : RegisterClass<"DSPIC", [i16], 16, (add (sequence "W%u", 2, 13))>;  // a divisor
// operands of assembler text in C, by XC16's letters
def WConstraintD : RegisterClass<"DSPIC", [i16], 16, (add (sequence "W%u", 1, 13))>;
def WConstraintU : RegisterClass<"DSPIC", [i16], 16, (add W4, W5, W6)>;
def WConstraintX : RegisterClass<"DSPIC", [i16], 16, (add W8, W9)>;
def WConstraintY : RegisterClass<"DSPIC", [i16], 16, (add W10, W11)>;
def WConstraintZ : RegisterClass<"DSPIC", [i16], 16, (add W4, W5, W6, W7)>;
def WP : RegisterClass<"DSPIC", [untyped], 16, (add D0, D2, D4, D6, D8, D10, D12)> { let Size = 32; }
def CCR : RegisterClass<"DSPIC", [i16], 16, (add SR)> { let isAllocatable = 0; let CopyCost = -1; }

// what a function hands back as it found it; an interrupt handler everything
def CSR : CalleeSavedRegs<(add (sequence "W%u", 8, 14))>;
def CSR_Interrupt : CalleeSavedRegs<(add (sequence "W%u", 0, 14))>;
def CSR_Shadow : CalleeSavedRegs<(add (sequence "W%u", 4, 14))>;  // PUSH.S keeps W0 to W3
