#version 450

// Gathers splats of mass: light, and light times a second number.

#define CHANNELS 2
#define KERNEL 1
#include "wheatstone/multiview/gather_splats.glsl"
