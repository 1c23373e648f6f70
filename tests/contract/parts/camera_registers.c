/* SPDX-License-Identifier: MIT
 * The functions of the sensor PO3030K that programs call directly: what they refuse, what they keep in the table of
 * registers, what comes back from the sensor. */
#include "say.h"
#include <camera/fast_2_timer/e_po3030k.h>
#include <camera/fast_2_timer/e_poxxxx.h>

#define SOME_REGISTER 0x4F

int main(void) {
  unsigned char value = 0;
  begin();
  e_poxxxx_init_cam();
  say("grey", e_po3030k_get_bytes_per_pixel(GREY_SCALE_MODE));
  say("colour", e_po3030k_get_bytes_per_pixel(RGB_565_MODE));
  say("mode", e_po3030k_set_color_mode(RGB_565_MODE));
  say("mode", e_po3030k_set_color_mode(99));
  say("sampling", e_po3030k_set_sampling_mode(MODE_QVGA));
  say("sampling", e_po3030k_set_sampling_mode(0x55));
  say("speed", e_po3030k_set_speed(SPEED_4));
  say("speed", e_po3030k_set_speed(SPEED_128));
  say("config", e_po3030k_config_cam((ARRAY_WIDTH - 160) / 2, (ARRAY_HEIGHT - 160) / 2, 160, 160, 4, 4, GREY_SCALE_MODE));
  say("set", e_po3030k_set_register(0xFE, 1));
  say("set", e_po3030k_set_register(SOME_REGISTER, 0x56));
  e_po3030k_write_cam_registers();
  e_po3030k_set_register(SOME_REGISTER, 0);
  say("get", e_po3030k_get_register(SOME_REGISTER, &value));
  say("table", value);
  e_po3030k_read_cam_registers();
  e_po3030k_get_register(SOME_REGISTER, &value);
  say("sensor", value);
  e_po3030k_set_register(SOME_REGISTER, 0x21);
  say("sent", e_po3030k_sync_register_array(SOME_REGISTER - 1, SOME_REGISTER + 1));
  e_po3030k_set_register(SOME_REGISTER, 0);
  e_po3030k_read_cam_registers();
  e_po3030k_get_register(SOME_REGISTER, &value);
  say("sensor", value);
  end();
}
