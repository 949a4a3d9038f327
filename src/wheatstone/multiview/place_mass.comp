#version 450

// Splats of mass are put into lists.

#define CHANNELS 2
#define KERNEL 1
#include "wheatstone/multiview/place_splats.glsl"
