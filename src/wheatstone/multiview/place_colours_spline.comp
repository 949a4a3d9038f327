#version 450

// Splats of mass in colours of their own, by the cubic spline kernel, are put into lists.

#define CHANNELS 3
#define KERNEL 2
#include "wheatstone/multiview/place_splats.glsl"
