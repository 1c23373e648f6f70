// SPDX-License-Identifier: MIT
// Folders as they lie in public repositories: with a project file of MPLAB, with more than one program, with
// headers that only the project's settings find.
#include <gtest/gtest.h>

#include <set>

#include "compiler/cache/elf_reader.h"
#include "compiler/projects/makefile_project.h"
#include "compiler/projects/mplab_project.h"
#include "tests/cc/bench.h"

using namespace cc_test;

namespace {

const char* kMain =
    "#include <stdio.h>\nint part(void);\nint main(void) { printf(\"%d\", part()); return 0; }";

cc::BuildResult build_folder(const Folder& folder) { return cc_test::build_folder(folder, "prog"); }

std::string mcp(const std::string& files, const std::string& include = "") {
  return "[HEADER]\r\ndevice=dsPIC30F6014A\r\n[PATH_INFO]\r\ndir_src=\r\ndir_inc=" + include +
         "\r\n[FILE_SUBFOLDERS]\r\nfile_000=.\r\n[FILE_INFO]\r\n" + files + "[SUITE_INFO]\r\n";
}

}  // namespace

TEST(mplab_project, files_that_the_project_does_not_list_are_left_alone) {
  Folder folder;
  folder.file("prog/main.c", kMain);
  folder.file("prog/part.c", "int part(void) { return 1; }");
  folder.file("prog/part_old.c", "int part(void) { return 2; }");
  folder.file("prog/tries/main.c", "int main(void) { return 5; }");
  folder.file("prog/broken.c", "this was never finished");
  folder.file("prog/robot.mcp", mcp("file_000=MAIN.C\r\nfile_001=part.c\r\nfile_002=part.h\r\n"));
  auto built = build_folder(folder);
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "1");
  EXPECT_TRUE(reads(
      folder, text_of(built),
      "@/prog/robot.mcp: project: lists 2 of the folder's 5 C files and 0 elsewhere; files that it does not "
      "list are linked only where something asks for them\n@/prog/broken.c: does not compile and is left "
      "out, as it is no part of the program: @/prog/broken.c:1:1: error: unknown type name 'this'"));
}

TEST(mplab_project, what_the_project_forgets_is_linked_where_it_is_asked_for) {
  Folder folder;
  folder.file("prog/main.c", kMain);
  folder.file("prog/new/part.c", "int part(void) { return 3; }");
  folder.file("prog/robot.mcp", mcp("file_000=main.c\r\n"));
  auto built = build_folder(folder);
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "3");
}

// the path on the author's PC ends in folders that lie beside the project
TEST(mplab_project, files_and_headers_elsewhere_are_found_by_the_end_of_their_path) {
  Folder folder;
  folder.file("robots/Task A/main.c", std::string("#include \"tools/part.h\"\n") + kMain);
  folder.file("robots/shared/tools/part.h", "#define PART 4\n");
  folder.file("robots/shared/tools/part.c", "#include \"part.h\"\nint part(void) { return PART; }");
  folder.file("robots/Task A/A.mcp",
              mcp("file_000=main.c\r\nfile_001=C:\\Users\\me\\robots\\shared\\Tools\\part.c\r\n",
                  "C:\\Program Files\\C30\\h;C:\\Users\\me\\robots\\shared"));
  auto built = build_folder(folder, "robots/Task A");
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "4");
}

TEST(mplab_project, a_project_of_mplab_x_lists_files_from_its_own_folder) {
  Folder folder;
  folder.file("prog/main.c", kMain);
  folder.file("prog/part.c", "int part(void) { return 6; }");
  folder.file("prog/other.c", "int part(void) { return 7; }");
  folder.file("prog/robot.X/nbproject/configurations.xml",
              "<logicalFolder><itemPath>../main.c</itemPath><itemPath>../part.c</itemPath>"
              "<itemPath>../other.c</itemPath></logicalFolder>"
              "<item path=\"../other.c\" ex=\"true\" overriding=\"false\"></item>");
  auto built = build_folder(folder);
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "6");
  built = build_folder(folder, "prog/robot.X");
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "6");
}

// by the archive's file or by the project that makes it; of its configurations the one that is linked
TEST(mplab_project, an_archive_of_another_project_is_made_of_its_files) {
  for (const std::string item :
       {"<linkerLibFileItem>../../lib.X/dist/Small/production/lib.X.a</linkerLibFileItem>",
        "<linkerLibProjectItem><makeArtifact PL=\"../../lib.X\" CT=\"3\" CN=\"Small\" "
        "OP=\"dist/Small/production/lib.X.a\"></makeArtifact></linkerLibProjectItem>"}) {
    Folder folder;
    folder.file(
        "tries/prog.X/main.c",
        "#include <stdio.h>\n#include \"part.h\"\nint main(void) { printf(\"%d\", part()); return 0; }");
    folder.file("tries/prog.X/nbproject/configurations.xml",
                "<itemPath>main.c</itemPath><conf name=\"default\" type=\"2\"><linkerLibItems>" + item +
                    "</linkerLibItems><C30></C30></conf>");
    folder.file("lib.X/part.c", "#include \"part.h\"\nint part(void) { return OTHER; }");
    folder.file("lib.X/big.c", "int part(void) { return 9; }");
    folder.file("lib.X/try.c", "int main(void) { return 9; }");
    folder.file("lib.X/part.h", "int part(void);\n#define OTHER 5\n");
    folder.file("lib.X/nbproject/configurations.xml",
                "<itemPath>part.c</itemPath><itemPath>big.c</itemPath><itemPath>try.c</itemPath>"
                "<conf name=\"Big\" type=\"3\"><item path=\"part.c\" ex=\"true\"></item></conf>"
                "<conf name=\"Small\" type=\"3\"><item path=\"big.c\" ex=\"true\"></item></conf>");
    auto built = build_folder(folder, "tries/prog.X");
    ASSERT_TRUE(built.ok) << text_of(built);
    EXPECT_EQ(said(folder), "5");
  }
}

// a file that was cut off is told, by line; what it lists before that is taken
TEST(mplab_project, a_project_that_breaks_off_is_told) {
  Folder folder;
  folder.file("prog/main.c", "int main(void) { return 0; }");
  folder.file("prog/a & b.c", "int part(void) { return 1; }");
  const std::string file = "prog/robot.X/nbproject/configurations.xml";
  const std::string whole =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<configurationDescriptor version=\"65\">\n"
      "  <!-- <itemPath>../gone.c</itemPath> -->\n  <itemPath>../main.c</itemPath>\n"
      "  <itemPath>../a &amp; b.c</itemPath>\n  <confs><conf name=\"x\">";
  for (const bool is_whole : {true, false}) {
    folder.file(file, whole + (is_whole ? "</conf></confs></configurationDescriptor>" : "<C30><prop"));
    std::string told;
    const auto project = cc::find_mplab_project(folder.path / "prog", told);
    ASSERT_TRUE(project);
    EXPECT_EQ(project->sources.size(), 2u);
    EXPECT_EQ(project->missing, 0);
    EXPECT_EQ(told, is_whole ? ""
                             : (folder.path / file).string() +
                                   ":6: got XML that breaks off (Error parsing start element tag), expected "
                                   "all that MPLAB X writes; what comes before is taken");
  }
  // elements within elements, more than a stack would hold
  std::string deep;
  for (int i = 0; i < 300'000; ++i) deep += "<C30>";
  folder.file(file, whole + deep);
  std::string told;
  EXPECT_TRUE(cc::find_mplab_project(folder.path / "prog", told));
}

// XC16 without -O is gcc's -O0; the chip alone is built so, and --opt wins
TEST(mplab_project, a_projects_optimisation_level_is_the_chips) {
  const auto mplab_x = [](const std::string& settings) {
    return "<configurationDescriptor><logicalFolder><itemPath>../main.c</itemPath></logicalFolder>"
           "<confs><conf><C30>" +
           settings +
           "</C30><C30-LD><property key=\"optimization-level\" "
           "value=\"3\"/></C30-LD></conf></confs></configurationDescriptor>";
  };
  const std::string key = "<property key=\"optimization-level\" value=\"";
  const std::string compiler = "[TOOL_SETTINGS]\r\nTS{25AC22BD-2378-4FDB-BFB6-7345A15512D3}=";
  const std::string program = mcp("file_000=main.c\r\n");
  struct Row {
    const char* file;
    std::string text;
    const char* level;
  };
  for (const Row& row :
       {Row{"robot.X/nbproject/configurations.xml", mplab_x(key + "0\"/>"), "-O0"},
        {"robot.X/nbproject/configurations.xml", mplab_x(key + "1\"/>"), "-O1"},
        {"robot.X/nbproject/configurations.xml", mplab_x(key + "2\"/>"), "-O2"},
        {"robot.X/nbproject/configurations.xml", mplab_x(key + "3\"/>"), "-O2"},
        {"robot.X/nbproject/configurations.xml", mplab_x(key + "s\"/>"), "-Os"},
        {"robot.X/nbproject/configurations.xml", mplab_x(key + "\"/>"), "-O0"},
        {"robot.X/nbproject/configurations.xml", mplab_x("<property key=\"x\" value=\"1\"/>"), "-O0"},
        {"robot.mcp", program + compiler + "-g -Wall\r\n", "-O0"},
        {"robot.mcp", program + compiler + "-g -Wall -O1\r\n", "-O1"},
        {"robot.mcp", program + compiler + "-Os -g\r\n", "-Os"},
        {"robot.mcp", program, ""},
        {"Makefile", "SRCS = main.c\nCFLAGS = -mcpu=30F6014A -O2\n", "-O2"},
        {"Makefile", "SRCS = main.c\nCFLAGS = -Wall -O\n", "-O1"},
        {"Makefile", "SRCS = main.c\n", ""}}) {
    Folder folder;
    // what is compiled says at which level: 0, 1 or 2, for size
    folder.file(
        "prog/main.c",
        "#ifdef __OPTIMIZE_SIZE__\n#warning level: -Os\n#elif defined __OPTIMIZE__\n"
        "#warning level: more than 0\n#else\n#warning level: -O0\n#endif\nint main(void) { return 0; }");
    folder.file(std::string("prog/") + row.file, row.text);
    cc::BuildOptions options;
    options.source_dir = folder.path / "prog";
    options.output = folder.path / "out.elf";
    options.cache_dir = folder.path / "cache";
    const std::string level = row.level;
    const auto says = [&](const cc::BuildResult& built, const std::string& told) {
      ASSERT_TRUE(built.ok) << text_of(built);
      EXPECT_TRUE(
          reads(folder, text_of(built), "@/prog/main.c:…: warning: level: " + told + " [-W#warnings]"))
          << row.text;
    };
    says(cc::build_image(options), level == "-O0" || level == "-Os" ? level : "more than 0");
    std::string told;
    const auto project = std::string(row.file) == "Makefile"
                             ? cc::read_makefile(options.source_dir)
                             : cc::find_mplab_project(options.source_dir, told);
    ASSERT_TRUE(project) << row.text;
    EXPECT_EQ(project->level, level) << row.text;
    if (level != "-O0") continue;
    options.optimisation = "-O1";
    says(cc::build_image(options), "more than 0");
  }
}

TEST(mplab_project, two_projects_of_different_programs_decide_nothing) {
  Folder folder;
  folder.file("prog/main.c", kMain);
  folder.file("prog/second.c", "int main(void) { return 5; }");
  folder.file("prog/part.c", "int part(void) { return 1; }");
  folder.file("prog/a.mcp", mcp("file_000=main.c\r\nfile_001=part.c\r\n"));
  folder.file("prog/b.mcp", mcp("file_000=second.c\r\n"));
  auto built = build_folder(folder);
  EXPECT_FALSE(built.ok);
  EXPECT_TRUE(reads(folder, text_of(built),
                    "@/prog: main(): got 2 definitions (main.c, second.c), expected 1; give each program a "
                    "folder of its own\n@/prog: project: got several that list different files (a.mcp and "
                    "b.mcp), expected one; none is taken, remove all but one"));
}

TEST(mplab_project, without_one_the_main_nearest_to_the_folder_is_the_programs) {
  Folder folder;
  folder.file("prog/main.c", kMain);
  folder.file("prog/library/part.c", "int part(void) { return 8; }");
  folder.file("prog/library/demo/main.c", "int demo; int main(void) { return 5; }");
  folder.file("prog/library/demo/part.c", "int part(void) { return 9; }");
  auto built = build_folder(folder);
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "8");
  ASSERT_EQ(built.warnings.size(), 1u) << text_of(built);
  EXPECT_TRUE(reads(folder, built.warnings[0],
                    "@/prog: main(): got 2 definitions, expected 1; main.c is taken, and of the folders of "
                    "the others what it asks for"));
}

TEST(mplab_project, a_header_is_found_from_the_folder_above_its_own) {
  Folder folder;
  folder.file("prog/app/main.c", std::string("#include \"tools/part.h\"\n") + kMain);
  folder.file("prog/source/tools/part.h", "#define PART 4\n");
  folder.file("prog/source/tools/part.c", "#include \"part.h\"\nint part(void) { return PART; }");
  auto built = build_folder(folder);
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "4");
}

// short names that a program has given a meaning to before it includes the library's headers
TEST(mplab_project, headers_of_the_libc_use_no_name_of_the_program) {
  Folder folder;
  std::string names;
  for (const char* name : {"a",   "b",     "c",     "e",      "n",      "s",     "v",     "x",   "y",
                           "to",  "from",  "key",   "end",    "base",   "list",  "size",  "set", "value",
                           "old", "first", "block", "format", "number", "state", "status"})
    names += std::string("#define ") + name + " 5 + 5\n";
  auto built =
      build(folder, names +
                        "#include <string.h>\n#include <stdlib.h>\n#include <stdio.h>\n#include <math.h>\n"
                        "#include <ctype.h>\n#include <setjmp.h>\n#include <assert.h>\n#include <time.h>\n"
                        "int main(void) { return 0; }");
  EXPECT_TRUE(built.ok) << text_of(built);
}

// a header of the name of one of ours, in a folder that the project names
TEST(mplab_project, headers_in_folders_of_the_project_win_over_ours) {
  for (const bool is_x : {false, true}) {
    Folder folder;
    folder.file("prog/main.c", "#include <motors.h>\n#include \"led.h\"\n" + std::string(kMain));
    folder.file("prog/part.c",
                "#include <motors.h>\n#include \"led.h\"\nint part(void) { return MOTORS + LEDS + EXTRA; }");
    folder.file("common/motors.h", "#define MOTORS 20\n");
    folder.file("common/led.h", "#define LEDS 1\n");
    if (is_x)
      folder.file("prog/robot.X/nbproject/configurations.xml",
                  "<itemPath>../main.c</itemPath><itemPath>../part.c</itemPath><C30>"
                  "<property key=\"extra-include-directories\" value=\"&quot;../../common&quot;\"/>"
                  "<property key=\"preprocessor-macros\" value=\"EXTRA=300;OTHER\"/></C30>");
    else
      folder.file("prog/robot.mcp",
                  mcp("file_000=main.c\r\nfile_001=part.c\r\n") +
                      "[TOOL_SETTINGS]\r\nTS{25AC22BD-2378-4FDB-BFB6-7345A15512D3}=-g -Wall "
                      "-I\"..\\common\" -DEXTRA=300\r\n");
    auto built = build_folder(folder);
    ASSERT_TRUE(built.ok) << text_of(built);
    EXPECT_EQ(said(folder), "321") << is_x;
  }
}

// MPLAB 8 was left behind with a list of files that are gone; then both lists are complete
TEST(mplab_project, of_two_projects_the_complete_or_the_newer_one_is_taken_and_named) {
  Folder folder;
  folder.file("prog/main.c", kMain);
  folder.file("prog/part.c", "int part(void) { return 1; }");
  folder.file("prog/new.c", "int part(void) { return 2; }");
  folder.file("prog/robot.mcp", mcp("file_000=main.c\r\nfile_001=part.c\r\nfile_002=gone.c\r\n"));
  folder.file("prog/robot.X/nbproject/configurations.xml",
              "<itemPath>../main.c</itemPath><itemPath>../new.c</itemPath>");
  auto built = build_folder(folder);
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "2");
  EXPECT_TRUE(
      reads(folder, text_of(built),
            "@/prog: project: got several that list different files (robot.X/nbproject/configurations.xml "
            "and robot.mcp), expected one; robot.X/nbproject/configurations.xml is taken, since all others "
            "list more files that are missing\n@/prog/robot.X/nbproject/configurations.xml: project: lists 2 "
            "of the folder's 3 C files and 0 elsewhere; files that it does not list are linked only where "
            "something asks for them"));

  folder.file("prog/robot.mcp", mcp("file_000=main.c\r\nfile_001=part.c\r\n"));
  built = build_folder(folder);
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "2");
  EXPECT_TRUE(reads(
      folder, text_of(built),
      "@/prog: project: got several that list different files (robot.X/nbproject/configurations.xml and "
      "robot.mcp), expected one; robot.X/nbproject/configurations.xml is taken, since it is the project of "
      "the newer MPLAB X\n@/prog/robot.X/nbproject/configurations.xml: project: lists 2 of the folder's 3 C "
      "files and 0 elsewhere; files that it does not list are linked only where something asks for them"));

  folder.file("prog/robot.X/nbproject/configurations.xml",
              "<itemPath>../main.c</itemPath><itemPath>../gone.c</itemPath>");
  built = build_folder(folder);
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "1");
}

TEST(mplab_project, handlers_and_functions_in_assembler_are_linked) {
  Folder folder;
  folder.file("prog/main.c", "void fast(void); int main(void) { fast(); return 0; }");
  folder.file(
      "prog/fast.s",
      "        .global _fast\n_fast:  return\n        .globl  __T3Interrupt\n__T3Interrupt: retfie\n");
  auto built = build_folder(folder);
  EXPECT_TRUE(built.ok) << text_of(built);
  std::set<std::string> names;
  for (const cc::ElfSymbol& symbol : cc::read_elf(folder.path / "out.elf").symbols) names.insert(symbol.name);
  EXPECT_TRUE(names.count("fast"));
  EXPECT_TRUE(names.count("_T3Interrupt"));
}

// 50,000 characters were too many for the stack
TEST(mplab_project, names_and_comments_of_any_length_are_read) {
  Folder folder;
  const std::string longest(300'000, 'a');
  folder.file("prog/main.c", "/*" + longest + "*/\n//" + longest + "\nint main(void) { return 0; }\n");
  folder.file("prog/nbproject/configurations.xml",
              "<itemPath>main.c</itemPath><itemPath>" + longest +
                  ".c</itemPath><C30><property key=\"preprocessor-macros\" "
                  "value=\"" +
                  longest + "\"/></C30>");
  std::string told;
  const auto project = cc::find_mplab_project(folder.path / "prog", told);
  ASSERT_TRUE(project.has_value()) << told;
  EXPECT_EQ(project->sources.size(), 1u);
  EXPECT_EQ(project->missing, 1);
  ASSERT_EQ(project->defines.size(), 1u);
  EXPECT_EQ(project->defines[0], longest);
}
