// SPDX-License-Identifier: MIT
// twinpuck-dev page NAME FILE: pages of docs/, or tables in them, that are made of the code's own tables.
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>

#include "hal_sim/board/part.h"
#include "hal_sim/faults/kinds.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/load/schema.h"
#include "tools/command_line.h"
#include "tools/dev/link_doc.h"
#include "tools/dev/verbs.h"
#include "tools/verbs.h"

namespace dev {

namespace {

/// A page's new text by its old one; empty: the old one is not that page.
using Maker = std::function<std::string(const std::string& before)>;

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> all = {
      {"world-format",
       [](const std::string&) { return sim::world_format_page(twin::robot_models(), board::part_kinds()); }},
      {"faults", [](const std::string&) { return faults::page(); }},
      {"control", [](const std::string& before) { return with_link_table(before, link_table()); }},
  };
  return all;
}

int write_page(const std::string& name, const std::string& file) {
  std::ifstream in(file);
  const std::string page = makers().at(name)({std::istreambuf_iterator<char>(in), {}});
  in.close();
  if (!page.empty() && std::ofstream(file, std::ios::binary) << page << std::flush) return tools::kPass;
  tools::complain(
      {file + ": page: " +
       (page.empty() ? "got one without the marks of the table, expected both" : "cannot be written")});
  return tools::kBadInput;
}

}  // namespace

void add_page(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("page", "Write a page of docs/, or the table in it, anew");
  auto name = std::make_shared<std::string>(), file = std::make_shared<std::string>();
  std::vector<std::string> names;
  for (const auto& [known, maker] : makers()) names.push_back(known);
  verb->add_option("NAME", *name, "world-format, faults or control")->required()->check(CLI::IsMember(names));
  verb->add_option("FILE", *file, "docs/NAME.md")->required();
  verb->callback([name, file, &exit_code] { exit_code = write_page(*name, *file); });
}

}  // namespace dev
