/* SPDX-License-Identifier: MIT
 * The mouse. There is no window: no button is pressed, and it points at nothing (NaN).
 */
#ifndef WB_MOUSE_H
#define WB_MOUSE_H

#include <webots/mouse_state.h>
#include <webots/types.h>

TP_C_BEGIN

void wb_mouse_enable(int sampling_period);
void wb_mouse_disable(void);
int wb_mouse_get_sampling_period(void);
void wb_mouse_enable_3d_position(void);
void wb_mouse_disable_3d_position(void);
bool wb_mouse_is_3d_position_enabled(void);
WbMouseState wb_mouse_get_state(void);
/** Valid until the next call. */
WbMouseState* wb_mouse_get_state_pointer(void);

TP_C_END

#endif
