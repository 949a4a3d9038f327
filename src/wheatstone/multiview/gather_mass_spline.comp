#version 450

// Gathers splats of mass by the cubic spline kernel.

#define CHANNELS 2
#define KERNEL 2
#include "wheatstone/multiview/gather_splats.glsl"
