// SPDX-License-Identifier: MIT
// The verbs for the chip's own programs: dis writes an image as assembler text, asm makes one from such text.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>

#include "compiler/cache/memory_limit.h"
#include "dspic30/asm/assembler.h"
#include "dspic30/core/disassembler.h"
#include "dspic30/load/firmware_file.h"
#include "dspic30/memory/program_memory.h"
#include "outputs/output_folder.h"
#include "sim_core/base/file_uses.h"
#include "sim_core/base/pattern.h"
#include "tools/command_line.h"
#include "tools/program_file.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

int disassemble(const std::string& name) {
  std::string error;
  dspic::FirmwareFile file;
  if (!read_program(name, file, error)) {
    complain({error});
    return kBadInput;
  }
  std::multimap<std::uint32_t, std::string> labels;
  for (const auto& [function, address] : file.functions) labels.emplace(address, function);
  std::uint32_t expected = 0;
  for (auto at = file.words.begin(); at != file.words.end();) {
    const auto [address, word] = *at++;
    if (word == dspic::kErasedWord) continue;
    if (address != expected) std::cout << '\n';
    const auto [first, last] = labels.equal_range(address);
    for (auto label = first; label != last; ++label) std::cout << label->second << ":\n";
    const bool is_flash = address < dspic::kFlashEnd;
    if (const auto* line = file.code.line_at(address); line && line->address == address)
      std::cout << fmt::format("; {}:{}\n", file.code.lines().files[line->file], line->line);
    const bool has_second = is_flash && at != file.words.end() && at->first == address + 2;
    const std::uint32_t second = has_second ? at->second : 0;
    const std::string text =
        is_flash ? dspic::disassemble(word, second, address) : fmt::format(".pword {:#08x}", word);
    std::cout << fmt::format("{:06x}  {:06x}  {}\n", address, word, text);
    expected = address + 2;
    if (is_flash && has_second && text[0] != '.' && dspic::instruction_words(word) == 2) {
      std::cout << fmt::format("{:06x}  {:06x}\n", at->first, second);
      expected = at++->first + 2;
    }
  }
  return kPass;
}

int assemble(const std::string& name, const std::string& output) {
  cc::limit_own_memory(name);
  std::string text;
  if (!read_file(name, text)) {
    complain({name + ": cannot be read, expected assembler text"});
    return kBadInput;
  }
  // upper case: the vendor's compiler has its preprocessor read such a file first
  static const sim::Pattern kForPreprocessor(
      R"((^|\n)[ \t]*#[ \t]*(include|define|undef|if|ifdef|ifndef)\b)");
  if (std::smatch found;
      fs::path(name).extension() == ".S" && std::regex_search(text, found, kForPreprocessor)) {
    const auto line = 1 + std::count(text.begin(), text.begin() + found.position(2), '\n');
    complain({fmt::format(
        "{}:{}: #{}: asm has no preprocessor, expected .include, .equ or .if; `twinpuck build DIR "
        "--hal dspic` has one",
        name, line, found[2].str())});
    return kBadInput;
  }
  const fs::path folder = fs::path(name).parent_path();
  bool is_no_file = false;
  sim::FileUses uses;
  uses.reads(name, "the assembler text");
  uses.writes(output, "-o");
  const dspic::assembly::Image image =
      dspic::assembly::assemble(text, name, [&](const std::string& other) -> std::optional<std::string> {
        // a pipe may never end
        std::error_code none;
        const fs::path file = folder / other;
        if (fs::exists(file, none) && !fs::is_regular_file(file, none)) {
          complain({fmt::format("{}: .include: got a pipe, a device or a folder, expected a file",
                                file.string())});
          is_no_file = true;
          return std::nullopt;
        }
        uses.reads(file.string(), ".include");
        std::string included;
        return read_file(file.string(), included) ? std::optional(included) : std::nullopt;
      });
  if (is_no_file) {
    std::cerr << image.report();
    return kBadInput;
  }
  if (!image.is_whole()) {
    std::cerr << image.report();
    return kTestFailed;
  }
  std::vector<std::string> problems;
  uses.check(problems);
  if (!problems.empty() || !outputs::can_write(output, "-o", problems)) {
    complain(problems);
    return kBadInput;
  }
  dspic::FirmwareFile file;
  file.words = image.program;
  if (!outputs::write_file(output, dspic::to_hex(file), "-o", problems)) {
    complain(problems);
    return kInvalidRun;
  }
  std::cout << fmt::format("{}: {} words\n", output, image.program.size());
  return kPass;
}

}  // namespace

void add_dis(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("dis", "The instructions of a program of the chip, a .hex or .elf file");
  auto name = std::make_shared<std::string>();
  verb->add_option("FILE", *name, "a .hex or .elf file")->required();
  verb->callback([=, &exit_code] { exit_code = disassemble(*name); });
}

void add_asm(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("asm", "Makes a program of the chip, a .hex file, from assembler text");
  auto name = std::make_shared<std::string>();
  auto output = std::make_shared<std::string>();
  verb->add_option("FILE", *name, "assembler text in XC16's syntax")->required();
  verb->add_option("-o", *output, "the .hex file")->required()->check(named());
  verb->callback([=, &exit_code] { exit_code = assemble(*name, *output); });
}

}  // namespace tools
