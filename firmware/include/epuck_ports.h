/* SPDX-License-Identifier: MIT
 * Names of the e-puck's pins and clock, as the library spelled them before 2006. Same pins, and the same
 * meaning, as in motor_led/e_epuck_ports.h, with which it shares its guard.
 */
#ifndef _EPUCK_PORTS
#define _EPUCK_PORTS

#include "p30F6014A.h"

#define FOSC 7.3728e6            /* crystal, Hz */
#define PLL 8.0                  /* multiplier */
#define FCY ((FOSC*PLL)/(4.0))   /* instruction cycles per second */
#define MILLISEC (FCY/1.0e3)     /* cycles per millisecond */
#define MICROSEC (FCY/1.0e6)     /* cycles per microsecond */
#define NANOSEC (FCY/1.0e9)      /* cycles per nanosecond, below 1 */
#define TCY_PIC (1e9/FCY)        /* one cycle, ns */
#define INTERRUPT_DELAY (10*TCY_PIC) /* time to enter an interrupt handler, ns */

#define TRUE 1
#define FALSE 0
#define OUTPUT_PIN 0
#define INPUT_PIN 1

/* ring LEDs, 1 = on */
#define LED0 _LATA6
#define LED0_dir _TRISA6
#define LED1 _LATA7
#define LED1_dir _TRISA7
#define LED2 _LATA9
#define LED2_dir _TRISA9
#define LED3 _LATA12
#define LED3_dir _TRISA12
#define LED4 _LATA10
#define LED4_dir _TRISA10
#define LED5 _LATA13
#define LED5_dir _TRISA13
#define LED6 _LATA14
#define LED6_dir _TRISA14
#define LED7 _LATA15
#define LED7_dir _TRISA15

/* front and body LED */
#define front_LED _LATC1
#define front_LED_dir _TRISC1
#define body_LED _LATC2
#define body_LED_dir _TRISC2

/* IR emitters: sensors 0 and 4, 1 and 5, 2 and 6, 3 and 7 */
#define pulse_IR0 _LATF7
#define pulse_IR1 _LATF8
#define pulse_IR2 _LATG0
#define pulse_IR3 _LATG1
#define pulse_IR0_dir _TRISF7
#define pulse_IR1_dir _TRISF8
#define pulse_IR2_dir _TRISG0
#define pulse_IR3_dir _TRISG1

/* analogue channels */
#define IR0 8
#define IR1 9
#define IR2 10
#define IR3 11
#define IR4 12
#define IR5 13
#define IR6 14
#define IR7 15
#define MIC1 2
#define MIC2 3
#define MIC3 4
#define ACCX 5
#define ACCY 6
#define ACCZ 7

/* codec and amplifier */
#define audio_on _LATF0
#define audio_on_dir _TRISF0

/* coils of the stepper motors; motor 1 is the left one */
#define motor1_pha _LATD0
#define motor1_pha_dir _TRISD0
#define motor1_phb _LATD1
#define motor1_phb_dir _TRISD1
#define motor1_phc _LATD2
#define motor1_phc_dir _TRISD2
#define motor1_phd _LATD3
#define motor1_phd_dir _TRISD3
#define motor2_pha _LATD4
#define motor2_pha_dir _TRISD4
#define motor2_phb _LATD5
#define motor2_phb_dir _TRISD5
#define motor2_phc _LATD6
#define motor2_phc_dir _TRISD6
#define motor2_phd _LATD7
#define motor2_phd_dir _TRISD7

/* I2C, battery, selector, remote control */
#define SIO_D _LATG3
#define SIO_D_dir _TRISG3
#define SIO_C _LATG2
#define SIO_C_dir _TRISG2
#define batt_low _RF1
#define batt_low_dir _TRISF1
#define selector0 _RG6
#define selector0_dir _TRISG6
#define selector1 _RG7
#define selector1_dir _TRISG7
#define selector2 _RG8
#define selector2_dir _TRISG8
#define selector3 _RG9
#define selector3_dir _TRISG9
#define remote _RF6
#define remote_dir _TRISF6

/* camera; CAM_data carries its semicolon */
#define CAM_reset _LATC13
#define CAM_reset_dir _TRISC13
#define CAM_data PORTD;
#define CAM_y0 _RD8
#define CAM_y0_dir _TRISD8
#define CAM_y1 _RD9
#define CAM_y1_dir _TRISD9
#define CAM_y2 _RD10
#define CAM_y2_dir _TRISD10
#define CAM_y3 _RD11
#define CAM_y3_dir _TRISD11
#define CAM_y4 _RD12
#define CAM_y4_dir _TRISD12
#define CAM_y5 _RD13
#define CAM_y5_dir _TRISD13
#define CAM_y6 _RD14
#define CAM_y6_dir _TRISD14
#define CAM_y7 _RD15
#define CAM_y7_dir _TRISD15
#define CAM_pwdn _RC2
#define CAM_vsync _RC4
#define CAM_href _RC3
#define CAM_pclk _RC14
#define CAM_pwdn_dir _TRISC2
#define CAM_vsync_dir _TRISC4
#define CAM_href_dir _TRISC3
#define CAM_pclk_dir _TRISC14

/* single instructions not in the device header */
#define InterruptOFF() {__asm__ volatile ("disi #10000");}
#define InterruptON() {__asm__ volatile ("disi #2");}

/* a timer's interrupt off */
#define stop_TMR1 IEC0bits.T1IE = 0
#define stop_TMR2 IEC0bits.T2IE = 0
#define stop_TMR3 IEC0bits.T3IE = 0
#define stop_TMR4 IEC1bits.T4IE = 0
#define stop_TMR5 IEC1bits.T5IE = 0

#endif
