// One particle of KIND_OF_LIGHT: it is projected and lit once, and told what kind of splat it is.

layout(local_size_x = 64) in;

#include "wheatstone/multiview/splat_work.glsl"
#include "wheatstone/multiview/splat_kinds.glsl"

layout(std430, binding = 2) writeonly buffer Splats { vec4 splats[]; };  // place, parallax, size; light, kind
layout(std430, binding = 3) buffer Reaches { uint reaches[]; };          // of each kind: the largest, as its bits

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(particles)) return;
  Splat splat;
  uint kind = no_kind;
  if (project(i, splat)) {
    float reach = reach_in_lists(splat.size);
    kind = uint(kind_of(splat.picture, max(max(abs(splat.light.r), abs(splat.light.g)), abs(splat.light.b)), reach));
    uint bits = floatBitsToUint(reach);
    if (reaches[kind] < bits) atomicMax(reaches[kind], bits);
  }
  splats[2 * i] = vec4(clamp(splat.x, -1e8, 1e8), clamp(splat.y, -1e8, 1e8), splat.parallax, splat.size);
  splats[2 * i + 1] = vec4(splat.light, uintBitsToFloat(kind));
}
