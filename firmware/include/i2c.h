/* SPDX-License-Identifier: MIT
 * Settings of the I2C module under the names of Microchip's peripheral library: masks for I2CCON, combined with &.
 * Constants alone. Source: bit fields [DS70143 14].
 */
#ifndef TWINPUCK_I2C_H
#define TWINPUCK_I2C_H
#ifndef __TWINPUCK__
#include_next <i2c.h>
#else
#include "p30F6014A.h"

/* I2CCON */
#define I2C_ON          0xFFFF
#define I2C_OFF         0x7FFF
#define I2C_IDLE_STOP   0xFFFF
#define I2C_IDLE_CON    0xDFFF
#define I2C_CLK_REL     0xFFFF
#define I2C_CLK_HLD     0xEFFF
#define I2C_IPMI_EN     0xFFFF
#define I2C_IPMI_DIS    0xF7FF
#define I2C_10BIT_ADD   0xFFFF
#define I2C_7BIT_ADD    0xFBFF
#define I2C_SLW_DIS     0xFFFF
#define I2C_SLW_EN      0xFDFF
#define I2C_SM_EN       0xFFFF
#define I2C_SM_DIS      0xFEFF
#define I2C_GCALL_EN    0xFFFF
#define I2C_GCALL_DIS   0xFF7F
#define I2C_STR_EN      0xFFFF
#define I2C_STR_DIS     0xFFBF
#define I2C_NACK        0xFFFF
#define I2C_ACK         0xFFDF
#define I2C_ACK_EN      0xFFFF
#define I2C_ACK_DIS     0xFFEF
#define I2C_RCV_EN      0xFFFF
#define I2C_RCV_DIS     0xFFF7
#define I2C_STOP_EN     0xFFFF
#define I2C_STOP_DIS    0xFFFB
#define I2C_RESTART_EN  0xFFFF
#define I2C_RESTART_DIS 0xFFFD
#define I2C_START_EN    0xFFFF
#define I2C_START_DIS   0xFFFE

#endif
#endif
