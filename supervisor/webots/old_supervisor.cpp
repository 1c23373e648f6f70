// SPDX-License-Identifier: MIT
// device/supervisor.h over supervisor.h: buffers that fill themselves, fields by mask. [Webots: changelog-5]
#include <device/supervisor.h>

#include <memory>
#include <string>
#include <vector>

#include "supervisor/webots/shared.h"

struct NodeStruct {
  std::string def;
  int thing;
};

namespace {

constexpr bool kNue = true;  // always, in this interface

/// supervisor_field_get() with a period.
struct Subscription {
  NodeRef node;
  int mask;
  float* buffer;
  int period_ms;
  double next_s;
};

std::vector<std::unique_ptr<NodeStruct>> found_nodes;
std::vector<Subscription> subscriptions;

/// x, y, z, then axis and angle, one a bit of the mask.
void fill(const NodeStruct& node, int mask, float* buffer) {
  const webots::Pose pose = webots::pose_of(node.thing, kNue);
  for (int bit = 0; bit < 7; ++bit)
    if (mask >> bit & 1)
      *buffer++ = static_cast<float>(bit < 3 ? pose.position[bit] : pose.rotation[bit - 3]);
}

bool is_found(NodeRef node, const char* function) {
  if (node && node->thing >= 0) return true;
  webots::warn("%s: got %s, expected a node that supervisor_node_was_found()", function,
               node ? node->def.c_str() : "NULL");
  return false;
}

}  // namespace

namespace webots {

void refresh_buffers() {
  for (Subscription& s : subscriptions) {
    if (time_s() + 1e-9 < s.next_s) continue;
    while (s.next_s <= time_s() + 1e-9) s.next_s += s.period_ms / 1000.0;
    fill(*s.node, s.mask, s.buffer);
  }
}

}  // namespace webots

extern "C" {

NodeRef supervisor_node_get_from_def(const char* def) {
  const std::string name = def ? def : "";
  for (const auto& node : found_nodes)
    if (node->def == name) return node.get();
  found_nodes.push_back(std::make_unique<NodeStruct>());
  *found_nodes.back() = {name, sv_find(name.c_str())};
  return found_nodes.back().get();
}

int supervisor_node_was_found(NodeRef node) { return node && node->thing >= 0; }

void supervisor_field_get(NodeRef node, int mask, float* buffer, int period_ms) {
  if (!is_found(node, "supervisor_field_get")) return;
  for (std::size_t i = 0; i < subscriptions.size();) {
    const Subscription& s = subscriptions[i];
    if (s.node == node && s.buffer == buffer)
      subscriptions.erase(subscriptions.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
  if (!buffer) return;
  fill(*node, mask, buffer);
  if (period_ms > 0)
    subscriptions.push_back({node, mask, buffer, period_ms, webots::time_s() + period_ms / 1000.0});
}

void supervisor_field_set(NodeRef node, int mask, const float* values) {
  if (!is_found(node, "supervisor_field_set")) return;
  webots::Pose pose = webots::pose_of(node->thing, kNue);
  for (int bit = 0; bit < 7; ++bit)
    if (mask >> bit & 1)
      (bit < 3 ? pose.position[bit] : pose.rotation[bit - 3]) = static_cast<double>(*values++);
  webots::put(node->thing, pose, kNue);
}

void supervisor_set_label(int id, const char* text, float x, float y, float size, unsigned int colour) {
  sv_label(id, text, static_cast<double>(x), static_cast<double>(y), static_cast<double>(size), colour, 0);
}

void supervisor_export_image(const char* filename, int) {
  sv_picture(webots::picture_name(filename).c_str());
}
void supervisor_simulation_quit(void) { sv_end(0, "simulation_quit()"); }
void supervisor_simulation_revert(void) { webots::reset_all(); }
void supervisor_simulation_physics_reset(void) { webots::rest_all(); }

void supervisor_robot_set_controller(NodeRef robot, const char* controller) {
  if (!is_found(robot, "supervisor_robot_set_controller")) return;
  if (std::string(sv_firmware(robot->thing)) != (controller ? controller : ""))
    webots::warn("'%s' keeps its program '%s'; got '%s'", robot->def.c_str(), sv_firmware(robot->thing),
                 controller ? controller : "");
  sv_restart(robot->thing);
}
}
