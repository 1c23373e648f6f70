/* SPDX-License-Identifier: MIT
 * Clock and list of devices behind webots/ and device/.
 *
 * The clock is an agenda: it fires at the end of every step, and re-times itself so that steps of whole milliseconds
 * stay exact in the long run although an agenda counts ticks of 100.03 us. Motors (agendas as well) and the ADC
 * scan go on beside it. A step longer than LONGEST_MS is waited for in pieces.
 */
#include "core.h"

#include <p30F6014A.h>
#include <stdio.h>
#include <string.h>

#include "I2C/e_I2C_protocol.h"
#include "a_d/advance_ad_scan/e_ad_conv.h"
#include "motor_led/advance_one_timer/e_agenda.h"
#include "motor_led/advance_one_timer/e_led.h"
#include "motor_led/advance_one_timer/e_motors.h"
#include "motor_led/e_init_port.h"
#include "webots/device.h"
#include "webots/robot.h"

/* an agenda's tick in tenths of a cycle, and a millisecond [lib: motor_led/advance_one_timer/e_agenda.c] */
#define TICK_TENTHS 14750UL
#define MS_TENTHS 147456UL
#define LONGEST_MS 5000 /* 50,000 ticks, an agenda has 16 bits */

#define RING 8
#define LEDS 10
#define GROUND 3
#define MOST_WARNINGS 20
#define NOBODY 0xFF /* what the bus reads where nothing answers: its lines are high */
#define GROUND_ADDRESS ((char)0xC0) /* [Webots: libepuck, ground sensors] */

static struct webots_device devices[WEBOTS_MOST_DEVICES];
static int device_count;

static unsigned char is_running;
static unsigned int leds_on;

/* --- the clock */

static volatile unsigned int fired; /* ends of steps that the agenda has seen */
static int clock_ms;                /* what the agenda counts; 0 before the first step */
static unsigned long rest_tenths;   /* of a tick, carried on */
static unsigned long time_ms;

static int next_interval(void) {
  unsigned long tenths = rest_tenths + (unsigned long)clock_ms * MS_TENTHS;
  rest_tenths = tenths % TICK_TENTHS;
  return (int)(unsigned int)(tenths / TICK_TENTHS);
}

static void end_of_step(void) {
  fired++;
  e_set_agenda_cycle(end_of_step, next_interval());
}

/* Waits for the next multiple of `ms` since the end of the last piece; what was missed is skipped. */
static int wait_piece(int ms) {
  unsigned int before;
  if (ms != clock_ms) {
    int first = clock_ms == 0;
    clock_ms = ms;
    rest_tenths = 0;
    if (first)
      e_activate_agenda(end_of_step, next_interval());
    else
      e_set_agenda_cycle(end_of_step, next_interval()); /* the count since the last end goes on */
    fired = 0;
  }
  before = fired;
  while (fired == before) {
  }
  before = fired;
  fired = 0;
  return before > 32767u / (unsigned int)ms ? 32767 : (int)before * ms;
}

void (*webots_before_step)(void);

int webots_step(int ms) {
  int passed = 0, i;
  webots_init();
  if (ms <= 0) return 0;
  if (webots_before_step) webots_before_step();
  while (ms - passed > LONGEST_MS) passed += wait_piece(LONGEST_MS);
  if (ms > passed) passed += wait_piece(ms - passed);
  time_ms += (unsigned int)passed;
  webots_wheels_step();
  for (i = 0; i < device_count; i++) {
    struct webots_device* d = &devices[i];
    if (d->period <= 0) continue;
    d->elapsed = d->elapsed > 32767 - passed ? 32767 : d->elapsed + passed;
    if (d->elapsed < d->period) continue;
    d->elapsed = 0;
    d->sample(d);
    d->fresh = 1;
  }
  return passed;
}

unsigned long webots_time_ms(void) { return time_ms; }

/* --- the devices */

struct webots_device* webots_add(const char* name, WbNodeType node, int index, int source) {
  struct webots_device* d = &devices[device_count];
  if (device_count == WEBOTS_MOST_DEVICES) return 0;
  device_count++;
  d->name = name;
  d->node = (unsigned char)node;
  d->index = (unsigned char)index;
  d->source = (unsigned char)source;
  return d;
}

static void add_devices(void) {
  static const char* const kProximity[RING] = {"ps0", "ps1", "ps2", "ps3", "ps4", "ps5", "ps6", "ps7"};
  static const char* const kLight[RING] = {"ls0", "ls1", "ls2", "ls3", "ls4", "ls5", "ls6", "ls7"};
  static const char* const kLeds[LEDS] = {"led0", "led1", "led2", "led3", "led4",
                                          "led5", "led6", "led7", "led8", "led9"};
  int i;
  for (i = 0; i < RING; i++) {
    /* the lab counts clockwise from the left, the product from the front right */
    int sensor = twin_lab_order() ? (i + 5) % RING : i;
    webots_add(kProximity[i], WB_NODE_DISTANCE_SENSOR, sensor, WEBOTS_ROBOT);
    webots_add(kLight[i], WB_NODE_LIGHT_SENSOR, sensor, WEBOTS_ROBOT);
  }
  for (i = 0; i < LEDS; i++) webots_add(kLeds[i], WB_NODE_LED, i, WEBOTS_ROBOT);
  webots_add("left wheel motor", WB_NODE_ROTATIONAL_MOTOR, 0, WEBOTS_ROBOT);
  webots_add("right wheel motor", WB_NODE_ROTATIONAL_MOTOR, 1, WEBOTS_ROBOT);
  webots_add("left wheel sensor", WB_NODE_POSITION_SENSOR, 0, WEBOTS_ROBOT);
  webots_add("right wheel sensor", WB_NODE_POSITION_SENSOR, 1, WEBOTS_ROBOT);
  webots_add("accelerometer", WB_NODE_ACCELEROMETER, 0, WEBOTS_ROBOT);
  if (isEpuckVersion1_3()) webots_add("gyro", WB_NODE_GYRO, 0, WEBOTS_ROBOT);
  webots_add("camera", WB_NODE_CAMERA, 0, WEBOTS_ROBOT);
  webots_add("mic0", WB_NODE_MICROPHONE, 0, WEBOTS_ROBOT);
  webots_add("mic1", WB_NODE_MICROPHONE, 1, WEBOTS_ROBOT);
  webots_add("mic2", WB_NODE_MICROPHONE, 2, WEBOTS_ROBOT);
  webots_add("speaker", WB_NODE_SPEAKER, 0, WEBOTS_ROBOT);
  /* packets go over the radio turret; whether it is there is asked when a program uses them */
  webots_add("emitter", WB_NODE_EMITTER, 0, WEBOTS_ROBOT);
  webots_add("receiver", WB_NODE_RECEIVER, 0, WEBOTS_ROBOT);
}

/* The bus is asked only when a program wants these; who has none leaves it unused. */
static void add_ground_sensors(void) {
  static const char* const kNames[GROUND] = {"gs0", "gs1", "gs2"};
  static unsigned char asked;
  unsigned char high;
  int i;
  if (asked) return;
  asked = 1;
  e_i2cp_init();
  e_i2cp_enable();
  high = (unsigned char)e_i2cp_read(GROUND_ADDRESS, 0); /* of the left one's counts, about 1000 at most */
  e_i2cp_disable();
  if (high == NOBODY) return;
  for (i = 0; i < GROUND; i++) webots_add(kNames[i], WB_NODE_DISTANCE_SENSOR, i, WEBOTS_GROUND);
}

/* programs repeat their mistakes every step */
static int too_many(void) {
  static unsigned char told;
  if (told > MOST_WARNINGS) return 1;
  if (told++ < MOST_WARNINGS) return 0;
  printf("Warning: there are more warnings of this kind, which are not shown\n");
  return 1;
}

unsigned short webots_find(const char* name, const char* function) {
  const char* wanted = name;
  char ground[4];
  int i;
  webots_init();
  /* floor sensors had other names once */
  if (name[0] == 'f' && name[1] == 's' && strlen(name) == 3) {
    strcpy(ground, name);
    ground[0] = 'g';
    wanted = ground;
  }
  if (wanted[0] == 'g' && wanted[1] == 's' && strlen(wanted) == 3) add_ground_sensors();
  for (i = 0; i < device_count; i++)
    if (strcmp(devices[i].name, wanted) == 0) return (unsigned short)(i + 1);
  if (too_many()) return 0;
  printf("Warning: %s(): got device \"%s\", expected one that this robot has\n", function, name);
  return 0;
}

int wb_robot_get_number_of_devices(void) {
  webots_init();
  return device_count;
}

WbDeviceTag wb_robot_get_device_by_index(int index) {
  webots_init();
  return index >= 0 && index < device_count ? (WbDeviceTag)(index + 1) : 0;
}

static const struct webots_device* any_device(WbDeviceTag tag) {
  return tag > 0 && tag <= (unsigned int)device_count ? &devices[tag - 1] : 0;
}

const char* wb_device_get_name(WbDeviceTag tag) { return any_device(tag) ? any_device(tag)->name : ""; }
const char* wb_device_get_model(WbDeviceTag tag) { return wb_device_get_name(tag); }
WbNodeType wb_device_get_node_type(WbDeviceTag tag) {
  return any_device(tag) ? (WbNodeType)any_device(tag)->node : WB_NODE_NO_NODE;
}
WbNodeType wb_device_get_type(WbDeviceTag tag) { return wb_device_get_node_type(tag); }

struct webots_device* webots_device_of(unsigned short tag, WbNodeType node, const char* function) {
  if (tag > 0 && tag <= (unsigned int)device_count && devices[tag - 1].node == node) return &devices[tag - 1];
  webots_warn(function, "got a tag that is no device of the kind, expected one of wb_robot_get_device()");
  return 0;
}

unsigned short webots_tag_of(WbNodeType node, int index) {
  int i;
  for (i = 0; i < device_count; i++)
    if (devices[i].node == node && devices[i].index == index) return (unsigned short)(i + 1);
  return 0;
}

void webots_enable(struct webots_device* device, int period, void (*sample)(struct webots_device*)) {
  device->sample = sample;
  device->period = period > 0 ? period : 0;
  device->elapsed = 0;
}

void webots_warn(const char* function, const char* what) {
  if (!too_many()) printf("Warning: %s(): %s\n", function, what);
}

void webots_robot_axes(float forward, float left, float up, float* xyz) {
  if (twin_nue()) {
    xyz[0] = -left;
    xyz[1] = up;
    xyz[2] = -forward;
  } else {
    xyz[0] = forward;
    xyz[1] = left;
    xyz[2] = up;
  }
}

/* --- LEDs */

void webots_led(int led, int on) {
  if (on)
    leds_on |= 1u << led;
  else
    leds_on &= ~(1u << led);
  if (led < 8)
    e_set_led((unsigned int)led, on != 0);
  else if (led == 8)
    e_set_body_led(on != 0);
  else
    e_set_front_led(on != 0);
}

void webots_show_leds(void) {
  int led;
  for (led = 0; led < LEDS; led++) webots_led(led, leds_on >> led & 1);
}

/* --- the beginning */

#define UART_115200 7 /* FCY / (16 * 115200) - 1, FCY 14.7456 MHz [DS70143 17.0] */
static unsigned char is_of_2005;

int webots_is_of_2005(void) { return is_of_2005; }
void webots_begin_2005(void) {
  if (!is_running) is_of_2005 = 1;
}

/* text goes to UART 1, which sends without interrupts, as printf() on the chip does */
static void open_console(void) {
  U1BRG = UART_115200;
  U1MODE = 0x8000;
  U1STA = 0x0400;
}

void webots_init(void) {
  if (is_running) return;
  is_running = 1;
  e_init_port();
  open_console();
  e_init_motors();
  e_start_agendas_processing();
  e_init_ad_scan(ALL_ADC);
  add_devices();
}
