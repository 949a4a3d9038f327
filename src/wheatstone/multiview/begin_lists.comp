#version 450

// How many entries 64 lists have together (STEP 0); then where each of them begins, one after the other, from where the
// first of them does (STEP 1).
// Variant: STEP=0
// Variant: STEP=1
#define SUMS 0
#define BEGINS 1

layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer Lists { uint lists[]; };
layout(std430, binding = 1) buffer Together { uint together[]; };  // of 64 lists: their sum, then where they begin

void main() {
  uint i = gl_GlobalInvocationID.x;
  uint next = STEP == BEGINS && i < together.length() ? together[i] : 0;
  for (uint k = 0; k < 64; ++k) {
    uint at = 64 * i + k;
    uint count = at < lists.length() ? lists[at] : 0;
    if (STEP == BEGINS && at < lists.length()) lists[at] = next;
    next += count;
  }
  if (STEP == SUMS && i < together.length()) together[i] = next;
}
