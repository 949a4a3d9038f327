#version 450

// Depth planes of mass: light, and light times a second number, interpolated between at most two pixels.

#define CHANNELS 2
#define TAPS 2
#include "wheatstone/multiview/composite_planes.glsl"
