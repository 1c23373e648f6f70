// SPDX-License-Identifier: MIT
// All that messages.txt says the command says, word for word; add what is new there. (World files have many more in
// tests/sim_core/loader_test.cpp.)
#include "tests/cli/command.h"

using namespace cli_test;
using wording::replaced;

namespace {

/// A row of messages.txt, with those below it that have no name: its next commands, in the same folder.
struct Row {
  struct Step {
    int exit_code = 0;
    std::string line, says;
    std::vector<std::pair<std::string, std::string>> files;  // "-> x": a link
  };
  std::string name;
  std::vector<Step> steps;
};

/// Text of a field.
std::string of_a_row(const std::string& row) {
  std::string text;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool is_escape = row[i] == '\\' && ++i < row.size();
    text += is_escape && row[i] == 'n' ? '\n' : is_escape && row[i] == 't' ? '\t' : row[i];
  }
  return text;
}

std::vector<Row> rows() {
  std::vector<Row> all;
  std::ifstream in(TWINPUCK_SOURCE_DIR "/tests/cli/messages.txt");
  for (std::string line; std::getline(in, line);) {
    if (line[0] == '#') continue;
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, '\t');
    if (!cell.empty()) all.emplace_back().name = cell;
    Row::Step& step = all.back().steps.emplace_back();
    std::getline(cells, cell, '\t');
    step.exit_code = std::stoi(cell);
    std::getline(cells, step.line, '\t');
    std::getline(cells, step.says, '\t');
    while (std::getline(cells, cell, '\t'))
      step.files.emplace_back(cell.substr(0, cell.find('=')), of_a_row(cell.substr(cell.find('=') + 1)));
  }
  return all;
}

class Messages : public CommandTest, public ::testing::WithParamInterface<Row> {
 protected:
  /// Text of the table with the names of this PC.
  std::string here(const std::string& text) const {
    return replaced(replaced(text, "@/", folder.string() + "/"), "~/", TWINPUCK_SOURCE_DIR "/");
  }
};

TEST_P(Messages, are_said_word_for_word) {
  for (const auto& [exit_code, line, says, files] : GetParam().steps) {
    for (const auto& [name, text] : files) {
      write(name, text);
      if (text.rfind("-> ", 0) == 0)
        fs::remove(folder / name), fs::create_symlink(here(text.substr(3)), folder / name);
    }
    const Said s = line.rfind("$ ", 0) == 0 ? in_folder(here(line.substr(2))) : twinpuck(here(line));
    EXPECT_TRUE(reads(s.text, of_a_row(says))) << line;
    EXPECT_EQ(s.exit_code, exit_code) << line;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Messages, ::testing::ValuesIn(rows()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
