// SPDX-License-Identifier: MIT
// Arithmetic and logic. Suffixes: rr registers, ri five-bit literal, i10 ten-bit literal in place, rm memory as
// second operand, mm memory as second operand and result, f near memory in place.
multiclass Alu<bits<5> op, string mn, SDPatternOperator node, bit comm, bit mem = 1> {
  let Defs = [SR] in {
    let isCommutable = comm in
    def rr : Alu3<op, 0, 0, (outs W:$d), (ins W:$b, W:$s), mn#"\t$b, $s, $d", [(set W:$d, (node W:$b, W:$s))]>;
    def ri : Alu3Lit5<op, (outs W:$d), (ins W:$b, lit5:$k), mn#"\t$b, $k, $d", [(set W:$d, (node W:$b, lit5:$k))]>;
    def rm : Alu3<op, 0, 1, (outs W:$d), (ins W:$b, W:$s), mn#"\t$b, [$s], $d", [(set W:$d, (node W:$b, (load addrind:$s)))]>
      { let mayLoad = 1; }
    if mem then
    def mm : Alu3<op, 1, 1, (outs), (ins W:$b, W:$s), mn#"\t$b, [$s], [$s]", [(store (node W:$b, (load addrind:$s)), addrind:$s)]>
      { let d = s; let mayLoad = 1; let mayStore = 1; }
  }
}
def rsub  : PatFrag<(ops node:$b, node:$s), (sub $s, $b)>;
def rsube : PatFrag<(ops node:$b, node:$s), (sube $s, $b)>;
defm ADD  : Alu<0b01000, "add", add, 1>;
defm SUB  : Alu<0b01010, "sub", sub, 0, 0>;
defm SUBR : Alu<0b00010, "subr", rsub, 0>;
defm AND  : Alu<0b01100, "and", and, 1>;
defm XOR  : Alu<0b01101, "xor", xor, 1>;
defm IOR  : Alu<0b01110, "ior", or, 1>;
let Uses = [SR] in {
  defm ADDC : Alu<0b01001, "addc", adde, 1, 0>;
  defm SUBB : Alu<0b01011, "subb", sube, 0, 0>;
  defm SUBBR : Alu<0b00011, "subbr", rsube, 0, 0>;
}
multiclass Lit10<bits<9> op, string mn, SDPatternOperator node> {
  let Defs = [SR] in
  def i10 : AluLit10<op, (outs W:$d), (ins W:$n, lit10:$k), mn#"\t$k, $d", [(set W:$d, (node W:$n, lit10:$k))]>;
}
defm ADD : Lit10<0b101100000, "add", add>;
defm SUB : Lit10<0b101100010, "sub", sub>;
defm AND : Lit10<0b101100100, "and", and>;
defm XOR : Lit10<0b101100101, "xor", xor>;
defm IOR : Lit10<0b101100110, "ior", or>;
let Uses = [SR] in { defm ADDC : Lit10<0b101100001, "addc", adde>; defm SUBB : Lit10<0b101100011, "subb", sube>; }

// subtracting is adding the negative, also for the carry; a low half keeps C, a high half complements
def : Pat<(add W:$a, nlit5:$k), (SUBri W:$a, (neg_x $k))>;
def : Pat<(add W:$a, nlit10:$k), (SUBi10 W:$a, (neg_x $k))>;
def : Pat<(addc W:$a, W:$b), (ADDrr W:$a, W:$b)>;
def : Pat<(addc W:$a, (load addrind:$b)), (ADDrm W:$a, addrind:$b)>;
def : Pat<(addc W:$a, lit5:$k), (ADDri W:$a, imm:$k)>;
def : Pat<(addc W:$a, lit10:$k), (ADDi10 W:$a, imm:$k)>;
def : Pat<(addc W:$a, nlit5:$k), (SUBri W:$a, (neg_x $k))>;
def : Pat<(addc W:$a, nlit10:$k), (SUBi10 W:$a, (neg_x $k))>;
def : Pat<(adde W:$a, clit5:$k), (SUBBri W:$a, (com_x $k))>;
def : Pat<(adde W:$a, clit10:$k), (SUBBi10 W:$a, (com_x $k))>;
def : Pat<(subc W:$a, W:$b), (SUBrr W:$a, W:$b)>;
def : Pat<(subc lit5:$k, W:$a), (SUBRri W:$a, imm:$k)>;
def : Pat<(subc W:$a, lit5:$k), (SUBri W:$a, imm:$k)>;

multiclass Un<bits<9> op, string mn, dag val, dag val_m> {
  let Defs = [SR] in {
    def r : Alu2<op, 0, 0, 0, (outs W:$d), (ins W:$s), mn#"\t$s, $d", [(set W:$d, val)]>;
    let mayLoad = 1 in def m : Alu2<op, 0, 0, 1, (outs W:$d), (ins W:$s), mn#"\t[$s], $d", [(set W:$d, val_m)]>;
    let mayLoad = 1, mayStore = 1 in
    def mm : Alu2<op, 0, 1, 1, (outs), (ins W:$s), mn#"\t[$s], [$s]", [(store val_m, addrind:$s)]> { let d = s; }
  }
}
defm INC : Un<0b111010000, "inc", (add W:$s, 1), (add (load addrind:$s), 1)>;
defm INC2 : Un<0b111010001, "inc2", (add W:$s, 2), (add (load addrind:$s), 2)>;
defm DEC : Un<0b111010010, "dec", (add W:$s, -1), (add (load addrind:$s), -1)>;
defm DEC2 : Un<0b111010011, "dec2", (add W:$s, -2), (add (load addrind:$s), -2)>;
defm NEG : Un<0b111010100, "neg", (sub 0, W:$s), (sub 0, (load addrind:$s))>;
defm COM : Un<0b111010101, "com", (xor W:$s, -1), (xor (load addrind:$s), -1)>;

// of bytes, where a variable without optimiser is counted in place (unoptimised.cpp)
let Defs = [SR], mayLoad = 1, mayStore = 1 in {
  def INCBmm : Alu2<0b111010000, 1, 1, 1, (outs), (ins W:$s), "inc.b\t[$s], [$s]", []> { let d = s; }
  def DECBmm : Alu2<0b111010010, 1, 1, 1, (outs), (ins W:$s), "dec.b\t[$s], [$s]", []> { let d = s; }
}
// near memory in place: one instruction, so nothing comes between read and write; volatile registers take it too
multiclass InPlace<bits<9> op, string mn, dag val> {
  let Defs = [SR], mayLoad = 1, mayStore = 1, AddedComplexity = 30 in
  def f : File<op, 0, (outs), (ins near:$f), mn#"\t$f", [(store val, addrnear:$f)]>;
}
defm INC : InPlace<0b111011000, "inc", (add (load addrnear:$f), 1)>;
defm INC2 : InPlace<0b111011001, "inc2", (add (load addrnear:$f), 2)>;
defm DEC : InPlace<0b111011010, "dec", (add (load addrnear:$f), -1)>;
defm NEG : InPlace<0b111011100, "neg", (sub 0, (load addrnear:$f))>;
defm COM : InPlace<0b111011101, "com", (xor (load addrnear:$f), -1)>;
defm SL  : InPlace<0b110101000, "sl", (shl (load addrnear:$f), (i16 1))>;
let mayStore = 1, AddedComplexity = 40 in {
  def CLRf : File<0b111011110, 0, (outs), (ins near:$f), "clr\t$f", [(store (i16 0), addrnear:$f)]>;
  def SETMf : File<0b111011111, 0, (outs), (ins near:$f), "setm\t$f", [(store (i16 -1), addrnear:$f)]>;
  def CLRBf : File<0b111011110, 1, (outs), (ins near8:$f), "clr.b\t$f", [(truncstorei8 (i16 0), addrnear8:$f)]>;
  def CLRm : Alu2<0b111010110, 0, 1, 0, (outs), (ins W:$d), "clr\t[$d]", [(store (i16 0), addrind:$d)]> { let s = 0; }
  def CLRBm : Alu2<0b111010110, 1, 1, 0, (outs), (ins W:$d), "clr.b\t[$d]", [(truncstorei8 (i16 0), addrind8:$d)]> { let s = 0; }
}
multiclass Shift<bits<9> op, string mn, SDPatternOperator node, SDPatternOperator nodev> {
  let Defs = [SR] in {
  def rr : Shift3<op, 0, (outs W:$d), (ins W:$b, W:$s), mn#"\t$b, $s, $d", [(set W:$d, (node W:$b, (i16 W:$s)))]>;
  def ri : Shift3<op, 4, (outs W:$d), (ins W:$b, lit4:$s), mn#"\t$b, $s, $d", [(set W:$d, (node W:$b, (i16 lit4:$s)))]>;
  }
  def : Pat<(nodev W:$b, W:$s), (!cast<Instruction>(NAME#"rr") W:$b, W:$s)>;
}
defm SHL : Shift<0b110111010, "sl", shl, shlv>;
defm LSR : Shift<0b110111100, "lsr", srl, lsrv>;
defm ASR : Shift<0b110111101, "asr", sra, asrv>;
