// SPDX-License-Identifier: MIT
// Multiplication and division. A product is a pair of registers. A division is REPEAT #17 and eighteen rounds of DIV;
// nothing may come between them, so both are one instruction up to the very end (asm_printer.cpp).
def MULUU : Shift3<0b101110000, 0, (outs WP:$d), (ins W:$b, W:$s), "mul.uu\t$b, $s, $d", []>;
def MULSS : Shift3<0b101110011, 0, (outs WP:$d), (ins W:$b, W:$s), "mul.ss\t$b, $s, $d", []>;
def MULUUi : I<(outs WP:$d), (ins W:$b, lit5:$k), "mul.uu\t$b, $k, $d"> {
  bits<4> b; bits<4> d; bits<5> k; let Inst{23-15} = 0b101110000; let Inst{14-11} = b; let Inst{10-7} = d; let Inst{6-5} = 3; let Inst{4-0} = k; }
let Defs = [W0, W1, SR], hasSideEffects = 0, Size = 8 in {
  def DIVS : Pseudo<(outs), (ins W:$a, WGE2:$b)>;
  def DIVU : Pseudo<(outs), (ins W:$a, WGE2:$b)>;
}
class Divide<bits<9> op, string mn> : I<(outs), (ins W:$a, W:$b), mn#"\t$a, $b"> {
  bits<4> a; bits<4> b; let Inst{23-15} = op; let Inst{14-11} = 0; let Inst{10-7} = a; let Inst{6-4} = 0; let Inst{3-0} = b; }
let hasSideEffects = 1 in { def DIVSW : Divide<0b110110000, "div.sw">; def DIVUW : Divide<0b110110001, "div.uw">;
  def REPEATi : I<(outs), (ins lit14:$k), "repeat\t$k"> { bits<14> k; let Inst{23-14} = 0b0000100100; let Inst{13-0} = k; } }
