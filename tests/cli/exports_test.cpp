// SPDX-License-Identifier: MIT
// What translated code needs of the executable is what ships: test programs export nothing more.
#include <set>
#include <sstream>

#include "tests/cli/command.h"

using namespace cli_test;

namespace {

class Exports : public CommandTest {
 protected:
  static std::set<std::string> exported(const std::string& program) {
    std::set<std::string> names;
    const Said said = shell::run("nm -D --defined-only '" + program + "'");
    EXPECT_EQ(said.exit_code, 0) << program;
    std::istringstream lines(said.text);
    for (std::string address, kind, name; lines >> address >> kind >> name;)
      // what templates and vague linkage leave behind is the linker's business, and the libraries' copies too
      if (std::string("TDRG").find(kind) != std::string::npos && name.find('@') == std::string::npos)
        names.insert(name);
    return names;
  }
};

TEST_F(Exports, test_programs_export_what_the_product_exports) {
  const std::set<std::string> product = exported(executable());
  EXPECT_GT(product.size(), 10u);
  // nobody else's program runs in this process: of C there is nothing
  for (const std::string& symbol : product) EXPECT_EQ(symbol.compare(0, 2, "_Z"), 0) << symbol;
  int programs = 0;
  for (const auto& file : fs::directory_iterator(fs::path(TWINPUCK_BUILD_DIR) / "tests")) {
    const std::string name = file.path().filename();
    // firmware_test gives its modules all of itself
    if (!file.is_regular_file() || name.size() < 5 || name.substr(name.size() - 5) != "_test" ||
        name == "firmware_test" ||
        read(file.path())
                .compare(0, 4,
                         "\x7f"
                         "ELF") != 0)
      continue;
    ++programs;
    for (const std::string& symbol : exported(file.path()))
      EXPECT_TRUE(product.count(symbol)) << name << " exports " << symbol << ", and twinpuck does not";
  }
  EXPECT_GT(programs, 0);
}

}  // namespace
