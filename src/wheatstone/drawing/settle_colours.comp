#version 450

// Every second pixel of a picture, as on a chequerboard, takes the mean of its neighbours, over-relaxed; each is held at
// the colour of its lines by their weight. The twin of settle in draw_diffusion.cpp.

layout(local_size_x = 64) in;

const float over_relaxation = 1.8;

layout(std430, binding = 0) readonly buffer Work {  // LevelWork
  int width, height, coarse_width, coarse_height;
  int odd;
};
layout(std430, binding = 1) readonly buffer Lines { vec4 lines[]; };
layout(std430, binding = 2) buffer Colours { vec4 colours[]; };

void main() {
  int y = int(gl_GlobalInvocationID.y);
  int x = 2 * int(gl_GlobalInvocationID.x) + ((y + odd) & 1);
  int v = int(gl_GlobalInvocationID.z);
  if (x >= width) return;
  int first = v * width * height;
  int at = first + y * width + x;
  vec4 line = lines[at];
  if (line.a >= 1) return;
  vec3 mean = (colours[first + max(y - 1, 0) * width + x].rgb + colours[first + min(y + 1, height - 1) * width + x].rgb +
               colours[first + y * width + max(x - 1, 0)].rgb + colours[first + y * width + min(x + 1, width - 1)].rgb) /
              4;
  vec3 wanted = mean + line.a * (line.rgb - mean);
  vec3 before = colours[at].rgb;
  colours[at] = vec4(before + over_relaxation * (wanted - before), line.a);
}
