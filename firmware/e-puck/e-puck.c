/**************************************************************************/
/* Name: e-puck.c */
/* Author: Olivier Michel <[email protected]> */
/* Date: October 21th, 2005 */
/**************************************************************************/
#include <device/robot.h>
#include <device/differential_wheels.h>
#include <device/distance_sensor.h>
#define NB_SENSORS 8
#define TIME_STEP 64
DeviceTag ps[NB_SENSORS];
static void reset(void) {
int i;
char name[4]="ps0";
for(i=0;i<NB_SENSORS;i++) {
ps[i]=robot_get_device(name); /* get a handler to the sensor */
/* perform distance measurements every TIME_STEP millisecond */
distance_sensor_enable(ps[i],TIME_STEP);
name[2]++; /* increase the device name to "ps1", "ps2", etc. */
}
}
static int run(int ms) {
int v;
v = distance_sensor_get_value(ps[2]); /* range: 0 (far) to 4095 (close) */
robot_console_printf("v=%d\n",v);
if (v>512) { /* we detected an obstacle with this sensor */
differential_wheels_set_speed(20,-20); /* spin round */
return 1280; /* for 1280 milliseconds */
} else {
differential_wheels_set_speed(20,16); /* advance, slightly turning */
return 64; /* for 64 milliseconds. */
}
}
int main() {
robot_live(reset); /* initialization */
robot_run(run); /* starts the controller */
return 0;
}
