// SPDX-License-Identifier: MIT
// See link_chip.h.
#include "link_chip.h"

#include <cstdlib>
#include <cstring>
#include <sstream>

#include "build_plan.h"
#include "build_record.h"
#include "compiler/cache/crash_words.h"
#include "hal_sim/api/host_table.h"
#include "link_messages.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

/// In every image of the chip that was linked here (dspic30/memory/host_places.h).
constexpr const char* kMadeHere = "_tp_hal";

/// The linker's numbers, of its report (dspic30/link/report.cpp).
void take_sizes(const std::string& report, const fs::path& folder, BuildResult& result) {
  result.size_report = report;
  const auto number_behind = [&](const std::string& word) {
    const std::size_t at = report.find("\n" + word);
    return at == std::string::npos ? 0 : std::strtol(report.c_str() + at + 1 + word.size(), nullptr, 10);
  };
  result.ram_bytes = number_behind("RAM ");
  result.stack_bytes = number_behind("stack ");
  if (const std::size_t at = report.find("(no bound: "); at != std::string::npos) {
    const std::size_t begin = at + std::strlen("(no bound: ");
    result.recursive = report.substr(begin, report.find("()", begin) - begin);
  }
  static const std::string kOfLinker = "link: warning: stack: ";
  for (std::string& warning : result.warnings)
    if (warning.rfind(kOfLinker, 0) == 0)
      warning = result.no_room = folder.string() + warning.substr(std::strlen("link"));
}

/// For the chip's linker: the library, and what of it the host can fill, or does.
void add_host_table(std::vector<std::string>& argv, const fs::path& library, bool fills,
                    const std::string& level) {
  argv.insert(argv.end(), {"--host-library", library.string()});
  const auto of = [](const auto& row) { return std::string(row.driver) + ":" + row.name; };
  int place = 0;
  for (const auto& row : api::kHostFunctions)
    argv.insert(argv.end(),
                {row.is_shortcut ? "--host-shortcut" : "--host", of(row) + "=" + std::to_string(place++)});
  for (const auto& row : api::kHostRegisters)
    argv.insert(argv.end(), {"--register", of(row) + "=" + std::to_string(row.bytes)});
  for (const auto& row : api::kHostOwned) argv.insert(argv.end(), {"--owned", of(row)});
  if (!fills) return;
  const char* number = level == "-O0" ? "0" : level == "-O2" ? "2" : level == "-Os" ? "3" : "1";
  argv.insert(argv.end(), {"--fill", std::to_string(api::host_table_sum()), "--library-level", number});
}

/// The linker's lines of drivers, which end its report: "host  agenda chip: main.c:12 uses T2CON".
void take_drivers(std::string& report, bool is_filled, BuildResult& result) {
  const std::size_t begin = report.find("\nhost  ");
  if (begin == std::string::npos) return;
  std::istringstream lines(report.substr(begin + 1));
  report.resize(begin + 1);
  for (std::string line; is_filled && std::getline(lines, line);)
    for (const auto& [word, whose] :
         {std::pair(" chip: ", "the chip's own driver"), std::pair(" own: ", "the program's own driver")})
      if (const std::size_t at = line.find(word); at != std::string::npos)
        result.notes.push_back(line.substr(6, at - 6) + ": " + whose + ", since " +
                               line.substr(at + std::strlen(word)));
}

}  // namespace

void link_chip(const std::vector<CompileOutcome>& user, const std::vector<CompileOutcome>& drivers,
               const std::vector<CompileOutcome>& members, const Program& program, const Library& library,
               const Renames& renames, const BuildOptions& o, const fs::path& output, BuildResult& result) {
  std::error_code ec;
  const fs::path half = unfinished(output);  // a folder
  fs::create_directories(half, ec);
  if (ec) {
    result.errors.push_back(output.string() + ": image: cannot be written: " + ec.message());
    result.is_bad_input = true;
    return;
  }
  const fs::path made = half / (output.stem().string() + ".elf");
  std::vector<std::string> argv = {compiler_path().string(), "--link", "-o", made.string()};
  for (const auto& u : user) argv.push_back(u.object.string());
  for (const auto& [from, to] : renames.of_program) argv.insert(argv.end(), {"--rename", from + "=" + to});
  for (const auto& [from, to] : renames.of_library)
    argv.insert(argv.end(), {"--rename-library", from + "=" + to});
  const auto made_of = [&](const fs::path& object, const std::string& source) {
    argv.insert(argv.end(), {"--source", object.string() + "=" + source});
  };
  for (const auto* list : {&user, &drivers, &members})
    for (const auto& made : *list) made_of(made.object, made.source.string());
  made_of(library.archive, "library");
  for (const auto& file : program.objects) {
    look_at(file);
    if (file.extension() != ".o") argv.push_back("--library");  // of an archive what is asked for
    argv.push_back(file.string());
  }
  for (const auto& d : drivers) argv.insert(argv.end(), {"--driver", d.object.string()});
  for (const auto& m : members) argv.insert(argv.end(), {"--library", m.object.string()});
  add_host_table(argv, library.archive, o.hal == "sim", o.optimisation);
  if (o.hal == "sim" && !o.with_texts) argv.push_back("--no-texts");
  for (const std::string& word : flags_of(readable_files(o))) argv.push_back(word);
  constexpr const char* kGapBytes = "4";
  if (o.sanitize) argv.insert(argv.end(), {"--gap", kGapBytes});
  const auto run = run_process(argv);
  // people know the file that they named, not the one that becomes it
  std::string said = run.output;
  const std::string hidden = (half / "").string(), known = (output.parent_path() / "").string();
  for (std::size_t at = 0; (at = said.find(hidden, at)) != std::string::npos; at += known.size())
    said.replace(at, hidden.size(), known);
  sort_messages(with_hints(said), result, run.status != 0);
  if (run.status > kBySignal)
    result.errors.push_back(o.source_dir.string() + ": link: " + crash_words(run.status - kBySignal));
  if (const std::size_t at = run.output.find("flash "); run.status == 0 && at != std::string::npos) {
    std::string report = run.output.substr(at);
    take_drivers(report, o.hal == "sim", result);
    take_sizes(report, o.source_dir, result);
  }
  for (const char* kind : {".hex", ".lst", ".map", ".elf"}) {
    if (!result.errors.empty()) break;
    fs::path from = made, to = output;
    if (kind != std::string(".elf")) to.replace_extension(kind);
    if (fs::exists(from.replace_extension(kind)))
      fs::rename(from, to, ec);
    else if (fs::exists(to) && bytes_of(output).find(kMadeHere) != std::string::npos)
      fs::remove(to, ec);  // of the image that is replaced
    if (ec) result.errors.push_back(to.string() + ": cannot write: " + ec.message());
  }
  fs::remove_all(half, ec);
  if (result.errors.empty()) look_at(output);
}

}  // namespace cc
