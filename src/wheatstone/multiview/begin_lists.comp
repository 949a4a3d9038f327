#version 450

// Where each of 64 lists begins, one after the other, from where the first of them does.

layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer Lists { uint lists[]; };
layout(std430, binding = 1) readonly buffer Begins { uint begins[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  uint next = i < begins.length() ? begins[i] : 0;
  for (uint k = 0; k < 64; ++k) {
    uint at = 64 * i + k;
    uint count = at < lists.length() ? lists[at] : 0;
    if (at < lists.length()) lists[at] = next;
    next += count;
  }
}
