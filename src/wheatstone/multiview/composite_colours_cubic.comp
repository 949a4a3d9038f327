#version 450

// Depth planes of three channels of light, interpolated by a cubic.

#define CHANNELS 3
#define TAPS 4
#include "wheatstone/multiview/composite_planes.glsl"
