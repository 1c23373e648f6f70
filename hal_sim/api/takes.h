/* SPDX-License-Identifier: MIT
 * TAKES(n): a call of this function costs the caller n processor cycles, CALL and RETURN included, whatever the compiler
 * estimates for its body: those of the driver's function of that name [measured: register way;
 * tests/register/function_costs_test.cpp holds both ways together].
 */
#ifndef TWINPUCK_API_TAKES_H
#define TWINPUCK_API_TAKES_H

#define TAKES(cycles) __attribute__((__noinline__, __annotate__("twinpuck cycles " #cycles)))

#endif
