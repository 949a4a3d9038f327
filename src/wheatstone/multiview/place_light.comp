#version 450

// Splats of the thesis's look are put into lists.

#define CHANNELS 3
#define KERNEL 0
#include "wheatstone/multiview/place_splats.glsl"
