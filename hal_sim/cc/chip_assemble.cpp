// SPDX-License-Identifier: MIT
// A .s file to an object: LLVM reads lines, labels and directives, dspic30/llvm/asm_parser.cpp the
// instructions.
#include "chip.h"
#include "dspic30/llvm/target.h"
#include "llvm/MC/MCAsmBackend.h"
#include "llvm/MC/MCAsmInfo.h"
#include "llvm/MC/MCCodeEmitter.h"
#include "llvm/MC/MCContext.h"
#include "llvm/MC/MCInstrInfo.h"
#include "llvm/MC/MCObjectFileInfo.h"
#include "llvm/MC/MCObjectWriter.h"
#include "llvm/MC/MCParser/MCAsmParser.h"
#include "llvm/MC/MCParser/MCTargetAsmParser.h"
#include "llvm/MC/MCRegisterInfo.h"
#include "llvm/MC/MCStreamer.h"
#include "llvm/MC/MCSubtargetInfo.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/SourceMgr.h"
#include "llvm/Support/raw_ostream.h"

namespace cc {

using namespace llvm;

int assemble_for_chip(const Options& options) {
  constexpr int kUsersFault = 1;
  const Target& target = dspic_target();
  const Triple triple(kDspicTriple);
  MCTargetOptions mc_options;
  std::unique_ptr<MCRegisterInfo> registers(target.createMCRegInfo(kDspicTriple));
  std::unique_ptr<MCAsmInfo> syntax(target.createMCAsmInfo(*registers, kDspicTriple, mc_options));
  std::unique_ptr<MCInstrInfo> instructions(target.createMCInstrInfo());
  std::unique_ptr<MCSubtargetInfo> subtarget(target.createMCSubtargetInfo(kDspicTriple, kDspicCpu, ""));

  if (!options.depfile.empty()) {
    std::error_code ec;
    raw_fd_ostream(options.depfile, ec) << "x: " << options.input << "\n";
  }
  auto text = MemoryBuffer::getFile(options.input);
  if (!text) {
    errs() << options.input << ": cannot read: " << text.getError().message() << "\n";
    return kUsersFault;
  }
  SourceMgr sources;
  sources.AddNewSourceBuffer(std::move(*text), SMLoc());
  for (size_t i = 0; i + 1 < options.passed_on.size(); ++i)
    if (options.passed_on[i] == "-I") sources.setIncludeDirs({options.passed_on[i + 1]});
  MCContext context(triple, syntax.get(), registers.get(), subtarget.get(), &sources, &mc_options);
  std::unique_ptr<MCObjectFileInfo> files(target.createMCObjectFileInfo(context, /*PIC=*/false));
  context.setObjectFileInfo(files.get());

  std::error_code ec;
  raw_fd_ostream out(options.output, ec, sys::fs::OF_None);
  if (ec) {
    errs() << options.output << ": cannot write: " << ec.message() << "\n";
    return kUsersFault;
  }
  std::unique_ptr<MCAsmBackend> backend(target.createMCAsmBackend(*subtarget, *registers, mc_options));
  auto writer = backend->createObjectWriter(out);
  std::unique_ptr<MCCodeEmitter> encoder(target.createMCCodeEmitter(*instructions, *registers, context));
  std::unique_ptr<MCStreamer> streamer(target.createMCObjectStreamer(
      triple, context, std::move(backend), std::move(writer), std::move(encoder), *subtarget, false, false,
      /*DWARFMustBeAtTheEnd=*/false));
  std::unique_ptr<MCAsmParser> parser(createMCAsmParser(sources, context, *streamer, *syntax));
  std::unique_ptr<MCTargetAsmParser> of_target(
      target.createMCAsmParser(*subtarget, *parser, *instructions, mc_options));
  parser->setTargetParser(*of_target);
  return parser->Run(/*NoInitialTextSection=*/false) ? kUsersFault : 0;
}

}  // namespace cc
