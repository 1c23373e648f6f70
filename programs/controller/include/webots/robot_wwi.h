/* SPDX-License-Identifier: MIT
 * Messages between the program and its robot's window. There is no window: nothing comes (NULL, size 0), and
 * what is sent is lost, as in Webots while no window is open.
 */
#ifndef WB_ROBOT_WWI_H
#define WB_ROBOT_WWI_H

#include <string.h> /* programs rely on it */
#include <webots/types.h>

TP_C_BEGIN

void wb_robot_wwi_send(const char* data, int size);
void wb_robot_wwi_send_text(const char* text);
const char* wb_robot_wwi_receive(int* size);
const char* wb_robot_wwi_receive_text(void);

TP_C_END

#endif
