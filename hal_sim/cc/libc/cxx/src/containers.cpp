// SPDX-License-Identifier: MIT
// C++ for firmware: what the headers of std::map, std::list and std::unordered_map leave to the library. The
// trees of maps and sets are not balanced: a map that is filled in order is as slow as a list.
#include <list>
#include <map>
#include <unordered_map>

namespace std {
namespace {

using Node = _Rb_tree_node_base;

/// The header's parent is the root, and the root's parent the header.
Node*& link_to(Node* node, Node& header) {
  Node* above = node->_M_parent;
  return above == &header ? header._M_parent : above->_M_left == node ? above->_M_left : above->_M_right;
}

Node* next(Node* node) {
  if (node->_M_right) return Node::_S_minimum(node->_M_right);
  Node* above = node->_M_parent;
  while (node == above->_M_right) node = above, above = above->_M_parent;
  // the header's right is the last node, which may be the root itself
  return node->_M_right == above ? node : above;
}

Node* previous(Node* node) {
  // nodes are black, only the header is red
  if (node->_M_color == _S_red) return node->_M_right;
  if (node->_M_left) return Node::_S_maximum(node->_M_left);
  Node* above = node->_M_parent;
  while (node == above->_M_left) node = above, above = above->_M_parent;
  return above;
}

}  // namespace

Node* _Rb_tree_increment(Node* node) throw() { return next(node); }
const Node* _Rb_tree_increment(const Node* node) throw() { return next(const_cast<Node*>(node)); }
Node* _Rb_tree_decrement(Node* node) throw() { return previous(node); }
const Node* _Rb_tree_decrement(const Node* node) throw() { return previous(const_cast<Node*>(node)); }

void _Rb_tree_insert_and_rebalance(const bool left, Node* node, Node* above, Node& header) throw() {
  node->_M_parent = above;
  node->_M_left = node->_M_right = nullptr;
  node->_M_color = _S_black;
  if (above == &header) {
    header._M_parent = header._M_left = header._M_right = node;
  } else if (left) {
    above->_M_left = node;
    if (header._M_left == above) header._M_left = node;
  } else {
    above->_M_right = node;
    if (header._M_right == above) header._M_right = node;
  }
}

Node* _Rb_tree_rebalance_for_erase(Node* const node, Node& header) throw() {
  Node* heir = node->_M_left ? node->_M_left : node->_M_right;
  if (node->_M_left && node->_M_right) {
    heir = Node::_S_minimum(node->_M_right);  // has nothing on its left
    if (heir->_M_parent != node) {
      heir->_M_parent->_M_left = heir->_M_right;
      if (heir->_M_right) heir->_M_right->_M_parent = heir->_M_parent;
      heir->_M_right = node->_M_right;
      heir->_M_right->_M_parent = heir;
    }
    heir->_M_left = node->_M_left;
    heir->_M_left->_M_parent = heir;
  }
  link_to(node, header) = heir;
  if (heir) heir->_M_parent = node->_M_parent;
  Node* root = header._M_parent;
  header._M_left = root ? Node::_S_minimum(root) : &header;
  header._M_right = root ? Node::_S_maximum(root) : &header;
  return node;
}

namespace __detail {

void _List_node_base::_M_hook(_List_node_base* const before) noexcept {
  _M_next = before;
  _M_prev = before->_M_prev;
  before->_M_prev->_M_next = this;
  before->_M_prev = this;
}

void _List_node_base::_M_unhook() noexcept {
  _M_prev->_M_next = _M_next;
  _M_next->_M_prev = _M_prev;
}

void _List_node_base::_M_transfer(_List_node_base* const first, _List_node_base* const last) noexcept {
  if (this == last) return;
  _List_node_base* const end = last->_M_prev;
  first->_M_prev->_M_next = last;
  last->_M_prev = first->_M_prev;
  first->_M_prev = _M_prev;
  end->_M_next = this;
  _M_prev->_M_next = first;
  _M_prev = end;
}

void _List_node_base::_M_reverse() noexcept {
  _List_node_base* node = this;
  do {
    _List_node_base* const after = node->_M_next;
    node->_M_next = node->_M_prev;
    node->_M_prev = after;
    node = after;
  } while (node != this);
}

void _List_node_base::swap(_List_node_base& a, _List_node_base& b) noexcept {
  _List_node_base* const after_a = a._M_next == &a ? &b : a._M_next;
  _List_node_base* const before_a = a._M_next == &a ? &b : a._M_prev;
  const bool b_empty = b._M_next == &b;
  a._M_next = b_empty ? &a : b._M_next;
  a._M_prev = b_empty ? &a : b._M_prev;
  if (!b_empty) a._M_next->_M_prev = a._M_prev->_M_next = &a;
  b._M_next = after_a;
  b._M_prev = before_a;
  if (after_a != &b) b._M_next->_M_prev = b._M_prev->_M_next = &b;
}

// odd numbers of buckets, twice as many each time
size_t _Prime_rehash_policy::_M_next_bkt(size_t least) const {
  size_t buckets = 13;
  while (buckets < least && buckets < 30000) buckets = 2 * buckets + 1;
  _M_next_resize = static_cast<size_t>(static_cast<float>(buckets) * _M_max_load_factor);
  return buckets;
}

pair<bool, size_t> _Prime_rehash_policy::_M_need_rehash(size_t, size_t elements, size_t more) const {
  if (elements + more <= _M_next_resize) return {false, 0};
  return {true, _M_next_bkt(_M_bkt_for_elements(elements + more) * _S_growth_factor)};
}

}  // namespace __detail

size_t _Hash_bytes(const void* bytes, size_t length, size_t seed) {
  unsigned long hash = 2166136261UL ^ seed;  // FNV-1a
  for (size_t i = 0; i < length; ++i)
    hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 16777619UL;
  return static_cast<size_t>(hash ^ (hash >> 16));
}

}  // namespace std
