#version 450

// Depth planes of mass: light, and light times a second number, interpolated by a cubic.

#define CHANNELS 2
#define TAPS 4
#include "wheatstone/multiview/composite_planes.glsl"
