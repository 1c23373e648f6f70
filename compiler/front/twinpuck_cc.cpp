// SPDX-License-Identifier: MIT
// twinpuck-cc -c x.c -o x.o: one C or assembler file to one object of the robot's dsPIC30F6014A. twinpuck-cc
// --link: objects to an image.
#include <unistd.h>

#include "chip.h"
#include "compiler/cache/crash_words.h"
#include "compiler/cache/memory_limit.h"
#include "dspic30/link/link.h"
#include "dspic30/llvm/target.h"
#include "install/places.h"
#include "llvm/Support/ErrorHandling.h"
#include "llvm/Support/raw_ostream.h"
#include "passes.h"

namespace {

using namespace llvm;

bool parse(int argc, char** argv, cc::Options& o) {
  std::vector<std::string> readable;
  for (int i = 1; i < argc; ++i) {
    StringRef a = argv[i];
    auto value = [&]() -> std::string { return i + 1 < argc ? argv[++i] : ""; };
    if (a == "-c")
      continue;
    else if (a == "-o")
      o.output = value();
    else if (a == "-O0")
      o.level = 0;
    else if (a == "-O" || a == "-O1")
      o.level = 1;
    else if (a == "-O2" || a == "-O3")
      o.level = 2;
    else if (a == "-Os")
      o.level = 2, o.for_size = true;
    else if (a == "--sanitize")
      o.sanitize = true;
    else if (a == "--strict")
      o.strict = true;
    else if (a == "--lint")
      o.lint = true;
    else if (a == "-S")
      o.emit_text = true;
    else if (a == "--webots")
      o.webots = true;
    else if (a == "--library")
      o.library = true;
    else if (a == "--weak")
      o.weak = true;
    else if (a == "--emit-ir")
      o.emit_ir = true;
    else if (a == "--project")
      o.project = value();
    else if (a == "--within")
      readable.push_back(value());
    else if (a.startswith("-std="))
      o.standard = a.substr(5).str();
    else if (a == "--depfile")
      o.depfile = value();
    else if (a == "--facts")
      o.facts = value();
    else if (a.consume_front("--shared=")) {
      o.has_shared = true;
      SmallVector<StringRef, 8> nodes;
      a.split(nodes, ',', -1, /*KeepEmpty=*/false);
      for (StringRef n : nodes) o.shared.push_back(n.str());
    } else if (a == "--fallback")
      o.fallback.push_back(value());
    else if (a == "-I" || a == "-D" || a == "-U" || a == "-include") {
      o.passed_on.push_back(a.str());
      o.passed_on.push_back(value());
    } else if (a.startswith("-I") || a.startswith("-D") || a.startswith("-U") || a.startswith("-W") ||
               a.startswith("-g") || a.startswith("-f")) {
      o.passed_on.push_back(a.str());
    } else if (a.startswith("-")) {
      errs() << "twinpuck-cc: command line: got " << a << ", expected a known option\n";
      return false;
    } else if (o.input.empty()) {
      o.input = a.str();
    } else {
      errs() << "twinpuck-cc: command line: got a second file " << a << ", expected one\n";
      return false;
    }
  }
  o.readable = cc::ReadableFiles(readable);
  if (o.fallback.empty())  // called by hand: the library's and the libc's headers after all others
    for (const char* folder : {"firmware/include", "firmware/libc/include"})
      o.passed_on.push_back("-I" + (places::product_share() / folder).string());
  if (o.input.empty() || o.output.empty()) {
    errs() << "usage: twinpuck-cc -c x.c -o x.o [-O0|-O1|-O2|-Os] [-I..] [-D..] [--sanitize] [--strict]\n";
    return false;
  }
  return true;
}

/// What is too large ends with a message, whichever way it asks for memory, and so does what takes too long.
void limit_use(const std::string& what) {
  cc::limit_own_memory(what);
  cc::limit_own_time(what);
  cc::tell_crashes(what);
  install_bad_alloc_error_handler([](void*, const char*, bool) { cc::end_without_memory(); });
}

/// LLVM and clang end the process where a disk refuses what they write; that is nobody's fault of theirs.
void tell_refused_output() {
  install_fatal_error_handler([](void*, const char* reason, bool) {
    StringRef text = reason;
    if (text.consume_front("IO failure on output stream: ")) {
      errs() << "twinpuck-cc: output: got " << text << ", expected files that can be written\n";
      _exit(1);
    }
    errs() << "LLVM ERROR: " << text << "\n";
  });
}

/// "DRIVER:NAME=NUMBER" or "DRIVER:NAME": the driver, and what is told of it.
dspic::link::HostDriver& host_driver(dspic::link::Options& o, StringRef text, std::string& name,
                                     unsigned& number) {
  const auto [driver, rest] = text.split(':');
  const auto [of, value] = rest.split('=');
  name = of.str();
  number = 0;
  value.getAsInteger(0, number);
  for (auto& known : o.host)
    if (known.name == driver) return known;
  o.host.push_back({driver.str(), {}, {}, {}, {}});
  return o.host.back();
}

/// twinpuck-cc --link -o x.elf a.o b.o [--library c.o]... [--driver d.o]... [--source O=C]... [--heap N]
///   of drivers that the host can fill: [--host-library A.a] [--host DRIVER:FUNCTION=PLACE]...
///     [--host-shortcut DRIVER:FUNCTION=PLACE]... [--register DRIVER:VARIABLE=BYTES]...
///     [--owned DRIVER:T2CON]...; --fill SUM fills them
///   --no-texts: neither .lst nor .map; --within FOLDER: the .lst quotes no other files
int link(int argc, char** argv) {
  dspic::link::Options o;
  std::vector<std::string> readable;
  o.moved_from = places::kUsualShare;
  o.moved_to = places::product_share().string();
  for (int i = 2; i < argc; ++i) {
    const StringRef a = argv[i];
    const auto value = [&]() -> std::string { return i + 1 < argc ? argv[++i] : ""; };
    if (a == "-o")
      o.output = value();
    else if (a == "--library")
      o.libraries.push_back(value());
    else if (a == "--driver")
      o.drivers.push_back(value());
    else if (a == "--source" || a == "--rename" || a == "--rename-library") {
      const std::string pair = value();
      const auto [from, to] = StringRef(pair).split('=');
      auto& pairs = a == "--source" ? o.sources : a == "--rename" ? o.renames : o.library_renames;
      pairs[from.str()] = to.str();
    } else if (a == "--host" || a == "--host-shortcut" || a == "--register" || a == "--owned") {
      std::string name;
      unsigned number;
      auto& driver = host_driver(o, value(), name, number);
      if (a == "--host")
        driver.functions[name] = number;
      else if (a == "--host-shortcut")
        driver.shortcuts[name] = number;
      else if (a == "--register")
        driver.registers.emplace_back(name, number);
      else
        driver.owned.insert(name);
    } else if (a == "--host-library") {
      o.libraries.push_back(value());
      o.host_library = o.libraries.back();
    } else if (a == "--within") {
      readable.push_back(value());
    } else if (a == "--no-texts") {
      o.with_texts = false;
    } else if (a == "--fill") {
      o.is_filled_by_host = true;
      o.host_table = std::uint32_t(std::strtoul(value().c_str(), nullptr, 0));
    } else if (a == "--library-level") {
      o.library_level = unsigned(std::strtoul(value().c_str(), nullptr, 0));
    } else if (a == "--gap") {
      o.gap_bytes = unsigned(std::strtoul(value().c_str(), nullptr, 0));
    } else if (a == "--heap")
      o.heap_bytes = unsigned(std::strtoul(value().c_str(), nullptr, 0));
    else
      o.inputs.push_back(a.str());
  }
  if (o.output.empty() || o.inputs.empty()) {
    errs() << "usage: twinpuck-cc --link -o x.elf a.o b.o [--library c.o]... [--driver d.o]... [--source "
              "O=C]... [--rename FROM=TO]... [--heap "
              "BYTES]\n";
    return 2;
  }
  o.may_quote = [files = cc::ReadableFiles(readable)](const std::string& file) { return files.has(file); };
  limit_use(o.output);
  return dspic::link::run(o) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  tell_refused_output();
  if (argc > 1 && StringRef(argv[1]) == "--link") return link(argc, argv);
  cc::Options options;
  if (!parse(argc, argv, options)) return 2;
  limit_use(options.input);
  if (!options.readable.has(options.input)) {
    errs() << options.input << ": " << options.readable.refusal("source", options.input) << "\n";
    return 1;
  }
  check_dspic_files([&](const std::string& file) {
    return options.readable.has(file) ? "" : options.readable.refusal("include", file);
  });
  if (StringRef(options.input).endswith_insensitive(".s")) return cc::assemble_for_chip(options);
  LLVMContext context;
  cc::Facts facts;
  auto module = cc::compile_to_module(options, context, facts);
  if (!module) return 1;
  cc::Unit unit{*module, options, facts};
  return cc::compile_for_chip(unit);
}
