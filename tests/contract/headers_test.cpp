// SPDX-License-Identifier: MIT
// Every header of the contract compiles by itself, with the firmware compiler, and so does the generated list
// of registers in use. Whether each prototype is implemented is checked by scripts/check_contract.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;

const fs::path kInclude = fs::path(TWINPUCK_SOURCE_DIR) / "firmware/include";
const fs::path kLibc = fs::path(TWINPUCK_SOURCE_DIR) / "firmware/libc/include";
const fs::path kScratch = fs::path(TWINPUCK_BUILD_DIR) / "tests/contract";

/// Compiles a text as firmware. The compiler's messages end up in the failure message.
void expect_compiles(const std::string& name, const std::string& source) {
  fs::create_directories(kScratch);
  const fs::path file = kScratch / (name + ".c"), messages = kScratch / (name + ".txt");
  std::ofstream(file) << source;
  const std::string command = std::string(TWINPUCK_BUILD_DIR) + "/twinpuck-cc " + file.string() + " -I" +
                              kInclude.string() + " -I" + kLibc.string() + " -o " +
                              (kScratch / (name + ".o")).string() + " >" + messages.string() + " 2>&1";
  const int status = std::system(command.c_str());
  std::ifstream in(messages);
  EXPECT_EQ(status, 0) << std::string(std::istreambuf_iterator<char>(in), {});
}

std::vector<std::string> headers() {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(kInclude)) {
    if (entry.path().extension() == ".h") found.push_back(fs::relative(entry.path(), kInclude).string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Contract, every_header_compiles_alone_and_twice) {
  const auto all = headers();
  EXPECT_GE(all.size(), 55u);
  for (const std::string& header : all) {
    SCOPED_TRACE(header);
    std::string name = header;
    std::replace(name.begin(), name.end(), '/', '_');
    expect_compiles(name,
                    "#include <" + header + ">\n#include <" + header + ">\nint main(void) { return 0; }\n");
  }
}

TEST(Contract, registers_have_words_fields_and_short_names) {
  expect_compiles(
      "registers",
      "#include <p30F6014A.h>\n"
      "_FOSC(CSW_FSCM_OFF & XT_PLL8);\n_FWDT(WDT_OFF);\n_FBORPOR(PBOR_OFF & MCLR_EN);\n"
      "_FGS(CODE_PROT_OFF);\n"
      "void _ISR _T1Interrupt(void) { IFS0bits.T1IF = 0; LATA ^= 1 << 6; }\n"
      "void _ISRFAST _T5Interrupt(void) { _T5IF = 0; }\n"
      "int main(void) {\n"
      "  T1CONbits.TCKPS = 3; T1CONbits.TCKPS0 = 1; T1CON = 0x8030; PR1 = 1474; IPC0bits.T1IP = 6;\n"
      "  ADPCFGbits.PCFG3 = 1; I2CSTATbits.R_W; I2CSTATbits.R_NOT_W; U1STAbits.URXISEL1 = 0;\n"
      "  _LATA6 = 1; _TRISG9 = 1; _ADIE = 1; RCONbits.POR = 0; SET_CPU_IPL(7);\n"
      "  while (!_RG6) Nop();\n"
      "  return SRbits.IPL;\n"
      "}\n");
}

TEST(Contract, structures_have_the_robots_sizes) {
  expect_compiles(
      "sizes",
      "#include <a_d/advance_ad_scan/e_acc.h>\n#include <bluetooth/e_bluetooth.h>\n#include <dsp.h>\n"
      "#include <motor_led/e_epuck_ports.h>\n#include <a_d/advance_ad_scan/e_ad_conv.h>\n"
      "_Static_assert(sizeof(LATABITS) == 2, \"a register is a word\");\n"
      "_Static_assert(sizeof(TypeAccRaw) == 6 && sizeof(TypeAccSpheric) == 12, \"acceleration\");\n"
      "_Static_assert(sizeof(struct BtDevice) == 29 && sizeof(struct BtEPuck) == 11, \"Bluetooth\");\n"
      "_Static_assert(sizeof(fractcomplex) == 4, \"fractions\");\n"
      // casts of floating constants are not constant expressions in the strict sense
      "extern char scan[PULSE_PERIOD == 4 && ACC_PROX_PERIOD == 64 && ADCS_3_CHAN == 39 ? 1 : -1];\n"
      "int main(void) { return 0; }\n");
}

}  // namespace
