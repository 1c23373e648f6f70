// SPDX-License-Identifier: MIT
// Bad input, one kind a test: a clear line, the documented exit code, nothing lost. (World files have many
// more of their own in tests/sim_core/loader_test.cpp.)
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

using namespace cli_test;

namespace {

struct Bad {
  const char* name;
  const char* arguments;  // @ stands for the test's folder
  int exit_code;
  const char* says;
};

class BadInput : public CommandTest, public ::testing::WithParamInterface<Bad> {};

TEST_P(BadInput, is_refused_with_a_clear_line) {
  const Bad& bad = GetParam();
  write("text.so", "I am no ELF\n");
  write("empty.so", "");
  write("chip.hex", ":020000040000FA\n");
  write("syntax/main.c", "int main(void) { retrun 0; }\n");
  write("undefined/main.c", "int main(void) { no_such_function(); while (1); }\n");
  write("sleepy/main.c", "#include <unistd.h>\nint main(void) { sleep(1); while (1); }\n");
  write("clock/main.c", "#include <time.h>\nint main(void) { return (int)mktime(0); }\n");
  write("threads/main.c", "#include <pthread.h>\nint main(void) { while (1); }\n");
  write("files/main.c", "#include <stdio.h>\nint main(void) { fopen(\"x\", \"r\"); while (1); }\n");
  write("two_mains/a.c", "int main(void) { while (1); }\n");
  write("two_mains/b.c", "int main(void) { while (1); }\n");
  write("no_main/a.c", "int x;\n");
  write("no_header/main.c", "#include \"nowhere.h\"\nint main(void) { while (1); }\n");
  write("nothing_here/readme.txt", "no C\n");
  write("broken.toml", "this is = = not toml\n");
  write("typo.toml", "twinpuck = 1\n[aren]\nsize = [1, 1]\n");
  write("no_version.toml", "title = \"x\"\n");
  write("unknown_firmware.toml",
        "twinpuck = 1\n[arena]\nsize = [1, 1]\n[[robot]]\nname = \"r\"\nfirmware = \"obstakle\"\n");
  write("good.toml", "twinpuck = 1\n[arena]\nsize = [1, 1]\n[[robot]]\n");
  write("half.toml", "[=]");
  write("empty.toml", "");
  write("image.so",
        "\x7f"
        "ELF, or so it says");
  fs::create_symlink("loop", folder / "loop");
  fs::create_symlink("/dev/full", folder / "full.so");
  write("odd/main.c", "int main(void) { while (1); }\n");
  write("device.cpp/readme.txt", "no C\n");
  std::string arguments = bad.arguments;
  for (std::size_t at; (at = arguments.find('@')) != std::string::npos;)
    arguments.replace(at, 1, folder.string());
  const Said s = twinpuck(arguments);
  EXPECT_EQ(s.exit_code, bad.exit_code) << s.text;
  EXPECT_NE(s.text.find(bad.says), std::string::npos) << s.text;
  EXPECT_EQ(s.text.find("terminate called"), std::string::npos) << s.text;
}

INSTANTIATE_TEST_SUITE_P(
    Kind, BadInput,
    ::testing::Values(
        Bad{"no_verb", "", 2, "verb: missing"}, Bad{"unknown_verb", "rnu maze", 2, "did you mean 'run'"},
        Bad{"unknown_option", "run maze --sede 3", 2, "did you mean '--seed'"},
        Bad{"no_world", "run", 2, "WORLD"}, Bad{"missing_world", "run nowhere.toml", 2, "nowhere.toml"},
        Bad{"world_is_a_folder", "run worlds", 2, "worlds"},
        Bad{"broken_world", "run @/broken.toml", 2, "broken.toml:1:"},
        Bad{"unknown_key", "run @/typo.toml", 2, "did you mean"},
        Bad{"no_version", "check @/no_version.toml", 2, "twinpuck"},
        Bad{"unknown_firmware_in_world", "run @/unknown_firmware.toml", 2, "did you mean 'obstacle'"},
        Bad{"missing_firmware", "run maze --fw puck=@/nothing.so", 2, "nothing.so"},
        Bad{"firmware_is_text", "run maze --fw puck=@/text.so", 2,
            "got a file that is neither Intel HEX nor ELF"},
        Bad{"firmware_is_empty", "run maze --fw puck=@/empty.so", 2, "empty file"},
        Bad{"firmware_is_hex", "run maze --fw puck=@/chip.hex", 2, "without an end record"},
        Bad{"firmware_of_the_pc", "run maze --fw puck=/lib/x86_64-linux-gnu/libm.so.6", 2,
            "got a program or library of this PC, expected the .hex or .elf of a dsPIC30F"},
        Bad{"firmware_for_nobody", "run maze --fw punk=blink", 2, "did you mean 'puck'"},
        Bad{"firmware_of_no_robot", "run maze --fw =blink", 2, "ROBOT=VALUE"},
        Bad{"controller_misspelt", "run maze --fw blnk", 2, "did you mean 'blink'"},
        Bad{"lint_misspelt", "lint blnk", 2, "did you mean 'blink'"},
        Bad{"cycles_misspelt", "cycles blnk", 2, "did you mean 'blink'"},
        Bad{"world_misspelt", "run maz", 2, "did you mean 'maze'"},
        Bad{"checked_world_misspelt", "check maz", 2, "did you mean 'maze'"},
        Bad{"inspected_world_misspelt", "inspect maz", 2, "did you mean 'maze'"},
        Bad{"supervisor_misspelt", "run maze --supervisor socce", 2, "did you mean 'soccer'"},
        Bad{"surplus_word", "run maze foo --for 1", 2, "one word too many: got 'foo'"},
        Bad{"time_with_a_unit", "run maze --for 5s", 2, "--for: got 5s, expected 0 to 1e+07"},
        Bad{"help_of_nothing", "help chek", 2, "did you mean 'check'"},
        Bad{"list_of_nothing", "list wrlds", 2, "wrlds"},
        Bad{"syntax_error", "run maze --fw puck=@/syntax", 2, "main.c:1"},
        Bad{"undefined_function", "run maze --fw puck=@/undefined", 2, "no_such_function"},
        Bad{"sleep", "run maze --fw puck=@/sleepy", 2, "unistd.h"},
        Bad{"calendar", "run maze --fw puck=@/clock", 2, "mktime"},
        Bad{"threads", "run maze --fw puck=@/threads", 2, "pthread.h"},
        Bad{"files", "run maze --fw puck=@/files", 2, "fopen"},
        Bad{"two_mains", "build @/two_mains -o @/x.elf", 1, "main"},
        Bad{"no_main", "build @/no_main -o @/x.elf", 1, "main"},
        Bad{"missing_header", "build @/no_header -o @/x.elf", 1, "nowhere.h"},
        Bad{"folder_without_c", "build @/nothing_here -o @/x.elf", 1, "nothing_here"},
        Bad{"build_of_nothing", "build @/nowhere -o @/x.elf", 2, "neither a file nor a controller"},
        Bad{"lint_of_nothing", "lint @/nowhere", 2, "neither a file nor a controller"},
        Bad{"cycles_of_text", "cycles @/text.so", 2, "got no program of the chip"},
        Bad{"negative_time", "run maze --for -1", 2, "--for"},
        Bad{"time_is_a_word", "run maze --for long", 2, "--for"},
        Bad{"bad_speed", "run maze --speed quick", 2, "expected max or a factor"},
        Bad{"zero_threads", "run maze --threads 0", 2, "--threads"},
        Bad{"negative_seed", "run maze --seed -4", 2, "--seed"},
        Bad{"key_without_time", "run maze --key puck=5", 2, "5@1.5"},
        Bad{"bad_uart", "run maze --uart puck=telnet", 2, "telnet"},
        Bad{"bad_port", "run maze --uart puck=tcp:99999", 2, "99999"},
        Bad{"uart_file_nowhere", "run maze --uart puck=file:/nowhere/x", 2, "/nowhere/x"},
        Bad{"picture_of_unknown_kind", "run maze --picture @/x.gif", 2, "expected .png or .svg"},
        Bad{"film_of_unknown_kind", "run maze --film @/x.mp4", 2, "expected .webm, .png or .apng"},
        Bad{"film_nowhere", "run maze --film /nowhere/x.webm", 2, "/nowhere/x.webm"},
        Bad{"film_too_small", "run maze --film @/x.webm --film-size 10", 2, "--film-size"},
        Bad{"heatmap_of_unknown_kind", "run maze --heatmap @/x.gif", 2, "expected .png, .svg or .csv"},
        Bad{"heatmap_without_cells", "run maze --heatmap @/x.png --heatmap-cell 0", 2, "--heatmap-cell"},
        Bad{"record_nowhere", "run maze --record /nowhere/r.csv", 2, "/nowhere/r.csv"},
        Bad{"summary_nowhere", "run maze --summary /nowhere/s.json", 2, "/nowhere/s.json"},
        Bad{"record_too_often", "run maze --record @/r.csv --record-every 0", 2, "--record-every"},
        Bad{"half_a_header", "run @/half.toml", 2, "half.toml:1:2: not TOML"},
        Bad{"half_a_table_of_exercises", "lab --table @/half.toml", 2, "half.toml:1:2"},
        Bad{"empty_world", "check @/empty.toml", 2, "empty.toml:1:1: twinpuck: missing"},
        Bad{"world_is_a_device", "check /dev/zero", 2, "expected a regular file"},
        Bad{"world_is_a_loop", "run @/loop", 2, "Too many levels of symbolic links"},
        Bad{"import_of_a_device", "import /dev/zero -o @/x.toml", 2, "expected a regular file"},
        Bad{"import_of_a_loop", "import @/loop -o @/x.toml", 2, "Too many levels of symbolic links"},
        Bad{"import_of_a_folder", "import @/odd -o @/x.toml", 2, "got a folder"},
        Bad{"import_onto_itself", "import @/empty.toml -o @/empty.toml", 2, "got the world itself"},
        Bad{"lab_table_is_a_device", "lab --table /dev/zero", 2, "expected a regular file"},
        Bad{"firmware_is_a_device", "run maze --fw puck=/dev/zero", 2, "regular file"},
        Bad{"firmware_is_a_loop", "run maze --fw puck=@/loop", 2, "loop"},
        Bad{"supervisor_is_a_device", "run maze --supervisor /dev/zero", 2, "got a pipe or a device"},
        Bad{"supervisor_is_a_loop", "run maze --supervisor @/loop", 2, "loop"},
        Bad{"cycles_of_a_device", "cycles /dev/zero", 2, "got a device"},
        Bad{"build_of_a_loop", "build @/loop -o @/x.elf", 2, "Too many levels of symbolic links"},
        Bad{"image_onto_a_device", "build @/odd -o @/full.so", 2, "expected a new name"},
        Bad{"image_onto_a_source", "build @/odd -o @/odd/main.c", 2, "expected a new name"},
        Bad{"record_onto_a_loop", "run maze --record @/loop", 2, "loop"},
        Bad{"record_onto_the_world", "run @/good.toml --record @/good.toml", 2, "got the file of the world"},
        Bad{"two_outputs_in_one", "run maze --record @/x --summary @/./x", 2, "got the file of --record"},
        Bad{"folder_under_a_loop", "run maze --save-images @/loop/x", 2, "Too many levels"},
        Bad{"serial_input_is_a_folder", "run maze --uart puck=file:/dev/null,@/odd", 2, "got a folder"},
        Bad{"link_onto_a_file", "run maze --uart puck=pty:@/text.so", 2, "File exists"},
        Bad{"time_is_nan", "run maze --for nan", 2, "--for: got nan"},
        Bad{"limit_is_nan", "run maze --host-limit nan", 2, "--host-limit: got nan"},
        Bad{"window_is_nan", "run maze --vcd @/x.vcd --vcd-from nan", 2, "--vcd-from: got nan"},
        Bad{"window_beyond_time", "run maze --vcd @/x.vcd --vcd-to 1e300", 2, "--vcd-to: got 1e300"},
        Bad{"cell_is_nan", "run maze --heatmap @/x.png --heatmap-cell nan", 2, "--heatmap-cell: got nan"},
        Bad{"film_speed_is_nan", "run maze --film @/x.webm --film-speed nan", 2, "--film-speed: got nan"},
        Bad{"record_every_nan", "run maze --record @/x.csv --record-every nan", 2, "--record-every: got nan"},
        Bad{"inspect_at_nan", "inspect maze --at nan", 2, "--at: got nan"},
        Bad{"roughness_is_nan", "inspect --profile all --roughness nan", 2, "--roughness: got nan"},
        Bad{"colour_is_nan", "inspect --profile all --colour nan,0,0", 2, "--colour: got nan"},
        Bad{"period_is_nan", "cycles blink --period nan", 2, "--period: got nan"},
        Bad{"trigger_is_nan", "run maze --vcd @/x.vcd --vcd-trigger puck:LED0=nan", 2,
            "got value 'nan', expected a whole number from 0 to 1"},
        Bad{"bad_name", "new 'My Robot'", 2, "a name of letters"},
        Bad{"name_taken", "new worlds", 2, "not empty"}),
    [](const auto& info) { return std::string(info.param.name); });

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
  EXPECT_NE(s.text.find(port), std::string::npos) << s.text;
}

TEST_F(BadLuck, a_full_disk_ends_the_run_with_7_and_says_so) {
  const Said s = twinpuck("run maze --for 60 --record /dev/full");
  EXPECT_EQ(s.exit_code, 7) << s.text;
  EXPECT_NE(s.text.find("No space left"), std::string::npos) << s.text;
}

TEST_F(BadLuck, every_output_on_a_full_disk_ends_with_7_and_is_named) {
  for (const char* name : {"x.png", "x.svg", "x.csv", "x.webm", "x.apng", "x"})
    fs::create_symlink("/dev/full", folder / name);
  for (const std::string output :
       {"--record @/x.csv", "--summary @/x", "--coverage @/x", "--vcd @/x", "--trace @/x",
        "--picture @/x.png", "--picture @/x.svg", "--heatmap @/x.png", "--heatmap @/x.svg",
        "--heatmap @/x.csv", "--film @/x.webm", "--film @/x.apng", "--uart puck=file:@/x"}) {
    const std::size_t at = output.find('@');
    const std::string option = output.substr(0, at) + folder.string() + output.substr(at + 1);
    const Said s = twinpuck("run maze --for 1 -q --fw puck=asercom " + option);
    EXPECT_EQ(s.exit_code, 7) << output << "\n" << s.text;
    EXPECT_NE(s.text.find(": cannot be written: "), std::string::npos) << output << "\n" << s.text;
    EXPECT_NE(s.text.find(output.substr(at + 1)), std::string::npos) << output << "\n" << s.text;
  }
}

// a limit on the size of files is a disk that fills up within a record
TEST_F(BadLuck, files_end_with_their_last_whole_record_when_the_disk_fills_up) {
  ASSERT_EQ(twinpuck("build braitenberg -o " + path("b.so")).exit_code, 0);
  for (const char* output : {"--record", "--vcd", "--trace"}) {
    const std::string file = path("x");
    fs::remove(file);
    const Said s = twinpuck("run maze --for 60 -q --fw puck=" + path("b.so") + " " + output + " " + file,
                            "ulimit -f 13 &&");
    EXPECT_EQ(s.exit_code, 7) << s.text;
    EXPECT_NE(s.text.find("x: "), std::string::npos) << s.text;
    EXPECT_NE(s.text.find("cannot be written: File too large"), std::string::npos) << s.text;
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
  const Said good = twinpuck("build " + path("long") + " -o " + path("x.so"));
  EXPECT_EQ(good.exit_code, 0) << good.text;
  const Said bad = twinpuck("build " + path("longer") + " -o " + path("x.so"));
  EXPECT_EQ(bad.exit_code, 1) << bad.text;
  EXPECT_NE(bad.text.find("expected at most 2097152"), std::string::npos) << bad.text;
}

// an escape sequence could hide a message or change the terminal
TEST_F(BadLuck, control_characters_in_names_do_not_reach_the_terminal) {
  const std::string name = "a\x1b[31mred\x07.toml";
  write(name, "twinpuck = 1\n[arena]\nsize = [1, 1]\n[[robot]]\nname = \"\\u001b[2J\"\n'\x9b' = 1\n");
  write("folder/\x1b]0;x\x07.c", "int main(void) { retrun 0; }\n");
  write("w.wbt", "#VRML_SIM R2023b utf8\nE-puck { name \"\x1b[31m\" controller \"\x1b[2J\" }\nFoo\x1b { }\n");
  for (const std::string& arguments :
       {"check '" + path(name) + "'", "run '" + path(name) + "'",
        "build " + path("folder") + " -o " + path("x.so"),
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
  ASSERT_EQ(twinpuck("build " + path("c") + " -o " + path("c.so")).exit_code, 0);
  const std::string before = read(path("c.so"));
  write("c/main.c", "int main(void) { oops }\n");
  EXPECT_EQ(twinpuck("build " + path("c") + " -o " + path("c.so")).exit_code, 1);
  EXPECT_EQ(read(path("c.so")), before);
}

}  // namespace
