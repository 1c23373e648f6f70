// SPDX-License-Identifier: MIT
// [[supervisor]]: programs attached to the world.
#include "sim_core/load/schema_keys.h"
#include "sim_core/load/schema_sections.h"

namespace sim {

SectionSpec supervisor_section() {
  using S = SupervisorDesc;
  return {"supervisor",
          true,
          "A program of the PC that watches and changes the world between ticks (docs/connecting.md). "
          "Several run "
          "in the order of the file.",
          {
              {"name", ValueType::Text, "", 0, 0, "", "", "shown in messages; without it the program's",
               into<S>([](S& s, const Value& v) { s.name = v.text; })},
              {"program", ValueType::Text, "", 0, 0, "", "required",
               "a C or C++ file, a folder of such, a shared object, or the name of a folder in "
               "programs/supervisors/; relative to this file",
               checked<S>([](S& s, const Value& v, const WorldDesc&) {
                 s.program = v.text;
                 return std::string(v.text.empty() ? "got \"\", expected the name of a program" : "");
               })},
              {"args", ValueType::Text, "", 0, 0, "", "\"\"",
               "what `main()` gets as its arguments: words between blanks, `'two words'` in quotes",
               into<S>([](S& s, const Value& v) { s.args = v.text; })},
              def_key<S>(),
              custom_data_key<S>(),
              node_key<S>(),
          }};
}

}  // namespace sim
