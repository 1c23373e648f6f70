// SPDX-License-Identifier: MIT
// clang's preprocessor before the assembler, for .S files (upper case), as XC16 does it.
#include <set>

#include "chip.h"
#include "clang/Basic/TargetInfo.h"
#include "clang/Driver/Compilation.h"
#include "clang/Driver/Driver.h"
#include "clang/Driver/Tool.h"
#include "clang/Frontend/CompilerInstance.h"
#include "clang/Frontend/CompilerInvocation.h"
#include "clang/Frontend/FrontendActions.h"
#include "clang/Frontend/TextDiagnosticPrinter.h"
#include "clang/Frontend/Utils.h"
#include "clang/Lex/PPCallbacks.h"
#include "clang/Lex/Preprocessor.h"
#include "clang/Lex/PreprocessorOptions.h"
#include "dspic30/llvm/target.h"
#include "include_finder.h"
#include "include_messages.h"

namespace cc {
namespace {

using namespace clang;

/// `#include` of the vendor's own file, whose names the assembler knows, is the assembler's to read.
std::string with_device_files_left(llvm::StringRef text) {
  std::string out;
  while (!text.empty()) {
    const auto [line, rest] = text.split('\n');
    llvm::StringRef name = line.trim();
    const bool includes = name.consume_front("#") && (name = name.ltrim()).consume_front("include");
    name = name.trim().drop_front(name.trim().empty() ? 0 : 1).take_until([](char c) {
      return c == '"' || c == '>';
    });
    if (includes && llvm::is_dspic_device_file(name.str()))
      out += ".include \"" + name.str() + "\"";
    else
      out += line;
    if (text.size() > line.size()) out += '\n';
    text = rest;
  }
  return out;
}

/// Files that are read.
class Included : public PPCallbacks {
 public:
  explicit Included(std::vector<std::string>& found) : found_(found) {}
  void InclusionDirective(SourceLocation, const Token&, StringRef, bool, CharSourceRange,
                          const FileEntry* file, StringRef, StringRef, const Module*,
                          SrcMgr::CharacteristicKind) override {
    if (file) found_.push_back(file->getName().str());
  }

 private:
  std::vector<std::string>& found_;
};

class ToText : public PreprocessorFrontendAction {
 public:
  ToText(std::string& text, std::vector<std::string>& found) : text_(text), found_(found) {}
  bool BeginInvocation(CompilerInstance& ci) override {
    ci.setTarget(make_chip_target(ci.getInvocation().TargetOpts));
    return true;
  }
  bool BeginSourceFileAction(CompilerInstance& ci) override {
    ci.getPreprocessor().addPPCallbacks(std::make_unique<Included>(found_));
    return true;
  }
  void ExecuteAction() override {
    text_.clear();
    llvm::raw_string_ostream out(text_);
    DoPrintPreprocessedInput(getCompilerInstance().getPreprocessor(), &out,
                             getCompilerInstance().getPreprocessorOutputOpts());
  }

 private:
  std::string& text_;
  std::vector<std::string>& found_;
};

}  // namespace

bool preprocess_assembler(const Options& options, std::string& text, std::vector<std::string>& found) {
  std::vector<std::string> arguments = {"/usr/lib/llvm-14/bin/clang",
                                        "--target=msp430",
                                        "-E",
                                        "-x",
                                        "assembler-with-cpp",
                                        options.input,
                                        "-o",
                                        "-",
                                        "-nostdinc",
                                        "-undef",
                                        "-fno-caret-diagnostics",
                                        "-Qunused-arguments"};
  for (const char* macro : kVendorMacros) arguments.push_back(std::string("-D") + macro);
  for (const std::string& word : options.passed_on) arguments.push_back(word);
  std::vector<const char*> argv;
  for (const std::string& word : arguments) argv.push_back(word.c_str());

  // clang's driver makes the arguments of the preprocessor of these.
  IntrusiveRefCntPtr<DiagnosticOptions> of_driver = new DiagnosticOptions;
  DiagnosticsEngine diagnostics(new DiagnosticIDs, &*of_driver,
                                new TextDiagnosticPrinter(llvm::errs(), &*of_driver));
  driver::Driver driver(argv[0], "x86_64-pc-linux-gnu", diagnostics);
  driver.setCheckInputsExist(false);
  std::unique_ptr<driver::Compilation> compilation(driver.BuildCompilation(argv));
  if (!compilation || compilation->getJobs().empty() || diagnostics.hasErrorOccurred()) return false;
  auto invocation = std::make_shared<CompilerInvocation>();
  if (!CompilerInvocation::CreateFromArgs(*invocation, compilation->getJobs().begin()->getArguments(),
                                          diagnostics))
    return false;
  // The text comes from memory, and includes are found as for C.
  invocation->getPreprocessorOpts().addRemappedFile(
      options.input,
      llvm::MemoryBuffer::getMemBufferCopy(with_device_files_left(text), options.input).release());
  std::set<std::string> missing, refused;
  CompilerInstance ci;
  ci.setInvocation(invocation);
  ci.createDiagnostics(
      new IncludeMessages(llvm::errs(), &invocation->getDiagnosticOpts(), options.readable, refused));
  ci.setFileManager(
      new FileManager(FileSystemOptions(),
                      bounded_file_system(forgiving_file_system(options.fallback, options.project, missing),
                                          options.readable, refused)));
  ToText action(text, found);
  return ci.ExecuteAction(action);
}

}  // namespace cc
