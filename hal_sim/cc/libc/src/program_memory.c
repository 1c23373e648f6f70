/* SPDX-License-Identifier: MIT
 * Firmware libc: program memory and data EEPROM as table instructions and libpic30.h reach them. Variables of
 * section tpeedata (_EEDATA, space(eedata)) lie in the EEPROM, in their order from its first word on. Everything
 * else has a program address of its own by which it is read, two bytes to an address as psv data on the chip; not
 * modelled: the window into program memory through pointers that are made of numbers (PSVPAG). */
#include "hal_sim/host/image_abi.h"

extern const char tp_text_begin[], tp_data_end[];     /* the linker script */
extern const char tp_eedata_begin[], tp_eedata_end[];

#define EEPROM 0x7FF000ul     /* [DS70143 3.1] */
#define CONSTANTS 0x010000ul  /* behind the vectors and whatever else the program might look for */

unsigned long tp_image_program_address(const volatile void *object)
{
  const char *at = (const char *)object;
  if (at >= tp_eedata_begin && at < tp_eedata_end) return EEPROM + (unsigned long)(at - tp_eedata_begin);
  return CONSTANTS + (unsigned long)((unsigned long long)at - (unsigned long long)tp_text_begin);
}

unsigned tp_image_table_read(unsigned long address)
{
  const char *at = tp_text_begin + (address - CONSTANTS);
  if (address >= EEPROM) return (unsigned)tp_table_read((tp_i64)address);
  if (address < CONSTANTS || at >= tp_data_end) return 0xFFFF; /* as erased program memory */
  return (unsigned char)at[0] | (unsigned)(unsigned char)at[1] << 8;
}
