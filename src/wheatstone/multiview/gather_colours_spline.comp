#version 450

// Gathers splats of mass in colours of their own, by the cubic spline kernel.

#define CHANNELS 3
#define KERNEL 2
#include "wheatstone/multiview/gather_splats.glsl"
