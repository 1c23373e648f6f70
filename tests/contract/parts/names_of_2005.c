/* SPDX-License-Identifier: MIT
 * The library's names of 2005, which are the basic functions of today. */
#include "say.h"
#include <ad_conv.h>
#include <led.h>
#include <motor_led/e_epuck_ports.h>
#include <motors.h>
#include <prox.h>

/* uart_char.h shares its guard with the header of today */
void InitUart1(void);
int GetcharUart1(char* car);
void SendUart1Char(char* buff, int length);
void InitUart2(void);
int GetcharUart2(char* car);
void SendUart2Char(char* buff, int length);

static int light(int number) {
  const int leds[8] = {LED0, LED1, LED2, LED3, LED4, LED5, LED6, LED7};
  return leds[number];
}

int main(void) {
  char got = 0;
  int i, right_one = 0;
  long passed;
  begin();
  InitUart1();
  SendUart1Char("sent 1\n", 7);
  while (e_uart1_sending()) continue;
  say("got1", GetcharUart1(&got));
  InitUart2();
  SendUart2Char("other\n", 6);
  say("busy2", e_uart2_sending() != 0);
  say("there2", e_ischar_uart2());
  say("got2", GetcharUart2(&got));
  for (i = 0; i < 8; i++) {
    LedClear();
    SetLed((unsigned int)i, 1);
    right_one += light(i) && !light((i + 1) % 8);
    SetLed((unsigned int)i, 2);
    right_one += !light(i);
  }
  say("leds", right_one);
  SetBodyLed(1);
  SetFrontLed(1);
  say("lights", BODY_LED + FRONT_LED);
  SetBodyLed(0);
  SetFrontLed(2);
  say("lights", BODY_LED + FRONT_LED);
  InitAd();
  say("microphone", ReadAd(2));
  InitProx(); /* it takes timer 1 */
  for (passed = 0; passed < 20000; passed++) ClrWdt();
  say("prox", GetProx(0));
  say("ambient", GetAmbientLight(0) > 3000);
  InitMotors();
  SetStepsLeft(7);
  SetStepsRight(0);
  SetSpeedLeft(500);
  SetSpeedRight(-1000);
  pause_ms(1000);
  say("left", GetStepsLeft());
  say("right", GetStepsRight());
  SetSpeedLeft(0);
  SetSpeedRight(0);
  end();
}
