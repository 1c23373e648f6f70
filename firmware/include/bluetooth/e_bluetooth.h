/* SPDX-License-Identifier: MIT
 * Commands to the Bluetooth module on UART 1 (National LMX9820A or LMX9838); call e_init_uart1() first.
 * Every function blocks until the module has answered, without time-out. Unless noted, the result is the
 * module's status byte: 0 means success.
 */
#ifndef _BLUETOOTH
#define _BLUETOOTH

/** A device found by an inquiry. */
struct BtDevice {
  unsigned char address[6]; /* low byte first */
  unsigned char class[3];   /* class of device */
  char friendly_name[20];   /* filled by e_bt_get_friendly_name() */
};

/** An e-puck found by e_bt_find_epuck(). */
struct BtEPuck {
  unsigned char address[6]; /* low byte first */
  unsigned char number[5];  /* four digits and a 0, from the name e-puck_NNNN */
};

extern unsigned char e_bt_local_paired_device[6*8]; /* addresses, filled by e_bt_list_local_paired_device() */
extern struct BtDevice e_bt_present_device[10];     /* filled by e_bt_inquiry() */
extern struct BtEPuck e_bt_present_epuck[10];       /* filled by e_bt_find_epuck() */

/** Inquires, then asks the names; returns the number of e-pucks found. Takes 5 s and more. */
int e_bt_find_epuck(void);

/** Connects to the first e-puck found. Returns the status, or 99 when none is there. */
char e_bt_connect_epuck(void);

/** Own PIN and own name, as text. */
char e_bt_read_local_pin_number(char *PIN);
char e_bt_read_local_name(char *name);
char e_bt_write_local_pin_number(char *PIN);
char e_bt_write_local_name(char *name);

/** Opens a serial link to `address` (6 bytes), closes it. */
char e_bt_etablish_SPP_link(char *address);
char e_bt_release_SPP_link(void);

/** Sends up to 120 bytes over the link in command mode. */
char e_bt_send_SPP_data(char *data, char datalenght);

/** After this, UART 1 is the link: every byte goes to the other side. */
char e_bt_tranparent_mode(void);

/** Back to commands: sends a break of at least 1 ms and initialises UART 1 again. */
void e_bt_exit_tranparent_mode(void);

/** Fills e_bt_local_paired_device; returns their number. */
char e_bt_list_local_paired_device(void);

/** Forgets the device of that index in the list. */
char e_bt_remove_local_paired_device(int);

/** Looks for devices for 5 s, at most 10; returns their number. */
int e_bt_inquiry(struct BtDevice *device);

/** Asks a device's name. */
char e_bt_get_friendly_name(struct BtDevice *device);

/** Which events the module reports. Setting one above 1 does not wait for the answer. */
char e_bt_set_event_filter(char event);
char e_bt_get_event_filter(void);

/** Restarts the module; returns its firmware version. */
int e_bt_reset(void);

/** Factory settings: the module loses name and PIN. */
char e_bt_factory_reset(void);

#endif
