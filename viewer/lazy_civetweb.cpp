// SPDX-License-Identifier: MIT
// civetweb is loaded when a server starts.
#include "sim_core/base/lazy_library.h"

// clang-format off
#define CALLS(X) \
  X(civetweb, mg_close_connection) X(civetweb, mg_connect_client) X(civetweb, mg_get_context) X(civetweb, mg_get_header) \
  X(civetweb, mg_get_request_info) X(civetweb, mg_get_server_ports) \
  X(civetweb, mg_get_user_connection_data) X(civetweb, mg_get_user_data) X(civetweb, mg_init_library) X(civetweb, mg_printf) \
  X(civetweb, mg_send_http_error) X(civetweb, mg_set_request_handler) \
  X(civetweb, mg_set_user_connection_data) X(civetweb, mg_set_websocket_handler) X(civetweb, mg_start) \
  X(civetweb, mg_stop) X(civetweb, mg_websocket_write) X(civetweb, mg_write)
// clang-format on

LAZY_LIBRARY(civetweb, "libcivetweb.so.1", CALLS)
