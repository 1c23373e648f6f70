// SPDX-License-Identifier: MIT
// A .s file to an object: LLVM reads lines, labels and directives, dspic30/llvm/asm_parser.cpp the
// instructions. A .S file goes through the preprocessor first.
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
#include "llvm/Support/Path.h"
#include "llvm/Support/SourceMgr.h"
#include "llvm/Support/raw_ostream.h"
#include "output_file.h"

namespace cc {

using namespace llvm;

namespace {

/// A file that a name means, whatever its case and its slashes; empty: there is none.
std::string file_below(const std::string& folder, StringRef name) {
  SmallString<128> at(folder);
  std::string rest = name.str();
  std::replace(rest.begin(), rest.end(), '\\', '/');
  if (sys::path::is_absolute(rest)) return sys::fs::is_regular_file(rest) ? rest : "";
  SmallVector<StringRef, 8> parts;
  StringRef(rest).split(parts, '/', -1, /*KeepEmpty=*/false);
  for (const StringRef part : parts) {
    SmallString<128> next(at);
    sys::path::append(next, part);
    std::error_code ec;
    if (!sys::fs::exists(next))
      for (sys::fs::directory_iterator it(at, ec), end; it != end && !ec; it.increment(ec))
        if (sys::path::filename(it->path()).equals_insensitive(part)) next = it->path();
    at = next;
  }
  return !parts.empty() && sys::fs::is_regular_file(at) ? at.str().str() : "";
}

/// `.include "E_Common.INC"` and .incbin say the file that is meant. Lines stay where they are.
/// `found`: those files.
std::string with_found_files(StringRef text, const std::vector<std::string>& folders,
                             std::vector<std::string>& found) {
  std::string out;
  while (!text.empty()) {
    const auto [line, rest] = text.split('\n');
    const StringRef statement = line.trim();
    const bool names_file =
        statement.startswith_insensitive(".include") || statement.startswith_insensitive(".incbin");
    const auto [before, quoted] = line.split('"');
    const auto [name, after] = quoted.split('"');
    std::string path;
    // as written; then, as for headers, by the end of what its author's PC had there
    for (std::string said = names_file ? name.str() : ""; path.empty() && !said.empty();) {
      for (const std::string& folder : folders)
        if (path.empty()) path = file_below(folder, said);
      const std::size_t slash = said.find_first_of("/\\");
      said.erase(0, slash == std::string::npos ? said.size() : slash + 1);
    }
    if (path.empty()) {
      out += line;
    } else {
      found.push_back(path);
      std::replace(path.begin(), path.end(), '\\', '/');
      out += (before + "\"" + path + "\"" + after).str();
    }
    if (text.size() > line.size()) out += '\n';
    text = rest;
  }
  return out;
}

std::vector<std::string> include_folders(const Options& options) {
  const StringRef beside = sys::path::parent_path(options.input);
  std::vector<std::string> folders = {beside.empty() ? "." : beside.str()};
  for (size_t i = 0; i < options.passed_on.size(); ++i) {
    StringRef word = options.passed_on[i];
    if (!word.consume_front("-I")) continue;
    if (word.empty() && i + 1 < options.passed_on.size()) word = options.passed_on[++i];
    folders.push_back(word.str());
  }
  return folders;
}

/// A rule with every file that was read.
bool write_depfile(const std::string& depfile, const std::string& input, const SourceMgr& sources,
                   const std::vector<std::string>& found) {
  OutputFile file(depfile);
  if (!file.is_open()) return false;
  raw_ostream& out = file.stream();
  const auto put = [&](StringRef name) {
    out << ' ';
    for (const char c : name) out << (c == ' ' ? "\\ " : std::string(1, c));
  };
  out << "x:";
  put(input);
  for (const std::string& name : found) put(name);
  for (unsigned i = 2; i <= sources.getNumBuffers(); ++i)
    if (const StringRef name = sources.getMemoryBuffer(i)->getBufferIdentifier(); sys::fs::exists(name))
      put(name);
  out << '\n';
  return file.finish();
}

/// Counts messages. The context has those of files behind a preprocessor with the line of their source, which
/// a handler of the SourceMgr does not get.
MCContext::DiagHandlerTy counted(const std::string& file) {
  return [file, told = 0u](const SMDiagnostic& message, bool, const SourceMgr&,
                           std::vector<const MDNode*>&) mutable {
    end_after_many(file, told);
    message.print(nullptr, errs());
  };
}

}  // namespace

int assemble_for_chip(const Options& options) {
  constexpr int kUsersFault = 1;
  const Target& target = dspic_target();
  const Triple triple(kDspicTriple);
  MCTargetOptions mc_options;
  std::unique_ptr<MCRegisterInfo> registers(target.createMCRegInfo(kDspicTriple));
  std::unique_ptr<MCAsmInfo> syntax(target.createMCAsmInfo(*registers, kDspicTriple, mc_options));
  std::unique_ptr<MCInstrInfo> instructions(target.createMCInstrInfo());
  std::unique_ptr<MCSubtargetInfo> subtarget(target.createMCSubtargetInfo(kDspicTriple, kDspicCpu, ""));

  if (!sys::fs::is_regular_file(options.input)) {  // a pipe would never end
    errs() << options.input << ": cannot read: expected a file\n";
    return kUsersFault;
  }
  // The text, preprocessed where its name says so, with the files that it includes found.
  auto text = MemoryBuffer::getFile(options.input);
  if (!text) {
    errs() << options.input << ": cannot read: " << text.getError().message() << "\n";
    return kUsersFault;
  }
  SourceMgr sources;
  const std::vector<std::string> folders = include_folders(options);
  std::vector<std::string> found;
  std::string source = (*text)->getBuffer().str();
  if (StringRef(options.input).endswith(".S") && !preprocess_assembler(options, source, found))
    return kUsersFault;
  sources.AddNewSourceBuffer(
      MemoryBuffer::getMemBufferCopy(with_found_files(source, folders, found), options.input), SMLoc());
  sources.setIncludeDirs(folders);
  mc_options.IASSearchPaths = folders;
  MCContext context(triple, syntax.get(), registers.get(), subtarget.get(), &sources, &mc_options);
  context.setDiagnosticHandler(counted(options.input));
  std::unique_ptr<MCObjectFileInfo> files(target.createMCObjectFileInfo(context, /*PIC=*/false));
  context.setObjectFileInfo(files.get());

  // LLVM's assembler writes the object as it reads.
  OutputFile out(options.output);
  if (!out.is_open()) return kUsersFault;
  std::unique_ptr<MCAsmBackend> backend(target.createMCAsmBackend(*subtarget, *registers, mc_options));
  auto writer = backend->createObjectWriter(out.stream());
  std::unique_ptr<MCCodeEmitter> encoder(target.createMCCodeEmitter(*instructions, *registers, context));
  std::unique_ptr<MCStreamer> streamer(target.createMCObjectStreamer(
      triple, context, std::move(backend), std::move(writer), std::move(encoder), *subtarget, false, false,
      /*DWARFMustBeAtTheEnd=*/false));
  streamer->emitFileDirective(sys::path::filename(options.input));
  std::unique_ptr<MCAsmParser> parser(createMCAsmParser(sources, context, *streamer, *syntax));
  std::unique_ptr<MCTargetAsmParser> of_target(
      target.createMCAsmParser(*subtarget, *parser, *instructions, mc_options));
  parser->setTargetParser(*of_target);
  const bool has_failed = parser->Run(/*NoInitialTextSection=*/false);
  if (!out.finish() || has_failed) return kUsersFault;
  // Who builds has to know what was read.
  const bool is_told =
      options.depfile.empty() || write_depfile(options.depfile, options.input, sources, found);
  return is_told ? 0 : kUsersFault;
}

}  // namespace cc
