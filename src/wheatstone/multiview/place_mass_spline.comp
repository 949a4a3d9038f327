#version 450

// Splats of mass by the cubic spline kernel are put into lists.

#define CHANNELS 2
#define KERNEL 2
#include "wheatstone/multiview/place_splats.glsl"
