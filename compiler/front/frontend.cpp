// SPDX-License-Identifier: MIT
// clang as a library, for the chip's target. What XC16 accepts and clang would refuse (the interrupt
// attribute above all) is renamed here, token by token.
#include "frontend.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "chip.h"
#include "clang/AST/ASTConsumer.h"
#include "clang/AST/ASTContext.h"
#include "clang/AST/Attr.h"
#include "clang/AST/Decl.h"
#include "clang/AST/Expr.h"
#include "clang/AST/Stmt.h"
#include "clang/Basic/TargetInfo.h"
#include "clang/CodeGen/CodeGenAction.h"
#include "clang/Driver/Compilation.h"
#include "clang/Driver/Driver.h"
#include "clang/Driver/Tool.h"
#include "clang/Frontend/CompilerInstance.h"
#include "clang/Frontend/CompilerInvocation.h"
#include "clang/Frontend/MultiplexConsumer.h"
#include "clang/Frontend/TextDiagnosticPrinter.h"
#include "clang/Lex/PPCallbacks.h"
#include "clang/Lex/Preprocessor.h"
#include "compiler/cache/crash_words.h"
#include "field_widths.h"
#include "forward_calls.h"
#include "implicit_functions.h"
#include "include_finder.h"
#include "include_messages.h"
#include "llvm/IR/Constants.h"
#include "llvm/IR/Metadata.h"
#include "llvm/Support/Host.h"
#include "llvm/Support/raw_ostream.h"
#include "output_file.h"
#include "program_checks.h"
#include "refused.h"
#include "token_watch.h"
#include "union_values.h"

namespace cc {
namespace {

using namespace clang;

/// Refuses headers of an operating system, and writes down every file read.
class IncludeWatch : public PPCallbacks {
 public:
  IncludeWatch(CompilerInstance& ci, const Options& options, const std::set<std::string>& refused)
      : ci_(ci), options_(options), refused_(refused) {}
  void InclusionDirective(SourceLocation, const Token&, StringRef name, bool, CharSourceRange range,
                          const FileEntry* file, StringRef, StringRef, const Module*,
                          SrcMgr::CharacteristicKind) override {
    if (options_.webots && file) return;  // the library behind Webots' interfaces has some of them
    if (const char* instead = refused_header(name)) {
      auto& d = ci_.getDiagnostics();
      d.Report(range.getBegin(), d.getCustomDiagID(DiagnosticsEngine::Fatal,
                                                   "#include <%0>: a robot has no operating system; %1"))
          << name << instead;
    } else if (!file && !is_refused(refused_, name)) {
      auto folders = options_.fallback;
      if (!options_.project.empty()) folders.push_back(options_.project);
      const std::string guess = header_like(name.str(), folders);
      auto& d = ci_.getDiagnostics();
      if (!guess.empty())
        d.Report(range.getBegin(), d.getCustomDiagID(DiagnosticsEngine::Note, "did you mean '%0'?")) << guess;
    }
  }

 private:
  CompilerInstance& ci_;
  const Options& options_;
  const std::set<std::string>& refused_;  // include_messages.h
};

/// Turns declarations into what the chip has of them.
class DeclarationConsumer : public ASTConsumer {
 public:
  DeclarationConsumer(const Options& options, Facts& facts)
      : checks_(!options.library && !options.weak), strict_(options.lint), facts_(facts) {}
  void Initialize(ASTContext& context) override { context_ = &context; }
  bool HandleTopLevelDecl(DeclGroupRef group) override {
    // an erroneous expression may have no type
    if (context_->getDiagnostics().hasErrorOccurred()) return true;
    for (Decl* decl : group) {
      note_place(place_text(context_->getSourceManager(), decl->getLocation()));  // its code is made next
      if (auto* text = dyn_cast<FileScopeAsmDecl>(decl)) place_text_of(*text);
      if (auto* var = dyn_cast<VarDecl>(decl)) make_register(var);
      compute_in_field_widths(decl, *context_);
      clear_unions(decl, *context_);
      note_accumulators(decl, *context_);
    }
    place_variables(*context_);
    return true;
  }
  void HandleTranslationUnit(ASTContext& context) override {
    note_place("");  // what follows looks at the whole file
    if (checks_ && !context.getDiagnostics().hasErrorOccurred()) check_program(context, strict_);
  }
  void HandleTopLevelDeclInObjCContainer(DeclGroupRef) override {}

 private:
  void place_text_of(const FileScopeAsmDecl& assembler) {
    const StringRef text = assembler.getAsmString()->getString();
    facts_.assembler_texts.emplace_back(
        assembler_lines_ + 1,
        place_text(context_->getSourceManager(), assembler.getAsmString()->getBeginLoc()));
    assembler_lines_ += unsigned(text.count('\n')) + (text.endswith("\n") ? 0 : 1);
  }
  /// A variable that the program puts into a register's place is that register.
  void make_register(VarDecl* var) {
    auto* section = var->getAttr<SectionAttr>();
    if (!section || !section->getName().startswith("tp_sfr_")) return;
    var->addAttr(AsmLabelAttr::CreateImplicit(*context_, section->getName(), /*IsLiteralLabel*/ true));
    var->dropAttr<SectionAttr>();
    var->setStorageClass(SC_Extern);
  }
  const bool checks_, strict_;  // program_checks.h
  Facts& facts_;
  unsigned assembler_lines_ = 0;
  ASTContext* context_ = nullptr;
};

/// Inside __attribute__((...)) some names mean something else to clang or need a special signature there.
class AttributeFilter {
 public:
  explicit AttributeFilter(Preprocessor& pp) : pp_(pp) {}
  void operator()(const Token& token) {
    if (token.is(tok::kw___attribute)) {
      armed_ = true;
      depth_ = 0;
      return;
    }
    if (!armed_) return;
    if (token.is(tok::l_paren)) ++depth_;
    if (token.is(tok::r_paren) && --depth_ <= 0) armed_ = false;
    if (token.is(tok::eof)) armed_ = false;
    if (depth_ == 3 && token.is(tok::numeric_constant)) return name_section(token);
    if (!token.is(tok::identifier) && !token.isAnyIdentifier()) return;
    const IdentifierInfo* name = token.getIdentifierInfo();
    if (!name) return;
    const StringRef bare = name->getName().trim('_');
    if (depth_ == 3)
      for (const char* known : {"save", "preprologue", "irq", "altirq"})  // of an interrupt: "functions"
        if (bare == known) return rename(token, kAttributePrefix + bare.str());
    if (depth_ != 2) return;
    section_ = section_for(bare, token);
    if (!section_.empty()) return rename(token, "section");
    for (const char* known :
         {"interrupt",   "signal",      "address", "space",  "near", "far",     "shadow", "persistent",
          "preprologue", "fillupper",   "secure",  "boot",   "sfr",  "reverse", "eds",    "unordered",
          "auto_psv",    "no_auto_psv", "keep",    "update", "save", "irq",     "altirq", "context"})
      if (bare == known) {
        rename(token, kAttributePrefix + bare.str());
        return;
      }
  }

 private:
  /// The parser takes attributes it does not know with any arguments, and drops them.
  void rename(const Token& token, const std::string& name) {
    const_cast<Token&>(token).setIdentifierInfo(&pp_.getIdentifierTable().get(name));
  }
  /// What follows a token in its file, without blanks, brackets and underscores.
  const char* text_behind(const Token& token) const {
    const auto& sources = pp_.getSourceManager();
    const char* at =
        sources.getCharacterData(sources.getSpellingLoc(token.getLocation())) + token.getLength();
    while (*at == ' ' || *at == '\t' || *at == '(' || *at == '_') ++at;
    return at;
  }

  /// sfr(0x2C4) and address(0x2C4) are a register's; "" for other attributes.
  std::string section_for(StringRef attribute, const Token& token) const {
    const StringRef argument = text_behind(token);
    if (attribute != "sfr" && attribute != "address") return "";
    const unsigned long address = std::strtoul(argument.data(), nullptr, 0);
    if (address == 0 || address >= kRegistersEnd) return "";
    char name[24];
    std::snprintf(name, sizeof name, "\"tp_sfr_%04lX\"", address);
    return name;
  }
  /// Makes the attribute's argument the name of its section.
  void name_section(const Token& token) {
    if (section_.empty()) return;
    const std::string& kept = *names_.insert(section_).first;
    auto& argument = const_cast<Token&>(token);
    argument.setKind(tok::string_literal);
    argument.setLiteralData(kept.data());
    argument.setLength(unsigned(kept.size()));
    section_.clear();
  }

  static constexpr unsigned long kRegistersEnd = 0x800;  // of special-function registers, bytes
  Preprocessor& pp_;
  bool armed_ = false;
  int depth_ = 0;
  std::string section_;  // of the attribute that is being read
  std::set<std::string> names_;
};

/// #pragma config NAME = VALUE, ...: settings of the configuration words; the values have the names of the
/// device header's macros, each a mask that clears what the choice clears.
class ConfigPragma : public PragmaHandler {
 public:
  explicit ConfigPragma(Facts& facts) : PragmaHandler("config"), facts_(facts) {}
  void HandlePragma(Preprocessor& pp, PragmaIntroducer, Token&) override {
    Token t;
    for (pp.LexUnexpandedToken(t); t.isAnyIdentifier(); pp.LexUnexpandedToken(t)) {
      const StringRef setting = t.getIdentifierInfo()->getName();
      pp.LexUnexpandedToken(t);
      if (t.isNot(tok::equal)) return;
      pp.LexUnexpandedToken(t);
      const char* word = setting == "FOSFPR" || setting == "FCKSMEN"                    ? "fosc"
                         : setting == "WDT" || setting == "FWPSA" || setting == "FWPSB" ? "fwdt"
                                                                                        : nullptr;
      const MacroInfo* macro = t.isAnyIdentifier() ? pp.getMacroInfo(t.getIdentifierInfo()) : nullptr;
      unsigned mask = 0;
      if (word && macro && macro->getNumTokens() == 1 &&
          !StringRef(pp.getSpelling(macro->getReplacementToken(0))).getAsInteger(0, mask)) {
        auto [place, is_new] = facts_.configuration.emplace(word, mask);
        if (!is_new) place->second &= mask;
      }
      pp.LexUnexpandedToken(t);
      if (t.isNot(tok::comma)) return;
    }
  }

 private:
  Facts& facts_;
};

class RobotAction : public EmitLLVMOnlyAction {
 public:
  RobotAction(llvm::LLVMContext& context, Facts& facts, const Options& options,
              const std::set<std::string>& refused)
      : EmitLLVMOnlyAction(&context), facts_(facts), options_(options), refused_(refused) {}
  bool BeginInvocation(CompilerInstance& ci) override {
    ci.setTarget(make_chip_target(ci.getInvocation().TargetOpts));
    return EmitLLVMOnlyAction::BeginInvocation(ci);
  }
  bool BeginSourceFileAction(CompilerInstance& ci) override {
    auto& pp = ci.getPreprocessor();
    pp.addPPCallbacks(std::make_unique<IncludeWatch>(ci, options_, refused_));
    pp.AddPragmaHandler(new ConfigPragma(facts_));
    filter_ = std::make_shared<AttributeFilter>(pp);
    watch_ = std::make_shared<TokenWatch>(pp);
    pp.setTokenWatcher([f = filter_, w = watch_](const Token& token) {
      (*w)(token);
      (*f)(token);
    });
    if (!options_.library) ci.setExternalSemaSource(implicit_functions(options_.strict || options_.lint));
    return EmitLLVMOnlyAction::BeginSourceFileAction(ci);
  }
  std::unique_ptr<ASTConsumer> CreateASTConsumer(CompilerInstance& ci, StringRef file) override {
    std::vector<std::unique_ptr<ASTConsumer>> all;
    all.push_back(std::make_unique<DeclarationConsumer>(options_, facts_));
    all.push_back(EmitLLVMOnlyAction::CreateASTConsumer(ci, file));
    return std::make_unique<MultiplexConsumer>(std::move(all));
  }

 private:
  Facts& facts_;
  const Options& options_;
  const std::set<std::string>& refused_;
  std::shared_ptr<AttributeFilter> filter_;
  std::shared_ptr<TokenWatch> watch_;
};

// another chip of 16 bits for the driver; target.cpp is what the compiler itself gets. DWARF 3: its
// addresses are all absolute, so the linker can make program addresses of them
const std::vector<const char*> kForChip = {"--target=msp430", "-ffreestanding", "-fno-builtin", "-gdwarf-3"};

std::vector<std::string> clang_arguments(const Options& o, const std::string& standard) {
  // C as XC16's gcc has it, without clang's passes, and without warnings about what old programs do freely.
  std::vector<std::string> a = {"/usr/lib/llvm-14/bin/clang",
                                "-c",
                                "-x",  // whatever the name says: MAIN.C would be C++
                                "c",
                                o.input,
                                "-o",
                                o.output,
                                "-std=" + standard,
                                "-fcommon",
                                "-fsigned-char",
                                "-fno-strict-aliasing",
                                "-fno-delete-null-pointer-checks",
                                "-fno-finite-loops",
                                "-fno-stack-protector",
                                "-ffp-contract=off",
                                "-g",
                                "-fno-short-enums",
                                "-fno-caret-diagnostics",
                                "-Qunused-arguments",
                                "-nostdinc",
                                "-Xclang",
                                "-disable-llvm-passes",
                                "-Xclang",
                                "-disable-lifetime-markers",
                                "-Wno-unknown-attributes",
                                "-Wno-ignored-attributes",
                                "-Wno-unknown-pragmas",
                                "-Wno-c99-extensions",
                                "-Wno-gnu-binary-literal",
                                "-Wno-main-return-type",
                                "-Wno-builtin-requires-header",
                                "-Wno-incompatible-library-redeclaration",
                                "-Wno-implicit-int",
                                "-Wno-asm-operand-widths",
                                "-Wno-typedef-redefinition",
                                "-Wno-pointer-sign",
                                "-Wno-invalid-source-encoding",
                                "-Wno-nonportable-include-path",
                                "-Wno-comment",
                                "-Wno-empty-body",
                                "-Wno-newline-eof",
                                "-Wno-error=return-type",
                                "-Wno-gnu-designator"};
  a.insert(a.end(), kForChip.begin(), kForChip.end());
  a.push_back("-funroll-loops");  // what the optimiser may, not what it does (emit.cpp)
  if (o.level == 0) a.insert(a.end(), {"-Xclang", "-disable-O0-optnone"});
  a.push_back("-fgnu89-inline");
  a.push_back(o.level == 0 ? "-O0" : o.for_size ? "-Os" : o.level == 1 ? "-O1" : "-O2");
  if (o.sanitize && !o.library) {
    a.push_back("-fsanitize=signed-integer-overflow,shift-exponent,array-bounds");
    a.push_back("-fsanitize-recover=all");
  } else {
    a.push_back("-fwrapv");
  }
  // what is a fault wherever it stands; the strict ones ask for more than old programs can give
  if (!o.library && !o.weak)
    for (const char* w :
         {"-Wuninitialized", "-Wsometimes-uninitialized", "-Winfinite-recursion", "-Warray-bounds",
          "-Wdivision-by-zero", "-Winteger-overflow", "-Wself-assign", "-Wparentheses", "-Wunused-comparison",
          "-Wtautological-constant-out-of-range-compare", "-Wtautological-compare", "-Wfor-loop-analysis",
          "-Wsizeof-pointer-memaccess", "-Wstrncat-size", "-Wreturn-type", "-Wreturn-stack-address",
          "-Wnull-dereference", "-Wbool-operation", "-Wshift-count-overflow"})
      a.push_back(w);
  // what is worth a look, for who asks for it
  if (o.strict || o.lint)
    for (const char* w :
         {"-Wall", "-Wextra", "-Wimplicit-function-declaration", "-Wshadow", "-Wwrite-strings",
          "-Wfloat-conversion", "-Wshorten-64-to-32", "-Wsign-compare", "-Wno-unused-parameter"})
      a.push_back(w);
  for (const char* d : kVendorMacros) a.push_back(std::string("-D") + d);
  for (const auto& p : o.passed_on) a.push_back(p);
  a.push_back(std::string("-I") + kFallbackRoot);
  return a;
}

}  // namespace

namespace {

/// Appends to what earlier attempts looked for in vain.
bool note_missing(const std::string& file, const std::set<std::string>& missing) {
  OutputFile out(file, llvm::sys::fs::OF_Append);
  if (!out.is_open()) return false;
  for (const llvm::StringRef name : missing)
    if (!name.startswith(kFallbackRoot) && !name.startswith(kVendorRoot)) out.stream() << name << "\n";
  return out.finish();
}

/// What clang notes of assembler text in C are numbers that it alone can read: they become places in `facts`,
/// one a line of the text, counted from 1.
void place_assembler(llvm::Module& module, const SourceManager& sources, Facts& facts) {
  const auto number = [&](const llvm::MDOperand& of_clang) {
    const auto* raw = llvm::mdconst::dyn_extract<llvm::ConstantInt>(of_clang);
    facts.assembler_places.push_back(
        raw ? place_text(sources,
                         SourceLocation::getFromRawEncoding(SourceLocation::UIntTy(raw->getZExtValue())))
            : "");
    return llvm::ConstantAsMetadata::get(
        llvm::ConstantInt::get(llvm::Type::getInt64Ty(module.getContext()), facts.assembler_places.size()));
  };
  for (llvm::Function& f : module)
    for (llvm::BasicBlock& block : f)
      for (llvm::Instruction& i : block) {
        const llvm::MDNode* places = i.getMetadata("srcloc");
        if (!places) continue;
        std::vector<llvm::Metadata*> numbers;
        for (const llvm::MDOperand& place : places->operands()) numbers.push_back(number(place));
        i.setMetadata("srcloc", llvm::MDNode::get(module.getContext(), numbers));
      }
}

constexpr const char* kDeclarations = "/twinpuck-forward-declarations.h";

/// One attempt in one standard of C; `declarations` go in front of the file. Messages go to `out`.
std::unique_ptr<llvm::Module> attempt(const Options& options, llvm::LLVMContext& context, Facts& facts,
                                      const std::string& standard, const std::string& declarations,
                                      llvm::raw_ostream& out) {
  IntrusiveRefCntPtr<DiagnosticOptions> diagnostic_options = new DiagnosticOptions;
  auto* printer = new TextDiagnosticPrinter(out, &*diagnostic_options);
  printer->setPrefix(options.input);  // of the options: no line has them
  DiagnosticsEngine diagnostics(new DiagnosticIDs, &*diagnostic_options, printer);
  auto arguments = clang_arguments(options, standard);
  if (!declarations.empty()) {
    arguments.push_back("-include");
    arguments.push_back(kDeclarations);
  }
  std::vector<const char*> argv;
  for (const auto& s : arguments) argv.push_back(s.c_str());
  driver::Driver driver(argv[0], "x86_64-pc-linux-gnu", diagnostics);
  driver.setCheckInputsExist(false);
  std::unique_ptr<driver::Compilation> compilation(driver.BuildCompilation(argv));
  if (!compilation || compilation->getJobs().empty() || diagnostics.hasErrorOccurred()) return nullptr;
  auto invocation = std::make_shared<CompilerInvocation>();
  const auto& cc1 = compilation->getJobs().begin()->getArguments();
  if (!CompilerInvocation::CreateFromArgs(*invocation, cc1, diagnostics)) return nullptr;
  if (!options.depfile.empty()) {
    auto& dep = invocation->getDependencyOutputOpts();
    dep.OutputFile = options.depfile;
    dep.Targets = {"x"};
    dep.IncludeSystemHeaders = true;
    dep.UsePhonyTargets = false;
  }
  // the virtual root must look like a folder, or clang drops it from the include path
  auto memory = llvm::makeIntrusiveRefCnt<llvm::vfs::InMemoryFileSystem>();
  memory->addFile(std::string(kFallbackRoot) + "/.root", 0, llvm::MemoryBuffer::getMemBuffer(""));
  memory->addFile(std::string(kVendorRoot) + "/.root", 0, llvm::MemoryBuffer::getMemBuffer(""));
  if (!declarations.empty())
    memory->addFile(kDeclarations, 0, llvm::MemoryBuffer::getMemBufferCopy(declarations));
  std::set<std::string> missing, refused;
  auto overlay = llvm::makeIntrusiveRefCnt<llvm::vfs::OverlayFileSystem>(bounded_file_system(
      forgiving_file_system(options.fallback, options.project, missing), options.readable, refused));
  overlay->pushOverlay(memory);
  CompilerInstance ci;
  ci.setInvocation(invocation);
  ci.createDiagnostics(new IncludeMessages(out, &invocation->getDiagnosticOpts(), options.readable, refused));
  ci.setFileManager(new FileManager(FileSystemOptions(), overlay));
  RobotAction action(context, facts, options, refused);
  const bool is_done = ci.ExecuteAction(action);
  if (!options.depfile.empty() && !note_missing(options.depfile + ".missing", missing)) return nullptr;
  auto module = is_done ? action.takeModule() : nullptr;
  if (module) place_assembler(*module, ci.getSourceManager(), facts);
  return module;
}

/// Attempts as the file stands, then with declarations of its own functions that it lacks.
std::unique_ptr<llvm::Module> attempts(const Options& options, llvm::LLVMContext& context, Facts& facts,
                                       const std::string& standard, std::string& messages) {
  llvm::raw_string_ostream said(messages);
  facts = Facts();
  auto source = llvm::MemoryBuffer::getFile(options.input);
  if (!source) {
    messages = options.input + ": cannot read: " + source.getError().message() + "\n";
    return nullptr;
  }
  auto module = attempt(options, context, facts, standard, "", said);
  said.flush();
  if (module) return module;
  const std::string declarations = forward_declarations(messages, (*source)->getBuffer().str());
  if (declarations.empty()) return nullptr;
  const std::string without = std::exchange(messages, "");
  facts = Facts();
  module = attempt(options, context, facts, standard, declarations, said);
  said.flush();
  // the program's own lines, not ours, say what is wrong
  if (!module && messages.find(kDeclarations) != std::string::npos) messages = without;
  return module;
}

}  // namespace

std::unique_ptr<llvm::Module> compile_to_module(const Options& options, llvm::LLVMContext& context,
                                                Facts& facts) {
  const std::string first = !options.standard.empty() ? options.standard : options.webots ? "gnu11" : "gnu89";
  std::string messages;
  auto module = attempts(options, context, facts, first, messages);
  if (!module && options.standard.empty() && !options.webots) {
    // what XC16 takes with -std=gnu99 only: a variable of each loop's own, for one
    std::string messages_of_c99;
    module = attempts(options, context, facts, "gnu99", messages_of_c99);
    if (module) messages = messages_of_c99;
  }
  llvm::errs() << messages;
  return module;
}

}  // namespace cc
