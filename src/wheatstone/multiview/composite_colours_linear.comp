#version 450

// Depth planes of three channels of light, interpolated between at most two pixels.

#define CHANNELS 3
#define TAPS 2
#include "wheatstone/multiview/composite_planes.glsl"
