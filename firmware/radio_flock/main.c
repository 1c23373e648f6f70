/* SPDX-License-Identifier: MIT
 * Radio flock: five times a second every robot tells all others by radio which way it drives, and turns towards
 * the mean of what it heard. Nobody leads; after half a minute all drive the same way.
 *
 * They share the channel by time: a period has 16 slots, and a robot speaks in the one that its selector says. All at
 * once, half of the packets would collide, and of those that arrive in a row the module keeps one.
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
#define SLOT 125              /* agenda ticks of 0.1 ms */
#define SLOTS 16              /* to a control period of 200 ms */
#define CRUISE 300            /* steps/s */
#define MOST_TURN 200         /* steps/s of each wheel */
#define STEPS_PER_TURN 2585L  /* right minus left: 2 pi x 53 mm / 0.1288 mm */
#define NEAR 200              /* counts: about 3 cm from another robot */

/* angles are bytes: 256 make a turn, and differences wrap by themselves */
static volatile int slot, slot_due;
static volatile int turned; /* steps, right minus left, when the slot began */
static volatile int heard;  /* since the last control step */
static volatile int turn;   /* steps/s of each wheel towards the mean of what was heard */
static long sum;            /* of the others' directions against ours */

/* In the interrupt, so that readings and speeds have their time, however long the main loop waits for the turret. */
static void steer(void) {
  int right = e_get_calibrated_prox(0) + e_get_calibrated_prox(1);
  int left = e_get_calibrated_prox(7) + e_get_calibrated_prox(6);
  int wanted = turn;
  if (right > NEAR || left > NEAR) wanted = right > left ? MOST_TURN : -MOST_TURN; /* keep clear first */
  e_set_speed(CRUISE, wanted);
  e_set_body_led(heard > 0);
}

static void next_slot(void) {
  slot = (slot + 1) % SLOTS;
  slot_due = 1;
  turned = (int)((unsigned int)e_get_steps_right() - (unsigned int)e_get_steps_left());
  if (slot == 0) steer();
}

static unsigned char direction(void) {
  return (unsigned char)(16 * getselector() + turned * 256L / STEPS_PER_TURN);
}

static int limited(long wanted) {
  if (wanted > MOST_TURN) return MOST_TURN;
  if (wanted < -MOST_TURN) return -MOST_TURN;
  return (int)wanted;
}

static void listen(void) {
  static unsigned char packet[COM_MODULE_MAXSIZE];
  int size;
  if (!IsPacketReady(packet, &size) || size != 1) return;
  sum += (signed char)(packet[0] - direction());
  heard++;
  turn = limited(3 * sum / (heard + 1));
}

int main(void) {
  unsigned char own;
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_init_ad_scan(ALL_ADC);
  e_calibrate_ir();
  InitComModule(COM_MODULE_DEFAULT_GROUP, 0, COM_MODULE_HW_ATTENUATOR_0DB, FULL_POWER);
  e_activate_agenda(next_slot, SLOT);
  while (1) {
    if (slot_due) {
      slot_due = 0;
      if (slot == 0) sum = heard = turn = 0;
      if (slot == getselector()) {
        own = direction();
        SendPacket(COM_MODULE_DEFAULT_GROUP, EVERYBODY, &own, 1);
      }
    }
    listen();
  }
}
