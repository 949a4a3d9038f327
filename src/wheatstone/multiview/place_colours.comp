#version 450

// Splats of mass in colours of their own are put into lists.

#define CHANNELS 3
#define KERNEL 1
#include "wheatstone/multiview/place_splats.glsl"
