/* SPDX-License-Identifier: MIT
 * Inside the library behind webots/ and device/: the list of devices and the clock that both interfaces share.
 * A device's file gives it a function that takes its sample; core.c calls it once a period, at the end of a step.
 */
#ifndef WEBOTS_CORE_H
#define WEBOTS_CORE_H

#include "simulator.h"
#include "webots/nodes.h"

#define WEBOTS_MOST_DEVICES 48 /* 43 of the robot, the turret's two, what programs do not see; each takes 16 bytes */
#define WEBOTS_WHEEL_STEPS 1000 /* a turn */
#define WEBOTS_MAX_RAD_S 6.2831853f /* 1000 steps/s */
#define WEBOTS_PI 3.14159265f
#define WEBOTS_G_M_S2 9.81f

struct webots_device {
  const char* name;
  void (*sample)(struct webots_device* device);
  int period;           /* ms; 0 disabled */
  int elapsed;          /* ms since the last sample */
  float value;          /* of sensors with one number */
  unsigned char node;   /* WbNodeType */
  unsigned char index;  /* among its kind: sensor number, wheel 0 left 1 right, end of packets */
  unsigned char source; /* enum webots_source */
  unsigned char fresh;  /* a first sample has been taken */
};

/* where a device's values come from */
enum webots_source { WEBOTS_ROBOT, WEBOTS_GROUND };

/** Starts library and clock, once. Blocks for about 0.2 s the first time. */
void webots_init(void);

/** Waits for the end of the next step of `ms` and samples what is due. Returns the time that has passed, ms. */
int webots_step(int ms);

/** Device of a name, with a warning that names `function` and 0 when there is none. */
unsigned short webots_find(const char* name, const char* function);

/** One more device, without a name for programs; null when the list is full. */
struct webots_device* webots_add(const char* name, WbNodeType node, int index, int source);

/** The device of a tag if it is of that kind, else a warning that names `function`, and null. */
struct webots_device* webots_device_of(unsigned short tag, WbNodeType node, const char* function);

/** Tag of the first device of a kind with that index; 0: there is none. */
unsigned short webots_tag_of(WbNodeType node, int index);

/** Samples from now on every `period` ms; 0 or less: no more. */
void webots_enable(struct webots_device* device, int period, void (*sample)(struct webots_device* device));

/** A line on the console, with the robot's name of the function before it. */
void webots_warn(const char* function, const char* what);

/** ms since webots_init(), the sum of all steps. */
unsigned long webots_time_ms(void);

/** LED 0 to 9 on or off. */
void webots_led(int led, int on);
/** Shows them again after something has cleared the ports. */
void webots_show_leds(void);

/** Converts forward, left, up to the axes of the world file. */
void webots_robot_axes(float forward, float left, float up, float* xyz);

/** Wheels: speed in rad/s without limit of time; steps since the start, 32 bits; speed unit, rad/s. */
void webots_wheel_speed(int wheel, float rad_s);
float webots_wheel_command(int wheel);
long webots_wheel_steps(int wheel);
float webots_speed_unit(void);

/** Called at the end of every step. */
void webots_wheels_step(void);

/** Called at the beginning of every step if it is not null: a picture is taken while the program waits. */
extern void (*webots_before_step)(void);

#endif
