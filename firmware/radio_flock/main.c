/* SPDX-License-Identifier: MIT
 * Radio flock: five times a second every robot tells all others by radio which way it drives, and turns towards
 * the mean of what it heard. Nobody leads; after half a minute all drive the same way.
 *
 * A robot has no compass: it counts its wheels' steps from a direction that its selector tells, 22.5 degrees a
 * position, counter-clockwise from the world's x axis. Set the switch to how the robot stands.
 */
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <contrib/SWIS_com_module/ComModule.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
#include <utility/utility.h>

#define EVERYBODY 0xFFFF
#define FULL_POWER 1
#define CONTROL_PERIOD 2000   /* agenda ticks of 0.1 ms */
#define CRUISE 300            /* steps/s */
#define MOST_TURN 200         /* steps/s of each wheel */
#define STEPS_PER_TURN 2585L  /* right minus left: 2 pi x 53 mm / 0.1288 mm */
#define NEAR 200              /* counts: about 3 cm from another robot */

/* angles are bytes: 256 make a turn, and differences wrap by themselves */
static volatile int control_due;
static long sum;  /* of the others' directions against ours */
static int heard; /* since the last control step */

static void control_tick(void) { control_due = 1; }

static unsigned char direction(void) {
  int turned = (int)((unsigned int)e_get_steps_right() - (unsigned int)e_get_steps_left());
  return (unsigned char)(16 * getselector() + turned * 256L / STEPS_PER_TURN);
}

static void listen(void) {
  static unsigned char packet[COM_MODULE_MAXSIZE];
  int size;
  if (!IsPacketReady(packet, &size) || size != 1) return;
  sum += (signed char)(packet[0] - direction());
  heard++;
}

static void steer(void) {
  int turn = heard > 0 ? (int)(3 * sum / (heard + 1)) : 0;
  int right = e_get_calibrated_prox(0) + e_get_calibrated_prox(1);
  int left = e_get_calibrated_prox(7) + e_get_calibrated_prox(6);
  if (turn > MOST_TURN) turn = MOST_TURN;
  if (turn < -MOST_TURN) turn = -MOST_TURN;
  if (right > NEAR || left > NEAR) turn = right > left ? MOST_TURN : -MOST_TURN; /* keep clear first */
  e_set_speed(CRUISE, turn);
  e_set_body_led(heard > 0);
}

int main(void) {
  unsigned char own;
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_init_ad_scan(ALL_ADC);
  e_calibrate_ir();
  InitComModule(COM_MODULE_DEFAULT_GROUP, 0, COM_MODULE_HW_ATTENUATOR_0DB, FULL_POWER);
  e_activate_agenda(control_tick, CONTROL_PERIOD);
  while (1) {
    listen();
    if (!control_due) continue;
    control_due = 0;
    steer();
    sum = heard = 0;
    own = direction();
    SendPacket(COM_MODULE_DEFAULT_GROUP, EVERYBODY, &own, 1);
  }
}
