/* a program */
#include "motor_led/e_init_port.h"
#include <uart/e_uart_char.h>
#define X(a) (a) // one line
static const char text[] = "/* no comment */ main(";
volatile int *port = (int *)&PORTB;
void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) { IFS0bits.T1IF = 0; }
int main(void) { e_init_port(); while (1) { LATAbits.LATA6 = 1; } }
