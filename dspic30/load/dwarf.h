// SPDX-License-Identifier: MIT
// Numbers of DWARF's entries, attributes, forms and locations, as far as they are read [DWARF 4, 7.5].
#pragma once

namespace dspic::dwarf {

enum Tag : unsigned {
  kArrayType = 0x01,
  kEnumerationType = 0x04,
  kFormalParameter = 0x05,
  kLexicalBlock = 0x0B,
  kMember = 0x0D,
  kPointerType = 0x0F,
  kCompileUnit = 0x11,
  kStructureType = 0x13,
  kTypedef = 0x16,
  kUnionType = 0x17,
  kInlinedSubroutine = 0x1D,
  kSubrangeType = 0x21,
  kBaseType = 0x24,
  kEnumerator = 0x28,
  kConstType = 0x26,
  kSubprogram = 0x2E,
  kVariable = 0x34,
  kVolatileType = 0x35
};
enum Attribute : unsigned {
  kLocation = 0x02,
  kName = 0x03,
  kStatements = 0x10,
  kByteSize = 0x0B,
  kBitOffset = 0x0C,
  kBitSize = 0x0D,
  kLowPc = 0x11,
  kHighPc = 0x12,
  kCompileFolder = 0x1B,
  kConstValue = 0x1C,
  kUpperBound = 0x2F,
  kAbstractOrigin = 0x31,
  kCountOf = 0x37,
  kDataMemberLocation = 0x38,
  kDeclaredFile = 0x3A,
  kDeclaredLine = 0x3B,
  kDeclaration = 0x3C,
  kEncoding = 0x3E,
  kFrameBase = 0x40,
  kSpecification = 0x47,
  kType = 0x49,
  kRanges = 0x55,
  kDataBitOffset = 0x6B
};
enum Form : unsigned {
  kAddr = 0x01,
  kBlock2 = 0x03,
  kBlock4 = 0x04,
  kData2 = 0x05,
  kData4 = 0x06,
  kData8 = 0x07,
  kString = 0x08,
  kBlock = 0x09,
  kBlock1 = 0x0A,
  kData1 = 0x0B,
  kFlag = 0x0C,
  kSdata = 0x0D,
  kStrp = 0x0E,
  kUdata = 0x0F,
  kRefAddr = 0x10,
  kRef1 = 0x11,
  kRef2 = 0x12,
  kRef4 = 0x13,
  kRef8 = 0x14,
  kRefUdata = 0x15,
  kSecOffset = 0x17,
  kExprloc = 0x18,
  kFlagPresent = 0x19
};
inline constexpr unsigned kFloatEncoding = 0x04, kSignedEncoding = 0x05, kSignedChar = 0x06;
// operations of locations
inline constexpr unsigned kOpAddr = 0x03, kOpPlusConst = 0x23, kOpReg0 = 0x50, kOpBreg0 = 0x70,
                          kOpConst1u = 0x08, kOpConsts = 0x11, kOpConstu = 0x10, kOpFbreg = 0x91,
                          kOpLit0 = 0x30, kOpStackValue = 0x9F;

}  // namespace dspic::dwarf
