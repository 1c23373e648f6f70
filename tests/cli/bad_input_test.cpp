// SPDX-License-Identifier: MIT
// Bad luck: clear lines, the documented exit code, nothing lost.
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

using namespace cli_test;

namespace {

class BadLuck : public CommandTest {};

TEST_F(BadLuck, a_port_in_use_is_named) {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(listen(fd, 1), 0);
  socklen_t size = sizeof address;
  getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
  const std::string port = std::to_string(ntohs(address.sin_port));
  const Said s = twinpuck("run maze --uart puck=tcp:" + port + " --for 1");
  close(fd);
  EXPECT_EQ(s.exit_code, 2);
  EXPECT_TRUE(reads(s.text, "robot 'puck': uart1: tcp:127.0.0.1:" + port +
                                ": got a port that is in use, expected a free one; 0 takes any"));
}

// a limit on the size of files is a disk that fills up within a record
TEST_F(BadLuck, files_end_with_their_last_whole_record_when_the_disk_fills_up) {
  ASSERT_EQ(twinpuck("build braitenberg -o " + path("b.elf")).exit_code, 0);
  for (const char* output : {"--record", "--vcd", "--trace"}) {
    const std::string file = path("x");
    fs::remove(file);
    const Said s = twinpuck("run maze --for 60 -q --fw puck=" + path("b.elf") + " " + output + " " + file,
                            "ulimit -f 13 &&");
    EXPECT_EQ(s.exit_code, 7) << s.text;
    EXPECT_TRUE(reads(s.text, std::string("@/x: ") +
                                  (output == std::string("--record") ? "" : output + std::string(": ")) +
                                  "cannot be written: File too large"));
    const std::string text = read(file);
    ASSERT_GT(text.size(), 5000u) << output;
    EXPECT_EQ(text.back(), '\n') << output;
    if (std::string(output) == "--record") {
      const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
      EXPECT_EQ(std::count(last.begin(), last.end(), ','), 15) << last;
    }
    if (std::string(output) == "--trace") {
      EXPECT_TRUE(nlohmann::json::accept(text)) << text.substr(text.size() - 99);
    }
  }
}

// regular expressions of the standard library follow a comment by recursion
TEST_F(BadLuck, very_long_comments_are_built_and_endless_files_refused) {
  const std::string end = "int main(void) { while (1); }\n";
  write("long/main.c", "/*" + std::string(1'900'000, 'x') + "*/\n" + end);
  write("longer/main.c", "//" + std::string(3'000'000, 'x') + "\n" + end);
  const Said good = twinpuck("build " + path("long") + " -o " + path("x.elf"));
  EXPECT_EQ(good.exit_code, 0) << good.text;
  const Said bad = twinpuck("build " + path("longer") + " -o " + path("x.elf"));
  EXPECT_EQ(bad.exit_code, 2) << bad.text;
  EXPECT_TRUE(reads(bad.text, "@/longer/main.c: source: got 3000033 bytes, expected at most 2097152"));
  for (const std::string name : {"main.c", "beside.h", "project.mcp", "configurations.xml"}) {
    const auto built = [&](const std::string& folder, std::size_t bytes) {
      write(folder + "/main.c", end);
      write(folder + "/" + name, end + "//" + std::string(bytes - end.size() - 2, 'x'));
      return twinpuck("build " + path(folder) + " -o " + path("x.elf"));
    };
    const std::string at = "longest_" + name;
    EXPECT_EQ(built("as_long_" + name, 2'097'152).text.find("expected at most"), std::string::npos) << name;
    EXPECT_TRUE(reads(built(at, 2'097'153).text,
                      "@/" + at + "/" + name + ": source: got 2097153 bytes, expected at most 2097152"));
  }
}

// an escape sequence could hide a message or change the terminal
TEST_F(BadLuck, control_characters_in_names_do_not_reach_the_terminal) {
  const std::string name = "a\x1b[31mred\x07.toml";
  write(name, "twinpuck = 1\n[arena]\nsize = [1, 1]\n[[robot]]\nname = \"\\u001b[2J\"\n'\x9b' = 1\n");
  write("folder/\x1b]0;x\x07.c", "int main(void) { retrun 0; }\n");
  write("w.wbt", "#VRML_SIM R2023b utf8\nE-puck { name \"\x1b[31m\" controller \"\x1b[2J\" }\nFoo\x1b { }\n");
  for (const std::string& arguments :
       {"check '" + path(name) + "'", "run '" + path(name) + "'",
        "build " + path("folder") + " -o " + path("x.elf"),
        "import " + path("w.wbt") + " -o " + path("w.toml"), std::string("run maze --fw 'puck=\x1b[31m'"),
        std::string("run maze '--\x1b[31m'"), std::string("list '\x9b'")}) {
    const Said s = twinpuck(arguments);
    for (char c : s.text)
      EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') << arguments << "\n"
                                                                                   << s.text;
    EXPECT_EQ(s.text.find('\x9b'), std::string::npos) << s.text;
    EXPECT_NE(s.exit_code, 6) << s.text;
  }
}

TEST_F(BadLuck, a_failed_build_leaves_the_old_image) {
  write("c/main.c", "int main(void) { while (1); }\n");
  ASSERT_EQ(twinpuck("build " + path("c") + " -o " + path("c.elf")).exit_code, 0);
  const std::string before = read(path("c.elf"));
  write("c/main.c", "int main(void) { oops }\n");
  EXPECT_EQ(twinpuck("build " + path("c") + " -o " + path("c.elf")).exit_code, 1);
  EXPECT_EQ(read(path("c.elf")), before);
}

}  // namespace
