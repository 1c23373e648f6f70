// SPDX-License-Identifier: MIT
// The last stage for the chip: names as the linker knows them, then the code generator.
#include <unistd.h>

#include <set>

#include "chip.h"
#include "dspic30/llvm/target.h"
#include "llvm/Analysis/TargetLibraryInfo.h"
#include "llvm/IR/DiagnosticHandler.h"
#include "llvm/IR/DiagnosticInfo.h"
#include "llvm/IR/LegacyPassManager.h"
#include "llvm/IR/Verifier.h"
#include "llvm/Support/CommandLine.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/SourceMgr.h"
#include "llvm/Support/raw_ostream.h"
#include "llvm/Target/TargetMachine.h"
#include "output_file.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

/// Options that only exist as flags of LLVM's command line.
void set_flags(const Options& o) {
  // what a loop may grow to when it is written out; measured: what makes delays of NOPs as long as XC16's.
  // For size as well: gcc writes out what two thirds of its rounds are no longer than
  const char* unrolled = o.for_size || o.level == 1 ? "-unroll-threshold=24" : "-unroll-threshold=40";
  const char* flags[] = {"twinpuck-cc",
                         // no speculation: a branch round a BSET must stay one
                         "-phi-node-folding-threshold=0", "-two-entry-phi-node-folding-threshold=0",
                         "-scalarize-load-store",
                         // a look-up in a table stays one: tests of the index in its place take longer here
                         "-instcombine-maxarray-size=0", unrolled,
                         // equal ends of blocks become one where size counts: the end of a loop and what
                         // stands before it would, and the loop lose its flags
                         o.level <= 1 ? "-enable-tail-merge=0" : "-enable-tail-merge=1",
                         // the gaps beside a local variable are its own as long as its function runs
                         o.sanitize ? "-no-stack-coloring=1" : "-no-stack-coloring=0"};
  cl::ParseCommandLineOptions(std::size(flags), flags);
}

/// XC16 puts an underscore before every name of C. "\1" says that nothing is to be added.
void add_underscores(Module& m) {
  const auto rename = [](GlobalValue& g) {
    const StringRef name = g.getName();
    if (name.empty() || name.startswith("\1") || name.startswith("llvm.") || g.hasPrivateLinkage()) return;
    g.setName("\1_" + name);
  };
  for (Function& f : m) rename(f);
  for (GlobalVariable& g : m.globals()) rename(g);
  for (GlobalAlias& a : m.aliases()) rename(a);
}

}  // namespace

void end_after_many(const std::string& file, unsigned& told) {
  constexpr unsigned kMost = 200;
  if (++told <= kMost) return;
  errs() << file << ": error: assembler: got more than " << kMost
         << " messages, expected fewer; does a macro use itself?\n";
  errs().flush();
  _exit(1);
}

namespace {

/// A line of assembler text, which a program may have made very long.
std::string shortened(StringRef line) {
  constexpr std::size_t kMost = 200;
  return line.size() > kMost ? (line.take_front(kMost) + " ...").str() : line.str();
}

/// Mistakes that show late, in assembler text of C or in what a function needs: each with its place, so that all of them
/// are told.
class LateMistakes : public DiagnosticHandler {
 public:
  LateMistakes(const Unit& unit, bool& has_failed) : unit_(unit), has_failed_(has_failed) {}

  bool handleDiagnostics(const DiagnosticInfo& info) override {
    if (const auto* of_parser = dyn_cast<DiagnosticInfoSrcMgr>(&info)) {
      const SMDiagnostic& d = of_parser->getSMDiag();
      const char* kind = d.getKind() == SourceMgr::DK_Error     ? "error"
                         : d.getKind() == SourceMgr::DK_Warning ? "warning"
                                                                : "note";
      has_failed_ |= d.getKind() == SourceMgr::DK_Error;
      // of code that is nobody's text: told once, however often it stands there
      if (!d.getLoc().isValid() && d.getLineContents().empty()) {
        if (told_of_code_.insert(d.getMessage().str()).second)
          errs() << unit_.options.input << ": " << kind << ": " << d.getMessage() << "\n";
        return true;
      }
      end_after_many(unit_.options.input, told_);
      errs() << place(of_parser->getLocCookie(), &d) << ": " << kind << ": " << d.getMessage()
             << "; in asm(\"" << shortened(d.getLineContents().trim()) << "\")\n";
      return true;
    }
    if (const auto* of_operands = dyn_cast<DiagnosticInfoInlineAsm>(&info)) {
      has_failed_ |= info.getSeverity() == DS_Error;
      errs() << place(of_operands->getLocCookie(), nullptr) << ": "
             << (info.getSeverity() == DS_Error ? "error" : "warning")
             << ": asm: " << of_operands->getMsgStr() << "\n";
      return true;
    }
    if (const auto* of_function = dyn_cast<DiagnosticInfoUnsupported>(&info)) {
      const Function& f = of_function->getFunction();
      StringRef name = f.getName(), file = f.getParent()->getSourceFileName();
      unsigned line = 1, column = 0;
      if (of_function->isLocationAvailable()) of_function->getLocation(file, line, column);
      name.consume_front("\1_");
      has_failed_ = true;
      errs() << file << ":" << line << ": error: " << name << "() " << of_function->getMessage() << "\n";
      return true;
    }
    return false;
  }

 private:
  std::string place(std::uint64_t number, const SMDiagnostic* of_text) const {
    const auto& known = unit_.facts.assembler_places;
    if (number > 0 && number <= known.size()) return known[number - 1];
    // asm() outside functions has none: that which has the line
    std::string found = unit_.options.input;
    const unsigned line = of_text && of_text->getSourceMgr() ? line_of(*of_text) : 0;
    for (const auto& [first, at] : unit_.facts.assembler_texts)
      if (first <= line) found = at;
    return found;
  }
  /// In the text itself, wherever a macro or a file of it may be.
  static unsigned line_of(const SMDiagnostic& d) {
    const SourceMgr& sources = *d.getSourceMgr();
    SMLoc at = d.getLoc();
    for (unsigned buffer = sources.FindBufferContainingLoc(at); buffer;
         buffer = sources.FindBufferContainingLoc(at)) {
      const SMLoc from = sources.getParentIncludeLoc(buffer);
      if (!from.isValid()) return sources.FindLineNumber(at, buffer);
      at = from;
    }
    return 0;
  }
  const Unit& unit_;
  bool& has_failed_;
  unsigned told_ = 0;
  std::set<std::string> told_of_code_;
};

std::unique_ptr<TargetMachine> make_machine(const Options& o) {
  TargetOptions options;
  // "None" would split what must be one instruction: LATAbits.LATA6 = 1
  const auto level = o.level == 0 ? CodeGenOpt::Less : CodeGenOpt::Default;
  return std::unique_ptr<TargetMachine>(
      dspic_target().createTargetMachine(kDspicTriple, kDspicCpu, "", options, None, None, level));
}

bool write(Module& m, const Unit& unit, TargetMachine& machine) {
  const Options& o = unit.options;
  OutputFile out(o.output);
  if (!out.is_open()) return false;
  if (o.emit_ir) {
    m.print(out.stream(), nullptr);
    return out.finish();
  }
  bool has_failed = false;
  {
    legacy::PassManager passes;  // holds what is not yet written of a text
    TargetLibraryInfoImpl library(Triple(m.getTargetTriple()));
    library.disableAllFunctions();
    passes.add(new TargetLibraryInfoWrapperPass(library));
    const auto kind = o.emit_text ? CGFT_AssemblyFile : CGFT_ObjectFile;
    if (machine.addPassesToEmitFile(passes, out.stream(), nullptr, kind)) return false;
    m.getContext().setDiagnosticHandler(std::make_unique<LateMistakes>(unit, has_failed));
    passes.run(m);
  }
  return out.finish() && !has_failed;
}

}  // namespace

int compile_for_chip(Unit& unit) {
  constexpr int kUsersFault = 1, kOurFault = 6;
  Module& m = unit.module;
  set_flags(unit.options);
  auto machine = make_machine(unit.options);
  if (!lower_for_chip(unit)) return kUsersFault;
  if (unit.options.sanitize && !unit.options.library) prepare_checks(unit);
  optimise_for_chip(unit, *machine);
  stop_where_undefined(m);
  add_underscores(m);
  if (verifyModule(m, &errs())) {
    errs() << unit.options.input << ": internal error: malformed code after the pipeline\n";
    return kOurFault;
  }
  return write(m, unit, *machine) ? 0 : kUsersFault;
}

}  // namespace cc
