// SPDX-License-Identifier: MIT
// twinpuck-dev page FILE: what is made of the code's own tables in a page of docs/, or the page's types of
// the live view's protocol.
#include <fstream>
#include <iterator>
#include <memory>

#include "hal_sim/board/part.h"
#include "hal_sim/faults/kinds.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/load/schema.h"
#include "tools/command_line.h"
#include "tools/dev/doc_part.h"
#include "tools/dev/link_doc.h"
#include "tools/dev/verbs.h"
#include "tools/verbs.h"
#include "viewer/requests.h"

namespace dev {

namespace {

struct Part {
  const char* name;  ///< as its mark has it
  std::string (*text)();
};

constexpr Part kParts[] = {
    {"world keys", [] { return sim::world_format_page(twin::robot_models(), board::part_kinds()); }},
    {"faults", [] { return faults::page(); }},
    {"records", [] { return link_table(); }},
    {"requests", [] { return viewer::protocol_tables(); }},
};

int write_page(const std::string& file) {
  std::ifstream in(file);
  std::string page{std::istreambuf_iterator<char>(in), {}};
  in.close();
  const std::string types = "protocol_types.ts";
  bool has_any = file.size() >= types.size() && file.substr(file.size() - types.size()) == types;
  if (has_any) page = viewer::protocol_types();
  for (const Part& part : kParts)
    if (const std::string fresh = with_doc_part(page, part.name, part.text()); !fresh.empty()) {
      page = fresh;
      has_any = true;
    }
  if (has_any && std::ofstream(file, std::ios::binary) << page << std::flush) return tools::kPass;
  tools::complain(
      {file + ": page: " + (has_any ? "cannot be written" : "got no mark of a part, expected one")});
  return tools::kBadInput;
}

}  // namespace

void add_page(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("page", "Write anew what is made of tables in a page of docs/");
  auto file = std::make_shared<std::string>();
  verb->add_option("FILE", *file, "docs/NAME.md, or the page's protocol_types.ts")->required();
  verb->callback([file, &exit_code] { exit_code = write_page(*file); });
}

}  // namespace dev
