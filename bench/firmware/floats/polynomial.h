/* SPDX-License-Identifier: MIT
 * What main.c calls.
 */
float polynomial(int which, float x);
