// SPDX-License-Identifier: MIT
// Controllers whose Makefile says which files they are and where they look: Webots' and those of GNU make.
#include <gtest/gtest.h>

#include "compiler/projects/makefile_project.h"
#include "tests/cc/bench.h"

using namespace cc_test;

namespace {

cc::BuildResult build_folder(const Folder& folder) {
  return cc_test::build_folder(folder, "controllers/prog");
}

const char* kMain =
    "#include <stdio.h>\n#include \"part.h\"\nint part(void);\n"
    "int main(void) { printf(\"%d\", part() + PART + EXTRA); return 0; }";

}  // namespace

TEST(makefile_project, sources_folders_and_macros_are_the_makefiles) {
  Folder folder;
  folder.file("controllers/prog/main.c", kMain);
  folder.file("controllers/prog/old.c", "int main(void) { return 9; }");
  folder.file("controllers/shared/src/part.c", "int part(void) { return 1; }");
  folder.file("controllers/shared/include/part.h", "#define PART 20\n");
  folder.file("controllers/prog/Makefile",
              "# what the program is\nSHARED = ../shared\nCSRCS = main.c \\\n  part.c # both\n"
              "VPATH = $(SHARED)/src\nCFLAGS += -Wall -DEXTRA=300 -I\"$(SHARED)/include\"\n"
              "OBJS=$(CSRCS:.c=.o)\nall: $(OBJS)\n\t$(CC) -o x.hex $^\n");
  auto built = build_folder(folder);
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "321");
}

// one program of two, its objects named in each way that public Makefiles have
TEST(makefile_project, objects_named_by_functions_of_make_are_found) {
  for (const std::string list : {
           "OBJS = $(patsubst %.c,%.o,$(wildcard *.c)) $(patsubst %.c,%.o,$(wildcard parts/*/*.c))\n",
           "SRC = $(wildcard *.c parts/*/*.c)\nOBJ = $(SRC:.c=.o)\n",
           "SRC = $(wildcard *.c) $(wildcard parts/*/*.c)\nOBJ = $(subst .c,.o,$(SRC))\n",
           "NAMES = main part\nOBJS = $(addsuffix .o,$(NAMES))\nVPATH = parts/one\n",
           "DIRS = . parts/one\nSRCS = $(foreach d,$(DIRS),$(wildcard $(d)/*.c))\n",
           "SRCS = $(filter-out tries/%,$(wildcard *.c */*.c */*/*.c))\n",
           "OBJS = $(addprefix build/,$(notdir $(patsubst %.c,%.o,$(wildcard *.c) parts/one/part.c)))\n",
           "OBJS = main.o\nEXTERNAL_OBJS = $(wildcard parts/*/*.o)\n",  // compiled by a Makefile over there
           // lists of any name, which a target is linked of
           "MINE := $(patsubst %.c,%.o,$(wildcard *.c))\nTHEIRS := $(patsubst %.c,%.o,$(wildcard "
           "parts/*/*.c))\n"
           "all: x.hex\nx.cof: $(MINE) $(THEIRS)\n\t$(CC) $^ -o $@\n",
           "x.elf: main.o part.o\n\t$(LD) $^\nother.elf: tries/other.o\n\t$(LD) $^\n",
       }) {
    Folder folder;
    folder.file("controllers/prog/main.c",
                "#include <stdio.h>\nint part(void);\nint main(void) { printf(\"%d\", part()); return 0; }");
    folder.file("controllers/prog/parts/one/part.c", "int part(void) { return 21; }");
    folder.file("controllers/prog/tries/part.c", "int part(void) { return 9; }");
    folder.file("controllers/prog/tries/other.c", "int main(void) { return 9; }");
    if (list.find("part.o") != std::string::npos)  // the object's name alone: one file of that name
      std::filesystem::remove(folder.path / "controllers/prog/tries/part.c");
    folder.file("controllers/prog/Makefile", list);
    auto built = build_folder(folder);
    ASSERT_TRUE(built.ok) << list << text_of(built);
    EXPECT_EQ(said(folder), "21") << list;
  }
}

// what each kind of assignment and each function of make gives, as GNU make's manual says: a macro each
TEST(makefile_project, assignments_and_functions_are_those_of_make) {
  const std::pair<const char*, int> rows[] = {{"$(SET)", 1},
                                              {"$(UNSET)", 2},
                                              {"$(AT_ONCE)", 3},
                                              {"$(LATE)", 4},
                                              {"$(subst 5 6,5,$(ADDED))", 5},
                                              {"$(EXPORTED)${OVERRIDDEN}", 89},
                                              {"$(if $(SET),11,12)", 11},
                                              {"$(if $(NOTHING),11,12)", 12},
                                              {"$(subst x,1,x3x)", 131},
                                              {"$(patsubst a%b,1%,a4b)", 14},
                                              {"$(patsubst a%b,1%,15)", 15},
                                              {"$(NAMES:.o=6)", 16},
                                              {"$(subst .,,$(suffix one.17))", 17},
                                              {"$(basename 18.c)", 18},
                                              {"$(notdir a/b/19)", 19},
                                              {"$(subst /,,$(dir 20/x))", 20},
                                              {"$(filter 2%,21 31)", 21},
                                              {"$(filter-out 2%,21 31)", 31},
                                              {"$(addprefix 2,2)", 22},
                                              {"$(addsuffix 3,2)", 23},
                                              {"$(strip  24 )", 24},
                                              {"$(foreach n,25,$(n))", 25},
                                              {"$(subst +,,$(subst $(SET),2+,16))", 26},
                                              {"$(INCLUDED)", 27}};
  std::string makefile =
      "include more.mk\nSET = 1\nSET ?= 99\nUNSET ?= 2\nTHREE = 3\nAT_ONCE := $(THREE)\nLATE = "
      "$(FOUR)\nTHREE = 99\n"
      "FOUR = 4\nADDED = 5\nADDED += 6\nexport EXPORTED = 8\noverride OVERRIDDEN := 9\nNAMES = 1.o\nCFLAGS =";
  std::string program = "#include <stdio.h>\nint main(void) { ", expected;
  for (std::size_t i = 0; i < std::size(rows); ++i) {
    makefile += " -DM" + std::to_string(i) + "=" + rows[i].first;
    program += "printf(\"%d \", M" + std::to_string(i) + "); ";
    expected += std::to_string(rows[i].second) + " ";
  }
  Folder folder;
  folder.file("controllers/prog/main.c", program + "return 0; }");
  folder.file("controllers/prog/more.mk", "INCLUDED = 27\n");
  folder.file("controllers/prog/Makefile", makefile + "\nOBJS = main.o\n");
  auto built = build_folder(folder);
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), expected);
}

// a part of the program in a folder with a Makefile of its own, which alone says where its headers lie
TEST(makefile_project, other_folders_are_compiled_as_their_makefiles_say) {
  Folder folder;
  folder.file("controllers/prog/main.c",
              "#include <stdio.h>\nint part(void);\nint main(void) { printf(\"%d\", part()); return 0; }");
  folder.file("controllers/src/part/part.c", "#include <value.h>\nint part(void) { return VALUE; }");
  folder.file("controllers/src/values/value.h", "#define VALUE 77\n");
  folder.file("controllers/src/part/Makefile", "CPPFLAGS = -I../values\n");
  folder.file("controllers/prog/Makefile", "OBJS = main.o\nEXTERNAL_OBJS = $(wildcard ../src/part/*.o)\n");
  auto built = build_folder(folder);
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "77");
}

TEST(makefile_project, settings_count_without_a_list_of_sources) {
  Folder folder;
  folder.file("controllers/prog/main.c", kMain);
  folder.file("controllers/prog/part.c", "int part(void) { return 1; }");
  folder.file("controllers/include/part.h", "#define PART 20\n");
  folder.file("controllers/prog/Makefile",
              "INCLUDE = -I../include\nCFLAGS = -D EXTRA=300\ninclude nowhere.mk\n");
  auto built = build_folder(folder);
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(said(folder), "321");
}

TEST(makefile_project, a_makefile_of_webots_names_all_sources) {
  Folder folder;
  const std::string head = "#include <webots/robot.h>\n";
  folder.file("controllers/prog/start.c",
              head + "int part(void);\nint main(void) { wb_robot_init(); return part(); }");
  folder.file("controllers/prog/prog.c", head + "int main(void) { return not_to_be_compiled; }");
  folder.file("controllers/shared/part.c", "int part(void) { return 0; }");
  folder.file("controllers/prog/Makefile", "C_SOURCES = start.c part.c\nVPATH = ../shared\n");
  auto built = build_folder(folder);
  EXPECT_TRUE(built.ok) << text_of(built);
}

TEST(makefile_project, what_make_would_compute_by_running_something_is_left_empty) {
  Folder folder;
  folder.file("controllers/prog/main.c", "int main(void) { return 0; }");
  folder.file(
      "controllers/prog/Makefile",
      "A = $(A)$(shell touch ran)\nSRCS := $(wildcard m*.c) $(A)\nB = $(C)\nC = $(B)\nCFLAGS = $(B) $(\n");
  auto built = build_folder(folder);
  EXPECT_TRUE(built.ok) << text_of(built);
}

TEST(makefile_project, makefiles_without_end_are_read_in_a_moment) {
  std::string doubled = "A = x.c\n", folders = "SRC = $(wildcard", ups;
  for (char c = 'B'; c <= 'Z'; ++c) {
    const std::string before = std::string("$(") + char(c - 1) + ") ";
    doubled += c + (" = " + before) + before + "\n";
  }
  for (int i = 0; i < 20'000; ++i) folders += " *", ups += i < 3000 ? "../" : "";
  const std::vector<std::string> texts = {
      "include Makefile Makefile $(wildcard *)\nSRC = main.c\n",  // reads itself
      doubled + "SRC = main.c $(Z)\n",                            // 33 million words
      "SRC = $(SRC) $(SRC) $(SRC)\n",
      folders + ")\n",
      "CFLAGS = -I/" + ups + "x\n",
      "SRC = main.c # " + std::string(300'000, 'a') + "\nX = " + std::string(300'000, 'b') + "\n"};
  for (const std::string& text : texts) {
    Folder folder;
    folder.file("prog/main.c", "int main(void) { return 0; }");
    folder.file("prog/Makefile", text);
    const auto project = cc::read_makefile(folder.path / "prog");
    ASSERT_TRUE(project.has_value()) << text.substr(0, 60);
    EXPECT_LE(project->sources.size(), 1u) << text.substr(0, 60);
  }
}
