/* SPDX-License-Identifier: MIT
 * Commands to the Bluetooth module. Its data link is UART 1 and is simulated: see e_uart_char.h.
 */
#include "bluetooth/e_bluetooth.h"
#include "unsimulated.h"
#define DEVICE "command mode of the Bluetooth module"

__attribute__((weak)) unsigned char e_bt_local_paired_device[6 * 8];
__attribute__((weak)) struct BtDevice e_bt_present_device[10];
__attribute__((weak)) struct BtEPuck e_bt_present_epuck[10];

UNSIMULATED(int, e_bt_find_epuck, (void))
UNSIMULATED(char, e_bt_connect_epuck, (void))
UNSIMULATED(char, e_bt_read_local_pin_number, (char *PIN))
UNSIMULATED(char, e_bt_read_local_name, (char *name))
UNSIMULATED(char, e_bt_write_local_pin_number, (char *PIN))
UNSIMULATED(char, e_bt_write_local_name, (char *name))
UNSIMULATED(char, e_bt_etablish_SPP_link, (char *address))
UNSIMULATED(char, e_bt_release_SPP_link, (void))
UNSIMULATED(char, e_bt_send_SPP_data, (char *data, char datalenght))
UNSIMULATED(char, e_bt_tranparent_mode, (void))
UNSIMULATED_VOID(e_bt_exit_tranparent_mode, (void))
UNSIMULATED(char, e_bt_list_local_paired_device, (void))
UNSIMULATED(char, e_bt_remove_local_paired_device, (int index))
UNSIMULATED(int, e_bt_inquiry, (struct BtDevice *device))
UNSIMULATED(char, e_bt_get_friendly_name, (struct BtDevice *device))
UNSIMULATED(char, e_bt_set_event_filter, (char event))
UNSIMULATED(char, e_bt_get_event_filter, (void))
UNSIMULATED(int, e_bt_reset, (void))
UNSIMULATED(char, e_bt_factory_reset, (void))
